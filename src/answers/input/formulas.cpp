#include "answers/input/formulas.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <exception>
#include <map>
#include <numbers>
#include <span>
#include <system_error>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "answers/input/errors.hpp"
#include "answers/input/parse.hpp"
#include "text/nearest_name.hpp"

namespace contensou::answers {

namespace formula_parts {

using Pair = std::array<double, 2>;

class Switches;
struct Operand;

/// Zeros of a function: at most those of its operands, at most those of the first operand, at most those of its own
/// switching functions, or others.
enum class Zeros : unsigned char { own, of_operands, of_first, edges };

/// The smooth continuation of a function beyond the zeros of its switching functions.
enum class Beyond : unsigned char {
  same,     ///< the function itself
  side,     ///< the operand or its negative, for abs
  value,    ///< the value that the function has, for sign and comparisons
  operand,  ///< the operand that the function takes, for min and max
  nothing,  ///< none: the function ends, or has an infinite slope
};

/// The places where a function is not smooth. The table of functions does not compile without them.
struct Breaks {
  /// Adds the switching functions of a function of x, or of x and y.
  using Rule = void(Switches& all, const Operand& x, const Operand& y);
  constexpr Breaks(Rule* add_switches, Beyond continuation, Zeros of = Zeros::own)
      : add(add_switches), beyond(continuation), zeros(of) {}
  Breaks(std::nullptr_t, Beyond, Zeros = Zeros::own) = delete;

  Rule* add;
  Beyond beyond;
  Zeros zeros;
};

void nowhere(Switches&, const Operand&, const Operand&) {}
Breaks::Rule at_zero, at_zeros, at_divisor, at_equals, at_halves, at_one, at_ones, at_poles, at_origin, at_cut, at_base;
constexpr Breaks smooth{nowhere, Beyond::same}, of_extremum{at_equals, Beyond::operand, Zeros::of_operands};
constexpr Breaks of_comparison{at_equals, Beyond::value, Zeros::edges}, of_logarithm{at_zero, Beyond::nothing};

/// A function of one number, of two, or of more (combined two at a time). A null `slope` or `slopes` means slopes of 0.
struct Function {
  std::string_view name;
  Breaks breaks;
  double (*one)(double) = nullptr;
  double (*slope)(double x, double value) = nullptr;
  double (*two)(double, double) = nullptr;
  Pair (*slopes)(double x, double y, double value) = nullptr;
  bool of_any = false;
};

double sign(double x) { return x > 0 ? 1 : x < 0 ? -1 : x; }
double plus(double x, double y) { return x + y; }
Pair ones(double, double, double) { return {1, 1}; }
Pair of_either(bool first) { return {first ? 1.0 : 0.0, first ? 0.0 : 1.0}; }
Pair of_length(double x, double y, double length) { return {x / length, y / length}; }
Pair of_angle(double y, double x, double) {
  const double length = std::hypot(x, y);
  return {x / length / length, -y / length / length};
}

constexpr Function functions[] = {
    {"abs", {at_zero, Beyond::side, Zeros::of_first}, std::fabs, [](double x, double) { return x < 0 ? -1.0 : 1.0; }},
    {"sign", {at_zero, Beyond::value, Zeros::of_first}, sign},
    {"rint", {at_halves, Beyond::value, Zeros::edges}, std::rint},
    {"sin", smooth, std::sin, [](double x, double) { return std::cos(x); }},
    {"cos", smooth, std::cos, [](double x, double) { return -std::sin(x); }},
    {"tan", {at_poles, Beyond::same}, std::tan, [](double, double tan) { return 1 + tan * tan; }},
    {"asin",
     {at_ones, Beyond::nothing, Zeros::of_first},
     std::asin,
     [](double x, double) { return 1 / std::sqrt((1 - x) * (1 + x)); }},
    {"acos",
     {at_ones, Beyond::nothing, Zeros::edges},
     std::acos,
     [](double x, double) { return -1 / std::sqrt((1 - x) * (1 + x)); }},
    {"atan", {nowhere, Beyond::same, Zeros::of_first}, std::atan, [](double x, double) { return 1 / (1 + x * x); }},
    {"sinh", {nowhere, Beyond::same, Zeros::of_first}, std::sinh, [](double x, double) { return std::cosh(x); }},
    {"cosh", {nowhere, Beyond::same, Zeros::edges}, std::cosh, [](double x, double) { return std::sinh(x); }},
    {"tanh",
     {nowhere, Beyond::same, Zeros::of_first},
     std::tanh,
     [](double x, double) { return 1 / std::cosh(x) / std::cosh(x); }},
    {"asinh",
     {nowhere, Beyond::same, Zeros::of_first},
     std::asinh,
     [](double x, double) { return 1 / std::hypot(1, x); }},
    {"acosh",
     {at_one, Beyond::nothing, Zeros::edges},
     std::acosh,
     [](double x, double) { return 1 / std::sqrt(x - 1) / std::sqrt(x + 1); }},
    {"atanh",
     {at_ones, Beyond::nothing, Zeros::of_first},
     std::atanh,
     [](double x, double) { return 1 / (1 - x) / (1 + x); }},
    {"exp", {nowhere, Beyond::same, Zeros::edges}, std::exp, [](double, double exp) { return exp; }},
    {"sqrt", {at_zero, Beyond::nothing, Zeros::of_first}, std::sqrt, [](double, double root) { return 0.5 / root; }},
    {"ln", of_logarithm, std::log, [](double x, double) { return 1 / x; }},
    {"log", of_logarithm, std::log, [](double x, double) { return 1 / x; }},
    {"log2", of_logarithm, std::log2, [](double x, double) { return 1 / x / std::numbers::ln2; }},
    {"log10", of_logarithm, std::log10, [](double x, double) { return 1 / x / std::numbers::ln10; }},
    {"hypot", {at_origin, Beyond::same, Zeros::edges}, nullptr, nullptr, std::hypot, of_length},
    {"atan2", {at_cut, Beyond::same}, nullptr, nullptr, std::atan2, of_angle},
    {"min", of_extremum, nullptr, nullptr, [](double x, double y) { return y < x ? y : x; },
     [](double x, double y, double) { return of_either(!(y < x)); }, true},
    {"max", of_extremum, nullptr, nullptr, [](double x, double y) { return x < y ? y : x; },
     [](double x, double y, double) { return of_either(!(x < y)); }, true},
    {"sum", smooth, nullptr, nullptr, plus, ones, true},
    {"avg", smooth, nullptr, nullptr, plus, ones, true},
};

constexpr Function negative{
    "-", {nowhere, Beyond::same, Zeros::of_first}, [](double x) { return -x; }, [](double, double) { return -1.0; }};
constexpr Function opposite{"!", {at_zero, Beyond::value, Zeros::edges}, [](double x) { return x == 0 ? 1.0 : 0.0; }};

/// Slopes of x^y by x and by y. The slope by y is 0 at x = 0 < y, and NaN for x < 0. The slope by x is set to 0 at 0^0.
Pair of_power(double x, double y, double value) {
  return {y == 0 ? 0 : y * std::pow(x, y - 1), value == 0 && x >= 0 ? 0 : value * std::log(x)};
}
constexpr Function power{"^",
                         {at_base, Beyond::nothing, Zeros::of_first},
                         nullptr,
                         nullptr,
                         [](double x, double y) { return y == 2 ? x * x : std::pow(x, y); },
                         of_power};

const Function* function_of(std::string_view name) {
  const auto* const found = std::ranges::find(functions, name, &Function::name);
  return found == std::end(functions) ? nullptr : found;
}

/// A step either puts a number or a variable on a stack, or replaces the last values on it by one result.
enum class Kind : unsigned char { number, variable, one, two, add, subtract, multiply, divide, choose };

struct Step {
  Kind kind;
  unsigned char left = 0, right = 0;  ///< of the first and the last operand: bit i + 1 is set if it has variable i
  union {
    double number;
    std::size_t variable;
    const Function* function;
  };
};

constexpr Function quotient{"/", {at_divisor, Beyond::same, Zeros::of_first}};

/// Operators that bind more tightly have a higher level. "<=" must precede "<", so that the longer sign is found first.
struct Operator {
  Function function;
  int level;
  Kind kind = Kind::two;
};
constexpr Operator operators[] = {
    {{"||",
      {at_zeros, Beyond::value, Zeros::edges},
      nullptr,
      nullptr,
      [](double x, double y) -> double { return x != 0 || y != 0; }},
     0},
    {{"&&",
      {at_zeros, Beyond::value, Zeros::edges},
      nullptr,
      nullptr,
      [](double x, double y) -> double { return x != 0 && y != 0; }},
     1},
    {{"<=", of_comparison, nullptr, nullptr, [](double x, double y) -> double { return x <= y; }}, 2},
    {{">=", of_comparison, nullptr, nullptr, [](double x, double y) -> double { return x >= y; }}, 2},
    {{"==", of_comparison, nullptr, nullptr, [](double x, double y) -> double { return x == y; }}, 2},
    {{"!=", of_comparison, nullptr, nullptr, [](double x, double y) -> double { return x != y; }}, 2},
    {{"<", of_comparison, nullptr, nullptr, [](double x, double y) -> double { return x < y; }}, 2},
    {{">", of_comparison, nullptr, nullptr, [](double x, double y) -> double { return x > y; }}, 2},
    {{"+", smooth}, 3, Kind::add},
    {{"-", smooth}, 3, Kind::subtract},
    {{"*", {nowhere, Beyond::same, Zeros::of_operands}}, 4, Kind::multiply},
    {quotient, 4, Kind::divide},
};
constexpr int tightest = 5;  ///< above the level of every operator
/// Variables from this one on are derivatives, which the sides of an equation contain.
constexpr std::size_t first_derivative = 2;
constexpr int deepest = 250;
constexpr std::size_t longest = 20000;
/// Each level of nesting keeps at most two values while the next level is computed. The two lowest places are unused.
/// An equation that is solved for its derivative has some levels more.
constexpr std::size_t most_values = 2 * deepest + 8;

/// Computes the formula with N slopes; with N = 0 the value alone.
template <std::size_t N>
Dual<N> run(std::span<const Step> steps, const double* values) {
  std::array<Dual<N>, most_values> stack;
  if (steps.empty()) return {};
  Dual<N>* end = stack.data() + 1;
  Dual<N> last{};  // value on the top of the stack
  for (const Step& step : steps) {
    // Replaces the last two values by a function of them, with slopes by the chain rule.
    const auto join = [&](double value, double by_x, double by_y) {
      --end;
      last[0] = value;
      for (std::size_t i = 1; i <= N; ++i) {
        const double left = step.left >> i & 1 ? by_x * (*end)[i] : 0;
        last[i] = left + (step.right >> i & 1 ? by_y * last[i] : 0);
      }
    };
    const double x = end[-1][0], y = last[0];
    switch (step.kind) {
      case Kind::number:
        *end++ = last;
        last = {step.number};
        break;
      case Kind::variable:
        *end++ = last;
        last = {values[step.variable]};
        if constexpr (N > 0) last[step.variable + 1] = 1;
        break;
      case Kind::one: {
        last[0] = step.function->one(y);
        const double by = N > 0 && step.function->slope ? step.function->slope(y, last[0]) : 0;
        for (std::size_t i = 1; i <= N; ++i) last[i] = step.left >> i & 1 ? by * last[i] : 0;
        break;
      }
      case Kind::two: {
        const double value = step.function->two(x, y);
        const auto by = N > 0 && step.function->slopes ? step.function->slopes(x, y, value) : Pair{};
        join(value, by[0], by[1]);
        break;
      }
      case Kind::add:
        join(x + y, 1, 1);
        break;
      case Kind::subtract:
        join(x - y, 1, -1);
        break;
      case Kind::multiply:
        join(x * y, y, x);
        break;
      case Kind::divide:
        join(x / y, 1 / y, -(x / y) / y);
        break;
      case Kind::choose:
        end -= 2;
        last = (*end)[0] != 0 ? end[1] : last;
        break;
    }
  }
  if (std::isnan(last[0])) last.fill(last[0]);
  return last;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_of_word(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || is_digit(c) || c == '_'; }

/// Characters that papers and word processors use in place of ASCII, each with the ASCII text that replaces it.
constexpr std::pair<char32_t, std::string_view> pasted[] = {
    {0x2032, "'"}, {0x2019, "'"}, {0xB4, "'"},   {0x2212, "-"},         {0x2013, "-"},
    {0xD7, "*"},   {0xB7, "*"},   {0x22C5, "*"}, {0xF7, "/"},           {0x2215, "/"},
    {0xB2, "^2"},  {0xB3, "^3"},  {0x3C0, "pi"}, {0x221A, "sqrt(...)"}, {0xA0, "a blank"}};

/// Compiles a formula by recursive descent.
class Parser {
 public:
  /// Reads text[begin, end).
  /// @param unused  names of parameters; those that the formula contains are removed
  Parser(const FormulaShape& shape, const std::map<std::string, double>& parameters,
         std::map<std::string, double>& unused, const std::string& text, std::size_t begin, std::size_t end)
      : shape_(shape), parameters_(parameters), unused_(unused), whole_(text), text_(whole_.data(), end), at_(begin) {
    if (end - begin > longest) reject(begin, fmt::format("a formula has at most {} characters", longest));
    expression(0);
    next();
    if (at_ < text_.size()) reject_operator();
  }

  std::vector<Step> steps;

 private:
  [[noreturn]] void reject(std::size_t place, const std::string& message) const { reject_at(place, whole_, message); }

  /// Returns the next character that is not blank; 0 at the end.
  char next() {
    at_ = std::min(text_.find_first_not_of(" \t\r\n", at_), text_.size());
    return at_ < text_.size() ? text_[at_] : '\0';
  }

  bool takes(std::string_view sign) {
    next();
    if (!text_.substr(at_).starts_with(sign)) return false;
    at_ += sign.size();
    return true;
  }

  /// @param operands  number of operands of the step; they are the last values on the stack
  void add(Step step, std::size_t operands) {
    auto variables = static_cast<unsigned char>(step.kind == Kind::variable ? 2U << step.variable : 0);
    if (operands > 0) step.right = variables_.back();
    for (; operands > 0; --operands) {
      step.left = variables_.back();
      variables |= step.left;
      variables_.pop_back();
    }
    variables_.push_back(variables);
    steps.push_back(step);
  }

  /// Reads an expression with operators of the given level and of higher levels.
  void expression(int level) {
    if (++depth_ > deepest) reject(at_, fmt::format("a formula is nested at most {} deep", deepest));
    if (takes("-") || takes("!")) {
      const Function& sign = text_[at_ - 1] == '-' ? negative : opposite;
      expression(tightest);
      add({.kind = Kind::one, .function = &sign}, 1);
    } else if (takes("+")) {
      expression(tightest);
    } else {
      operand();
      if (takes("**") || takes("^")) {
        expression(tightest);
        add({.kind = Kind::two, .function = &power}, 2);
      }
    }
    const auto follows = [&](const Operator& each) {
      return each.level >= level && !(in_bars_ && each.function.name == "||") && takes(each.function.name);
    };
    constexpr int level_of_products = 4;
    bool divided = false;
    while (true) {
      const Operator* found = std::ranges::find_if(operators, follows);
      if (found == std::end(operators)) {
        const char first = next();
        if (level > level_of_products || !(first == '(' || (is_of_word(first) && !is_digit(first)))) break;
        if (divided) reject(at_, "a product behind / is ambiguous: type * or brackets");
        constexpr const Operator* product = std::ranges::find(operators, Kind::multiply, &Operator::kind);
        found = product;
      }
      divided = found->kind == Kind::divide;
      expression(found->level + 1);
      add({.kind = found->kind, .function = &found->function}, 2);
    }
    if (level == 0 && takes("?")) {
      within(":");
      expression(0);
      add({.kind = Kind::choose, .number = 0}, 3);
    }
    --depth_;
  }

  /// Reads a value and the sign that closes it. For a function it reads several values between commas.
  /// @return  number of values
  int within(std::string_view closing, const Function* function = nullptr) {
    const std::size_t opening = at_ - 1;
    const bool outside = std::exchange(in_bars_, closing == "|");
    int count = 0;
    do {
      expression(0);
      if (++count > 1 && function->two) add({.kind = Kind::two, .function = function}, 2);
    } while (function && takes(","));
    in_bars_ = outside;
    if (takes(closing)) return count;
    if (next() != '\0' && next() != ')') reject_operator();
    reject(opening, fmt::format("'{}' is not closed", text_[opening]));
  }

  void operand() {
    const char first = next();
    const std::size_t begin = at_;
    const char* const letters = text_.data() + at_;
    double value = 0;
    if (takes("(")) return within(")"), void();
    if (takes("|")) return within("|"), add({.kind = Kind::one, .function = function_of("abs")}, 1);
    if (first == '.' || is_digit(first)) {
      const auto [end, error] = std::from_chars(letters, text_.data() + text_.size(), value);
      at_ += static_cast<std::size_t>(end - letters);
      if (error == std::errc()) return add({.kind = Kind::number, .number = value}, 0);
      const std::string typed = quotation(text_.substr(begin, std::max<std::size_t>(at_ - begin, 1)));
      reject(begin, fmt::format("{} is no number from 5e-324 to 1.8e308", typed));
    }
    std::string name;
    if (shape_.read_name) at_ += shape_.read_name(shape_, text_, begin, name);
    while (name.empty() && at_ < text_.size() && is_of_word(text_[at_])) ++at_;
    if (name.empty()) name = text_.substr(begin, at_ - begin);
    const auto variable =
        static_cast<std::size_t>(std::ranges::find(shape_.variables, name) - shape_.variables.begin());
    if (variable < shape_.variables.size()) {
      add({.kind = Kind::variable, .variable = variable}, 0);
    } else if (const auto parameter = parameters_.find(name); parameter != parameters_.end()) {
      unused_.erase(name);
      add({.kind = Kind::number, .number = parameter->second}, 0);
    } else if (name == "pi") {
      add({.kind = Kind::number, .number = std::numbers::pi}, 0);
    } else if (const Function* function = function_of(name)) {
      call(*function, begin);
    } else {
      reject_operand(name, begin);
    }
  }

  void call(const Function& function, std::size_t begin) {
    if (!takes("(")) {
      const std::size_t bar = at_;
      const std::string value = takes("|") && within("|") ? escaped(text_.substr(bar, at_ - bar)) : "...";
      reject(begin, fmt::format("{0} needs brackets: type {0}({1})", function.name, value));
    }
    const int count = within(")", &function), needed = function.one ? 1 : 2;
    if (!function.of_any && count != needed) {
      reject(begin, fmt::format("{} takes {} value{}, not {}", function.name, needed, needed == 1 ? "" : "s", count));
    }
    if (function.one) add({.kind = Kind::one, .function = &function}, 1);
    if (function.name == "avg") {
      add({.kind = Kind::number, .number = 1.0 * count}, 0);
      add({.kind = Kind::divide, .function = &quotient}, 2);
    }
  }

  [[noreturn]] void reject_operand(const std::string& name, std::size_t place) {
    if (name.empty()) {
      const std::string before = next() == '\0' ? "the end" : quotation(text_.substr(place, 1));
      reject(place, fmt::format("a number, a name or a bracket is missing before {}", before));
    }
    if (const auto refused = shape_.refused.find(name); refused != shape_.refused.end()) {
      reject(place, fmt::format("{}: {}", quotation(name), refused->second));
    }
    static const std::map<std::string, std::string> written_as{
        {"cot", "(1/tan(x))"},           {"sec", "(1/cos(x))"},    {"csc", "(1/sin(x))"},
        {"cbrt", "(sign(x)*|x|^(1/3))"}, {"heaviside", "(x > 0)"}, {"Heaviside", "(x > 0)"}};
    if (const auto other = written_as.find(name); other != written_as.end() && next() == '(') {
      reject(place, fmt::format("{} is no function; write {}", quotation(name), other->second));
    }
    std::vector<std::string> known;
    for (const Function& function : functions) known.emplace_back(function.name);
    std::string way_out = fmt::format("; functions are {}", fmt::join(known, ", "));
    if (next() != '(') {
      known.emplace_back("pi");
      known.insert(known.begin(), shape_.variables.begin(), shape_.variables.end());
      for (const auto& [parameter, value] : parameters_) known.push_back(parameter);
      way_out = name.back() == '\'' ? "" : fmt::format(": give its value with --param {}=VALUE", name);
    }
    reject(place, fmt::format("{} is no variable, parameter or function{}{}", quotation(name), suggestion(name, known),
                              way_out));
  }

  [[noreturn]] void reject_operator() {
    const char typed = next();
    if (typed == '|') reject(at_, "'|' closes nothing: |x| needs an operator before it");
    if (typed == ')') reject(at_, "')' closes nothing");
    if (typed == ',') reject(at_, "a formula is one number: a decimal point is a point");
    const std::string quoted = quotation({&typed, 1});
    if (typed != '(' && typed != '.' && !is_of_word(typed)) reject(at_, fmt::format("{} is no operator", quoted));
    reject(at_, fmt::format("an operator is missing before {}: a product is a*b", quoted));
  }

  const FormulaShape& shape_;
  const std::map<std::string, double>& parameters_;
  std::map<std::string, double>& unused_;
  const std::string& whole_;
  std::string_view text_;
  std::size_t at_;
  int depth_ = 0;
  bool in_bars_ = false;                  ///< true: the innermost open bracket is the bar that opens |x|
  std::vector<unsigned char> variables_;  ///< for each value on the stack, the variables in it; bits as in Step::left
};

using Steps = std::vector<Step>;

bool equal(std::span<const Step> some, std::span<const Step> others) {
  return std::ranges::equal(some, others, [](const Step& a, const Step& b) {
    return a.kind == b.kind && (a.kind == Kind::number     ? a.number == b.number
                                : a.kind == Kind::variable ? a.variable == b.variable
                                                           : a.function == b.function);
  });
}

int operands_of(const Step& step) {
  return step.kind == Kind::number || step.kind == Kind::variable ? 0
         : step.kind == Kind::one                                 ? 1
         : step.kind == Kind::choose                              ? 3
                                                                  : 2;
}

/// Returns true for the exponents of powers that are smooth everywhere.
bool is_whole(double exponent) { return exponent >= 0 && std::rint(exponent) == exponent; }

/// Steps that compute a part of a formula.
struct Operand {
  std::span<const Step> steps = {};
  unsigned char variables = 0;  ///< coded like Step::left

  bool is_constant() const { return variables == 0; }
  double constant() const { return run<0>(steps, nullptr)[0]; }
  bool is_zero() const { return is_constant() && constant() == 0; }
};

/// The switching functions of formulas: functions of parts of these formulas.
class Switches {
 public:
  struct Edge {
    double value, by_x, by_y;
  };
  using EdgeOf = Edge(double x, double y);

  /// Adds the switching functions of all steps of a formula. The formula must outlive this object.
  void add(std::span<const Step> formula) {
    parts_.clear();
    formula_ = formula;
    std::vector<Part> stack;
    for (std::size_t i = 0; i < formula.size(); ++i) {
      const Step& step = formula[i];
      Part part{i, static_cast<unsigned char>(step.kind == Kind::variable ? 2U << step.variable : 0)};
      for (int left = operands_of(step); left > 0; --left) {
        part.begin = stack.back().begin;
        part.variables |= stack.back().variables;
        stack.pop_back();
      }
      stack.push_back(part);
      parts_.push_back(part);
      const std::array<Operand, 3> operands = operands_before(i);
      if (step.kind == Kind::choose)
        add_zeros(operands[0]);
      else if (operands_of(step) > 0)
        step.function->breaks.add(*this, operands[0], operands[1]);
    }
  }

  /// Adds the function `edge` of x, or of x and y.
  void add(EdgeOf* edge, const Operand& x, const Operand& y = {}) {
    if (x.is_constant() && y.is_constant()) return;
    const auto same = [&](const Row& row) {
      return row.edge == edge && equal(row.x.steps, x.steps) && equal(row.y.steps, y.steps);
    };
    if (std::ranges::none_of(rows_, same)) rows_.push_back({edge, x, y});
  }

  /// Adds functions that vanish wherever x does. For a product these are its factors.
  void add_zeros(Operand x) {
    while (!x.is_constant()) {
      const Step& last = x.steps.back();
      const std::array<Operand, 3> operands = operands_before(static_cast<std::size_t>(&last - formula_.data()));
      if (last.kind == Kind::subtract) return add_difference(operands[0], operands[1]);
      if (last.kind == Kind::choose) {
        add_zeros(operands[2]);
        x = operands[1];
        continue;
      }
      const Zeros zeros = last.kind == Kind::variable ? Zeros::own : last.function->breaks.zeros;
      if (zeros == Zeros::edges) return;
      if (zeros == Zeros::own) return add([](double value, double) -> Edge { return {value, 1, 0}; }, x);
      if (zeros == Zeros::of_operands) add_zeros(operands[1]);
      x = operands[0];
    }
  }

  void add_difference(const Operand& x, const Operand& y) {
    if (y.is_zero()) return add_zeros(x);
    if (x.is_zero()) return add_zeros(y);
    add([](double a, double b) -> Edge { return {a - b, 1, -1}; }, x, y);
  }

  Eigen::MatrixX3d at(const double* values) const {
    Eigen::MatrixX3d all(std::ssize(rows_), 3);
    for (Eigen::Index i = 0; i < all.rows(); ++i) {
      const auto& [edge, x, y] = rows_[static_cast<std::size_t>(i)];
      const Dual<2> first = run<2>(x.steps, values), second = run<2>(y.steps, values);
      const auto [value, by_x, by_y] = edge(first[0], second[0]);
      all(i, 0) = value;
      for (std::size_t j = 1; j <= 2; ++j) {
        const double left = x.variables >> j & 1 ? by_x * first[j] : 0;
        all(i, static_cast<Eigen::Index>(j)) = left + (y.variables >> j & 1 ? by_y * second[j] : 0);
      }
      if (std::isnan(value)) all.row(i).setConstant(value);
    }
    return all;
  }

 private:
  struct Row {
    EdgeOf* edge;
    Operand x, y;
  };
  struct Part {
    std::size_t begin;
    unsigned char variables;
  };

  std::array<Operand, 3> operands_before(std::size_t step) const {
    std::array<Operand, 3> operands;
    std::size_t end = step;
    for (int left = operands_of(formula_[step]); left > 0; --left) {
      const auto [begin, variables] = parts_[end - 1];
      operands[static_cast<std::size_t>(left - 1)] = {formula_.subspan(begin, end - begin), variables};
      end = begin;
    }
    return operands;
  }

  std::span<const Step> formula_;
  std::vector<Part> parts_;  ///< for each step of the formula, the part that this step completes
  std::vector<Row> rows_;
};

void at_zero(Switches& all, const Operand& x, const Operand&) { all.add_zeros(x); }
void at_zeros(Switches& all, const Operand& x, const Operand& y) {
  all.add_zeros(x);
  all.add_zeros(y);
}
void at_divisor(Switches& all, const Operand&, const Operand& y) { all.add_zeros(y); }
void at_equals(Switches& all, const Operand& x, const Operand& y) { all.add_difference(x, y); }
void at_halves(Switches& all, const Operand& x, const Operand&) {
  all.add(
      [](double value, double) -> Switches::Edge {
        constexpr double pi = std::numbers::pi;
        const double rest = std::remainder(value, 2);  // cos(pi x) vanishes exactly where |rest| = 0.5
        return {std::sin(pi * (0.5 - std::fabs(rest))), -pi * std::sin(pi * rest), 0};
      },
      x);
}
void at_one(Switches& all, const Operand& x, const Operand&) {
  all.add([](double value, double) -> Switches::Edge { return {value - 1, 1, 0}; }, x);
}
void at_ones(Switches& all, const Operand& x, const Operand&) {
  all.add([](double value, double) -> Switches::Edge { return {(1 - value) * (1 + value), -2 * value, 0}; }, x);
}
void at_poles(Switches& all, const Operand& x, const Operand&) {
  all.add([](double value, double) -> Switches::Edge { return {std::cos(value), -std::sin(value), 0}; }, x);
}
void at_origin(Switches& all, const Operand& x, const Operand& y) {
  if (y.is_zero()) return all.add_zeros(x);
  if (x.is_zero()) return all.add_zeros(y);
  if (x.is_constant() || y.is_constant()) return;
  all.add(
      [](double a, double b) -> Switches::Edge {
        const double length = std::hypot(a, b);
        return {length, a / length, b / length};
      },
      x, y);
}
void at_cut(Switches& all, const Operand& y, const Operand& x) {
  if (y.is_zero()) return all.add_zeros(x);
  if (y.is_constant() || (x.is_constant() && x.constant() > 0)) return;
  all.add([](double a, double b) -> Switches::Edge { return {b <= 0 ? a : std::nan(""), 1, 0}; }, y, x);
}
void at_base(Switches& all, const Operand& x, const Operand& y) {
  if (x.is_zero()) return all.add_zeros(y);
  if (!(y.is_constant() && is_whole(y.constant()))) all.add_zeros(x);
}

/// Returns the steps of the formula that keeps the choices of another formula at a point: see Formulas::branch.
Steps branch(const Steps& formula, const double* values) {
  std::vector<std::size_t> begins;    // begin of each part on the stack
  std::vector<std::size_t> begin_of;  // for each step, the begin of the part that the step completes
  std::vector<Beyond> beyond;
  const auto value_of_part = [&](std::size_t last) {
    return run<0>(std::span(formula).subspan(begin_of[last], last + 1 - begin_of[last]), values)[0];
  };
  for (std::size_t i = 0; i < formula.size(); ++i) {
    const Step& step = formula[i];
    std::size_t begin = i;
    for (int left = operands_of(step); left > 0; --left) {
      begin = begins.back();
      begins.pop_back();
    }
    begins.push_back(begin);
    begin_of.push_back(begin);
    const bool has_function = operands_of(step) > 0 && step.kind != Kind::choose;
    beyond.push_back(has_function ? step.function->breaks.beyond : Beyond::same);
    const bool whole_power =
        step.kind == Kind::two && step.function == &power && step.right == 0 && is_whole(value_of_part(i - 1));
    // A function that ends has no continuation, and its operands stay as they are.
    if (beyond[i] == Beyond::nothing && !whole_power)
      std::fill(beyond.begin() + static_cast<std::ptrdiff_t>(begin), beyond.end(), Beyond::same);
  }
  Steps steps;
  std::vector<std::size_t> starts;  // begin of each part on the stack, in the result
  for (std::size_t i = 0; i < formula.size(); ++i) {
    const Step& step = formula[i];
    const auto operands = static_cast<std::size_t>(operands_of(step));
    const std::size_t begin = operands == 0 ? steps.size() : starts[starts.size() - operands];
    const std::size_t last = operands == 0 ? begin : starts.back();  // begin of the last operand
    starts.resize(starts.size() - operands);
    starts.push_back(begin);
    const auto place = [&](std::size_t at) { return steps.begin() + static_cast<std::ptrdiff_t>(at); };
    switch (beyond[i]) {
      case Beyond::side:
        if (const double at = value_of_part(i - 1); at == 0) {
          steps.push_back(step);
        } else if (at < 0) {
          steps.push_back({.kind = Kind::one, .left = step.left, .function = &negative});
        }
        break;
      case Beyond::value:
        steps.resize(begin);
        steps.push_back({.kind = Kind::number, .number = value_of_part(i)});
        break;
      case Beyond::operand: {
        const double second = value_of_part(i - 1), first = value_of_part(begin_of[i - 1] - 1);
        const bool takes_first = step.function->two(first, second) == first;
        steps.erase(place(takes_first ? last : begin), takes_first ? steps.end() : place(last));
        break;
      }
      default:
        steps.push_back(step);
    }
  }
  return steps;
}

/// A factor of a product: the steps that compute this factor, and the variables in it.
struct Factor {
  Steps steps;
  unsigned char variables;  ///< coded like Step::left

  bool operator==(const Factor& other) const { return equal(steps, other.steps); }
};
using Factors = std::vector<Factor>;

/// A part of a formula as a quotient: the factors of its numerator (over) and of its denominator (under).
struct Quotient {
  Factor whole;
  Factors over, under = {};
};

/// Appends those factors of `by` that depend on variables, each of them `times` times.
void multiply(Factors& product, const Factors& by, int times = 1) {
  for (const Factor& each : by) {
    if (each.variables != 0) product.insert(product.end(), static_cast<std::size_t>(times), each);
  }
}

/// Makes `product` a multiple of `of`: appends the factors of `of` that `product` lacks.
void make_multiple(Factors& product, const Factors& of) {
  for (auto each = of.begin(); each != of.end(); ++each) {
    if (std::ranges::count(product, *each) < std::count(of.begin(), each + 1, *each)) product.push_back(*each);
  }
}

/// Returns the factors of the denominator of a formula.
Factors divisors(const Steps& formula) {
  std::vector<Quotient> stack;
  for (const Step& step : formula) {
    const std::vector<Quotient> parts(stack.end() - operands_of(step), stack.end());
    stack.resize(stack.size() - parts.size());
    Quotient joined{{{}, static_cast<unsigned char>(step.kind == Kind::variable ? 2U << step.variable : 0)}, {}};
    for (const auto& [part, over, under] : parts) {
      joined.whole.steps.insert(joined.whole.steps.end(), part.steps.begin(), part.steps.end());
      joined.whole.variables |= part.variables;
    }
    joined.whole.steps.push_back(step);
    joined.over = {joined.whole};
    const bool of_quotients = step.kind == Kind::multiply || step.kind == Kind::divide;
    if (of_quotients) {
      const bool divides = step.kind == Kind::divide;
      joined.over = parts[0].over;
      joined.under = parts[0].under;
      multiply(joined.over, divides ? parts[1].under : parts[1].over);
      multiply(joined.under, divides ? parts[1].over : parts[1].under);
    } else if (step.kind == Kind::add || step.kind == Kind::subtract ||
               (step.kind == Kind::one && step.function == &negative)) {
      // A sum: `under` is the common denominator, and `over` is the sum, as one factor, times `under`.
      for (const Quotient& part : parts) make_multiple(joined.under, part.under);
      multiply(joined.over, joined.under);
    } else if (step.kind == Kind::two && step.function == &power && parts[1].whole.variables == 0) {
      const double exponent = run<0>(parts[1].whole.steps, nullptr)[0];
      constexpr int highest = 8;
      if (std::rint(exponent) == exponent && std::abs(exponent) <= highest) {
        joined.over.clear();
        multiply(joined.over, exponent > 0 ? parts[0].over : parts[0].under, static_cast<int>(std::abs(exponent)));
        multiply(joined.under, exponent > 0 ? parts[0].under : parts[0].over, static_cast<int>(std::abs(exponent)));
      }
    }
    stack.push_back(std::move(joined));
  }
  return stack.empty() ? Factors{} : stack.back().under;
}

/// A side of an equation as rest + by[0] D + by[1] D', with the derivatives D and D'. A part without steps is 0.
struct Linear {
  Factor rest;
  std::array<Factor, 2> by = {};

  bool has_derivative() const { return !by[0].steps.empty() || !by[1].steps.empty(); }
};

/// Returns a part of a formula that an operator makes from one or two parts.
Factor joined(Factor x, Kind kind, const Function& function, const Factor& y = {}) {
  x.steps.insert(x.steps.end(), y.steps.begin(), y.steps.end());
  const unsigned char right = kind == Kind::one ? x.variables : y.variables;
  x.steps.push_back({.kind = kind, .left = x.variables, .right = right, .function = &function});
  x.variables |= y.variables;
  return x;
}

const Function& function_of(Kind kind) { return std::ranges::find(operators, kind, &Operator::kind)->function; }

Factor difference(const Factor& x, const Factor& y) {
  if (y.steps.empty()) return x;
  if (x.steps.empty()) return joined(y, Kind::one, negative);
  return joined(x, Kind::subtract, function_of(Kind::subtract), y);
}

Factor divided(const Factor& x, const Factor& by) {
  const bool is_one = by.steps.size() == 1 && by.steps[0].kind == Kind::number && by.steps[0].number == 1;
  return x.steps.empty() || is_one ? x : joined(x, Kind::divide, function_of(Kind::divide), by);
}

Factor multiplied(const Factor& x, const Factor& by) {
  if (x.steps.size() == 1 && x.steps[0].kind == Kind::number && x.steps[0].number == 1) return by;
  return x.steps.empty() ? x : joined(x, Kind::multiply, function_of(Kind::multiply), by);
}

/// Returns the side of an equation as a linear function of the derivatives; empty if it is not linear.
std::optional<Linear> linear_in_derivatives(const Steps& side) {
  std::vector<Linear> stack;
  for (const Step& step : side) {
    const std::vector<Linear> parts(stack.end() - operands_of(step), stack.end());
    stack.resize(stack.size() - parts.size());
    const auto each = [](const Linear& x, const auto& change) {
      return Linear{change(x.rest), {change(x.by[0]), change(x.by[1])}};
    };
    const auto none = [&](std::size_t part) { return !parts[part].has_derivative(); };
    Linear whole;
    if (step.kind == Kind::variable && step.variable >= first_derivative) {
      whole.by.at(step.variable - first_derivative) = {{{.kind = Kind::number, .number = 1}}, 0};
    } else if (std::ranges::none_of(parts, &Linear::has_derivative)) {
      whole.rest.variables = static_cast<unsigned char>(step.kind == Kind::variable ? 2U << step.variable : 0);
      for (const Linear& part : parts) {
        whole.rest.steps.insert(whole.rest.steps.end(), part.rest.steps.begin(), part.rest.steps.end());
        whole.rest.variables |= part.rest.variables;
      }
      whole.rest.steps.push_back(step);
    } else if (step.kind == Kind::one && step.function == &negative) {
      whole = each(parts[0], [](const Factor& x) { return difference({}, x); });
    } else if (step.kind == Kind::add || step.kind == Kind::subtract) {
      const auto sum = [&](const Factor& x, const Factor& y) {
        if (step.kind == Kind::subtract) return difference(x, y);
        return x.steps.empty() ? y : y.steps.empty() ? x : joined(x, Kind::add, function_of(Kind::add), y);
      };
      const auto& [x, y] = std::tie(parts[0], parts[1]);
      whole = {sum(x.rest, y.rest), {sum(x.by[0], y.by[0]), sum(x.by[1], y.by[1])}};
    } else if (step.kind == Kind::multiply && (none(0) || none(1))) {
      whole = each(parts[none(0) ? 1 : 0], [&](const Factor& x) { return multiplied(x, parts[none(0) ? 0 : 1].rest); });
    } else if (step.kind == Kind::divide && none(1)) {
      whole = each(parts[0], [&](const Factor& x) { return divided(x, parts[1].rest); });
    } else {
      return std::nullopt;
    }
    stack.push_back(std::move(whole));
  }
  Factor& rest = stack.back().rest;
  if (rest.steps.size() == 1 && rest.steps[0].kind == Kind::number && rest.steps[0].number == 0) rest = {};
  return stack.back();
}

/// Returns the place of the equals sign in [begin, end), which is none of the signs <=, >=, == and !=.
std::size_t equals_sign(const std::string& text, std::size_t begin, std::size_t end) {
  for (std::size_t at = begin; at < end; ++at) {
    if (text[at] != '=') continue;
    if (at + 1 < end && text[at + 1] == '=') {
      ++at;
    } else if (at == begin || std::string_view("<>!").find(text[at - 1]) == std::string_view::npos) {
      return at;
    }
  }
  return end;
}

}  // namespace formula_parts

void reject_at(std::size_t place, const std::string& text, const std::string& message, std::string_view advice) {
  throw BadInput("{}, at character {} of {}{}{}", message, place + 1, quotation(text), advice.empty() ? "" : "; ",
                 advice);
}

void require_ascii(const std::string& text) {
  const auto at = std::ranges::find_if(text, [](char c) { return static_cast<unsigned char>(c) >= 0x80; });
  if (at == text.end()) return;
  const auto place = static_cast<std::size_t>(at - text.begin());
  // UTF-8: the first byte has a leading 1 bit for each byte of the letter; later bytes begin with 10. Else Latin-1.
  std::size_t size = 1;
  while (size < 4 && place + size < text.size() && (text[place + size] & 0xC0) == 0x80) ++size;
  const std::string letter = text.substr(place, size);
  char32_t number = static_cast<unsigned char>(*at) & (size == 1 ? 0xFFU : 0xFFU >> (size + 1));
  for (const char next : letter.substr(1)) number = number << 6U | (static_cast<unsigned char>(next) & 0x3FU);
  const auto* const known = std::ranges::find(formula_parts::pasted, number, [](const auto& row) { return row.first; });
  const auto instead =
      known == std::end(formula_parts::pasted) ? "letters from a to z, digits and signs of ASCII" : known->second;
  reject_at(place, text,
            fmt::format("the letter {} (U+{:04X}) has no meaning here; type {}", quotation(letter),
                        static_cast<unsigned>(number), instead));
}

bool has_meaning(std::string_view name) { return name == "pi" || formula_parts::function_of(name) != nullptr; }

std::size_t end_of_word(std::string_view text, std::size_t begin) {
  using formula_parts::is_digit;
  using formula_parts::is_of_word;
  std::size_t end = begin;
  if (is_digit(text[begin])) {
    double value = 0;
    const auto [after, error] = std::from_chars(text.data() + begin, text.data() + text.size(), value);
    return static_cast<std::size_t>(after - text.data());
  }
  while (end < text.size() && is_of_word(text[end])) ++end;
  return std::max(end, begin + 1);
}

std::optional<TypedDerivative> derivative_at(std::string_view text, std::size_t begin) {
  using formula_parts::is_digit;
  using formula_parts::is_of_word;
  if (begin >= text.size() || !is_of_word(text[begin]) || is_digit(text[begin])) return std::nullopt;
  std::size_t at = begin;
  const auto takes = [&](std::string_view sign) {
    const std::size_t there = text.find_first_not_of(" \t", at);
    if (there == std::string_view::npos || !text.substr(there).starts_with(sign)) return false;
    at = there + sign.size();
    return true;
  };
  const auto word = [&] {
    const std::size_t from = at;
    while (at < text.size() && is_of_word(text[at])) ++at;
    return std::string(text.substr(from, at - from));
  };
  std::string letter = word();
  if (std::size_t primes = 0; at < text.size() && text[at] == '\'') {
    while (at < text.size() && text[at] == '\'') ++primes, ++at;
    return TypedDerivative{letter, primes, "", at - begin};
  }
  if (letter[0] != 'd') return std::nullopt;
  std::size_t order = 1;
  if (letter == "d" && takes("^") && at < text.size() && is_digit(text[at])) {  // d^2x/dt^2
    order = static_cast<std::size_t>(text[at++] - '0');
    if (takes("*") || at >= text.size()) return std::nullopt;
    letter = "d" + word();
  } else if (letter.size() > 2 && is_digit(letter[1])) {  // d2x/dt2
    order = static_cast<std::size_t>(letter[1] - '0');
    letter.erase(1, 1);
  }
  if (letter.size() < 2 || order < 1 || !takes("/") || !takes("d")) return std::nullopt;
  std::string by = word();
  if (order > 1 && !takes(fmt::format("^{}", order))) {
    if (by.empty() || by.back() - '0' != static_cast<int>(order)) return std::nullopt;
    by.pop_back();
  }
  if (by.empty() || is_digit(by[0])) return std::nullopt;
  return TypedDerivative{letter.substr(1), order, by, at - begin};
}

std::size_t read_name_of_equation(const FormulaShape& shape, std::string_view text, std::size_t begin,
                                  std::string& name) {
  using formula_parts::is_of_word;
  std::size_t end = begin;
  if (const auto derivative = derivative_at(text, begin)) {
    name = derivative->name();
    end += derivative->characters;
  } else {
    while (end < text.size() && is_of_word(text[end])) ++end;
    name = text.substr(begin, end - begin);
  }
  if (std::ranges::count(shape.variables, name) == 0) return end - begin;
  std::size_t at = end;  // behind "(t)", if this follows
  for (const std::string_view sign :
       {std::string_view("("), std::string_view(shape.independent), std::string_view(")")}) {
    at = text.find_first_not_of(" \t", at);
    if (at == std::string_view::npos || !text.substr(at).starts_with(sign)) return end - begin;
    at += sign.size();
  }
  return at - begin;
}

struct Formulas::Compiled {
  std::array<std::vector<formula_parts::Step>, 2> formulas;
  formula_parts::Switches switches = {};

  /// Returns the formulas of a text with their switching functions.
  /// @param unused  parameters that no formula contains
  static std::shared_ptr<const Compiled> finished(Compiled compiled, const std::string& text,
                                                  const std::map<std::string, double>& unused) {
    if (!unused.empty())
      throw BadInput("no formula of {} has the parameter {}", quotation(text), quotation(unused.begin()->first));
    const auto shared = std::make_shared<Compiled>(std::move(compiled));
    for (const auto& formula : shared->formulas) shared->switches.add(formula);
    return shared;
  }
};

namespace formula_parts {

/// Calls take(begin, place of the equals sign, end, index of the text before the equals sign in `left`) for each
/// statement of a text except values of parameters, which are added to `parameters`.
template <class Take>
void read_statements(const FormulaShape& shape, const std::string& text, std::map<std::string, double>& parameters,
                     const Take& take) {
  const auto may_be_parameter = [&](const std::string& name) {
    return !name.empty() && !is_digit(name[0]) && std::ranges::all_of(name, is_of_word) && name != "pi" &&
           !function_of(name) && std::ranges::count(shape.variables, name) == 0 && !shape.refused.contains(name);
  };
  for (const auto& [name, value] : parameters) {
    if (may_be_parameter(name)) continue;
    throw BadInput("{} cannot name a parameter: letters, digits and _ that are not {}, pi or a function",
                   quotation(name), fmt::join(shape.variables, ", "));
  }
  require_ascii(text);
  std::map<std::string, double> own;  // if a parameter is set twice, the last value counts
  for (std::size_t begin = 0, end = 0; begin <= text.size(); begin = end + 1) {
    end = std::min(text.find(';', begin), text.size());
    const std::size_t first = std::min(text.find_first_not_of(" \t\r\n", begin), end);
    if (first == end && !(begin == 0 && end == text.size())) continue;
    const std::size_t equals = equals_sign(text, first, end);
    std::string left = text.substr(first, equals < end ? equals - first : 0);
    std::erase_if(left, [](unsigned char c) { return std::isspace(c); });
    const std::string value = equals < end ? text.substr(equals + 1, end - equals - 1) : "";
    const auto which = static_cast<std::size_t>(std::ranges::find(shape.left, left) - shape.left.begin());
    if (which == shape.left.size() && may_be_parameter(left) && is_number(value)) {
      own[left] = parse_number(value);
    } else {
      take(first, equals, end, left.empty() ? shape.left.size() : which);
    }
  }
  parameters.merge(own);
}

}  // namespace formula_parts

Formulas::Formulas(const FormulaShape& shape, const std::string& text, std::map<std::string, double> parameters) {
  std::array<std::optional<std::array<std::size_t, 2>>, 2> found;  // begin and end of each formula
  formula_parts::read_statements(shape, text, parameters, [&](auto first, auto equals, auto end, std::size_t which) {
    const bool bare = shape.left[0].empty() && equals == end && !found[0];
    if (bare) which = 0;
    if (which == shape.left.size()) {
      const std::string second = shape.left[1].empty() ? "" : fmt::format(" or {} =", shape.left[1]);
      reject_at(first, text, fmt::format("{} ={} is missing", shape.left[0], second), shape.sentence);
    }
    if (found[which]) reject_at(first, text, fmt::format("{} stands there twice", shape.left[which]), shape.sentence);
    found[which] = {{bare ? first : equals + 1, end}};
  });
  std::map<std::string, double> unused = parameters;
  Compiled compiled;
  for (std::size_t i = 0; i < 2; ++i) {
    if (shape.left[i].empty() && !found[i]) continue;
    if (!found[i]) reject_at(text.size(), text, fmt::format("{} = is missing", shape.left[i]), shape.sentence);
    const auto& [from, to] = *found[i];
    compiled.formulas[i] = formula_parts::Parser(shape, parameters, unused, text, from, to).steps;
  }
  compiled_ = Compiled::finished(std::move(compiled), text, unused);
}

Formulas Formulas::of_equations(const FormulaShape& shape, const std::string& text,
                                std::map<std::string, double> parameters) {
  using formula_parts::difference;
  std::vector<std::array<std::size_t, 3>> equations;
  formula_parts::read_statements(shape, text, parameters, [&](auto first, auto equals, auto end, std::size_t) {
    equations.push_back({first, equals, end});
  });
  std::map<std::string, double> unused = parameters;
  Compiled compiled;
  const auto linear = [&](std::size_t from, std::size_t to) {
    return linear_in_derivatives(formula_parts::Parser(shape, parameters, unused, text, from, to).steps);
  };
  const std::string names = fmt::format("{}", fmt::join(shape.derivatives, " and "));
  for (const auto& [first, equals, end] : equations) {
    const auto reject = [&, place = first](const std::string& message) {
      reject_at(place, text, message, shape.sentence);
    };
    if (equals == end) reject_at(end, text, "an equals sign is missing", shape.sentence);
    const auto left = linear(first, equals), right = linear(equals + 1, end);
    if (!left || !right) reject(fmt::format("the equation is not linear in {}", names));
    std::array<formula_parts::Factor, 2> by;
    for (std::size_t i = 0; i < 2; ++i) by.at(i) = difference(left->by.at(i), right->by.at(i));
    formula_parts::Factor rest = difference(right->rest, left->rest);
    if (shape.differentials) {
      if (!rest.steps.empty() || by[0].steps.empty() || by[1].steps.empty())
        reject(fmt::format("each term must contain one of {}", names));
      rest = difference(right->by[0], left->by[0]);
      by[0] = std::exchange(by[1], {});
    }
    const std::size_t which = by[0].steps.empty() ? 1 : 0;
    if (by.at(which).steps.empty())
      reject("no derivative stands in this equation; one is needed, and a start is no equation but an option");
    if (!by.at(1 - which).steps.empty()) reject(names + " both stand in this equation; one is needed");
    if (!compiled.formulas.at(which).empty()) reject("a second equation of " + shape.derivatives[which]);
    if (rest.steps.empty()) rest.steps = {{.kind = formula_parts::Kind::number, .number = 0}};
    compiled.formulas.at(which) = divided(rest, by.at(which)).steps;
  }
  for (std::size_t i = 0; i < (shape.differentials ? 1 : shape.derivatives.size()); ++i) {
    if (compiled.formulas.at(i).empty())
      reject_at(text.size(), text, fmt::format("the equation of {} is missing", shape.derivatives[i]), shape.sentence);
  }
  return Formulas(Compiled::finished(std::move(compiled), text, unused));
}

std::array<double, 2> Formulas::operator()(std::initializer_list<double> values) const {
  const auto& [first, second] = compiled_->formulas;
  return {formula_parts::run<0>(first, values.begin())[0], formula_parts::run<0>(second, values.begin())[0]};
}

Eigen::MatrixX3d Formulas::switches(const std::array<double, 2>& values) const {
  return compiled_->switches.at(values.data());
}

Formulas Formulas::branch(const std::array<double, 2>& values) const {
  Compiled compiled;
  for (std::size_t i = 0; i < 2; ++i) {
    compiled.formulas[i] = formula_parts::branch(compiled_->formulas[i], values.data());
    compiled.switches.add(compiled.formulas[i]);
  }
  return Formulas(std::make_shared<const Compiled>(std::move(compiled)));
}

std::optional<Formulas> Formulas::denominator() const {
  using formula_parts::Kind;
  formula_parts::Factors all;
  for (const auto& formula : compiled_->formulas) make_multiple(all, formula_parts::divisors(formula));
  if (all.empty()) return std::nullopt;
  Compiled compiled;
  auto& [product, none] = compiled.formulas;
  unsigned char before = 0;
  for (const auto& [steps, variables] : all) {
    product.insert(product.end(), steps.begin(), steps.end());
    if (&steps != &all.front().steps) {
      product.push_back({.kind = Kind::multiply, .left = before, .right = variables, .number = 0});
    }
    before |= variables;
  }
  return Formulas(std::make_shared<const Compiled>(std::move(compiled)));
}

std::optional<std::array<Expression, 2>> Formulas::expressions() const {
  using formula_parts::Kind;
  std::array<Expression, 2> both{0, 0};
  for (std::size_t i = 0; i < 2; ++i) {
    std::vector<Expression> stack;
    for (const formula_parts::Step& step : compiled_->formulas[i]) {
      const std::vector<Expression> of(stack.end() - formula_parts::operands_of(step), stack.end());
      stack.resize(stack.size() - of.size(), 0);
      try {
        switch (step.kind) {
          case Kind::number:
            stack.emplace_back(Number(step.number));
            break;
          case Kind::variable:
            stack.push_back(Expression::variable(step.variable));
            break;
          case Kind::one:
            stack.push_back(
                step.function == &formula_parts::negative ? -of[0] : Expression::function(step.function->name, of[0]));
            break;
          case Kind::two:
            if (step.function == &formula_parts::power) {
              const bool is_e = of[0].is(Expression::Kind::number) && of[0].number().value() == std::numbers::e;
              stack.push_back(is_e ? Expression::function("exp", of[1]) : power(of[0], of[1]));
            } else if (step.function->name == "hypot") {
              stack.push_back(power(of[0] * of[0] + of[1] * of[1], Number(1, 2)));
            } else if (step.function->name == "sum" || step.function->name == "avg") {
              stack.push_back(of[0] + of[1]);
            } else {
              return std::nullopt;
            }
            break;
          case Kind::choose:
            return std::nullopt;
          case Kind::add:
            stack.push_back(of[0] + of[1]);
            break;
          case Kind::subtract:
            stack.push_back(of[0] - of[1]);
            break;
          case Kind::multiply:
            stack.push_back(of[0] * of[1]);
            break;
          case Kind::divide:
            stack.push_back(of[0] / of[1]);
            break;
        }
      } catch (const std::exception&) {
        return std::nullopt;  // another function, or too long a formula
      }
    }
    if (!stack.empty()) both[i] = stack.back();
  }
  return both;
}

template <std::size_t N>
std::array<Dual<N>, 2> Formulas::with_slopes(const std::array<double, N>& values) const {
  const auto& [first, second] = compiled_->formulas;
  return {formula_parts::run<N>(first, values.data()), formula_parts::run<N>(second, values.data())};
}
template std::array<Dual<1>, 2> Formulas::with_slopes(const std::array<double, 1>&) const;
template std::array<Dual<2>, 2> Formulas::with_slopes(const std::array<double, 2>&) const;

namespace {

/// Returns the value of a formula of numbers, which may be infinite or NaN; empty for other text.
std::optional<double> formula_of_numbers(const std::string& text) {
  if (text.find_first_not_of("+-") > 1) return std::nullopt;  // two signs, as in +-1, are a mistake
  try {
    return Formulas({.left = {}, .variables = {}, .sentence = "a value is a number"}, text, {})({})[0];
  } catch (const BadInput&) {
    return std::nullopt;
  }
}

}  // namespace

double parse_constant(const std::string& text) {
  const auto value = is_number(text) ? std::nullopt : formula_of_numbers(text);
  if (!value) return parse_number(text);
  if (!std::isfinite(*value)) throw BadInput("{} is not a finite number", quotation(text));
  return *value;
}

bool is_constant(const std::string& text) { return is_number(text) || formula_of_numbers(text); }

}  // namespace contensou::answers
