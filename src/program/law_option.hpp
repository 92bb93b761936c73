#pragma once

#include "argument.hpp"
#include "contensou/reduction/friction_law.hpp"

namespace contensou::program {

/// --law.
class LawOption {
 public:
  void add(CLI::App& app);
  bool given() const { return law_.given(); }

  /// The law of that name; the first of named_laws() if none was given.
  /// @throws BadInput  for an unknown name
  reduction::Law read() const;

 private:
  Argument law_;
};

}  // namespace contensou::program
