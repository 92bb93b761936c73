#include "stop_batch.hpp"

#include <algorithm>
#include <cstdio>
#include <stdexcept>

#include <fmt/format.h>

#include "number.hpp"
#include "stop_times.hpp"

namespace contensou::program {

namespace {

constexpr const char* result = "tau_stop";

class Rows {
 public:
  Rows(const CsvTable& table, const reduction::Law& law, const RouteOption& route)
      : table_(table), mu_(table.column("mu")), u0_(table.column("u0")), v0_(table.column("v0")), stop_(law, route) {}

  /// @throws BadLine, std::runtime_error  beginning with the row's place
  double stop_time(const CsvRecord& row) {
    table_.require_complete(row);
    const double mu = number(row, "mu", mu_);
    const reduction::State start{.u = number(row, "u0", u0_), .v = number(row, "v0", v0_)};
    if (!(mu > 0 && mu <= 1)) throw table_.complaint(row.line, fmt::format("mu: 0 < mu <= 1 is required, got {}", mu));
    if (start.v < 0) throw table_.complaint(row.line, fmt::format("v0: v0 >= 0 is required, got {}", start.v));
    try {
      return stop_(mu, start);
    } catch (const std::domain_error& error) {
      throw table_.complaint(row.line, error.what());
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(table_.complaint(row.line, error.what()).what());
    }
  }

 private:
  double number(const CsvRecord& row, std::string_view name, std::size_t column) const {
    try {
      return parse_number(row.fields[column]);
    } catch (const BadInput& error) {
      throw table_.complaint(row.line, fmt::format("{}: {}", name, error.what()));
    }
  }

  const CsvTable& table_;
  std::size_t mu_, u0_, v0_;
  StopTimes stop_;
};

}  // namespace

StopBatch stop_batch(const CsvTable& table, const reduction::Law& law, const RouteOption& route, bool keep_going) {
  Rows rows(table, law, route);
  if (table.has_column(result)) {
    throw table.complaint(table.header().line,
                          fmt::format("the input already has a column '{}': rename or remove it", result));
  }

  const auto line = [&](std::vector<std::string> fields, std::string last) {
    fields.resize(table.header().fields.size());
    fields.push_back(std::move(last));
    return csv_line(fields);
  };
  StopBatch batch{.csv = line(table.header().fields, result)};
  const auto keep_without_result = [&](const CsvRecord& row, const std::exception& error, ExitStatus status) {
    if (!keep_going) throw;
    std::fputs(fmt::format("{}\n", error.what()).c_str(), stderr);
    batch.csv += line(row.fields, "");
    batch.status = std::max(batch.status, status);
  };
  for (const CsvRecord& row : table.rows()) {
    try {
      batch.csv += line(row.fields, fmt::format("{}", rows.stop_time(row)));
    } catch (const BadLine& error) {
      keep_without_result(row, error, ExitStatus::bad_input);
    } catch (const std::runtime_error& error) {
      keep_without_result(row, error, ExitStatus::numerical_failure);
    }
  }
  return batch;
}

}  // namespace contensou::program
