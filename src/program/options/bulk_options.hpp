#pragma once

#include <optional>
#include <string>

#include "options/argument.hpp"
#include "output/progress.hpp"

namespace contensou::program {

/// Returns the default rule for progress. Progress of long work is shown if standard error is a terminal and the output
/// does not go to a terminal. Otherwise progress is never shown.
/// @param output  the file of -o; "-" is standard output
ShowProgress progress_if_watched(const std::string& output);

/// --threads and --progress, for a verb that computes much.
class BulkOptions {
 public:
  void add(CLI::App& app);

  Arguments all() const { return {&threads_, &progress_}; }
  void need(const Argument& other, const std::string& reason) {
    threads_.needs(other, reason);
    progress_.needs(other, reason);
  }

  /// Returns the number of threads: by default as many as the machine runs at once.
  int threads() const;

  /// Returns the rule for progress that --progress sets; by default progress_if_watched.
  /// @param output  the file of -o; "-" is standard output
  ShowProgress progress(const std::string& output) const;

 private:
  ArgumentOf<long> threads_;
  ArgumentOf<std::optional<ShowProgress>> progress_;
};

}  // namespace contensou::program
