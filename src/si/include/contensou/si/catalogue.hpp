#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "contensou/si/experiment.hpp"

namespace contensou::si {

/// A built-in ball, or body that lies flat, with a typical start.
struct CatalogueEntry {
  std::string name;  ///< one lower-case word
  Experiment experiment;
  std::string sources;        ///< sources of the values, and which values are assumed
  std::string left_out = {};  ///< effects on the real body that this model leaves out; empty if there are none of note
};

/// Returns the built-in balls.
const std::vector<CatalogueEntry>& catalogue();

/// Returns the entry of that name; null if there is none.
const CatalogueEntry* find_ball(std::string_view name);

}  // namespace contensou::si
