#include "fit/scaled_orbit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <Eigen/LU>

#include "contensou/reduction/root.hpp"

namespace contensou::fit {

namespace {

constexpr double near_axis = 1e-12;  ///< of k or 1/k: from there on the smaller speed goes in proportion to its start
constexpr double at_rest = 1e-12;    ///< of w at the start
constexpr double first_width = 0.5, min_width = 1e-4;
constexpr double ray_step = 1e-3;  ///< of k*: nearer to the ray A - B is a line
constexpr double on_ray = 1e-14;

}  // namespace

Speeds operator+(const Speeds& a, const Speeds& b) {
  return {a.v + b.v, a.u + b.u, a.slid + b.slid, a.turned + b.turned, a.centre + b.centre, a.way + b.way};
}

Speeds operator*(double c, const Speeds& a) {
  return {c * a.v, c * a.u, c * a.slid, c * a.turned, c * a.centre, c * a.way};
}

/// Polynomials through values at Chebyshev's points of [-1, 1].
struct ScaledOrbit::Basis {
  using Values = Eigen::Array<double, nodes, 1>;
  using Powers = Eigen::Array<double, nodes + 1, 1>;

  Values z;
  Eigen::Matrix<double, nodes, nodes> powers_of_values;
  Eigen::Matrix<double, 2, nodes> last_coefficients;  ///< of the Chebyshev series
  Eigen::Matrix<double, nodes, nodes + 1> values_of_powers;

  Basis() {
    for (int j = 0; j < nodes; ++j) {
      const double angle = std::numbers::pi * (j + 0.5) / nodes;
      z[j] = std::cos(angle);
      for (int i = 0; i <= nodes; ++i) values_of_powers(j, i) = std::pow(z[j], i);
      for (int i : {0, 1}) last_coefficients(i, j) = 2.0 / nodes * std::cos((nodes - 2 + i) * angle);
    }
    powers_of_values = values_of_powers.leftCols<nodes>().inverse();
  }

  /// The integral from -1.
  Powers integral(const Values& values, double at_left) const {
    const Eigen::Array<double, nodes, 1> powers = powers_of_values.lazyProduct(values.matrix());
    Powers result;
    result[0] = 0;
    for (int i = 0; i < nodes; ++i) result[i + 1] = powers[i] / (i + 1);
    double there = 0;
    for (int i = nodes; i >= 0; --i) there = result[i] - there;
    result[0] = at_left - there;
    return result;
  }

  Values at_nodes(const Powers& powers) const { return values_of_powers.lazyProduct(powers.matrix()); }

  /// What a polynomial leaves of its values.
  double error(const Values& values) const { return (last_coefficients * values.matrix()).cwiseAbs().sum(); }

  static const Basis& only() {
    static const Basis basis;
    return basis;
  }
};

ScaledOrbit::Integrals ScaledOrbit::Cell::at(double z) const {
  Integrals result = powers.col(nodes);
  for (int i = nodes - 1; i >= 0; --i) result = result * z + powers.col(i);
  return result;
}

ScaledOrbit::ScaledOrbit(const reduction::Law& law, double mu, reduction::State start, double accuracy,
                         reduction::Inertia inertia, double drive)
    : law_(law),
      mu_(mu),
      accuracy_(accuracy),
      inertia_(inertia),
      drive_(drive),
      width_(first_width),
      v0_(start.v),
      u0_(start.u) {
  double v = std::abs(v0_), w = mu * std::abs(u0_);
  if (v == 0 && w == 0) return;
  if (drive_ > 0) find_ray();
  by_[0] = {.x = -1, .ln_w = 1, .ln_mu = 1};
  by_[1] = {.x = 1, .ln_w = 0, .ln_mu = 0};
  by_[2] = {.x = -1, .ln_w = 1, .ln_mu = 0};
  if (w < near_axis * v) {  // w follows v
    w = near_axis * v;
    by_[0] = {.x = 0, .ln_w = 0, .ln_mu = 1};
    by_[1] = {.x = 0, .ln_w = 1, .ln_mu = 0};
    by_[2] = {};
  } else if (v < near_axis * w && ray_ == 0) {  // v follows w
    v = near_axis * w;
    by_[0].x = by_[1].x = by_[2].x = 0;
  }
  orbit_v0_ = v;
  orbit_w0_ = w;
  const double k0 = v / w;
  side_ = k0 < ray_ ? -1 : 1;
  x_ = x0_ = std::log(std::max(std::abs(k0 - ray_), on_ray * ray_));
  now_[ln_w] = ln_w0_ = std::log(w);
  const auto [fall, B] = rates(x0_);
  q0_ = B / fall;
  dT0_ = -w / fall;
  for (double k : law.kinks()) {
    if (side_ * (k - ray_) > 0) kinks_.push_back(std::log(std::abs(k - ray_)));
  }
  std::ranges::sort(kinks_);
  reach(0);
}

double ScaledOrbit::greatest_drive(const reduction::Law& law, double mu, reduction::Inertia inertia) {
  constexpr double far = 1e9, some = 0.9;
  const double moment = law(reduction::slip_of_ratio(far)).moment;
  return some * (1 - inertia.gamma * mu * mu / inertia.chi * far * moment);
}

double ScaledOrbit::fall_towards_ray(double distance) const {
  const double k = ray_ + distance;
  const auto [force, moment] = law_(reduction::slip_of_ratio(k));
  return (inertia_.chi * (force - drive_) - inertia_.gamma * mu_ * mu_ * moment * k) / distance;
}

void ScaledOrbit::find_ray() {
  const auto rises = [&](double ln_k) {
    const double k = std::exp(ln_k);
    const auto [force, moment] = law_(reduction::slip_of_ratio(k));
    return inertia_.chi * (force - drive_) - inertia_.gamma * mu_ * mu_ * moment * k;
  };
  const double low = std::log(drive_) - 5, high = 20;
  if (!(rises(low) < 0 && rises(high) > 0))
    throw std::domain_error("fit: under that rolling friction sliding does not end: a smaller one is required");
  ray_ = std::exp(reduction::root_between(rises, low, high));
  near_ray_ = {fall_towards_ray(-ray_step * ray_), fall_towards_ray(ray_step * ray_)};
}

ScaledOrbit::Rates ScaledOrbit::rates(double x) const {
  if (ray_ > 0) {
    const double distance = side_ * std::exp(x), z = distance / (ray_step * ray_);
    const double B = inertia_.gamma * mu_ * mu_ * law_(reduction::slip_of_ratio(ray_ + distance)).moment;
    if (std::abs(z) >= 1) return {fall_towards_ray(distance), B};
    const auto [below, above] = near_ray_;
    return {(below + above + z * (above - below)) / 2, B};
  }
  constexpr double smallest = 1e-12;  // below it Phi/k and Psi do not change
  const double k = std::max(std::exp(x), smallest);
  const auto [force, moment] = law_(reduction::slip_of_ratio(k));
  const double A = inertia_.chi * force / k, B = inertia_.gamma * mu_ * mu_ * moment;
  if (!(A > B)) throw std::domain_error("fit: the law has an invariant ray there: a smaller patch is required");
  return {A - B, B};
}

void ScaledOrbit::reach(double T) {
  if (v0_ == 0 && u0_ == 0) return;
  const Basis& basis = Basis::only();
  while (now_[T_] <= T && now_[ln_w] > ln_w0_ + std::log(at_rest)) {
    while (!kinks_.empty() && kinks_.back() > x_ - 1e-9) kinks_.pop_back();
    const double whole = kinks_.empty() ? width_ : std::min(width_, x_ - kinks_.back());
    Cell cell{};
    cell.x = x_;
    cell.half_width = whole / 2;
    Basis::Values q, step;
    for (int j = 0; j < nodes; ++j) {
      const auto [fall, B] = rates(x_ - cell.half_width * (1 + basis.z[j]));
      q[j] = B / fall;
      step[j] = 1 / fall;
    }
    const auto add = [&](int which, const Basis::Values& slope) -> Basis::Values {
      const Basis::Powers powers = basis.integral(slope, now_[which]);
      cell.powers.row(which) = powers.transpose();
      return basis.at_nodes(powers);
    };
    const Basis::Values w = add(ln_w, -cell.half_width * q).exp();
    const Basis::Values dT = cell.half_width * step * w;
    const double error = std::max(basis.error(cell.half_width * q), basis.error(dT) / dT.maxCoeff()) / accuracy_;
    const double factor = std::clamp(0.8 * std::pow(std::max(error, 1e-30), -1.0 / nodes), 0.3, 4.0);
    if (error > 1 && whole > min_width) {
      width_ = factor * whole;
      continue;
    }
    const Basis::Values by = add(E, -cell.half_width * 2 * q * (1 + q));
    const Basis::Values v = w * (ray_ + side_ * (x_ - cell.half_width * (1 + basis.z)).exp());
    add(T_, dT);
    add(G, dT * (by + 2 * q));
    add(slid, dT * v);
    add(slid_by, dT * v * 2 * (by + q));
    add(turned, dT * w);
    add(turned_by, dT * w * 2 * (by + q));
    cell.T_left = now_[T_];
    now_ = cell.at(1);
    cell.T_end = now_[T_];
    // dT/dz at an end is that of x there.
    const auto bend = [&](double at_x, double ln_w_there) {
      return (cell.T_end - cell.T_left) * rates(at_x).fall * std::exp(-ln_w_there) / cell.half_width - 2;
    };
    cell.bend_left = bend(x_, cell.at(-1)[ln_w]);
    cell.bend_end = bend(x_ - whole, now_[ln_w]);
    cells_.push_back(cell);
    x_ -= whole;
    width_ = factor * whole;
  }
}

ScaledOrbit::Stop ScaledOrbit::stop() const {
  if (u0_ == 0)
    return {std::abs(v0_) / (inertia_.chi * (1 - drive_)), 0, (v0_ < 0 ? -1 : 1) / inertia_.chi,
            0};  // what is left of w is not its own
  const auto change = [&](const Direction& by) { return change_of_T(by, now_); };
  return {now_[T_] + std::exp(now_[ln_w]) / rates(x_).B, change(by_[0]), v0_ == 0 ? 0 : change(by_[1]) / v0_,
          change(by_[2]) / u0_};
}

double ScaledOrbit::change_of_T(const Direction& by, const Integrals& here) const {
  return -dT0_ * by.x + (by.ln_w - q0_ * by.x) * here[T_] + by.ln_mu * here[G];
}

ScaledOrbit::Place ScaledOrbit::place_of(double T, std::size_t& cell) const {
  if (cell > 0 && T < cells_[cell - 1].T_end) cell = 0;
  while (cell + 1 < cells_.size() && T > cells_[cell].T_end) ++cell;
  const Cell& found = cells_[cell];
  const bool moves = T <= found.T_end;
  double z = 1;
  if (moves) {
    // Newton's method, from the cubic through the ends.
    const double s = (T - found.T_left) / (found.T_end - found.T_left);
    z = -1 + s * (2 + (1 - s) * ((1 - s) * found.bend_left - s * found.bend_end));
    for (int i = 0; i < 50; ++i) {
      double value = 0, slope = 0;
      for (int n = nodes; n >= 0; --n) {
        slope = slope * z + value;
        value = value * z + found.powers(T_, n);
      }
      const double last = z;
      z = std::clamp(z - (value - T) / slope, -1.0, 1.0);
      if (std::abs(z - last) < 1e-6) break;  // the error now is of its square
    }
  }
  const double x = found.x - found.half_width * (1 + z);
  const Integrals here = found.at(z);
  const double w = moves ? std::exp(here[ln_w] - ln_w0_) : 0;
  return {&found, z, moves, here, {w * std::exp(x - x0_), w, here[slid] / orbit_v0_, here[turned] / orbit_w0_}};
}

Speeds ScaledOrbit::now(const Place& place) const {
  const Speeds& unit = place.unit;
  if (ray_ > 0) {
    const double x = place.cell->x - place.cell->half_width * (1 + place.z);
    const double v = place.moves ? std::exp(place.here[ln_w]) * ratio(x) : 0;
    return {v, u0_ * unit.u, place.here[slid], u0_ * unit.turned};
  }
  return {v0_ * unit.v, u0_ * unit.u, v0_ * unit.slid, u0_ * unit.turned};
}

Speeds ScaledOrbit::speeds_at(double T, std::size_t& cell) const {
  return cells_.empty() ? Speeds{} : now(place_of(T, cell));
}

ScaledOrbit::Moment ScaledOrbit::at(double T, std::size_t& cell) const {
  Moment result{};
  if (cells_.empty()) {  // at rest
    if (T == 0) result.by_v.v = result.by_u.u = 1;
    return result;
  }
  const Place place = place_of(T, cell);
  const Integrals& here = place.here;
  const Speeds& unit = place.unit;
  const Cell& in = *place.cell;
  const double z = place.z;
  Eigen::Array2d slopes = Eigen::Array2d::Zero();
  for (int n = nodes; n > 0; --n) slopes = slopes * z + n * in.powers.col(n).head<2>();
  const double dT = -slopes[T_] / in.half_width, q = -slopes[ln_w] / in.half_width;
  result.now = now(place);
  if (place.moves) {
    result.dv = result.now.v * (1 + q) / dT;
    result.du = result.now.u * q / dT;
  }

  // How all four, over what they are of 1 m/s at the start, change with a number at this T; at rest the integrals do.
  const auto change = [&](double factor, const Direction& by) -> Speeds {
    if (factor == 0) return {};
    const double of_ln_w = by.ln_w - q0_ * by.x;
    const double of_x = place.moves ? -change_of_T(by, here) / dT : 0;
    const double of_ratio = of_ln_w + by.ln_mu * here[E] + q * of_x - by.ln_w;
    const double of_slid = -dT0_ * by.x + (2 * of_ln_w - by.x - by.ln_w) * unit.slid +
                           by.ln_mu * here[slid_by] / orbit_v0_ + unit.v * dT * of_x;
    const double of_turned = -dT0_ * by.x + (2 * of_ln_w - by.ln_w) * unit.turned +
                             by.ln_mu * here[turned_by] / orbit_w0_ + unit.u * dT * of_x;
    const double v = factor * v0_, u = factor * u0_;
    return {v * unit.v * (of_x + of_ratio - by.x), u * unit.u * of_ratio, v * of_slid, u * of_turned};
  };
  result.by_ln_mu = change(1, by_[0]);
  result.by_v = change(v0_ == 0 ? 0 : 1 / v0_, by_[1]) + Speeds{unit.v, 0, unit.slid, 0};
  result.by_u = change(u0_ == 0 ? 0 : 1 / u0_, by_[2]) + Speeds{0, unit.u, 0, unit.turned};
  return result;
}

}  // namespace contensou::fit
