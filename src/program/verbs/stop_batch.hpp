#pragma once

#include <optional>
#include <string>

#include "contensou/reduction/friction_law.hpp"
#include "exit_status.hpp"
#include "input/csv.hpp"
#include "options/route_option.hpp"
#include "options/start_options.hpp"
#include "output/output.hpp"

namespace contensou::program {

/// How a batch of stop times is computed.
struct BatchRequest {
  reduction::Law law;
  Body body;
  std::optional<si::Shot> ball;  ///< of SI columns slip and spin; none: columns mu, u0 and v0
  const RouteOption& route;
  bool keep_going = false;  ///< report a bad row on standard error and leave its tau_stop empty
  int threads = 1;
  bool progress = false;
};

/// Stop times of a table of any length, in the memory of a few blocks of it: writes the table with a column tau_stop,
/// or t_stop in s of a ball.
/// Rows are written in order, as soon as they are done; the bytes do not depend on the number of threads. Overflows are
/// counted on standard error.
///
/// @param table   with columns mu, u0 and v0, or slip and spin; the others pass through
/// @param output  not finished here
/// @return        what the worst row was that was kept without a result; done if none was
/// @throws BadLine             for a table that lacks a column or is not CSV and, unless keep_going, for a bad row; the
///                             rows before it have been written
/// @throws std::runtime_error  likewise for a row that cannot be computed
ExitStatus stop_batch(CsvReader& table, OutputFile& output, const BatchRequest& request);

}  // namespace contensou::program
