# The pictures of README.md, each by the command line that stands above it, and pool.svg:
#   cmake -D CONTENSOU=<program> -D FOLDER=<where> -P gallery.cmake
cmake_minimum_required(VERSION 3.25)

function(draw options picture)
  separate_arguments(words UNIX_COMMAND "${options}")
  execute_process(COMMAND ${CONTENSOU} ${words} -o ${FOLDER}/${picture} COMMAND_ERROR_IS_FATAL ANY)
  message(STATUS "contensou ${options} -o ${picture}")
endfunction()

file(MAKE_DIRECTORY ${FOLDER}/gallery)
draw("portrait --ball pool --law exact" pool.svg)
file(STRINGS ${CMAKE_CURRENT_LIST_DIR}/README.md lines REGEX "^`contensou |^!\\[")
foreach(line IN LISTS lines)
  if(line MATCHES "^`contensou ([^`]+)`")
    set(options "${CMAKE_MATCH_1}")
  elseif(line MATCHES "\\((gallery/[a-z]+\\.svg)\\)")
    draw("${options}" ${CMAKE_MATCH_1})
  endif()
endforeach()
