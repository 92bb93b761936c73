"""The wheel: the module alone, with what it needs of this tree, its libraries inside.

It is tagged for this Python, and for machines with the C library of this one or a later one. This file works in its folder and,
for pip, at the top of the archive that `.ci/release sources` makes.
"""

import platform
import re
import sys
import sysconfig
from pathlib import Path

from skbuild import setup

here = Path("." if Path("by_headers.cmake").exists() else "src/python")
top = Path("../.." if here == Path(".") else ".")
project = re.search(r"project\((.*?)\)\n", (top / "CMakeLists.txt").read_text(), re.DOTALL)[1]
version = re.search(r"VERSION ([0-9.]+)", project)[1]
url = re.search(r'HOMEPAGE_URL "(.*)"', project)[1]

# Links and pictures by their addresses in the repository.
readme = re.sub(r"\]\((?!https?:|#)([^)]*)\)", rf"]({url}/blob/v{version}/src/python/\1)", (here / "README.md").read_text())

libc, libc_version = platform.libc_ver()
tags = {}
if libc == "glibc":
    machine = sysconfig.get_platform().removeprefix("linux-").replace("-", "_")
    tags = {"bdist_wheel": {"plat_name": f"manylinux_{libc_version.replace('.', '_')}_{machine}"}}

setup(
    options=tags,
    name="contensou",
    version=version,
    description="Balls and pucks that slide and spin at once, under the friction of Contensou and Zhuravlev",
    long_description=readme,
    long_description_content_type="text/markdown",
    author="The contensou authors",
    maintainer="The contensou maintainers",
    url=url,
    project_urls={"Issues": f"{url}/issues", "Changes": f"{url}/blob/main/.github/CHANGELOG.md"},
    license="MIT",
    license_files=[str(top / "LICENSE"), str(top / ".github/THIRD_PARTY.txt")],
    classifiers=[
        "Development Status :: 4 - Beta",
        "Intended Audience :: Education",
        "Intended Audience :: Science/Research",
        "License :: OSI Approved :: MIT License",
        "Operating System :: POSIX :: Linux",
        "Programming Language :: C++",
        "Programming Language :: Python :: 3",
        "Topic :: Scientific/Engineering :: Physics",
        "Typing :: Typed",
    ],
    python_requires=">=3.9",
    install_requires=["numpy"],
    packages=["contensou"],
    package_dir={"contensou": str(here / "contensou")},
    package_data={"contensou": ["py.typed", "*.pyi"]},
    zip_safe=False,
    cmake_source_dir=str(top),
    cmake_args=[
        f"-DCMAKE_PROJECT_TOP_LEVEL_INCLUDES={(here / 'by_headers.cmake').resolve()}",
        "-DCONTENSOU_PYTHON=ON", f"-DCONTENSOU_PYTHON_DIR={here}", f"-DCONTENSOU_PYTHON_EXECUTABLE={sys.executable}",
        "-DCONTENSOU_PROGRAM=OFF", "-DBUILD_TESTING=OFF", "-DCMAKE_UNITY_BUILD=ON", "-DCMAKE_UNITY_BUILD_BATCH_SIZE=16",
        "-DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON",
    ],
    cmake_process_manifest_hook=lambda files: [file for file in files if Path(file).name.startswith("_core.")],
)
