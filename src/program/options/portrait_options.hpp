#pragma once

#include <vector>

#include "contensou/portraits/phase_portrait.hpp"
#include "contensou/portraits/phase_portrait_figure.hpp"
#include "options/argument.hpp"
#include "options/law_option.hpp"

namespace contensou::program {

/// What a portrait shows and how it looks.
class PortraitOptions {
 public:
  void add(CLI::App& app);

  /// The names that were given, joined; empty if none was.
  std::string given_names() const;

  /// The request's view, window, orbits, isochrones, points and rival law.
  /// @throws BadInput  for unknown names and numbers out of range
  void read(portraits::PortraitRequest& request) const;

  /// @throws BadInput  as above
  portraits::PortraitStyle style() const;

 private:
  std::vector<reduction::State> points() const;

  Argument view_, window_, orbits_, through_, isochrones_, arrows_, field_, axes_, colour_, style_, size_;
  LawOption against_;
};

}  // namespace contensou::program
