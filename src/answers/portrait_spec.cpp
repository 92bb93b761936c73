#include "answers/portrait_spec.hpp"

#include <string>

#include <fmt/format.h>

#include "contensou/si/scaling.hpp"

namespace contensou::answers {

portraits::PhasePortrait PortraitSpec::portrait() const {
  portraits::PortraitRequest asked = request;
  asked.highlight = start;
  constexpr double narrow_mm = 120;
  if (style.size.width_mm.value_or(narrow_mm) < narrow_mm) {
    asked.orbits_per_side = asked.orbits_per_side.value_or(8);
    asked.isochrones = asked.isochrones.value_or(4);
  }
  if (experiment) asked.time_unit = 1 / si::seconds(*experiment, 1);
  return portraits::phase_portrait(flow, asked);
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
