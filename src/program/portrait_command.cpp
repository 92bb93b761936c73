#include <optional>
#include <string>

#include <fmt/format.h>

#include "commands.hpp"
#include "contensou/portraits/phase_portrait.hpp"
#include "contensou/portraits/phase_portrait_data.hpp"
#include "contensou/portraits/phase_portrait_figure.hpp"
#include "contensou/reduction/phase_plane.hpp"
#include "contensou/si/bridge.hpp"
#include "law_option.hpp"
#include "output.hpp"
#include "output_options.hpp"
#include "phase_plane_report.hpp"
#include "picture.hpp"
#include "portrait_options.hpp"
#include "route_option.hpp"
#include "start_options.hpp"

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
    const Given given = read_start();
    const reduction::ReducedSystem system = given.body.system(law_.read());
    if (facts_->count() > 0) return print_facts(system);
    if (output_.digits_argument().given()) output_.digits_argument().reject("a picture has no digits: add --facts");
    portraits::PortraitRequest request;
    request.route = route_.read(system);
    if (request.route == reduction::Route::direct) {
      throw BadInput("--route direct: a portrait is drawn by closed, quadrature or regularised");
    }
    request.highlight = given.state;
    options_.read(request);
    const portraits::PortraitStyle style = options_.style();
    if (given.shot) request.time_unit = 1 / si::seconds(*given.shot, 1);

    const Argument& file = output_.file_argument();
    const std::string path = file.given() ? file.text() : standard_file;
    const std::string format = read_format(path);
    const auto picture = portraits::find_picture_format(format);
    if (!picture && format != "csv" && format != "json") {
      throw BadInput(
          fmt::format("-o {}: a portrait is written as one of {}; '{}' is none of them", path, endings, format));
    }
    const portraits::PhasePortrait portrait = portraits::phase_portrait(system, request);
    if (picture) {
      write_output(path, drawn(portraits::draw(portrait, caption(given, portrait), style), *picture));
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

  struct Given {
    GivenBody body;
    std::optional<reduction::State> state;
    std::optional<si::Shot> shot;
  };

  Given read_start() const {
    if (start_.without_motion()) return {start_.read_body(), std::nullopt, std::nullopt};
    const GivenStart start = start_.read();
    return {start.body, start.state, start.shot};
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

  static portraits::PortraitCaption caption(const Given& given, const portraits::PhasePortrait& portrait) {
    const reduction::ReducedSystem& system = portrait.system;
    portraits::PortraitCaption caption;
    if (!given.state) return caption;
    const double stop = reduction::stop_time(system, *given.state).tau;
    caption.highlight = "this motion";
    if (!given.shot) {
      caption.subtitle =
          fmt::format("u_0 = {:g}, v_0 = {:g}: it stops after τ* = {:.4g}", given.state->u, given.state->v, stop);
      return caption;
    }
    const si::Shot& shot = *given.shot;
    std::string law = portraits::literal(system.law().name());
    for (const auto& rival : portrait.against) law += " against " + portraits::literal(rival.system.law().name());
    caption.title =
        fmt::format("{},  {{/:Italic μ}} = {:.4g},  law: {}", portraits::literal(shot.ball.name), system.mu(), law);
    caption.subtitle = fmt::format("slip {:g} m/s, spin {:g} rad/s: it stops after {:.3g} s", si::slip_at_start(shot),
                                   si::spin_at_start(shot), si::seconds(shot, stop));
    caption.speed_unit = "m/s";
    caption.time_symbol = "{/:Italic t}*";
    caption.time_unit_name = "s";
    caption.time_unit = 1 / si::seconds(shot, 1);
    caption.highlight = "this ball";
    return caption;
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
