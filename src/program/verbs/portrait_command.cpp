#include <string>

#include <fmt/format.h>

#include "commands.hpp"
#include "contensou/portraits/phase_portrait.hpp"
#include "contensou/portraits/phase_portrait_data.hpp"
#include "contensou/reduction/phase_plane.hpp"
#include "options/law_option.hpp"
#include "options/output_options.hpp"
#include "options/portrait_options.hpp"
#include "options/portrait_question.hpp"
#include "options/route_option.hpp"
#include "options/start_options.hpp"
#include "output/output.hpp"
#include "output/picture.hpp"
#include "verbs/phase_plane_report.hpp"

namespace contensou::program {

namespace {

constexpr const char* standard_file = "portrait.svg";
constexpr const char* endings = "svg, pdf, png, eps, gp, tex, csv, json";

class PortraitCommand final : public Command {
 public:
  std::string name() const override { return "portrait"; }
  std::string summary() const override {
    return "A phase portrait: orbits, isochrones of the stop time, invariant axes";
  }
  std::string example() const override { return "contensou portrait --mu 0.3 -o portrait.svg"; }

  void add_options(CLI::App& app) override {
    start_.add(app);
    law_.add(app);
    route_.add(app, {reduction::Route::closed, reduction::Route::quadrature, reduction::Route::regularised});
    options_.add(app);
    facts_ = app.add_flag("--facts");
    facts_->description(
        "print the plane's facts instead: regime, singular points at the origin and at infinity with eigenvalues and "
        "kind, how orbits enter the origin; to standard output unless -o is given");
    output_.add(
        app,
        fmt::format("write to FILE (default {}), whole or not at all; its ending is one of {}", standard_file, endings),
        fmt::format("instead of the ending, as with -o -: {}; with --facts: text, csv, json", endings));
  }

  ExitStatus run() override {
    PortraitQuestion question = read_start();
    const reduction::ReducedSystem system = question.system();
    if (facts_->count() > 0) return print_facts(system);
    if (output_.digits_argument().given()) output_.digits_argument().reject("a picture has no digits: add --facts");
    question.request.route = route_.read(system);
    if (question.request.route == reduction::Route::direct) {
      throw BadInput("--route direct: a portrait is drawn by closed, quadrature or regularised");
    }
    options_.read(question.request);
    question.style = options_.style();

    const Argument& file = output_.file_argument();
    const std::string path = file.given() ? file.text() : standard_file;
    const std::string format = read_format(path);
    const auto picture = portraits::find_picture_format(format);
    if (!picture && format != "csv" && format != "json") {
      throw BadInput(
          fmt::format("-o {}: a portrait is written as one of {}; '{}' is none of them", path, endings, format));
    }
    const portraits::PhasePortrait portrait = question.portrait();
    if (picture) {
      write_output(path, drawn(question.figure(portrait), *picture));
    } else {
      write_output(path, format == "csv" ? portraits::to_csv(portrait) : portraits::to_json(portrait));
    }
    return ExitStatus::done;
  }

 private:
  ExitStatus print_facts(const reduction::ReducedSystem& system) const {
    if (!options_.given_names().empty()) {
      throw BadInput(
          fmt::format("--facts and {} exclude each other: facts are of the whole plane, and print no picture",
                      options_.given_names()));
    }
    if (route_.named()) throw BadInput("--facts and --route exclude each other: facts follow no orbit");
    const reduction::PhasePlane plane = reduction::phase_plane(system);
    output_.write_as(
        output_.format(), [&](int digits) { return phase_plane_as_text(system, plane, digits); },
        [&] { return phase_plane_as_csv(plane); }, [&] { return phase_plane_as_json(system, plane); });
    return ExitStatus::done;
  }

  PortraitQuestion read_start() const {
    if (start_.without_motion()) {
      const GivenBody body = start_.read_body();
      return {.law = law_.read(), .mu = body.mu, .inertia = body.inertia};
    }
    const GivenStart start = start_.read();
    return {.law = law_.read(),
            .mu = start.body.mu,
            .inertia = start.body.inertia,
            .start = start.state,
            .shot = start.shot};
  }

  std::string read_format(const std::string& path) const {
    const Argument& format = output_.format_argument();
    const std::string by_ending = ending(path);
    if (!format.given()) return path == "-" ? "svg" : by_ending;
    const bool ending_is_format =
        portraits::find_picture_format(by_ending) || by_ending == "csv" || by_ending == "json";
    if (ending_is_format && by_ending != format.text()) {
      format.reject(fmt::format("the file {} says otherwise: leave out one of them", path));
    }
    return format.text();
  }

  StartOptions start_;
  LawOption law_;
  RouteOption route_;
  PortraitOptions options_;
  CLI::Option* facts_ = nullptr;
  OutputOptions output_{Format::text};
};

}  // namespace

std::unique_ptr<Command> make_portrait_command() { return std::make_unique<PortraitCommand>(); }

}  // namespace contensou::program
