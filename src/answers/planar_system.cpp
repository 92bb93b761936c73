#include "answers/planar_system.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <vector>

#include <fmt/format.h>
#include <muParser.h>

#include "answers/errors.hpp"
#include "answers/parse.hpp"
#include "text/nearest_name.hpp"

namespace contensou::answers {

namespace {

struct Formulas {
  std::array<mu::Parser, 2> rates;  ///< u', v'
  double u = 0, v = 0;
  std::map<std::string, double> parameters;
};

/// A formula in muParser's words, and where each of its letters stood.
struct Translated {
  std::string formula;
  std::vector<std::size_t> places;
};

[[noreturn]] void reject(const std::string& text, std::size_t place, const std::string& message) {
  throw BadInput(fmt::format("{}, at character {} of {}", message, place + 1, quotation(text)));
}

/// |x| as abs(x). A bar opens where an operand is due.
Translated without_bars(const std::string& text, std::size_t begin, std::size_t end) {
  Translated result;
  const auto append = [&](const std::string& letters, std::size_t place) {
    result.formula += letters;
    result.places.insert(result.places.end(), letters.size(), place);
  };
  std::vector<std::size_t> open;
  bool operand_due = true;
  for (std::size_t i = begin; i < end; ++i) {
    const char letter = text[i];
    if (letter == '|') {
      if (!operand_due && open.empty()) reject(text, i, "'|' closes nothing: |x| needs an operator before it");
      if (operand_due) {
        open.push_back(i);
      } else {
        open.pop_back();
      }
      append(operand_due ? "abs(" : ")", i);
      continue;
    }
    append({letter}, i);
    if (!std::isspace(static_cast<unsigned char>(letter))) {
      operand_due = std::string_view("+-*/^(,<>=!&?:").find(letter) != std::string_view::npos;
    }
  }
  if (!open.empty()) reject(text, open.back(), "'|' is not closed");
  result.places.push_back(end);
  return result;
}

double hypotenuse(double x, double y) { return std::hypot(x, y); }
double sign(double x) { return x > 0 ? 1 : x < 0 ? -1 : x; }

void compile(mu::Parser& parser, Formulas& formulas, const std::string& text, std::size_t begin, std::size_t end) {
  const Translated translated = without_bars(text, begin, end);
  try {
    parser.DefineFun("hypot", hypotenuse);
    parser.DefineFun("sign", sign);
    parser.DefineConst("pi", std::numbers::pi);
    parser.DefineVar("u", &formulas.u);
    parser.DefineVar("v", &formulas.v);
    for (auto& [name, value] : formulas.parameters) parser.DefineVar(name, &value);
    parser.SetExpr(translated.formula);
    parser.Eval();
    if (parser.GetNumResults() != 1) reject(text, begin, "a formula is one number: a decimal point is a point");
  } catch (const mu::ParserError& error) {
    const auto at = static_cast<std::size_t>(std::max(error.GetPos(), 0));
    const std::size_t place = translated.places[std::min(at, translated.places.size() - 1)];
    if (error.GetCode() == mu::ecUNASSIGNABLE_TOKEN) {
      std::string typed;
      for (std::size_t i = place; i < end && (std::isalnum(static_cast<unsigned char>(text[i])) || text[i] == '_');
           ++i) {
        typed += text[i];
      }
      std::vector<std::string> names{"u", "v", "pi"};
      for (const auto& [name, value] : formulas.parameters) names.push_back(name);
      for (const auto& [name, function] : parser.GetFunDef()) names.push_back(name);
      if (!typed.empty() && !std::isdigit(static_cast<unsigned char>(typed[0]))) {
        reject(text, place,
               fmt::format("{} is no variable, parameter or function{}: give its value with --param {}=VALUE",
                           quotation(typed), suggestion(typed, names), typed));
      }
    }
    std::string message = error.GetMsg();
    message = message.substr(0, message.find(" found at position"));
    message = message.substr(0, message.find(" at position"));
    if (!message.empty() && message.back() == '.') message.pop_back();
    if (!message.empty()) message[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(message[0])));
    reject(text, place, message);
  }
}

}  // namespace

reduction::PlanarField parse_planar_system(const std::string& text, const std::map<std::string, double>& parameters) {
  constexpr const char* shape = "a system is \"u' = F; v' = G\"";
  const auto formulas = std::make_shared<Formulas>();
  formulas->parameters = parameters;
  for (const auto& [name, value] : parameters) {
    const bool spelled = !name.empty() && (std::isalpha(static_cast<unsigned char>(name[0])) || name[0] == '_') &&
                         std::ranges::all_of(name, [](unsigned char c) { return std::isalnum(c) || c == '_'; });
    if (!spelled || name == "u" || name == "v" || name == "pi" || mu::Parser().GetFunDef().contains(name)) {
      throw BadInput(fmt::format(
          "{} cannot name a parameter: letters, digits and _ that are not u, v, pi or a function", quotation(name)));
    }
  }
  std::array<bool, 2> found{};
  std::size_t begin = 0;
  while (begin <= text.size()) {
    const std::size_t end = std::min(text.find(';', begin), text.size());
    const std::size_t first = std::min(text.find_first_not_of(" \t\r\n", begin), end);
    if (first < end || (begin == 0 && end == text.size())) {
      const std::size_t equals = text.find('=', first);
      std::string left = equals < end ? text.substr(first, equals - first) : "";
      std::erase_if(left, [](unsigned char c) { return std::isspace(c); });
      if (left != "u'" && left != "v'") reject(text, first, fmt::format("u' = or v' = is missing: {}", shape));
      const std::size_t which = left == "u'" ? 0 : 1;
      if (std::exchange(found[which], true)) reject(text, first, fmt::format("{} stands there twice: {}", left, shape));
      compile(formulas->rates[which], *formulas, text, equals + 1, end);
    }
    begin = end + 1;
  }
  if (!found[0] || !found[1]) {
    reject(text, text.size(), fmt::format("{}' = is missing: {}", found[0] ? "v" : "u", shape));
  }
  for (const auto& [name, value] : parameters) {
    if (!formulas->rates[0].GetUsedVar().contains(name) && !formulas->rates[1].GetUsedVar().contains(name)) {
      throw BadInput(fmt::format("no formula of {} has the parameter {}", quotation(text), quotation(name)));
    }
  }
  return [formulas](const Eigen::Vector2d& x) {
    formulas->u = x[0];
    formulas->v = x[1];
    return Eigen::Vector2d(formulas->rates[0].Eval(), formulas->rates[1].Eval());
  };
}

}  // namespace contensou::answers
