#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace contensou::reduction {
namespace {

constexpr int width = 2;
using Vector [[gnu::vector_size(16)]] = double;
using Integers [[gnu::vector_size(16)]] = long long;

using Pair [[gnu::vector_size(16)]] = double;
struct Columns {
  Vector first;
  Vector second;
};

inline Columns transposed(const Pair (&pairs)[width]) {
  return {__builtin_shufflevector(pairs[0], pairs[1], 0, 2), __builtin_shufflevector(pairs[0], pairs[1], 1, 3)};
}
inline Vector fused(Vector a, Vector b, Vector c) { return a * b + c; }
inline bool all(Integers mask) { return (mask[0] & mask[1]) != 0; }

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
