#include "answers/input/headings.hpp"

#include <algorithm>
#include <cctype>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "contensou/si/quantity.hpp"

namespace contensou::answers {

Heading heading_of(std::string_view text) {
  text = without_spaces(text);
  const std::size_t open = text.find_first_of("[(");
  if (open == std::string_view::npos || (text.back() != ']' && text.back() != ')')) return {std::string(text), ""};
  return {std::string(without_spaces(text.substr(0, open))),
          std::string(without_spaces(text.substr(open + 1, text.size() - open - 2)))};
}

std::string usual_name(std::string_view name) {
  constexpr std::string_view deviation = "_sd";
  constexpr std::pair<std::string_view, std::string_view> usual[]{
      {"time", "t"},       {"timestamp", "t"}, {"t_s", "t"},         {"seconds", "t"},  {"theta", "angle"},
      {"\u03b8", "angle"}, {"yaw", "angle"},   {"heading", "angle"}, {"v_x", "vx"},     {"v_{x}", "vx"},
      {"v_y", "vy"},       {"v_{y}", "vy"},    {"omega_x", "wx"},    {"omega_y", "wy"}, {"omega_z", "wz"},
      {"omega", "wz"},     {"pos_x", "x"},     {"pos_y", "y"},       {"x_m", "x"},      {"y_m", "y"},
      {"fz", "load"},      {"f", "load"},      {"force", "load"}};
  std::string small(name);
  std::ranges::transform(small, small.begin(),
                         [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  const bool is_deviation = small.ends_with(deviation);
  if (is_deviation) small.resize(small.size() - deviation.size());
  const auto* found = std::ranges::find(usual, small, &std::pair<std::string_view, std::string_view>::first);
  if (found != std::end(usual)) small = found->second;
  return is_deviation ? small + std::string(deviation) : small;
}

double factor_of(const std::string& unit, std::string_view si_unit) {
  if (unit.empty()) return 1;
  const bool angle = si_unit == "rad";
  const si::Dimension& dimension = *si::find_dimension(angle ? "deg" : si_unit);
  const auto value = si::parse_quantity("1 " + unit, dimension);
  if (!value) throw BadInput("{} is no unit of it: use {}", quotation(unit), si::units_of(dimension));
  return angle ? *value * (std::numbers::pi / 180) : *value;
}

bool is_in_pixels(const SiColumn& column) { return column.unit == "px" || column.unit == "px/s"; }

std::optional<SiColumn> find_column(const CsvReader& table, std::string_view name, std::string_view si_unit,
                                    std::optional<double> pixel) {
  const auto fail = [&](const std::string& message) { throw table.complaint(table.header_line(), message); };
  const bool is_there =
      std::ranges::any_of(table.names(), [&](const std::string& heading) { return heading_of(heading).name == name; });
  std::optional<SiColumn> found;
  for (std::size_t i = 0; i < table.names().size(); ++i) {
    const auto [of, unit] = heading_of(table.names()[i]);
    if ((is_there ? of : usual_name(of)) != name) continue;
    if (found) fail(fmt::format("two columns are called '{}'; one is allowed", name));
    if ((unit == "px" && si_unit == "m") || (unit == "px/s" && si_unit == "m/s")) {
      if (!pixel) fail(fmt::format("column {}: pixels need a size: --pixel LENGTH", quotation(table.names()[i])));
      found = {{table.names()[i], i}, unit, *pixel};
      continue;
    }
    try {
      found = {{table.names()[i], i}, unit, factor_of(unit, si_unit)};
    } catch (const BadInput& error) {
      fail(fmt::format("column {}: {}", quotation(table.names()[i]), error.what()));
    }
  }
  return found;
}

SiColumn require_column(const CsvReader& table, std::string_view name, std::string_view si_unit) {
  if (const auto found = find_column(table, name, si_unit)) return *found;
  return {table.column(name)};  // throws, because there is no such column
}

}  // namespace contensou::answers
