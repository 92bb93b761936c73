// The loop for AVX-512 as a processor with AVX2 can run it: its source, word for word, over the few instructions of 512
// bits that it names, each made of two of 256.
#include <immintrin.h>

namespace {

inline __m256d lower(__m512d x) { return __builtin_shufflevector(x, x, 0, 1, 2, 3); }
inline __m256d upper(__m512d x) { return __builtin_shufflevector(x, x, 4, 5, 6, 7); }
inline __m512d whole(__m256d low, __m256d high) { return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7); }

inline __m512d magnitude_in_halves(__m512d x) {
  const __m256d sign = _mm256_set1_pd(-0.0);
  return whole(_mm256_andnot_pd(sign, lower(x)), _mm256_andnot_pd(sign, upper(x)));
}

inline __m512d fused_in_halves(__m512d a, __m512d b, __m512d c) {
  return whole(_mm256_fmadd_pd(lower(a), lower(b), lower(c)), _mm256_fmadd_pd(upper(a), upper(b), upper(c)));
}

inline int signs_in_halves(__m512i x) {
  const auto doubles = reinterpret_cast<__m512d>(x);
  return _mm256_movemask_pd(lower(doubles)) | _mm256_movemask_pd(upper(doubles)) << 4;
}

inline void stream_in_halves(double* to, __m512d x) {
  _mm256_stream_pd(to, lower(x));
  _mm256_stream_pd(to + 4, upper(x));
}

}  // namespace

#define _mm512_abs_pd magnitude_in_halves
#define _mm512_fmadd_pd fused_in_halves
#define _mm512_movepi64_mask signs_in_halves
#define _mm512_stream_pd stream_in_halves
#define run_avx512 run_avx512_in_halves

#include "stop_time_avx512.cpp"
