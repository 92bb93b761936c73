// A text must be a formula whose value is the same with and without slopes, or give a readable error message that names
// one of its characters.
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <string>

#include "answers/input/errors.hpp"
#include "answers/input/formulas.hpp"
#include "answers/input/parse.hpp"
#include "finding.hpp"

using namespace contensou;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text = "u' = " + std::string(fuzz::text_of(data, size));
  try {
    const answers::Formulas formulas({{"u'", "v'"}, {"u", "v"}, "u' = F; v' = G"}, text + "; v' = u", {});
    for (const std::array point : {std::array{0.3, -1.7}, std::array{0.0, 0.0}, std::array{-1e300, 1e-300}}) {
      const auto [u, v] = formulas({point[0], point[1]});
      const auto [dual, other] = formulas.with_slopes(point);
      const bool equal = std::bit_cast<std::uint64_t>(u) == std::bit_cast<std::uint64_t>(dual[0]);
      fuzz::require(equal || (std::isnan(u) && std::isnan(dual[0])), "value");
      fuzz::require(v == point[0] && other == answers::Dual<2>{point[0], 1, 0}, "the other formula");
    }
  } catch (const answers::BadInput& error) {
    std::string message = error.what();
    fuzz::require_readable(message);
    const std::string quoted = " of " + answers::quotation(text + "; v' = u"), before = ", at character ";
    if (message.ends_with(quoted)) {
      message.erase(message.size() - quoted.size());
      std::size_t character = 0;
      std::from_chars(&message[message.rfind(before) + before.size()], message.data() + message.size(), character);
      fuzz::require(character >= 1 && character <= text.size() + 10, error.what());
    }
  }
  return 0;
}
