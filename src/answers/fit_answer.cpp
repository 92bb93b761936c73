#include "answers/fit_answer.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "answers/parse.hpp"

namespace contensou::answers {

namespace {

using fit::Estimate;
using fit::Parameter;

Json members_of(const Estimate& estimate) {
  return {{"value", estimate.value},
          {"standard_error", estimate.standard_error},
          {"low", estimate.interval.low},
          {"high", estimate.interval.high},
          {"determined", estimate.determined()}};
}

const std::string_view& name_of(const Estimate& estimate) { return fit::kind_of(estimate.parameter).name; }

bool is_of_start(const Estimate& estimate) { return static_cast<int>(estimate.parameter) >= fit::shared_parameters; }

/// None without degrees of freedom.
Json reduced_chi2(const fit::Fit& fit, bool planned) {
  if (planned) return 1;
  return fit.degrees_of_freedom > 0 ? Json(fit.reduced_chi2()) : Json();
}

/// "t = 0.1, 0.25 s", by track where there are several; the first ones.
std::string places_of(const std::vector<fit::Outlier>& outliers, const std::vector<fit::Track>& tracks) {
  constexpr std::size_t most = 6;
  std::string text;
  for (std::size_t i = 0; i < std::min(outliers.size(), most); ++i) {
    const auto& [track, t] = outliers[i];
    const bool first_of_track = i == 0 || outliers[i - 1].track != track;
    if (first_of_track && i > 0) text += " s; ";
    if (first_of_track && tracks.size() > 1) text += escaped(tracks[track].name) + ", ";
    text += fmt::format("{}{:.6g}", first_of_track ? "t = " : ", ", t);
  }
  return text + (outliers.size() > most ? ", ... s" : " s");
}

/// What else is to be known, a sentence each.
std::vector<std::string> remarks_on(const fit::Fit& fit, const std::vector<fit::Track>& tracks, bool planned) {
  std::vector<std::string> remarks;
  for (const fit::Noise& noise : fit.noise) {
    if (noise.outliers.empty() || planned) continue;
    remarks.push_back(fmt::format(
        "{}: {} of {} values are off by more than 6 standard deviations of the others, at {}; Huber's "
        "loss (--robust) lets them count for less",
        fit::kind_of(noise.observable).name, noise.outliers.size(), noise.values, places_of(noise.outliers, tracks)));
  }
  for (std::size_t i = 0; i < fit.turns.size(); ++i) {
    const auto& [limit, others] = fit.turns[i];
    if (!std::isfinite(limit)) continue;
    const double spin = std::abs(fit.estimate(Parameter::spin, i).value);
    constexpr double near = 0.8;
    const std::string of = tracks.size() > 1 ? escaped(tracks[i].name) + ": " : "";
    if (planned) {
      remarks.push_back(
          fmt::format("{}between two pictures a mark turns by less than half a turn up to a spin of {:.4g} rad/s; "
                      "beyond it its turns have to be found by trial{}",
                      of, limit, spin > near * limit ? ", as here" : ""));
    } else if (spin > near * limit) {
      remarks.push_back(
          fmt::format("{}from {:.4g} rad/s on a mark turns by more than half a turn between two pictures: its "
                      "turns were found by trial; more pictures a second would show them",
                      of, limit));
    }
    if (!others.empty()) {
      remarks.push_back(fmt::format(
          "{}a spin of {:.4g} rad/s, by other whole turns between two pictures, fits as well: another rate of "
          "pictures, or how far the mark is blurred in one, tells which",
          of, others.front()));
    }
  }
  if (const auto& seen = fit.rolling_friction_seen) {
    remarks.push_back(fmt::format(
        "chi^2 would be less by {:.0f} with a rolling friction of about {:.2g} +- {:.1g}, friction then about "
        "{:.3g}: --rolling-friction {:.2g} lets the fit search it",
        seen->chi2_less, seen->value, seen->standard_error, seen->friction, seen->value));
  }
  if (fit.at_limit) {
    remarks.emplace_back(
        "a value ran into what it may be: friction 1e-4 to 10, a patch not larger than the ball nor so large "
        "that the law has an invariant ray, slip and R spin up to 100 m/s; are the units right?");
  }
  return remarks;
}

/// "friction", "patch_radius, mm": in the units in which people read them.
struct Shown {
  std::string name;
  double unit;
};
Shown shown(Parameter parameter) {
  const auto& [name, unit, meaning] = fit::kind_of(parameter);
  if (parameter == Parameter::patch_radius) return {fmt::format("{}, mm", name), 1e-3};
  return {unit.empty() ? std::string(name) : fmt::format("{}, {}", name, unit), 1};
}

constexpr int name_width = 18;

std::string line_on(const Estimate& estimate, const Digits& digits) {
  const auto [name, unit] = shown(estimate.parameter);
  const auto number = [&, unit = unit](double value) { return digits(value / unit); };
  if (!estimate.free)
    return fmt::format("{:<{}}{:>{}}  given\n", name, name_width, number(estimate.value), digits.width());
  const auto& [low, high] = estimate.interval;
  const std::string interval = fmt::format("{} to {}", number(low), number(high));
  if (!estimate.determined()) {
    const bool from_below = std::isinf(low) || low == 0, from_above = std::isinf(high);
    const std::string known = from_below && from_above ? ""
                              : from_above             ? fmt::format(": {} or more", number(low))
                              : from_below             ? fmt::format(": {} or less", number(high))
                                                       : ": " + interval;
    return fmt::format("{:<{}}{:>{}}{:>12}{:>12}   not determined{}\n", name, name_width, "?", digits.width(), "?", "",
                       known);
  }
  const bool with_error = !estimate.skewed();
  const double percent = 100 * estimate.standard_error / std::abs(estimate.value);
  return fmt::format("{:<{}}{:>{}}{:>12}{:>12}   {}\n", name, name_width, number(estimate.value), digits.width(),
                     with_error ? Digits{std::min(digits.count, 3)}(estimate.standard_error / unit) : "",
                     with_error && std::isfinite(percent) ? fmt::format("{:.2g} %", percent) : "", interval);
}

std::string table_of(const fit::Fit& fit, const std::vector<fit::Track>& tracks, const Digits& digits) {
  std::string text = fmt::format("{:<{}}{:>{}}{:>12}{:>12}   {}\n", "", name_width, "value", digits.width(), "+-", "",
                                 "95 % confidence");
  std::size_t track = tracks.size();
  for (const Estimate& estimate : fit.estimates) {
    if (is_of_start(estimate) && estimate.track != track) {
      track = estimate.track;
      if (tracks.size() > 1) text += escaped(tracks[track].name) + "\n";
    }
    text += line_on(estimate, digits);
  }
  return text;
}

std::string noise_of(const fit::Fit& fit, bool planned) {
  std::string text;
  const bool some_given = !std::ranges::all_of(fit.noise, &fit::Noise::estimated);
  if (!planned && some_given && fit.degrees_of_freedom > 0)
    text += fmt::format("reduced chi^2 {:.4g}, {} degrees of freedom\n", fit.reduced_chi2(), fit.degrees_of_freedom);
  for (const fit::Noise& noise : fit.noise) {
    const auto& kind = fit::kind_of(noise.observable);
    text += fmt::format("{:<6}{} values, sd {:.3g} {}{}\n", kind.name, noise.values, noise.sd, kind.unit,
                        planned           ? ""
                        : noise.estimated ? " (estimated)"
                                          : fmt::format(" (given), residuals {:.3g}", noise.rms));
  }
  return text;
}

std::string ranking_of(const std::vector<fit::Fit>& fits) {
  const fit::Fit& best = fits.front();
  std::string text = fmt::format("\n{:<14}{:>12}{:>12}{:>16}\n", "law", "friction", "patch, mm", "AIC less best");
  for (const fit::Fit& fit : fits) {
    text += fmt::format("{:<14}{:>12.4g}{:>12.4g}{:>16.1f}\n", fit.law, fit.estimates[0].value,
                        1e3 * fit.estimates[1].value, fit.aic - best.aic);
  }
  constexpr double hardly = 4;
  return text + (fits[1].aic - best.aic < hardly ? "these data do not tell the first two apart (by 4 they would)\n"
                                                 : fmt::format("{} fits better than all others\n", best.law));
}

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
             {"reduced_chi2", reduced_chi2(best, planned)},
             {"degrees_of_freedom", best.degrees_of_freedom},
             {"profiled", best.profiled},
             {"fits", best.fits()},
             {"misfits", best.misfits},
             {"remarks", remarks_on(best, tracks, planned)}};
  if (best.rolls_with_friction()) members["rolling_friction"] = members_of(best.estimate(Parameter::rolling_friction));
  if (best.only) {
    members["only"] = {{"name", best.only->name()},
                       {"friction_power", best.only->friction_power},
                       {"patch_power", best.only->patch_power},
                       {"value", best.only->value},
                       {"standard_error", best.only->value * best.only->relative_error},
                       {"low", best.only->interval.low},
                       {"high", best.only->interval.high}};
  }
  members["tracks"] = Json::array();
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    Json track{{"file", tracks[i].name}, {"start", tracks[i].start}};
    for (const Estimate& estimate : best.estimates) {
      if (is_of_start(estimate) && estimate.track == i) track[std::string(name_of(estimate))] = members_of(estimate);
    }
    if (const fit::Turns& turns = best.turns[i]; std::isfinite(turns.half_turn_spin)) {
      track["half_turn_spin"] = turns.half_turn_spin;
      track["other_spins"] = turns.other_spins;
    }
    members["tracks"].push_back(std::move(track));
  }
  members["noise"] = Json::object();
  for (const fit::Noise& noise : best.noise) {
    members["noise"][std::string(fit::kind_of(noise.observable).name)] = {{"values", noise.values},
                                                                          {"rms", noise.rms},
                                                                          {"sd", noise.sd},
                                                                          {"estimated", noise.estimated},
                                                                          {"outliers", noise.outliers.size()}};
    Json& places = members["noise"][std::string(fit::kind_of(noise.observable).name)]["outliers_at"];
    places = Json::array();
    for (const auto& [track, t] : noise.outliers) places.push_back({{"file", tracks[track].name}, {"t", t}});
  }
  members["laws"] = Json::array();
  for (const fit::Fit& fit : fits) {
    members["laws"].push_back({{"law", fit.law},
                               {"aic", fit.aic},
                               {"friction", fit.estimates[0].value},
                               {"patch_radius", fit.estimates[1].value},
                               {"reduced_chi2", reduced_chi2(fit, planned)}});
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
  if (!best.fits()) {
    text += "\nTHIS DOES NOT FIT: these errors and intervals do not count.\n";
    for (const std::string& misfit : best.misfits) text += fmt::format("- {}\n", misfit);
  }
  if (best.only) {
    const std::string unit = best.only->patch_power == 0 ? "" : best.only->patch_power > 0 ? " mm" : " 1/mm";
    const double scale = std::pow(1e3, best.only->patch_power);
    const auto number = [&](double value) { return digits(scale * value); };
    text += fmt::format(
        "\nOf friction and patch radius these data determine {} only: {} +- {}{} ({:.2g} %), 95 % confidence {} to "
        "{}{}\n",
        best.only->name(), number(best.only->value), number(best.only->value * best.only->relative_error), unit,
        100 * best.only->relative_error, number(best.only->interval.low), number(best.only->interval.high), unit);
  }
  text += "\n" + table_of(best, tracks, digits) + "\n";
  const bool both = best.estimates[0].free && best.estimates[1].free;
  if (both) text += fmt::format("correlation of friction and patch_radius {:.3f}\n", best.correlation_of_contact());
  if (best.profiled) text += "intervals by profile likelihood\n";
  text += noise_of(best, planned);
  for (const std::string& remark : remarks_on(best, tracks, planned)) text += remark + "\n";
  if (fits.size() > 1) text += ranking_of(fits);
  return text;
}

}  // namespace contensou::answers
