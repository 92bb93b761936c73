#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "contensou/si/experiment.hpp"

namespace contensou::si {

/// A built-in ball, or built-in body that lies flat, with a typical start.
struct CatalogueEntry {
  std::string name;  ///< one lower-case word
  Experiment experiment;
  std::string sources;        ///< sources of the values, and which values are assumed
  std::string left_out = {};  ///< real effects that the model leaves out; empty if none is important
};

/// Returns the built-in balls.
const std::vector<CatalogueEntry>& catalogue();

/// Returns the entry with that name; null if there is none.
const CatalogueEntry* find_ball(std::string_view name);

}  // namespace contensou::si
