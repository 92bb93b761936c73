#pragma once

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <boost/math/quadrature/tanh_sinh.hpp>

namespace contensou::tests {

/// Phi, Psi and 1 - Psi/Psi(0) of a table of pressures in long double: elliptic integrals by the arithmetic-geometric
/// mean, between two rows integrated by tanh-sinh on either side of k.
class RingsOfTable {
 public:
  RingsOfTable(std::vector<double> rho, std::vector<double> pressure)
      : rho_(std::move(rho)), pressure_(std::move(pressure)) {}

  struct Answer {
    long double force, moment, deficit;
  };

  Answer operator()(double k) const {
    const long double load = over([&](const Place&) { return 1.0L; }, k);
    const long double pivoting = over([&](const Place& at) { return at.radius; }, k);
    const long double force = over([&](const Place& at) { return at.inside ? at.cross : at.along; }, k);
    const long double moment = over([&](const Place& at) { return at.radius * (at.inside ? at.along : at.cross); }, k);
    return {force / load, moment / load, 1 - moment / pivoting};
  }

 private:
  struct Place {
    long double radius;
    bool inside;        ///< k < radius
    long double along;  ///< (2/pi) E
    long double cross;  ///< (2/pi) (E - (1 - q^2) K)/q
  };

  /// @param distance  radius^2 - k^2
  static Place place(long double radius, long double k, long double distance) {
    const bool inside = distance > 0;
    const long double larger = inside ? radius : k;
    const long double q = (inside ? k : radius) / larger;
    long double a = 1;
    long double b = std::sqrt(std::abs(distance)) / larger;
    long double sum = 0;
    if (b == 0) return {radius, inside, 2 / std::numbers::pi_v<long double>, 2 / std::numbers::pi_v<long double>};
    for (long double power = 1; std::abs(a - b) > 1e-19L * a && power < 1e6L; power *= 2) {
      const long double half_difference = (a - b) / 2;
      sum += power * half_difference * half_difference;
      const long double mean = (a + b) / 2;
      b = std::sqrt(a * b);
      a = mean;
    }
    return {radius, inside, (1 - q * q / 2 - sum) / a, (q * q / 2 - sum) / a / q};
  }

  template <class Part>
  long double over(Part part, double k) const {
    static boost::math::quadrature::tanh_sinh<long double> rule(12);
    long double total = 0;
    for (std::size_t i = 1; i < rho_.size(); ++i) {
      const long double inner = rho_[i - 1];
      const long double outer = rho_[i];
      const long double width = (outer - inner) * (outer + inner);
      if (width == 0 || (pressure_[i - 1] == 0 && pressure_[i] == 0)) continue;
      const long double behind = (k - inner) * (k + inner);
      const auto at = [&](long double share) {
        const long double pressure = (1 - share) * pressure_[i - 1] + share * pressure_[i];
        const long double radius = std::sqrt(inner * inner + share * width);
        return pressure * width * part(place(radius, k, share * width - behind));
      };
      const long double cut = behind / width;
      if (cut > 0 && cut < 1) {
        total += rule.integrate(at, 0.0L, cut, 1e-12L) + rule.integrate(at, cut, 1.0L, 1e-12L);
      } else {
        total += rule.integrate(at, 0.0L, 1.0L, 1e-12L);
      }
    }
    return total;
  }

  std::vector<double> rho_;
  std::vector<double> pressure_;
};

}  // namespace contensou::tests
