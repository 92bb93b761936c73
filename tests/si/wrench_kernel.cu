// All of wrench_kernel.h, as C++17 and as CUDA. CUDA itself is not needed: clang knows the language, and the attributes
// and functions that CUDA's headers would declare stand here.
#ifdef __CUDACC__
#define __host__ __attribute__((host))
#define __device__ __attribute__((device))
#define __global__ __attribute__((global))
#define DECLARE(T)             \
  __device__ T fabs(T);        \
  __device__ T sqrt(T);        \
  __device__ T log(T);         \
  __device__ T frexp(T, int*); \
  __device__ T ldexp(T, int);
DECLARE(float)
DECLARE(double)
#else
#define __device__
#define __global__
#endif

#include "contensou/wrench_kernel.h"

using namespace contensou::kernel;

template <class Law, class T>
__device__ void both(T* at) {
  const Wrench<T> value = wrench<Law>(at[0], at[1], at[2], at[3], at[4]);
  const WrenchSlopes<T> slopes = wrench_slopes<Law>(at[0], at[1], at[2], at[3], at[4], at[5]);
  at[6] = value.fx + value.fy + value.m + slopes.slopes[2][2];
  at[7] = step<Law>(at[0], at[1], at[2], at[3], at[4], at[5], at[6], at[7]).w;
}

template <class T>
__device__ void all(T* at) {
  both<Exact>(at);
  both<Uniform>(at);
  both<Elliptic>(at);
  both<Pade>(at);
}

__global__ void contacts(float* floats, double* doubles) {
  all(floats);
  all(doubles);
}
