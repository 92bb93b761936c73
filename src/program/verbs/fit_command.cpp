#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "contensou/fit/fit.hpp"
#include "contensou/si/ball_motion.hpp"
#include "contensou/si/run_file.hpp"
#include "input/track_file.hpp"
#include "options/figure_options.hpp"
#include "options/law_option.hpp"
#include "options/output_options.hpp"
#include "options/start_options.hpp"
#include "verb.hpp"
#include "verbs/fit_figure.hpp"

namespace contensou::program {

namespace {

using fit::Estimate;
using fit::Fit;
using fit::Parameter;

constexpr const char* stop = "stop";

/// NAME=SD, ... with units.
NoiseByName parse_noise(const std::string& typed) {
  NoiseByName noise;
  std::vector<std::string> names = observable_names();
  names.emplace_back(stop);
  for (const std::string& each : split(typed, ',')) {
    const std::size_t sign = each.find('=');
    if (sign == std::string::npos) throw NotAllowed("NAME=SD,... is needed, as in slip=0.01,spin=1");
    const std::string name = each.substr(0, sign);
    const auto found = std::ranges::find(names, name);
    if (found == names.end()) throw no_such("observable", name, names);
    const auto place = static_cast<std::size_t>(found - names.begin());
    const std::string_view unit = name == stop ? "s" : fit::observable_kinds()[place].unit;
    const std::string value = each.substr(sign + 1);
    // A plain angle is in radians, which angles elsewhere are not.
    const bool has_unit = !value.empty() && std::isalpha(static_cast<unsigned char>(value.back())) != 0;
    const double sd = unit == "rad" && has_unit ? parse_quantity(value, "deg") * (std::numbers::pi / 180)
                                                : parse_quantity(value, unit);
    if (!(sd > 0)) throw NotAllowed(fmt::format("a standard deviation is > 0, in {}", unit));
    noise[name] = sd;
  }
  return noise;
}

fit::Free parse_free(const std::string& typed) {
  fit::Free free{false, false, false, false};
  const Choices<bool fit::Free::*> choices{{"friction", &fit::Free::friction},
                                           {"patch", &fit::Free::patch_radius},
                                           {"slip", &fit::Free::slip},
                                           {"spin", &fit::Free::spin}};
  for (const std::string& name : split(typed, ',')) free.*one_of(choices, "parameter")(name) = true;
  return free;
}

double parse_positive_time(const std::string& typed) {
  const double time = parse_quantity(typed, "s");
  if (!(time > 0)) throw NotAllowed("a time > 0 is needed, in s");
  return time;
}

Json members_of(const Estimate& estimate) {
  return {{"value", estimate.value},
          {"standard_error", estimate.standard_error},
          {"low", estimate.interval.low},
          {"high", estimate.interval.high}};
}

const std::string_view& name_of(const Estimate& estimate) { return fit::kind_of(estimate.parameter).name; }

bool is_of_start(const Estimate& estimate) { return static_cast<int>(estimate.parameter) >= fit::shared_parameters; }

/// Infinity where there are no degrees of freedom: no format says NaN.
double reduced_chi2(const Fit& fit) { return or_infinity(fit.reduced_chi2()); }

/// The best law's fit, with the others by their criterion.
Answer answer_of(const std::vector<Fit>& fits, const std::vector<fit::Track>& tracks, bool planned) {
  const Fit& best = fits.front();
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
  for (const Fit& fit : fits) {
    members["laws"].push_back({{"law", fit.law},
                               {"aic", fit.aic},
                               {"friction", fit.estimates[0].value},
                               {"patch_radius", fit.estimates[1].value},
                               {"reduced_chi2", planned ? 1 : reduced_chi2(fit)}});
  }
  for (const Fit& fit : fits) {
    for (const Estimate& estimate : fit.estimates) {
      const std::string track = is_of_start(estimate) ? tracks[estimate.track].name : "";
      Json row{{"law", fit.law}, {"track", track}, {"parameter", name_of(estimate)}};
      row.update(members_of(estimate));
      answer.rows.push_back(std::move(row));
    }
  }
  return answer;
}

std::string report(const std::vector<Fit>& fits, const std::vector<fit::Track>& tracks, bool planned,
                   const Digits& digits) {
  const Fit& best = fits.front();
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
  if (best.at_limit) text += "a value ran into what it may be: the patch is not larger than the ball\n";
  if (fits.size() > 1) {
    text += fmt::format("\n{:<14}{:>12}{:>12}{:>16}\n", "law", "friction", "patch mm", "AIC less best");
    for (const Fit& fit : fits) {
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

class FitCommand final : public Verb {
 public:
  void add_options(CLI::App& app) override {
    files_
        .add(
            app, "FILE", "",
            "CSV with t and any of slip, spin, x, y, vx, vy, angle, in SI units (rad) or with a unit, as in 'spin "
            "[rpm]'; NAME_sd is the standard deviation of NAME; - is standard input. Several files: one ball",
            [](const std::string& typed) { return typed; }, true)
        ->expected(1, 1000)
        ->allow_extra_args();
    app.option_defaults()->group("Data");
    from_.add(app, "--from", "TIME",
              "where the motion begins, in seconds; earlier rows are left out (default: the first row)", quantity("s"));
    until_.add(app, "--until", "TIME", "later rows are left out; with --plan the end of the film (default: the stop)",
               quantity("s"));
    noise_.add(app, "--noise", "NAME=SD,...",
               "standard deviations of columns that have none, and of stop (default: estimated)", parse_noise);
    stop_time_.add(app, "--stop-time", "TIME", "measured, in seconds from the start; with --noise stop=SD",
                   parse_positive_time);
    start_.add_ball(app, "radius and gravity, and the values of what is not free");
    law_.add(app, "--law", "LAW,...", "one, or several to rank (default exact). 'contensou help laws' explains them");
    app.option_defaults()->group("Estimate");
    free_.add(app, "--free", "NAMES", "what is to be found, of friction,patch,slip,spin (default: all)", parse_free);
    app.add_flag("--robust", robust_, "Huber's loss: values that are far off count for less");
    app.add_flag("--plan", plan_,
                 "no FILE: the errors that a film with these --fps and --noise would give of the ball");
    fps_.add(app, "--fps", "N", "pictures in a second, for --plan", number);
    figure_.add(app);
    output_.add(app);
  }

  ExitStatus run() override {
    const Output output = output_.read(plan_ ? 1 : 0);
    const std::vector<reduction::Law> laws = law_.read_several(start_.standard_law());
    if (plan_ && laws.size() > 1) law_.argument().reject("--plan is of one law");
    fit::FitRequest request{.ball = start_.read_rolling_ball(laws.front()), .law = laws.front(), .tracks = {}};
    request.robust = robust_;
    request.tracks = plan_ ? planned_tracks(request) : read_tracks();
    const bool only_stop = request.tracks.size() == 1 && request.tracks[0].series.empty();
    request.free = free_.value_or(only_stop ? fit::Free{true, true, false, false} : fit::Free{});
    std::vector<Fit> fits;
    try {
      fits = plan_ ? std::vector{fit::plan(request)} : fit::fit_laws(request, laws);
    } catch (const std::domain_error& error) {
      throw BadInput(fmt::format("{}; a way out may be --noise NAME=SD, --free or a longer film", error.what()));
    }
    if (output.picture()) {
      if (only_stop) throw BadInput("one stop time is no curve to draw: leave out the picture");
      output.write({figure_.apply(fit_figure(fits.front(), request.tracks, figure_.size()), output.format)});
    } else if (output.format == "toml") {
      output.write(si::run_file(fits.front().ball, remark(fits.front())));
    } else {
      Answer answer = answer_of(fits, request.tracks, plan_);
      answer.text = [&](const Digits& digits) { return report(fits, request.tracks, plan_, digits); };
      output.write(answer);
    }
    return ExitStatus::done;
  }

 private:
  static std::string remark(const Fit& fit) {
    return fmt::format("fitted to {} values, law {}: friction +- {:.2g}, patch_radius +- {:.2g} m", fit.values, fit.law,
                       fit.estimates[0].standard_error, fit.estimates[1].standard_error);
  }

  NoiseByName noise() const { return noise_.value_or({}); }

  std::optional<fit::Measured> stop_time() const {
    if (!stop_time_.given()) return std::nullopt;
    const NoiseByName given = noise();
    const auto sd = given.find(stop);
    if (sd == given.end()) stop_time_.reject("its standard deviation is needed: add --noise stop=SD");
    return fit::Measured{*stop_time_, sd->second};
  }

  std::vector<fit::Track> read_tracks() const {
    if (fps_.given()) fps_.reject("it is of a film that is planned: add --plan, or leave it out");
    if (!files_.given() && !stop_time_.given())
      throw BadInput(
          "FILE missing: give a CSV with t and slip, spin, x, y, vx, vy or angle; or --stop-time, or --plan");
    std::vector<fit::Track> tracks;
    if (files_.given()) {
      for (const std::string& file : files_.all())
        tracks.push_back(read_track(file, {noise(), from_.optional(), until_.optional()}));
    } else {
      tracks.push_back({.name = "--stop-time"});
    }
    if (stop_time_.given()) {
      if (tracks.size() > 1) stop_time_.reject("it is of one track, and there are several files");
      tracks.front().stop_time = stop_time();
    }
    return tracks;
  }

  /// Tracks with the times and errors of a film of the ball.
  std::vector<fit::Track> planned_tracks(const fit::FitRequest& request) const {
    if (files_.given()) throw BadInput("--plan is of a film that is not made yet: leave out FILE");
    if (from_.given()) from_.reject("a film that is planned begins with the motion: leave it out");
    std::vector<std::string> missing;
    if (!fps_.given()) missing.emplace_back("--fps N");
    if (!noise_.given()) missing.emplace_back("--noise NAME=SD,... of what is seen");
    if (!missing.empty()) throw BadInput(fmt::format("--plan needs {}", fmt::join(missing, " and ")));
    const double end = until_.given() ? *until_ : si::BallMotion(request.ball, request.law).stop_time();
    const double frames = std::floor(end * *fps_ * (1 + 1e-12)) + 1;
    constexpr double most = 1e7;
    if (!(frames >= 2 && frames <= most))
      fps_.reject(fmt::format("in {:.3g} s that gives {:.3g} pictures; 2 to {:.0g} are allowed", end, frames, most));
    const auto rows = static_cast<Eigen::Index>(frames);
    fit::Track track{.name = "plan", .t = Eigen::ArrayXd::LinSpaced(rows, 0, (frames - 1) / *fps_)};
    for (const fit::ObservableKind& kind : fit::observable_kinds()) {
      if (const NoiseByName given = noise(); given.contains(std::string(kind.name)))
        track.series.push_back({kind.observable, {}, Eigen::ArrayXd::Constant(rows, given.at(std::string(kind.name)))});
    }
    track.stop_time = stop_time();
    return {track};
  }

  ArgumentOf<std::string> files_;
  ArgumentOf<double> from_, until_, stop_time_, fps_;
  ArgumentOf<NoiseByName> noise_;
  ArgumentOf<fit::Free> free_;
  bool robust_ = false, plan_ = false;
  StartOptions start_;
  LawOption law_;
  FigureOptions figure_;
  OutputOptions output_{
      {{"a fit", with_pictures(answer_formats("text"), {"toml"})}, {"a plan", answer_formats("text")}}};
};

const RegisteredVerb<FitCommand> fit_verb("fit", "Friction and patch radius of a ball, from a film of it",
                                          "contensou fit --plan --ball pool --fps 240 --noise slip=0.01,spin=1");

}  // namespace

}  // namespace contensou::program
