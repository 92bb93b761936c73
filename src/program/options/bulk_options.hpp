#pragma once

#include <optional>
#include <string>

#include "options/argument.hpp"
#include "output/progress.hpp"

namespace contensou::program {

/// When progress is to be shown that nobody asked for: of long work, if standard error is a terminal to which no output goes.
/// @param output  the file of -o; "-" is standard output
ShowProgress progress_if_watched(const std::string& output);

/// --threads and --progress, for a verb that computes much.
class BulkOptions {
 public:
  void add(CLI::App& app);

  /// Throws BadInput if one of them was given where they mean nothing.
  /// @param reason  follows "--threads " and " is for "
  void refuse(const std::string& reason) const;

  /// The threads to compute with: as many as the machine runs at once if no number was given.
  int threads() const;

  /// When progress is to be shown: progress_if_watched, unless always or never was asked for.
  /// @param output  the file of -o; "-" is standard output
  ShowProgress progress(const std::string& output) const;

 private:
  ArgumentOf<long> threads_;
  ArgumentOf<std::optional<ShowProgress>> progress_;
};

}  // namespace contensou::program
