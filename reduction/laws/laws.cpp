#include "contensou/reduction/laws.hpp"

#include <algorithm>

#include "contensou/reduction/hertz_law.hpp"
#include "contensou/reduction/pade_law.hpp"
#include "contensou/reduction/potential8_law.hpp"
#include "contensou/reduction/pressure_law.hpp"

namespace contensou::reduction {

const std::vector<Law>& paper_laws() {
  static const std::vector<Law> laws{PadeLaw{}, HertzLaw{}};
  return laws;
}

const std::vector<Law>& named_laws() {
  static const std::vector<Law> laws{PadeLaw{},           HertzLaw{},     PressureLaw::uniform(), PressureLaw::punch(),
                                     PressureLaw::ring(), Potential8Law{}};
  return laws;
}

std::optional<Law> find_law(std::string_view name) {
  const auto& laws = named_laws();
  const auto found = std::ranges::find(laws, name, &Law::name);
  if (found == laws.end()) return std::nullopt;
  return *found;
}

}  // namespace contensou::reduction
