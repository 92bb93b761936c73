#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace contensou::reduction {

/// What a recomputation says of a printed statement.
enum class Verdict {
  holds,     ///< the number it gives is the computed one
  slip,      ///< it is not, but with the correction it is
  not_true,  ///< it is not, and no correction of a detail makes it so
};

std::string_view name(Verdict verdict);

/// A printed statement as numbers, at the place where it fits worst.
struct Evidence {
  double printed;                     ///< what the statement gives there
  double computed;                    ///< what is found without it
  double allowed;                     ///< how far apart they may be, relative to max(1, |computed|)
  std::string at{};                   ///< where, for people
  std::optional<double> corrected{};  ///< what it gives with the correction
  bool at_least = false;              ///< printed is a lower bound

  /// not_a_number agrees with nothing.
  Verdict verdict() const;
};

/// A statement of Zh98 that was recomputed.
struct PaperClaim {
  std::string equation;
  std::string statement;
  std::string correction;  ///< empty where it holds
  Verdict recorded;        ///< what this library's README says of it
  Evidence evidence;

  Verdict found() const { return evidence.verdict(); }
  bool as_recorded() const { return found() == recorded; }
};

}  // namespace contensou::reduction
