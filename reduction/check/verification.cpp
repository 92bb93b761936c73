#include "contensou/reduction/verification.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <boost/math/quadrature/gauss_kronrod.hpp>

#include "check/hertz_inner_orbit.hpp"
#include "contensou/reduction/detail/stepped_motion.hpp"
#include "contensou/reduction/laws.hpp"
#include "system/balance.hpp"

namespace contensou::reduction {

namespace {

using std::numbers::pi;

double size(Rate rate) { return std::hypot(rate.u, rate.v); }

// Allowed errors: of rounding, of difference quotients (symmetry.hpp), and of steppers.
constexpr double rounding = 1e-13;
constexpr double difference_quotient = 1e-9;
constexpr double stepping = 1e-10;

double relative(double value, double reference) {
  return value == reference ? 0.0 : std::abs(value - reference) / std::abs(reference);
}

/// Returns the larger of two errors. NaN counts as the largest, so that it is never overwritten.
double worse(double a, double b) { return std::isnan(a) || a > b ? a : b; }

/// Returns the start in a unit of speed in which squares and sums do not overflow. The conversion is exact. A speed
/// below 1e-200 of the other speed has no effect and becomes 0; then the checks of an axis apply.
State normalised(State start) {
  constexpr double faint = 1e-200;
  const int exponent = std::ilogb(std::max(std::abs(start.u), start.v));
  const State scaled{std::ldexp(start.u, -exponent), std::ldexp(start.v, -exponent)};
  return {std::abs(scaled.u) < faint ? 0 : scaled.u, scaled.v < faint ? 0 : scaled.v};
}

/// Computes the checks of one start.
class Examination {
 public:
  Examination(const Flow& flow, const Flow& quadrature, State start)
      : system_(flow.system()),
        start_(normalised(start)),
        flow_(flow),
        quadrature_(quadrature),
        orbit_(flow.orbit(start_)) {}

  std::vector<Check> run() {
    const Motion regularised = integrate_regularised(system_, start_);
    const Motion direct = integrate_directly(system_, start_);
    routes(regularised, direct);
    symmetry();
    if (start_.u != 0 && start_.v != 0) {
      add("generator on dv/du", slope_symmetry_residual(system_, beside_the_kink()), difference_quotient);
      if (!on_a_ray(orbit_.start_log_ratio())) {
        separated_equation();
        first_integral(regularised, direct);
        times(regularised);
      }
    }
    limits();
    bounds();
    inner_orbit();
    return std::move(checks_);
  }

 private:
  void add(std::string name, double measured, double allowed) {
    checks_.push_back({std::move(name), measured, allowed});
  }

  void routes(const Motion& regularised, const Motion& direct) {
    const double best = orbit_.stop_time();
    if (!flow_.is_by_quadrature()) {
      const double by_quadrature = quadrature_.orbit(start_).stop_time();
      add("stop time: quadrature against closed form", relative(by_quadrature, best), rounding);
    }
    add("stop time: (2.7) and (2.8) in beta", relative(regularised.stop_time, best), stepping);
    add("stop time: (2.6) in tau", relative(direct.stop_time, best), stepping);
  }

  void symmetry() {
    add("generator on (2.6)", field_symmetry_residual(system_, start_), difference_quotient);
    add("generator on (2.7)", regularised_symmetry_residual(system_, start_), difference_quotient);

    // The factor is not a power of two, because for a power of two all digits would agree by construction.
    constexpr double factor = 1e3 / 7;
    const double scaled = integrate_directly(system_, {factor * start_.u, factor * start_.v}).stop_time;
    add("stop time of the scaled start, (2.6)", relative(scaled, factor * orbit_.stop_time()), stepping);
  }

  /// Returns the start, or a state beside a start at a kink: there the ring and the uniform disc have no derivatives.
  State beside_the_kink() const {
    const double k = start_.v / (system_.mu() * std::abs(start_.u));
    const bool beside =
        std::ranges::any_of(system_.law().kinks(), [&](double kink) { return std::abs(k - kink) < 1e-3 * kink; });
    return beside ? State{start_.u, 1.01 * start_.v} : start_;
  }

  void separated_equation() {
    // The change of p = ln v is tested over one unit of xi, from the start and around k = 1.
    double worst = 0;
    const TerminalChart& chart = orbit_.chart();
    for (double xi : {orbit_.start_coordinate(), std::min(orbit_.start_coordinate(), chart.coordinate(0) + 0.5)}) {
      if (on_a_ray(chart.log_ratio(xi - 1))) continue;  // k = 1 can lie on a ray or beyond a ray
      const auto [bottom, top] = std::minmax({chart.log_ratio(xi - 1), chart.log_ratio(xi)});
      const double sign = std::copysign(1.0, start_.u);
      const auto slope = [&](double ln_k) {
        const double q = sign * system_.mu() * std::exp(ln_k);
        return q * separated_slope(system_, q);
      };
      using Rule = boost::math::quadrature::gauss_kronrod<double, 31>;
      std::vector<double> edges{bottom, top};
      for (double k : system_.law().kinks()) edges.push_back(std::clamp(std::log(k), bottom, top));
      std::ranges::sort(edges);
      double change = 0;
      for (std::size_t i = 1; i < edges.size(); ++i) {
        if (edges[i] > edges[i - 1]) change += Rule::integrate(slope, edges[i - 1], edges[i], 8, 1e-14);
      }
      const double along = orbit_.at_coordinate(xi).ln_v - orbit_.at_coordinate(xi - 1).ln_v;
      // dp/dq = Phi/(q D) loses as many digits as D = Phi - r k Psi.
      const double digits = 1 / std::max(1.0, steepness(chart.log_ratio(xi - 1)));
      worst = worse(relative(along, std::copysign(change, along)) * digits, worst);
    }
    add("separated equation dp/dq", worst, 1e-12);
  }

  /// Returns ln k, even if k underflows.
  double log_ratio(const OrbitPoint& point) const { return point.ln_v - std::log(system_.mu() * std::abs(point.u)); }

  void first_integral(const Motion& regularised, const Motion& direct) {
    // An error of ln k changes ln w by this error times the slope d ln w/d ln k, which is unbounded on rays and for r
    // next to Phi'(0)/Psi(0).
    const auto drift = [&](const Motion& motion) {
      const double at_start = flow_.log_first_integral(start_.u, std::log(start_.v));
      double worst = 0;
      for (Eigen::Index i = 0; i + 1 < motion.points.rows(); ++i) {
        const OrbitPoint point = motion.points.row(i);
        if (on_a_ray(log_ratio(point))) continue;
        const double here = flow_.log_first_integral(point.u, point.ln_v);
        worst = worse(std::abs(here - at_start) / (1 + steepness(log_ratio(point))), worst);
      }
      return worst;
    };
    add("first integral along (2.7)", drift(regularised), stepping);
    add("first integral along (2.6)", drift(direct), stepping);
  }

  /// Returns |d ln w/d ln k| = r k Psi/|Phi - rho - r k Psi|, theory.md (R2). Under a drive the numerator is rho + r k
  /// Psi, because steps in time give larger errors of k next to the ray, in the ratio of these numerators.
  double steepness(double ln_k) const {
    const double k = std::exp(std::clamp(ln_k, -300.0, 300.0));
    const Balance balance = Balance::of(system_.law(), system_.r(), system_.drive(), k);
    return balance.speeds / std::abs(balance.difference());
  }

  /// Returns true on a ray. There k does not change, so k does not determine the state.
  bool on_a_ray(double ln_k) const { return steepness(ln_k) > 1e9; }

  void times(const Motion& regularised) {
    // Compare tau(k) and beta(k) of the similarity solution with those of the stepper at the same k. Next to an
    // invariant ray k determines tau and beta badly; on the ray k does not determine them.
    const double beta_unit = 1 / (16 * system_.mu() * std::abs(start_.u) + 15 * pi * start_.v);
    double worst_tau = 0;
    double worst_beta = 0;
    for (Eigen::Index i = 0; i + 1 < regularised.points.rows(); ++i) {
      const OrbitPoint stepped = regularised.points.row(i);
      const double ln_k = log_ratio(stepped);
      if (on_a_ray(ln_k)) continue;
      const OrbitPoint exact =
          orbit_.at_coordinate(std::min(orbit_.chart().coordinate(ln_k), orbit_.start_coordinate()));
      const double blunt = 1 + steepness(ln_k);
      worst_tau = worse(std::abs(stepped.tau - exact.tau) / (orbit_.stop_time() * blunt), worst_tau);
      worst_beta = worse(std::abs(stepped.beta - exact.beta) / ((beta_unit + exact.beta) * blunt), worst_beta);
    }
    add("tau(k) against (2.8)", worst_tau, stepping);
    add("beta(k) against (2.8)", worst_beta, stepping);
  }

  void limits() {
    // Next to the axes the general formulas must give the values on the axes.
    const double speed = std::max(std::abs(start_.u), start_.v);
    const double faint = 1e-15 / std::max(1.0, system_.r());
    const State almost_pivoting{speed, faint * system_.mu() * speed};
    const double pivoting_rate = system_.r() * system_.law().pivoting_moment();
    const State almost_sliding{faint * std::min(1.0, pivoting_rate) * speed / system_.mu(), speed};
    const auto stop = [&](State start) { return flow_.orbit(start).stop_time(); };
    // Under a drive k = 0 is no limit of motions: a body at k = 0 begins to creep.
    const bool creeps = system_.drive() > 0;
    const double pivoting = creeps ? stop({speed, 0}) : system_.pivoting_limit(speed);
    add(creeps ? "start of creeping" : "limit of pure pivoting", relative(stop(almost_pivoting), pivoting), rounding);
    const double sliding = system_.sliding_limit(speed) / (1 - system_.drive());
    add("limit of pure sliding", relative(stop(almost_sliding), sliding), rounding);
  }

  void bounds() {
    if (!system_.law().sliding_bounds()) return;
    const double stop = orbit_.stop_time();
    const auto [lower, upper] = system_.stop_time_bounds(start_);
    add("two-sided bound of the stop time", worse(lower / stop - 1, worse(stop / upper - 1, 0)), rounding);

    // The law's bounds follow from Phi + Psi/Psi(0) >= 1 (Coulomb friction) or <= 1 (laws with m >= 1).
    const double sign = system_.law().sliding_bounds()->min >= 1 ? 1 : -1;
    double worst = 0;
    for (int i = -200; i <= 200; ++i) {
      const Slip slip = slip_of_ratio(std::exp2(0.1 * i));
      const double excess = system_.law()(slip).force - system_.law().moment_deficit(slip);
      worst = worse(sign * excess, worst);
    }
    add("Phi + Psi/Psi(0) on its side of 1", worst, 1e-15);
  }

  void inner_orbit() {
    if (!system_.law().as<HertzLaw>() || !(system_.r() < 2) || system_.drive() > 0) return;
    const SimilarityCurve& curve = *flow_.solution().through(0);
    // Errors are relative to the change of ln w, which is r times a number of order 1, and larger as r -> 2.
    double worst = 0;
    for (double k : {1e-6, 1e-3, 0.03, 0.3, 0.7, 0.99}) {
      const double elementary = hertz_inner_ln_w(system_.r(), 1) - hertz_inner_ln_w(system_.r(), k);
      const double change = curve.ln_w(0) - curve.ln_w(std::log(k));
      worst = worse(std::abs(change - elementary) / std::max(system_.r(), std::abs(change)), worst);
    }
    add("elementary orbit for k <= 1", worst, rounding);
  }

  const ReducedSystem& system_;
  State start_;
  const Flow& flow_;
  const Flow& quadrature_;
  Orbit orbit_;
  std::vector<Check> checks_;
};

}  // namespace

std::vector<Check> verify(const Flow& flow, const std::vector<State>& starts) {
  const ReducedSystem& system = flow.system();
  constexpr double min_r = 1e-100;
  if (system.r() < min_r) {
    throw std::domain_error(fmt::format(
        "verify: mu = {} is too small, the fields underflow; gamma mu^2/chi >= {} is needed", system.mu(), min_r));
  }
  const Flow quadrature = flow.is_by_quadrature() ? flow : Flow::by_quadrature(system);
  std::vector<Check> all;
  for (const State& start : starts) {
    require_state("verify", start);
    if (start.u == 0 && start.v == 0) {
      throw std::domain_error("verify: u = v = 0 is rest, there is no motion to check");
    }
    for (Check& check : Examination(flow, quadrature, start).run()) {
      const auto same = std::ranges::find(all, check.name, &Check::name);
      if (same == all.end()) {
        all.push_back(std::move(check));
      } else {
        same->measured = worse(check.measured, same->measured);
      }
    }
  }
  return all;
}

std::vector<Check> verify(const Flow& flow, State start) { return verify(flow, std::vector{start}); }

double generator_residual(const std::function<Rate(State)>& field, int degree, State state) {
  // Fourth-order central difference of F(exp(h) x) in h: truncation 1e-11, rounding 1e-13.
  constexpr double h = 1e-3;
  const auto along = [&](double step) { return field({std::exp(step) * state.u, std::exp(step) * state.v}); };
  const Rate far_ahead = along(2 * h), ahead = along(h), behind = along(-h), far_behind = along(-2 * h);
  const Rate here = field(state);
  const auto residual = [&](double Rate::*part) {
    const double derivative = (8 * (ahead.*part - behind.*part) - (far_ahead.*part - far_behind.*part)) / (12 * h);
    return derivative - degree * here.*part;
  };
  return size({residual(&Rate::u), residual(&Rate::v)}) / size(here);
}

double field_symmetry_residual(const ReducedSystem& system, State state) {
  return generator_residual([&](State at) { return system.field(at); }, 0, state);
}

double regularised_symmetry_residual(const ReducedSystem& system, State state) {
  return generator_residual([&](State at) { return system.regularised_field(at); }, 2, state);
}

double slope_symmetry_residual(const ReducedSystem& system, State state) {
  // The two partial derivatives use other difference quotients than the derivative along the group. The steps are
  // short, because the exact law has no third derivative at k = 1.
  constexpr double h = 2e-5;
  const auto partial = [&](double du, double dv) {
    const auto at = [&](double step) { return system.slope({state.u * (1 + step * du), state.v * (1 + step * dv)}); };
    return (8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h);
  };
  return std::abs(partial(1, 0) + partial(0, 1)) / std::abs(system.slope(state));
}

double separated_slope(const ReducedSystem& system, double q) {
  if (q == 0 || !std::isfinite(q)) {
    throw std::domain_error(fmt::format("separated_slope: q must be finite and not 0, got {}", q));
  }
  // d ln v = -(Phi - rho) ds/v and d ln k = -(Phi - rho - r k Psi) ds/v (theory.md (R2), (R20)), and q = mu k.
  const double k = std::abs(q) / system.mu();
  const Balance balance = Balance::of(system.law(), system.r(), system.drive(), k);
  return balance.force / (q * balance.difference());
}

}  // namespace contensou::reduction
