#include <fmt/format.h>

#include "answers/figures/figures.hpp"
#include "answers/verbs/ball_answers.hpp"
#include "options/law_option.hpp"
#include "options/output_options.hpp"
#include "options/start_options.hpp"
#include "verb.hpp"

namespace contensou::program {

namespace {

auto at_least_0(const char* unit) {
  return checked(quantity(unit), is_not_negative, fmt::format("a value >= 0 is needed, in {}", unit));
}

class AimCommand final : public Verb {
 public:
  void add_options(CLI::App& app) override {
    distance_.add(
        app, "--distance", "LENGTH",
        "distance from the start to the place where slip and spin end; with rolling friction, to the place of rest",
        at_least_0("m"));
    turns_.add(app, "--turns", "N", "number of turns about the vertical until slip and spin end, of either sign",
               number);
    time_.add(app, "--time", "TIME",
              "time when slip and spin end; with rolling friction, time of rest. Two of --distance, --turns and --time "
              "must be given",
              at_least_0("s"));
    rolls_at_.add(app, "--rolls-at", "LENGTH",
                  "distance from the start to the place where a ball begins to roll (slip below 1 mm/s), instead of "
                  "--distance, --turns, --time. Only starts with forward slip are found",
                  checked(quantity("m"), is_positive, "a value > 0 is needed, in m"));
    rolling_speed_.add(
        app, "--rolling-speed", "SPEED",
        "speed of rolling after the spin has ended, for --rolls-at; with 0 the ball stops where it would begin to roll",
        at_least_0("m/s"));
    spin_.add(app, "--spin", "ROTATION",
              "spin about the vertical at the start, for --rolls-at, of either sign (default 0)", quantity("rad/s"));
    const std::string alone =
        "two of --distance, --turns and --time decide the start, or --rolls-at and --rolling-speed";
    for (Argument* argument : {&rolls_at_, &rolling_speed_, &spin_})
      argument->excludes({&distance_, &turns_, &time_}, alone);
    rolls_at_.needs(rolling_speed_, "goes with --rolling-speed");
    rolling_speed_.needs(rolls_at_, "goes with --rolls-at");
    spin_.needs(rolls_at_, "goes with --rolls-at and --rolling-speed");
    start_.take_own_body();
    start_.add_body(app);
    start_.add_ball(app, "real body in SI units, built-in or from a run file; its start is not used",
                    StartOptions::no_start);
    law_.add(app);
    output_.add(app);
  }

  ExitStatus run() override {
    const reduction::Law law = law_.read(start_.standard_law());
    const si::Experiment ball = start_.read_ball(law, at_rest("aim"));
    start_.tell_left_out();
    const Output output = output_.read();
    if (const std::string names = names_given({&rolls_at_, &rolling_speed_, &spin_}); !names.empty()) {
      if (output.picture) throw BadInput("{}: a picture needs two of --distance, --turns and --time", names);
      return output.write(aim_answer(ball, law, si::RollingGoal{*rolls_at_, *rolling_speed_, spin_.value_or(0)}));
    }
    const si::Goal goal{distance_.optional(), turns_.optional(), time_.optional()};
    if (!output.picture) return output.write(aim_answer(ball, law, goal));
    start_.require_undriven(ball, "the plane of aims");
    return output_.write({aim_figure(ball, law, goal, output_.size())}, output);
  }

 private:
  ArgumentOf<double> distance_, turns_, time_, rolls_at_, rolling_speed_, spin_;
  StartOptions start_;
  LawOption law_;
  PictureOptions output_{{{"a start", with_pictures(answer_formats("text"))}}};
};

const RegisteredVerb<AimCommand> aim_verb(Purpose::compute, "aim",
                                          "Find the start that reaches a given distance, number of turns or time",
                                          "contensou aim --ball puck --distance 20m --turns 3", {{"", aim_fields}},
                                          {"slip", "spin"});

}  // namespace

}  // namespace contensou::program
