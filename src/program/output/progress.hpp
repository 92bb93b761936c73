#pragma once

#include <chrono>
#include <string>

#include "options/argument.hpp"

namespace contensou::program {

/// How far a long computation is, in one line of standard error that is written over a few times a second.
class Progress {
 public:
  /// @param total  of what, in the plural
  Progress(double total, std::string what, bool shown);

  /// @param done  so many of total
  void show(double done);

  /// Leaves a line that says how long it took, if any was shown before.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;

  double total_;
  std::string what_;
  bool shown_;
  bool begun_ = false;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_ = start_;
};

/// The bar at that share of the work, with rate and time left; without a line end.
std::string progress_line(double done, double total, const std::string& what, double seconds);

/// --progress.
class ProgressOption {
 public:
  void add(CLI::App& app);

  const Argument& argument() const { return progress_; }

  /// Whether progress is to be shown: if standard error is a terminal, unless always or never was asked for.
  /// @throws BadInput  for another word
  bool read() const;

 private:
  Argument progress_;
};

}  // namespace contensou::program
