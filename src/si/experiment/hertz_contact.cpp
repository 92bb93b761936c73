#include "contensou/si/hertz_contact.hpp"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace contensou::si {

double effective_modulus(const HertzModuli& moduli) {
  const auto compliance = [&](std::size_t body) {
    const double nu = moduli.poisson_ratio[body];
    return (1 - nu) * (1 + nu) / moduli.youngs_modulus[body];
  };
  return 1 / (compliance(0) + compliance(1));
}

double hertz_patch_radius(double load, double radius, const HertzModuli& moduli) {
  const double bend = 1 + radius / moduli.counter_radius;  // R/R'
  if (!(bend > 0)) {
    throw std::domain_error(fmt::format(
        "counter_radius {} m is a dish no wider than the ball of radius {} m, which then touches it in no one "
        "patch: below {} it is wider",
        moduli.counter_radius, radius, -radius));
  }
  return std::cbrt(0.75 * load * (radius / bend) / effective_modulus(moduli));
}

double patch_radius_of_deceleration(double radius, double deceleration, double friction, double gravity,
                                    double pivoting_moment, double gamma) {
  return radius * radius * deceleration / (gamma * friction * gravity * pivoting_moment);
}

}  // namespace contensou::si
