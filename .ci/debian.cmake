# Adds a copyright and a changelog to each package, and compresses the manual pages, as Debian demands. CPack runs this script
# between the installation and the packing.
cmake_minimum_required(VERSION 3.25)

set(root ${CMAKE_CURRENT_LIST_DIR}/..)
file(READ ${root}/LICENSE licence)
string(REGEX REPLACE "^MIT License\n\nCopyright \\(c\\) ([^\n]*)\n\n" "" licence "${licence}")
set(holder "${CMAKE_MATCH_1}")
string(STRIP "${licence}" licence)
string(REPLACE "\n\n" "\n.\n" licence "${licence}")
string(REPLACE "\n" "\n " licence "\n${licence}")
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)

file(GLOB components LIST_DIRECTORIES ON ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/*)
foreach(component IN LISTS components)
  cmake_path(GET component FILENAME name)
  string(TOUPPER ${name} name)
  set(package ${CPACK_DEBIAN_${name}_PACKAGE_NAME})
  set(documents ${component}/usr/share/doc/${package})
  file(REMOVE ${documents}/LICENSE)
  file(COPY ${root}/.github/THIRD_PARTY.txt DESTINATION ${documents})
  file(WRITE ${documents}/copyright "Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: contensou
Upstream-Contact: ${CPACK_PACKAGE_CONTACT}
Source: ${CPACK_PACKAGE_HOMEPAGE_URL}
Comment: THIRD_PARTY.txt beside this file has the licences of the libraries that
 are compiled into the package.

Files: *
Copyright: ${holder}
License: Expat${licence}
")
  file(WRITE ${documents}/changelog "contensou (${CPACK_PACKAGE_VERSION}) unstable; urgency=medium

  * Release ${CPACK_PACKAGE_VERSION}; .github/CHANGELOG.md in the sources lists its changes.

 -- ${CPACK_PACKAGE_CONTACT}  ${date}
")
  file(GLOB compressed ${component}/usr/share/man/man*/*.[1-9])
  execute_process(COMMAND gzip -9n ${documents}/changelog ${compressed} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
