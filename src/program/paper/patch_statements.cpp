#include <map>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/tools/minima.hpp>

#include "contensou/reduction/verification.hpp"
#include "paper/statements.hpp"
#include "paper/zh98.hpp"

namespace contensou::program {

namespace {

using namespace zh98;

constexpr double by_integral = 1e-10;        ///< allowed error of an integral over the patch
constexpr double by_difference = 1e-6;       ///< allowed error of a difference quotient
constexpr double quantitatively_well = 0.1;  ///< largest error that the words "well, in numbers" of the paper allow

template <class Integrand>
double integral(Integrand integrand, double left, double right, unsigned halvings = 8) {
  return boost::math::quadrature::gauss_kronrod<double, 31>::integrate(integrand, left, right, halvings, 1e-12);
}

/// Returns the one-sided derivative with an error of second order; side = 1: from above, -1: from below.
template <double (*function)(double), int side>
double derivative(double at) {
  constexpr double step = side * 1e-5;
  return (-3 * function(at) + 4 * function(at + step) - function(at + 2 * step)) / (2 * step);
}

/// Returns the slope of ln f against ln k between k and 2 k, for a function f(k).
template <double (*function)(double)>
double order(double k) {
  return std::log2(function(2 * k) / function(k));
}

/// Returns the contact patch under Hertz's pressure.
const reduction::ContactPatch& patch() {
  static const reduction::ContactPatch hertz([](double rest) { return std::sqrt(rest); });
  return hertz;
}

/// Returns force and moment by the integral over the disc. Several statements need them at one k.
const reduction::Resistance& over_disc(double k) {
  static std::map<double, reduction::Resistance> known;
  const auto found = known.find(k);
  return found != known.end() ? found->second : known[k] = patch().over_disc(reduction::slip_of_ratio(k));
}

double true_force(double k) { return k > 0 ? over_disc(k).force : 0; }
double true_moment(double k) { return over_disc(k).moment; }

double last_angle(double k) { return k > 1 ? std::asin(1 / k) : pi; }

/// Returns the integral of Q_n cos(theta)^power for theta in (0, top); Q_n is the integral in (1.2) times 3/(2 pi).
double over_angles(int n, int power, double k, double top) {
  const auto integrand = [&](double theta) {
    return std::pow(std::cos(theta), power) * patch().chord_moment(n, theta, k);
  };
  // Near the last angle, the chord's length varies like a square root; theta = top sin(x) makes the integrand smooth.
  return integral([&](double x) { return top * std::cos(x) * integrand(top * std::sin(x)); }, 0, pi / 2, 2);
}

/// Returns the force by (1.2), with cos(theta)^power under the integral.
template <int power>
double force_by_chords(double k) {
  return (k > 1 ? 2 : 1) * over_angles(1, power, k, last_angle(k));
}

/// Returns M^h - h F of the paper, by an integral up to `multiple` times the last angle in (1.2).
template <int multiple>
double moment_by_chords(double k) {
  return (k > 1 ? 2 : 1) * over_angles(2, 0, k, multiple * last_angle(k)) - k * true_force(k);
}

double inner_remainder(double k) { return std::abs(true_force(k) - 3 * pi / 8 * k); }
double outer_remainder(double k) { return std::abs(1 - 1 / (10 * k * k) - true_force(k)); }

double load() {
  return 2 * pi * integral([](double c) { return c * pressure(std::sqrt((1 - c) * (1 + c))); }, 0, 1);
}

/// Returns the friction force across the slip, by an integral over the disc. The midpoint rule uses no symmetry.
double force_across(double k) {
  constexpr int points = 64;
  const auto of_circle = [&](double rho) {
    double sum = 0;
    for (int i = 0; i < points; ++i) {
      const double angle = 2 * pi * (i + 0.37) / points;
      sum += rho * std::cos(angle) / std::hypot(k - rho * std::sin(angle), rho * std::cos(angle));
    }
    return 2 * pi / points * rho * pressure(rho) * sum;
  };
  return integral(of_circle, 0, 1);
}

/// Returns the distance from the centre of the patch to one end of a chord: the end that is farther from the edge.
double worst_chord_end(double k) {
  const double theta = 0.7 * last_angle(k);
  const auto rho = [&](double q) { return std::hypot(k - q * std::cos(theta), q * std::sin(theta)); };
  const double near = rho(chord_end(k, theta, -1)), far = rho(chord_end(k, theta, 1));
  return std::abs(near - 1) < std::abs(far - 1) ? far : near;
}

double pade_error(double k) { return std::abs(1 - pade_force(k) / (k <= 1 ? inner_force(k) : outer_force(k))); }

double worst_of_pade() {
  return boost::math::tools::brent_find_minima([](double k) { return -pade_error(k); }, 0.05, 3.0, 24).first;
}

}  // namespace

std::vector<Statement> patch_statements() {
  std::vector<Statement> statements{
      {"sigma", "3N/(2 pi eps^2) sqrt(1 - rho^2/eps^2) carries the load N", 1., load(), by_integral, 0,
       "0 <= rho <= eps"},
      {"(1.1)", "F is f times the integral of sigma cos(theta): that of (1.3)", inner_force, true_force, by_integral,
       0.5},
      {"", "friction across the slip integrates to 0", 0., force_across, 1e-9, 1.5},
      {"", "q_- and q_+ are where a chord meets the edge, rho = eps", 1., worst_chord_end, by_integral, 2},
      {"(1.2)", "k > 1: F is 3/pi times the integral of Q_1 over (0, theta*)", force_by_chords<0>, true_force,
       by_integral, 2, "", Verdict::erratum, "the integral of Q_1 cos(theta)", force_by_chords<1>},
      {"(1.2)", "k <= 1: F is 3/(2 pi) times the integral of Q_1 over (0, pi)", force_by_chords<0>, true_force,
       by_integral, 0.5, "", Verdict::erratum, "the integral of Q_1 cos(theta)", force_by_chords<1>},
      {"(1.3)", "F for k <= 1", inner_force, true_force, by_integral, 0.5},
      {"(1.3)", "F for k > 1", outer_force, true_force, by_integral, 2},
      {"(1.3)", "F is continuous at k = 1", inner_force, outer_force, by_integral, 1},
      {"(1.3)", "and so is its derivative", derivative<inner_force, -1>, derivative<outer_force, 1>, by_difference, 1},
      {"", "F = (3 pi/8) k + O(k^2), the slope", 3 * pi / 8, [](double k) { return true_force(k) / k; }, 1e-6, 1e-5},
      {"", "its remainder is O(k^2); sharper, O(k^3): the order found", 2., order<inner_remainder>, lower_bound, 0.02,
       "k -> 0"},
      {"", "F = 1 - 1/(10 k^2) + O(1/k^3), the coefficient", 1. / 10,
       [](double k) { return k * k * (1 - true_force(k)); }, 1e-4, 100},
      {"", "its remainder is O(1/k^3); sharper, O(1/k^4): the order found", 3.,
       [](double k) { return -order<outer_remainder>(k); }, lower_bound, 10, "k -> inf"},
      {"(1.4)", "the Pade force keeps the derivative at 0", derivative<pade_force, 1>, derivative<true_force, 1>, 1e-6,
       0},
      {"(1.4)", "and the limit at infinity", pade_force, true_force, 1e-8, 1e9},
      {"(1.4)", "approximates (1.3) well in numbers, too: the relative error", 0., pade_error, quantitatively_well,
       worst_of_pade(), "", Verdict::not_true, "it misses by {percent:.3g} % at worst"},
      {"M^h", "k <= 1: Q_2 over theta from 0 to 2 pi; M^h - h F for k -> 0", moment_by_chords<2>, true_moment,
       by_integral, 1e-6, "", Verdict::erratum, "theta from 0 to pi", moment_by_chords<1>},
      {"M^h", "k > 1: twice the integral of Q_2 over (0, theta*); M^h - h F", moment_by_chords<1>, true_moment,
       by_integral, 2},
      {"(1.5)", "M for k <= 1", inner_moment, true_moment, by_integral, 0.5},
      {"(1.5)", "M for k > 1", outer_moment, true_moment, by_integral, 2},
      {"(1.5)", "M is continuous at k = 1", inner_moment, outer_moment, by_integral, 1},
      {"(1.5)", "and smooth there, as F is", derivative<inner_moment, -1>, derivative<outer_moment, 1>, by_difference,
       1},
      {"(1.6)", "the Pade moment keeps the value at 0", pade_moment, true_moment, by_integral, 0},
      {"(1.6)", "and the behaviour at infinity, k M", [](double k) { return k * pade_moment(k); },
       [](double k) { return k * true_moment(k); }, 1e-3, 1e3},
      {"1.", "the two frictions are not independent: F falls with spin, by", 1. / 10,
       [](double k) { return 1 - true_force(k); }, lower_bound, 0.5, "k = inf to 0.5"},
      {"1.", "M falls with sliding, by", 1. / 10, [](double k) { return true_moment(0) - true_moment(k); }, lower_bound,
       1, "k = 0 to 1"},
      {"2.", "no break-away: F is viscous, a power of v for v -> 0", 1., order<true_force>, 1e-6, 1e-4, "k -> 0"},
      {"2.", "likewise M, a power of omega for omega -> 0", -1., order<true_moment>, 1e-6, 1e4, "k -> inf"},
      {"3.", "no limit at v = omega = 0: F differs from ray to ray, by", 1. / 2,
       [](double k) { return true_force(k) - true_force(1 / k); }, lower_bound, 1e9, "k = 0, inf"},
      {"3.", "M differs from ray to ray, by", 1. / 2, [](double k) { return true_moment(1 / k) - true_moment(k); },
       lower_bound, 1e9, "k = 0, inf"},
  };
  for (Statement& statement : statements) {
    if (statement.where.empty()) statement.where = "k = {:.4g}";
  }
  return statements;
}

}  // namespace contensou::program
