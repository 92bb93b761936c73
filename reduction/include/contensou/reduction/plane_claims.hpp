#pragma once

#include <functional>
#include <vector>

#include "contensou/reduction/paper_claim.hpp"
#include "contensou/reduction/reduced_system.hpp"
#include "contensou/reduction/similarity_solution.hpp"

namespace contensou::reduction {

/// The equations of the plane (u, v) of Zh98 exactly as printed (namespace paper), as values: another function in place
/// of one of them is another paper, and this is how a test lies.
struct PrintedPlane {
  std::function<Rate(double mu, State state)> field;              ///< (2.6)
  std::function<double(double mu, State state)> slope;            ///< dv/du
  std::function<Rate(double mu, State state)> regularised_field;  ///< (2.7)
  std::function<double(double mu, State state)> weight;           ///< the integrand of (2.8)
};

PrintedPlane printed_plane();

/// Every equation and claim of section 2 of Zh98 from (2.6) on, at one mu and one start.
///
/// @param system  a ball under the law of (2.6): what the printed equations are held against
/// @param start   u > 0, v > 0
/// @param solution  of that system; by default the library's
std::vector<PaperClaim> plane_claims(const ReducedSystem& system, State start,
                                     const PrintedPlane& printed = printed_plane());
std::vector<PaperClaim> plane_claims(const ReducedSystem& system, State start, const PrintedPlane& printed,
                                     const SimilaritySolution& solution);

}  // namespace contensou::reduction
