#pragma once

#include <string>

#include "contensou/reduction/friction_law.hpp"
#include "csv_table.hpp"
#include "exit_status.hpp"
#include "route_option.hpp"

namespace contensou::program {

/// Stop times of a whole table.
struct StopBatch {
  std::string csv;                       ///< the table with a column tau_stop
  ExitStatus status = ExitStatus::done;  ///< of the worst row that was kept without one
};

/// @param table       with columns mu, u0 and v0; the others pass through
/// @param keep_going  report a bad row on standard error and leave its tau_stop empty
/// @throws BadLine             for a table that lacks a column or, unless keep_going, has a bad row
/// @throws std::runtime_error  for a row that cannot be computed, unless keep_going
StopBatch stop_batch(const CsvTable& table, const reduction::Law& law, const RouteOption& route, bool keep_going);

}  // namespace contensou::program
