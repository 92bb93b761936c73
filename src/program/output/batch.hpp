#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "answers/input/csv.hpp"
#include "exit_status.hpp"
#include "output/progress.hpp"
#include "platform/output_file.hpp"

namespace contensou::program {

/// The computation for each row of a table.
struct BatchRequest {
  std::vector<std::string> inputs;   ///< columns that are read; all others are copied
  std::vector<std::string> results;  ///< columns that are added

  /// Computes the results of a row, which begins on the given line, from its inputs. Threads call this function.
  /// @throws std::domain_error   for a bad row
  /// @throws std::runtime_error  for a row that cannot be computed
  std::function<void(std::span<const double> inputs, std::span<double> results, long line)> compute;

  bool keep_going = false;  ///< true: report a bad row on standard error and leave its results empty
  int threads = 1;
  ShowProgress progress = ShowProgress::never;
};

/// Computes a table of any length; only a few blocks of the table are in memory. Rows are written in order, as soon as
/// possible. The output does not depend on the number of threads. Standard error shows the number of infinite results.
///
/// @param output  file for the table; the caller finishes it
/// @return        status of the worst row that has no result; `done` if all rows have results
/// @throws BadLine             for a table that lacks a column or is not CSV. Without keep_going also for a bad row,
///                             after the rows before it have been written
/// @throws std::runtime_error  without keep_going, for a row that cannot be computed, when earlier rows are written
ExitStatus run_batch(CsvReader& table, OutputFile& output, const BatchRequest& request);

}  // namespace contensou::program
