#pragma once

#include <cstddef>
#include <deque>
#include <future>
#include <utility>

namespace contensou::program {

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
