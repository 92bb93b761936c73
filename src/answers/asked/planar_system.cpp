#include "answers/asked/planar_system.hpp"

#include <algorithm>
#include <array>
#include <cctype>

#include "answers/input/errors.hpp"

namespace contensou::answers {

FormulaField parse_planar_system(const std::string& text, const std::map<std::string, double>& parameters) {
  using Equations = FormulaField::Equations;
  const std::vector<std::string> lefts = left_sides(text);
  const auto has = [&](std::string_view left) { return std::ranges::count(lefts, left) > 0; };
  const auto read = [&](Equations equations, const FormulaShape& shape) {
    return FormulaField{equations, Formulas(shape, text, parameters), shape.variables};
  };
  if (has("x''")) return read(Equations::second, {{"x''"}, {"x", "x'"}, "an equation of second order is \"x'' = F\""});
  if (has("y'") && !has("x'")) return read(Equations::first, {{"y'"}, {"x", "y"}, "an equation is \"y' = F\""});
  if (has("x'")) return read(Equations::system, {{"x'", "y'"}, {"x", "y"}, "a system is \"x' = F; y' = G\""});
  return read(Equations::system, {{"u'", "v'"}, {"u", "v"}, "a system is \"u' = F; v' = G\""});
}

reduction::Basis parse_basis(const std::string& text, const FormulaField& system,
                             const std::map<std::string, double>& parameters) {
  reduction::Basis basis;
  std::vector<Formulas> functions;
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
    functions.emplace_back(FormulaShape{{}, system.variables, "a basis is \"1; u; v; exp(u)\""}, basis.names.back(),
                           known);
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
      return FormulaField{equations, formulas.branch({x[0], x[1]}), variables};
    };
  }
  return field;
}

}  // namespace contensou::answers
