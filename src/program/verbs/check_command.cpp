#include <fmt/format.h>

#include "answers/figures/figures.hpp"
#include "answers/verbs/check_answer.hpp"
#include "contensou/reduction/laws.hpp"
#include "contensou/reduction/verification.hpp"
#include "options/law_option.hpp"
#include "options/output_options.hpp"
#include "options/start_options.hpp"
#include "options/system_option.hpp"
#include "verb.hpp"

namespace contensou::program {

namespace {

using reduction::Check;
using reduction::Law;

class CheckCommand final : public Verb {
 public:
  void add_options(CLI::App& app) override {
    system_.add(app);
    start_.take_own_body();
    start_.add(app);
    start_.add_drive(app);
    law_.add(app);
    app.option_defaults()->group("Against a table");
    against_.add(
        app, "--against", "FILE",
        "table of a motion from an engine or a camera, - for standard input. The motion of --ball under --law "
        "is compared with this table. Columns: t, and slip,spin or vx,vy,wx,wy,wz, or of a flat body "
        "x,y,angle, in SI units or as 'wz [rpm]'. The first row is the start, unless --slip and --spin are given");
    tolerance_.add(app, "--tolerance", "SHARE",
                   fmt::format("largest difference that passes, divided by slip and spin at the start (default {})",
                               standard_tolerance),
                   checked(number, is_positive, "a share above 0 is needed"));
    tolerance_.needs(against_, "is for a table");
    output_.add(app);
    system_.argument().excludes({&law_.argument(), &against_}, "friction is in the formulas");
    system_.argument().excludes(start_.of_body(), "its numbers are in the formulas, or --param");
  }

  ExitStatus run() override {
    const Output output = output_.read();
    if (against_.given()) return compare(output);
    if (output.picture && output.format != "tex")
      throw BadInput("a picture compares with a table: add --against FILE, or leave it out");
    if (system_.given()) {
      const TypedSystem typed = system_.read(law_.parameters());
      return output.write(check_system_answer(typed.field, system_.require_start(typed, start_)));
    }
    const bool of_one_start = start_.given() || start_.body_argument().given();
    const bool one_law = law_.given() || start_.brings_law();
    std::vector<CheckedLaw> rows;
    for (const Law& law : one_law ? std::vector{law_.read(start_.standard_law())} : reduction::paper_laws()) {
      for (Check& check : of_one_start ? checks_of_start(law) : built_in_checks(law)) {
        rows.push_back({law.name(), std::move(check)});
      }
    }
    return output.write(check_answer(rows, !start_.given()));
  }

 private:
  static constexpr double standard_tolerance = 0.01;

  /// Compares the motion in a table with the motion under the law.
  ExitStatus compare(const Output& output) const {
    const Law law = law_.read(start_.standard_law());
    if (!start_.ball_given()) {
      against_.reject("slip and spin are those of a ball in SI units: add --ball NAME|FILE.toml");
    }
    const si::Experiment ball = start_.read_ball(law, at_rest(against_.name()));
    const double tolerance = tolerance_.value_or(standard_tolerance);
    const MotionsBeside motions = compare_with_motions(against_.text(), ball, start_.given_values(), law, tolerance);
    const Answer answer = check_against_answer(motions, law.name(), tolerance);
    if (!output.picture) return output.write(answer);
    output_.write({check_figure(motions, ball.ball.name, output_.size())}, output);
    return answer.passed ? ExitStatus::done : ExitStatus::check_failed;
  }

  std::vector<Check> checks_of_start(const Law& law) const {
    const GivenStart start = start_.read(law);
    if (start.at_rest()) throw BadInput("u0 = v0 = 0 is rest, there is no motion to check: make one of them positive");
    if (!start.motion) return verify(start.system, start.state);
    std::vector<Check> worst;  // for each check, the worst result over all orbits of the motion
    for (const si::ReducedPiece& piece : start.pieces()) take_worse(worst, verify(piece.flow.system(), piece.start));
    return worst;
  }

  SystemOption system_;
  StartOptions start_;
  LawOption law_;
  Argument against_;
  ArgumentOf<double> tolerance_;
  PictureOptions output_{{{"a table of checks", with_pictures(answer_formats("text"))}}};
};

const RegisteredVerb<CheckCommand> check_verb(Purpose::check, "check",
                                              "Check every statement of the theory, or compare a table of a motion",
                                              "contensou check --mu 0.1 --u0 1 --v0 1", {{"", check_fields}},
                                              {"u", "v", "mu", "f, N"});

}  // namespace

}  // namespace contensou::program
