#include "answers/input/tables.hpp"

#include <algorithm>
#include <cctype>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <Eigen/Core>

#include "answers/input/errors.hpp"
#include "contensou/reduction/tabulated_pressure_law.hpp"
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

si::LoadHistory read_load_history(const std::string& path) {
  CsvReader table(path, CsvReader::Separator::any);
  const SiColumn time = require_column(table, "t", "s"), load = require_column(table, "load", "N");
  std::vector<double> t, newtons;
  std::vector<long> lines;
  table.for_each_row([&](const CsvRow& row) {
    t.push_back(time.factor * table.number(row, time.column));
    newtons.push_back(load.factor * table.number(row, load.column));
    lines.push_back(row.line());
  });
  try {
    return {std::move(t), std::move(newtons)};
  } catch (const si::WrongLoad& error) {
    throw table.complaint(lines[error.row], error.what());
  } catch (const std::domain_error& error) {
    throw table.complaint(lines.empty() ? table.header_line() : lines.back(), error.what());
  }
}

std::string require_load_alone(const si::Experiment& experiment, const reduction::Law& law, std::string others) {
  const std::string no = "--load with a table";
  if (std::holds_alternative<si::HertzModuli>(experiment.contact.patch)) {
    throw BadInput(
        "{}: the patch by Hertz's formula grows with the load, and the motion is then no other "
        "one's copy; --patch-radius {:.6g} keeps it as it is under the first load",
        no, si::patch_radius_of(experiment, law));
  }
  const auto add = [&](const std::string& other) { others += (others.empty() ? "" : ", ") + other; };
  if (experiment.contact.rolling_friction > 0) add("the rolling friction");
  if (experiment.environment.slope != 0) add("the slope");
  if (!others.empty()) throw BadInput("{} allows friction alone: leave out {}", no, others);
  if (experiment.ball.body.lies_flat()) return "";
  return fmt::format(
      "note: the patch stays at {:.6g} m while the load changes; that of an elastic ball goes with its cube root\n",
      si::patch_radius_of(experiment, law));
}

reduction::Law read_pressure_profile(const std::string& path) {
  CsvReader table(path);
  return read_pressure_profile(table, path);
}

reduction::Law read_pressure_profile(CsvReader& table, const std::string& name) {
  const CsvColumn rho_column = table.column("rho");
  const CsvColumn pressure_column = table.column("pressure");
  std::vector<double> rho, pressure;
  bool loaded = false;
  long last_line = 0;
  table.for_each_row([&](const CsvRow& row) {
    const double before = rho.empty() ? -1 : rho.back();
    const double before_that = rho.size() < 2 ? -1 : rho[rho.size() - 2];
    rho.push_back(table.number(row, rho_column));
    pressure.push_back(table.number(row, pressure_column));
    if (before < 0 && rho.back() != 0) {
      throw table.complaint(row.line(), fmt::format("rho must begin at 0, the centre, got {}", rho.back()));
    }
    if (!(rho.back() >= before)) {
      throw table.complaint(row.line(), fmt::format("rho must not decrease, got {} after {}", rho.back(), before));
    }
    if (rho.back() == before && (rho.back() == 0 || rho.back() == before_that)) {
      throw table.complaint(
          row.line(), fmt::format("rho = {} again: a step of the pressure has two rows of one rho > 0", rho.back()));
    }
    if (rho.back() > 1) {
      throw table.complaint(row.line(), fmt::format("rho must end at 1, the edge of the patch, got {}", rho.back()));
    }
    if (pressure.back() < 0) {
      throw table.complaint(row.line(), fmt::format("the pressure must be >= 0, got {}", pressure.back()));
    }
    loaded = loaded || pressure.back() > 0;
    last_line = row.line();
  });
  if (rho.size() < 2) {
    throw table.complaint(table.header_line(), "two or more rows are needed, from rho = 0 to rho = 1");
  }
  if (rho.back() != 1) {
    throw table.complaint(last_line, fmt::format("rho must end at 1, the edge of the patch, got {}", rho.back()));
  }
  if (!loaded) throw table.complaint(last_line, "the pressure is 0 in every row");
  const auto rows = static_cast<Eigen::Index>(rho.size());
  try {
    return reduction::TabulatedPressureLaw(name, Eigen::Map<const Eigen::ArrayXd>(rho.data(), rows),
                                           Eigen::Map<const Eigen::ArrayXd>(pressure.data(), rows));
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("{}: {}", name, error.what()));
  }
}

}  // namespace contensou::answers
