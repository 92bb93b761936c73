#pragma once

#include <condition_variable>
#include <exception>
#include <map>
#include <mutex>
#include <semaphore>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace contensou::program {

/// Works on a long sequence of pieces in several threads. Takes and hands on one piece at a time, in order, as soon as
/// the pieces before it have been handed on; holds at most two pieces for each thread.
///
/// @param take     bool(Piece&, settle): makes it the next piece; false if there is none. Before it waits for something
///                 else than the pieces taken so far, it calls bool settle(), which waits for these; if that is false,
///                 nothing more is to be taken
/// @param work     void(Piece&): does what takes long
/// @param hand_on  void(Piece&): passes the result on
/// @throws  what take, work or hand_on throws for the first piece in the order; nothing is handed on after it
template <class Piece, class Take, class Work, class HandOn>
void work_in_order(int threads, Take take, Work work, HandOn hand_on) {
  struct Taken {
    Piece piece;
    std::exception_ptr error;
  };
  const auto error_of = [](auto action) {
    try {
      action();
      return std::exception_ptr();
    } catch (...) {
      return std::current_exception();
    }
  };
  std::mutex taking, handing_on;
  std::counting_semaphore<> room(2 * static_cast<std::ptrdiff_t>(threads));
  std::condition_variable settled;
  std::map<long, Taken> finished;
  long taken = 0, handed_on = 0;
  bool ended = false;          // of taking
  std::exception_ptr failure;  // of handing on

  const auto settle = [&] {
    std::unique_lock lock(handing_on);
    settled.wait(lock, [&] { return handed_on == taken; });
    return !failure;
  };
  const auto take_next = [&](Taken& next) {
    const std::lock_guard lock(taking);
    if (ended) return -1L;
    next.error = error_of([&] { ended = !take(next.piece, settle); });
    if (!next.error && ended) return -1L;
    ended = ended || next.error;
    return taken++;
  };
  const auto hand_on_finished = [&] {
    while (!finished.empty() && finished.begin()->first == handed_on) {
      Taken& first = finished.begin()->second;
      if (!failure) failure = first.error ? first.error : error_of([&] { hand_on(first.piece); });
      finished.erase(finished.begin());
      ++handed_on;
      room.release();
    }
    settled.notify_one();
    return !failure;
  };
  const auto run = [&] {
    for (bool going_on = true; going_on;) {
      room.acquire();
      Taken next;
      const long place = take_next(next);
      if (place < 0) return room.release();
      if (!next.error) next.error = error_of([&] { work(next.piece); });
      const std::lock_guard lock(handing_on);
      finished.emplace(place, std::move(next));
      going_on = hand_on_finished();
    }
  };
  {
    std::vector<std::jthread> others;
    try {
      for (int i = 1; i < threads; ++i) others.emplace_back(run);
    } catch (const std::system_error&) {
      // The threads there are do all of it.
    }
    run();
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace contensou::program
