#pragma once

#include "options/argument.hpp"

namespace contensou::program {

/// --threads.
class ThreadOption {
 public:
  void add(CLI::App& app);
  bool given() const { return threads_.given(); }

  /// As many as the machine runs at once if none were given.
  /// @throws BadInput  unless it is a whole number from 1 to 1024
  int read() const;

 private:
  Argument threads_;
};

}  // namespace contensou::program
