#include "options/bulk_options.hpp"
#include "options/law_option.hpp"
#include "options/output_options.hpp"
#include "options/route_option.hpp"
#include "options/start_options.hpp"
#include "verb.hpp"
#include "verbs/stop_answer.hpp"
#include "verbs/stop_batch.hpp"

namespace contensou::program {

namespace {

class StopCommand final : public Verb {
 public:
  void add_options(CLI::App& app) override {
    start_.add(app);
    law_.add(app);
    route_.add(app);
    app.add_flag("--estimate", estimate_, "the estimates for small mu beside the stop time, with their errors");
    batch_.add(app, "--batch", "FILE",
               "CSV with columns mu,u0,v0, to which it adds tau_stop; with --ball slip,spin (m/s, rad/s) and t_stop "
               "(s); - is standard input");
    app.add_flag("--keep-going", keep_going_, "with --batch: leave tau_stop of a bad row empty and go on");
    bulk_.add(app);
    output_.add(app);
  }

  ExitStatus run() override {
    if (batch_.given()) return run_batch();
    if (keep_going_) throw BadInput("--keep-going is for many starts: add --batch FILE");
    bulk_.refuse("many starts: add --batch FILE");
    const Output output = output_.read();
    const GivenStart start = start_.read(law_.read(start_.body()));
    output.write(stop_answer(start, route_.read(start.system), estimate_));
    return ExitStatus::done;
  }

 private:
  ExitStatus run_batch() const {
    const bool has_ball = start_.ball_given();
    if (has_ball ? start_.overrides_start() : start_.given()) {
      throw BadInput("--batch and " + start_.given_names() + " exclude each other: the starts are in the file");
    }
    if (estimate_) throw BadInput("--estimate is for one start: leave it or --batch out");
    const Output out = output_.read(1);
    const reduction::Law law = law_.read(start_.body());
    const BatchRequest request{law,
                               start_.body(),
                               has_ball ? std::optional(start_.read(law).shot.value()) : std::nullopt,
                               route_,
                               keep_going_,
                               bulk_.threads(),
                               bulk_.progress(out.path)};
    OutputFile output(out.path);  // before the input, which may be long in coming
    CsvReader table(batch_.text());
    const ExitStatus status = stop_batch(table, output, request);
    output.finish();
    return status;
  }

  StartOptions start_;
  LawOption law_;
  RouteOption route_;
  Argument batch_;
  bool estimate_ = false;
  bool keep_going_ = false;
  BulkOptions bulk_;
  OutputOptions output_{{{"a stop time", answer_formats("text")}, {"a table of stop times", {"csv"}}}};
};

const RegisteredVerb<StopCommand> stop_verb("stop", "When the ball stops sliding and spinning, and how it rolls then",
                                            "contensou stop --ball pool --slip 2");

}  // namespace

}  // namespace contensou::program
