#include "options/instants_option.hpp"
#include "options/law_option.hpp"
#include "options/output_options.hpp"
#include "options/start_options.hpp"
#include "verb.hpp"
#include "verbs/roll_answer.hpp"

namespace contensou::program {

namespace {

double parse_end(const std::string& typed) {
  const double end = parse_number(typed);
  if (!(end > 0)) throw NotAllowed("a time after the start is needed, in s");
  return end;
}

class RollCommand final : public Verb {
 public:
  void add_options(CLI::App& app) override {
    start_.add_ball(app);
    velocity_.add(app, "--velocity", "VX,VY", "velocity of the centre in m/s, instead of the start's",
                  [](const std::string& typed) { return Eigen::Vector2d(numbers(typed, 2, "VX,VY").data()); });
    angular_velocity_.add(
        app, "--angular-velocity", "WX,WY,WZ", "angular velocity in rad/s, z up, instead of the start's",
        [](const std::string& typed) { return Eigen::Vector3d(numbers(typed, 3, "WX,WY,WZ").data()); });
    law_.add(app);
    integrated_.add(app, "--route", "ROUTE",
                    "reduced: the similarity solution (default), or integrated: the five equations of motion (2.5)",
                    one_of<bool>({{"reduced", false}, {"integrated", true}}, "route"));
    CLI::Option* at = instants_.add(app, "t", " in s", "");
    until_.add(app, "--until", "T", "the last of them, in s (default: a little past the stop)", parse_end)
        ->excludes(at);
    output_.add(app);
  }

  ExitStatus run() override {
    const Output output = output_.read();
    const si::Shot shot = read_shot();
    const Roll roll{shot, law_.read(), integrated_.value_or(false)};
    const double end = until_.value_or(roll.standard_end());
    if (output.picture()) {
      if (instants_.given()) throw BadInput("a picture needs no --at or --samples: leave them out");
      output.write(portraits::roll_figure(roll_picture(roll, end)));
    } else if (output.format == "text" && !instants_.given() && !until_.given()) {
      output.write(roll_report(roll, output.digits));
    } else {
      const auto* at = instants_.at();
      output.write(roll_table(roll, at != nullptr ? *at : Eigen::ArrayXd::LinSpaced(instants_.samples(), 0, end)));
    }
    return ExitStatus::done;
  }

 private:
  si::Shot read_shot() const {
    const si::StartOverride start{velocity_.optional(), angular_velocity_.optional()};
    if ((start.velocity || start.angular_velocity) && start_.overrides_start()) {
      throw BadInput("--slip, --spin and --velocity, --angular-velocity exclude each other: give one pair of them");
    }
    return start_.read_ball(start);
  }

  StartOptions start_;
  ArgumentOf<Eigen::Vector2d> velocity_;
  ArgumentOf<Eigen::Vector3d> angular_velocity_;
  LawOption law_;
  ArgumentOf<bool> integrated_;
  InstantsOption instants_;
  ArgumentOf<double> until_;
  OutputOptions output_{{{"a motion", with_pictures(answer_formats("csv"))}}};
};

const RegisteredVerb<RollCommand> roll_verb(
    "roll", "The whole motion of a ball: t,x,y,vx,vy,wx,wy,wz,slip,energy",
    "contensou roll --ball pool --velocity 1,0 --angular-velocity 40,35,-50 --format text");

}  // namespace

}  // namespace contensou::program
