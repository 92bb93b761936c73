// Kinds of equations, coordinates and solutions as formulas, for the list of Kamke in kamke.csv and for known
// equations. Each kind is checked by its definition without derivatives. The last column of kamke.csv lists the kinds
// that classify_ode of SymPy 1.14 found in at most 40 s; it is "?" for equations that took longer.
#include "answers/equation/equation.hpp"

#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <catch2/catch.hpp>

#include "contensou/reduction/planar_reduction.hpp"

using namespace contensou::answers;
using Eigen::Vector2d;

namespace {

struct Row {
  std::string name, f, g;
  Vector2d start;
  std::string peer;

  FormulaField field() const { return parse_planar_system(fmt::format("u' = {}; v' = {}", f, g), {}); }
};

std::vector<Row> kamke() {
  std::ifstream in(CONTENSOU_PROGRAM_TESTS "/kamke.csv");
  REQUIRE(in);
  std::vector<Row> rows;
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::istringstream cells(line);
    std::array<std::string, 6> cell;
    for (std::string& each : cell) std::getline(cells, each, ',');
    rows.push_back({cell[0], cell[1], cell[2], {std::stod(cell[3]), std::stod(cell[4])}, cell[5]});
  }
  return rows;
}

Steps steps(const FormulaField& field, const Vector2d& start) {
  return steps_of(field, contensou::reduction::find_symmetries(field, start), "", false, start, start);
}

std::vector<std::string> kinds(const std::string& text) {
  const FormulaField field = parse_planar_system(text, {});
  return kinds_of(equation_of(field, {1.3, 0.7}).value());
}

/// Returns true if two functions of random numbers agree wherever both have values.
bool agree(const std::function<std::array<double, 2>(const std::function<double()>& random)>& values) {
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> any(0.3, 1.9);
  const auto random = [&] { return any(engine); };
  int compared = 0;
  for (int i = 0; i < 2000 && compared < 60; ++i) {
    const auto [a, b] = values(random);
    if (!std::isfinite(a) || !std::isfinite(b)) continue;
    if (!(std::abs(a - b) <= 1e-7 * (1e-3 + std::abs(a) + std::abs(b)))) return false;
    ++compared;
  }
  return compared >= 20;
}

/// Returns true if the equation dy/dx = R has the kind, by its definition.
bool holds(const std::string& kind, const std::function<double(double, double)>& R) {
  using Random = std::function<double()>;
  const auto number = [&](std::string_view before) {
    const std::size_t at = kind.find(before) + before.size();
    const std::string text = kind.substr(at, kind.find_first_of(")*", at) - at);
    const std::size_t slash = text.find('/');
    return std::stod(text) / (slash == text.npos ? 1 : std::stod(text.substr(slash + 1)));
  };
  if (kind == "separable") {
    return agree([&](const Random& r) -> std::array<double, 2> {
      const double a = r(), b = r(), c = r(), d = r();
      return {R(a, b) * R(c, d), R(a, d) * R(c, b)};
    });
  }
  if (kind == "linear" || kind == "Riccati") {
    return agree([&](const Random& r) -> std::array<double, 2> {
      const double x = r(), y = r(), h = r() / 4;
      if (kind == "linear") return {R(x, y + h) + R(x, y - h), 2 * R(x, y)};
      return {R(x, y + 3 * h) + 3 * R(x, y + h), 3 * R(x, y + 2 * h) + R(x, y)};
    });
  }
  if (kind.starts_with("Bernoulli")) {
    const double n = number("n = ");
    return agree([&](const Random& r) -> std::array<double, 2> {
      const double x = r(), a = r(), b = r(), c = r();
      const double A = std::pow(a, n), B = std::pow(b, n), D = a * B - b * A;
      const double p = (R(x, a) * B - R(x, b) * A) / D, q = (a * R(x, b) - b * R(x, a)) / D;
      return {std::abs(D) < 1e-2 ? std::nan("") : R(x, c), p * c + q * std::pow(c, n)};
    });
  }
  if (kind == "homogeneous") {
    return agree([&](const Random& r) -> std::array<double, 2> {
      const double x = r(), y = r(), s = r();
      return {R(x, y), R(s * x, s * y)};
    });
  }
  if (kind.starts_with("isobaric")) {
    const std::string_view of_v = "v -> a";
    double m = 0;
    if (kind.find(of_v) != kind.npos)
      m = kind.find("v -> a*") != kind.npos                ? 1
          : kind.find("a^(", kind.find(of_v)) != kind.npos ? number("a^(")
                                                           : number("a^");
    return agree([&](const Random& r) -> std::array<double, 2> {
      const double x = r(), y = r(), s = r();
      return {R(s * x, std::pow(s, m) * y), std::pow(s, m - 1) * R(x, y)};
    });
  }
  if (kind.starts_with("shift") || kind == "autonomous") {
    const double c = kind == "autonomous" ? 0 : number("(1, ");
    return agree([&](const Random& r) -> std::array<double, 2> {
      const double x = r(), y = r(), s = r();
      return {R(x, y), R(x + s, y + c * s)};
    });
  }
  return true;
}

}  // namespace

TEST_CASE("each kind of equation that is named holds by its definition", "[symmetry]") {
  int undecided = 0;
  for (const Row& row : kamke()) {
    const FormulaField field = row.field();
    const auto equation = equation_of(field, row.start);
    REQUIRE(equation);
    std::vector<std::string> found = kinds_of(*equation);
    for (std::string& kind : found) {
      if (kind.starts_with(of_orbits)) kind.erase(0, of_orbits.size());
    }
    const auto R = [&](double x, double y) {
      const Vector2d f = field({x, y});
      return f[1] / f[0];
    };
    INFO(row.name << ": v' = (" << row.g << ")/(" << row.f << "): " << fmt::format("{}", fmt::join(found, "; ")));
    for (const std::string& kind : found) {
      INFO(kind);
      CHECK(holds(kind, R));
    }
    undecided += row.peer == "?";
    const std::array<std::string, 3> theirs{"separable", "1st_linear", "1st_homogeneous_coeff_best"};
    const std::array<std::string, 3> ours{"separable", "linear", "homogeneous"};
    for (std::size_t i = 0; i < 3; ++i) {
      if ((" " + row.peer + " ").find(" " + theirs[i] + " ") == std::string::npos) continue;
      INFO("SymPy: " << theirs[i]);
      CHECK(std::count(found.begin(), found.end(), ours[i]) == 1);
    }
  }
  WARN("without an answer of SymPy: " << undecided);
}

TEST_CASE("kinds hold by their definitions for starts next to the origin and far from it, too", "[symmetry]") {
  for (const Row& row : kamke()) {
    const FormulaField field = row.field();
    const auto R = [&](double x, double y) {
      const Vector2d f = field({x, y});
      return f[1] / f[0];
    };
    for (const double size : {1e-6, 1e5}) {
      const auto equation = equation_of(field, size * row.start);
      REQUIRE(equation);
      for (std::string kind : kinds_of(*equation)) {
        if (kind.starts_with(of_orbits)) kind.erase(0, of_orbits.size());
        INFO(row.name << ": v' = (" << row.g << ")/(" << row.f << "), start times " << size << ": " << kind);
        CHECK(holds(kind, R));
      }
    }
  }
}

TEST_CASE("formulas of H are constant along orbits, and their texts read back", "[invariant]") {
  int solved = 0, separated = 0;
  for (const Row& row : kamke()) {
    const FormulaField field = row.field();
    const Steps found = steps(field, row.start);
    INFO(row.name << ": u' = " << row.f << "; v' = " << row.g);
    separated += found.coordinates.has_value();
    if (!found.integral) continue;
    ++solved;
    const std::string text = found.text(found.integral->H);
    INFO("H = " << text);
    const Formulas H({{}, {"u", "v"}, "H"}, text, {});
    std::mt19937 engine(5);
    std::uniform_real_distribution<double> size(0.5, 2);
    int compared = 0;
    for (int i = 0; i < 400; ++i) {
      const Vector2d x(row.start[0] * size(engine), row.start[1] * size(engine)), f = field(x);
      const auto [value, by_u, by_v] = H.with_slopes(std::array{x[0], x[1]})[0];
      const double terms = std::abs(f[0] * by_u) + std::abs(f[1] * by_v);
      if (!std::isfinite(terms) || !std::isfinite(value)) continue;
      CHECK(std::abs(f[0] * by_u + f[1] * by_v) <= 1e-9 * terms + 1e-12);
      ++compared;
    }
    CHECK(compared >= 20);
  }
  CHECK(solved >= 160);
  CHECK(separated >= 100);
}

TEST_CASE("kinds, coordinates and H of a field that jumps hold across the jump, wherever it lies", "[symmetry]") {
  std::mt19937_64 random(12);
  const auto among = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  const std::vector<std::string> factors{"1", "v", "u", "v/u", "sqrt(abs(v))", "(u + v)", "v^2"};
  const std::vector<std::string> curves{"{0}*u + v - {1}", "v - u^2*{0}",     "u - {1}",   "v - {1}",
                                        "u*v - {1}",       "u^2 + v^2 - {1}", "v - {0}*u", "u"};
  int named = 0, reduced = 0, solved = 0;
  for (const bool as_kink : {false, true}) {
    for (const std::string& factor : factors) {
      for (const std::string& curve : curves) {
        const double a = among(0.6, 1.6), c = among(0, 1) < 0.3 ? among(15, 25) : among(0.8, 1.6);
        const std::string z = fmt::format(fmt::runtime(curve), std::rint(100 * a) / 100, std::rint(100 * c) / 100);
        const std::string text = fmt::format("dv/du = {}*{}({})", factor, as_kink ? "abs" : "sign", z);
        const FormulaField field = parse_planar_system(text, {});
        const Vector2d start(among(0.5, 1.5), among(0.5, 1.5));
        const auto equation = equation_of(field, start);
        REQUIRE(equation);
        const Steps found = steps(field, start);
        INFO(text << ": " << fmt::format("{}", fmt::join(found.kinds, "; ")) << "; from " << start.transpose());
        for (const std::string& kind : found.kinds) {
          INFO(kind);
          // Only these kinds stay the same if the plane is shifted.
          const bool shifts = kind == "separable" || kind == "linear" || kind == "autonomous" || kind == "Riccati";
          for (const double there : {0., c - 1, c - 1.4}) {
            if (there != 0 && !shifts) continue;
            CHECK(holds(kind, [&](double x, double y) { return field({x + there, y})[1]; }));
            CHECK(holds(kind, [&](double x, double y) { return field({x, y + there})[1]; }));
            ++named;
          }
        }
        if (found.coordinates) {
          const Coordinates& k = *found.coordinates;
          const auto rate = [&](const Expression& e) { return e.derivative(0) + equation->slope * e.derivative(1); };
          const Expression of_q = rate(k.q), of_p = rate(k.p);
          INFO(found.separated());
          for (int i = 0; i < 200; ++i) {
            const double reach = i % 2 == 0 ? 2 : c + 2, x = among(-reach, reach), y = among(-reach, reach);
            if (!equation->contains(k.within, {x, y})) continue;
            const double q = of_q({x, y}), p = of_p({x, y}), at = k.q({x, y});
            const double error = k.dq_dp ? q - (*k.dq_dp)({0, 0, at}) * p : p - (*k.dp_dq)({0, 0, at}) * q;
            if (std::isfinite(error)) CHECK(std::abs(error) <= 1e-9 * (1 + std::abs(q) + std::abs(p)));
          }
          ++reduced;
        }
        if (found.integral) {
          INFO("H = " << found.text(found.integral->H) << " for " << found.where());
          const Expression& H = found.integral->H;
          const FormulaField border = parse_planar_system("dv/du = " + z, {});
          for (int i = 0; i < 20; ++i) {
            const Vector2d from(i % 4 == 0 ? c - 0.2 : among(-2, 2), i % 4 == 1 ? c - 0.2 : among(-2, 2));
            const auto orbit = contensou::reduction::by_steps(contensou::reduction::SmoothField(field)).orbit(from);
            double before = H({from[0], from[1]});
            for (double time = 0.1; time < 0.6; time += 0.1) {
              try {
                const Vector2d x = orbit.at(time);
                const bool slides = std::abs(border(x)[1]) < 1e-9;
                const bool crosses_pole = factor == "v/u" && x[0] * from[0] <= 0;
                if (slides || crosses_pole || !found.holds_at(x) || !found.holds_at(from)) break;
                const double now = H({x[0], x[1]});
                if (std::isfinite(now) && std::isfinite(before) && std::abs(now) < 1e3)
                  CHECK(std::abs(now - before) <= 1e-6 * (1 + std::abs(now)));
              } catch (const std::domain_error&) {
                break;  // the orbit is not followed so far
              }
            }
          }
          ++solved;
        }
      }
    }
  }
  CHECK(named >= 100);
  CHECK(reduced >= 40);
  CHECK(solved >= 30);
}

TEST_CASE("C of a start at a jump is that of the motion from there", "[invariant]") {
  std::mt19937_64 random(4);
  const auto among = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  for (int i = 0; i < 10; ++i) {
    const double friction = among(0.05, 0.3), x0 = (i % 2 == 0 ? 1 : -1) * among(0.5, 3);
    const FormulaField field = parse_planar_system(fmt::format("x'' = -x - {}*sign(x')", friction), {});
    const Vector2d start(x0, 0);
    const Steps found = steps(field, start);
    REQUIRE(found.integral);
    const auto plane = contensou::reduction::reduce(field, start);
    // The motion turns back, so that friction acts along x0.
    const double C = found.constant(start, [&] { return plane.orbit(start); });
    CHECK(C == Approx(x0 * x0 / 2 - friction * std::abs(x0)).epsilon(1e-13));
    const Vector2d later = plane.orbit(start).at(1);
    CHECK(found.integral->H({later[0], later[1]}) == Approx(C).epsilon(1e-9));
    // Motions cross x' = 0, where this H jumps.
    CHECK(found.where() == (x0 > 0 ? "x' < 0" : "x' > 0"));
    CHECK(found.jumps().empty());
    // The body stays at the jump if the force of the spring is less than friction.
    const Vector2d rest(friction / 2, 0);
    CHECK(std::isnan(found.constant(rest, [&] { return plane.orbit(rest); })));
  }
}

TEST_CASE("known equations have the kinds of a textbook, and no others", "[table]") {
  struct Known {
    std::string text;
    std::vector<std::string> kinds;
  };
  const std::vector<Known> all{
      {"y' = x*y", {"separable", "linear", "integrating factor of x", "integrating factor of y"}},
      {"y' = x - y", {"linear", "shift along a direction (1, 1)", "integrating factor of x"}},
      {"y' = y/x + tan(y/x)", {"homogeneous"}},
      {"y' = 2*y/x + x^2*y^3", {"Bernoulli (n = 3)", "isobaric (x -> a*x, y -> a^(-3/2)*y)"}},
      {"y' = x^2 + y^2", {"Riccati"}},
      {"y' = -(2*x*y + 3)/(x^2 + 4*y)", {"exact"}},
      {"y' = -(3*x*y + y^2)/(x^2 + x*y)", {"homogeneous", "integrating factor of x"}},
      {"y' = -y/(2*x - y*exp(y))", {"integrating factor of y"}},
      {"y' = sin(y)", {"autonomous", "separable", "integrating factor of y"}},
      {"y' = |y|", {"autonomous", "separable", "integrating factor of y"}},
      {"y' = cos(x + y)", {"shift along a direction (1, -1)"}},
      {"x'' = -sin(x)", {"autonomous", "conservative", "Hamiltonian"}},
      {"x'' = -x - 0.2*sign(x')", {"autonomous"}},
      {"x'' = x'^2/x", {"autonomous"}},
      {"x'' = -sign(x)", {"autonomous", "conservative", "Hamiltonian", "isobaric (x -> a*x, x' -> a^(1/2)*x')"}},
      {"x' = sign(y); y' = -sign(x)", {"Hamiltonian", "orbits: separable", "orbits: homogeneous"}},
      {"y' = sign(0.5-y)", {"autonomous", "separable"}},
      {"x'' = -x - 0.2*x'", {"autonomous", "linear of the second order", "isobaric (x -> a*x, x' -> a*x')"}},
      {"x' = y; y' = -sin(x)", {"conservative", "Hamiltonian", "orbits: separable", "orbits: Bernoulli (n = -1)"}},
      {"x' = -y + x*(1 - x^2 - y^2); y' = x + y*(1 - x^2 - y^2)", {"orbits: rotation"}},
      {"x' = 2*x*y; y' = x^2 + y^3", {"gradient"}},
      {"y' = sin(x*y) + x", {}},
      {"y' = pi*y", {"autonomous", "separable", "linear", "integrating factor of x", "integrating factor of y"}},
      {"y' = sign(x)*y", {"separable", "linear", "integrating factor of x", "integrating factor of y"}},
      {"x' = -sign(x); y' = -y",
       {"gradient", "orbits: separable", "orbits: linear", "orbits: integrating factor of x",
        "orbits: integrating factor of y"}},
  };
  for (const auto& [text, expected] : all) {
    INFO(text);
    CHECK(kinds(text) == expected);
  }
}
