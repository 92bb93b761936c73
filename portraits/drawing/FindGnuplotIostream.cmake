# gnuplot-iostream, a header that comes without a package for CMake.
find_path(GnuplotIostream_INCLUDE_DIR gnuplot-iostream.h)
mark_as_advanced(GnuplotIostream_INCLUDE_DIR)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(GnuplotIostream REQUIRED_VARS GnuplotIostream_INCLUDE_DIR)
if(GnuplotIostream_FOUND AND NOT TARGET GnuplotIostream::GnuplotIostream)
  add_library(GnuplotIostream::GnuplotIostream INTERFACE IMPORTED)
  target_include_directories(GnuplotIostream::GnuplotIostream INTERFACE ${GnuplotIostream_INCLUDE_DIR})
endif()
