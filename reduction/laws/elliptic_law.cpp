#include "contensou/reduction/laws.hpp"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace contensou::reduction {

EllipticLaw::EllipticLaw(double moment) : moment_(moment) {
  if (moment >= min_moment && moment <= 1) return;
  throw std::domain_error(fmt::format("EllipticLaw: the moment C must be from {} to 1, got {}", min_moment, moment));
}

std::string EllipticLaw::name() const {
  return moment_ == hertz_moment ? "elliptic" : fmt::format("elliptic:{}", moment_);
}

Resistance EllipticLaw::operator()(Slip slip) const {
  require_slip("EllipticLaw", slip);
  if (slip.sliding <= slip.pivoting) {
    const double k = slip.sliding / slip.pivoting;
    const double root = std::sqrt(k * k + moment_ * moment_);
    return {k / root, moment_ * (moment_ / root)};
  }
  const double inverse_k = slip.pivoting / slip.sliding;
  const double rim = moment_ * inverse_k;
  const double root = std::sqrt(1 + rim * rim);
  return {1 / root, moment_ * (rim / root)};
}

double EllipticLaw::moment_deficit(Slip slip) const {
  if (slip.sliding > slip.pivoting) return 1 - (*this)(slip).moment / moment_;
  require_slip("EllipticLaw", slip);
  const double k = slip.sliding / slip.pivoting;
  const double root = std::sqrt(k * k + moment_ * moment_);
  return k / root * (k / (root + moment_));
}

double EllipticLaw::force_deficit(Slip slip) const {
  if (slip.sliding <= slip.pivoting) return 1 - (*this)(slip).force;
  require_slip("EllipticLaw", slip);
  const double rim = moment_ * (slip.pivoting / slip.sliding);
  const double root = std::sqrt(1 + rim * rim);
  return rim / root * (rim / (1 + root));
}

}  // namespace contensou::reduction
