#include "contensou/reduction/laws.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <boost/math/special_functions/gamma.hpp>

#include "numerics/gauss_function.hpp"

namespace contensou::reduction {

namespace {

/// Returns C = sqrt(pi) Gamma(p + 2)/(2 Gamma(p + 5/2)) = Psi(0).
Wide pivoting_moment_of(Wide p) {
  return std::sqrt(std::numbers::pi_v<Wide>) / 2 * boost::math::tgamma_delta_ratio(p + 2, Wide{0.5});
}

/// The smaller speed divided by the larger one, its square, and 1 - square, computed without this subtraction.
struct Ratio {
  double ratio;
  double square;
  double rest;
};

Ratio ratio(double smaller, double larger) {
  const double q = smaller / larger;
  return {q, q * q, (larger - smaller) / larger * (1 + q)};
}

}  // namespace

struct PressureLaw::Series {
  explicit Series(Wide p)
      : inner_force(0.5, -p - 0.5, 2),
        inner_moment(0.5, -p - 1.5, 1),
        outer_force(-0.5, 0.5, p + 2),
        outer_moment(0.5, 0.5, p + 3),
        force_slope(static_cast<double>(pivoting_moment_of(p) * (p + 1.5))),
        pivoting_moment(static_cast<double>(pivoting_moment_of(p))),
        outer_scale(static_cast<double>(1 / (2 * (p + 2)))) {}

  GaussFunction inner_force;
  GaussFunction inner_moment;
  GaussFunction outer_force;
  GaussFunction outer_moment;
  double force_slope;
  double pivoting_moment;
  double outer_scale;
};

PressureLaw::PressureLaw(double p, std::string name)
    : p_(p), name_(std::move(name)), series_(std::make_shared<const Series>(p)) {}

PressureLaw::PressureLaw(double p)
    : PressureLaw(p > -1 && p <= max_p ? p
                                       : throw std::domain_error(fmt::format(
                                             "PressureLaw: the exponent p must be > -1 and <= {}, got {}", max_p, p)),
                  fmt::format("pressure:{}", p)) {}

PressureLaw PressureLaw::uniform() { return {0, "uniform"}; }
PressureLaw PressureLaw::punch() { return {-0.5, "punch"}; }
PressureLaw PressureLaw::ring() { return {-1, "ring"}; }
PressureLaw PressureLaw::paraboloid() { return {1, "paraboloid"}; }

Resistance PressureLaw::operator()(Slip slip) const {
  require_slip("PressureLaw", slip);
  const Series& series = *series_;
  if (slip.sliding <= slip.pivoting) {
    const auto [k, square, rest] = ratio(slip.sliding, slip.pivoting);
    return {series.force_slope * k * series.inner_force(square, rest),
            series.pivoting_moment * series.inner_moment(square, rest)};
  }
  const auto [inverse_k, square, rest] = ratio(slip.pivoting, slip.sliding);
  return {series.outer_force(square, rest), series.outer_scale * inverse_k * series.outer_moment(square, rest)};
}

double PressureLaw::moment_deficit(Slip slip) const {
  if (slip.sliding > slip.pivoting) return 1 - (*this)(slip).moment / series_->pivoting_moment;
  require_slip("PressureLaw", slip);
  const auto [k, square, rest] = ratio(slip.sliding, slip.pivoting);
  return square * series_->inner_moment.deficit(square, rest);
}

double PressureLaw::force_deficit(Slip slip) const {
  if (slip.sliding <= slip.pivoting) return 1 - (*this)(slip).force;
  require_slip("PressureLaw", slip);
  const auto [inverse_k, square, rest] = ratio(slip.pivoting, slip.sliding);
  return square * series_->outer_force.deficit(square, rest);
}

}  // namespace contensou::reduction
