"""The wheel: the module alone, with what it needs of this tree, its libraries inside.

It is tagged for this Python, and for machines with the C library of this one or a later one.
"""

import platform
import re
import sys
import sysconfig
from pathlib import Path

from skbuild import setup

top = Path("../..")
version = re.search(r"VERSION ([0-9.]+)", (top / "CMakeLists.txt").read_text().split("project(")[1])

libc, libc_version = platform.libc_ver()
tags = {}
if libc == "glibc":
    machine = sysconfig.get_platform().removeprefix("linux-").replace("-", "_")
    tags = {"bdist_wheel": {"plat_name": f"manylinux_{libc_version.replace('.', '_')}_{machine}"}}

setup(
    options=tags,
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
        f"-DCMAKE_PROJECT_TOP_LEVEL_INCLUDES={Path('by_headers.cmake').resolve()}",
        "-DCONTENSOU_PYTHON=ON", "-DCONTENSOU_PYTHON_DIR=.", f"-DCONTENSOU_PYTHON_EXECUTABLE={sys.executable}",
        "-DCONTENSOU_PROGRAM=OFF", "-DBUILD_TESTING=OFF", "-DCMAKE_UNITY_BUILD=ON", "-DCMAKE_UNITY_BUILD_BATCH_SIZE=16",
        "-DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON",
    ],
    cmake_process_manifest_hook=lambda files: [file for file in files if Path(file).name.startswith("_core.")],
)
