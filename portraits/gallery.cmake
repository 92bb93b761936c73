# The pictures of portraits/README.md, each by one command line:
#   cmake -D CONTENSOU=<program> -D FOLDER=<where> -P gallery.cmake
cmake_minimum_required(VERSION 3.25)

set(pictures
  "pool.svg: --ball pool --law exact"
  "gallery/uv.svg: --mu 0.3"
  "gallery/pair.svg: --mu 0.01 --law exact"
  "gallery/patch.svg: --mu 0.5 --law exact --view patch --through 0.6,0.4"
  "gallery/log.svg: --mu 0.5 --view log"
  "gallery/similarity.svg: --mu 0.3 --view similarity"
  "gallery/blowup.svg: --mu 0.3 --view blowup"
  "gallery/disc.svg: --mu 0.3 --view disc --style screen"
  "gallery/time.svg: --mu 0.3 --view time"
  "gallery/puck.svg: --body disc --law uniform"
  "gallery/against.svg: --mu 0.5 --against exact --orbits 8"
  "gallery/field.svg: --mu 0.5 --view patch --field --orbits 5 --isochrones 0")

file(MAKE_DIRECTORY ${FOLDER}/gallery)
foreach(picture IN LISTS pictures)
  string(REGEX MATCH "^([^:]+): (.*)$" ignored "${picture}")
  separate_arguments(options UNIX_COMMAND "${CMAKE_MATCH_2}")
  set(file ${FOLDER}/${CMAKE_MATCH_1})
  execute_process(COMMAND ${CONTENSOU} portrait ${options} -o ${file} COMMAND_ERROR_IS_FATAL ANY)
  message(STATUS "contensou portrait ${CMAKE_MATCH_2} -o ${CMAKE_MATCH_1}")
endforeach()
