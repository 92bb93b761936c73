# Builds and runs the programs of the documents in a project of their own and compares their output with the text below
# them. Builds them also by the project and the commands of .github/INSTALL.md.
#   cmake -D ROOT=<source tree> -D BUILD=<build tree> -D WORK=<scratch folder> -D MODE=<mode> -P consumer_test.cmake
# MODE  find     against an installation of BUILD
#       compile  with add_subdirectory, no further than to the programs' objects: the library is not built again
#       add      with add_subdirectory, to the end
#       shared   against an installation of shared libraries, built for it
cmake_minimum_required(VERSION 3.25)

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGN} ended with ${status}:\n${output}")
  endif()
endfunction()

# Finds the text between the next line FENCE and the end of its block. `rest` becomes the text behind this block.
macro(next_block fence result)
  string(FIND "${rest}" "```${fence}\n" start)
  if(start EQUAL -1)
    set(${result} "")
    set(rest "")
  else()
    string(LENGTH "```${fence}\n" fence_length)
    math(EXPR start "${start} + ${fence_length}")
    string(SUBSTRING "${rest}" ${start} -1 rest)
    string(FIND "${rest}" "```" end)
    string(SUBSTRING "${rest}" 0 ${end} ${result})
    math(EXPR end "${end} + 3")
    string(SUBSTRING "${rest}" ${end} -1 rest)
  endif()
endmacro()

file(REMOVE_RECURSE ${WORK})
configure_file(${ROOT}/tests/consumer/project.cmake ${WORK}/source/CMakeLists.txt COPYONLY)
# Finds the first program of a document, or of a chapter of it, and its output. Programs of si need more than
# contensou::reduction.
#   take_program(NAME document language ending [chapter])
set(programs "")
function(take_program name document language ending)
  file(READ ${ROOT}/${document} rest)
  string(REGEX REPLACE "^.*\n## ${ARGN}\n" "" rest "${rest}")
  next_block(${language} code)
  next_block(text shown)
  if(code STREQUAL "" OR shown STREQUAL "")
    message(FATAL_ERROR "${document} shows no program in ${language} with its output")
  endif()
  file(WRITE ${WORK}/source/${name}.${ending} "${code}")
  set(shown_${name} "${shown}" PARENT_SCOPE)
  if(name MATCHES "^readme_" OR (name MATCHES "^si_" AND NOT MODE STREQUAL "add"))
    set(programs ${programs} ${name} PARENT_SCOPE)
  endif()
endfunction()
take_program(readme_flow README.md cpp cpp)
take_program(readme_law reduction/README.md cpp cpp "A law of your own")
take_program(readme_field reduction/README.md cpp cpp "A field of your own")
take_program(si_motion src/si/README.md cpp cpp)
take_program(wrench src/si/README.md c c)
take_program(wrench_kernel src/si/README.md c++ cpp)
take_program(wrench_step src/si/README.md c++ cpp "Time steps")

# Compares the output of a program with the output that its document shows.
function(compare name program)
  execute_process(COMMAND ${program} RESULT_VARIABLE status OUTPUT_VARIABLE printed)
  if(NOT status EQUAL 0 OR NOT printed STREQUAL "${shown_${name}}")
    message(FATAL_ERROR "${program} ended with ${status} and printed\n${printed}but its document shows\n${shown_${name}}")
  endif()
endfunction()

set(options -G Ninja -D CMAKE_BUILD_TYPE=Debug)
if(MODE STREQUAL "shared")
  set(BUILD ${WORK}/shared)
  # Compiling many sources at a time takes a third of the processor time. MODE add compiles each source alone.
  run(${CMAKE_COMMAND} -S ${ROOT} -B ${BUILD} ${options} -D BUILD_TESTING=OFF -D BUILD_SHARED_LIBS=ON
    -D CONTENSOU_PAGE=OFF -D CMAKE_UNITY_BUILD=ON -D CMAKE_UNITY_BUILD_BATCH_SIZE=16
    -D CMAKE_DISABLE_PRECOMPILE_HEADERS=ON)
  run(${CMAKE_COMMAND} --build ${BUILD})
endif()
if(MODE STREQUAL "find" OR MODE STREQUAL "shared")
  run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/installed)
  list(APPEND options -D CMAKE_PREFIX_PATH=${WORK}/installed)
  # The installed program must run in its folder without any variable of the environment.
  execute_process(COMMAND ${CMAKE_COMMAND} -E env --unset=LD_LIBRARY_PATH --unset=PATH
    ${WORK}/installed/bin/contensou stop --mu 1 --u0 0 --v0 0 --format csv
    RESULT_VARIABLE status OUTPUT_VARIABLE output)
  if(NOT status EQUAL 0 OR output STREQUAL "")
    message(FATAL_ERROR "the installed program ended with ${status} and printed '${output}'")
  endif()
  foreach(document IN ITEMS theory numerics planar)
    if(NOT EXISTS ${WORK}/installed/share/doc/contensou/reduction/${document}.md)
      message(FATAL_ERROR "${document}.md, which `help theory` names, is not installed")
    endif()
  endforeach()
  run(python3 ${ROOT}/tests/links_test.py ${WORK}/installed/share/doc/contensou 5)
else()
  list(APPEND options -D CONTENSOU_SOURCE=${ROOT})
endif()

# Users of wrench_kernel.h need neither CMake nor Eigen nor C++20.
set(include ${ROOT}/reduction/include)
if(EXISTS ${WORK}/installed/include)
  set(include ${WORK}/installed/include)
endif()
foreach(program IN ITEMS wrench_kernel wrench_step)
  run(c++ -std=c++17 -Wall -Wextra -Werror -pedantic -I ${include} ${WORK}/source/${program}.cpp -o ${WORK}/${program})
  compare(${program} ${WORK}/${program})
endforeach()

run(${CMAKE_COMMAND} -S ${WORK}/source -B ${WORK}/build ${options})
if(MODE STREQUAL "compile")
  run(${CMAKE_COMMAND} --build ${WORK}/build --target objects)
  return()
endif()
run(${CMAKE_COMMAND} --build ${WORK}/build --target programs)
foreach(program IN LISTS programs)
  compare(${program} ${WORK}/build/${program})
endforeach()
if(NOT MODE STREQUAL "add")  # in MODE add the project uses contensou::reduction alone
  compare(wrench ${WORK}/build/wrench_from_c)
endif()
if(NOT MODE STREQUAL "find")
  return()
endif()

# Builds the project of INSTALL, and runs its commands for pkg-config, in a folder with the files that they name.
set(mine ${WORK}/mine)
configure_file(${WORK}/source/readme_flow.cpp ${mine}/mine.cpp COPYONLY)
configure_file(${WORK}/source/wrench.c ${mine}/wrench.c COPYONLY)
file(READ ${ROOT}/.github/INSTALL.md rest)
next_block(cmake project)
next_block(sh commands)
file(WRITE ${mine}/CMakeLists.txt "${project}")
run(${CMAKE_COMMAND} -S ${mine} -B ${mine}/build ${options})
run(${CMAKE_COMMAND} --build ${mine}/build)
compare(readme_flow ${mine}/build/mine)
find_program(pkg_config pkg-config)
if(pkg_config)
  set(ENV{PKG_CONFIG_PATH} ${WORK}/installed/lib/pkgconfig)
  # eval is needed because pkg-config writes a backslash before the blank in the name of this folder.
  string(REGEX REPLACE "([^\n]+)" "eval \"\\1\"" commands "${commands}")
  file(WRITE ${mine}/commands.sh "set -e\n${commands}")
  run(${CMAKE_COMMAND} -E chdir ${mine} sh commands.sh)
  compare(readme_flow ${mine}/mine)
  compare(wrench ${mine}/wrench)
endif()
