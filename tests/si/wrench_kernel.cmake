# Compiles wrench_kernel.cu as CUDA, by clang; then with a std::vector in the header, which must fail.
#   cmake -D CLANG=<clang++> -D ROOT=<top of the tree> -D WORK=<scratch folder> -P wrench_kernel.cmake
cmake_minimum_required(VERSION 3.25)

function(compile include result)
  execute_process(COMMAND ${CLANG} -x cuda --cuda-device-only --cuda-gpu-arch=sm_70 -nocudainc -nocudalib
    -Wno-unknown-cuda-version -D__CUDACC__ -std=c++17 -Wall -Wextra -Werror -fsyntax-only -I ${include}
    ${ROOT}/tests/si/wrench_kernel.cu RESULT_VARIABLE status ERROR_VARIABLE output)
  if(status EQUAL 0)
    set(output "compiled")
  endif()
  set(${result} "${output}" PARENT_SCOPE)
endfunction()

set(include ${ROOT}/reduction/include)
file(READ ${include}/contensou/wrench_kernel.h header)
string(REGEX MATCHALL "#include[^\n]*" includes "${header}")
if(NOT includes STREQUAL "#include <cmath>")
  message(FATAL_ERROR "wrench_kernel.h includes more than <cmath>: ${includes}")
endif()
compile(${include} output)
if(NOT output STREQUAL "compiled")
  message(FATAL_ERROR "wrench_kernel.h is not CUDA:\n${output}")
endif()

string(REPLACE "#include <cmath>" "#include <cmath>\n#include <vector>" header "${header}")
string(REPLACE "  WrenchSlopes<T> result{};" "  WrenchSlopes<T> result{};\n  std::vector<T> speeds(3, vx);" header "${header}")
file(WRITE ${WORK}/contensou/wrench_kernel.h "${header}")
compile(${WORK} output)
if(NOT output MATCHES "reference to __host__ function")
  message(FATAL_ERROR "a std::vector in wrench_kernel.h passes: ${output}")
endif()
