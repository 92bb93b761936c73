#include "answers/aim_answer.hpp"
#include "answers/aim_figure.hpp"
#include "options/figure_options.hpp"
#include "options/law_option.hpp"
#include "options/output_options.hpp"
#include "options/start_options.hpp"
#include "verb.hpp"

namespace contensou::program {

namespace {

class AimCommand final : public Verb {
 public:
  void add_options(CLI::App& app) override {
    distance_.add(app, "--distance", "LENGTH",
                  "of the centre from the start, when slip and spin end, with rolling friction when it rests",
                  quantity("m"));
    turns_.add(app, "--turns", "N", "about the vertical until then, of either sign", number);
    time_.add(app, "--time", "TIME", "when slip and spin end; two of the three decide the start", quantity("s"));
    start_.add_ball(app, "a ball in SI units, built in or from a run file; its own start does not count",
                    StartOptions::no_start);
    law_.add(app);
    figure_.add(app);
    output_.add(app);
  }

  ExitStatus run() override {
    const reduction::Law law = law_.read(start_.standard_law());
    const si::Experiment ball = start_.read_ball(law, at_rest("aim"));
    const Output output = output_.read();
    figure_.require_picture(output);
    const si::Goal goal{distance_.optional(), turns_.optional(), time_.optional()};
    if (output.picture()) {
      start_.require_undriven(ball, "the plane of aims");
      output.write({figure_.apply(aim_figure(ball, law, goal, figure_.size()), output.format)});
    } else {
      output.write(aim_answer(ball, law, goal));
    }
    return ExitStatus::done;
  }

 private:
  ArgumentOf<double> distance_, turns_, time_;
  StartOptions start_;
  LawOption law_;
  FigureOptions figure_;
  OutputOptions output_{{{"a start", with_pictures(answer_formats("text"))}}};
};

const RegisteredVerb<AimCommand> aim_verb(Purpose::compute, "aim",
                                          "The start that goes so far, turns so often or lasts so long",
                                          "contensou aim --ball puck --distance 20m --turns 3");

}  // namespace

}  // namespace contensou::program
