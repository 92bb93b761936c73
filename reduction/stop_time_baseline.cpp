#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace contensou::reduction {
namespace {

constexpr int width = 2;
using Vector [[gnu::vector_size(16)]] = double;
using Bits [[gnu::vector_size(16)]] = unsigned long long;

inline Vector larger(Vector a, Vector b) { return a > b ? a : b; }
inline Vector fused(Vector a, Vector b, Vector c) { return a * b + c; }
inline bool any_negative(Bits x) { return (x[0] | x[1]) >> 63 != 0; }

struct Columns {
  Vector zeroth, first, second, third;
};

/// Coefficients j and j + 1 of a panel, with four more each.
inline Vector folded(const double* panel, double t4, int j) {
  const auto* pairs = reinterpret_cast<const Vector*>(panel + j);
  return pairs[0] + t4 * pairs[2];
}
inline Columns columns(const double* const (&panels)[width], const double* t4) {
  const Vector a = folded(panels[0], t4[0], 0), b = folded(panels[1], t4[1], 0);
  const Vector c = folded(panels[0], t4[0], 2), d = folded(panels[1], t4[1], 2);
  return {__builtin_shufflevector(a, b, 0, 2), __builtin_shufflevector(a, b, 1, 3), __builtin_shufflevector(c, d, 0, 2),
          __builtin_shufflevector(c, d, 1, 3)};
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
