#include <string>

#include <fmt/format.h>

#include "contensou/portraits/stop_time_map.hpp"
#include "options/body_option.hpp"
#include "options/law_option.hpp"
#include "options/output_options.hpp"
#include "options/thread_option.hpp"
#include "output/output.hpp"
#include "output/picture.hpp"
#include "output/progress.hpp"
#include "verb.hpp"
#include "verbs/stop_times.hpp"
#include "verbs/sweep.hpp"

namespace contensou::program {

namespace {

class SweepCommand final : public Verb {
 public:
  void add_options(CLI::App& app) override {
    mu_.add(app, "--mu", "M|MIN:MAX:N", "patch ratio, 0 < M <= 1, or N values of it");
    u0_.add(app, "--u0", "MIN:MAX:N", "N values of the pivoting R omega_z at the start, MIN and MAX among them");
    v0_.add(app, "--v0", "MIN:MAX:N", "N values of the sliding speed at the start, MIN >= 0");
    app.add_flag("--log", log_, "values in equal ratios instead of equal steps; MIN > 0");
    law_.add(app);
    body_.add(app);
    threads_.add(app);
    progress_.add(app);
    output_.add(app);
  }

  ExitStatus run() override {
    const Body body = body_.read();
    const SweepGrid grid = read_grid(body);
    const Output out = output_.read();
    const reduction::Law law = law_.read();
    const int threads = threads_.read();
    const bool progress = progress_.read(out.path);
    if (const auto picture = out.picture()) {
      for (const Argument* argument : {&threads_.argument(), &progress_.argument()}) {
        if (argument->given()) argument->reject("is for npy and csv: a picture is of few starts, leave it out");
      }
      out.write(drawn(portraits::draw(make_map(reduction::ReducedSystem(law, grid.mu.least(), body.inertia), grid)),
                      *picture));
      return ExitStatus::done;
    }
    OutputFile output(out.path);
    sweep({.law = law,
           .body = body.inertia,
           .grid = grid,
           .format = out.format == "npy" ? SweepFormat::npy : SweepFormat::csv,
           .threads = threads,
           .progress = progress},
          output);
    output.finish();
    return ExitStatus::done;
  }

 private:
  static Range read_range(const Argument& argument, Steps steps) {
    if (!argument.given()) {
      throw BadInput(fmt::format("{} missing: a sweep is --mu M --u0 MIN:MAX:N --v0 MIN:MAX:N", argument.name()));
    }
    try {
      return parse_range(argument.text(), steps);
    } catch (const BadInput& error) {
      argument.reject(error.what());
    }
  }

  double read_patch_ratio(const Body& body) const {
    if (mu_.given()) return read_range(mu_, Steps::linear).least();
    if (body.patch_ratio) return *body.patch_ratio;
    throw BadInput("--mu missing: give --mu M or MIN:MAX:N, or a --body that lies flat, disc or ring");
  }

  SweepGrid read_grid(const Body& body) const {
    const Steps steps = log_ ? Steps::logarithmic : Steps::linear;
    const bool mu_is_range = mu_.given() && mu_.text().find(':') != std::string::npos;
    const SweepGrid grid{.mu = mu_is_range ? read_range(mu_, steps) : Range(read_patch_ratio(body)),
                         .mu_is_range = mu_is_range,
                         .u0 = read_range(u0_, steps),
                         .v0 = read_range(v0_, steps)};
    for (double mu : {grid.mu.least(), grid.mu.most()}) {
      if (const std::string wrong = body.complaint(mu); !wrong.empty()) mu_.reject(wrong);
    }
    if (grid.v0.least() < 0) v0_.reject("a sliding speed is >= 0; turn the axes so that the ball slides along x");
    return grid;
  }

  portraits::StopTimeMap make_map(const reduction::ReducedSystem& system, const SweepGrid& grid) const {
    constexpr double most_points = 1e6;
    if (grid.mu_is_range) mu_.reject("a picture shows one mu: give --mu M, or write npy or csv");
    if (grid.u0.count() < 2) u0_.reject("a picture needs a range, MIN:MAX:N");
    if (grid.v0.count() < 2) v0_.reject("a picture needs a range, MIN:MAX:N");
    if (grid.points() > most_points) {
      throw BadInput(fmt::format("a picture shows at most {:g} starts, not {:g}: reduce N, or write npy or csv",
                                 most_points, grid.points()));
    }
    const auto values = [](const Range& range) {
      Eigen::ArrayXd array(range.count());
      for (long i = 0; i < range.count(); ++i) array[i] = range[i];
      return array;
    };
    const reduction::Flow flow(system);
    tell_if_not_proved(flow.table());
    return portraits::stop_time_map(flow, {values(grid.u0), values(grid.v0), log_});
  }

  Argument mu_, u0_, v0_;
  bool log_ = false;
  LawOption law_;
  BodyOption body_;
  ThreadOption threads_;
  ProgressOption progress_;
  OutputOptions output_{{{"a sweep", {"npy", "csv", "svg", "pdf", "png", "eps", "gp"}, "csv"}}};
};

const RegisteredVerb<SweepCommand> registered("sweep",
                                              "A map of stop times over starts, of any size: numbers or a picture",
                                              "contensou sweep --mu 0.1 --u0 0:2:201 --v0 0:2:201 -o map.npy");

}  // namespace

}  // namespace contensou::program
