#pragma once

#include <cstddef>
#include <deque>
#include <future>
#include <utility>

namespace contensou::program {

/// Works on a long sequence of pieces, several at a time, each in a thread of its own. Pieces are taken and handed on
/// one at a time, in order. At most one piece for each thread is kept.
///
/// @param ready    bool(): true if `take` does not have to wait; before a wait all pieces are handed on
/// @param take     bool(Piece&): sets the argument to the next piece; false if there is none
/// @param work     void(Piece&): does the long computation
/// @param hand_on  void(Piece&): passes the result on
/// @throws  the exception of take, work or hand_on for the first piece in order; no later piece is handed on
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
  // If one thread is requested, or no more threads can be started, the work is done when its result is waited for.
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
