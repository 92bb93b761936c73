// Notation: s = rho^2, s_i the rows, g_i the slope of the pressure in s before row i.
//   pressure = p_n + sum of c_i (1 - s/s_i) over the rows with s < s_i,  c_i = s_i (g_(i+1) - g_i),  g_(n+1) = 0
// A paraboloid of radius a carries the load c a^2/2 (per pi); its rim speed of pivoting is a times that of the patch.
#include "contensou/reduction/profile_law.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <Eigen/LU>

#include "contensou/reduction/pressure_law.hpp"
#include "numerics/gauss_function.hpp"

namespace contensou::reduction {

namespace {

/// Functions of y in [0, 1], smooth but for y = 0, side by side in one table of polynomials.
///
/// A panel is an eighth of an octave of y, so its half width is at most 1/17 of the way to y = 0; the last begins at
/// y = 0, where a singular part like y^3 ln y is below the last bit.
template <int functions>
class FunctionTable {
 public:
  using Values = std::array<double, functions>;

  template <class Function>
  explicit FunctionTable(Function function) : panels_(panels) {
    using Matrix = Eigen::Matrix<double, terms, terms>;
    using Rows = Eigen::Matrix<double, terms, functions, functions == 1 ? Eigen::ColMajor : Eigen::RowMajor>;
    Eigen::Array<double, terms, 1> nodes;  // Chebyshev's
    for (int j = 0; j < terms; ++j) nodes[j] = std::cos(std::numbers::pi * (2 * j + 1) / (2 * terms));
    Matrix powers;
    for (int n = 0; n < terms; ++n) powers.col(n) = nodes.pow(terms - 1 - n);
    const Eigen::PartialPivLU<Matrix> solver(powers);
    for (int i = 0; i < panels; ++i) {
      const auto [left, right] = edges(i);
      Rows values;
      for (int j = 0; j < terms; ++j) {
        const Values at = function(left + (right - left) / 2 * (1 + nodes[j]));
        values.row(j) = Eigen::Map<const Eigen::Matrix<double, 1, functions>>(at.data());
      }
      const Rows coefficients = solver.solve(values);
      Eigen::Map<Rows>(panels_[static_cast<std::size_t>(i)].front().data()) = coefficients;
    }
  }

  Values operator()(double y) const {
    // The exponent and the first bits of the mantissa count the panels, the others go from -1 to 1 across each.
    constexpr int fraction_bits = 52;
    constexpr std::uint64_t fraction = (std::uint64_t{1} << fraction_bits) - 1;
    constexpr auto first = std::bit_cast<std::uint64_t>(lowest) >> (fraction_bits - cut_bits);
    const auto bits = std::bit_cast<std::uint64_t>(y);
    if (y < lowest) return polynomial(0, 2 / lowest * y - 1);
    if (y >= 1) return polynomial(panels - 1, 1);
    const double rest = std::bit_cast<double>((bits << cut_bits & fraction) | std::bit_cast<std::uint64_t>(1.0));
    return polynomial((bits >> (fraction_bits - cut_bits)) - first + 1, 2 * rest - 3);
  }

 private:
  static constexpr int terms = 12;
  static constexpr double lowest = 0x1p-18;
  static constexpr int cut_bits = 3;
  static constexpr int cuts = 1 << cut_bits;
  static constexpr int panels = 18 * cuts + 1;

  /// Edges of panel i; panel 0 is (0, lowest).
  static std::pair<double, double> edges(int i) {
    if (i == 0) return {0, lowest};
    const double octave = std::ldexp(lowest, (i - 1) / cuts);
    const double left = 1 + (i - 1) % cuts / double{cuts};
    return {octave * left, octave * (left + 1.0 / cuts)};
  }

  Values polynomial(std::size_t panel, double t) const {
    Values sum{};
    for (const Values& coefficient : panels_[panel]) {
      for (std::size_t f = 0; f < functions; ++f) sum[f] = sum[f] * t + coefficient[f];
    }
    return sum;
  }

  std::vector<std::array<Values, terms>> panels_;  ///< powers of (distance from the centre)/(half width), highest first
};

/// The law of p = 1 (pressure_law.hpp) for sums of many: functions of 1 - k^2 or 1 - k^-2.
struct Paraboloid {
  static constexpr double pivoting_moment = 8.0 / 15;
  static constexpr double force_slope = 4.0 / 3;
  static constexpr double outer_scale = 1.0 / 6;

  FunctionTable<2> inner;          ///< Phi/(Phi'(0) k), Psi/Psi(0)
  FunctionTable<1> inner_deficit;  ///< (1 - Psi/Psi(0))/k^2
  FunctionTable<2> outer;          ///< Phi, 6 k Psi

  static const Paraboloid& law() {
    static const GaussFunction inner_force(0.5L, -1.5L, 2), inner_moment(0.5L, -2.5L, 1);
    static const GaussFunction outer_force(-0.5L, 0.5L, 3), outer_moment(0.5L, 0.5L, 4);
    static const Paraboloid instance{
        FunctionTable<2>([](double y) {
          return std::array{inner_force(1 - y, y), inner_moment(1 - y, y)};
        }),
        FunctionTable<1>([](double y) { return std::array{inner_moment.deficit(1 - y, y)}; }),
        FunctionTable<2>([](double y) {
          return std::array{outer_force(1 - y, y), outer_moment(1 - y, y)};
        })};
    return instance;
  }
};

/// 1 - q^2.
double rest(double q) { return (1 - q) * (1 + q); }

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
    add(rho[i], square * (slope(i + 1) - slope(i)) * square / 2, Paraboloid::pivoting_moment);
  }
  add(1, relative[last], uniform()({0, 1}).moment);
  discs_ = std::make_shared<const std::vector<Disc>>(std::move(discs));
}

Resistance ProfileLaw::operator()(Slip slip) const {
  require_slip("ProfileLaw", slip);
  const Paraboloid& paraboloid = Paraboloid::law();
  Resistance sum{0, 0};
  for (const Disc& disc : std::span(*discs_).first(discs_->size() - 1)) {
    const double pivoting = slip.pivoting * disc.radius;
    if (slip.sliding <= pivoting) {
      const double k = slip.sliding / pivoting;
      const auto [force, moment] = paraboloid.inner(rest(k));
      sum.force += disc.load * (Paraboloid::force_slope * k * force);
      sum.moment += disc.moment * moment;
    } else {
      const double inverse_k = pivoting / slip.sliding;
      const auto [force, moment] = paraboloid.outer(rest(inverse_k));
      sum.force += disc.load * force;
      sum.moment += disc.load * disc.radius * (Paraboloid::outer_scale * inverse_k * moment);
    }
  }
  if (const Disc& rim = discs_->back(); rim.load > 0) {
    const Resistance part = uniform()(slip);
    sum.force += rim.load * part.force;
    sum.moment += rim.load * part.moment;
  }
  return {std::min(sum.force / load_, 1.0), sum.moment / load_};
}

double ProfileLaw::moment_deficit(Slip slip) const {
  require_slip("ProfileLaw", slip);
  const Paraboloid& paraboloid = Paraboloid::law();
  double sum = 0;
  for (const Disc& disc : std::span(*discs_).first(discs_->size() - 1)) {
    const double pivoting = slip.pivoting * disc.radius;
    if (slip.sliding <= pivoting) {
      const double k = slip.sliding / pivoting;
      sum += disc.moment * (k * k * paraboloid.inner_deficit(rest(k))[0]);
    } else {
      const double inverse_k = pivoting / slip.sliding;
      const double moment = Paraboloid::outer_scale * inverse_k * paraboloid.outer(rest(inverse_k))[1];
      sum += disc.moment * (1 - moment / Paraboloid::pivoting_moment);
    }
  }
  const Disc& rim = discs_->back();
  if (rim.load > 0) sum += rim.moment * uniform().moment_deficit(slip);
  return sum / pivoting_moment_;
}

}  // namespace contensou::reduction
