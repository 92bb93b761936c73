"""The wheel: the module alone, linked with the libraries of this tree."""

import re
import sys
from pathlib import Path

from skbuild import setup

top = Path("../..")
version = re.search(r"VERSION ([0-9.]+)", (top / "CMakeLists.txt").read_text().split("project(")[1])

setup(
    name="contensou",
    version=version[1],
    description="Balls and pucks that slide and spin at once, under the friction of Contensou and Zhuravlev",
    license="MIT",
    python_requires=">=3.9",
    install_requires=["numpy"],
    packages=["contensou"],
    package_data={"contensou": ["py.typed", "*.pyi"]},
    zip_safe=False,
    cmake_source_dir=str(top),
    cmake_args=[
        "-DCONTENSOU_PYTHON=ON", "-DCONTENSOU_PYTHON_DIR=.", f"-DCONTENSOU_PYTHON_EXECUTABLE={sys.executable}",
        "-DCONTENSOU_PROGRAM=OFF", "-DBUILD_TESTING=OFF", "-DCMAKE_UNITY_BUILD=ON", "-DCMAKE_UNITY_BUILD_BATCH_SIZE=16",
        "-DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON",
    ],
    cmake_process_manifest_hook=lambda files: [file for file in files if Path(file).name.startswith("_core.")],
)
