#include <immintrin.h>

namespace contensou::reduction {
namespace {

constexpr int width = 4;
using Vector = __m256d;
using Integers [[gnu::vector_size(32)]] = long long;

using Pair [[gnu::vector_size(16)]] = double;
struct Columns {
  Vector first;
  Vector second;
};

inline Columns transposed(const Pair (&pairs)[width]) {
  const auto joined = [&](int lane) { return __builtin_shufflevector(pairs[lane], pairs[lane + 2], 0, 1, 2, 3); };
  const Vector even = joined(0), odd = joined(1);
  return {__builtin_shufflevector(even, odd, 0, 4, 2, 6), __builtin_shufflevector(even, odd, 1, 5, 3, 7)};
}
inline Vector fused(Vector a, Vector b, Vector c) { return _mm256_fmadd_pd(a, b, c); }
inline bool all(Integers mask) { return _mm256_movemask_pd(reinterpret_cast<Vector>(mask)) == 0xf; }
inline void stream(double* to, Vector vector) { _mm256_stream_pd(to, vector); }
inline void streamed() { _mm_sfence(); }

}  // namespace
}  // namespace contensou::reduction

#include "stop_time_lanes.hpp"

void contensou::reduction::run_avx2(const StopTimeTable& table, const StopTimeJob& job) { run(table, job); }
