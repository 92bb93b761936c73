# Makes packages by cpack: for Debian, one for each component, with CMAKE_INSTALL_PREFIX=/usr; for Windows, a zip.
set(CPACK_PACKAGE_CONTACT "The contensou maintainers <contensou@users.noreply.github.com>")
set(CPACK_STRIP_FILES ON)

set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/debian.cmake)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "balls and pucks that slide and spin on a plane")
set(what "contensou computes stop times, motions and phase portraits of a body under the
combined dry friction of Contensou and Zhuravlev.")

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME contensou)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS gnuplot-nox)
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "${what}
.
This package contains the program, its manual pages, and completions for bash
and zsh. The program draws with gnuplot.")

set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libcontensou-dev)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS "libeigen3-dev, libfmt-dev, libtomlplusplus-dev")
set(CPACK_DEBIAN_LIBRARY_DESCRIPTION "${what}
.
This package contains the static libraries, their headers for C++20 and C, and
the files for CMake and pkg-config.")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-contensou)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
if(TARGET contensou_python)
  get_directory_property(minor DIRECTORY src/python DEFINITION Python_VERSION_MINOR)
  math(EXPR next "${minor} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.${minor}), python3 (<< 3.${next}), python3-numpy")
endif()
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-matplotlib")
set(CPACK_DEBIAN_PYTHON_DESCRIPTION "${what}
.
This package contains the module for Python 3, with arrays of NumPy.")

if(WIN32)  # the zip contains the program alone, in a folder that may lie anywhere
  set(CPACK_GENERATOR ZIP)
  set(CPACK_COMPONENTS_ALL program)
  set(CPACK_ARCHIVE_COMPONENT_INSTALL ON)
  set(CPACK_PRE_BUILD_SCRIPTS "")
  install(FILES README.md LICENSE .github/THIRD_PARTY.txt DESTINATION . COMPONENT program)
endif()
include(CPack)
