#include <string>

#include <fmt/format.h>

#include "contensou/portraits/phase_portrait.hpp"
#include "contensou/reduction/phase_plane.hpp"
#include "options/law_option.hpp"
#include "options/output_options.hpp"
#include "options/portrait_options.hpp"
#include "options/portrait_question.hpp"
#include "options/route_option.hpp"
#include "options/start_options.hpp"
#include "output/output.hpp"
#include "output/picture.hpp"
#include "verb.hpp"
#include "verbs/phase_plane_report.hpp"

namespace contensou::program {

namespace {

class PortraitCommand final : public Verb {
 public:
  void add_options(CLI::App& app) override {
    start_.add(app);
    law_.add(app);
    route_.add(app, {reduction::Route::closed, reduction::Route::quadrature, reduction::Route::regularised});
    options_.add(app);
    app.add_flag(
        "--facts", facts_,
        "print the plane's facts instead: regime, singular points at the origin and at infinity with eigenvalues and "
        "kind, how orbits enter the origin; to standard output unless -o is given");
    output_.add(app);
  }

  ExitStatus run() override {
    const GivenStart start = start_.without_motion() ? GivenStart{start_.read_body(), {}, {}} : start_.read();
    const reduction::ReducedSystem system = start.body.system(law_.read());
    if (facts_) return print_facts(system);
    const Output output = output_.read();
    const reduction::Route route = route_.read(system);
    if (route == reduction::Route::direct) {
      throw BadInput("--route direct: a portrait is drawn by closed, quadrature or regularised");
    }
    PortraitQuestion question{.flow = route == reduction::Route::quadrature ? reduction::Flow::by_quadrature(system)
                                                                            : reduction::Flow(system)};
    if (!start_.without_motion()) {
      question.start = start.state;
      question.shot = start.shot;
    }
    question.request.stepped = route == reduction::Route::regularised;
    options_.read(question.request);
    question.style = options_.style();

    const portraits::PhasePortrait portrait = question.portrait();
    const auto picture = output.picture();
    output.write(picture                  ? drawn(question.figure(portrait), *picture)
                 : output.format == "csv" ? portraits::to_csv(portrait)
                                          : portraits::to_json(portrait));
    return ExitStatus::done;
  }

 private:
  ExitStatus print_facts(const reduction::ReducedSystem& system) const {
    if (!options_.given_names().empty()) {
      throw BadInput(
          fmt::format("--facts and {} exclude each other: facts are of the whole plane, and print no picture",
                      options_.given_names()));
    }
    if (route_.given()) throw BadInput("--facts and --route exclude each other: facts follow no orbit");
    const reduction::PhasePlane plane = reduction::phase_plane(system);
    output_.read(1).write_as([&](int digits) { return phase_plane_as_text(system, plane, digits); },
                             [&] { return phase_plane_as_csv(plane); },
                             [&] { return phase_plane_as_json(system, plane); });
    return ExitStatus::done;
  }

  StartOptions start_;
  LawOption law_;
  RouteOption route_;
  PortraitOptions options_;
  bool facts_ = false;
  OutputOptions output_{{{"a portrait", with_pictures({}, {"csv", "json"}), "svg", "portrait.svg"},
                         {"a table of facts", {"text", "csv", "json"}, "text"}}};
};

const RegisteredVerb<PortraitCommand> registered(
    "portrait", "A phase portrait: orbits, isochrones of the stop time, invariant axes",
    "contensou portrait --mu 0.3 -o portrait.svg");

}  // namespace

}  // namespace contensou::program
