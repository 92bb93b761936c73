#include "answers/figures/figures.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include <fmt/format.h>
#include <Eigen/Cholesky>

#include "contensou/portraits/layout.hpp"
#include "contensou/si/motion.hpp"

namespace contensou::answers {

namespace {

using portraits::Colour;
using portraits::Panel;
using portraits::Point;

constexpr Colour fit_colour{0x8c0f35};
constexpr Colour textbook_colour{0x777777};
constexpr Colour inner_colour{0xd3dff0}, outer_colour{0xeef2f8};
/// Colours of the tracks, one after the other. Their brightness differs, too, for prints in grey.
constexpr Colour data_colours[]{{0x4a90cc}, {0x3a3a3a}, {0xe0a030}, {0x8050a0}};

/// Largest number of values of a track that are drawn. More marks would overlap.
constexpr Eigen::Index most_marks = 250;
/// Residuals of more standard deviations than this are drawn as arrows at the border.
constexpr double residual_border = 4;

Panel empty(portraits::Text title, portraits::Text name) {
  Panel panel;
  panel.title = std::move(title);
  panel.x = {portraits::math("t") + ", s", 0, 0, false, {}};
  panel.y = {std::move(name), INFINITY, -INFINITY, false, {}};
  return panel;
}

void widen(portraits::Axis& axis, double margin) {
  const double length = axis.high > axis.low ? axis.high - axis.low : std::max(std::abs(axis.high), 1e-300);
  axis.low -= margin * length;
  axis.high += margin * length;
}

/// Unit of an axis: mm or mm/s for values below 0.1 m or 0.1 m/s.
struct ShownUnit {
  std::string name;
  double factor = 1;
};
ShownUnit shown_unit(const fit::Fit& fit, const std::vector<fit::Track>& tracks, const fit::Noise& noise) {
  const std::string unit(fit::kind_of(noise.observable).unit);
  double largest = 0;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    for (std::size_t k = 0; k < tracks[i].series.size(); ++k) {
      if (tracks[i].series[k].observable == noise.observable)
        largest = std::max(largest, fit.predicted[i][k].abs().maxCoeff());
    }
  }
  constexpr double small = 0.1;
  return unit.starts_with('m') && largest < small ? ShownUnit{"m" + unit, 1e3} : ShownUnit{unit};
}

/// Returns an angle, rad, plus or minus the whole turns that bring it nearest to the angle `other`.
double at_turn_of(double other, double angle) {
  constexpr double turn = 2 * std::numbers::pi;
  return angle + turn * std::round((other - angle) / turn);
}

/// Returns slip, spin or angle under the uncoupled model from the same start, in SI units; empty for other observables.
/// @param times  s from the start
Eigen::ArrayXd of_textbook(const fit::Fit& fit, const reduction::Law& law, std::size_t track,
                           fit::Observable observable, const Eigen::ArrayXd& times) {
  using fit::Observable, fit::Parameter;
  if (fit.rolls_with_friction()) return {};
  si::Experiment ball = fit.ball;
  const double spin = fit.estimate(Parameter::spin, track).value;
  ball.start = si::SlipAndSpin{std::max(0.0, fit.estimate(Parameter::slip, track).value), spin};
  const si::Motion motion = si::Motion::uncoupled(ball, law);
  if (observable == Observable::slip) return motion.at(times).slip;
  if (observable == Observable::spin) return motion.at(times).wz;
  if (observable != Observable::angle) return {};
  if (!(motion.spin_end() > 0))
    return Eigen::ArrayXd::Constant(times.size(), fit.estimate(Parameter::angle, track).value);
  const Eigen::ArrayXd spinning = times.min(motion.spin_end());
  return fit.estimate(Parameter::angle, track).value + spin * spinning * (1 - spinning / (2 * motion.spin_end()));
}

/// Two panels for one observable: the data with the fit, and the residuals.
struct Pair {
  Panel data, residuals;
};

Pair panels_of(const fit::Fit& fit, const reduction::Law& law, const std::vector<fit::Track>& tracks,
               const fit::Noise& noise) {
  const auto& [observable, name, si_unit, meaning] = fit::kind_of(noise.observable);
  const auto [unit, factor] = shown_unit(fit, tracks, noise);
  Pair pair{empty("", fmt::format("{}, {}", name, unit)), empty("", fmt::format("{}: residual / sd", name))};
  if (noise.neighbours > 0)
    pair.residuals.title = fmt::format("residuals depend on each other: correlation {:.2f}", noise.neighbours);
  double last = 0, first = INFINITY;
  portraits::Lines curves{{}, {fit_colour, 3}, "fitted motion"};
  portraits::Lines textbook{{}, {textbook_colour, 1.6, true}, "textbook (uncoupled)"};
  portraits::Axis& y = pair.data.y;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    const fit::Track& track = tracks[i];
    for (std::size_t k = 0; k < track.series.size(); ++k) {
      const fit::Series& series = track.series[k];
      if (series.observable != noise.observable) continue;
      const Colour colour = data_colours[i % std::size(data_colours)];
      const Eigen::Index step = std::max<Eigen::Index>(1, (track.t.size() + most_marks - 1) / most_marks);
      portraits::Marks data{{}, colour, 0.38, portraits::Marks::Shape::dot, i == 0 ? "measured" : ""};
      portraits::Marks residuals = data;
      residuals.legend = "";
      portraits::Polyline curve;
      for (Eigen::Index row = 0; row < track.t.size(); row += step) {
        const double fitted = factor * fit.predicted[i][k][row];
        double value = factor * series.value[row];
        if (observable == fit::Observable::angle) value = at_turn_of(fitted, value);
        curve.push_back({track.t[row], fitted});
        first = std::min(first, track.t[row]);
        last = std::max(last, track.t[row]);
        for (double each : {fitted, std::isnan(value) ? fitted : value}) {
          y.low = std::min(y.low, each);
          y.high = std::max(y.high, each);
        }
        if (std::isnan(value)) continue;
        data.points.push_back({track.t[row], value});
        const double sd = factor * (series.sd.size() > 0 ? series.sd[row] : noise.sd);
        const double residual = (value - fitted) / sd;
        if (std::abs(residual) <= residual_border) {
          residuals.points.push_back({track.t[row], residual});
        } else {
          pair.residuals.labels.push_back(
              {{track.t[row], std::copysign(residual_border, residual)}, residual > 0 ? "↑" : "↓", colour});
        }
      }
      constexpr int pieces = 200;
      const Eigen::ArrayXd times = Eigen::ArrayXd::LinSpaced(pieces + 1, 0, track.t[track.t.size() - 1] - track.start);
      if (const Eigen::ArrayXd values = of_textbook(fit, law, i, observable, times); values.size() > 0) {
        textbook.lines.emplace_back();
        for (Eigen::Index j = 0; j < times.size(); ++j)
          textbook.lines.back().push_back({track.start + times[j], factor * values[j]});
        y.low = std::min(y.low, factor * values.minCoeff());
        y.high = std::max(y.high, factor * values.maxCoeff());
      }
      curves.lines.push_back(std::move(curve));
      pair.data.marks.push_back(std::move(data));
      pair.residuals.marks.push_back(std::move(residuals));
    }
  }
  pair.data.lines.push_back(std::move(curves));
  if (!textbook.lines.empty()) pair.data.lines.push_back(std::move(textbook));
  for (Panel* panel : {&pair.data, &pair.residuals}) {
    // The axis shows the time of the film. The axis begins at 0 if the film begins soon after 0.
    panel->x.low = first > 0 && first < 0.1 * last ? 0 : first;
    panel->x.high = last > first ? last : first + 1;
  }
  widen(y, 0.06);
  // Leave room for an arrow at the border, even if the panel is only a few millimetres high.
  pair.residuals.y.low = -1.25 * residual_border;
  pair.residuals.y.high = 1.25 * residual_border;
  pair.residuals.y.ticks = {{-3, "−3"}, {0, "0"}, {3, "3"}};
  pair.residuals.lines.push_back({{{{pair.residuals.x.low, 0}, {pair.residuals.x.high, 0}}}, {fit_colour, 1.2}, ""});
  return pair;
}

/// Returns the ellipse in which two numbers lie with the given probability.
portraits::Polyline ellipse(const Point& middle, const Eigen::Matrix2d& covariance, double probability) {
  const Eigen::Matrix2d root = covariance.llt().matrixL();
  const double radius = std::sqrt(-2 * std::log(1 - probability));
  portraits::Polyline line;
  constexpr int pieces = 120;
  for (int i = 0; i <= pieces; ++i) {
    const double angle = 2 * std::numbers::pi * i / pieces;
    const Eigen::Vector2d at = radius * root * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    line.push_back({middle.x + at.x(), middle.y + at.y()});
  }
  return line;
}

Panel confidence_panel(const fit::Fit& fit) {
  const fit::Estimate& friction = fit.estimates[0];
  const fit::Estimate& patch = fit.estimates[1];
  constexpr double mm = 1e3;
  const double f_error = friction.standard_error, eps_error = mm * patch.standard_error;
  Eigen::Matrix2d covariance;
  const double together = 0.999999 * fit.correlation_of_contact() * f_error * eps_error;
  covariance << f_error * f_error, together, together, eps_error * eps_error;
  const Point middle{friction.value, mm * patch.value};
  Panel panel;
  panel.title = "confidence regions: 68 and 95 %";
  panel.x = {"friction", middle.x - 3 * f_error, middle.x + 3 * f_error, false, {}};
  panel.y = {"patch radius, mm", middle.y - 3 * eps_error, middle.y + 3 * eps_error, false, {}};
  const auto outer = ellipse(middle, covariance, 0.95), inner = ellipse(middle, covariance, 0.68);
  panel.regions = {{outer, outer_colour}, {inner, inner_colour}};
  panel.lines = {{{outer, inner}, {fit_colour, 1.2}, ""}};
  panel.marks = {{{middle}, fit_colour, 1}};
  return panel;
}

/// Returns true if the error of a number is large enough for an axis. The error is too small if data have no noise.
bool has_width(const fit::Estimate& estimate) {
  constexpr double least = 1e-6;
  return std::isfinite(estimate.standard_error) && estimate.standard_error > least * estimate.value;
}

/// Returns a number with its standard error as text, or with its interval if the interval is skewed.
std::string with_error(const fit::Estimate& estimate, double scale, std::string_view unit = "") {
  if (!estimate.determined()) return "not determined";
  const std::string of = unit.empty() ? "" : fmt::format(" {}", unit);
  if (!estimate.free) return fmt::format("{:.4g}{}", estimate.value * scale, of);
  const auto& [low, high] = estimate.interval;
  if (estimate.skewed()) return fmt::format("{:.3g} to {:.3g}{}", low * scale, high * scale, of);
  const double value = estimate.value * scale, error = estimate.standard_error * scale;
  if (!has_width(estimate)) return fmt::format("{:.4g} ± {:.2g}{}", value, error, of);
  // Both numbers end with the first digit of the error, or with its second digit after a 1.
  const std::string first = fmt::format("{:.0e}", error);
  const int decimals = std::max(0, (first.front() == '1' ? 1 : 0) - std::stoi(first.substr(first.find('e') + 1)));
  return fmt::format("{:.{}f} ± {:.{}f}{}", value, decimals, error, decimals, of);
}

/// Returns a panel that contains the results in words.
Panel numbers_panel(const fit::Fit& fit, std::size_t tracks) {
  Panel panel = empty("", "");
  panel.bare = true;
  panel.x = {"", 0, 1, false, {}};
  panel.y = {"", 0, 1, false, {}};
  double height = 0.95;
  const auto line = [&](const std::string& text) {
    panel.labels.push_back({{0.05, height}, text, {0x222222}, portraits::Label::Align::left});
    height -= 0.13;
  };
  line("friction " + with_error(fit.estimates[0], 1));
  line("patch radius " + with_error(fit.estimates[1], 1e3, "mm"));
  if (fit.rolls_with_friction()) {
    line("rolling friction " + with_error(fit.estimate(fit::Parameter::rolling_friction), 1));
  } else {
    line(fmt::format("correlation of both {:.2f}", fit.correlation_of_contact()));
  }
  if (tracks == 1) {
    line("slip at the start " + with_error(fit.estimate(fit::Parameter::slip), 1, "m/s"));
    line("spin at the start " + with_error(fit.estimate(fit::Parameter::spin), 1, "rad/s"));
  }
  for (const fit::Noise& noise : fit.noise) {
    const auto& kind = fit::kind_of(noise.observable);
    line(fmt::format("{}: {} values, rms {:.2g} {}", kind.name, noise.values, noise.rms, kind.unit));
  }
  return panel;
}

}  // namespace

portraits::Figure fit_figure(const fit::Fit& fit, const std::vector<reduction::Law>& laws,
                             const std::vector<fit::Track>& tracks, const portraits::AskedSize& size) {
  const reduction::Law& law = *std::ranges::find(laws, fit.law, [](const auto& each) { return each.name(); });
  portraits::Figure figure;
  figure.title = fmt::format("{},  law: {}", portraits::shortened(fit.ball.ball.name), portraits::shortened(fit.law));
  figure.subtitle = fmt::format("friction {}, patch radius {}", with_error(fit.estimates[0], 1),
                                with_error(fit.estimates[1], 1e3, "mm"));
  if (fit.rolls_with_friction())
    figure.subtitle += ", rolling friction " + with_error(fit.estimate(fit::Parameter::rolling_friction), 1);
  if (fit.only)
    figure.subtitle = fmt::format("the data do not determine friction and patch radius, only {}",
                                  portraits::shortened(fit.only->name()));
  if (!fit.fits()) figure.subtitle += "; this does not fit: the errors do not count";
  std::vector<Panel> below;  // the panels of residuals, and the panel of results in words
  for (const fit::Noise& noise : fit.noise) {
    Pair pair = panels_of(fit, law, tracks, noise);
    figure.panels.push_back(std::move(pair.data));
    below.push_back(std::move(pair.residuals));
  }
  // A page has no room for more rows of panels.
  constexpr std::size_t most_rows = 5;
  const bool both = fit.noise.size() < most_rows && fit.estimates[0].free && fit.estimates[1].free &&
                    std::ranges::all_of(std::span(fit.estimates).first(fit::contact_parameters), has_width) &&
                    !fit.only;
  if (both) {
    figure.panels.push_back(confidence_panel(fit));
    below.push_back(numbers_panel(fit, tracks.size()));
  }
  const auto columns = static_cast<int>(figure.panels.size());
  figure.max_columns = columns;
  portraits::PaperSize usual{85.0 * columns + 10, 150};
  const double width = size.width_mm.value_or(usual.width_mm);
  if (portraits::panel_columns(width, columns) == columns) {
    figure.panels.insert(figure.panels.end(), std::make_move_iterator(below.begin()),
                         std::make_move_iterator(below.end()));
  } else {
    // There are too many rows for panels of the usual height. The panels become flat. Those of residuals stand beside
    // the panels of data, or are left out on a narrow page.
    const bool beside = portraits::panel_columns(width, 2) == 2;
    figure.max_columns = beside ? 2 : 1;
    for (int i = columns - 1; beside && i >= 0; --i)
      figure.panels.insert(figure.panels.begin() + i + 1, std::move(below[static_cast<std::size_t>(i)]));
    usual = {100.0 * static_cast<double>(figure.panels.size()), 67};
  }
  figure.size = portraits::fitted(usual, static_cast<int>(figure.panels.size()), size, figure.max_columns);
  return figure;
}

}  // namespace contensou::answers
