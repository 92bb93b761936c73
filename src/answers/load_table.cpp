#include "answers/load_table.hpp"

#include <stdexcept>
#include <vector>

#include "answers/headings.hpp"

namespace contensou::answers {

si::LoadHistory read_load_history(const std::string& path) {
  CsvReader table(path);
  const auto column = [&](std::string_view name, std::string_view unit) {
    const auto found = find_column(table, name, unit);
    return found ? *found : SiColumn{table.column(std::string(name))};  // says that there is none
  };
  const SiColumn time = column("t", "s"), load = column("load", "N");
  std::vector<double> t, newtons;
  long last = table.header_line();
  table.for_each_row([&](const CsvRow& row) {
    t.push_back(time.factor * table.number(row, time.column));
    newtons.push_back(load.factor * table.number(row, load.column));
    last = row.line();
  });
  try {
    return {std::move(t), std::move(newtons)};
  } catch (const std::domain_error& error) {
    throw table.complaint(last, error.what());
  }
}

}  // namespace contensou::answers
