// Formulas are compared with trees that need no text for their values, and with differences of 33 digits.
#include "answers/input/formulas.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <catch2/catch.hpp>

#include "answers/asked/planar_system.hpp"
#include "answers/input/errors.hpp"

using namespace contensou::answers;
using Catch::Matchers::Contains;

namespace {

Formulas formulas(const std::string& text) {
  return {{{"u'", "v'"}, {"u", "v"}, "a system is \"u' = F; v' = G\""}, text, {}};
}
Dual<2> slopes(const std::string& formula, double u, double v) {
  const Formulas compiled = formulas("u' = " + formula + "; v' = 1");
  const Dual<2> result = compiled.with_slopes(std::array{u, v})[0];
  const double value = compiled({u, v})[0];
  CHECK((value == result[0] || (std::isnan(value) && std::isnan(result[0]))));
  return result;
}
double value(const std::string& formula, double u = 0.3, double v = -1.7) { return slopes(formula, u, v)[0]; }
std::string mistake(const std::string& formula) {
  try {
    formulas("u' = " + formula + "; v' = 1");
  } catch (const BadInput& error) {
    return error.what();
  }
  return "none";
}
void check_mistake(const std::string& formula, const std::string& words, std::size_t character) {
  INFO(formula);
  CHECK_THAT(mistake(formula), Contains(words) && Contains(fmt::format(", at character {} of 'u' = ", character)));
}

using Random = std::mt19937_64;
std::size_t below(Random& random, std::size_t count) { return static_cast<std::size_t>(random() % count); }
double between(Random& random, double from, double to) {
  return from + (to - from) * static_cast<double>(random() >> 11) * 0x1p-53;
}

/// A function of one number, and its derivative in long double by other identities than those of the library.
struct Known {
  std::string name;
  std::function<double(double)> value;
  std::function<long double(long double)> slope;
};
const std::vector<Known>& known() {
  using std::cos, std::sqrt, std::exp, std::sin;
  using Long = long double;
  constexpr Long ln10 = std::numbers::ln10_v<Long>, ln2 = std::numbers::ln2_v<Long>;
  static const std::vector<Known> all{
      {"sin", [](double x) { return std::sin(x); }, [](Long x) { return cos(x); }},
      {"cos", [](double x) { return std::cos(x); }, [](Long x) { return -sin(x); }},
      {"tan", [](double x) { return std::tan(x); }, [](Long x) { return 1 / (cos(x) * cos(x)); }},
      {"asin", [](double x) { return std::asin(x); }, [](Long x) { return 1 / sqrt(1 - x * x); }},
      {"acos", [](double x) { return std::acos(x); }, [](Long x) { return -1 / sqrt(1 - x * x); }},
      {"atan", [](double x) { return std::atan(x); }, [](Long x) { return 1 / (1 + x * x); }},
      {"sinh", [](double x) { return std::sinh(x); }, [](Long x) { return (exp(x) + exp(-x)) / 2; }},
      {"cosh", [](double x) { return std::cosh(x); }, [](Long x) { return (std::expm1(x) - std::expm1(-x)) / 2; }},
      {"tanh", [](double x) { return std::tanh(x); }, [](Long x) { return 4 / (2 + exp(2 * x) + exp(-2 * x)); }},
      {"asinh", [](double x) { return std::asinh(x); }, [](Long x) { return 1 / sqrt(1 + x * x); }},
      {"acosh", [](double x) { return std::acosh(x); }, [](Long x) { return 1 / std::sinh(std::acosh(x)); }},
      {"atanh", [](double x) { return std::atanh(x); }, [](Long x) { return 1 / (1 - x * x); }},
      {"exp", [](double x) { return std::exp(x); }, [](Long x) { return exp(x); }},
      {"sqrt", [](double x) { return std::sqrt(x); }, [](Long x) { return std::pow(x, -0.5L) / 2; }},
      {"ln", [](double x) { return std::log(x); }, [](Long x) { return 1 / x; }},
      {"log", [](double x) { return std::log(x); }, [](Long x) { return 1 / x; }},
      {"log2", [](double x) { return std::log2(x); }, [=](Long x) { return 1 / (x * ln2); }},
      {"log10", [](double x) { return std::log10(x); }, [=](Long x) { return 1 / (x * ln10); }},
      {"rint", [](double x) { return std::nearbyint(x); }, [](Long) { return 0.0L; }},
      {"sign", [](double x) { return x == 0 || std::isnan(x) ? x : std::copysign(1, x); }, [](Long) { return 0.0L; }},
      {"abs", [](double x) { return x < 0    ? -x
                                    : x == 0 ? 0
                                             : x; }, [](Long x) { return x < 0 ? -1.0L : 1.0L; }},
      {"-", [](double x) { return -x; }, [](Long) { return -1.0L; }},
      {"!", [](double x) { return x != 0 || std::isnan(x) ? 0 : 1; }, [](Long) { return 0.0L; }},
  };
  return all;
}

struct Result {
  double value;
  std::array<long double, 2> slopes{}, scales{};  ///< derivatives by u and v; sums of the sizes of their terms
  std::array<bool, 2> depends{};
  bool moderate = true;  ///< true while no derivative is tiny, huge or missing

  void add(const Result& operand, long double by) {
    for (std::size_t i : {0U, 1U}) {
      if (!operand.depends[i]) continue;
      depends[i] = true;
      slopes[i] += by * operand.slopes[i];
      scales[i] += std::fabs(by) * operand.scales[i];
    }
    const bool depends_at_all = operand.depends[0] || operand.depends[1];
    const long double size = std::fabs(by);
    moderate = moderate && operand.moderate && (!depends_at_all || size == 0 || (size > 1e-60L && size < 1e60L));
  }
};

struct Tree {
  std::string op;  ///< a name of known(), an operator, a function of several numbers, "u", "v", or "" for a number
  double number = 0;
  std::vector<Tree> parts = {};

  Result at(double u, double v) const {
    if (op == "u") return {u, {1, 0}, {1, 0}, {true, false}};
    if (op == "v") return {v, {0, 1}, {0, 1}, {false, true}};
    if (parts.empty()) return {number};
    Result result = parts[0].at(u, v);
    if (op == "?") {
      Result chosen = parts[result.value != 0 ? 1 : 2].at(u, v);
      const Result other = parts[result.value != 0 ? 2 : 1].at(u, v);
      chosen.moderate = chosen.moderate && result.moderate && other.moderate;
      for (std::size_t i : {0U, 1U}) chosen.depends[i] = true;
      return chosen;
    }
    for (const Known& function : known()) {
      if (function.name != op) continue;
      Result next{function.value(result.value)};
      next.add(result, function.slope(result.value));
      return next;
    }
    for (std::size_t i = 1; i < parts.size(); ++i) {
      const Result other = parts[i].at(u, v);
      const double x = result.value, y = other.value;
      const long double a = x, b = y;
      Result next{0};
      const auto become = [&](double value, long double by_x, long double by_y) {
        next.value = value;
        next.add(result, by_x);
        next.add(other, by_y);
      };
      if (op == "+" || op == "sum" || op == "avg") become(x + y, 1, 1);
      if (op == "-2") become(x - y, 1, -1);
      if (op == "*") become(x * y, b, a);
      if (op == "/") become(x / y, 1 / b, -a / (b * b));
      if (op == "hypot") become(std::hypot(x, y), a / std::hypot(a, b), b / std::hypot(a, b));
      if (op == "atan2") become(std::atan2(x, y), b / (a * a + b * b), -a / (a * a + b * b));
      if (op == "min") become(y < x ? y : x, y < x ? 0 : 1, y < x ? 1 : 0);
      if (op == "max") become(x < y ? y : x, x < y ? 0 : 1, x < y ? 1 : 0);
      if (op == "^") {
        const double power = y == 2 ? x * x : std::pow(x, y);
        const long double by_y = a == 0 && b > 0 ? 0 : std::pow(a, b) * std::log(a);
        become(power, b == 0 ? 0 : b * std::pow(a, b - 1), by_y);
      }
      if (op == "<") become(x < y, 0, 0);
      if (op == ">") become(x > y, 0, 0);
      if (op == "<=") become(x <= y, 0, 0);
      if (op == ">=") become(x >= y, 0, 0);
      if (op == "==") become(x == y, 0, 0);
      if (op == "!=") become(x != y, 0, 0);
      if (op == "&&") become(x != 0 && y != 0, 0, 0);
      if (op == "||") become(x != 0 || y != 0, 0, 0);
      result = next;
    }
    if (op == "avg") {
      Result next{result.value / static_cast<double>(parts.size())};
      next.add(result, 1.0L / static_cast<long double>(parts.size()));
      return next;
    }
    return result;
  }
};

Tree random_tree(Random& random, int depth) {
  const auto some = [&](std::size_t count) {
    std::vector<Tree> parts;
    while (parts.size() < count) parts.push_back(random_tree(random, depth - 1));
    return parts;
  };
  switch (depth <= 0 ? below(random, 4) : 3 + below(random, 10)) {
    case 0:
      return {"", static_cast<double>(below(random, 5)) / 2};
    case 1:
      return {"", std::stod(fmt::format("{:.3g}", std::exp(between(random, -7, 7))))};
    case 2:
    case 3:
      return {below(random, 2) == 0 ? "u" : "v"};
    case 4:
    case 5:
      return {known()[below(random, known().size())].name, 0, some(1)};
    case 6: {
      static const std::vector<std::string> names{"<", ">", "<=", ">=", "==", "!=", "&&", "||"};
      return {names[below(random, names.size())], 0, some(2)};
    }
    case 7: {
      static const std::vector<std::string> names{"min", "max", "sum", "avg"};
      return {names[below(random, names.size())], 0, some(2 + below(random, 3))};
    }
    case 8:
      return {"?", 0, some(3)};
    case 9:
      return {below(random, 2) == 0 ? "hypot" : "atan2", 0, some(2)};
    default: {
      static const std::vector<std::string> names{"+", "-2", "*", "/", "^"};
      return {names[below(random, names.size())], 0, some(2)};
    }
  }
}

/// Writes a tree as a user would: with all necessary and some unnecessary brackets, and with blanks anywhere.
class Typist {
 public:
  explicit Typist(Random& random) : random_(random) {}

  /// @param level    operators that bind less tightly than this level need brackets
  std::string operator()(const Tree& tree, int level = 0, bool in_bars = false) {
    const int own = level_of(tree);
    if (own < level || (in_bars && tree.op == "||") || below(random_, 8) == 0) {
      return "(" + blank() + body(tree, own, false) + blank() + ")";
    }
    return body(tree, own, in_bars);
  }

 private:
  static int level_of(const Tree& tree) {
    const std::string& op = tree.op;
    if (op == "?") return 0;
    if (op == "||") return 1;
    if (op == "&&") return 2;
    if (op[0] == '<' || op[0] == '>' || op[0] == '=' || op == "!=") return 3;
    if (op == "+" || op == "-2") return 4;
    if (op == "*" || op == "/") return 5;
    if (op == "-" || op == "!") return 6;
    return op == "^" ? 7 : 8;
  }

  std::string blank() { return std::array{"", "", "", " ", "  ", "\t"}[below(random_, 6)]; }

  std::string body(const Tree& tree, int own, bool in_bars) {
    const auto& [op, number, parts] = tree;
    if (op.empty()) return fmt::format("{}", number);
    if (parts.empty()) return op;
    if (op == "?") {
      return (*this)(parts[0], 1, in_bars) + blank() + "?" + blank() + (*this)(parts[1]) + blank() + ":" + blank() +
             (*this)(parts[2], 0, in_bars);
    }
    if (own == 6) return op + blank() + (*this)(parts[0], 6, in_bars);
    if (op == "^") {
      const std::string sign = below(random_, 2) == 0 ? "^" : "**";
      return (*this)(parts[0], 8, in_bars) + blank() + sign + blank() + (*this)(parts[1], 6, in_bars);
    }
    if (own < 6) {
      const std::string sign = op == "-2" ? "-" : op;
      return (*this)(parts[0], own, in_bars) + blank() + sign + blank() + (*this)(parts[1], own + 1, in_bars);
    }
    if (op == "abs" && below(random_, 3) > 0) return "|" + blank() + (*this)(parts[0], 0, true) + blank() + "|";
    std::string text = op + blank() + "(";
    for (const Tree& part : parts) text += (&part == &parts[0] ? "" : ",") + blank() + (*this)(part) + blank();
    return text + ")";
  }

  Random& random_;
};

}  // namespace

TEST_CASE("the common denominator of formulas", "[formula]") {
  const Eigen::Vector2d x(1.3, 0.7);
  const auto denominator = [&](const std::string& text) {
    const contensou::reduction::SmoothField field = contensou::answers::parse_planar_system(text, {});
    return field.denominator ? field.denominator(x) : Eigen::RowVector3d(1, 0, 0);
  };
  const auto is = [](const Eigen::RowVector3d& found, double value, double by_u, double by_v) {
    return (found - Eigen::RowVector3d(value, by_u, by_v)).norm() < 1e-14;
  };
  const double u = x[0], v = x[1];
  CHECK(is(denominator("y' = y/x"), u, 1, 0));
  CHECK(is(denominator("y' = (x+y)/(x-y)^2 + 1/(x-y)"), (u - v) * (u - v), 2 * (u - v), -2 * (u - v)));
  CHECK(is(denominator("u' = 1/(u*v); v' = -u/v"), u * v, v, u));
  CHECK(is(denominator("y' = 1/(1 + 1/x)"), u + 1, 1, 0));
  CHECK(is(denominator("y' = x^-2*y + (2/x)^3"), u * u * u, 3 * u * u, 0));
  CHECK(is(denominator("y' = x/(y/(x+1))"), v, 0, 1));
  CHECK(is(denominator("y' = y/2 + sin(1/x)*x"), 1, 0, 0));
}

TEST_CASE("20 000 random formulas have the values of their trees, to the last bit, and their slopes", "[formulas]") {
  Random random(20260711);
  Typist typed(random);
  int numbers = 0, slopes_compared = 0;
  for (int n = 0; n < 20000; ++n) {
    const Tree tree = random_tree(random, 1 + static_cast<int>(below(random, 4)));
    const std::string text = typed(tree);
    const double u = below(random, 12) == 0 ? 0 : between(random, -3, 3);
    const double v = below(random, 12) == 0 ? 1 : between(random, -3, 3);
    const Result wanted = tree.at(u, v);
    const Formulas compiled = formulas("v' = 2; u' = " + text);
    const Dual<2> got = compiled.with_slopes(std::array{u, v})[0];
    const double plain = compiled({u, v})[0];
    if (std::isnan(wanted.value)) {
      if (std::isnan(plain) && std::isnan(got[0]) && std::isnan(got[1]) && std::isnan(got[2])) continue;
    } else {
      numbers += 1;
      const auto bits = std::bit_cast<std::uint64_t>(wanted.value);
      bool equal = std::bit_cast<std::uint64_t>(plain) == bits && std::bit_cast<std::uint64_t>(got[0]) == bits;
      if (wanted.moderate) {
        slopes_compared += 1;
        for (std::size_t i : {0U, 1U}) {
          equal = equal && std::fabs(got[i + 1] - wanted.slopes[i]) <= 1e-13L * wanted.scales[i];
        }
      }
      if (equal) continue;
    }
    CAPTURE(text, u, v, plain, got[0], wanted.value, got[1], wanted.slopes[0], got[2], wanted.slopes[1]);
    FAIL("not the tree's");
  }
  CHECK(numbers > 12000);
  CHECK(slopes_compared > 10000);
}

TEST_CASE("slopes of every function and operator are differences in 33 digits", "[formulas]") {
  using Quad = boost::multiprecision::cpp_bin_float_quad;
  using Function = std::function<Quad(const Quad&, const Quad&)>;
  struct Row {
    std::string formula;
    Function function;
    double u, v;
  };
  const std::vector<Row> rows{
      {"sin(u)", [](const Quad& x, const Quad&) { return sin(x); }, 1.3, 1},
      {"cos(u)", [](const Quad& x, const Quad&) { return cos(x); }, 1.3, 1},
      {"tan(u)", [](const Quad& x, const Quad&) { return tan(x); }, 1.3, 1},
      {"asin(u)", [](const Quad& x, const Quad&) { return asin(x); }, 0.999, 1},
      {"acos(u)", [](const Quad& x, const Quad&) { return acos(x); }, -0.75, 1},
      {"atan(u)", [](const Quad& x, const Quad&) { return atan(x); }, 1.3, 1},
      {"sinh(u)", [](const Quad& x, const Quad&) { return sinh(x); }, -1.3, 1},
      {"cosh(u)", [](const Quad& x, const Quad&) { return cosh(x); }, 1.3, 1},
      {"tanh(u)", [](const Quad& x, const Quad&) { return tanh(x); }, 12.5, 1},
      {"asinh(u)", [](const Quad& x, const Quad&) { return Quad(log(x + sqrt(x * x + 1))); }, 1e-5, 1},
      {"acosh(u)", [](const Quad& x, const Quad&) { return Quad(log(x + sqrt(x * x - 1))); }, 1.01, 1},
      {"atanh(u)", [](const Quad& x, const Quad&) { return Quad(log((1 + x) / (1 - x)) / 2); }, 0.99, 1},
      {"exp(u)", [](const Quad& x, const Quad&) { return exp(x); }, 1.3, 1},
      {"sqrt(u)", [](const Quad& x, const Quad&) { return sqrt(x); }, 1.3, 1},
      {"ln(u)", [](const Quad& x, const Quad&) { return log(x); }, 1.3, 1},
      {"log(u)", [](const Quad& x, const Quad&) { return log(x); }, 0.3, 1},
      {"log2(u)", [](const Quad& x, const Quad&) { return Quad(log(x) / log(Quad(2))); }, 1.3, 1},
      {"log10(u)", [](const Quad& x, const Quad&) { return log10(x); }, 1.3, 1},
      {"|u|", [](const Quad& x, const Quad&) { return fabs(x); }, -1.3, 1},
      {"rint(u) + sign(v)", [](const Quad&, const Quad&) { return Quad(2); }, 1.3, 2},
      {"-u - v", [](const Quad& x, const Quad& y) { return Quad(-x - y); }, 1.3, 2.2},
      {"u*v", [](const Quad& x, const Quad& y) { return Quad(x * y); }, 1.3, 2.2},
      {"u/v", [](const Quad& x, const Quad& y) { return Quad(x / y); }, 1.3, 2.2},
      {"u^v", [](const Quad& x, const Quad& y) { return pow(x, y); }, 1.3, -2.2},
      {"u^2*v^3", [](const Quad& x, const Quad& y) { return Quad(x * x * y * y * y); }, -1.3, -2.2},
      {"hypot(u, v)", [](const Quad& x, const Quad& y) { return sqrt(Quad(x * x + y * y)); }, 1.3, -2.2},
      {"atan2(u, v)", [](const Quad& x, const Quad& y) { return atan2(x, y); }, 1.3, -2.2},
      {"min(3, u, v)", [](const Quad&, const Quad& y) { return y; }, 1.3, -2.2},
      {"max(-3, u, v)", [](const Quad& x, const Quad&) { return x; }, 1.3, -2.2},
      {"sum(u, v, u)", [](const Quad& x, const Quad& y) { return Quad(2 * x + y); }, 1.3, -2.2},
      {"avg(u, v, u)", [](const Quad& x, const Quad& y) { return Quad((2 * x + y) / 3); }, 1.3, -2.2},
      {"u > v ? u*v : u/v", [](const Quad& x, const Quad& y) { return Quad(x * y); }, 1.3, -2.2},
  };
  for (const auto& [formula, function, u, v] : rows) {
    CAPTURE(formula);
    const Dual<2> got = slopes(formula, u, v);
    const auto difference = [&, &function = function, u = u, v = v](int by) {
      const auto at = [&](int steps) {
        const Quad h = ldexp(Quad(steps), -24);
        return by == 0 ? function(u + h, v) : function(u, v + h);
      };
      return Quad(ldexp(Quad(8 * (at(1) - at(-1)) - (at(2) - at(-2))), 24) / 12).convert_to<double>();
    };
    CHECK(got[1] == Approx(difference(0)).epsilon(1e-13).margin(1e-20));
    CHECK(got[2] == Approx(difference(1)).epsilon(1e-13).margin(1e-20));
  }
}

TEST_CASE("slopes at kinks and at the ends of functions", "[formulas]") {
  const double infinity = std::numeric_limits<double>::infinity();
  const auto check = [](const std::string& formula, double u, double v, double by_u, double by_v) {
    CAPTURE(formula, u, v);
    const Dual<2> got = slopes(formula, u, v);
    CHECK((got[1] == by_u || (std::isnan(got[1]) && std::isnan(by_u))));
    CHECK((got[2] == by_v || (std::isnan(got[2]) && std::isnan(by_v))));
  };
  check("|u|*v", 0, 3, 3, 0);
  check("max(u, v) + 2*min(u, v)", 1, 1, 3, 0);
  check("u < v ? 5*u : 7*v", 1, 1, 0, 7);
  check("u^0", 0, 1, 0, 0);
  check("u^1", 0, 1, 1, 0);
  check("u^2", 0, 1, 0, 0);
  check("u^3", 0, 1, 0, 0);
  check("u^3", -2, 1, 12, 0);
  check("u^-1", -2, 1, -0.25, 0);
  check("u^0.5", 0, 1, infinity, 0);
  check("u^v", 0, 3, 0, 0);
  check("u^v", -2, 3, 12, NAN);
  check("2^v", 1, 0, 0, std::numbers::ln2);
  check("sqrt(u) + v", 0, 1, infinity, 1);
  check("sqrt(u*u)", 0, 1, NAN, 0);
  check("hypot(u, v)", 0, 0, NAN, NAN);
  check("ln(u)", -1, 1, NAN, NAN);
  check("u > 0 ? ln(u) : v", -1, 1, 0, 1);
}

TEST_CASE("functions and conditions have one meaning: rint, &&, ||, !, signs, asinh", "[formulas]") {
  const std::vector<std::pair<std::string, double>> rows{
      {"rint(0.5)", 0},
      {"rint(2.5)", 2},
      {"rint(-1.5)", -2},
      {"0.5 && 0.5", 1},
      {"0 && 1", 0},
      {"0 || 0.1", 1},
      {"(u < 0) || (v > 0)", 0},
      {"|u| || |v|", 1},
      {"!0.5", 0},
      {"!0 + 1", 2},
      {"--u", 0.3},
      {"u--v", 0.3 + -1.7},
      {"2^-1^2", 0.5},
      {"2^3^2", 512},
      {"2**3**2", 512},
      {"-u^2", -(0.3 * 0.3)},
      {"-3^2", -9},
      {"2*-3", -6},
      {"1 < 2 == 1", 1},
      {"1 + 1 < 3 && 2 > 1", 1},
      {".5 + 5. + 1e-3 + 1E+2", 105.501},
      {"||v|*u|", 0.3 * 1.7},
      {"|u*|v||", 0.3 * 1.7},
      {"||u| - |v||", 1.4},
      {"|(u < 0 || v < 0)|", 1},
      {"asinh(1e-5)", std::asinh(1e-5)},
      {"0 ? 1 : 0 ? 2 : 3", 3},
      {"1 ? 0 ? 1 : 2 : 3", 2},
      {"pi", std::numbers::pi},
      {"sign(0) + sign(-2)", -1},
      {"log(2) - ln(2)", 0},
      {"min(3) + avg(1, 2, 6)", 6},
      {"1/0 > 1e308", 1},
      {"4.9e-324", 4.9e-324},
      {"atan2(0, -1)", std::numbers::pi},
  };
  for (const auto& [formula, wanted] : rows) {
    CAPTURE(formula);
    CHECK(value(formula) == wanted);
  }
  CHECK(std::isnan(value("0/0")));
  CHECK(std::isnan(value("(-8)^(1/3)")));
}

TEST_CASE("mistakes in a formula are named at their character", "[formulas]") {
  check_mistake("u**", "a number, a name or a bracket is missing before the end", 9);
  check_mistake("*u", "missing before '*'", 6);
  check_mistake("", "missing before the end", 6);
  check_mistake("u 2", "an operator is missing before '2': a product is a*b", 8);
  check_mistake("1/2u", "a product behind / is ambiguous: type * or brackets", 9);
  check_mistake("u/v(u + 1)", "a product behind / is ambiguous: type * or brackets", 9);
  check_mistake("u % v", "'%' is no operator", 8);
  check_mistake("u = v", "'=' is no operator", 8);
  check_mistake(std::string("u\0v", 3), "'\\x00' is no operator", 7);
  check_mistake("(u*(v)", "'(' is not closed", 6);
  check_mistake("u)", "')' closes nothing", 7);
  check_mistake("2*|u", "'|' is not closed", 8);
  check_mistake("(|u)|", "'|' is not closed", 7);
  check_mistake("u|", "'|' closes nothing", 7);
  check_mistake("|u|v|u|", "'|' closes nothing", 10);
  check_mistake("u ? v", "'?' is not closed", 8);
  check_mistake("hypot(u)", "hypot takes 2 values, not 1", 6);
  check_mistake("2*sin(1, 2, 3)", "sin takes 1 value, not 3", 8);
  check_mistake("1 + sqrt|u - 1|", "sqrt needs brackets: type sqrt(|u - 1|)", 10);
  check_mistake("sqrt|\tu|", "type sqrt(|\\tu|)", 6);
  check_mistake("sin u", "sin needs brackets: type sin(...)", 6);
  check_mistake("1,5", "a decimal point is a point", 7);
  check_mistake("1e400", "'1e400' is no number from 5e-324 to 1.8e308", 6);
  check_mistake("u*_pi", "'_pi' is no variable, parameter or function (did you mean 'pi'?)", 8);
  check_mistake("_e", "'_e' is no variable", 6);
  check_mistake("sgn(u)", "(did you mean 'sign'?); functions are abs, sign, ", 6);
  check_mistake("-u'", "''' is no operator", 8);
  check_mistake("u\u2212v", "the letter '\u2212' (U+2212) has no meaning here; type -", 7);
  check_mistake("\u221au", "(U+221A) has no meaning here; type sqrt(...)", 6);
  check_mistake("u*\U0001d4cd", "(U+1D4CD) has no meaning here; type letters", 8);
  check_mistake("\xe2", "has no meaning here", 6);
  CHECK_THROWS_WITH(formulas("u\u2032 = u; v' = 1"),
                    Contains("the letter '\u2032' (U+2032) has no meaning here; type ', at character 2 of"));
}

TEST_CASE("formulas are nested and long within limits", "[formulas]") {
  const auto repeated = [](const std::string& text, int times) {
    std::string result;
    for (int i = 0; i < times; ++i) result += text;
    return result;
  };
  for (const std::string open : {"(", "|", "-", "2^", "sin(", "u + v*(", "u ? 1 : ", "1 ? "}) {
    CAPTURE(open);
    CHECK_THAT(mistake(repeated(open, 1500)), Contains("nested at most 250 deep"));
  }
  CHECK_THAT(mistake(repeated("(", 100000)), Contains("at most 20000 characters, at character 5 "));
  CHECK(value(repeated("(", 240) + "u" + repeated(")", 240)) == 0.3);
  CHECK(value(repeated("1 + 2*(", 80) + "u" + repeated(")", 80), 0) == std::exp2(80) - 1);
  CHECK(value(repeated("1 ? u : ", 240) + "v") == 0.3);
  CHECK(value(repeated("u+", 9999) + "u", 1) == 10000);
}

TEST_CASE("formulas are values that threads share; a planar system has its Jacobian", "[formulas]") {
  const FormulaField field = parse_planar_system("u' = -u/hypot(u, v); v' = a*u*v^2", {{"a", 3}});
  const contensou::reduction::PlanarField as_function = field;
  std::array<Eigen::Matrix2d, 4> found;
  std::vector<std::thread> threads;
  for (Eigen::Matrix2d& each : found) {
    threads.emplace_back([&each, copy = field] {
      for (int i = 0; i < 1000; ++i) each = copy.jacobian({3, -4});
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const Eigen::Matrix2d& each : found) {
    CHECK(each.isApprox(Eigen::Matrix2d{{-16.0 / 125, -12.0 / 125}, {48, -72}}, 1e-15));
  }
  CHECK(as_function({3, -4}) == Eigen::Vector2d(-0.6, 144));
}

TEST_CASE("equations of first and second order are systems in u and v", "[system]") {
  const auto check = [](const std::string& text, Eigen::Vector2d value, Eigen::Matrix2d slopes) {
    INFO(text);
    const FormulaField field = parse_planar_system(text, {});
    CHECK((field({2, 3}) - value).norm() == 0);
    CHECK((field.jacobian({2, 3}) - slopes).norm() == 0);
  };
  check("y' = x*y", {1, 6}, (Eigen::Matrix2d() << 0, 0, 3, 2).finished());
  check("x'' = -x - a*x'; a = 2", {3, -8}, (Eigen::Matrix2d() << 0, 1, -1, -2).finished());
  check("y' = x**2; x' = y", {3, 4}, (Eigen::Matrix2d() << 0, 1, 4, 0).finished());
  check("u' = v; v' = u*v", {3, 6}, (Eigen::Matrix2d() << 0, 1, 3, 2).finished());
  const auto refusal = [](const std::string& text) {
    try {
      parse_planar_system(text, {});
    } catch (const BadInput& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  CHECK_THAT(refusal("y' = x; y' = 3"), Contains("a second equation of y', at character 9 of"));
  CHECK_THAT(refusal("y = 3"), Contains("no derivative stands there, at character 1 of"));
}

TEST_CASE("equations are read as people write them", "[system]") {
  struct Row {
    std::string text;
    std::vector<std::string> variables;
    std::string independent;
    Eigen::Vector2d value;  // at (2, 3), by hand
  };
  const double sin2 = std::sin(2.);
  const std::vector<Row> rows{
      {"x' = y; y' = -x", {"x", "y"}, "t", {3, -2}},
      {"theta'' = -sin(theta)", {"theta", "theta'"}, "t", {3, -sin2}},
      {"S' = -b*S*I; I' = b*S*I - g*I; b = 2; g = 4", {"S", "I"}, "t", {-12, 0}},
      {"x1' = x2; x2' = -x1", {"x1", "x2"}, "t", {3, -2}},
      {"X' = Y; Y' = -X", {"X", "Y"}, "t", {3, -2}},
      {"dx/dt = y; dy/dt = -x", {"x", "y"}, "t", {3, -2}},
      {"dx/ds = y, dy/ds = -x", {"x", "y"}, "s", {3, -2}},
      {"dy/dx = x - y", {"x", "y"}, "x", {1, -1}},
      {"x'(t) = y(t); y'(t) = -x(t)", {"x", "y"}, "t", {3, -2}},
      {"y'' = -y", {"y", "y'"}, "t", {3, -2}},
      {"x'' + x = 0", {"x", "x'"}, "t", {3, -2}},
      {"x'' + 0.5x' + x = 0", {"x", "x'"}, "t", {3, -3.5}},
      {"m*x'' = -k x - 2 dx/dt; m = 2; k = 3", {"x", "x'"}, "t", {3, -6}},
      {"d^2x/dt^2 = -x; ", {"x", "x'"}, "t", {3, -2}},
      {"d2x/dt2 = -x", {"x", "x'"}, "t", {3, -2}},
      {"y' + y = x", {"x", "y"}, "x", {1, -1}},
      {"x*y' = y + x", {"x", "y"}, "x", {1, 2.5}},
      {"(x + y)*y' = x - y", {"x", "y"}, "x", {1, -0.2}},
      {"(x + y) dy/dx + y = x", {"x", "y"}, "x", {1, -0.2}},
      {"x y'/2 - y'(1 + x) = -(y'(x) + y)", {"x", "y"}, "x", {1, 3}},
      {"y dx - x dy = 0", {"x", "y"}, "x", {1, 1.5}},
      {"(2x y) dx + (x^2 + 1) dy = 0", {"x", "y"}, "x", {1, -2.4}},
      {"dy = (x - y) dx", {"x", "y"}, "x", {1, -1}},
      {"y' = 2x y", {"x", "y"}, "x", {1, 12}},
      {"y' = x(1-y)(1 + y)", {"x", "y"}, "x", {1, -16}},
      {"x' = t - x", {"t", "x"}, "t", {1, -1}},
      {"dS/dt = -k*S; k = 2", {"t", "S"}, "t", {1, -6}},
      {"r' = r^2 - s", {"s", "r"}, "s", {1, 7}},
      {"dx/dy = x y", {"y", "x"}, "y", {1, 6}},
      {"y' = e^x", {"x", "y"}, "x", {1, std::pow(std::numbers::e, 2.)}},
      {"v' = u; u' = v^2", {"u", "v"}, "t", {9, 2}},
      {"b' = a; a' = b >= 3 ? 1 : 0", {"b", "a"}, "t", {3, 0}},
      {"x'' = x' == 3 ? x : 0", {"x", "x'"}, "t", {3, 2}},
      {"x'=x(1-y)\ny'=-y(1-x)", {"x", "y"}, "t", {-4, 3}},
  };
  for (const Row& row : rows) {
    INFO(row.text);
    const FormulaField field = parse_planar_system(row.text, {});
    CHECK(field.variables == row.variables);
    CHECK(field.independent == row.independent);
    CHECK((field({2, 3}) - row.value).norm() <= 1e-15 * row.value.norm());
    // The derivatives are those of the field, by central differences.
    const double step = 1e-5;
    for (int i = 0; i < 2; ++i) {
      const Eigen::Vector2d along = step * Eigen::Vector2d::Unit(i), at(2.25, 3.25);
      const Eigen::Vector2d slope = (field(at + along) - field(at - along)) / (2 * step);
      CHECK((field.jacobian(at).col(i) - slope).norm() <= 1e-8 * (1 + slope.norm()));
    }
  }
  // Letters with a value are no variables: the time is a parameter here, and so is x.
  CHECK(parse_planar_system("x'' = -x + t", {{"t", 5}})({2, 3}) == Eigen::Vector2d(3, 3));
  CHECK(parse_planar_system("y'' = -y + x", {{"x", 5}})({2, 3}) == Eigen::Vector2d(3, 3));
  CHECK(parse_planar_system("z' = a*z + b", {{"a", 2}}).variables == std::vector<std::string>{"b", "z"});
}

TEST_CASE("a refused equation names what it lacks, and its character", "[system]") {
  const auto check = [](const std::string& text, const std::string& words, int character, bool forms = true) {
    INFO(text);
    try {
      parse_planar_system(text, {});
      FAIL("it was read");
    } catch (const BadInput& error) {
      CHECK_THAT(error.what(), Contains(words) && Contains(fmt::format(", at character {} of", character)));
      if (forms) CHECK_THAT(error.what(), Contains("type a system \"x' = F; y' = G\" or one equation"));
    }
  };
  check("x' = y; y' = z; z' = x", "three equations: contensou solves two", 17);
  check("a' = b; b' = c; c' = d; d' = a", "4 equations: contensou solves two", 17);
  check("x'' = -x + cos(t)", "the time t stands in the right side; contensou solves equations without it", 16, false);
  check("x' = y; y' = -x + sin(t)", "the time t stands in the right side", 23, false);
  check("dx/ds = y; dy/ds = s", "the independent letter s stands in the right side", 20, false);
  check("y'' = -y + x", "the independent letter x stands in the right side", 12, false);
  check("x''' = x", "x''' has the order 3", 1);
  check("x' = y; y'' = x", "two equations, one of them of second order", 9);
  check("x' = y", "y' = is missing; if y is independent, type dx/dy = F", 7);
  check("u' = v", "v' = is missing", 7);
  check("dx/dt = y; dy/ds = x", "both t and s are independent", 12);
  check("x' + y' = 0; x' = y", "x' and y' both stand in this equation; one is needed", 1);
  check("x' = y; y' = x; x + 1 = 2", "no derivative stands in this equation; one is needed", 17);
  check("y'^2 = x", "the equation is not linear in y'", 1);
  check("1/y' = x", "the equation is not linear in y'", 1);
  check("x'' = sin(x'')", "the equation is not linear in x''", 1);
  check("y dx - x dy = 1", "each term must contain one of dx and dy", 1);
  check("y dx = 0", "one more differential is needed", 3);
  check("y'", "an equals sign is missing", 3);
  check("sin' = 1", "sin has a meaning of its own, and therefore no derivative", 1, false);
  check("x' = y; pi' = x", "pi has a meaning of its own, and therefore no derivative", 9, false);
  check("y' = xy + 1", "'xy' is no variable: a product is x*y", 6, false);
  check("", "no derivative stands there", 1);
  check("\\dot x = y", "no derivative stands there", 1);
  check("y' = a + b*y + x", "'a' is no variable, parameter or function: give its value with --param a=VALUE", 6, false);
  check("z' = a + b*z", "a, b have no value; the equation of z has one independent letter", 1, false);
}

TEST_CASE("every function and operator names the places where it breaks", "[formulas]") {
  struct Row {
    std::string op, formula;
    double u, v;
  };
  constexpr double half_pi = std::numbers::pi / 2;
  const std::vector<Row> broken{
      {"abs", "|u - 2|*v", 2, 1},
      {"abs", "|u*v*u|", 3, 0},
      {"sign", "sign(u + v) + u", 1, -1},
      {"rint", "rint(3*u)", 2.5, 7},
      {"rint", "rint(-u)", 1e15 + 0.5, 7},
      {"tan", "tan(u)", half_pi, 7},
      {"asin", "asin(u/2)", 2, 7},
      {"acos", "acos(-v)", 7, 1},
      {"acosh", "acosh(v)", 7, 1},
      {"atanh", "atanh(u)", -1, 7},
      {"sqrt", "sqrt(u - v)", 3, 3},
      {"sqrt", "sqrt(4*(u - 1)^2/exp(v)^2)", 1, 7},
      {"sqrt", "sqrt(max(0, u - 1))", 1, 7},
      {"ln", "ln(u)", 0, 7},
      {"log", "log(u)", 0, 7},
      {"log2", "log2(u - 3)", 3, 7},
      {"log10", "log10(u)", 0, 7},
      {"hypot", "hypot(u - 1, v)", 1, 0},
      {"hypot", "hypot(0, u - 1)", 1, 7},
      {"atan2", "atan2(u - 1, v)", 1, -1},
      {"atan2", "atan2(0, v)", 7, 0},
      {"min", "min(u, 3, v)", 3, 5},
      {"max", "max(7, 3, v)", 0, 7},
      {"<", "u < 2", 2, 7},
      {">", "u*v > 6", 2, 3},
      {"<=", "0 <= u - 1", 1, 7},
      {">=", "u >= v ? u : v", 3, 3},
      {"==", "u == v", 3, 3},
      {"!=", "u - 1 != 2", 3, 7},
      {"&&", "u < 1 && v - 1", 7, 1},
      {"||", "u - 1 || v > 9", 1, 7},
      {"!", "!(u - 1)", 1, 7},
      {"?", "u - 1 ? 2 : 3", 1, 7},
      {"/", "v/(u - 1)^2", 1, 7},
      {"^", "(u - 1)^0.5", 1, 7},
      {"^", "(u - 1)^-2", 1, 7},
      {"^", "(u - 1)^v", 1, 7},
      {"^", "0^(u - 1)", 1, 7},
      {"sin", "sin(|u|)", 0, 7},
  };
  const auto switches = [](const std::string& formula, double u, double v) {
    return formulas("u' = " + formula + "; v' = 1").switches({u, v});
  };
  std::vector<std::string> answered;
  for (const auto& [op, formula, u, v] : broken) {
    CAPTURE(formula);
    answered.push_back(op);
    const Eigen::MatrixX3d here = switches(formula, u, v), beside = switches(formula, u + 0.5, v - 0.375);
    CHECK((here.col(0).array().abs() < 1e-15).count() == 1);
    CHECK((beside.col(0).array().abs() < 1e-15).count() == 0);
    CHECK(beside.rows() == here.rows());
  }
  for (const std::string smooth : {"sin", "cos", "atan", "sinh", "cosh", "tanh", "asinh", "exp", "sum", "avg", "-"}) {
    CAPTURE(smooth);
    answered.push_back(smooth);
    CHECK(switches(smooth + "(u - v)", 1, 1).rows() == 0);
  }
  for (const std::string smooth : {"u + v*u - v", "u^3 - v^2.0*u^0", "sqrt(2)*|3 - pi|*u", "hypot(u, 2)", "2^u",
                                   "atan2(v, 1)", "(1 > 2 ? 3 : 4)*v/5", "u/exp(v)", "u/cosh(v)^2"}) {
    CAPTURE(smooth);
    CHECK(switches(smooth, 1, 1).rows() == 0);
  }
  const std::string sentence = mistake("_e(u)"), opening = "functions are ";
  const std::size_t begin = sentence.find(opening) + opening.size();
  const std::string names = sentence.substr(begin, sentence.find(", at character") - begin) + ", ";
  CHECK(std::ranges::count(names, ',') == 27);
  for (std::size_t at = 0; at < names.size(); at = names.find(", ", at) + 2) {
    const std::string function = names.substr(at, names.find(", ", at) - at);
    INFO("the function " << function << " needs a row above");
    CHECK(std::ranges::count(answered, function) > 0);
  }

  // Equal functions are one row, and a row has no value where its function has none.
  CHECK(switches("|u| + sign(-2*u)*u^0.5/u + (0 < u) + sqrt(u*u)", 1, 1).rows() == 1);
  CHECK(switches("atan2(u, v)", 1, 1).array().isNaN().all());
  CHECK(switches("|ln(u)|", -1, 1).array().isNaN().any());
}

TEST_CASE("between the zeros of the switching functions random formulas are smooth", "[formulas]") {
  Random random(20261127);
  Typist typed(random);
  int breaks = 0, slopes_compared = 0;
  // Larger values are rounded, and their sines turn fast. Both look like breaks of the formula.
  const std::function<bool(const Tree&, double, double)> is_tame = [&](const Tree& tree, double u, double v) {
    const double size = std::fabs(tree.at(u, v).value);
    return (std::isnan(size) || size == 0 || (size > 1e-12 && size < 1e6)) &&
           std::ranges::all_of(tree.parts, [&](const Tree& part) { return is_tame(part, u, v); });
  };
  for (int n = 0; n < 20000; ++n) {
    const Tree tree = random_tree(random, 1 + static_cast<int>(below(random, 4)));
    const std::string text = typed(tree);
    const Formulas compiled = formulas("v' = 2; u' = " + text);
    const Eigen::Vector2d from{between(random, -3, 3), between(random, -3, 3)};
    const Eigen::Vector2d way{between(random, -1, 1), between(random, -1, 1)};
    const auto switches = [&](double s) {
      const Eigen::Vector2d x = from + s * way;
      return compiled.switches({x[0], x[1]});
    };
    CAPTURE(text, from, way);
    const Eigen::MatrixX3d here = switches(0);
    for (const int by : {0, 1}) {
      const auto difference = [&](double h) {
        const Eigen::Vector2d step = h * Eigen::Vector2d::Unit(by), more = from + step, less = from - step;
        const Eigen::VectorXd change =
            compiled.switches({more[0], more[1]}).col(0) - compiled.switches({less[0], less[1]}).col(0);
        return Eigen::VectorXd(change / (2 * h));
      };
      const Eigen::VectorXd coarse = difference(1e-4), fine = difference(5e-5), finest = difference(2.5e-5);
      for (Eigen::Index i = 0; i < here.rows(); ++i) {
        const double most = 1e-5 * std::fabs(finest[i]);
        if (!(std::fabs(coarse[i] - finest[i]) < most && std::fabs(fine[i] - finest[i]) < most)) continue;
        if (std::isnan(here(i, 1 + by))) continue;  // a part has no slope, such as ln(u) in 0*ln(u) for u < 0
        slopes_compared += 1;
        CAPTURE(i, here(i, 0));
        CHECK(std::fabs(here(i, 1 + by) - finest[i]) <= 10 * most + 1e-9 * std::fabs(here(i, 0)));
      }
    }
    // Look for a jump of the value or of the slope: halve the way, and keep the half with the greater change.
    for (const bool of_slope : {false, true}) {
      const auto quantity = [&](double s) {
        const Eigen::Vector2d x = from + s * way;
        const Dual<2> all = compiled.with_slopes(std::array{x[0], x[1]})[0];
        return of_slope ? all[1] * way[0] + all[2] * way[1] : all[0];
      };
      const auto change = [&](double a, double b) {
        if (std::isfinite(a) == std::isfinite(b)) return std::isfinite(a) ? std::fabs(a - b) : 0;
        return of_slope ? 0 : std::numeric_limits<double>::infinity();
      };
      double begin = 0, end = 1, first = quantity(begin), last = quantity(end);
      double most = 0, earlier = 0;
      for (int halvings = 0; halvings < 30; ++halvings) {
        if (halvings == 25) earlier = change(first, last);
        const double middle = (begin + end) / 2, between_them = quantity(middle);
        const double at_left = change(first, between_them), at_right = change(between_them, last);
        if (std::isfinite(at_left + at_right)) most = std::max({most, at_left, at_right});
        const bool left = at_left > at_right;
        (left ? end : begin) = middle;
        (left ? last : first) = between_them;
      }
      double noise = 1e-14 * std::fmax(std::fabs(first), std::fabs(last));
      for (int i = 1; i < 8; ++i) {
        for (const double from_end : {begin - (end - begin), end + (end - begin)}) {
          const double rounding = change(quantity(from_end + i * 1e-14), quantity(from_end));
          if (std::isfinite(rounding)) noise = std::max(noise, rounding);
        }
      }
      if (!(change(first, last) > 1e-3 * most) || !(change(first, last) > 1e3 * noise)) continue;
      // A jump keeps its size in a smaller part. A smooth function, however steep, changes there by 1/32.
      if (!(change(first, last) >= 0.1 * earlier)) continue;
      const auto tame_at = [&](double s) { return is_tame(tree, from[0] + s * way[0], from[1] + s * way[1]); };
      if (!tame_at(begin) || !tame_at(end)) continue;
      breaks += 1;
      const Eigen::VectorXd before = switches(begin).col(0), after = switches(end).col(0);
      const Eigen::VectorXd far_before = switches(begin - 1e-3).col(0), far_after = switches(end + 1e-3).col(0);
      bool found = false;
      for (Eigen::Index i = 0; i < before.size(); ++i) {
        const double far = std::fmax(std::fabs(far_before[i]), std::fabs(far_after[i]));
        const double size = std::fmin(std::fabs(before[i]), std::fabs(after[i]));
        found = found || before[i] * after[i] <= 0 || size <= 1e-4 * far;
      }
      CAPTURE(of_slope, begin, end - begin, first, last, most, before, after);
      CHECK(found);
    }
  }
  CHECK(breaks > 600);
  CHECK(slopes_compared > 10000);
}

TEST_CASE("a planar system has the switching functions of its formulas", "[system]") {
  const auto switches = [](const std::string& text) -> Eigen::MatrixXd {
    const contensou::reduction::SmoothField field = parse_planar_system(text, {});
    return field.switches ? field.switches({2, 3}) : Eigen::MatrixX3d(0, 3);
  };
  CHECK(switches("u' = v; v' = -sin(u)").rows() == 0);
  CHECK(switches("u' = v*|u|; v' = max(u, v)") == (Eigen::MatrixXd(2, 3) << 2, 1, 0, -1, 1, -1).finished());
  CHECK(switches("x'' = -x - 0.2*sign(x' - 0.5)") == Eigen::RowVector3d(2.5, 0, 1));
  CHECK(switches("y' = |x*y - 4|") == Eigen::RowVector3d(2, 3, 2));
}

TEST_CASE("a branch continues a formula smoothly beyond its switching functions", "[formulas][exact]") {
  struct Row {
    std::string text, beyond;  // beyond: the continuation of the formula from u = 2, as a formula
  };
  // A part within sqrt, a logarithm or a power that is not whole stays as it is.
  const std::vector<Row> rows{{"abs(u)", "u"},
                              {"abs(1-u)", "u-1"},
                              {"sign(u)*v", "v"},
                              {"rint(u)+u", "2+u"},
                              {"max(0,u-1)", "u-1"},
                              {"min(0,u-1)", "0*u"},
                              {"max(0,u-1)^2", "(u-1)^2"},
                              {"abs(u)^3", "u^3"},
                              {"(u > 1)*v+!(u > 1)", "v"},
                              {"u > 1 ? u : 7", "u"},
                              {"u > 1 && v < 9 ? u*v : 7", "u*v"},
                              {"max(u, v, 0)", "u"},
                              {"hypot(abs(u), v)", "hypot(u, v)"},
                              {"sqrt(abs(u))", "sqrt(abs(u))"},
                              {"sign(u)*abs(u)^0.5", "abs(u)^0.5"},
                              {"ln(max(u, 1))", "ln(max(u, 1))"}};
  const FormulaShape shape{{"u'", "v'"}, {"u", "v"}, "a system"};
  for (const auto& [text, beyond] : rows) {
    CAPTURE(text);
    const Formulas whole(shape, "u' = " + text + "; v' = v", {}), wanted(shape, "u' = " + beyond + "; v' = v", {});
    const Formulas branch = whole.branch({2, 0.5});
    for (const double u : {-3.0, -0.5, 0.5, 1.5, 2.0, 4.0}) {
      CHECK(branch({u, 0.7})[0] == wanted({u, 0.7})[0]);
      CHECK(branch.with_slopes(std::array{u, 0.7})[0] == wanted.with_slopes(std::array{u, 0.7})[0]);
    }
    CHECK(branch({2, 0.5}) == whole({2, 0.5}));
  }
}
