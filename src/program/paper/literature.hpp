#pragma once

#include <string_view>
#include <vector>

namespace contensou::program {

/// A number that somebody else published, and what it is here.
struct Published {
  std::string_view name;    ///< what it is of
  std::string_view source;  ///< authors, where, year
  std::string_view link;    ///< its DOI or repository; empty if it has none
  std::string_view read;    ///< what of the source was read: "abstract", "code", "in textbooks" or "as cited"
  double published;
  double allowed;         ///< half a unit of the last digit printed; of a closed expression, rounding
  double computed;        ///< without that number
  bool confirmed = true;  ///< what was found when it was written down

  bool agrees() const;
};

/// Disc and ring, the textbook's ball, cue and stone.
std::vector<Published> published_numbers();

}  // namespace contensou::program
