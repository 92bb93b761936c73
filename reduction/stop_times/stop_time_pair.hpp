// What the kernels of AVX2 and AVX-512 have in common: two starts in a vector of four doubles.
#pragma once

#include <immintrin.h>

namespace contensou::reduction {
namespace {

/// Of the panels a and b the low halves, a b, and the high ones, a b; t holds where the two starts lie.
inline __m256d pair(const double* a, const double* b, const double* t) {
  const __m256d ts = _mm256_broadcast_pd(reinterpret_cast<const __m128d*>(t));
  const __m256d a01 = _mm256_load_pd(a), b01 = _mm256_load_pd(b);
  const __m256d a23 = _mm256_load_pd(a + 4), b23 = _mm256_load_pd(b + 4);
  const __m256d from2 = _mm256_fmadd_pd(_mm256_unpackhi_pd(a23, b23), ts, _mm256_unpacklo_pd(a23, b23));
  const __m256d from1 = _mm256_fmadd_pd(from2, ts, _mm256_unpackhi_pd(a01, b01));
  return _mm256_fmadd_pd(from1, ts, _mm256_unpacklo_pd(a01, b01));
}

/// The low and the high halves of two pairs.
inline __m256d low(__m256d ab, __m256d cd) { return _mm256_permute2f128_pd(ab, cd, 0x20); }
inline __m256d high(__m256d ab, __m256d cd) { return _mm256_permute2f128_pd(ab, cd, 0x31); }

}  // namespace
}  // namespace contensou::reduction
