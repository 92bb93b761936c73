#include <immintrin.h>

namespace contensou::reduction {
namespace {

constexpr int width = 8;
using Vector = __m512d;
using Integers [[gnu::vector_size(64)]] = long long;

using Pair [[gnu::vector_size(16)]] = double;
struct Columns {
  Vector first;
  Vector second;
};

inline Columns transposed(const Pair (&pairs)[width]) {
  const auto joined = [&](int lane) {
    const auto low = __builtin_shufflevector(pairs[lane], pairs[lane + 2], 0, 1, 2, 3);
    const auto high = __builtin_shufflevector(pairs[lane + 4], pairs[lane + 6], 0, 1, 2, 3);
    return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
  };
  const Vector even = joined(0), odd = joined(1);
  return {__builtin_shufflevector(even, odd, 0, 8, 2, 10, 4, 12, 6, 14),
          __builtin_shufflevector(even, odd, 1, 9, 3, 11, 5, 13, 7, 15)};
}
inline Vector fused(Vector a, Vector b, Vector c) { return _mm512_fmadd_pd(a, b, c); }
inline bool all(Integers mask) { return _mm512_movepi64_mask(reinterpret_cast<__m512i>(mask)) == 0xff; }
inline void stream(double* to, Vector vector) { _mm512_stream_pd(to, vector); }
inline void streamed() { _mm_sfence(); }

}  // namespace
}  // namespace contensou::reduction

#include "stop_time_lanes.hpp"

void contensou::reduction::run_avx512(const StopTimeTable& table, const StopTimeJob& job) { run(table, job); }
