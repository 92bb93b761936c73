#pragma once

#include "contensou/reduction/friction_law.hpp"

namespace contensou::reduction {

/// Returns a law that keeps its values, bit for bit those of the law given. The solutions of one law for many r call
/// the law at the same k. Threads may share the result.
Law remembered(const Law& law);

/// Returns the law that was given to `remembered`, or the law itself.
const Law& original(const Law& law);

}  // namespace contensou::reduction
