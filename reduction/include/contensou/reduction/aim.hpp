#pragma once

#include <optional>
#include <stdexcept>

#include "contensou/reduction/flow.hpp"

namespace contensou::reduction {

/// What a motion has come to when it stops.
struct Reached {
  double tau;       ///< stop time, in the paper's time
  double distance;  ///< of the centre, its velocity integrated over tau: speed squared
  double turned;    ///< |u| integrated over tau: speed squared
};

/// Of a body that begins without rolling: its centre moves along the slip, at V = (1 - 1/chi) v0 + v/chi.
/// @throws std::domain_error  as Flow::orbit, and for a flow with a drive
Reached reached(const Flow& flow, State start);

/// What a start is to come to: two of the three, none of them negative.
struct Aim {
  std::optional<double> tau, distance, turned;
};

/// What is asked for is so far apart that no start in doubles comes to it.
struct TooFarApart : std::domain_error {
  using std::domain_error::domain_error;
};

/// That Phi does not fall and Psi does not grow with k, the hypothesis of (R59) and (R60), at 276 ratios from 1e-6 to 1e6, to
/// 1e-6 of them. Every pressure keeps it, and so do all named laws: the two are derivatives of a convex function.
/// @throws std::domain_error  naming which does not, and where
void require_monotone(const Law& law);

/// The least stop time with the other of two that is asked for, its distance or how far it turns: that of pure sliding, or of
/// pure pivoting (README (R60)).
/// @throws std::domain_error  as aimed, and where that other one is not given
double least_time(const Flow& flow, const Aim& aim);

/// The one start with u, v >= 0 that comes to what is asked for; none where that is out of reach, which a stop time below
/// least_time is and nothing else. README (R59), (R60): a root in ln k, and a scale.
/// @throws std::domain_error  unless two are given, finite and not negative; for a flow with a drive; as require_monotone
/// @throws TooFarApart        where what the best start comes to is off by more than 1e-6
///
/// Accuracy  what the start comes to, 1e-13 of each of the two.
/// Cost      some 15 orbits.
std::optional<State> aimed(const Flow& flow, const Aim& aim);

}  // namespace contensou::reduction
