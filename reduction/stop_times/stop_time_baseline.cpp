#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace contensou::reduction {
namespace {

constexpr int width = 2;
using Vector [[gnu::vector_size(16)]] = double;
using Bits [[gnu::vector_size(16)]] = unsigned long long;

inline Vector magnitude(Vector x) { return reinterpret_cast<Vector>(reinterpret_cast<Bits>(x) & 0x7fffffffffffffff); }

#ifdef __FP_FAST_FMA
inline Vector fused(Vector a, Vector b, Vector c) {
  return {__builtin_fma(a[0], b[0], c[0]), __builtin_fma(a[1], b[1], c[1])};
}
#else
/// The upper half of the digits (Veltkamp).
inline Vector upper(Vector x) {
  const Vector raised = 0x8000001p0 * x;
  return raised - (raised - x);
}

/// A processor without the instruction makes it of some twenty others: product and sum each with what their roundings
/// leave out (Dekker, Knuth), which is added last. That addition rounds, too: where the whole lies within 2^-50 of the
/// middle between two doubles, but not there, this may be the other one of them.
inline Vector fused(Vector a, Vector b, Vector c) {
  const Vector product = a * b;
  const Vector a1 = upper(a), a0 = a - a1, b1 = upper(b), b0 = b - b1;
  const Vector below_product = ((a1 * b1 - product) + a1 * b0 + a0 * b1) + a0 * b0;
  const Vector sum = product + c;
  const Vector product_in_sum = sum - c;
  const Vector below_sum = (product - product_in_sum) + (c - (sum - product_in_sum));
  return sum + (below_sum + below_product);
}
#endif

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
  return fused(fused(fused(c3, t, c2), t, c1), t, c0);
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

#include "stop_times/stop_time_lanes.hpp"

void contensou::reduction::run_baseline(const StopTimeTable& table, const StopTimeJob& job) { run(table, job); }
