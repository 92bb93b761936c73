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
constexpr double ray_step = 1e-3;                    ///< of k*: nearer to the ray A - B is a line
constexpr double on_ray = 1e-14, beside_ray = 1e-4;  ///< of k*
constexpr double step_of_ln_mu = 1e-4, step_of_drive = 1e-3;

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
                         reduction::Inertia inertia, std::optional<double> drive)
    : law_(law),
      accuracy_(accuracy),
      inertia_(inertia),
      here_{.mu = mu, .drive = drive.value_or(0)},
      width_(first_width),
      v0_(start.v),
      u0_(start.u) {
  double v = std::abs(v0_), w = mu * std::abs(u0_);
  if (v == 0 && w == 0) return;
  here_ = ray_of(here_.mu, here_.drive);
  if (drive) {
    beside_.push_back(beside(-step_of_ln_mu, step_of_ln_mu, false));
    const double h = step_of_drive;
    const bool low = here_.drive<h, high = here_.drive + h> greatest_drive(law, mu, inertia);
    beside_.push_back(beside(low ? h : -h, low ? 2 * h : high ? -2 * h : h, true));
  }
  by_[0] = {.x = -1, .ln_w = 1, .ln_mu = 1};
  by_[1] = {.x = 1, .ln_w = 0, .ln_mu = 0};
  by_[2] = {.x = -1, .ln_w = 1, .ln_mu = 0};
  if (w < near_axis * v) {  // w follows v
    w = near_axis * v;
    w_follows_ = true;
    by_[0] = {.x = 0, .ln_w = 0, .ln_mu = 1};
    by_[1] = {.x = 0, .ln_w = 1, .ln_mu = 0};
    by_[2] = {};
  } else if (v < near_axis * w && here_.k == 0) {  // v follows w
    v = near_axis * w;
    by_[0].x = by_[1].x = by_[2].x = 0;
  }
  orbit_v0_ = v;
  orbit_w0_ = w;
  const double k0 = v / w;
  side_ = k0 < here_.k ? -1 : 1;
  x_ = x0_ = std::log(std::max(std::abs(k0 - here_.k), on_ray * here_.k));
  now_[ln_w] = ln_w0_ = std::log(w);
  const auto [fall, B] = rates(x0_);
  q0_ = B / fall;
  dT0_ = -w / fall;
  for (double k : law.kinks()) {
    if (side_ * (k - here_.k) > 0) kinks_.push_back(std::log(std::abs(k - here_.k)));
  }
  std::ranges::sort(kinks_);
  reach(0);
}

double ScaledOrbit::greatest_drive(const reduction::Law& law, double mu, reduction::Inertia inertia) {
  constexpr double far = 1e9, some = 0.9;
  const double moment = law(reduction::slip_of_ratio(far)).moment;
  return some * (1 - inertia.gamma * mu * mu / inertia.chi * far * moment);
}

double ScaledOrbit::fall_towards(const Ray& ray, double distance) const {
  // A start without slip may lie beside a ray that is nearer than k = 0: beyond it the force is the opposite.
  const double k = ray.k + distance;
  const auto [size, moment] = law_(reduction::slip_of_ratio(std::abs(k)));
  const double force = std::copysign(size, k);
  return (inertia_.chi * (force - ray.drive) - inertia_.gamma * ray.mu * ray.mu * moment * k) / distance;
}

ScaledOrbit::Ray ScaledOrbit::ray_of(double mu, double drive) const {
  Ray ray{.mu = mu, .drive = drive};
  if (drive == 0) return ray;
  const auto rises = [&](double ln_k) { return fall_towards(ray, std::exp(ln_k)); };
  const double low = std::log(drive) - 5, high = 20;
  if (!(rises(low) < 0 && rises(high) > 0))
    throw std::domain_error("fit: under that rolling friction sliding does not end: a smaller one is required");
  ray.k = std::exp(reduction::root_between(rises, low, high));
  ray.fall_near = {fall_towards(ray, -ray_step * ray.k), fall_towards(ray, ray_step * ray.k)};
  return ray;
}

/// Derivative of the parabola through the values here and at two steps.
ScaledOrbit::Beside ScaledOrbit::beside(double first, double second, bool by_drive) const {
  const auto ray = [&](double step) {
    return by_drive ? ray_of(here_.mu, here_.drive + step) : ray_of(here_.mu * std::exp(step), here_.drive);
  };
  Beside result{.first = ray(first),
                .second = ray(second),
                .of_here = -(first + second) / (first * second),
                .of_first = second / (first * (second - first)),
                .of_second = -first / (second * (second - first))};
  result.k = result.of(here_.k, result.first.k, result.second.k);
  return result;
}

ScaledOrbit::Rates ScaledOrbit::rates(const Ray& ray, double x) const {
  const double per_moment = inertia_.gamma * ray.mu * ray.mu;
  if (ray.k > 0) {
    const double distance = side_ * std::exp(x), z = distance / (ray_step * ray.k);
    const double B = per_moment * law_(reduction::slip_of_ratio(std::abs(ray.k + distance))).moment;
    if (std::abs(z) >= 1) return {fall_towards(ray, distance), B};
    const auto [below, above] = ray.fall_near;
    return {(below + above + z * (above - below)) / 2, B};
  }
  constexpr double smallest = 1e-12;  // below it Phi/k and Psi do not change
  const double k = std::max(std::exp(x), smallest);
  const auto [force, moment] = law_(reduction::slip_of_ratio(k));
  const double A = inertia_.chi * force / k, B = per_moment * moment;
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
    const Basis::Values k = here_.k + side_ * (x_ - cell.half_width * (1 + basis.z)).exp(), v = k * w;
    add(T_, dT);
    add(slid, dT * v);
    add(turned, dT * w);
    // By a number: q, ln F and k*.
    const auto add_by = [&](const auto& add_to, const Basis::Values& q_by, const Basis::Values& ln_F_by, double k_by) {
      const Basis::Values by = add_to(0, -cell.half_width * q_by);
      add_to(1, dT * (by - ln_F_by));
      add_to(2, dT * v * (2 * by - ln_F_by + k_by / k));
      add_to(3, dT * w * (2 * by - ln_F_by));
    };
    const auto add_by_ln_mu = [&](int which, const Basis::Values& slope) {
      constexpr int places[]{E, G, slid_by, turned_by};
      return add(places[which], slope);
    };
    if (beside_.empty()) add_by(add_by_ln_mu, 2 * q * (1 + q), -2 * q, 0);
    for (const Beside& each : beside_) {
      Basis::Values q_by, ln_F_by;
      for (int j = 0; j < nodes; ++j) {
        const double x = x_ - cell.half_width * (1 + basis.z[j]);
        const Rates first = rates(each.first, x), second = rates(each.second, x);
        q_by[j] = each.of(q[j], first.B / first.fall, second.B / second.fall);
        ln_F_by[j] = each.of(-std::log(step[j]), std::log(first.fall), std::log(second.fall));
      }
      if (&each == &beside_.front()) {
        add_by(add_by_ln_mu, q_by, ln_F_by, each.k);
        continue;
      }
      auto& powers_by = by_drive_.emplace_back();
      const auto add_by_drive = [&](int which, const Basis::Values& slope) -> Basis::Values {
        const Basis::Powers powers = basis.integral(slope, now_by_drive_[which]);
        powers_by.row(which) = powers.transpose();
        return basis.at_nodes(powers);
      };
      add_by(add_by_drive, q_by, ln_F_by, each.k);
      now_by_drive_ = powers_by.rowwise().sum();
    }
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
  if (u0_ == 0) {  // what is left of w is not its own
    const double T = std::abs(v0_) / (inertia_.chi * (1 - here_.drive));
    return {.T = T,
            .by_ln_mu = 0,
            .by_v = (v0_ < 0 ? -1 : 1) / (inertia_.chi * (1 - here_.drive)),
            .by_u = 0,
            .by_drive = beside_.empty() ? 0 : T / (1 - here_.drive)};
  }
  const double T = now_[T_] + std::exp(now_[ln_w]) / rates(x_).B;
  if (!beside_.empty()) {
    const auto by = [&](std::size_t which) { return moved(shift_by(which, now_, now_by_drive_), now_).T; };
    return {.T = T, .by_ln_mu = by(by_ln_mu), .by_v = by(by_v), .by_u = by(by_u), .by_drive = by(by_rho)};
  }
  const auto change = [&](const Direction& by) { return change_of_T(by, now_); };
  return {T, change(by_[0]), v0_ == 0 ? 0 : change(by_[1]) / v0_, change(by_[2]) / u0_};
}

ScaledOrbit::Shift ScaledOrbit::shift_by(std::size_t which, const Integrals& here,
                                         const Eigen::Array4d& by_drive) const {
  const double k0 = orbit_v0_ / orbit_w0_;
  switch (which) {
    case by_ln_mu:
      return {.k = w_follows_ ? 0 : -k0,
              .ln_w = w_follows_ ? 0.0 : 1.0,
              .ray = beside_[0].k,
              .E = here[E],
              .T = here[G],
              .slid = here[slid_by],
              .turned = here[turned_by]};
    case by_v:
      return {.k = w_follows_ ? 0 : 1 / orbit_w0_, .ln_w = w_follows_ ? 1 / orbit_v0_ : 0};
    case by_u:
      return {.k = w_follows_ ? 0 : -k0 / u0_, .ln_w = w_follows_ ? 0 : 1 / u0_};
    default:
      return {.k = 0,
              .ln_w = 0,
              .ray = beside_[1].k,
              .E = by_drive[0],
              .T = by_drive[1],
              .slid = by_drive[2],
              .turned = by_drive[3]};
  }
}

ScaledOrbit::Moved ScaledOrbit::moved(const Shift& by, const Integrals& here) const {
  const double distance = std::exp(x0_);
  const double x = (by.k - by.ray) / (side_ * std::max(distance, beside_ray * here_.k));
  const double scale = by.ln_w - q0_ * x;
  return {x, scale, -dT0_ * x + scale * here[T_] + by.T};
}

FilmOrbit::Moment ScaledOrbit::driven(const Place& place, std::size_t cell) const {
  Moment result{};
  result.now = now(place);
  const Integrals& here = place.here;
  const double x = place.cell->x - place.cell->half_width * (1 + place.z), k = ratio(x);
  const double w = place.moves ? std::exp(here[ln_w]) : 0, v = k * w;
  const auto slope = slopes(place);
  const double dT = slope.T, q = slope.ln_w;
  Eigen::Array4d by_drive = Eigen::Array4d::Zero();
  for (int n = nodes; n >= 0; --n) by_drive = by_drive * place.z + by_drive_[cell].col(n);
  const auto change = [&](std::size_t which) -> Speeds {
    const Shift by = shift_by(which, here, by_drive);
    const Moved start = moved(by, here);
    const double of_x = place.moves ? -start.T / dT : 0;  // at one T
    const double of_ln_w = start.scale + by.E + q * of_x;
    const auto integral = [&](double first, double last, double whole, double own) {
      return -first * dT0_ * start.x + 2 * start.scale * whole + own - last * start.T;
    };
    return {v * of_ln_w + w * ((k - here_.k) * of_x + by.ray), result.now.u * (of_ln_w - by.ln_w),
            integral(orbit_v0_, v, here[slid], by.slid),
            u0_ / orbit_w0_ * (integral(orbit_w0_, w, here[turned], by.turned) - by.ln_w * here[turned])};
  };
  result.by_ln_mu = change(by_ln_mu);
  result.by_v = change(by_v);
  result.by_u = change(by_u) + Speeds{0, place.unit.u, 0, place.unit.turned};
  result.by_drive = change(by_rho);
  return result;
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

ScaledOrbit::Slopes ScaledOrbit::slopes(const Place& place) {
  Eigen::Array2d by_z = Eigen::Array2d::Zero();
  for (int n = nodes; n > 0; --n) by_z = by_z * place.z + n * place.cell->powers.col(n).head<2>();
  return {-by_z[T_] / place.cell->half_width, -by_z[ln_w] / place.cell->half_width};
}

Speeds ScaledOrbit::now(const Place& place) const {
  const Speeds& unit = place.unit;
  if (here_.k > 0) {
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
  if (!beside_.empty()) return driven(place, cell);
  const Integrals& here = place.here;
  const Speeds& unit = place.unit;
  const auto slope = slopes(place);
  const double dT = slope.T, q = slope.ln_w;
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
