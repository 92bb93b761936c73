#pragma once

#include <optional>

#include <Eigen/Core>

#include "contensou/fit/fit.hpp"
#include "fit/search.hpp"

namespace contensou::fit {

/// The report on a solution. If `better` is set, a better solution was found on the way, and the intervals are invalid.
struct Report {
  Fit fit;
  std::optional<Eigen::VectorXd> better = {};
};

/// @param planned  true for a film that is not made yet: there are no values, and no intervals by profile likelihood
Report report_on(const Search& search, const Eigen::VectorXd& solution, bool planned);

}  // namespace contensou::fit
