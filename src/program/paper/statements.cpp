#include "paper/statements.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace contensou::program {

std::string_view word(Verdict verdict) {
  switch (verdict) {
    case Verdict::holds:
      return "holds";
    case Verdict::erratum:
      return "erratum";
    case Verdict::not_true:
      break;
  }
  return "false";
}

Finding Statement::examine() const {
  Finding found{printed(at), computed(at), std::nullopt, Verdict::not_true};
  const auto agrees = [&](double value) {
    if (allowed == lower_bound) return found.computed >= value;
    return value == found.computed ||
           std::abs(value - found.computed) <= allowed * std::max(1.0, std::abs(found.computed));
  };
  if (corrected) found.corrected = corrected(at);
  if (found.corrected && agrees(*found.corrected)) found.verdict = Verdict::erratum;
  if (agrees(found.printed)) found.verdict = Verdict::holds;
  return found;
}

std::string Examined::correction() const {
  return fmt::format(fmt::runtime(statement.correction), fmt::arg("computed", found.computed),
                     fmt::arg("percent", 100 * found.computed));
}

}  // namespace contensou::program
