#include "answers/input/pressure_profile.hpp"

#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <Eigen/Core>

#include "answers/input/csv.hpp"
#include "contensou/reduction/tabulated_pressure_law.hpp"

namespace contensou::answers {

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
