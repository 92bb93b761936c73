#include "contensou/si/spreads.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <stdexcept>

#include <Eigen/Eigenvalues>

#include "contensou/si/quantity.hpp"

namespace contensou::si {

using Eigen::Index;
using Eigen::MatrixXd;

std::string Component::name() const {
  if (quantity->count() == 1) return std::string(quantity->name);
  std::string_view rest = quantity->components;
  for (std::size_t i = 0; i < index; ++i) rest.remove_prefix(rest.find(',') + 1);
  std::string name(rest.substr(0, rest.find(',')));
  std::ranges::transform(name, name.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return name;
}

const std::vector<Component>& uncertain_components() {
  static const std::vector<Component> all = [] {
    std::vector<Component> made;
    for (const Quantity* quantity : quantities()) {
      if (quantity == &inertia_factor || quantity == &youngs_modulus || quantity == &poisson_ratio) continue;
      for (std::size_t i = 0; i < quantity->count(); ++i) made.push_back({quantity, i});
    }
    return made;
  }();
  return all;
}

const std::vector<std::string>& uncertain_names() {
  static const std::vector<std::string> all = [] {
    std::vector<std::string> names;
    for (const Component& each : uncertain_components()) names.push_back(each.name());
    return names;
  }();
  return all;
}

std::optional<Component> find_component(std::string_view name) {
  const auto found = std::ranges::find(uncertain_names(), name);
  if (found == uncertain_names().end()) return std::nullopt;
  return uncertain_components()[static_cast<std::size_t>(found - uncertain_names().begin())];
}

std::optional<double> parse_spread(std::string_view text, std::string_view unit, double value) {
  static const Dimension percent{"", "%", "percent", {}};
  if (const auto share = parse_quantity(text, percent)) {
    if (value == 0) throw std::domain_error("is 0, and so is every % of it: give a number");
    return *share / 100 * std::abs(value);
  }
  const Dimension* const dimension = find_dimension(unit);
  return dimension ? parse_quantity(text, *dimension) : std::nullopt;
}

std::optional<Index> Spreads::place(const Component& of) const {
  const auto found = std::ranges::find(numbers, of, &Number::of);
  if (found == numbers.end()) return std::nullopt;
  return found - numbers.begin();
}

void Spreads::add(const Component& of, double standard) {
  numbers.push_back({of, standard});
  const auto size = static_cast<Index>(numbers.size());
  correlation.conservativeResizeLike(MatrixXd::Identity(size, size));
}

Spreads Spreads::of(const std::function<bool(const Component&)>& kept) const {
  Spreads some;
  std::vector<Index> places;
  for (const Number& number : numbers) {
    if (!kept(number.of)) continue;
    some.numbers.push_back(number);
    places.push_back(*place(number.of));
  }
  some.correlation = correlation(places, places);
  return some;
}

MatrixXd Spreads::covariance() const {
  Eigen::VectorXd standard(static_cast<Index>(numbers.size()));
  for (Index i = 0; i < standard.size(); ++i) standard[i] = numbers[static_cast<std::size_t>(i)].standard;
  return standard.asDiagonal() * correlation * standard.asDiagonal();
}

Spreads spreads_of(const MatrixXd& covariance, const std::vector<Component>& named) {
  Spreads result;
  std::vector<Index> rows;
  for (Index i = 0; i < covariance.rows(); ++i) {
    if (!(covariance(i, i) > 0)) continue;
    rows.push_back(i);
    result.add(named[static_cast<std::size_t>(i)], std::sqrt(covariance(i, i)));
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double both = covariance(rows[i], rows[j]) / (result.numbers[i].standard * result.numbers[j].standard);
      const auto row = static_cast<Index>(i), column = static_cast<Index>(j);
      result.correlation(row, column) = result.correlation(column, row) = std::clamp(both, -1.0, 1.0);
    }
  }
  return result;
}

double least_eigenvalue(const MatrixXd& correlation) {
  return Eigen::SelfAdjointEigenSolver<MatrixXd>(correlation, Eigen::EigenvaluesOnly).eigenvalues()[0];
}

}  // namespace contensou::si
