#include <immintrin.h>

#include "stop_time_pair.hpp"

namespace contensou::reduction {
namespace {

constexpr int width = 8;
using Vector = __m512d;
using Bits [[gnu::vector_size(64)]] = unsigned long long;

inline Vector magnitude(Vector x) { return _mm512_abs_pd(x); }
inline Vector fused(Vector a, Vector b, Vector c) { return _mm512_fmadd_pd(a, b, c); }
inline bool any_negative(Bits x) { return _mm512_movepi64_mask(reinterpret_cast<__m512i>(x)) != 0; }

struct Pairs {
  __m256d ab, cd, ef, gh;
};
inline Pairs pairs(const double* const (&panels)[width], const double* t) {
  return {pair(panels[0], panels[1], t), pair(panels[2], panels[3], t + 2), pair(panels[4], panels[5], t + 4),
          pair(panels[6], panels[7], t + 6)};
}

inline Vector joined(__m256d first, __m256d second) {
  return __builtin_shufflevector(first, second, 0, 1, 2, 3, 4, 5, 6, 7);
}
struct Halves {
  Vector low, high;
};
inline Halves halves(const Pairs& of) {
  return {joined(low(of.ab, of.cd), low(of.ef, of.gh)), joined(high(of.ab, of.cd), high(of.ef, of.gh))};
}

inline void stream(double* to, Vector vector) { _mm512_stream_pd(to, vector); }
inline void streamed() { _mm_sfence(); }

}  // namespace
}  // namespace contensou::reduction

#include "stop_time_lanes.hpp"

void contensou::reduction::run_avx512(const StopTimeTable& table, const StopTimeJob& job) { run(table, job); }
