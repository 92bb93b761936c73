#include "fit/orbit_cells.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <Eigen/LU>

#include "contensou/reduction/detail/infinity.hpp"
#include "contensou/reduction/detail/root.hpp"
#include "contensou/reduction/reduced_system.hpp"

namespace contensou::fit {

namespace {

constexpr double near_axis = 1e-12;  ///< least k, and least 1/k; a start nearer to an axis is moved to this value
constexpr double at_rest = 1e-12;    ///< share of the speeds at the start below which the body counts as being at rest
constexpr double first_width = 0.5, min_width = 1e-16;
constexpr double ray_step = 1e-5;  ///< share of c* (orbit_cells.hpp); next to c* D is mostly rounding, so F is linear
/// Shares of the larger term of D. A |D| above `certainty` has a certain sign. If |D| is below `constant`, k counts as
/// constant. `rounding` is the error of the terms.
constexpr double certainty = 1e-9, constant = 1e-10, rounding = 1e-15;

}  // namespace

/// Polynomials through values at the Chebyshev points of [-1, 1], and their integrals from -1.
struct OrbitCells::Basis {
  using Values = Eigen::Array<double, nodes, 1>;

  Values z;
  Eigen::Matrix<double, nodes + 1, nodes> integral;   ///< from values to the coefficients of z^i of the integral
  Eigen::Matrix<double, nodes, nodes + 1> values;     ///< from coefficients of z^i to values
  Eigen::Matrix<double, 2, nodes> last_coefficients;  ///< from values to the last two Chebyshev coefficients

  Basis() {
    for (int j = 0; j < nodes; ++j) {
      const double angle = std::numbers::pi * (j + 0.5) / nodes;
      z[j] = std::cos(angle);
      for (int i = 0; i <= nodes; ++i) values(j, i) = std::pow(z[j], i);
      for (int i : {0, 1}) last_coefficients(i, j) = 2.0 / nodes * std::cos((nodes - 2 + i) * angle);
    }
    integral.setZero();
    integral.bottomRows<nodes>() = values.leftCols<nodes>().inverse();
    for (int i = nodes; i > 0; --i) {
      integral.row(i) /= i;
      integral.row(0) += (i % 2 == 0 ? -1 : 1) * integral.row(i);
    }
  }

  /// Returns the estimated error of the polynomial through these values: its last two Chebyshev coefficients.
  double error(const Values& of) const { return (last_coefficients * of.matrix()).cwiseAbs().sum(); }

  static const Basis& only() {
    static const Basis basis;
    return basis;
  }
};

OrbitCells::OrbitCells(const reduction::Law& law, double mu, reduction::Inertia inertia, Kind kind,
                       reduction::State start, double drive, double accuracy)
    : law_(law),
      mu_(mu),
      inertia_(inertia),
      kind_(kind),
      start_(start),
      drive_(drive),
      accuracy_(accuracy),
      width_(first_width) {
  const auto [u, v] = start;
  if (v == 0 && u == 0) return;
  if (mu * u < near_axis * v) {
    start_.u = near_axis * v / mu;
    u_share_ = u / start_.u;
  } else if (v < near_axis * mu * u && drive == 0) {
    start_.v = near_axis * mu * u;
    v_share_ = v / start_.v;
  }
  const double k = start_.v / (mu * start_.u), end = k_end(k);
  inverse_ = drive == 0 && k < end;
  end_ = inverse_ ? 1 / end : end;
  distance_ = (inverse_ ? 1 / k : k) - end_;
  now_[ln_u] = std::log(start_.u);
  for (const int side : {-1, 1}) {
    const double distance = side * ray_step * end_, c = end_ + distance;
    if (end_ > 0) near_[side > 0] = F(distance, forces(inverse_ ? 1 / c : c).D);
  }
  for (double kink : law.kinks()) {
    const double left = ((inverse_ ? 1 / kink : kink) - end_) / distance_;
    if (left > 0 && left < 1) kinks_.push_back(-std::log(left));
  }
  std::ranges::sort(kinks_, std::ranges::greater());
  reach(0);
}

double OrbitCells::greatest_drive(const reduction::Law& law, double mu, reduction::Inertia inertia) {
  constexpr double far = 1e9, some = 0.9;
  const double moment = law(reduction::slip_of_ratio(far)).moment;
  return some * (1 - inertia.gamma * mu * mu / inertia.chi * far * moment);
}

OrbitCells::Forces OrbitCells::forces(double k) const {
  // At k < 0, which a start without slip may have if a ray lies next to the start, the force is reversed.
  const auto [size, moment] = law_(reduction::slip_of_ratio(std::abs(k)));
  const double B = inertia_.gamma * mu_ * mu_ * moment;
  return {inertia_.chi * (std::copysign(size, k) - drive_) - B * k, B};
}

double OrbitCells::k_end(double k) const {
  if (kind_ == Kind::flat)
    return reduction::terminal_ratios(law_, inertia_.gamma * mu_ * mu_ / inertia_.chi).end_of(k).k;
  if (drive_ == 0) return 0;
  // This search finds one ray, and is faster than a search for all rays.
  const auto rises = [&](double ln_k) { return forces(std::exp(ln_k)).D; };
  const double low = std::log(drive_) - 5, high = 20, at_low = rises(low), at_high = rises(high);
  if (!(at_low < 0 && at_high > 0))
    throw std::domain_error("fit: under that rolling friction sliding does not end: a smaller one is required");
  return std::exp(reduction::root_between(rises, low, high, at_low, at_high));
}

double OrbitCells::F(double distance, double D) const {
  const double c = end_ + distance;
  return inverse_ ? -D * c * (c / distance) : D / distance;
}

double OrbitCells::ratio(double s) const {
  const double c = end_ + distance_ * std::exp(-s);
  return inverse_ ? 1 / c : c;
}

OrbitCells::Powers OrbitCells::next_powers(double half_width, double& error) const {
  using Values = Basis::Values;
  const Basis& basis = Basis::only();
  Values k, falls, steps;
  double noise = 0;
  for (int j = 0; j < nodes; ++j) {
    constexpr double smallest = 1e-12;  // below this k, Phi/k and Psi do not change
    double distance = distance_ * std::exp(-(s_ + half_width * (1 + basis.z[j])));
    k[j] = inverse_ ? 1 / (end_ + distance) : end_ + distance;
    if (end_ == 0 && !inverse_) distance = std::max(distance, smallest);
    const auto [D, B] = forces(end_ == 0 && !inverse_ ? distance : k[j]);
    double fall = 0;
    if (const double z = distance / (ray_step * end_); std::abs(z) < 1) {
      const auto [below, above] = near_;
      fall = (below + above + z * (above - below)) / 2;
    } else {
      fall = F(distance, D);
      const double larger = std::abs(F(distance, B * k[j]));
      if (!(fall > -certainty * larger))
        throw std::domain_error("fit: the law has an invariant ray there: a smaller patch is required");
      fall = std::max(fall, constant * larger);
      noise = std::max(noise, rounding * larger / fall);
    }
    falls[j] = -half_width * B / fall;
    steps[j] = half_width * mu_ / fall;
  }
  Powers result;
  const auto add = [&](int which, const Values& slope) {
    result.row(which) = (basis.integral * slope.matrix()).transpose();
    result(which, 0) += now_[which];
  };
  add(ln_u, falls);
  const Values u = (basis.values * result.row(ln_u).matrix().transpose()).array().exp(), dT = steps * u;
  add(T_, dT);
  add(slid, dT * mu_ * k * u);
  add(turned, dT * u);
  // If a cell is far too wide, exp(ln u) underflows at its end.
  constexpr double steepest = 50;
  const double fall_of_ln_u = -falls.minCoeff(), share = std::min(1.0, 2 * half_width + fall_of_ln_u);
  error = std::max(basis.error(falls), basis.error(dT) / dT.maxCoeff() * share) / (accuracy_ + noise);
  if (fall_of_ln_u > steepest) error = infinity;
  return result;
}

void OrbitCells::reach(double T) {
  const auto moves = [&] {
    const double u = std::exp(now_[ln_u]);
    return u > at_rest * start_.u || ratio(s_) * mu_ * u > at_rest * std::max(start_.v, mu_ * start_.u);
  };
  if (start_.u == 0) return;
  while (now_[T_] <= T && moves()) {
    while (!kinks_.empty() && kinks_.back() < s_ + 1e-9) kinks_.pop_back();
    const double width = kinks_.empty() ? width_ : std::min(width_, kinks_.back() - s_);
    double error = 0;
    const Powers powers = next_powers(width / 2, error);
    width_ = std::clamp(0.8 * std::pow(std::max(error, 1e-30), -1.0 / nodes), 0.3, 4.0) * width;
    if (error > 1 && width > min_width) continue;
    now_ = powers.rowwise().sum();
    cells_.push_back({s_, width / 2, now_[T_], powers});
    s_ += width;
  }
}

Speeds OrbitCells::speeds_at(double T) const {
  if (cells_.empty()) return {};
  const auto found = std::ranges::lower_bound(cells_, T, {}, &Cell::T_end);
  if (found == cells_.end()) return {0, 0, v_share_ * now_[slid], u_share_ * now_[turned]};
  const auto& [s, half_width, T_end, powers] = *found;
  // Newton's method for z, starting at the last result.
  const auto number = static_cast<std::size_t>(found - cells_.begin());
  double z = number == last_cell_ ? last_z_ : -1;
  for (int i = 0; i < 50; ++i) {
    double value = 0, slope = 0;
    for (int n = nodes; n >= 0; --n) {
      slope = slope * z + value;
      value = value * z + powers(T_, n);
    }
    const double last = z;
    z = std::clamp(z - (value - T) / slope, -1.0, 1.0);
    if (std::abs(z - last) < 1e-6) break;  // the error of the next z would be about the square of this step
  }
  last_cell_ = number;
  last_z_ = z;
  Integrals at = powers.col(nodes);
  for (int n = nodes - 1; n >= 0; --n) at = at * z + powers.col(n);
  const double u = std::exp(at[ln_u]);
  return {v_share_ * ratio(s + half_width * (1 + z)) * mu_ * u, u_share_ * u, v_share_ * at[slid],
          u_share_ * at[turned]};
}

double OrbitCells::stop() const {
  if (start_.u == 0) return 0;
  // Next to the axis u = 0 the cells contain u of a neighbouring orbit, which begins at start_.
  if (u_share_ < 1) return start_.v / (inertia_.chi * (1 - drive_));
  return now_[T_] + mu_ * std::exp(now_[ln_u]) / forces(ratio(s_)).B;
}

}  // namespace contensou::fit
