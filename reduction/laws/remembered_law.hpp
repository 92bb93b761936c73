#pragma once

#include "contensou/reduction/friction_law.hpp"

namespace contensou::reduction {

/// Returns a law that stores its values; they equal the values of the given law bit for bit. The solutions of one law
/// for many r call the law at the same k. Threads may share the result.
Law remembered(const Law& law);

/// Returns the law that was given to `remembered`; a law that `remembered` did not make is returned unchanged.
const Law& original(const Law& law);

}  // namespace contensou::reduction
