#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "answers/asked/formula_law.hpp"
#include "answers/figures/figures.hpp"
#include "answers/input/formulas.hpp"
#include "answers/input/track_file.hpp"
#include "answers/verbs/fit_answer.hpp"
#include "contensou/fit/fit.hpp"
#include "contensou/si/motion.hpp"
#include "contensou/si/run_file.hpp"
#include "contensou/si/scaling.hpp"
#include "options/law_option.hpp"
#include "options/output_options.hpp"
#include "options/start_options.hpp"
#include "verb.hpp"

namespace contensou::program {

namespace {

using fit::Fit;

constexpr const char* stop = "stop";
constexpr const char* slide = "distance";
constexpr const si::Quantity* of_patch[]{&si::patch_radius, &si::spin_deceleration, &si::youngs_modulus};

/// Reads "NAME=SD, ...", where SD may have a unit.
NoiseByName parse_noise(const std::string& typed) {
  NoiseByName noise;
  std::vector<std::string> names = observable_names();
  names.insert(names.end(), {stop, slide});
  for (const std::string& each : split(typed, ',')) {
    const std::size_t sign = each.find('=');
    if (sign == std::string::npos) throw NotAllowed("NAME=SD,... is needed, as in slip=0.01,spin=1");
    const std::string typed_name = each.substr(0, sign);
    const std::string known = observable_name(typed_name);
    const std::string& name = std::ranges::count(names, known) > 0 ? known : typed_name;
    const auto found = std::ranges::find(names, name);
    if (found == names.end()) throw NotAllowed(no_such("observable", name, names, false));
    const auto place = static_cast<std::size_t>(found - names.begin());
    const std::string_view unit = name == stop ? "s" : name == slide ? "m" : fit::observable_kinds()[place].unit;
    const std::string value = each.substr(sign + 1);
    // An angle without a unit is in radians here, in contrast to angles of other options.
    const bool has_unit =
        !value.empty() && !is_constant(value) && std::isalpha(static_cast<unsigned char>(value.back()));
    const double sd = unit == "rad" && has_unit ? parse_quantity(value, "deg") * (std::numbers::pi / 180)
                                                : parse_quantity(value, unit);
    if (!(sd > 0)) throw NotAllowed("a standard deviation is > 0, in {}", unit);
    if (!noise.emplace(name, sd).second) throw NotAllowed("{} is given twice; once is allowed", name);
  }
  return noise;
}

fit::Free parse_free(const std::string& typed) {
  fit::Free free{false, false, false, false, false};
  const Choices<bool fit::Free::*> choices{{"friction", &fit::Free::friction},
                                           {"patch", &fit::Free::patch_radius},
                                           {"rolling_friction", &fit::Free::rolling_friction},
                                           {"slip", &fit::Free::slip},
                                           {"spin", &fit::Free::spin}};
  for (const std::string& name : split(typed, ',')) free.*one_of(choices, "parameter")(name) = true;
  return free;
}

class FitCommand final : public Verb {
 public:
  void add_options(CLI::App& app) override {
    files_
        .add(
            app, "FILE", "",
            "table measured on a film, as CSV or text with tabs or semicolons; - is standard input. Columns: t, or frame with --fps; "
            "and any of slip, spin (or wz), x, y, vx, vy, angle (or theta), in SI units or as 'spin [rpm]'. A column "
            "NAME_sd contains the standard deviation of NAME. Several files are films of one ball",
            [](const std::string& typed) { return typed; }, true)
        ->expected(1, -1)
        ->allow_extra_args();
    app.option_defaults()->group("Data");
    from_.add(app, "--from", "TIME", "first instant that is used, in seconds (default: the first row)", quantity("s"));
    until_.add(app, "--until", "TIME",
               "last instant that is used, in seconds (default: the last row; with --plan: the stop)", quantity("s"));
    noise_.add(app, "--noise", "NAME=SD,...",
               "standard deviations of columns; stop=SD belongs to --stop-time (default: estimated from the deviations "
               "between data and motion)",
               parse_noise);
    stop_time_.add(app, "--stop-time", "TIME",
                   "measured end of slip and spin, in seconds after the start; needs --noise stop=SD",
                   checked(quantity("s"), is_positive, "a time > 0 is needed, in s"));
    distance_.add(
        app, "--distance", "LENGTH",
        "measured distance from the start to the place where slip and spin end; gives the friction, without "
        "FILE; the spin is 0 unless --spin is given. Its standard deviation is --noise distance=SD (default: 1 % of it)",
        checked(quantity("m"), is_positive, "a length > 0 is needed, in m"));
    pixel_.add(app, "--pixel", "LENGTH", "length that one pixel shows, for columns such as 'x [px]'",
               checked(quantity("m"), is_positive, "a length > 0 is needed, in m"));
    start_.take_radius_for_ball();
    start_.add_ball(app, "real ball with the values that are not fitted; with --radius no ball is needed");
    law_.add_several(
        app, "LAW,...",
        "law of friction, or several laws to compare (default exact); 'contensou help laws' lists all laws");
    app.option_defaults()->group("Estimate");
    free_.add(app, "--free", "NAMES",
              "numbers to find: any of friction,patch,rolling_friction,slip,spin (default: all that the body has; the "
              "patch of a disc or ring only if the film shows a smaller one)",
              parse_free);
    robust_.add(app, "--robust", "give outliers less weight, by Huber's loss");
    plan_.add(app, "--plan", "predict the standard errors that a film with --fps and --noise would give; without FILE");
    fps_.add(app, "--fps", "N", "pictures per second of the film, for --plan and for a column frame",
             checked(number, is_positive, "pictures in a second > 0 are needed"));
    plan_.excludes({&files_, &from_, &pixel_},
                   "a planned film has no table yet, begins with the motion, and has its noise in SI units");
    distance_.excludes({&files_, &stop_time_, &plan_, &from_, &until_, &fps_, &pixel_},
                       "a distance alone gives the friction");
    output_.add(app);
  }

  ExitStatus run() override {
    const Output output = output_.read(plan_ ? 1 : 0);
    const std::vector<reduction::Law> laws = law_.read_several(start_.standard_law());
    if (plan_ && laws.size() > 1) law_.argument().reject("--plan takes one law");
    for (const reduction::Law& law : laws) {
      if (output.format == "toml" && !find_law_or_formulas(law.name()))
        law_.argument().reject(
            fmt::format("a run file has a law by its name or its formulas, and {} is neither: leave one "
                        "of the two out, or take --format text or json",
                        law.name()));
    }
    fit::FitRequest request{.ball = start_.read_ball(laws.front()), .law = laws.front(), .tracks = {}};
    if (const double slope = request.ball.environment.slope; slope != 0)
      throw BadInput(
          "fit needs a level plane, and this one has a slope of {} degrees; --slope 0 "
          "leaves it out",
          slope);
    // The spin of a built-in ball is an example, and no part of a measured distance.
    if (distance_.given() && start_.given_values().find(si::spin) == nullptr)
      request.ball.start = si::SlipAndSpin{si::slip_at_start(request.ball), 0};
    request.robust = robust_;
    request.tracks = plan_               ? planned_tracks(request)
                     : distance_.given() ? std::vector{slide_of(request)}
                                         : read_tracks();
    const bool only_stop = request.tracks.size() == 1 && request.tracks[0].series.empty();
    fit::Free usual = fit::usually_free(request.ball);
    if (only_stop) usual.slip = usual.spin = false;
    if (distance_.given()) usual.patch_radius = false;
    request.free = free_.value_or(usual);
    Progress progress("searches", progress_if_watched(output.path));
    request.each_search = [&progress, searches = 0.0]() mutable { progress.show(++searches, NAN); };
    std::vector<Fit> fits;
    try {
      fits = plan_ ? std::vector{fit::plan(request)} : fit::fit_laws(request, laws);
    } catch (const std::domain_error& error) {
      throw BadInput("{}; a way out may be --noise NAME=SD, --free or a longer film", error.what());
    }
    progress.erase();
    if (output.picture) {
      if (only_stop) throw BadInput("one stop time is no curve to draw: leave out the picture");
      output_.write({fit_figure(fits.front(), laws, request.tracks, output_.size())}, output);
    } else if (output.format == "toml") {
      Fit& fitted = fits.front();
      if (is_formula_law(fitted.law)) fitted.ball.contact.law = fitted.law;
      output.write(si::run_file(fitted.ball, remark(fitted)));
    } else {
      Answer answer = answer_of(fits, request.tracks, plan_);
      answer.text = [&](const Digits& digits) { return report_on(fits, request.tracks, plan_, digits); };
      output.write(answer);
    }
    const Fit& best = fits.front();
    if (best.fits()) return ExitStatus::done;
    fmt::print(stderr, "contensou: this does not fit: {}\n", fmt::join(best.misfits, "; "));
    return ExitStatus::check_failed;
  }

 private:
  static std::string remark(const Fit& fit) {
    const auto error = [](const fit::Estimate& estimate, const char* unit) {
      const std::string_view name = fit::kind_of(estimate.parameter).name;
      return !estimate.free          ? fmt::format("{} given", name)
             : estimate.determined() ? fmt::format("{} +- {:.2g}{}", name, estimate.standard_error, unit)
                                     : fmt::format("{} not determined", name);
    };
    std::string text = fmt::format("fitted to {} values, law {}: {}, {}", fit.values, fit.law,
                                   error(fit.estimates[0], ""), error(fit.estimates[1], " m"));
    if (fit.rolls_with_friction()) text += ", " + error(fit.estimate(fit::Parameter::rolling_friction), "");
    if (fit.ball.spreads.empty()) text += "\nno [uncertainty]: no standard deviations tell what is known of them";
    if (!fit.fits()) text += fmt::format("\nTHIS DOES NOT FIT: {}", fmt::join(fit.misfits, "; "));
    return text;
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
    if (!files_.given() && !stop_time_.given())
      throw BadInput(
          "FILE missing: give a CSV with t and slip, spin, x, y, vx, vy or angle; or --stop-time, or --plan");
    std::vector<fit::Track> tracks;
    Unused unused{noise(), fps_.given(), pixel_.given()};
    if (stop_time_.given()) unused.noise.erase(stop);
    if (files_.given()) {
      const auto note = [](const std::string& text) { fmt::print(stderr, "contensou: {}\n", text); };
      for (const std::string& file : files_.all()) {
        CsvReader table(file, CsvReader::Separator::any);
        tracks.push_back(read_track(table, file,
                                    {noise(), from_.optional(), until_.optional(), fps_.optional(), pixel_.optional()},
                                    note, &unused));
      }
    } else {
      tracks.push_back({.name = "--stop-time"});
    }
    if (unused.fps) fps_.reject("no file has a column frame and no t: leave it out, or give one; --plan takes it, too");
    if (unused.pixel) pixel_.reject("no file has columns in px or px/s, as 'x [px]': leave it out, or name them so");
    if (!unused.noise.empty()) {
      const std::string& name = unused.noise.begin()->first;
      noise_.reject(name == stop
                        ? "stop is the noise of --stop-time, which is not given"
                        : fmt::format("no file has a column {0} without standard deviations of its own", name));
    }
    if (stop_time_.given()) {
      if (tracks.size() > 1) stop_time_.reject("one stop time fits one file, and there are several");
      tracks.front().stop_time = stop_time();
    }
    return tracks;
  }

  /// Returns the stop time that belongs to the measured distance. Friction changes only the scale of time, and of
  /// lengths by the same factor, so that distance and stop time stay proportional.
  fit::Track slide_of(const fit::FitRequest& request) const {
    if (request.ball.contact.rolling_friction > 0)
      distance_.reject("with rolling friction a distance does not give the friction; add --rolling-friction 0");
    const si::Motion motion = si::Motion::reduced(request.ball, request.law);
    const double time = motion.stop_time(), length = motion.at(time).position.norm();
    if (!(length > 0)) distance_.reject("the body slides at the start: add --slip V");
    NoiseByName given = noise();
    constexpr double usual = 0.01;
    const auto sd = given.extract(slide);
    if (!given.empty()) noise_.reject("only distance=SD goes with --distance");
    if (sd.empty())
      fmt::print(stderr, "contensou: the distance is taken as known to 1 %; --noise distance=SD changes this\n");
    const double in_time = time / length;
    return {
        .name = "--distance",
        .stop_time = fit::Measured{*distance_ * in_time, in_time * (sd.empty() ? usual * *distance_ : sd.mapped())}};
  }

  /// Returns tracks with the times and the standard deviations of a planned film of the ball.
  std::vector<fit::Track> planned_tracks(const fit::FitRequest& request) const {
    std::vector<std::string> missing;
    if (!fps_.given()) missing.emplace_back("--fps N");
    if (!noise_.given()) missing.emplace_back("--noise NAME=SD,... of what is seen");
    const si::Description values = start_.given_values();
    if (!start_.ball_given() && values.find(si::friction) == nullptr) missing.emplace_back("--friction F");
    const auto is_given = [&](const si::Quantity* quantity) { return values.find(*quantity) != nullptr; };
    if (!start_.ball_given() && std::ranges::none_of(of_patch, is_given)) missing.emplace_back("--patch-radius LENGTH");
    if (si::slip_at_start(request.ball) == 0 && si::spin_at_start(request.ball) == 0)
      missing.emplace_back("a start, --slip V, --spin W or both");
    if (!missing.empty()) throw BadInput("--plan needs {}", fmt::join(missing, " and "));
    const double end = until_.given() ? *until_ : si::Motion::reduced(request.ball, request.law).stop_time();
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
  ArgumentOf<double> from_, until_, stop_time_, distance_, fps_, pixel_;
  ArgumentOf<NoiseByName> noise_;
  ArgumentOf<fit::Free> free_;
  Flag robust_, plan_;
  StartOptions start_;
  LawOption law_;
  PictureOptions output_{
      {{"a fit", with_pictures(answer_formats("text"), {"toml"})}, {"a plan", answer_formats("text")}}};
};

const RegisteredVerb<FitCommand> fit_verb(Purpose::bodies, "fit", "Fit friction and patch radius to a film of a ball",
                                          "contensou fit --plan --ball pool --fps 240 --noise slip=0.01,spin=1",
                                          {{"", fit_fields}}, {"slip", "spin", "stop", "patch", "law"});

}  // namespace

}  // namespace contensou::program
