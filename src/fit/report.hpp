#pragma once

#include <optional>

#include <Eigen/Core>

#include "contensou/fit/fit.hpp"
#include "fit/search.hpp"

namespace contensou::fit {

/// The report on a solution; without intervals that count where a better one was met on the way.
struct Report {
  Fit fit;
  std::optional<Eigen::VectorXd> better = {};
};

/// @param planned  the film is not made yet: no values, no interval by profile
Report report_on(const Search& search, const Eigen::VectorXd& solution, bool planned);

}  // namespace contensou::fit
