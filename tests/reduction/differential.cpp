// Random starts and systems are computed by every route of the library. Results of two routes may differ by at most the
// accuracies that they state.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <type_traits>
#include <vector>

#include <fmt/format.h>
// Boost 1.74 derives from std::unary_function, which LLVM's library for C++20 does not have.
#define BOOST_NO_CXX98_FUNCTION_BASE
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <catch2/catch.hpp>

#include "constants.hpp"
#include "contensou/reduction/detail/stepped_motion.hpp"
#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/laws.hpp"
#include "contensou/reduction/stop_time.hpp"
#include "motion/stop_time_table.hpp"

using namespace contensou::reduction;

namespace {

class Questions {
 public:
  explicit Questions(unsigned seed) : random_(seed) {}

  ReducedSystem system() {
    const Law law = this->law();
    const double r = this->r(law);
    if (one_of(2) == 0) return {law, 1, {.chi = 1, .gamma = r}};  // so that the system has exactly this r
    const double chi = log_uniform(-6, 6), gamma = log_uniform(-6, 6);
    return {law, std::sqrt(r * chi / gamma), {.chi = chi, .gamma = gamma}};
  }

  /// Returns a system with a drive of any size, also next to 1 and next to the border above which k has no bound.
  ReducedSystem driven_system() {
    const ReducedSystem free = system();
    const double border = 1 - free.r() / terminal_ratios(free.law(), free.r()).high;
    double drive = 0;
    while (!(drive >= ReducedSystem::least_drive && drive < 1)) {
      const std::array drives{log_uniform(-80, 0), 1 - log_uniform(-30, 0), nearly(border),
                              std::uniform_real_distribution<>(0, 1)(random_)};
      drive = drives[one_of(drives.size())];
    }
    return {free.law(), free.mu(), free.inertia(), drive};
  }

  State start(const Flow& flow) {
    const double mu = flow.system().mu();
    const double sign = one_of(2) == 0 ? 1 : -1;
    switch (one_of(8)) {
      case 0:
        return {sign * log_uniform(-700, 700), log_uniform(-700, 700)};  // the whole range of doubles
      case 1:
        return one_of(2) == 0 ? State{0, log_uniform(-200, 200)} : State{sign * log_uniform(-200, 200), 0};
      case 2:
        return {sign, mu * nearly(1)};
      case 3:
        if (const auto& rays = flow.terminal().rays; !rays.empty()) {
          return {sign, mu * nearly(rays[one_of(rays.size())].k)};
        }
        [[fallthrough]];
      default: {
        const double u = log_uniform(-50, 50);
        return {sign * u, mu * u * log_uniform(-30, 30)};
      }
    }
  }

 private:
  std::size_t one_of(std::size_t count) { return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_); }
  double log_uniform(double low, double high) { return std::exp(std::uniform_real_distribution<>(low, high)(random_)); }

  /// Returns the number itself, a neighbour, or a number at any distance from it.
  double nearly(double x) {
    const std::size_t side = one_of(4);
    if (side == 0) return x;
    if (side == 1) return std::nextafter(x, one_of(2) == 0 ? 0 : 2 * x);
    return x * (1 + (side == 2 ? 1 : -1) * log_uniform(-36, -3));
  }

  Law law() {
    const auto& laws = named_laws();
    const std::size_t which = one_of(laws.size() + 1);
    if (which < laws.size()) return laws[which];
    return PressureLaw(std::uniform_real_distribution<>(-0.95, 25)(random_));
  }

  /// Returns an r of any size, also on and next to the borders of the regimes, and with the ray at k = 1.
  double r(const Law& law) {
    const TerminalRatios ratios = terminal_ratios(law, 1);
    const auto [force, moment] = law({1, 1});
    const std::array borders{ratios.low, ratios.high, force / moment};
    if (one_of(3) == 0) return nearly(borders[one_of(borders.size())]);
    if (one_of(2) == 0) return ratios.low + (ratios.high - ratios.low) * log_uniform(-20, 0);
    return log_uniform(-30, 60);
  }

  std::mt19937_64 random_;
};

/// Returns the largest difference of two states at the same time in u, v and beta, each divided by its own scale.
double difference(const OrbitPoint& a, const OrbitPoint& b, State start) {
  const auto relative = [](double x, double y, double scale) { return x == y ? 0 : std::abs(x - y) / scale; };
  return std::max({relative(a.u, b.u, std::abs(start.u)), relative(a.v, b.v, std::max(start.v, b.v)),
                   relative(a.beta, b.beta, b.beta)});
}

/// Returns the difference of two results divided by the allowed difference.
double excess(double a, double b, double accuracy) {
  if (a == b) return 0;
  const double larger = std::max(std::abs(a), std::abs(b));
  constexpr double smallest = 4 * std::numeric_limits<double>::denorm_min();
  if (std::isinf(larger)) return std::min(a, b) > 0.999999 * std::numeric_limits<double>::max() ? 0 : larger;
  return std::abs(a - b) / (accuracy * larger + smallest);
}

struct Door {
  std::string name;
  double tau;
  double accuracy;
};

/// Compares the routes for some starts of each of some systems.
void ask(Questions& questions, ReducedSystem (Questions::*next)(), int systems) {
  constexpr int starts = 40;
  int asked = 0;
  for (int i = 0; i < systems; ++i) {
    const ReducedSystem system = (questions.*next)();
    const Flow flow(system), by_quadrature = Flow::by_quadrature(system);
    std::optional<StopTimeTable> table;
    if (system.drive() == 0) table.emplace(flow);
    for (int j = 0; j < starts; ++j, ++asked) {
      const State start = questions.start(flow);
      const auto where = [&] {
        return fmt::format("law {}, mu = {}, chi = {}, gamma = {}, r = {}, drive = {}, u0 = {}, v0 = {}",
                           system.law().name(), system.mu(), system.inertia().chi, system.inertia().gamma, system.r(),
                           system.drive(), start.u, start.v);
      };
      const StopTime best = flow.stop_time(start);
      const StopTime quadrature = by_quadrature.stop_time(start);
      const Orbit orbit = flow.orbit(start);
      std::vector<Door> doors{{"quadrature", quadrature.tau, quadrature.accuracy},
                              {"orbit", orbit.stop_time(), orbit.accuracy()},
                              {"mirrored", flow.stop_time({-start.u, start.v}).tau, 0}};
      if (table) doors.push_back({"table", (*table)(start.u, start.v), 4 * eps});
      // For a small r creeping is stiff, and steps are too slow.
      const bool steps = system.drive() == 0 || system.r() > 1e-4;
      if (j == 0 && steps) {
        for (Route route : {Route::direct, Route::regularised}) {
          try {
            const StopTime stepped = stop_time(system, start, route);
            doors.push_back({std::string(name(route)), stepped.tau, stepped.accuracy});
          } catch (const std::runtime_error& error) {
            FAIL_CHECK(fmt::format("{}: {}", error.what(), where()));
          }
        }
      }
      if (std::isnormal(best.tau)) {
        const OrbitPoint half = orbit.at_time(best.tau / 2);
        if (j < 2 && steps) {
          const Motion stepped = integrate_directly(system, start, Eigen::ArrayXd::Constant(1, best.tau / 2));
          if (!stepped.outcome.ok()) {
            FAIL_CHECK(fmt::format("{}: {}", stepped.outcome.sentence, where()));
            continue;
          }
          const double error = difference(half, stepped.points.row(0), start);
          const double ln_k0 = std::log(start.v / system.mu() / std::abs(start.u));
          const bool on_ray = std::ranges::any_of(
              flow.terminal().rays, [&](const InvariantRay& ray) { return std::abs(std::log(ray.k) - ln_k0) < 1e-3; });
          const double blunt = 1e4 * eps / (1 - system.drive());  // rounding of Phi - drive
          if (!(error <= (on_ray ? 1e-5 : 1e-8) + blunt)) {
            FAIL_CHECK(fmt::format("at half time: u = {}, v = {}, beta = {} instead of {}, {}, {}: {}", half.u, half.v,
                                   half.beta, stepped.points.u[0], stepped.points.v[0], stepped.points.beta[0],
                                   where()));
          }
        }
        if (std::isnormal(half.u) && std::isnormal(half.v)) {
          doors.push_back({"from half time", best.tau / 2 + flow.stop_time({half.u, half.v}).tau, 16 * eps});
        }
      }
      for (const Door& door : doors) {
        const double error = excess(door.tau, best.tau, door.accuracy / (1 - system.drive()) + best.accuracy);
        if (!(error <= 1)) {
          FAIL_CHECK(fmt::format("{}: {} instead of {}, {:.3g} times what is stated: {}", door.name, door.tau, best.tau,
                                 error, where()));
        }
      }
      if (!(best.bounds.lower <= best.tau && best.tau <= best.bounds.upper)) {
        FAIL_CHECK(
            fmt::format("{} is not within {} and {}: {}", best.tau, best.bounds.lower, best.bounds.upper, where()));
      }
    }
  }
  CHECK(asked == systems * starts);
}

/// T(k), the scaled stop time divided by w, of a body with a drive and a ray: dT/dk = (1 - r Psi T)/D from (R2), (R20);
/// D: `difference`. T is integrated in steps from the ray's tangent, with more digits than a double has. No code is
/// shared with the library, not even the laws.
class ByTheRay {
 public:
  using Wide = std::conditional_t<(std::numeric_limits<long double>::digits > 60), long double,
                                  boost::multiprecision::cpp_bin_float_quad>;

  /// @param ellipse  C of the elliptic law; 0: the Pade law
  ByTheRay(double ellipse, const ReducedSystem& system, double ray)
      : c_(ellipse), r_(system.r()), drive_(system.drive()), ray_(ray) {
    const auto slope = [&](auto function) {
      return (function(ray_ * (1 + near)) - function(ray_ * (1 - near))) / (2 * ray_ * near);
    };
    for (int i = 0; i < 4; ++i) ray_ -= difference(ray_) / slope([&](Wide k) { return difference(k); });
    at_ray_ = 1 / (r_ * moment(ray_));
    tangent_ = -r_ * slope([&](Wide k) { return moment(k); }) * at_ray_ /
               (slope([&](Wide k) { return difference(k); }) + r_ * moment(ray_));
  }

  Wide ray() const { return ray_; }

  Wide operator()(Wide k) const {
    using std::abs, std::ceil, std::exp, std::log;
    using Values = std::array<Wide, 1>;
    const int side = k < ray_ ? -1 : 1;
    // Above the ray, steps in ln |k - k*|. Below the ray, steps in ln(k*/k - 1), which also resolve small k.
    const Wide from = side > 0 ? log(near * ray_) : log(near / (1 - near)),
               to = log(abs(k - ray_) / (side > 0 ? 1 : k));
    Values value{at_ray_ + side * tangent_ * near * ray_};
    if (!(to > from)) return at_ray_ + tangent_ * (k - ray_);
    const int steps = static_cast<int>(static_cast<double>(to - from) / 0.02) + 1;
    const Wide step = (to - from) / steps;
    boost::numeric::odeint::runge_kutta_fehlberg78<Values, Wide, Values, Wide> stepper;
    const auto rate = [&](const Values& x, Values& slope, Wide along) {
      const Wide share = side > 0 ? Wide(1) : Wide(1 / (1 + exp(along))),
                 distance = exp(along) * (side > 0 ? share : share * ray_);
      const Wide at = ray_ + side * distance;
      slope[0] = side * share * distance * (1 - r_ * moment(at) * x[0]) / difference(at);
    };
    for (int i = 0; i < steps; ++i) stepper.do_step(rate, value, Wide(from + step * i), step);
    return value[0];
  }

 private:
  static constexpr double near = 1e-7;  // the error is the square of this number

  Wide force(Wide k) const {
    using std::sqrt;
    return c_ > 0 ? Wide(k / sqrt(c_ * c_ + k * k)) : Wide(3 * pi * k / (8 + 3 * pi * k));
  }
  Wide moment(Wide k) const {
    using std::sqrt;
    return c_ > 0 ? Wide(c_ * c_ / sqrt(c_ * c_ + k * k)) : Wide(3 * pi / (16 + 15 * pi * k));
  }
  Wide difference(Wide k) const { return force(k) - drive_ - r_ * k * moment(k); }

  inline static const Wide pi = boost::math::constants::pi<Wide>();
  Wide c_, r_, drive_, ray_, at_ray_, tangent_;
};

}  // namespace

TEST_CASE("every door has one answer, within the accuracy that it states", "[differential][route]") {
  Questions questions(20'261'122);
  ask(questions, &Questions::system, CONTENSOU_FULL_TESTS ? 500 : 40);
}

TEST_CASE("with a drive, too", "[differential][route][drive]") {
  Questions questions(28'261'123);
  ask(questions, &Questions::driven_system, CONTENSOU_FULL_TESTS ? 300 : 30);
}

TEST_CASE("random drives by quadrature and by steps from the ray", "[differential][route][drive]") {
  std::mt19937_64 random(29'261'124);
  const auto uniform = [&](double low, double high) { return std::uniform_real_distribution<>(low, high)(random); };
  const bool fast = std::is_same_v<ByTheRay::Wide, long double>;
  int asked = 0;
  for (const int drives = CONTENSOU_FULL_TESTS ? 1000 : fast ? 200 : 20; asked < drives;) {
    const double ellipse = asked % 3 == 0 ? 0 : uniform(0.1, 1);
    const Law law = ellipse > 0 ? Law(EllipticLaw(ellipse)) : Law(PadeLaw{});
    const double drive = asked % 2 == 0 ? uniform(1e-3, 0.99) : std::pow(10, uniform(-8, 0));
    const ReducedSystem system(law, std::pow(10, uniform(-2.5, 0)), {uniform(1, 4), uniform(0.5, 3)}, drive);
    const Flow flow = Flow::by_quadrature(system);
    if (flow.terminal().rays.size() != 1) continue;
    ++asked;
    const ByTheRay by_the_ray(ellipse, system, flow.terminal().rays[0].k);
    const double side = uniform(-0.7, 0.3) < 0 ? -1 : 1;
    const State start{1,
                      system.mu() * static_cast<double>(by_the_ray.ray()) * std::exp(side * std::exp(uniform(-6, 2)))};
    const StopTime stop = flow.stop_time(start);
    const ByTheRay::Wide mu = system.mu(), reference = by_the_ray(start.v / mu) * mu / system.scaled_time_rate();
    const double error = std::abs(static_cast<double>(stop.tau / reference - 1));
    if (!(error <= stop.accuracy)) {
      FAIL_CHECK(
          fmt::format("{} instead of {}, {:.3g} times what is stated: law {}, mu = {}, chi = {}, gamma = {}, "
                      "drive = {}, v0 = {}",
                      stop.tau, static_cast<double>(reference), error / stop.accuracy, law.name(), system.mu(),
                      system.inertia().chi, system.inertia().gamma, drive, start.v));
    }
  }
  CHECK(asked >= 20);
}
