#include "answers/portrait_spec.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "contensou/si/scaling.hpp"

namespace contensou::answers {

namespace {

/// A motion of several orbits as one line: at equal times, and towards the stop at equal ratios of the time left.
portraits::PortraitOrbit one_line(const std::vector<si::ReducedPiece>& pieces) {
  constexpr Eigen::Index of_piece = 300;
  constexpr double folds = 30;
  const double stop = si::stop_time(pieces);
  const auto pieces_before = static_cast<Eigen::Index>(pieces.size()) - 1, rows = (pieces_before + 1) * of_piece + 1;
  const Eigen::ArrayXd empty(rows);
  portraits::PortraitOrbit orbit{empty, empty, empty, empty, empty};
  const auto set = [&](Eigen::Index row, const reduction::OrbitPoint& point, double left) {
    orbit.u[row] = point.u;
    orbit.v[row] = point.v;
    orbit.ln_v[row] = point.ln_v;
    orbit.ln_k[row] = std::log(point.k);
    orbit.tau_left[row] = left;
  };
  for (Eigen::Index row = 0; row < rows; ++row) {
    const Eigen::Index piece = std::min(row / of_piece, pieces_before);
    const double part = static_cast<double>(row - piece * of_piece) / of_piece;
    const auto& here = pieces[static_cast<std::size_t>(piece)];
    if (piece < pieces_before) {
      const double tau = std::lerp(here.tau, pieces[static_cast<std::size_t>(piece) + 1].tau, part);
      set(row, si::state_at(pieces, tau), stop - tau);
    } else {
      const double left = row + 1 == rows ? 0 : here.orbit.stop_time() * std::exp(-folds * part);
      set(row, si::state_at_time_left(pieces, left), left);
    }
  }
  orbit.ln_k[rows - 1] = orbit.ln_k[rows - 2];
  return orbit;
}

}  // namespace

portraits::PhasePortrait PortraitSpec::portrait() const {
  portraits::PortraitRequest asked = request;
  asked.highlight = start;
  constexpr double narrow_mm = 120;
  if (style.size.width_mm.value_or(narrow_mm) < narrow_mm) {
    asked.orbits_per_side = asked.orbits_per_side.value_or(8);
    asked.isochrones = asked.isochrones.value_or(4);
  }
  if (experiment) asked.time_unit = 1 / si::seconds(*experiment, 1);
  portraits::PhasePortrait portrait = portraits::phase_portrait(flow, asked);
  if (const auto orbits = pieces(); orbits.size() > 1) portrait.highlight = one_line(orbits);
  return portrait;
}

std::vector<si::ReducedPiece> PortraitSpec::pieces() const {
  if (!experiment || (experiment->contact.rolling_friction == 0 && experiment->environment.slope == 0)) return {};
  if (!start || (start->u == 0 && start->v == 0)) return {};
  return si::ResistedMotion(*experiment, flow.system().law(), experiment->contact.rolling_friction).pieces();
}

portraits::Figure PortraitSpec::figure(const portraits::PhasePortrait& portrait) const {
  return mapped_figure(portrait).figure;
}

portraits::MappedFigure PortraitSpec::mapped_figure(const portraits::PhasePortrait& portrait) const {
  return portraits::draw_mapped(portrait, caption(portrait), style);
}

portraits::PortraitSource PortraitSpec::source() const {
  if (!experiment) return {.version = CONTENSOU_VERSION};
  return {.version = CONTENSOU_VERSION, .ball = experiment->ball.name, .seconds_per_tau = si::seconds(*experiment, 1)};
}

portraits::PortraitCaption PortraitSpec::caption(const portraits::PhasePortrait& portrait) const {
  using portraits::math, portraits::sub;
  portraits::PortraitCaption caption;
  if (!start) return caption;
  const double stop = portrait.highlight ? portrait.highlight->tau_left[0] : 0;
  caption.highlight = "this motion";
  if (!experiment) {
    caption.subtitle = math("u") + sub("0") + math(" = ") + fmt::format("{:g}, ", start->u) + math("v") + sub("0") +
                       math(" = ") + fmt::format("{:g}: slip and spin end after ", start->v) + math("τ* = ") +
                       fmt::format("{:.4g}", stop);
    return caption;
  }
  caption.title = portraits::title_of(portraits::shortened(experiment->ball.name),
                                      fmt::format("{:.4g}", flow.system().mu()), portraits::law_names(portrait));
  caption.subtitle =
      fmt::format("slip {:g} m/s, spin {:g} rad/s: they end after {:.3g} s", si::slip_at_start(*experiment),
                  si::spin_at_start(*experiment), si::seconds(*experiment, stop));
  caption.speed_unit = "m/s";
  caption.time_symbol = math("t*");
  caption.time_unit_name = "s";
  caption.time_unit = 1 / si::seconds(*experiment, 1);
  caption.highlight = experiment->ball.body.lies_flat() ? "this motion" : "this ball";
  return caption;
}

}  // namespace contensou::answers
