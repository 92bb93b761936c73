#pragma once

#include "options/argument.hpp"

namespace contensou::program {

/// --threads.
class ThreadOption {
 public:
  void add(CLI::App& app);
  const Argument& argument() const { return threads_; }

  /// As many as the machine runs at once if none were given.
  int read() const;

 private:
  ArgumentOf<long> threads_;
};

}  // namespace contensou::program
