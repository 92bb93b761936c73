#include <immintrin.h>

namespace contensou::reduction {
namespace {

constexpr int width = 8;
using Vector = __m512d;
using Bits [[gnu::vector_size(64)]] = unsigned long long;

inline Vector larger(Vector a, Vector b) { return _mm512_maskz_max_pd(0xff, a, b); }
inline Vector fused(Vector a, Vector b, Vector c) { return _mm512_fmadd_pd(a, b, c); }
inline bool any_negative(Bits x) { return _mm512_movepi64_mask(reinterpret_cast<__m512i>(x)) != 0; }

struct Columns {
  Vector zeroth, first, second, third;
};

inline __m256d folded(const double* panel, const double& t4) {
  return _mm256_fmadd_pd(_mm256_broadcast_sd(&t4), _mm256_load_pd(panel + 4), _mm256_load_pd(panel));
}
/// Lanes i and i + 4, one after the other.
inline Vector joined(const double* const (&panels)[width], const double* t4, int i) {
  return __builtin_shufflevector(folded(panels[i], t4[i]), folded(panels[i + 4], t4[i + 4]), 0, 1, 2, 3, 4, 5, 6, 7);
}
inline Columns columns(const double* const (&panels)[width], const double* t4) {
  const Vector a = joined(panels, t4, 0), b = joined(panels, t4, 1);
  const Vector c = joined(panels, t4, 2), d = joined(panels, t4, 3);
  return {
      __builtin_shufflevector(__builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14),
                              __builtin_shufflevector(c, d, 0, 8, 2, 10, 4, 12, 6, 14), 0, 1, 8, 9, 4, 5, 12, 13),
      __builtin_shufflevector(__builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15),
                              __builtin_shufflevector(c, d, 1, 9, 3, 11, 5, 13, 7, 15), 0, 1, 8, 9, 4, 5, 12, 13),
      __builtin_shufflevector(__builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14),
                              __builtin_shufflevector(c, d, 0, 8, 2, 10, 4, 12, 6, 14), 2, 3, 10, 11, 6, 7, 14, 15),
      __builtin_shufflevector(__builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15),
                              __builtin_shufflevector(c, d, 1, 9, 3, 11, 5, 13, 7, 15), 2, 3, 10, 11, 6, 7, 14, 15)};
}

inline void stream(double* to, Vector vector) { _mm512_stream_pd(to, vector); }
inline void streamed() { _mm_sfence(); }

}  // namespace
}  // namespace contensou::reduction

#include "stop_time_lanes.hpp"

void contensou::reduction::run_avx512(const StopTimeTable& table, const StopTimeJob& job) { run(table, job); }
