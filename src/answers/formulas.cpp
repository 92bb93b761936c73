#include "answers/formulas.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <muParser.h>

#include "answers/errors.hpp"
#include "answers/parse.hpp"
#include "text/nearest_name.hpp"

namespace contensou::answers {

namespace {

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

void compile(mu::Parser& parser, const FormulaShape& shape, std::vector<double>& values,
             std::map<std::string, double>& parameters, const std::string& text, std::size_t begin, std::size_t end) {
  const Translated translated = without_bars(text, begin, end);
  try {
    parser.DefineFun("hypot", hypotenuse);
    parser.DefineFun("sign", sign);
    parser.DefineConst("pi", std::numbers::pi);
    for (std::size_t i = 0; i < values.size(); ++i) parser.DefineVar(shape.variables[i], &values[i]);
    for (auto& [name, value] : parameters) parser.DefineVar(name, &value);
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
      std::vector<std::string> names = shape.variables;
      names.emplace_back("pi");
      for (const auto& [name, value] : parameters) names.push_back(name);
      for (const auto& [name, function] : parser.GetFunDef()) names.push_back(name);
      if (const auto refused = shape.refused.find(typed); refused != shape.refused.end()) {
        reject(text, place, fmt::format("{}: {}", quotation(typed), refused->second));
      }
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

struct Formulas::Compiled {
  std::array<mu::Parser, 2> formulas;
  std::vector<double> values;                ///< of the variables
  std::map<std::string, double> parameters;  ///< parsers point at both
};

Formulas::Formulas(const FormulaShape& shape, const std::string& text, std::map<std::string, double> parameters)
    : compiled_(std::make_unique<Compiled>()) {
  compiled_->values.resize(shape.variables.size(), 1);
  compiled_->parameters = std::move(parameters);
  const auto may_be_parameter = [&](const std::string& name) {
    const bool spelled = !name.empty() && (std::isalpha(static_cast<unsigned char>(name[0])) || name[0] == '_') &&
                         std::ranges::all_of(name, [](unsigned char c) { return std::isalnum(c) || c == '_'; });
    return spelled && std::ranges::count(shape.variables, name) == 0 && name != "pi" && !shape.refused.contains(name) &&
           !mu::Parser().GetFunDef().contains(name);
  };
  for (const auto& [name, value] : compiled_->parameters) {
    if (may_be_parameter(name)) continue;
    throw BadInput(fmt::format("{} cannot name a parameter: letters, digits and _ that are not {}, pi or a function",
                               quotation(name), fmt::join(shape.variables, ", ")));
  }
  struct Piece {
    std::size_t begin = 0, end = 0;
  };
  std::array<std::optional<Piece>, 2> found;
  std::map<std::string, double> own;  // the last of a name counts
  std::size_t begin = 0;
  while (begin <= text.size()) {
    const std::size_t end = std::min(text.find(';', begin), text.size());
    const std::size_t first = std::min(text.find_first_not_of(" \t\r\n", begin), end);
    if (first < end || (begin == 0 && end == text.size())) {
      const std::size_t equals = text.find('=', first);
      std::string left = equals < end ? text.substr(first, equals - first) : "";
      std::erase_if(left, [](unsigned char c) { return std::isspace(c); });
      const auto which = static_cast<std::size_t>(std::ranges::find(shape.left, left) - shape.left.begin());
      if (which == shape.left.size()) {
        const std::string value = equals < end ? text.substr(equals + 1, end - equals - 1) : "";
        if (!may_be_parameter(left) || !is_number(value)) {
          reject(text, first, fmt::format("{} = or {} = is missing: {}", shape.left[0], shape.left[1], shape.sentence));
        }
        own[left] = parse_number(value);
      } else if (found[which]) {
        reject(text, first, fmt::format("{} stands there twice: {}", left, shape.sentence));
      } else {
        found[which] = {equals + 1, end};
      }
    }
    begin = end + 1;
  }
  compiled_->parameters.merge(own);
  for (std::size_t i : {0, 1}) {
    if (!found[i]) reject(text, text.size(), fmt::format("{} = is missing: {}", shape.left[i], shape.sentence));
    compile(compiled_->formulas[i], shape, compiled_->values, compiled_->parameters, text, found[i]->begin,
            found[i]->end);
  }
  for (const auto& [name, value] : compiled_->parameters) {
    const auto has = [&name = name](const mu::Parser& formula) { return formula.GetUsedVar().contains(name); };
    if (std::ranges::none_of(compiled_->formulas, has)) {
      throw BadInput(fmt::format("no formula of {} has the parameter {}", quotation(text), quotation(name)));
    }
  }
}

Formulas::~Formulas() = default;

std::array<double, 2> Formulas::operator()(std::initializer_list<double> values) {
  std::ranges::copy(values, compiled_->values.begin());
  return {compiled_->formulas[0].Eval(), compiled_->formulas[1].Eval()};
}

}  // namespace contensou::answers
