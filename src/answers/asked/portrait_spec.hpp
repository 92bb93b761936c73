#pragma once

#include <optional>
#include <vector>

#include "contensou/portraits/phase_portrait.hpp"
#include "contensou/reduction/flow.hpp"
#include "contensou/si/motion.hpp"

namespace contensou::answers {

/// The complete description of a portrait: the options of `portrait`, or the state of the page. Equal descriptions give
/// equal portraits, so the command line on the page draws the same picture.
struct PortraitSpec {
  reduction::Flow flow;
  std::optional<reduction::State> start = {};     ///< start of the highlighted orbit
  std::optional<si::Experiment> experiment = {};  ///< source of mu and start, if they are those of a ball in SI units
  portraits::PortraitRequest request = {};        ///< highlight and time unit follow from start and experiment
  portraits::PortraitStyle style = {};

  /// Computes the portrait.
  /// @throws std::domain_error  as phase_portrait
  portraits::PhasePortrait portrait() const;

  /// Draws a portrait, in SI units if `experiment` is set. Returns the figure with the map of each panel.
  portraits::MappedFigure mapped_figure(const portraits::PhasePortrait& portrait) const;

  /// Returns the source of the portrait (version, ball, seconds per tau), for files with the data of the portrait.
  portraits::PortraitSource source() const;

  /// Returns the request, completed from start, experiment and style.
  portraits::PortraitRequest whole_request() const;

  std::vector<si::ReducedPiece> pieces() const;  ///< orbits of a ball with rolling friction or on a slope; else empty
  portraits::PortraitCaption caption(const portraits::PhasePortrait& portrait) const;
};

/// Computes portraits for one figure. Only flow, start and experiment may differ between the specs.
/// @param specs  one or more
/// @throws std::domain_error  as phase_portraits
std::vector<portraits::PhasePortrait> portraits_of(const std::vector<PortraitSpec>& specs);

/// Draws the portraits of these specs in one figure. Throws as portraits::draw_together.
portraits::Figure figure_of(const std::vector<PortraitSpec>& specs, const std::vector<portraits::PhasePortrait>& all);

}  // namespace contensou::answers
