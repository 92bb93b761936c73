#include "verbs/fit_answer.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "input/parse.hpp"

namespace contensou::program {

namespace {

using fit::Estimate;
using fit::Parameter;

Json members_of(const Estimate& estimate) {
  return {{"value", estimate.value},
          {"standard_error", estimate.standard_error},
          {"low", estimate.interval.low},
          {"high", estimate.interval.high}};
}

const std::string_view& name_of(const Estimate& estimate) { return fit::kind_of(estimate.parameter).name; }

bool is_of_start(const Estimate& estimate) { return static_cast<int>(estimate.parameter) >= fit::shared_parameters; }

/// Infinity where there are no degrees of freedom: no format says NaN.
double reduced_chi2(const fit::Fit& fit) { return or_infinity(fit.reduced_chi2()); }

}  // namespace

Answer answer_of(const std::vector<fit::Fit>& fits, const std::vector<fit::Track>& tracks, bool planned) {
  const fit::Fit& best = fits.front();
  Answer answer;
  Json& members = answer.members;
  members = {{"law", best.law},
             {"friction", members_of(best.estimates[0])},
             {"patch_radius", members_of(best.estimates[1])},
             {"slip", members_of(best.estimate(Parameter::slip))},
             {"spin", members_of(best.estimate(Parameter::spin))},
             {"correlation", best.correlation_of_contact()},
             {"reduced_chi2", planned ? 1 : reduced_chi2(best)},
             {"degrees_of_freedom", best.degrees_of_freedom},
             {"profiled", best.profiled}};
  if (best.only) {
    members["only"] = {{"name", best.only->name()},
                       {"friction_power", best.only->friction_power},
                       {"patch_power", best.only->patch_power},
                       {"value", best.only->value},
                       {"standard_error", best.only->value * best.only->relative_error}};
  }
  members["tracks"] = Json::array();
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    Json track{{"file", tracks[i].name}, {"start", tracks[i].start}};
    for (const Estimate& estimate : best.estimates) {
      if (is_of_start(estimate) && estimate.track == i) track[std::string(name_of(estimate))] = members_of(estimate);
    }
    members["tracks"].push_back(std::move(track));
  }
  members["noise"] = Json::object();
  for (const fit::Noise& noise : best.noise) {
    members["noise"][std::string(fit::kind_of(noise.observable).name)] = {
        {"values", noise.values}, {"rms", noise.rms}, {"sd", noise.sd}, {"estimated", noise.estimated}};
  }
  members["laws"] = Json::array();
  for (const fit::Fit& fit : fits) {
    members["laws"].push_back({{"law", fit.law},
                               {"aic", fit.aic},
                               {"friction", fit.estimates[0].value},
                               {"patch_radius", fit.estimates[1].value},
                               {"reduced_chi2", planned ? 1 : reduced_chi2(fit)}});
  }
  for (const fit::Fit& fit : fits) {
    for (const Estimate& estimate : fit.estimates) {
      const std::string track = is_of_start(estimate) ? tracks[estimate.track].name : "";
      Json row{{"law", fit.law}, {"track", track}, {"parameter", name_of(estimate)}};
      row.update(members_of(estimate));
      answer.rows.push_back(std::move(row));
    }
  }
  return answer;
}

std::string report_on(const std::vector<fit::Fit>& fits, const std::vector<fit::Track>& tracks, bool planned,
                      const Digits& digits) {
  const fit::Fit& best = fits.front();
  std::string text = planned
                         ? fmt::format("{} as planned: {} values, law {}\n", best.ball.ball.name, best.values, best.law)
                         : fmt::format("{}: {} measured value{}, law {}\n", best.ball.ball.name, best.values,
                                       best.values == 1 ? "" : "s", best.law);
  if (best.only) {
    text += fmt::format("\nThese data determine {} only: {} +- {} ({:.2g} %)\n", best.only->name(),
                        digits(best.only->value), digits(best.only->value * best.only->relative_error),
                        100 * best.only->relative_error);
  }
  const Digits few{std::min(digits.count, 3)};
  text += fmt::format("\n{:<14}{:>{}}{:>12}{:>12}   {}\n", "", "value", digits.width(), "+-", "", "95 % confidence");
  std::size_t track = tracks.size();
  for (const Estimate& estimate : best.estimates) {
    if (is_of_start(estimate) && estimate.track != track) {
      track = estimate.track;
      if (tracks.size() > 1) text += fmt::format("{}\n", escaped(tracks[track].name));
    }
    const std::string_view unit = fit::kind_of(estimate.parameter).unit;
    if (!estimate.free) {
      text += fmt::format("{:<14}{:>{}}  {}, given\n", name_of(estimate), digits(estimate.value), digits.width(), unit);
      continue;
    }
    const double percent = 100 * estimate.standard_error / std::abs(estimate.value);
    const bool decided = std::isfinite(estimate.standard_error);
    std::string line =
        fmt::format("{:<14}{:>{}}{:>12}{:>12}   {} to {} {}", name_of(estimate), decided ? digits(estimate.value) : "?",
                    digits.width(), decided ? few(estimate.standard_error) : "?",
                    std::isfinite(percent) ? fmt::format("{:.2g} %", percent) : "", digits(estimate.interval.low),
                    digits(estimate.interval.high), unit);
    line.resize(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  text += "\n";
  if (best.estimates[0].free && best.estimates[1].free) {
    text += fmt::format("correlation of friction and patch_radius {:.3f}{}\n", best.correlation_of_contact(),
                        best.profiled ? "; their intervals are by profile likelihood" : "");
  }
  const bool some_given = !std::ranges::all_of(best.noise, &fit::Noise::estimated);
  if (!planned && some_given && best.degrees_of_freedom > 0) {
    text += fmt::format("reduced chi^2 {:.4g}, {} degrees of freedom\n", best.reduced_chi2(), best.degrees_of_freedom);
  }
  for (const fit::Noise& noise : best.noise) {
    const auto& kind = fit::kind_of(noise.observable);
    text += fmt::format("{:<6}{} values, sd {:.3g} {}{}\n", kind.name, noise.values, noise.sd, kind.unit,
                        planned           ? ""
                        : noise.estimated ? " (estimated)"
                                          : fmt::format(" (given), residuals {:.3g}", noise.rms));
  }
  if (best.at_limit)
    text +=
        "a value ran into what it may be: friction 1e-4 to 10, a patch not larger than the ball, nor so large that the "
        "law\n"
        "has an invariant ray\n";
  if (fits.size() > 1) {
    text += fmt::format("\n{:<14}{:>12}{:>12}{:>16}\n", "law", "friction", "patch mm", "AIC less best");
    for (const fit::Fit& fit : fits) {
      text += fmt::format("{:<14}{:>12.4g}{:>12.4g}{:>16.1f}\n", fit.law, fit.estimates[0].value,
                          1e3 * fit.estimates[1].value, fit.aic - best.aic);
    }
    const double lead = fits[1].aic - best.aic;
    constexpr double hardly = 4;
    text += lead < hardly ? "these data do not tell the first two apart (by 4 they would)\n"
                          : fmt::format("{} fits better than all others\n", best.law);
  }
  return text;
}

}  // namespace contensou::program
