#pragma once

#include <string_view>
#include <vector>

namespace contensou::program {

/// A number that others have published, and the same number computed by this library.
struct Published {
  std::string_view name;    ///< the quantity
  std::string_view source;  ///< authors, journal or title, year
  std::string_view link;    ///< DOI or repository of the source; empty if there is none
  std::string_view read;    ///< part of the source that was read: "abstract", "code", "in textbooks" or "as cited"
  double published;
  double allowed;         ///< half a unit of the last printed digit; for an exact expression, the error of rounding
  double computed;        ///< computed without the published number
  bool confirmed = true;  ///< recorded result: true if both agree

  bool agrees() const;
};

/// Returns published numbers of disc, ring and grains, and of a ball, a cue and a stone in textbooks.
std::vector<Published> published_numbers();

}  // namespace contensou::program
