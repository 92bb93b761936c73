#include "answers/verbs/fit_answer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "answers/input/parse.hpp"

namespace contensou::answers {

namespace {

using fit::Estimate;
using fit::Parameter;

constexpr Field<Estimate> estimate_fields[]{
    {"value", "", "estimated value; one of many possible values if the data do not determine the number",
     [](const Estimate& of) -> Json { return of.value; }},
    {"standard_error", "", "standard error of the value; inf if the data do not determine the number",
     [](const Estimate& of) -> Json { return of.standard_error; }},
    {"low", "", "", [](const Estimate& of) -> Json { return of.interval.low; }},
    {"high", "", "ends of the 95 % confidence interval", [](const Estimate& of) -> Json { return of.interval.high; }},
    {"determined", "", "true if the data determine the number",
     [](const Estimate& of) -> Json { return of.determined(); }},
};
Json members_of_estimate(const Estimate& estimate) { return members_of(estimate_fields, estimate); }
constexpr const char* of_estimate = " {`value`, `standard_error`, `low`, `high`, `determined`}";

const std::string_view& name_of(const Estimate& estimate) { return fit::kind_of(estimate.parameter).name; }

bool is_of_start(const Estimate& estimate) { return static_cast<int>(estimate.parameter) >= fit::shared_parameters; }

/// Returns chi^2 divided by the degrees of freedom; null without degrees of freedom.
Json reduced_chi2(const fit::Fit& fit, bool planned) {
  if (planned) return 1;
  return fit.degrees_of_freedom > 0 ? Json(fit.reduced_chi2()) : Json();
}

/// Returns the time from the first to the last picture of a film, s.
double length_of(const fit::Track& track) { return track.t.size() > 0 ? track.t.tail(1)[0] - track.t[0] : 0; }

/// Returns the first times at which outliers lie, such as "t = 0.1, 0.25 s". For several tracks, each track has a list.
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

/// Returns the last time until which a body has not moved; NaN if it moves from the first pictures on. Up to 2 % of the
/// way is noise.
double stands_until(const fit::Track& track) {
  using enum fit::Observable;
  Eigen::Index first = track.t.size();  // row that has moved
  double range = 0;
  const auto of_place = [](const fit::Series& each) { return each.observable == x || each.observable == y; };
  const auto range_of = [](const fit::Series& each) {
    return each.value.maxCoeff<Eigen::PropagateNumbers>() - each.value.minCoeff<Eigen::PropagateNumbers>();
  };
  for (const fit::Series& each : track.series) {
    if (of_place(each)) range = std::max(range, range_of(each));
  }
  for (const fit::Series& each : track.series) {
    const double small = 0.02 * (of_place(each) ? range : range_of(each));
    const bool speed = !of_place(each) && each.observable != angle;
    for (Eigen::Index i = 0; i < first; ++i) {
      if (std::abs(each.value[i] - (speed ? 0 : each.value[0])) > small) first = i;
    }
  }
  constexpr Eigen::Index least = 5, share = 20;
  return first >= std::max(least, track.t.size() / share) ? track.t[first - 1] : NAN;
}

/// Returns the remarks on a fit, one sentence each. Examples: outliers, or turns of a mark that were found by trial.
std::vector<std::string> remarks_on(const fit::Fit& fit, const std::vector<fit::Track>& tracks, bool planned) {
  std::vector<std::string> remarks;
  for (const fit::Noise& noise : fit.noise) {
    if (planned) continue;
    const std::string_view name = fit::kind_of(noise.observable).name;
    const char* const robust =
        fit.robust ? "Huber's loss lets them count for less" : "with Huber's loss (--robust) they count for less";
    if (!noise.outliers.empty()) {
      remarks.push_back(
          fmt::format("{}: {} of {} values are off by more than 6 standard deviations of the others, at {}; {}", name,
                      noise.outliers.size(), noise.values, places_of(noise.outliers, tracks), robust));
    } else if (noise.hides_outliers()) {
      remarks.push_back(fmt::format("{}: {:.2g} % of the values are far from where most values are; {}", name,
                                    100 * noise.far_from_most, robust));
    }
  }
  for (const fit::Track& track : tracks) {
    const double still = fit.fits() || planned ? NAN : stands_until(track);
    if (!std::isnan(still))
      remarks.push_back(fmt::format("{}nothing moves before {:.4g} s; --from {:.4g} begins the fit there",
                                    tracks.size() > 1 ? escaped(track.name) + ": " : "", still, still));
  }
  if (const Estimate& friction = fit.estimates[0]; friction.free && friction.determined() && !planned) {
    constexpr double least = 0.002, most = 1.5;  // ice to rubber
    if (friction.value < least || friction.value > most) {
      remarks.push_back(fmt::format(
          "friction {:.2g} is outside {} to {}, where friction usually lies; are the units and the pictures per second "
          "right?",
          friction.value, least, most));
    }
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
  for (const fit::OtherMotion& other : fit.other_motions) {
    const std::string of = tracks.size() > 1 ? escaped(tracks[other.track].name) + ": " : "";
    remarks.push_back(fmt::format(
        "{}another motion fits as well: friction {:.4g}, slip {:.4g} m/s, spin {:.4g} rad/s, chi^2 more by {:.2g}; "
        "intervals contain both, and a column of what is not seen, spin, angle or slip, tells which",
        of, other.friction, other.slip, other.spin, other.chi2_more));
  }
  if (const auto& seen = fit.patch_seen; seen && fit.estimates[1].free) {
    remarks.push_back(fmt::format(
        "the patch is smaller than the whole face: it was searched, and AIC is less by {:.0f}; --patch-radius R gives "
        "it",
        seen->aic_less));
  } else if (seen) {
    remarks.push_back(fmt::format(
        "a patch with a radius of about {:.3g} mm, smaller than the whole face, fits far better: AIC less by {:.0f}, "
        "friction then about {:.3g}; --free friction,patch,slip,spin lets the fit search it",
        1e3 * seen->radius, seen->aic_less, seen->friction));
  }
  if (const auto& seen = fit.rolling_friction_seen) {
    remarks.push_back(fmt::format(
        "chi^2 would be less by {:.0f} with a rolling friction of about {:.2g} +- {:.1g}, friction then about "
        "{:.3g}: --rolling-friction {:.2g} lets the fit search it",
        seen->chi2_less, seen->value, seen->standard_error, seen->friction, seen->value));
  }
  return remarks;
}

/// The name of a number and the unit in which people read it, such as "friction" and "patch_radius, mm".
struct Shown {
  std::string name;
  double unit;
};
Shown shown(Parameter parameter) {
  const auto& [name, unit, meaning] = fit::kind_of(parameter);
  if (parameter == Parameter::patch_radius) return {fmt::format("{}, mm", name), 1e-3};
  return {unit.empty() ? std::string(name) : fmt::format("{}, {}", name, unit), 1};
}

/// Returns the line of a table for an estimate.
std::vector<std::string> line_on(const Estimate& estimate, const Digits& digits) {
  const auto [name, unit] = shown(estimate.parameter);
  const auto number = [&, unit = unit](double value) { return digits(value / unit); };
  if (!estimate.free) return {name, number(estimate.value) + "  given"};
  const auto& [low, high] = estimate.interval;
  const std::string interval = fmt::format("{} to {}", number(low), number(high));
  if (!estimate.determined()) {
    const bool from_below = std::isinf(low) || low == 0, from_above = std::isinf(high);
    const std::string known = from_below && from_above ? ""
                              : from_above             ? fmt::format(": {} or more", number(low))
                              : from_below             ? fmt::format(": {} or less", number(high))
                                                       : ": " + interval;
    return {name, "?", "?", "", "   not determined" + known};
  }
  const bool with_error = !estimate.skewed();
  // The zero of a place and of an angle is arbitrary, and so is a part of it. More than 100 % of a number says nothing.
  using enum Parameter;
  constexpr std::array no_parts{x, y, angle, direction};
  const bool has_parts = std::ranges::find(no_parts, estimate.parameter) == no_parts.end();
  const double percent = 100 * estimate.standard_error / std::abs(estimate.value);
  return {name, number(estimate.value),
          with_error ? Digits{std::min(digits.count, 3)}(estimate.standard_error / unit) : "",
          with_error && has_parts && percent < 100 ? fmt::format("{:.2g} %", percent) : "", "   " + interval};
}

std::string table_of(const fit::Fit& fit, const std::vector<fit::Track>& tracks, const Digits& digits) {
  const auto number = TextTable::right(digits.width());
  TextTable table({TextTable::left(18), number, TextTable::right(12), TextTable::right(12)});
  table.add({"", "value", "+-", "", "   95 % confidence"});
  std::size_t track = tracks.size();
  for (const Estimate& estimate : fit.estimates) {
    if (is_of_start(estimate) && estimate.track != track) {
      track = estimate.track;
      if (tracks.size() > 1) table.add({escaped(tracks[track].name)});
    }
    table.add(line_on(estimate, digits));
  }
  return table.text();
}

std::string noise_of(const fit::Fit& fit, bool planned) {
  std::string text;
  const bool some_given = !std::ranges::all_of(fit.noise, &fit::Noise::estimated);
  if (!planned && some_given && fit.degrees_of_freedom > 0)
    text += fmt::format("reduced chi^2 {:.4g}, {} degrees of freedom\n", fit.reduced_chi2(), fit.degrees_of_freedom);
  TextTable table({TextTable::left(6)});
  for (const fit::Noise& noise : fit.noise) {
    const auto& kind = fit::kind_of(noise.observable);
    table.add({std::string(kind.name),
               fmt::format("{} values, sd {:.3g} {}{}", noise.values, noise.sd, kind.unit,
                           planned           ? ""
                           : noise.estimated ? " (estimated)"
                                             : fmt::format(" (given), residuals {:.3g}", noise.rms))});
  }
  return text + table.text();
}

/// Returns how well a motion that fits describes the film, to follow the first line.
std::string goodness_of(const fit::Fit& fit) {
  if (!fit.widened) return fit.degrees_of_freedom > 0 ? ": fits within the noise" : "";
  double place = 0;
  std::vector<std::string> sizes;
  for (const fit::Noise& noise : fit.noise) {
    if (noise.observable == fit::Observable::x || noise.observable == fit::Observable::y)
      place = std::max(place, noise.rms);
    else if (noise.observable == fit::Observable::angle)
      sizes.push_back(fmt::format("{:.2g} degrees", noise.rms * 180 / std::numbers::pi));
    else
      sizes.push_back(fmt::format("{:.2g} {}", noise.rms, fit::kind_of(noise.observable).unit));
  }
  if (place > 0) sizes.insert(sizes.begin(), fmt::format("{:.2g} mm", 1e3 * place));
  const auto& [varies, least, most] = *fit.widened;
  return fmt::format(
      "\nfits within {}; neighbouring residuals depend on each other, and the errors are {:.2g} to {:.2g} times as wide "
      "as without this (friction that varies by {:.2g} % along the path, errors of the camera)",
      fmt::join(sizes, " and "), least, most, 100 * varies);
}

std::string ranking_of(const std::vector<fit::Fit>& fits) {
  const fit::Fit& best = fits.front();
  TextTable table({TextTable::left(14), TextTable::right(12), TextTable::right(12), TextTable::right(16)});
  table.add({"law", "friction", "patch, mm", "AIC less best"});
  for (const fit::Fit& fit : fits) {
    table.add({fit.law, fmt::format("{:.4g}", fit.estimates[0].value),
               fmt::format("{:.4g}", 1e3 * fit.estimates[1].value), fmt::format("{:.1f}", fit.aic - best.aic)});
  }
  constexpr double hardly = 4;
  return "\n" + table.text() +
         (fits[1].aic - best.aic < hardly ? "these data do not tell the first two apart (by 4 they would)\n"
                                          : fmt::format("{} fits better than all others\n", best.law));
}

/// The fits of all laws, the best first, and the tracks.
struct FitReport {
  const std::vector<fit::Fit>& fits;
  const std::vector<fit::Track>& tracks;
  bool planned;
  const fit::Fit& best = fits.front();
};

constexpr Field<FitReport> answer_fields[]{
    {"law", "", "name of the law of friction that fits best", [](const FitReport& r) -> Json { return r.best.law; },
     ""},
    {"friction", "1", "coefficient of friction",
     [](const FitReport& r) { return members_of_estimate(r.best.estimates[0]); }, "", 0, of_estimate},
    {"patch_radius", "m", "radius of the patch",
     [](const FitReport& r) { return members_of_estimate(r.best.estimates[1]); }, "", 0, of_estimate},
    {"slip", "m/s", "slip at the start of the first film",
     [](const FitReport& r) { return members_of_estimate(r.best.estimate(Parameter::slip)); }, "", 0, of_estimate},
    {"spin", "1/s", "spin at the start of the first film",
     [](const FitReport& r) { return members_of_estimate(r.best.estimate(Parameter::spin)); }, "", 0, of_estimate},
    {"correlation", "", "correlation between the errors of friction and patch_radius",
     [](const FitReport& r) -> Json { return r.best.correlation_of_contact(); }, ""},
    {"reduced_chi2", "",
     "chi squared (sum of squared residuals, each divided by its standard deviation) divided by degrees_of_freedom; 1 "
     "if the noise is estimated",
     [](const FitReport& r) {
       const Json value = reduced_chi2(r.best, r.planned);
       return value.is_null() ? said_null : value;
     },
     ""},
    {"degrees_of_freedom", "", "number of measured values minus number of estimated values",
     [](const FitReport& r) -> Json { return r.best.degrees_of_freedom; }, ""},
    {"profiled", "", "true if the intervals come from the profile likelihood",
     [](const FitReport& r) -> Json { return r.best.profiled; }, ""},
    {"fits", "", "true if this motion can explain the data", [](const FitReport& r) -> Json { return r.best.fits(); },
     ""},
    {"widened", "",
     "null if the motion fits within the noise. Else neighbouring residuals depend on each other, and errors are widened: "
     "standard deviation of the friction along the path, divided by the friction; smallest and largest factor",
     [](const FitReport& r) -> Json {
       if (!r.best.widened) return {};
       return {{"friction_varies", r.best.widened->friction_varies},
               {"least", r.best.widened->least},
               {"most", r.best.widened->most}};
     },
     "", 0, " {`friction_varies`, `least`, `most`}"},
    {"misfits", "", "reasons why this motion cannot explain the data; exit status 1",
     [](const FitReport& r) -> Json { return r.best.misfits; }, ""},
    {"remarks", "", "further remarks, such as outliers",
     [](const FitReport& r) -> Json { return remarks_on(r.best, r.tracks, r.planned); }, ""},
    {"rolling_friction", "1", "coefficient of rolling friction, if the ball has one or if --free names one",
     [](const FitReport& r) {
       return r.best.rolls_with_friction() ? members_of_estimate(r.best.estimate(Parameter::rolling_friction)) : Json();
     },
     "", 0, of_estimate},
    {"only", "",
     "combination of friction and patch radius that the data determine, if they do not determine both. The combination "
     "is a product of powers",
     [](const FitReport& r) -> Json {
       if (!r.best.only) return {};
       const auto& [friction_power, patch_power, value, error, interval] = *r.best.only;
       return {{"name", r.best.only->name()},
               {"friction_power", friction_power},
               {"patch_power", patch_power},
               {"value", value},
               {"standard_error", value * error},
               {"low", interval.low},
               {"high", interval.high}};
     },
     "", 0, " {`name`, `friction_power`, `patch_power`, `value`, `standard_error`, `low`, `high`}"},
    {"tracks", "rad/s",
     "start of the motion in each film: estimates of `slip`, `spin`, `direction`, `vx`, `vy`, `x`, `y`, `angle`, or "
     "`rolling` instead of `vx`, `vy` with rolling friction. `lasts`: seconds from the first picture to the last. "
     "`half_turn_spin`: spin above which a mark turns more than half a turn between two pictures. `other_spins`: other "
     "spins that fit the data equally well",
     [](const FitReport& r) {
       Json list = Json::array();
       for (std::size_t i = 0; i < r.tracks.size(); ++i) {
         Json track{{"file", r.tracks[i].name}, {"start", r.tracks[i].start}, {"lasts", length_of(r.tracks[i])}};
         for (const Estimate& estimate : r.best.estimates) {
           if (is_of_start(estimate) && estimate.track == i)
             track[std::string(name_of(estimate))] = members_of_estimate(estimate);
         }
         const double half_turn_spin = r.best.turns[i].half_turn_spin;
         if (std::isfinite(half_turn_spin)) track["half_turn_spin"] = half_turn_spin;
         const std::vector<double> other_spins = r.best.other_spins(i);
         if (std::isfinite(half_turn_spin) || !other_spins.empty()) track["other_spins"] = other_spins;
         list.push_back(std::move(track));
       }
       return list;
     },
     "", 0, " [{`file`, `start`, `lasts`, `slip`, ...}]"},
    {"noise", "",
     "noise of each column: number of values, root mean square of the residuals, standard deviation. `outliers_at` "
     "[{`file`, `t`}] lists the outliers (s)",
     [](const FitReport& r) {
       Json noise = Json::object();
       for (const auto& [observable, values, rms, sd, estimated, outliers, far, dependent] : r.best.noise) {
         Json places = Json::array();
         for (const auto& [track, t] : outliers) places.push_back({{"file", r.tracks[track].name}, {"t", t}});
         noise[std::string(fit::kind_of(observable).name)] = {
             {"values", values},     {"rms", rms}, {"sd", sd}, {"estimated", estimated}, {"outliers", outliers.size()},
             {"outliers_at", places}};
       }
       return noise;
     },
     "", 0, " {NAME {`values`, `rms`, `sd`, `estimated`, `outliers`, `outliers_at`}}"},
    {"laws", "", "laws of --law, the best first. aic: Akaike information criterion, small for a good law",
     [](const FitReport& r) {
       Json laws = Json::array();
       for (const fit::Fit& fit : r.fits) {
         laws.push_back({{"law", fit.law},
                         {"aic", fit.aic},
                         {"friction", fit.estimates[0].value},
                         {"patch_radius", fit.estimates[1].value},
                         {"reduced_chi2", reduced_chi2(fit, r.planned)}});
       }
       return laws;
     },
     "", 0, " [{`law`, `aic`, `friction`, `patch_radius`, `reduced_chi2`}]"},
};

}  // namespace

Answer answer_of(const std::vector<fit::Fit>& fits, const std::vector<fit::Track>& tracks, bool planned) {
  Answer answer{.members = members_of(answer_fields, {fits, tracks, planned})};
  for (const fit::Fit& fit : fits) {
    for (const Estimate& estimate : fit.estimates) {
      const std::string track = is_of_start(estimate) ? tracks[estimate.track].name : "";
      Json& row = answer.rows.emplace_back(Json{{"law", fit.law}, {"track", track}, {"parameter", name_of(estimate)}});
      row.update(row_of(estimate_fields, estimate));
    }
  }
  return answer;
}

std::string report_on(const std::vector<fit::Fit>& fits, const std::vector<fit::Track>& tracks, bool planned,
                      const Digits& digits) {
  const fit::Fit& best = fits.front();
  std::string lasts;
  for (const fit::Track& track : tracks) {
    if (track.t.size() > 1) lasts += fmt::format("{}{:.4g} s", lasts.empty() ? " in " : ", ", length_of(track));
  }
  std::string text = fmt::format("{}{}: {} {}value{}{}, law {}{}\n", best.ball.ball.name, planned ? " as planned" : "",
                                 best.values, planned ? "" : "measured ", best.values == 1 ? "" : "s", lasts, best.law,
                                 best.fits() && !planned ? goodness_of(best) : "");
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

std::vector<FieldText> fit_fields() {
  return joined({{{"in: `t`", "s", "time of the row"},
                  {"in: `slip`", "m/s", "sliding speed of the contact point"},
                  {"in: `x`, `y`", "m", "place of the centre of the ball"},
                  {"in: `vx`, `vy`", "m/s", "velocity of the centre of the ball"},
                  {"in: `spin`", "rad/s", "spin about the vertical"},
                  {"in: `angle`", "rad", "angle by which the ball has turned about the vertical"},
                  {"in: NAME`_sd`", "as NAME",
                   "standard deviation of the column NAME, in its unit. All other columns are ignored"},
                  {"CSV `law`, `track`, `parameter`", "", "name of the law, of the film and of the estimated number"}},
                 texts_of(estimate_fields),
                 texts_of(answer_fields)});
}

}  // namespace contensou::answers
