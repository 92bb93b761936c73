// As much of muParser 2.3 as answers/formulas.cpp asks for, with its grammar, where all is compiled from headers alone (the page,
// the wheel, Windows), and Debian's muParser, a library with streams, is not at hand.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mu {

enum EErrorCodes { ecUNASSIGNABLE_TOKEN, ecSYNTAX };

class ParserError {
 public:
  ParserError(EErrorCodes code, std::size_t place, std::string message)
      : code_(code), place_(static_cast<int>(place)), message_(std::move(message)) {}
  EErrorCodes GetCode() const { return code_; }
  int GetPos() const { return place_; }
  const std::string& GetMsg() const { return message_; }

 private:
  EErrorCodes code_;
  int place_;
  std::string message_;
};

namespace parts {

using One = double (*)(double);
using Two = double (*)(double, double);

/// Of one number, of two, or of any number, two at a time.
struct Function {
  std::string_view name;
  One one = nullptr;
  Two two = nullptr;
  bool of_any = false;
};

/// On a stack: puts a number or a variable there, or replaces the last by what a function makes of them.
struct Step {
  double number = 0;
  const double* variable = nullptr;
  One one = nullptr;
  Two two = nullptr;
  bool chooses = false;  ///< the second or the third of three, by the first
};

struct Operator {
  int level;
  std::string_view sign;
  Two of;
};
inline constexpr int levels = 4;
inline constexpr std::array operators{
    Operator{0, "&&", [](double a, double b) -> double { return a != 0 && b != 0; }},
    Operator{1, "<=", [](double a, double b) -> double { return a <= b; }},
    Operator{1, ">=", [](double a, double b) -> double { return a >= b; }},
    Operator{1, "==", [](double a, double b) -> double { return a == b; }},
    Operator{1, "!=", [](double a, double b) -> double { return a != b; }},
    Operator{1, "<", [](double a, double b) -> double { return a < b; }},
    Operator{1, ">", [](double a, double b) -> double { return a > b; }},
    Operator{2, "+", [](double a, double b) { return a + b; }},
    Operator{2, "-", [](double a, double b) { return a - b; }},
    Operator{3, "*", [](double a, double b) { return a * b; }},
    Operator{3, "/", [](double a, double b) { return a / b; }},
};
inline constexpr std::array known{
    Function{"sin", std::sin},
    Function{"cos", std::cos},
    Function{"tan", std::tan},
    Function{"asin", std::asin},
    Function{"acos", std::acos},
    Function{"atan", std::atan},
    Function{"sinh", std::sinh},
    Function{"cosh", std::cosh},
    Function{"tanh", std::tanh},
    Function{"asinh", std::asinh},
    Function{"acosh", std::acosh},
    Function{"atanh", std::atanh},
    Function{"exp", std::exp},
    Function{"sqrt", std::sqrt},
    Function{"ln", std::log},
    Function{"log", std::log},
    Function{"log2", std::log2},
    Function{"log10", std::log10},
    Function{"rint", std::rint},
    Function{"abs", std::fabs},
    Function{"atan2", nullptr, std::atan2},
    Function{"min", nullptr, [](double a, double b) { return std::min(a, b); }, true},
    Function{"max", nullptr, [](double a, double b) { return std::max(a, b); }, true},
    Function{"sum", nullptr, [](double a, double b) { return a + b; }, true},
};

}  // namespace parts

class Parser {
  using One = parts::One;
  using Two = parts::Two;
  using Function = parts::Function;

 public:
  Parser() {
    for (const Function& function : parts::known) functions_.emplace(function.name, function);
  }

  void DefineFun(const std::string& name, One function) { functions_[name] = {.one = function}; }
  void DefineFun(const std::string& name, Two function) { functions_[name] = {.two = function}; }
  void DefineConst(const std::string& name, double value) { constants_[name] = value; }
  void DefineVar(const std::string& name, double* value) { variables_[name] = value; }
  const std::map<std::string, Function>& GetFunDef() const { return functions_; }
  const std::map<std::string, double*>& GetUsedVar() const { return used_; }
  int GetNumResults() const { return results_; }

  void SetExpr(std::string formula) {
    formula_ = std::move(formula);
    steps_.clear();
  }

  /// @throws ParserError  at the first call
  double Eval() {
    if (steps_.empty()) parse();
    std::size_t size = 0;
    const auto top = [&](std::size_t below) -> double& { return stack_[size - 1 - below]; };
    for (const parts::Step& step : steps_) {
      if (step.one) {
        top(0) = step.one(top(0));
      } else if (step.two) {
        top(1) = step.two(top(1), top(0));
        --size;
      } else if (step.chooses) {
        top(2) = top(2) != 0 ? top(1) : top(0);
        size -= 2;
      } else {
        stack_[size++] = step.variable ? *step.variable : step.number;
      }
    }
    return stack_[0];
  }

 private:
  void parse() {
    at_ = 0;
    results_ = 0;
    do {
      choice();
      ++results_;
    } while (takes(","));
    if (at_ < formula_.size()) reject("unexpected character");
    stack_.resize(steps_.size());
  }

  [[noreturn]] void reject(const char* message) const { throw ParserError(ecSYNTAX, at_, message); }

  bool takes(std::string_view sign) {
    at_ = std::min(formula_.find_first_not_of(" \t\r\n", at_), formula_.size());
    if (formula_.compare(at_, sign.size(), sign) != 0) return false;
    at_ += sign.size();
    return true;
  }

  void choice() {
    binary(0);
    if (!takes("?")) return;
    choice();
    if (!takes(":")) reject("':' of a choice is missing");
    choice();
    steps_.push_back({.chooses = true});
  }

  /// Operators of that level, and those that bind more.
  void binary(int level) {
    if (level == parts::levels) return sign();
    binary(level + 1);
    for (;;) {
      const auto found = std::ranges::find_if(
          parts::operators, [&](const parts::Operator& one) { return one.level == level && takes(one.sign); });
      if (found == parts::operators.end()) return;
      binary(level + 1);
      steps_.push_back({.two = found->of});
    }
  }

  void sign() {
    if (takes("+")) return sign();
    if (!takes("-")) return power();
    sign();
    steps_.push_back({.one = [](double a) { return -a; }});
  }

  void power() {
    operand();
    if (!takes("^")) return;
    sign();
    steps_.push_back({.two = std::pow});
  }

  void operand() {
    if (takes("(")) {
      choice();
      if (!takes(")")) reject("')' is missing");
      return;
    }
    const std::size_t begin = at_;
    const auto is_digit = [&] { return at_ < formula_.size() && formula_[at_] >= '0' && formula_[at_] <= '9'; };
    const auto is_letter = [&] {
      const char c = at_ < formula_.size() ? formula_[at_] : ' ';
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
    };
    if (is_digit() || (at_ < formula_.size() && formula_[at_] == '.')) {
      char* end = nullptr;
      const double number = std::strtod(formula_.c_str() + at_, &end);
      if (end == formula_.c_str() + at_) reject("unexpected character");
      at_ = static_cast<std::size_t>(end - formula_.c_str());
      return steps_.push_back({.number = number});
    }
    while (is_letter() || (at_ > begin && is_digit())) ++at_;
    const std::string name = formula_.substr(begin, at_ - begin);
    if (const auto found = variables_.find(name); found != variables_.end()) {
      used_.insert(*found);
      steps_.push_back({.variable = found->second});
    } else if (const auto constant = constants_.find(name); constant != constants_.end()) {
      steps_.push_back({.number = constant->second});
    } else if (const auto function = functions_.find(name); function != functions_.end()) {
      call(function->second);
    } else if (name.empty()) {
      reject("a number or a name is missing");
    } else {
      throw ParserError(ecUNASSIGNABLE_TOKEN, begin, "unexpected name");
    }
  }

  void call(const Function& function) {
    if (!takes("(")) reject("'(' of a function is missing");
    int count = 0;
    do {
      choice();
      if (++count > 1 && function.two) steps_.push_back({.two = function.two});
    } while (takes(","));
    if (!takes(")")) reject("')' is missing");
    if (!function.of_any && count != (function.one ? 1 : 2)) reject("another number of values is needed");
    if (function.one) steps_.push_back({.one = function.one});
  }

  std::map<std::string, Function> functions_;
  std::map<std::string, double> constants_;
  std::map<std::string, double*> variables_, used_;
  std::string formula_;
  std::vector<parts::Step> steps_;
  std::vector<double> stack_;
  std::size_t at_ = 0;
  int results_ = 0;
};

}  // namespace mu
