// Planar systems in other units, and orbits that begin at or next to the origin.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <regex>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "answers/asked/planar_system.hpp"
#include "contensou/reduction/planar_reduction.hpp"
#include "run_program.hpp"

using namespace contensou;
using Eigen::Vector2d;

namespace {

struct TypedSystem {
  std::string f, g;
  double u, v;  ///< start

  std::string text() const { return fmt::format("u' = {}; v' = {}", f, g); }
  Vector2d start() const { return {u, v}; }

  /// Returns the system of S u and S v.
  TypedSystem in_units(const std::string& size) const {
    const auto scaled = [&](const std::string& side) {
      static const std::regex variable(R"(\b[uv]\b)");
      return fmt::format("{}*({})", size, std::regex_replace(side, variable, "($&/" + size + ")"));
    };
    return {scaled(f), scaled(g), std::stod(size) * u, std::stod(size) * v};
  }
};

/// The answer of `reduce`, and states of the orbit.
struct Stated {
  nlohmann::json answer;
  std::vector<std::optional<Vector2d>> states;
};

constexpr std::array<double, 5> state_times{0, 0.1, 0.5, 1, 2};

Stated stated(const TypedSystem& system) {
  const Run run = run_program({"reduce", "--system", system.text(), "--u0", fmt::format("{}", system.u), "--v0",
                               fmt::format("{}", system.v), "--format", "json"});
  INFO(system.text() << "\n" << run.err);
  REQUIRE((run.status == 0 || run.status == 1));
  Stated all{nlohmann::json::parse(run.out), {}};
  const answers::FormulaField field = answers::parse_planar_system(system.text(), {});
  const Vector2d start = system.start();
  const reduction::PlanarReduction plane = reduction::reduce(field, start, reduction::find_symmetries(field, start));
  const reduction::PlanarOrbit orbit = plane.orbit(start);
  for (const double time : state_times) {
    try {
      all.states.emplace_back(orbit.at(time));
    } catch (const std::domain_error&) {
      all.states.emplace_back(std::nullopt);
    }
  }
  return all;
}

/// Returns the differences between two statements; `scaled` is in units of `size`.
std::string differences(const Stated& plain, const Stated& scaled, double size) {
  std::string all;
  const auto compare = [&](const std::string& what, const nlohmann::json& one, const nlohmann::json& other) {
    const bool near = one.is_number() && other.is_number() &&
                      std::fabs(one.get<double>() - other.get<double>()) <= 1e-11 * std::fabs(one.get<double>());
    if (!near && one != other) all += fmt::format("; {} {}, not {}", what, other.dump(), one.dump());
  };
  const nlohmann::json none;
  for (const std::string name : {"form", "kind", "end", "tau_stop", "period", "reversors"}) {
    compare(name, plain.answer.value(name, none), scaled.answer.value(name, none));
  }
  double largest = 0;
  for (std::size_t i = 0; i < state_times.size(); ++i) {
    const auto &one = plain.states[i], &other = scaled.states[i];
    compare(fmt::format("a state at {}", state_times[i]), one.has_value(), other.has_value());
    if (!one || !other) continue;
    largest = std::max(largest, one->norm());
    const double error = (*other / size - *one).norm() / largest;
    if (!(error <= 1e-11)) all += fmt::format("; state at {}: {:.1e} off", state_times[i], error);
  }
  const nlohmann::json &points = plain.answer["equilibria"], &others = scaled.answer["equilibria"];
  compare("number of equilibria", points.size(), others.size());
  for (std::size_t i = 0; i < std::min(points.size(), others.size()); ++i) {
    compare(fmt::format("kind of equilibrium {}", i), points[i].value("kind", none), others[i].value("kind", none));
    const auto at = [](const nlohmann::json& point) { return Vector2d(point["u"], point["v"]); };
    const double error = (at(others[i]) / size - at(points[i])).norm() / plain.states[0]->norm();
    if (!(error <= 1e-12)) all += fmt::format("; equilibrium {}: {:.1e} off", i, error);
  }
  return all;
}

}  // namespace

TEST_CASE("a planar system has the same solution in units from 1e-12 to 1e12", "[net]") {
  const std::vector<TypedSystem> systems{
      {"v", "-u", 1.3, 0.7},
      {"v", "-sin(u)", 1.3, 0.7},
      {"v", "-u^3 + u", 1.3, 0.7},
      {"v", "-u - 0.3*v", 1.3, 0.7},
      {"-2*u + v", "u - 3*v", 1.3, 0.7},
      {"u*(1 - v)", "v*(u - 1)", 1.3, 0.7},
      {"u^2 - v^2", "2*u*v", 1.3, 0.7},
      {"v", "-u^3", 1.3, 0.7},
      {"v", "-u - 0.2*sign(v)", 1.3, 0.7},
      {"v", "-v/5 - u^3 + u", 1.3, 0.7},
      {"1", "u - v", 0.5, 0.7},
      {"1", "v^2 - u*v + 1", 0.3, 0.2},
      {"u", "u*sin(u) - v", 1.3, 0.7},
      {"v", "1 - exp(u)", 0.6, 0.7},
      {"-2*u*v", "2*u*v - v", 1.3, 0.7},
      {"-u*sqrt(u^2 + v^2)", "-v*sqrt(u^2 + v^2) - 1", 1.3, 0.7},
      {"u - v - u*(u^2 + v^2)", "u + v - v*(u^2 + v^2)", 1.3, 0.7},
      {"u^2*v - u + v/10", "0.5 - u^2*v - v/10", 1.3, 0.7},
  };
  for (const TypedSystem& system : systems) {
    const Stated plain = stated(system);
    for (int digits = -12; digits <= 12; digits += CONTENSOU_FULL_TESTS ? 1 : 6) {
      const std::string size = fmt::format("1e{}", digits);
      INFO(system.text() << ", solved by " << plain.answer["form"] << ", in units of " << size);
      std::string found;
      try {
        found = differences(plain, stated(system.in_units(size)), std::stod(size));
      } catch (const std::domain_error& refused) {
        found = refused.what();
      }
      CHECK(found == "");
    }
  }
}

namespace {

using LongState = std::array<long double, 2>;

/// Returns the state at a time by steps of order 8; empty if steps of half the size differ, or if the state is large.
std::optional<Vector2d> by_small_steps(const reduction::PlanarField& field, const Vector2d& start, double time) {
  const auto at_end = [&](int count) {
    boost::numeric::odeint::runge_kutta_fehlberg78<LongState, long double> stepper;
    LongState state{start[0], start[1]};
    const auto equations = [&](const LongState& x, LongState& rate, long double) {
      const Vector2d f = field({static_cast<double>(x[0]), static_cast<double>(x[1])});
      rate = {f[0], f[1]};
    };
    for (int i = 0; i < count; ++i) stepper.do_step(equations, state, 0.0L, time / static_cast<long double>(count));
    return Vector2d(static_cast<double>(state[0]), static_cast<double>(state[1]));
  };
  const Vector2d x = at_end(400), finer = at_end(800);
  if (!((x - finer).norm() <= 1e-13 * finer.norm()) || !(finer.norm() < 100)) return std::nullopt;
  return finer;
}

}  // namespace

TEST_CASE("orbits begin at the origin and next to it", "[net]") {
  // Systems of all forms of the inverse integrating factor, and those with a scaling.
  const std::vector<TypedSystem> systems{
      {"1", "exp(3*u) - 2*v", 1.3, 0.7},
      {"1", "u*exp(-u^2) - 4*u*v", 1.3, 0.7},
      {"1", "exp(2*u) - v*cos(u)", 1.3, 0.7},
      {"1", "1 - v^2", 1.3, 0.7},
      {"1", "2*u - u^4 + 2*u^2*v - v^2 + 1", 1.3, 0.7},
      {"1", "v^2 + 3*v - 4", 1.3, 0.7},
      {"1", "u^2 + 2*u*v + v^2", 1.3, 0.7},
      {"1", "v^2 - v*sin(u) + cos(u)", 1.3, 0.7},
      {"1", "2*u*v - 2*v^2 + 1", 1.3, 0.7},
      {"u^2 - u*sin(v) + cos(v)", "1", 0.7, 1.3},
      {"1", "u*v^2 + 3*u*v", 1.3, 0.7},
      {"1", "v^3/3 + v^2 + v/2 + 1", 1.3, 0.7},
      {"1", "2*sqrt(v^2 + 1) + 3", 1.3, 0.7},
      {"1", "2*cos(v) - 3", 1.3, 0.7},
      {"1", "cos(3*u + 2*v)", 1.3, 0.7},
      {"1", "exp(u)*(1 - exp(v))*exp(-v)", 1.3, 0.7},
      {"1", "(u^5 - v^2)/u^3", 1.3, 0.7},
      {"u", "u*sin(u) - v", 1.3, 0.7},
      {"u", "v^2 - 1", 1.3, 0.7},
      {"u + 1", "u*v - v^2", 1.3, 0.7},
      {"u^2", "-2*u^2*v^2 + 3", 1.3, 0.7},
      {"u^2 + 1", "1 - u*v", 1.3, 0.7},
      {"u^2 - 1", "u*v - 2", 1.3, 0.7},
      {"u^2 - 4", "-u*v^2 - 2*v^2 + 4*v", 1.3, 0.7},
      {"cos(u)", "-v - sin(u)*cos(u) - cos(u)", 1.3, 0.7},
      {"sin(2*u)", "-sin(2*v)", 1.3, 0.7},
      {"v", "-4*u^2 - 4*u - v^2", 1.3, 0.7},
      {"v", "-2*v^2 + 3*cos(u + 1)", 1.3, 0.7},
      {"v + 1", "u + v", 1.3, 0.7},
      {"u + v - 1", "-2*u + v - 3", 1.3, 0.7},
      {"v - u^2", "u", 1.3, 0.7},
      {"2*u*v", "-2*v^2 - 1", 1.3, 0.7},
      {"u^2*v - 1", "u*v^2 - 1", 1.3, 0.7},
      {"u^2 + v^2 + 2", "-2*u*v", 1.3, 0.7},
      {"v*sin(u)^2", "1 - v^2*sin(u)*cos(u)", 1.3, 0.7},
      {"1 - 3*u^2*v + 6*v^2", "3*u*v^2 - u", 1.3, 0.7},
      {"v", "-sin(u)", 1.3, 0.7},
      {"u*(1 - v)", "v*(u - 1)", 1.3, 0.7},
      {"u - v - u*(u^2 + v^2)", "u + v - v*(u^2 + v^2)", 1.3, 0.7},
      {"2*u - v - 3", "u + v - 3", 1.3, 0.7},
      {"-2*u + v", "u - 3*v", 1.3, 0.7},
      {"u^2 - v^2", "2*u*v", 1.3, 0.7},
      {"1", "u", 1, 0.5},
      {"v", "u^2", 0.7, 0.4},
      {"v", "1 - exp(u)", 1.3, 0.7},
  };
  int compared = 0;
  std::vector<std::string> forms;
  for (const TypedSystem& system : systems) {
    const answers::FormulaField field = answers::parse_planar_system(system.text(), {});
    const Vector2d around = system.start();
    const reduction::PlanarReduction plane =
        reduction::reduce(field, around, reduction::find_symmetries(field, around));
    INFO(system.text());
    CHECK(plane.solved());
    if (!plane.solved()) continue;
    INFO("solved by '" << plane.form() << "'");
    forms.emplace_back(plane.form());
    for (const Vector2d& start : {Vector2d(0, 0), Vector2d(1e-31, 0)}) {
      INFO("start (" << start[0] << ", 0)");
      const bool has_value = field(start).allFinite(), rests = has_value && field(start).isZero(0);
      if (!has_value) {
        CHECK_THROWS_AS(plane.orbit(start).at(1), std::domain_error);
        continue;
      }
      const reduction::PlanarOrbit orbit = plane.orbit(start);
      double largest = start.norm();
      for (const double time : {1e-3, 0.0, 0.1, 0.5, 1.0}) {  // at 0 an error is compared with the state at 1e-3
        const auto wanted = by_small_steps(field, start, time);
        if (!wanted) break;
        std::optional<Vector2d> state;
        std::string refusal;
        try {
          state = orbit.at(time);
        } catch (const std::domain_error& refused) {
          refusal = refused.what();
        }
        INFO("t = " << time << " " << refusal);
        CHECK(state);
        if (!state) continue;
        largest = std::max(largest, wanted->norm());
        const double error = (*state - *wanted).norm() / (largest > 0 ? largest : 1);
        INFO("state " << state->transpose() << ", not " << wanted->transpose() << ", error " << error);
        CHECK(error <= 1e-11);
        if (!rests && time > 0) CHECK(*state != start);
        ++compared;
      }
    }
  }
  CHECK(compared > 300);
  for (const std::string form : {"scaling", "constant", "affine", "polynomial", "linear in v", "quadratic in v",
                                 "linear in u", "quadratic in u", "product"}) {
    INFO(form);
    CHECK(std::ranges::count(forms, form) > 0);
  }
}

TEST_CASE("orbits that stay beside a pole for ever do not end at it by rounding", "[planar]") {
  // q = a x + b y - c obeys q' = a + b/q and tends to -b/a, so that x and y grow for ever beside q = 0.
  for (int i = 0; i < 12; ++i) {
    const double a = 0.3 + 0.17 * i, b = 1.4 - 0.09 * i, c = 0.5 * (i % 5) - 1;
    const double q = -1.2 * b / a, x = 0.5, y = (q + c - a * x) / b;
    const std::string text = fmt::format("y' = 1/({}*x + {}*y - ({}))", a, b, c);
    INFO(text << ", y(0.5) = " << y);
    const reduction::SmoothField field = answers::parse_planar_system(text, {});
    const Vector2d start(x, y);
    CHECK(reduction::reduce(field, start).orbit(start).end() != reduction::PlanarEnd::border);
  }
}

TEST_CASE("along unstable solutions states have no digits that rounding made", "[planar]") {
  // z = y - a x - b obeys z' = z (c z + d x), so that the rounding of z = 0 grows like exp(d x^2/2).
  for (int i = 0; i < 6; ++i) {
    const double a = 0.4 - 0.3 * i, b = 0.7 * i - 1, c = i % 2 == 0 ? 0.9 : -1.3, d = 1.2 + 0.4 * i;
    const std::string z = fmt::format("(y - ({})*x - ({}))", a, b);
    // The term with the cube has no solution by quadrature.
    const std::string text =
        fmt::format("y' = {} + {}*({}*{} + {}*x{})", a, z, c, z, d, i % 3 == 2 ? "- y*" + z + "^2" : "");
    for (const double x : {1., 3., 6., 9.}) {
      INFO(text << ", x = " << x);
      const Run run = run_program({"orbit", "--system", text, "--x0", "0", "--y0", fmt::format("{}", b), "--at",
                                   fmt::format("{}", x), "--format", "json"});
      CHECK((run.status == 0 || x > 1));
      if (run.status == 0) {
        CHECK(nlohmann::json::parse(run.out)["y"][0].get<double>() == Catch::Detail::Approx(a * x + b).margin(1e-6));
      } else {
        CHECK(run.status == 2);
        CHECK_THAT(run.err, Catch::Matchers::Contains("the orbit is known up to"));
      }
    }
  }
}
