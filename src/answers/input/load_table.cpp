#include "answers/input/load_table.hpp"

#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "answers/input/errors.hpp"
#include "answers/input/headings.hpp"

namespace contensou::answers {

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

}  // namespace contensou::answers
