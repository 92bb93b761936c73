#include "answers/asked/planar_system.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <numbers>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "answers/input/errors.hpp"
#include "answers/input/parse.hpp"

namespace contensou::answers {

namespace {

using Equations = FormulaField::Equations;

constexpr std::string_view equation_forms =
    "type a system \"x' = F; y' = G\" or one equation \"y' = F(x, y)\" or \"x'' = F(x, x')\", in any letters; also "
    "dx/dt, x'(t), \"M dx + N dy = 0\", and equations that are linear in the highest derivative";

/// Returns true for the name of a variable that needs no dx/dt to be told from a product: one letter, with an index or
/// not, or a Greek one.
bool is_letter(std::string_view name) {
  constexpr std::string_view greek[]{"alpha", "beta", "delta", "epsilon", "eta",   "gamma", "lambda", "mu", "nu",
                                     "omega", "phi",  "psi",   "rho",     "sigma", "tau",   "theta",  "xi", "zeta"};
  if (std::ranges::count(greek, name) > 0) return true;
  const auto is_index = [](char c) { return c == '_' || (c >= '0' && c <= '9'); };
  return !name.empty() && std::isalpha(static_cast<unsigned char>(name[0])) &&
         std::ranges::all_of(name.substr(1), is_index);
}

/// Returns the text with a semicolon in place of each line end, and of each comma outside brackets that separates
/// equations: an equals sign follows before the next comma or semicolon.
std::string with_semicolons(std::string text) {
  int depth = 0;
  for (std::size_t at = 0; at < text.size(); ++at) {
    depth += text[at] == '(' ? 1 : text[at] == ')' ? -1 : 0;
    const std::size_t next = text[at] == ',' && depth == 0 ? text.find_first_of("=;,\n", at + 1) : std::string::npos;
    if (text[at] == '\n' || (next != std::string::npos && text[next] == '=')) text[at] = ';';
  }
  return text;
}

/// A name in a text and its place.
struct Named {
  std::string name;
  std::size_t place;
};

/// The derivatives and the other names of a text.
struct Scanned {
  std::vector<std::pair<TypedDerivative, std::size_t>> derivatives;  ///< with their places
  std::vector<Named> names;
  std::string independent;  ///< letter of dx/dt or x'(t); empty if there is none
  bool has_e = false;       ///< true: e^ stands in the text, with Euler's number

  /// Returns the letters of derivatives, or of differentials dx, in the order of their appearance.
  std::vector<Named> letters(bool of_differentials) const {
    std::vector<Named> all;
    const auto add = [&](const std::string& letter, std::size_t place) {
      if (std::ranges::count(all, letter, &Named::name) == 0) all.push_back({letter, place});
    };
    for (const auto& [derivative, place] : derivatives) add(derivative.letter, place);
    for (const auto& [name, place] : names) {
      if (of_differentials && name[0] == 'd' && is_letter(name.substr(1))) add(name.substr(1), place);
    }
    return all;
  }
};

/// Reads the names of a text.
/// @param values  names that have a value, which are no variables
Scanned scanned(const std::string& text, const std::map<std::string, double>& values) {
  Scanned all;
  const auto set_independent = [&](const std::string& letter, std::size_t place) {
    if (!all.independent.empty() && all.independent != letter)
      reject_at(place, text, fmt::format("both {} and {} are independent", all.independent, letter), equation_forms);
    all.independent = letter;
  };
  for (std::size_t at = 0; at < text.size();) {
    const auto derivative = derivative_at(text, at);
    if (derivative && !values.contains("d" + derivative->letter)) {
      const bool has_value = values.contains(derivative->letter);
      if (has_value || has_meaning(derivative->letter)) {
        reject_at(at, text,
                  fmt::format("{} has a {}, and therefore no derivative", derivative->letter,
                              has_value ? "value" : "meaning of its own"));
      }
      all.derivatives.emplace_back(*derivative, at);
      if (!derivative->by.empty()) set_independent(derivative->by, at);
      at += derivative->characters;
      // x'(t)
      const std::size_t open = std::min(text.find_first_not_of(' ', at), text.size());
      const std::size_t close = text.find(')', open);
      if (open < text.size() && text[open] == '(' && close != std::string::npos) {
        std::string letter = text.substr(open + 1, close - open - 1);
        std::erase(letter, ' ');
        const bool is_name = !letter.empty() && std::isalpha(static_cast<unsigned char>(letter[0])) &&
                             end_of_word(letter, 0) == letter.size();
        const bool is_state =
            std::ranges::any_of(all.derivatives, [&](const auto& other) { return other.first.letter == letter; });
        if (is_name && !is_state && !values.contains(letter)) {
          set_independent(letter, open + 1);
          at = close + 1;
        }
      }
      continue;
    }
    const std::size_t end = end_of_word(text, at);
    std::string name = text.substr(at, end - at);
    const bool is_name = std::isalpha(static_cast<unsigned char>(name[0])) || name[0] == '_';
    const std::size_t next = std::min(text.find_first_not_of(' ', end), text.size());
    const bool is_e = name == "e" && next < text.size() && text[next] == '^' && !values.contains(name);
    all.has_e |= is_e;
    if (is_name && !is_e && !has_meaning(name) && !values.contains(name)) all.names.push_back({std::move(name), at});
    at = end;
  }
  return all;
}

/// Returns the independent letter of an equation of first order for a state.
std::string independent_of_first(const Scanned& found, const std::string& state, std::size_t place,
                                 const std::string& text) {
  if (!found.independent.empty()) return found.independent;
  std::vector<std::string> others;
  for (const auto& [name, where] : found.names) {
    if (name != state && is_letter(name) && std::ranges::count(others, name) == 0) others.push_back(name);
  }
  const auto has = [&](std::string_view name) { return std::ranges::count(others, name) > 0; };
  // In these pairs of letters, a system is meant, whose second equation is missing.
  constexpr std::pair<std::string_view, std::string_view> pairs[]{{"x", "y"}, {"u", "v"}, {"v", "u"}};
  for (const auto& [one, other] : pairs) {
    if (state == one && has(other)) {
      reject_at(text.size(), text,
                fmt::format("{1}' = is missing; if {1} is independent, type d{0}/d{1} = F", one, other),
                equation_forms);
    }
  }
  const std::string usual = state == "y" ? "x" : "t";
  if (has(usual) || others.empty()) return usual;
  if (has("t")) return "t";
  if (others.size() > 1) {
    reject_at(
        place, text,
        fmt::format("{} have no value; the equation of {} has one independent letter: give the others a value with "
                    "--param NAME=VALUE",
                    fmt::join(others, ", "), state));
  }
  return others.front();
}

}  // namespace

FormulaField parse_planar_system(const std::string& typed, const std::map<std::string, double>& given) {
  require_ascii(typed);
  const std::string text = with_semicolons(typed);
  std::map<std::string, double> parameters = given, values = given;
  for (std::size_t begin = 0, end = 0; begin < text.size(); begin = end + 1) {
    end = std::min(text.find(';', begin), text.size());
    const std::size_t name = std::min(text.find_first_not_of(" \t\r\n", begin), end);
    if (name == end) continue;
    const std::size_t name_end = end_of_word(text, name), equals = text.find_first_not_of(' ', name_end);
    if (equals < end && text[equals] == '=' && is_number(text.substr(equals + 1, end - equals - 1)))
      values.emplace(text.substr(name, name_end - name), 0);
  }
  const Scanned found = scanned(text, values);
  const bool differentials = found.derivatives.empty();
  std::vector<Named> letters = found.letters(differentials);
  const auto reject = [&](std::size_t place, const std::string& message) {
    reject_at(place, text, message, equation_forms);
  };
  std::size_t order = 1;
  for (const auto& [derivative, place] : found.derivatives) {
    if (derivative.order > 2) reject(place, fmt::format("{} has the order {}", derivative.name(), derivative.order));
    order = std::max(order, derivative.order);
  }
  if (letters.empty()) reject(0, "no derivative stands there");
  const auto word = [](std::size_t count) { return count == 3 ? "three" : fmt::to_string(count); };
  if (letters.size() > 2)
    reject(letters[2].place, fmt::format("{} equations: contensou solves two", word(letters.size())));
  if (letters.size() == 2 && order == 2)
    reject(letters[1].place,
           "two equations, one of them of second order: contensou solves one equation of second order");
  if (differentials && letters.size() == 1) reject(letters[0].place, "one more differential is needed");

  FormulaShape shape{.left = {}, .variables = {}, .sentence = std::string(equation_forms)};
  std::string independent = found.independent.empty() ? "t" : found.independent;
  Equations equations = Equations::system;
  const auto& [state, place] = letters[0];
  if (differentials) {
    // The independent letter is x or t, if one of them is there.
    const bool swapped = letters[1].name == "x" || (letters[1].name == "t" && state != "x");
    if (swapped) std::swap(letters[0], letters[1]);
    equations = Equations::first;
    shape.variables = {letters[0].name, letters[1].name};
    shape.derivatives = {"d" + letters[0].name, "d" + letters[1].name};
    shape.differentials = true;
    independent = letters[0].name;
  } else if (letters.size() == 2) {
    const bool usual =
        (letters[0].name == "v" && letters[1].name == "u") || (letters[0].name == "y" && letters[1].name == "x");
    if (usual) std::swap(letters[0], letters[1]);
    shape.variables = {letters[0].name, letters[1].name};
    shape.derivatives = {letters[0].name + "'", letters[1].name + "'"};
  } else if (order == 2) {
    equations = Equations::second;
    shape.variables = {state, state + "'"};
    shape.derivatives = {state + "''"};
    if (independent == "t" && state == "y" && !values.contains("x")) shape.refused["x"] = "";
  } else {
    equations = Equations::first;
    independent = independent_of_first(found, state, place, text);
    shape.variables = {independent, state};
    shape.derivatives = {state + "'"};
  }
  shape.independent = independent;
  if (equations != Equations::first) {
    if (!values.contains(independent)) shape.refused[independent] = "";
    std::erase_if(shape.refused, [&](const auto& row) { return std::ranges::count(shape.variables, row.first) > 0; });
    for (auto& [letter, reason] : shape.refused) {
      reason = fmt::format("the {} stands in the right side; contensou solves equations without it",
                           letter == "t" ? "time t" : "independent letter " + letter);
    }
  }
  const auto is_variable = [&](char c) { return std::ranges::count(shape.variables, std::string_view(&c, 1)) > 0; };
  for (const auto& [name, where] : found.names) {
    if (name.size() > 1 && std::ranges::count(shape.variables, name) == 0 && std::ranges::all_of(name, is_variable))
      reject_at(where, text, fmt::format("{} is no variable: a product is {}", quotation(name), fmt::join(name, "*")));
  }
  if (found.has_e) parameters["e"] = std::numbers::e;
  shape.read_name = read_name_of_equation;
  const std::vector<std::string> variables = shape.variables;
  shape.variables.insert(shape.variables.end(), shape.derivatives.begin(), shape.derivatives.end());
  return {equations, Formulas::of_equations(shape, text, parameters), variables, independent};
}

reduction::Basis parse_basis(const std::string& text, const FormulaField& system,
                             const std::map<std::string, double>& parameters) {
  reduction::Basis basis;
  std::vector<Formulas> functions;
  FormulaShape shape{{}, system.variables, "a basis is \"1; u; v; exp(u)\""};
  shape.read_name = read_name_of_equation;
  for (std::size_t begin = 0, end = 0; end < text.size(); begin = end + 1) {
    end = std::min(text.find(';', begin), text.size());
    const std::size_t first = std::min(text.find_first_not_of(" \t\r\n", begin), end);
    if (first == end) continue;
    // The class Formulas throws for parameters that its formulas do not contain. Keep only those in this formula.
    std::map<std::string, double> known;
    const auto is_letter = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
    for (std::size_t at = first; at < end; ++at) {
      const std::size_t from = at;
      while (at < end && is_letter(text[at])) ++at;
      const auto parameter = parameters.find(text.substr(from, at - from));
      if (parameter != parameters.end()) known.insert(*parameter);
    }
    basis.names.push_back(text.substr(first, text.find_last_not_of(" \t\r\n", end - 1) + 1 - first));
    functions.emplace_back(shape, basis.names.back(), known);
  }
  if (functions.empty() || functions.size() > reduction::Basis::most) {
    throw BadInput("1 to {} functions are a basis, such as \"1; u; v; exp(u)\", not {}", reduction::Basis::most,
                   functions.size());
  }
  basis.values = [functions](const Eigen::Vector2d& x) {
    Eigen::MatrixX3d all(std::ssize(functions), 3);
    for (std::size_t i = 0; i < functions.size(); ++i) {
      const auto [value, by_u, by_v] = functions[i].with_slopes(std::array{x[0], x[1]})[0];
      all.row(static_cast<Eigen::Index>(i)) << value, by_u, by_v;
    }
    return all;
  };
  return basis;
}

Eigen::Vector2d FormulaField::operator()(const Eigen::Vector2d& x) const {
  const auto [first, second] = formulas({x[0], x[1]});
  switch (equations) {
    case Equations::first:
      return {1, first};
    case Equations::second:
      return {x[1], first};
    default:
      return {first, second};
  }
}

Eigen::Matrix2d FormulaField::jacobian(const Eigen::Vector2d& x) const {
  const auto [first, second] = formulas.with_slopes(std::array{x[0], x[1]});
  const Eigen::RowVector2d slopes(first[1], first[2]);
  Eigen::Matrix2d all;
  switch (equations) {
    case Equations::first:
      all << 0, 0, slopes;
      break;
    case Equations::second:
      all << 0, 1, slopes;
      break;
    default:
      all << slopes, second[1], second[2];
  }
  return all;
}

std::vector<Eigen::MatrixXd> FormulaField::polynomials() const {
  const auto typed = formulas.expressions();
  if (!typed) return {};
  std::array<Expression, 2> sides = *typed;
  if (equations == Equations::first) sides = {1, (*typed)[0]};
  if (equations == Equations::second) sides = {Expression::variable(1), (*typed)[0]};
  std::vector<Eigen::MatrixXd> both;
  for (const Expression& side : sides) {
    const auto by_u = coefficients(side, 0);
    if (!by_u) return {};
    Eigen::MatrixXd& all = both.emplace_back(Eigen::MatrixXd::Zero(std::ssize(*by_u), 1));
    for (Eigen::Index i = 0; i < all.rows(); ++i) {
      const auto by_v = coefficients((*by_u)[static_cast<std::size_t>(i)], 1);
      if (!by_v) return {};
      if (all.cols() < std::ssize(*by_v)) {
        all.conservativeResizeLike(Eigen::MatrixXd::Zero(all.rows(), std::ssize(*by_v)));
      }
      for (std::size_t j = 0; j < by_v->size(); ++j) all(i, static_cast<Eigen::Index>(j)) = (*by_v)[j]({});
    }
  }
  return both;
}

FormulaField::operator reduction::SmoothField() const {
  reduction::SmoothField field([*this](const Eigen::Vector2d& x) { return (*this)(x); },
                               [*this](const Eigen::Vector2d& x) { return jacobian(x); });
  if (const auto divisors = formulas.denominator()) {
    field.denominator = [divisors = *divisors](const Eigen::Vector2d& x) {
      const auto [value, by_u, by_v] = divisors.with_slopes(std::array{x[0], x[1]})[0];
      return Eigen::RowVector3d(value, by_u, by_v);
    };
  }
  if (formulas.switches({0, 0}).rows() > 0) {
    field.switches = [formulas = formulas](const Eigen::Vector2d& x) { return formulas.switches({x[0], x[1]}); };
    field.branch = [*this](const Eigen::Vector2d& x) -> reduction::SmoothField {
      return FormulaField{equations, formulas.branch({x[0], x[1]}), variables, independent};
    };
  }
  return field;
}

}  // namespace contensou::answers
