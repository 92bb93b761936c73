#pragma once

#include <cstddef>
#include <deque>
#include <future>
#include <utility>

namespace contensou::program {

/// Works on a long sequence of pieces, several at a time, each in a thread of its own. Takes and hands on one piece at
/// a time, in order; holds at most one piece for each thread.
///
/// @param ready    bool(): whether taking does not have to wait; if it has to, all pieces are handed on before
/// @param take     bool(Piece&): makes it the next piece; false if there is none
/// @param work     void(Piece&): does what takes long
/// @param hand_on  void(Piece&): passes the result on
/// @throws  what take, work or hand_on throws for the first piece in the order; nothing is handed on after it
template <class Piece, class Ready, class Take, class Work, class HandOn>
void work_in_order(int threads, Ready ready, Take take, Work work, HandOn hand_on) {
  struct Task {
    Piece piece;
    std::future<void> done;  ///< waits for the thread when it is destroyed
  };
  std::deque<Task> tasks;
  const auto hand_on_all_but = [&](std::size_t left) {
    for (; tasks.size() > left; tasks.pop_front()) {
      tasks.front().done.get();
      hand_on(tasks.front().piece);
    }
  };
  // Deferred: where one thread is wanted, or no more can be had, it is the one that waits for the piece.
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
