#include <limits>
#include <string>

#include <fmt/format.h>

#include "contensou/portraits/stop_time_map.hpp"
#include "options/bulk_options.hpp"
#include "options/law_option.hpp"
#include "options/output_options.hpp"
#include "options/start_options.hpp"
#include "verb.hpp"
#include "verbs/stop_times.hpp"
#include "verbs/sweep.hpp"

namespace contensou::program {

namespace {

/// MIN:MAX:N, or a number alone.
Range parse_range(const std::string& typed) {
  const std::size_t first = typed.find(':');
  if (first == std::string::npos) return {.least = parse_number(typed), .most = parse_number(typed)};
  const std::size_t second = typed.find(':', first + 1);
  if (second == std::string::npos || typed.find(':', second + 1) != std::string::npos) {
    throw BadInput(fmt::format("{} is not a range; write it MIN:MAX:N, as in 0:2:201", quotation(typed)));
  }
  const Range range{.least = parse_number(typed.substr(0, first)),
                    .most = parse_number(typed.substr(first + 1, second - first - 1)),
                    .count = parse_integer(typed.substr(second + 1), 1, std::numeric_limits<long>::max())};
  const auto& [least, most, count, in_ratios] = range;
  if (least > most) throw BadInput(fmt::format("MIN = {} exceeds MAX = {}: put the smaller one first", least, most));
  if (count == 1 && least != most) {
    throw BadInput(fmt::format("one value cannot be both MIN = {} and MAX = {}: give N = 2 or more", least, most));
  }
  if (count > 1 && least == most) {
    throw BadInput(
        fmt::format("all {} values would be {}: give different MIN and MAX, or the number alone", count, least));
  }
  return range;
}

class SweepCommand final : public Verb {
 public:
  void add_options(CLI::App& app) override {
    const auto read = [](const std::string& typed) {
      try {
        return parse_range(typed);
      } catch (const BadInput& error) {
        throw NotAllowed(error.what());
      }
    };
    mu_.add(app, "--mu", "M|MIN:MAX:N", "patch ratio, 0 < M <= 1, or N values of it", read);
    u0_.add(app, "--u0", "MIN:MAX:N", "N values of the pivoting R omega_z at the start, MIN and MAX among them", read);
    v0_.add(app, "--v0", "MIN:MAX:N", "N values of the sliding speed at the start, MIN >= 0", read);
    app.add_flag("--log", log_, "values in equal ratios instead of equal steps; MIN > 0");
    law_.add(app);
    body_.add_body(app);
    bulk_.add(app);
    output_.add(app);
  }

  ExitStatus run() override {
    const Body body = body_.body();
    const SweepGrid grid = read_grid(body);
    const Output out = output_.read();
    const reduction::Law law = law_.read();
    if (out.picture()) {
      bulk_.refuse("npy and csv: a picture is of few starts, leave it out");
      out.write(portraits::draw(make_map(reduction::ReducedSystem(law, grid.mu.least, body.inertia), grid)));
      return ExitStatus::done;
    }
    OutputFile output(out.path);
    sweep({.law = law,
           .body = body.inertia,
           .grid = grid,
           .format = out.format == "npy" ? SweepFormat::npy : SweepFormat::csv,
           .threads = bulk_.threads(),
           .progress = bulk_.progress(out.path)},
          output);
    output.finish();
    return ExitStatus::done;
  }

 private:
  Range range_of(const ArgumentOf<Range>& argument) const {
    if (!argument.given()) {
      throw BadInput(fmt::format("{} missing: a sweep is --mu M --u0 MIN:MAX:N --v0 MIN:MAX:N", argument.name()));
    }
    Range range = *argument;
    range.in_ratios = log_;
    if (log_ && range.count > 1 && !(range.least > 0)) {
      argument.reject(
          fmt::format("logarithmic steps need MIN > 0, got {}: raise MIN, or leave --log out", range.least));
    }
    return range;
  }

  SweepGrid read_grid(const Body& body) const {
    if (!mu_.given() && !body.patch_ratio) {
      throw BadInput("--mu missing: give --mu M or MIN:MAX:N, or a --body that lies flat, disc or ring");
    }
    const SweepGrid grid{.mu = mu_.given() ? range_of(mu_) : Range{*body.patch_ratio, *body.patch_ratio},
                         .mu_is_range = mu_.given() && mu_.text().find(':') != std::string::npos,
                         .u0 = range_of(u0_),
                         .v0 = range_of(v0_)};
    for (double mu : {grid.mu.least, grid.mu.most}) {
      if (const std::string wrong = body.complaint(mu); !wrong.empty()) mu_.reject(wrong);
    }
    if (grid.v0.least < 0) v0_.reject("a sliding speed is >= 0; turn the axes so that the ball slides along x");
    return grid;
  }

  portraits::StopTimeMap make_map(const reduction::ReducedSystem& system, const SweepGrid& grid) const {
    constexpr double max_points = 1e6;
    if (grid.mu_is_range) mu_.reject("a picture shows one mu: give --mu M, or write npy or csv");
    for (const auto* axis : {&u0_, &v0_}) {
      if ((*axis)->count < 2) axis->reject("a picture needs a range, MIN:MAX:N");
    }
    if (grid.points() > max_points) {
      throw BadInput(fmt::format("a picture shows at most {:g} starts, not {:g}: reduce N, or write npy or csv",
                                 max_points, grid.points()));
    }
    const auto values = [](const Range& range) -> Eigen::ArrayXd {
      return Eigen::ArrayXd::NullaryExpr(range.count, [&](Eigen::Index i) { return range[i]; });
    };
    const reduction::Flow flow(system);
    tell_if_not_proved(flow.table());
    return portraits::stop_time_map(flow, {values(grid.u0), values(grid.v0), log_});
  }

  ArgumentOf<Range> mu_, u0_, v0_;
  bool log_ = false;
  LawOption law_;
  BodyOptions body_;
  BulkOptions bulk_;
  OutputOptions output_{{{"a sweep", {"npy", "csv", "svg", "pdf", "png", "eps", "gp"}, "-", "csv"}}};
};

const RegisteredVerb<SweepCommand> sweep_verb("sweep",
                                              "A map of stop times over starts, of any size: numbers or a picture",
                                              "contensou sweep --mu 0.1 --u0 0:2:201 --v0 0:2:201 -o map.npy");

}  // namespace

}  // namespace contensou::program
