#pragma once

#include <functional>
#include <variant>

#include "contensou/reduction/friction_law.hpp"
#include "contensou/wrench_kernel.h"

namespace contensou::reduction {

/// A law whose slopes are central differences, within 1e-9 for a smooth law and finite at kinks.
struct ByDifferences {
  Law law;

  /// @throws std::domain_error  if the law throws
  kernel::Friction<double> operator()(const kernel::Slip<double>& slip) const;
};

/// A law that returns its slopes. The laws of contensou/wrench_kernel.h have slopes in closed form, to 4 eps.
using SlopedLaw = std::variant<ByDifferences, kernel::Exact, kernel::Uniform, kernel::Elliptic, kernel::Pade>;

/// Returns the law of the kernel; ByDifferences for a law that is not in contensou/wrench_kernel.h.
SlopedLaw with_slopes(const Law& law);

/// Returns the friction of a law with its slopes, for implicit steps in time. A law with a dissipation potential
/// satisfies p force_slope = r moment_slope, where p and r are the speeds of kernel::Slip (numerics.md (R50)). A call
/// allocates or throws only if the law does.
std::function<kernel::Friction<double>(Slip)> tangent_of(const Law& law);

/// Returns a bound of the error of tangent_of's slopes: 0 for slopes in closed form, else the error of the differences.
double tangent_error(const Law& law);

}  // namespace contensou::reduction
