#include <algorithm>
#include <cstddef>
#include <deque>

#include <fmt/format.h>

#include "answers/input/tables.hpp"
#include "answers/verbs/ball_answers.hpp"
#include "contensou/si/scaling.hpp"
#include "options/law_option.hpp"
#include "options/output_options.hpp"
#include "options/route_option.hpp"
#include "options/start_options.hpp"
#include "output/batch.hpp"
#include "verb.hpp"
#include "verbs/stop_times.hpp"

namespace contensou::program {

namespace {

/// Columns of the tables that --batch reads, without and with --ball.
constexpr ColumnText reduced_starts{"mu,u0,v0", "1, speed, speed", "mu, and u and v at the start"};
constexpr ColumnText ball_starts{"spin,slip", "1/s, m/s", "spin and slip of the ball at the start, with --ball"};

std::vector<FieldText> stop_batch_texts() {
  return joined(
      {texts_of({reduced_starts, ball_starts}, "in: "),
       texts_of({{"tau_stop", "speed", "time tau when slip and spin end; other columns are copied from the input"},
                 {"t_stop", "s", "time when slip and spin end, with --ball"},
                 {"tau_stop_LAW,t_stop_LAW", "", "these times under each law, if --law names several"}},
                "out: ")});
}

class StopCommand final : public Verb {
 public:
  void add_options(CLI::App& app) override {
    start_.take_load_history();
    start_.take_own_body();
    start_.add(app);
    start_.add_drive(app);
    law_.add(app, ". With --batch also several names, between commas");
    route_.add(app);
    estimate_.add(app, "--estimate", "also print estimates for small mu, with their errors");
    gradient_.add(app, "--gradient", "also print the exact derivatives of the stop time (see gradient)");
    uncertainty_.add(app, "--uncertainty", "NAME=SPREAD,...",
                     "standard deviations of input values, such as slip=1%,friction=5%, or fit: those in "
                     "a file of 'contensou fit'. Also prints the standard deviation of the stop time");
    app.option_defaults()->group("Many starts");
    batch_.add(app, "--batch", "FILE",
               "table with one start a row, - for standard input. Columns: mu,u0,v0, or with --ball slip,spin (m/s, "
               "rad/s). The output adds the column tau_stop or t_stop");
    keep_going_.add(app, "--keep-going", "continue after a bad row, and leave its result empty");
    bulk_.add(app);
    batch_.excludes(start_.of_start(), "the starts are in the file");
    batch_.excludes({&estimate_, &uncertainty_, &gradient_}, "the results are stop times alone");
    keep_going_.needs(batch_, "is for many starts");
    bulk_.need(batch_, "is for many starts");
    output_.add(app);
  }

  ExitStatus run() override {
    if (batch_.given()) return run_many();
    const Output output = output_.read();
    const GivenStart start = start_.read(law_.read(start_.standard_law()));
    const auto load = start_.load_history();
    if (load && uncertainty_.given()) uncertainty_.reject("needs a constant load: give --load a number");
    if (load) fmt::print(stderr, "{}", require_load_alone(*start.experiment, start.system.law()));
    return output.write(
        stop_answer(start, route_.read(start.system), estimate_, gradient_, read_uncertainty(start), load));
  }

 private:
  std::optional<Uncertainty> read_uncertainty(const GivenStart& start) const {
    if (!uncertainty_.given()) return std::nullopt;
    if (start.experiment && uncertainty_.text().find("fit") != std::string::npos)
      start_.tell_spreads_left_out(*start.experiment);
    try {
      return stop_uncertainty(start, uncertainty_.text());
    } catch (const BadInput& error) {
      uncertainty_.reject(error.what());
    }
  }

  static double sliding(const char* name, double speed) {
    if (speed >= 0) return speed;
    throw BadInput("{0}: {0} >= 0 is required, got {1}", name, speed);
  }

  ExitStatus run_many() const {
    const bool has_ball = start_.ball_given();
    if (has_ball && start_.load_history()) throw BadInput("--batch needs a constant load: give --load a number");
    const Output out = output_.read(1);
    const std::vector<reduction::Law> laws = law_.read_several(start_.standard_law());
    const auto ball = has_ball ? std::optional(start_.read_ball(laws.front(), at_rest("--batch"))) : std::nullopt;
    std::deque<StopTimes> stop_times;  // a deque, because its elements must keep their addresses
    std::vector<double> mu;            // mu of the ball under each law
    BatchRequest request{.inputs = names_of({has_ball ? ball_starts : reduced_starts}),
                         .results = {},
                         .compute =
                             [&](std::span<const double> row, std::span<double> results, long line) {
                               if (const std::string wrong = start_.body().complaint(row[0]); !wrong.empty()) {
                                 throw BadInput("mu: {}, got {}", wrong, row[0]);
                               }
                               const reduction::State start{.u = row[1], .v = sliding("v0", row[2])};
                               for (std::size_t i = 0; i < results.size(); ++i)
                                 results[i] = stop_times[i](row[0], start, line);
                             },
                         .keep_going = keep_going_,
                         .threads = bulk_.threads(),
                         .progress = bulk_.progress(out.path)};
    for (const reduction::Law& law : laws) {
      stop_times.emplace_back(law, ball ? ball->ball.body.inertia : start_.body().inertia,
                              ball ? start_.drive_along_x(*ball) : start_.drive().value_or(0), route_);
      if (ball && ball->contact.rolling_friction != 0) stop_times.back().resist(*ball);
      if (ball) mu.push_back(si::patch_ratio(*ball, law));
      const std::string result = has_ball ? "t_stop" : "tau_stop";
      request.results.push_back(laws.size() > 1 ? fmt::format("{}_{}", result, law.name()) : result);
      if (std::ranges::count(request.results, request.results.back()) > 1)
        law_.argument().reject(fmt::format("the law {} is there twice", law.name()));
    }
    if (has_ball) {
      const si::Experiment& experiment = *ball;
      request.compute = [&](std::span<const double> row, std::span<double> results, long /*line*/) {
        const reduction::State start{.u = row[0] * experiment.ball.radius, .v = sliding("slip", row[1])};
        for (std::size_t i = 0; i < results.size(); ++i)
          results[i] = si::seconds(experiment, stop_times[i](mu[i], start, 0));
      };
    }
    OutputFile output(out.path);  // opened before the input, so that an error appears at once
    CsvReader table(batch_.text());
    const bool si_columns = table.has_column("slip") || table.has_column("spin");
    if (!has_ball && !table.has_column("mu") && si_columns) {
      throw table.complaint(table.header_line(), "columns slip, spin are in SI units: add --ball NAME|FILE.toml");
    }
    if (has_ball && table.has_column("vx")) {
      throw table.complaint(
          table.header_line(),
          "columns vx, vy, wx, wy, wz are a start of 'contensou roll --batch'; stop needs slip, spin alone");
    }
    if (has_ball && !si_columns && table.has_column("mu")) {
      throw table.complaint(table.header_line(), "columns mu, u0, v0 are starts without --ball: leave it out");
    }
    const ExitStatus status = run_batch(table, output, request);
    output.finish();
    return status;
  }

  StartOptions start_;
  LawOption law_;
  RouteOption route_;
  Argument batch_, uncertainty_;
  Flag estimate_, gradient_, keep_going_;
  BulkOptions bulk_;
  OutputOptions output_{{{"a stop time", answer_formats("text")}, {"a table of stop times", {"csv"}}}};
};

const RegisteredVerb<StopCommand> stop_verb(Purpose::compute, "stop", "Compute when slip and spin end",
                                            "contensou stop --ball pool --slip 2",
                                            {{"", stop_fields}, {"--batch", stop_batch_texts}},
                                            {"u", "v", "mu", "f, N", "tau", "chi, gamma", "(speed)"});

}  // namespace

}  // namespace contensou::program
