#include "contensou/reduction/patch_claims.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/tools/minima.hpp>

#include "contensou/reduction/contact_patch.hpp"

namespace contensou::reduction {

namespace {

using std::numbers::pi;
using Function = std::function<double(double)>;

constexpr double by_integral = 1e-10;        ///< what an integral over the patch may miss by
constexpr double by_difference = 1e-6;       ///< a difference quotient
constexpr double quantitatively_well = 0.1;  ///< the most that "well, in numbers" can mean

constexpr std::array inner_ratios{0.1, 0.5, 0.9};
constexpr std::array outer_ratios{1.1, 2.0, 10.0};

template <class Integrand>
double integral(Integrand integrand, double left, double right, unsigned halvings = 8) {
  return boost::math::quadrature::gauss_kronrod<double, 31>::integrate(integrand, left, right, halvings, 1e-12);
}

std::string at_ratio(double k) { return fmt::format("k = {:.4g}", k); }

/// A printed function of k against a computed one, where they differ most.
template <class Ratios>
Evidence compare(const Ratios& ratios, const Function& printed, const Function& computed,
                 const Function& corrected = {}) {
  Evidence worst{0, 0, by_integral};
  double largest = -1;
  for (double k : ratios) {
    const double here = printed(k);
    const double truth = computed(k);
    const double error = std::abs(here - truth);
    if (error <= largest) continue;
    largest = std::isnan(error) ? std::numeric_limits<double>::infinity() : error;
    worst.printed = here;
    worst.computed = truth;
    if (corrected) worst.corrected = corrected(k);
    worst.at = at_ratio(k);
  }
  return worst;
}

/// One-sided derivative to second order: side = 1 from above, -1 from below.
double derivative(const Function& function, double at, double side) {
  constexpr double h = 1e-5;
  const double step = side * h;
  return (-3 * function(at) + 4 * function(at + step) - function(at + 2 * step)) / (2 * step);
}

/// d ln f/d ln k.
double log_slope(const Function& function, double k) { return std::log(function(2 * k) / function(k)) / std::log(2.0); }

double hertz_pressure(double rest) { return std::sqrt(rest); }

class PatchExamination {
 public:
  PatchExamination(const PrintedPatch& printed, const PatchTruth& truth)
      : printed_(printed), truth_(truth), patch_(hertz_pressure) {}

  std::vector<PaperClaim> run() {
    stress();
    force();
    approximate_force();
    moment();
    approximate_moment();
    conclusions();
    return std::move(claims_);
  }

 private:
  void add(std::string equation, std::string statement, Evidence evidence) {
    claims_.push_back({std::move(equation), std::move(statement), "", Verdict::holds, std::move(evidence)});
  }
  void add_slip(std::string equation, std::string statement, std::string correction, Evidence evidence,
                Verdict recorded = Verdict::slip) {
    claims_.push_back(
        {std::move(equation), std::move(statement), std::move(correction), recorded, std::move(evidence)});
  }

  const Resistance& truth(double k) {
    const auto known = known_.find(k);
    return known != known_.end() ? known->second : known_.emplace(k, truth_(k)).first->second;
  }
  double true_force(double k) { return truth(k).force; }
  double true_moment(double k) { return truth(k).moment; }

  /// Q_n of (1.2) times 3/(2 pi).
  double chord(int n, double theta, double k) const { return patch_.chord_moment(n, theta, k); }

  double last_angle(double k) const { return k > 1 ? std::asin(1 / k) : pi; }

  /// The integral of Q_n cos(theta)^power over (0, top).
  double over_angles(int n, int power, double k, double top) const {
    const auto part = [&](double left, double right) {
      return integral([&](double theta) { return std::pow(std::cos(theta), power) * chord(n, theta, k); }, left, right,
                      1);
    };
    // theta = top sin(x): the chord's length has a root at the last angle.
    if (k > 1) {
      return integral(
          [&](double x) {
            const double theta = top * std::sin(x);
            return top * std::cos(x) * std::pow(std::cos(theta), power) * chord(n, theta, k);
          },
          0, pi / 2, 1);
    }
    double sum = 0;
    for (double left = 0; left < top - 1e-9; left += pi / 2) sum += part(left, left + pi / 2);
    return sum;
  }

  void stress() {
    const double load =
        2 * pi * integral([&](double c) { return c * printed_.pressure(std::sqrt((1 - c) * (1 + c))); }, 0, 1);
    add("sigma", "3N/(2 pi eps^2) sqrt(1 - rho^2/eps^2) carries the load N", {1, load, by_integral});
  }

  void force() {
    // Friction across the slip, over the disc, with no use of the symmetry: the midpoint rule of the whole circle.
    const auto across = [&](double k) {
      constexpr int points = 64;
      return integral(
          [&](double rho) {
            double sum = 0;
            for (int i = 0; i < points; ++i) {
              const double angle = 2 * pi * (i + 0.37) / points;
              const double x = k - rho * std::sin(angle);
              const double y = rho * std::cos(angle);
              sum += y / std::hypot(x, y);
            }
            return 2 * pi / points * rho * printed_.pressure(rho) * sum;
          },
          0, 1);
    };
    add("(1.1)", "F is f times the integral of sigma cos(theta): that of (1.3)",
        compare(inner_ratios, printed_.inner_force, [&](double k) { return true_force(k); }));
    add("", "friction across the slip integrates to 0", {0, across(1.5), 1e-9, at_ratio(1.5)});
    const auto ends = [&](double k) {
      double worst = 1;
      for (double share : {0.1, 0.5, 0.9}) {
        const double theta = share * last_angle(k);
        for (double sign : {-1.0, 1.0}) {
          const double q = printed_.chord_end(k, theta, sign);
          const double rho = std::hypot(k - q * std::cos(theta), q * std::sin(theta));
          if (!(std::abs(rho - 1) <= std::abs(worst - 1))) worst = rho;
        }
      }
      return worst;
    };
    add("", "q_- and q_+ are where a chord meets the edge, rho = eps", {1, ends(2), by_integral, at_ratio(2)});
    add_slip(
        "(1.2)", "k > 1: F is 3/pi times the integral of Q_1 over (0, theta*)", "the integral of Q_1 cos(theta)",
        compare(
            std::array{2.0}, [&](double k) { return 2 * over_angles(1, printed_.force_cosines, k, last_angle(k)); },
            [&](double k) { return true_force(k); },
            [&](double k) { return 2 * over_angles(1, 1, k, last_angle(k)); }));
    add_slip("(1.2)", "k <= 1: F is 3/(2 pi) times the integral of Q_1 over (0, pi)", "the integral of Q_1 cos(theta)",
             compare(
                 std::array{0.5}, [&](double k) { return over_angles(1, printed_.force_cosines, k, pi); },
                 [&](double k) { return true_force(k); }, [&](double k) { return over_angles(1, 1, k, pi); }));
    add("(1.3)", "F for k <= 1", compare(inner_ratios, printed_.inner_force, [&](double k) { return true_force(k); }));
    add("(1.3)", "F for k > 1", compare(outer_ratios, printed_.outer_force, [&](double k) { return true_force(k); }));
    add("(1.3)", "F is continuous at k = 1",
        {printed_.inner_force(1), printed_.outer_force(1), by_integral, at_ratio(1)});
    add("(1.3)", "and so is its derivative",
        {derivative(printed_.inner_force, 1, -1), derivative(printed_.outer_force, 1, 1), by_difference, at_ratio(1)});
    add("", "F = (3 pi/8) k + O(k^2), the slope",
        {printed_.slope_at_zero, true_force(1e-5) / 1e-5, 1e-6, at_ratio(1e-5)});
    const auto inner_rest = [&](double k) { return std::abs(true_force(k) - printed_.slope_at_zero * k); };
    add("", "its remainder is O(k^2); sharper, O(k^3): the order found",
        at_least(2, log_slope(inner_rest, 0.02), "k -> 0"));
    add("", "F = 1 - 1/(10 k^2) + O(1/k^3), the coefficient",
        {printed_.deficit_at_infinity, 100 * 100 * (1 - true_force(100)), 1e-4, at_ratio(100)});
    const auto outer_rest = [&](double k) {
      return std::abs(1 - printed_.deficit_at_infinity / (k * k) - true_force(k));
    };
    add("", "its remainder is O(1/k^3); sharper, O(1/k^4): the order found",
        at_least(3, -log_slope(outer_rest, 10), "k -> inf"));
  }

  static Evidence at_least(double least, double computed, std::string at) {
    return {least, computed, 0, std::move(at), {}, true};
  }

  void approximate_force() {
    add("(1.4)", "the Pade force keeps the derivative at 0",
        {derivative(printed_.pade_force, 0, 1), derivative([&](double k) { return k > 0 ? true_force(k) : 0; }, 0, 1),
         1e-6, at_ratio(0)});
    add("(1.4)", "and the limit at infinity", {printed_.pade_force(1e9), true_force(1e9), 1e-8, at_ratio(1e9)});
    const auto [k, error] = worst_error(
        printed_.pade_force, [&](double x) { return x <= 1 ? printed_.inner_force(x) : printed_.outer_force(x); });
    add_slip("(1.4)", "approximates (1.3) well in numbers, too: the relative error",
             fmt::format("it misses by {:.3g} % at worst", 100 * error), {0, error, quantitatively_well, at_ratio(k)},
             Verdict::not_true);
  }

  /// The largest relative error of an approximation, and where.
  static std::pair<double, double> worst_error(const Function& approximation, const Function& exact) {
    const auto miss = [&](double k) { return -std::abs(1 - approximation(k) / exact(k)); };
    const auto [k, least] = boost::math::tools::brent_find_minima(miss, 0.05, 3.0, 24);
    return {k, -least};
  }

  void moment() {
    add_slip("M^h", "k <= 1: Q_2 over theta from 0 to 2 pi; M^h - h F for k -> 0", "theta from 0 to pi",
             compare(
                 std::array{1e-6},
                 [&](double k) { return over_angles(2, 0, k, printed_.inner_moment_angle) - k * true_force(k); },
                 [&](double k) { return true_moment(k); },
                 [&](double k) { return over_angles(2, 0, k, pi) - k * true_force(k); }));
    add("M^h", "k > 1: twice the integral of Q_2 over (0, theta*); M^h - h F",
        compare(
            outer_ratios,
            [&](double k) {
              return printed_.outer_moment_factor * over_angles(2, 0, k, last_angle(k)) - k * true_force(k);
            },
            [&](double k) { return true_moment(k); }));
    add("(1.5)", "M for k <= 1",
        compare(inner_ratios, printed_.inner_moment, [&](double k) { return true_moment(k); }));
    add("(1.5)", "M for k > 1", compare(outer_ratios, printed_.outer_moment, [&](double k) { return true_moment(k); }));
    add("(1.5)", "M is continuous at k = 1",
        {printed_.inner_moment(1), printed_.outer_moment(1), by_integral, at_ratio(1)});
    add("(1.5)", "and smooth there, as F is",
        {derivative(printed_.inner_moment, 1, -1), derivative(printed_.outer_moment, 1, 1), by_difference,
         at_ratio(1)});
  }

  void approximate_moment() {
    add("(1.6)", "the Pade moment keeps the value at 0",
        {printed_.pade_moment(0), true_moment(0), by_integral, at_ratio(0)});
    add("(1.6)", "and the behaviour at infinity, k M",
        {1e3 * printed_.pade_moment(1e3), 1e3 * true_moment(1e3), 1e-3, at_ratio(1e3)});
  }

  void conclusions() {
    const auto force = [&](double k) { return true_force(k); };
    const auto moment = [&](double k) { return true_moment(k); };
    add("1.", "the two frictions are not independent: F falls with spin, by",
        at_least(0.1, 1 - force(0.5), "k = inf to 0.5"));
    add("1.", "M falls with sliding, by", at_least(0.1, moment(0) - moment(1), "k = 0 to 1"));
    add("2.", "no break-away: F is viscous, a power of v for v -> 0", {1, log_slope(force, 1e-4), 1e-6, "k -> 0"});
    add("2.", "likewise M, a power of omega for omega -> 0", {-1, log_slope(moment, 1e4), 1e-6, "k -> inf"});
    add("3.", "no limit at v = omega = 0: F differs from ray to ray, by",
        at_least(0.5, force(1e9) - force(1e-9), "k = 0, inf"));
    add("3.", "M differs from ray to ray, by", at_least(0.5, moment(1e-9) - moment(1e9), "k = 0, inf"));
  }

  PrintedPatch printed_;
  PatchTruth truth_;
  ContactPatch patch_;                  ///< for its chords
  std::map<double, Resistance> known_;  ///< truth_, by k: an integral over the patch takes milliseconds
  std::vector<PaperClaim> claims_;
};

}  // namespace

PrintedPatch printed_patch() {
  const auto root = [](double k) { return std::sqrt((k - 1) * (k + 1)); };
  const auto theta = [](double k) { return std::asin(1 / k); };
  PrintedPatch printed;
  printed.pressure = [](double rho) { return 3 / (2 * pi) * std::sqrt(1 - rho * rho); };
  printed.inner_force = [](double k) { return 3.0 / 32 * pi * k * (4 - k * k); };
  printed.outer_force = [=](double k) {
    return 3 / (64 * k) * (4 * k * k * (4 - k * k) * theta(k) + 4 * (k * k + 2) * root(k));
  };
  printed.inner_moment = [](double k) { return 3.0 / 128 * pi * (8 - 8 * k * k + 3 * k * k * k * k); };
  printed.outer_moment = [=](double k) {
    return 3.0 / 128 * 2 * ((8 - 8 * k * k + 3 * k * k * k * k) * theta(k) + 3 * (2 - k * k) * root(k));
  };
  printed.pade_force = [](double k) { return 3 * pi * k / (8 + 3 * pi * k); };
  printed.pade_moment = [](double k) { return 3 * pi / (16 + 15 * pi * k); };
  printed.chord_end = [](double k, double angle, double sign) {
    return k * std::cos(angle) + sign * std::sqrt(1 - k * k * std::sin(angle) * std::sin(angle));
  };
  printed.force_cosines = 0;
  printed.inner_moment_angle = 2 * pi;
  printed.outer_moment_factor = 2;
  printed.slope_at_zero = 3 * pi / 8;
  printed.deficit_at_infinity = 1.0 / 10;
  return printed;
}

PatchTruth integrated_patch() {
  return [patch = ContactPatch(hertz_pressure)](double k) { return patch.over_disc(slip_of_ratio(k)); };
}

std::vector<PaperClaim> patch_claims(const PrintedPatch& printed, const PatchTruth& truth) {
  return PatchExamination(printed, truth).run();
}

}  // namespace contensou::reduction
