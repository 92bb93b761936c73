#include "contensou/reduction/laws.hpp"

#include <algorithm>
#include <locale>
#include <sstream>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "contensou/reduction/hertz_law.hpp"
#include "contensou/reduction/pade_law.hpp"
#include "contensou/reduction/potential8_law.hpp"
#include "contensou/reduction/pressure_law.hpp"

namespace contensou::reduction {

namespace {

constexpr std::string_view family = "pressure:";

Law law_of_the_family(std::string_view exponent) {
  // Not std::from_chars, which libc++ does not have for a double.
  std::istringstream text{std::string(exponent)};
  text.imbue(std::locale::classic());
  double p = 0;
  if (!(text >> std::noskipws >> p) || exponent.starts_with("+-") ||
      text.peek() != std::istringstream::traits_type::eof()) {
    throw std::domain_error(fmt::format(
        "'{}' is not a number; the exponent P of the pressure (1 - rho^2)^P is needed, as in pressure:0.5", exponent));
  }
  if (!(p > -1 && p <= PressureLaw::max_p)) {
    throw std::domain_error(fmt::format("-1 < P <= {} is required{}", PressureLaw::max_p,
                                        p == -1 ? "; the limit P -> -1 is the law ring" : ""));
  }
  return PressureLaw(p);
}

}  // namespace

const std::vector<Law>& paper_laws() {
  static const std::vector<Law> laws{HertzLaw{}, PadeLaw{}};
  return laws;
}

const std::vector<Law>& named_laws() {
  static const std::vector<Law> laws{HertzLaw{},           PadeLaw{},           PressureLaw::uniform(),
                                     PressureLaw::punch(), PressureLaw::ring(), Potential8Law{}};
  return laws;
}

std::optional<Law> find_law(std::string_view name) {
  if (name.starts_with(family)) return law_of_the_family(name.substr(family.size()));
  const auto& laws = named_laws();
  const auto found = std::ranges::find(laws, name, &Law::name);
  if (found == laws.end()) return std::nullopt;
  return *found;
}

}  // namespace contensou::reduction
