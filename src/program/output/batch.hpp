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

/// What is computed of each row of a table.
struct BatchRequest {
  std::vector<std::string> inputs;   ///< columns that are read; the others pass through
  std::vector<std::string> results;  ///< columns that are added

  /// The results of a row, from its inputs and the number of lines before it; several threads call it.
  /// @throws std::domain_error   for a bad row
  /// @throws std::runtime_error  for one that cannot be computed
  std::function<void(std::span<const double> inputs, std::span<double> results, long line)> compute;

  bool keep_going = false;  ///< report a bad row on standard error and leave its results empty
  int threads = 1;
  ShowProgress progress = ShowProgress::never;
};

/// Computes on a table of any length, in the memory of a few blocks of it.
/// Rows are written in order, as soon as they are done; the bytes do not depend on the number of threads. Infinite
/// results are counted on standard error.
///
/// @param output  not finished here
/// @return        what the worst row was that was kept without a result; done if none was
/// @throws BadLine             for a table that lacks a column or is not CSV and, unless keep_going, for a bad row; the
///                             rows before it have been written
/// @throws std::runtime_error  likewise for a row that cannot be computed
ExitStatus run_batch(CsvReader& table, OutputFile& output, const BatchRequest& request);

}  // namespace contensou::program
