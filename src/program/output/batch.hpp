#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <future>
#include <span>
#include <string>
#include <utility>
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

/// Works on a long sequence of pieces, several at a time, each in its own thread. Pieces are taken one at a time, and
/// their results are handed on in the same order. At most one piece for each thread is kept in memory.
///
/// @param ready    bool(): true if `take` can return without waiting; before a wait, all finished pieces are handed on
/// @param take     bool(Piece&): sets the argument to the next piece; false if there is none
/// @param work     void(Piece&): does the long computation
/// @param hand_on  void(Piece&): passes the result on
/// @throws  the exception of take, work or hand_on for the first piece that fails; no later piece is handed on
template <class Piece, class Ready, class Take, class Work, class HandOn>
void work_in_order(int threads, Ready ready, Take take, Work work, HandOn hand_on) {
  struct Task {
    Piece piece;
    std::future<void> done;  ///< its destructor waits for the thread
  };
  std::deque<Task> tasks;
  const auto hand_on_all_but = [&](std::size_t left) {
    for (; tasks.size() > left; tasks.pop_front()) {
      tasks.front().done.get();
      hand_on(tasks.front().piece);
    }
  };
  // std::launch::deferred does the work in done.get(): for one thread, or if the system cannot start more threads.
  const auto policy = threads > 1 ? std::launch::async | std::launch::deferred : std::launch::deferred;
  for (;;) {
    hand_on_all_but(ready() ? static_cast<std::size_t>(threads) - 1 : 0);
    Piece piece;
    try {
      if (!take(piece)) break;
    } catch (...) {
      hand_on_all_but(0);
      throw;
    }
    Task& task = tasks.emplace_back(Task{std::move(piece), {}});
    task.done = std::async(policy, [&] { work(task.piece); });
  }
  hand_on_all_but(0);
}

}  // namespace contensou::program
