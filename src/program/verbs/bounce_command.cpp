#include <fmt/format.h>

#include "answers/verbs/ball_answers.hpp"
#include "contensou/si/quantity.hpp"
#include "options/law_option.hpp"
#include "options/output_options.hpp"
#include "options/start_options.hpp"
#include "verb.hpp"

namespace contensou::program {

namespace {

class BounceCommand final : public Verb {
 public:
  void add_options(CLI::App& app) override {
    start_.take_own_body();
    start_.add_body(app);
    start_.add_ball(app, "real ball in SI units: built-in, or from a run file", [](const si::Quantity& of) {
      return &of != &si::slip && &of != &si::velocity && &of != &si::load && &of != &si::slope &&
             &of != &si::rolling_friction;
    });
    app.option_defaults()->group("Impact");
    speed_.add(app, "--speed", "SPEED",
               "velocity of the centre along x, in metres per second (default: velocity of --ball)", quantity("m/s"));
    normal_speed_.add(app, "--normal-speed", "SPEED", "speed towards the plane, in metres per second, above 0",
                      checked(quantity("m/s"), is_positive, "a speed above 0 is needed"));
    drop_.add(app, "--drop", "LENGTH",
              "height from which the ball is dropped, in metres, above 0; replaces --normal-speed",
              checked(quantity("m"), is_positive, "a height above 0 is needed"));
    normal_speed_.excludes({&drop_});
    restitution_.add(app, "--restitution", "E",
                     "coefficient of restitution, 0 to 1: normal speed after the impact divided by normal speed before",
                     checked(
                         number, [](double part) { return part >= 0 && part <= 1; }, "0 to 1 is needed"));
    rolling_below_.add(
        app, "--rolling-below", "SPEED",
        fmt::format("slip below which the ball counts as rolling, in metres per second (default {})", si::rolling_slip),
        checked(quantity("m/s"), is_not_negative, "0 or more is needed"));
    law_.add(app);
    output_.add(app);
  }

  ExitStatus run() override {
    const Output output = output_.read();
    const reduction::Law law = law_.read(start_.standard_law());
    si::Experiment experiment = start_.read_rolling_ball(law, "'contensou roll' gives its motion",
                                                         start_.ball().given() ? si::Description{} : at_rest(""));
    start_.require_undriven(experiment, "bounce");
    if (!normal_speed_.given() && !drop_.given()) throw BadInput("--normal-speed missing: give it, or --drop LENGTH");
    if (!restitution_.given()) throw BadInput("--restitution missing: 0 (it stays down) to 1 (it loses nothing)");
    if (experiment.environment.load && drop_.given())
      drop_.reject(
          "the run file presses the ball with a load, which says no gravity: give --normal-speed, or gravity there");
    if (speed_.given())
      experiment.start = si::Velocities{{*speed_, 0}, si::velocities_of(experiment.start).angular_velocity};
    si::require_experiment(experiment);
    const si::Impact impact{drop_.given() ? si::drop_speed(*drop_, experiment.environment.gravity) : *normal_speed_,
                            *restitution_};
    if (!std::holds_alternative<si::HertzModuli>(experiment.contact.patch)) {
      fmt::print(stderr,
                 "note: the patch stays at {:.6g} m while the ball is pressed on the plane; that of an elastic ball "
                 "widens\n",
                 si::patch_radius_of(experiment, law));
    }
    return output.write(
        answers::bounce_answer(experiment, law, impact, drop_.optional(), rolling_below_.value_or(si::rolling_slip)));
  }

 private:
  StartOptions start_;
  LawOption law_;
  ArgumentOf<double> speed_, normal_speed_, drop_, restitution_, rolling_below_;
  OutputOptions output_{{{"a bounce", answer_formats("text")}}};
};

const RegisteredVerb<BounceCommand> bounce_verb(Purpose::compute, "bounce",
                                                "Compute how a spinning ball bounces off the plane",
                                                "contensou bounce --ball rubber --spin 200 --drop 1 --restitution 0.8",
                                                {{"", bounce_fields}}, {"slip", "spin", "patch", "uncoupled model"});

}  // namespace

}  // namespace contensou::program
