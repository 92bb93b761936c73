#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "contensou/si/experiment.hpp"

namespace contensou::si {

/// A ball, or a body that lies flat, that is built in, with a typical start.
struct CatalogueEntry {
  std::string name;  ///< one lower-case word
  Experiment experiment;
  std::string sources;        ///< where the values come from and which of them are assumed
  std::string left_out = {};  ///< what it does in the world and not in this model; empty for nothing of note
};

/// The built-in balls.
const std::vector<CatalogueEntry>& catalogue();

/// The entry of that name; null if there is none.
const CatalogueEntry* find_ball(std::string_view name);

}  // namespace contensou::si
