// Notation: s = rho^2, s_i the rows, g_i the slope of the pressure in s before row i.
//   pressure = p_n + sum of c_i (1 - s/s_i) over the rows with s < s_i,  c_i = s_i (g_(i+1) - g_i),  g_(n+1) = 0
// A paraboloid of radius a carries the load c a^2/2 (per pi); its rim speed of pivoting is a times that of the patch.
#include "contensou/reduction/profile_law.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "contensou/reduction/pressure_law.hpp"

namespace contensou::reduction {

namespace {

const PressureLaw& paraboloid() {
  static const PressureLaw law(1);
  return law;
}

const PressureLaw& uniform() {
  static const PressureLaw law = PressureLaw::uniform();
  return law;
}

void require_table(const Eigen::ArrayXd& rho, const Eigen::ArrayXd& pressure) {
  const auto reject = [](Eigen::Index row, const std::string& rule) {
    throw std::domain_error(fmt::format("ProfileLaw: row {}: {}", row + 1, rule));
  };
  if (rho.size() != pressure.size() || rho.size() < 2) {
    throw std::domain_error(fmt::format("ProfileLaw: two or more rows are needed, got {} rho and {} pressures",
                                        rho.size(), pressure.size()));
  }
  const Eigen::Index last = rho.size() - 1;
  if (rho[0] != 0) reject(0, fmt::format("rho must begin at 0, got {}", rho[0]));
  for (Eigen::Index i = 0; i <= last; ++i) {
    if (i > 0 && !(rho[i] > rho[i - 1])) reject(i, fmt::format("rho must increase, got {}", rho[i]));
    if (!(pressure[i] >= 0) || !std::isfinite(pressure[i])) {
      reject(i, fmt::format("the pressure must be finite and >= 0, got {}", pressure[i]));
    }
  }
  if (rho[last] != 1) reject(last, fmt::format("rho must end at 1, got {}", rho[last]));
  if (!(pressure.maxCoeff() > 0)) throw std::domain_error("ProfileLaw: the pressure is 0 in every row");
}

}  // namespace

ProfileLaw::ProfileLaw(std::string name, const Eigen::ArrayXd& rho, const Eigen::ArrayXd& pressure)
    : name_(std::move(name)) {
  require_table(rho, pressure);
  const Eigen::ArrayXd relative = pressure / pressure.maxCoeff();
  const Eigen::Index last = rho.size() - 1;
  const auto slope = [&](Eigen::Index i) {
    return i > last ? 0.0 : (relative[i] - relative[i - 1]) / ((rho[i] - rho[i - 1]) * (rho[i] + rho[i - 1]));
  };
  std::vector<Disc> discs;
  const auto add = [&](double radius, double load, double pure_pivoting) {
    discs.push_back({radius, load, load * radius * pure_pivoting});
    load_ += discs.back().load;
    pivoting_moment_ += discs.back().moment;
  };
  for (Eigen::Index i = 1; i <= last; ++i) {
    const double square = rho[i] * rho[i];
    add(rho[i], square * (slope(i + 1) - slope(i)) * square / 2, paraboloid()({0, 1}).moment);
  }
  add(1, relative[last], uniform()({0, 1}).moment);
  discs_ = std::make_shared<const std::vector<Disc>>(std::move(discs));
}

Resistance ProfileLaw::operator()(Slip slip) const {
  require_slip("ProfileLaw", slip);
  Resistance sum{0, 0};
  for (const Disc& disc : *discs_) {
    if (disc.load == 0) continue;
    const PressureLaw& law = &disc == &discs_->back() ? uniform() : paraboloid();
    const Resistance part = law({slip.sliding, slip.pivoting * disc.radius});
    sum.force += disc.load * part.force;
    sum.moment += disc.load * disc.radius * part.moment;
  }
  return {std::min(sum.force / load_, 1.0), sum.moment / load_};
}

double ProfileLaw::moment_deficit(Slip slip) const {
  require_slip("ProfileLaw", slip);
  double sum = 0;
  for (const Disc& disc : *discs_) {
    if (disc.load == 0) continue;
    const PressureLaw& law = &disc == &discs_->back() ? uniform() : paraboloid();
    sum += disc.moment * law.moment_deficit({slip.sliding, slip.pivoting * disc.radius});
  }
  return sum / pivoting_moment_;
}

}  // namespace contensou::reduction
