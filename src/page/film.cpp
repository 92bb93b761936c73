// The page reads a film (a table) of a reader and finds friction and patch of the ball, like `contensou fit`.
#include <string>
#include <vector>

#include <emscripten/bind.h>

#include "answers/figures/figures.hpp"
#include "answers/input/csv.hpp"
#include "answers/input/track_file.hpp"
#include "answers/verbs/fit_answer.hpp"
#include "contensou/fit/fit.hpp"
#include "contensou/si/experiment.hpp"
#include "page/javascript.hpp"

namespace contensou::page {

namespace {

/// Returns the fit of the best law: {report, notes about columns that are not read, law, friction, patch, start
/// (start_value), measured: {t, and for each observable of the film its column, and with _fitted the column of the
/// fitted motion}, figure of `contensou fit`}.
/// @param laws  list of names of laws
val fit(const std::string& text, const std::string& name, const val& ball, const val& laws) {
  si::Experiment experiment = experiment_of(ball);
  experiment.ball.name = ball["title"].as<std::string>();
  std::vector<reduction::Law> tried;
  for (const auto& law : emscripten::vecFromJSArray<std::string>(laws)) tried.push_back(law_of(law));
  answers::CsvReader table(text, name);
  std::string notes;
  fit::FitRequest request{
      .ball = experiment, .law = tried.front(), .tracks = {}, .free = fit::usually_free(experiment)};
  request.tracks.push_back(
      answers::read_track(table, name, {}, [&](const std::string& note) { notes += note + "\n"; }));
  const std::vector<fit::Fit> fits = fit::fit_laws(request, tried);
  const fit::Track& track = request.tracks.front();
  val measured = object("t", Eigen::ArrayXd(track.t - track.start));
  for (std::size_t i = 0; i < track.series.size(); ++i) {
    const std::string name(fit::kind_of(track.series[i].observable).name);
    measured.set(name, column(track.series[i].value));
    measured.set(name + "_fitted", column(fits.front().predicted.front()[i]));
  }
  const auto value = [&](fit::Parameter parameter) { return fits.front().estimate(parameter).value; };
  return object("notes", notes, "report", answers::report_on(fits, request.tracks, false, {6}), "law", fits.front().law,
                "friction", value(fit::Parameter::friction), "patch", value(fit::Parameter::patch_radius), "start",
                start_value(fits.front().ball), "measured", measured, "figure",
                figure_value(answers::fit_figure(fits.front(), tried, request.tracks, {.width_mm = 120})));
}

}  // namespace

}  // namespace contensou::page

EMSCRIPTEN_BINDINGS(film) { emscripten::function("fit", contensou::page::answering<contensou::page::fit>); }
