#include <immintrin.h>

#include "stop_times/stop_time_pair.hpp"

namespace contensou::reduction {
namespace {

constexpr int width = 4;
using Vector = __m256d;
using Bits [[gnu::vector_size(32)]] = unsigned long long;

inline Vector magnitude(Vector x) { return _mm256_andnot_pd(_mm256_set1_pd(-0.0), x); }
inline Vector fused(Vector a, Vector b, Vector c) { return _mm256_fmadd_pd(a, b, c); }
inline bool any_negative(Bits x) { return _mm256_movemask_pd(reinterpret_cast<Vector>(x)) != 0; }

struct Pairs {
  Vector ab, cd;
};
inline Pairs pairs(const double* const (&panels)[width], const double* t) {
  return {pair(panels[0], panels[1], t), pair(panels[2], panels[3], t + 2)};
}

struct Halves {
  Vector low, high;
};
inline Halves halves(Pairs of) { return {low(of.ab, of.cd), high(of.ab, of.cd)}; }

inline void stream(double* to, Vector vector) { _mm256_stream_pd(to, vector); }
inline void streamed() { _mm_sfence(); }

}  // namespace
}  // namespace contensou::reduction

#include "stop_times/stop_time_lanes.hpp"

void contensou::reduction::run_avx2(const StopTimeTable& table, const StopTimeJob& job) { run(table, job); }
