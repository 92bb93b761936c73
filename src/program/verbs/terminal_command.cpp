#include <optional>

#include "answers/verbs/plane_answers.hpp"
#include "contensou/portraits/theory_figures.hpp"
#include "options/law_option.hpp"
#include "options/output_options.hpp"
#include "options/start_options.hpp"
#include "verb.hpp"

namespace contensou::program {

namespace {

class TerminalCommand final : public Verb {
 public:
  void add_options(CLI::App& app) override {
    app.option_defaults()->group("Start");
    start_.add_mu(app);
    start_.add_body(app);
    start_.add_ball(app);
    start_.add_drive(app);
    law_.add(app);
    output_.add(app);
  }

  ExitStatus run() override {
    const Output output = output_.read();
    const reduction::Law law = law_.read(start_.standard_law());
    if (!output.picture) return output.write(phase_plane_answer(start_.read_body(law), answers::PlaneRows::limits));
    // The figure shows all r. If a body is given, a mark shows the r of this body.
    std::optional<double> r;
    double drive = start_.drive().value_or(0);
    if (names_given(start_.of_body()) != names_given({&start_.drive()})) {
      const reduction::ReducedSystem system = start_.read_body(law);
      r = system.r();
      drive = system.drive();
    }
    return output_.write({portraits::rays_figure(law, r, output_.size(), drive)}, output);
  }

 private:
  StartOptions start_;
  LawOption law_;
  PictureOptions output_{{{"a terminal ratio", with_pictures(answer_formats("text"))}}};
};

const RegisteredVerb<TerminalCommand> terminal_verb(Purpose::compute, "terminal",
                                                    "Compute the ratio of slip to rim speed at the stop",
                                                    "contensou terminal --law uniform --body disc",
                                                    {{"", terminal_fields}},
                                                    {"u", "v", "mu", "k", "f, N", "Phi, Psi", "stop", "chi, gamma"});

}  // namespace

}  // namespace contensou::program
