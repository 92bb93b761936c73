#include "answers/asked/portrait_spec.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "contensou/si/scaling.hpp"

namespace contensou::answers {

namespace {

constexpr int of_narrow = 8;  ///< number of orbits on each side of u = 0 in a narrow panel

/// Joins orbits into one curve, at equal steps of time; on the last orbit, at equal ratios of successive times left.
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

portraits::PortraitRequest PortraitSpec::whole_request() const {
  portraits::PortraitRequest asked = request;
  asked.highlight = start;
  constexpr double narrow_mm = 120;
  if (style.size.width_mm.value_or(narrow_mm) < narrow_mm) {
    asked.orbits = asked.orbits.value_or(of_narrow);
    asked.isochrones = asked.isochrones.value_or(4);
  }
  if (experiment) asked.time_unit = 1 / si::seconds(*experiment, 1);
  return asked;
}

portraits::PhasePortrait PortraitSpec::portrait() const { return portraits_of({*this}).front(); }

std::vector<portraits::PhasePortrait> portraits_of(const std::vector<PortraitSpec>& specs) {
  std::vector<reduction::Flow> flows;
  for (const PortraitSpec& spec : specs) flows.push_back(spec.flow);
  portraits::PortraitRequest asked = specs.front().whole_request();
  if (specs.size() > 1) {
    asked.orbits = asked.orbits.value_or(of_narrow);
    asked.isochrones = specs.front().request.isochrones;  // the default number of a single plane would be too large
  }
  std::vector<portraits::PhasePortrait> all = portraits::phase_portraits(flows, asked);
  for (std::size_t i = 0; i < specs.size(); ++i) {
    if (const auto orbits = specs[i].pieces(); orbits.size() > 1) all[i].highlight = {one_line(orbits)};
  }
  return all;
}

portraits::Figure figure_of(const std::vector<PortraitSpec>& specs, const std::vector<portraits::PhasePortrait>& all) {
  if (specs.size() == 1) return specs.front().mapped_figure(all.front()).figure;
  std::vector<portraits::PortraitCaption> captions;
  for (std::size_t i = 0; i < specs.size(); ++i) captions.push_back(specs[i].caption(all[i]));
  portraits::PortraitCaption& first = captions.front();
  // The title is common to all panels. Each panel shows only the properties of its own plane.
  first.subtitle = "";
  if (const auto& ball = specs.front().experiment) {
    first.title = portraits::shortened(ball->ball.name);
    const double mu = all.front().system().mu();
    if (std::ranges::all_of(all, [=](const auto& other) { return other.system().mu() == mu; }))
      first.title += ",  " + portraits::math("μ = ") + fmt::format("{:.4g}", mu);
    first.subtitle = fmt::format("slip {:g} m/s, spin {:g} rad/s", si::slip_at_start(*ball), si::spin_at_start(*ball));
  } else if (const auto& start = specs.front().start) {
    using portraits::math, portraits::sub;
    first.subtitle = math("u") + sub("0") + math(" = ") + fmt::format("{:g}, ", start->u) + math("v") + sub("0") +
                     math(" = ") + fmt::format("{:g}", start->v);
  }
  return portraits::draw_together(all, std::move(captions), specs.front().style);
}

std::vector<si::ReducedPiece> PortraitSpec::pieces() const {
  if (!experiment || !si::is_driven(*experiment) || !start || (start->u == 0 && start->v == 0)) return {};
  return si::Motion::reduced(*experiment, flow.system().law()).pieces();
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
  const double stop = portrait.highlight.empty() ? 0 : portrait.highlight[0].tau_left[0];
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
