#pragma once

#include <optional>
#include <vector>

#include "contensou/portraits/phase_portrait.hpp"
#include "contensou/portraits/phase_portrait_figure.hpp"
#include "contensou/reduction/flow.hpp"
#include "contensou/si/motion.hpp"

namespace contensou::answers {

/// Everything that a portrait is asked for by: the options of `portrait`, or the state of the page. Equal questions
/// have equal answers, so that the page's command line draws what the page shows.
struct PortraitSpec {
  reduction::Flow flow;
  std::optional<reduction::State> start = {};     ///< of the highlighted orbit
  std::optional<si::Experiment> experiment = {};  ///< where mu and start came from, if it is a ball in SI units
  portraits::PortraitRequest request = {};        ///< highlight and time unit follow from start and experiment
  portraits::PortraitStyle style = {};

  /// @throws std::domain_error  as phase_portrait
  portraits::PhasePortrait portrait() const;

  /// The drawing of that portrait, with the units of a ball.
  portraits::Figure figure(const portraits::PhasePortrait& portrait) const;

  /// The drawing, and the map of each of its panels.
  portraits::MappedFigure mapped_figure(const portraits::PhasePortrait& portrait) const;

  /// What its data say about where they come from.
  portraits::PortraitSource source() const;

  /// The request with what follows from start, experiment and style.
  portraits::PortraitRequest whole_request() const;

  std::vector<si::ReducedPiece> pieces() const;  ///< the orbits of a ball with rolling friction or on a slope
  portraits::PortraitCaption caption(const portraits::PhasePortrait& portrait) const;
};

/// Portraits of specs that differ in flow, start and experiment alone, to be compared in one figure.
/// @param specs  one or more
/// @throws std::domain_error  as phase_portraits
std::vector<portraits::PhasePortrait> portraits_of(const std::vector<PortraitSpec>& specs);

/// The drawing of them. Throws as draw_together.
portraits::Figure figure_of(const std::vector<PortraitSpec>& specs, const std::vector<portraits::PhasePortrait>& all);

}  // namespace contensou::answers
