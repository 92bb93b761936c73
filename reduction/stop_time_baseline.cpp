#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace contensou::reduction {
namespace {

constexpr int width = 2;
using Vector [[gnu::vector_size(16)]] = double;
using Bits [[gnu::vector_size(16)]] = unsigned long long;

inline Vector magnitude(Vector x) { return reinterpret_cast<Vector>(reinterpret_cast<Bits>(x) & 0x7fffffffffffffff); }
inline Vector fused(Vector a, Vector b, Vector c) { return a * b + c; }
inline bool any_negative(Bits x) { return (x[0] | x[1]) >> 63 != 0; }

struct Halves {
  Vector low, high;
};

/// Of the panels a and b the half whose coefficients begin there.
inline Vector half(const double* a, const double* b, Vector t) {
  const auto* as = reinterpret_cast<const Vector*>(a);
  const auto* bs = reinterpret_cast<const Vector*>(b);
  const Vector a01 = as[0], b01 = bs[0], a23 = as[2], b23 = bs[2];
  const Vector c0 = __builtin_shufflevector(a01, b01, 0, 2), c1 = __builtin_shufflevector(a01, b01, 1, 3);
  const Vector c2 = __builtin_shufflevector(a23, b23, 0, 2), c3 = __builtin_shufflevector(a23, b23, 1, 3);
  return ((c3 * t + c2) * t + c1) * t + c0;
}

using Pairs = Halves;
inline Halves halves(Pairs of) { return of; }
inline Pairs pairs(const double* const (&panels)[width], const double* t) {
  const Vector ts = *reinterpret_cast<const Vector*>(t);
  return {half(panels[0], panels[1], ts), half(panels[0] + 2, panels[1] + 2, ts)};
}

#ifdef __SSE2__
inline void stream(double* to, Vector vector) { _mm_stream_pd(to, vector); }
inline void streamed() { _mm_sfence(); }
#else
inline void stream(double* to, Vector vector) { *reinterpret_cast<Vector*>(to) = vector; }
inline void streamed() {}
#endif

}  // namespace
}  // namespace contensou::reduction

#include "stop_time_lanes.hpp"

void contensou::reduction::run_baseline(const StopTimeTable& table, const StopTimeJob& job) { run(table, job); }
