#pragma once

#include <chrono>
#include <string>

namespace contensou::program {

/// How far a long computation is, in one line of standard error that is written over a few times a second.
class Progress {
 public:
  /// @param what  is counted, in the plural
  Progress(std::string what, bool shown) : what_(std::move(what)), shown_(shown) {}
  ~Progress() { erase(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// @param total  NaN if it is not known
  void show(double done, double total);

  /// Makes room for a message, until it is shown again.
  void erase();

  /// Leaves a line that says how long it took, if any was shown before.
  void finish(double done);

 private:
  using Clock = std::chrono::steady_clock;

  std::string what_;
  bool shown_;
  bool begun_ = false;
  bool visible_ = false;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_ = start_;
};

/// The bar at that fraction of the work, with rate and time left, or how much was done where the total is NaN; without
/// a line end.
std::string progress_line(double done, double total, const std::string& what, double seconds);

}  // namespace contensou::program
