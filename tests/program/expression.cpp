// Expressions are compared with the formulas from which they are made: values, slopes, and the text typed in again.
#include "answers/input/expression.hpp"

#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <catch2/catch.hpp>

#include "answers/input/formulas.hpp"

using namespace contensou::answers;

namespace {

const std::vector<std::string> names{"u", "v"};

Formulas compiled(const std::string& text) {
  return {{{"u'", "v'"}, {"u", "v"}, "a system is \"u' = F; v' = G\""}, "u' = " + text + "; v' = 1", {}};
}
Expression expression(const std::string& text) { return compiled(text).expressions().value()[0]; }
std::string simplified(const std::string& text) { return expression(text).text(names); }

std::string random_text(std::mt19937& random, int depth) {
  const auto one_of = [&](std::initializer_list<const char*> all) {
    return std::string(data(all)[random() % all.size()]);
  };
  const auto part = [&] { return random_text(random, depth - 1); };
  switch (depth == 0 ? random() % 2 : 2 + random() % 5) {
    case 0:
      return one_of({"u", "v"});
    case 1:
      return one_of({"1", "2", "0.5", "3", "(1/3)", "0.7", "u", "v"});
    case 2:
      return fmt::format("{}({})",
                         one_of({"sin", "cos", "tan", "exp", "ln", "sqrt", "abs", "atan", "tanh", "sinh", "cosh",
                                 "asin", "acos", "asinh", "atanh", "sign", "-"}),
                         part());
    case 3:
      return fmt::format("({})^{}", part(), one_of({"2", "3", "(-1)", "(-2)", "0.5", "(3/2)", "(1/3)", "u", "(-1/2)"}));
    default:
      return fmt::format("({} {} {})", part(), one_of({"+", "-", "*", "/", "*"}), part());
  }
}

bool agree(double a, double b, double scale) { return std::abs(a - b) <= 1e-9 * scale; }

}  // namespace

TEST_CASE("a simplified formula has the values and slopes of the typed one, and its text reads back", "[route]") {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> anywhere(-2, 2);
  int compared = 0, sloped = 0;
  for (int i = 0; i < 4000; ++i) {
    const std::string text = random_text(random, 1 + i % 4);
    const Formulas typed = compiled(text);
    const auto both = typed.expressions();
    if (!both) continue;
    const Expression& e = (*both)[0];
    const std::string again = e.text(names);
    INFO(text << " = " << again);
    const Formulas retyped = compiled(again);
    const std::array slopes{e.derivative(0), e.derivative(1)};
    for (int k = 0; k < 4; ++k) {
      const double u = anywhere(random), v = anywhere(random);
      const auto [value, by_u, by_v] = typed.with_slopes(std::array{u, v})[0];
      const double moderate = std::abs(value) + std::abs(by_u) + std::abs(by_v);
      if (!(moderate < 1e4) || !(moderate > 1e-4)) continue;
      INFO("at " << u << ", " << v);
      REQUIRE(agree(e({u, v}), value, 1 + moderate));
      REQUIRE(agree(retyped({u, v})[0], value, 1 + moderate));
      REQUIRE(agree(e.expanded()({u, v}), value, 100 * (1 + moderate)));
      ++compared;
      const double du = slopes[0]({u, v}), dv = slopes[1]({u, v});
      if (!std::isfinite(du) || !std::isfinite(dv)) continue;
      REQUIRE(agree(du, by_u, 1000 * (1 + moderate)));
      REQUIRE(agree(dv, by_v, 1000 * (1 + moderate)));
      ++sloped;
    }
  }
  CHECK(compared > 5000);
  CHECK(sloped > 4900);
}

TEST_CASE("formulas are simplified as on paper", "[table]") {
  CHECK(simplified("u - u") == "0");
  CHECK(simplified("u*v/u") == "v");
  CHECK(simplified("v/u + v/u + 0.5*u - u/3") == "u/6 + 2*v/u");
  CHECK(simplified("(2*u + 2*v)/(u + v)") == "2");
  CHECK(simplified("(1 - u)/(u - 1)") == "-1");
  CHECK(simplified("sqrt(u^2)") == "abs(u)");
  CHECK(simplified("sqrt(4*u^2 + 4)") == "2*sqrt(u^2 + 1)");
  CHECK(simplified("sqrt(12)*u") == "2*sqrt(3)*u");
  CHECK(simplified("exp(u)*exp(-u)*exp(2*ln(v))") == "v^2");
  CHECK(simplified("-exp(-1/u)*exp(u)*u^2") == "-u^2*exp(u - 1/u)");
  CHECK(simplified("1/(2*u*v)") == "1/(2*u*v)");
  CHECK(simplified("-v^2 + 1") == "1 - v^2");
  CHECK(simplified("sin(-u)*tan(atan(v))") == "-v*sin(u)");
  CHECK(expression("(u + v)^2 - u^2 - 2*u*v").expanded().text(names) == "v^2");
  CHECK(expression("0.1 + 0.2").text(names) == "3/10");
  const auto [above, below] = fraction_of(expression("1/u + 1/(u*v)"));
  CHECK(above.text(names) == "v + 1");
  CHECK(below.text(names) == "u*v");
  CHECK(coefficients(expression("(u + v)^2"), 1).value()[1].text(names) == "2*u");
  CHECK_FALSE(coefficients(expression("sin(v)"), 1));
  CHECK_FALSE(compiled("u > 1 ? u : v").expressions());
}
