#include <immintrin.h>

namespace contensou::reduction {
namespace {

constexpr int width = 4;
using Vector = __m256d;
using Bits [[gnu::vector_size(32)]] = unsigned long long;

inline Vector larger(Vector a, Vector b) { return _mm256_max_pd(a, b); }
inline Vector fused(Vector a, Vector b, Vector c) { return _mm256_fmadd_pd(a, b, c); }
inline bool any_negative(Bits x) { return _mm256_movemask_pd(reinterpret_cast<Vector>(x)) != 0; }

struct Columns {
  Vector zeroth, first, second, third;
};

inline Vector folded(const double* panel, const double& t4) {
  return _mm256_fmadd_pd(_mm256_broadcast_sd(&t4), _mm256_load_pd(panel + 4), _mm256_load_pd(panel));
}
inline Columns columns(const double* const (&panels)[width], const double* t4) {
  const Vector a = folded(panels[0], t4[0]), b = folded(panels[1], t4[1]);
  const Vector c = folded(panels[2], t4[2]), d = folded(panels[3], t4[3]);
  const Vector ab_even = _mm256_unpacklo_pd(a, b), ab_odd = _mm256_unpackhi_pd(a, b);
  const Vector cd_even = _mm256_unpacklo_pd(c, d), cd_odd = _mm256_unpackhi_pd(c, d);
  return {_mm256_permute2f128_pd(ab_even, cd_even, 0x20), _mm256_permute2f128_pd(ab_odd, cd_odd, 0x20),
          _mm256_permute2f128_pd(ab_even, cd_even, 0x31), _mm256_permute2f128_pd(ab_odd, cd_odd, 0x31)};
}

inline void stream(double* to, Vector vector) { _mm256_stream_pd(to, vector); }
inline void streamed() { _mm_sfence(); }

}  // namespace
}  // namespace contensou::reduction

#include "stop_time_lanes.hpp"

void contensou::reduction::run_avx2(const StopTimeTable& table, const StopTimeJob& job) { run(table, job); }
