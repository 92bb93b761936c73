// A table of pressures must give a law with finite Phi and Psi in their range, or a readable error message.
#include <cmath>
#include <stdexcept>
#include <typeinfo>

#include "answers/input/tables.hpp"
#include "finding.hpp"

using namespace contensou;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const fuzz::MemoryFile file(fuzz::text_of(data, size));
  try {
    const reduction::Law law = answers::read_pressure_profile(file.path());
    const double most = law.pivoting_moment();
    fuzz::require(most > 0 && std::isfinite(law.force_slope()), "pure pivoting");
    for (int i = -80; i <= 80; ++i) {
      const auto [force, moment] = law(reduction::slip_of_ratio(std::exp2(0.5 * i)));
      constexpr double rounding = 1e-12;
      fuzz::require(force >= 0 && force <= 1 + rounding, fmt::format("Phi(2^{}) = {}", 0.5 * i, force));
      fuzz::require(moment >= 0 && moment <= most * (1 + rounding), fmt::format("Psi(2^{}) = {}", 0.5 * i, moment));
    }
  } catch (const std::domain_error& error) {
    fuzz::require_readable(error.what());
  } catch (const std::runtime_error& error) {  // the whole load of the patch is in one point
    fuzz::require(typeid(error) == typeid(std::runtime_error), error.what());
    fuzz::require_readable(error.what());
  }
  return 0;
}
