# Gives the program only headers of Debian's libraries, after the headers of the compiler. Debian's C library lies in
# the same folder and must not come first.
function(from_debian target)
  add_library(${target} INTERFACE IMPORTED GLOBAL)
  target_compile_options(${target} INTERFACE -idirafter/usr/include -idirafter/usr/include/eigen3)
  target_compile_definitions(${target} INTERFACE ${ARGN})
endfunction()

from_debian(Boost::headers)
from_debian(CLI11::CLI11)
from_debian(Eigen3::Eigen)
from_debian(fmt::fmt FMT_HEADER_ONLY)
from_debian(GnuplotIostream::GnuplotIostream)
from_debian(nlohmann_json::nlohmann_json)
from_debian(tomlplusplus::tomlplusplus TOML_HEADER_ONLY=1)
from_debian(Catch2::Catch2)

macro(provide method package)
  if("${package}" MATCHES "^(Boost|CLI11|Eigen3|fmt|GnuplotIostream|nlohmann_json|tomlplusplus|Catch2)$")
    set(${package}_FOUND TRUE)
  endif()
endmacro()
cmake_language(SET_DEPENDENCY_PROVIDER provide SUPPORTED_METHODS FIND_PACKAGE)
