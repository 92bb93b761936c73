#include <optional>

#include "answers/verbs/phase_plane_answer.hpp"
#include "contensou/portraits/theory_figures.hpp"
#include "options/figure_options.hpp"
#include "options/law_option.hpp"
#include "options/start_options.hpp"
#include "verb.hpp"

namespace contensou::program {

namespace {

class TerminalCommand final : public Verb {
 public:
  void add_options(CLI::App& app) override {
    app.option_defaults()->group("Start");
    body_.add_mu(app);
    body_.add_body(app);
    body_.add_drive(app);
    law_.add(app);
    output_.add(app);
  }

  ExitStatus run() override {
    const Output output = output_.read();
    const reduction::Law law = law_.read(std::string(body_.body().law));
    if (!output.picture) return output.write(terminal_answer(body_.read_system(law)));
    // The figure shows all r. If a body is given, a mark shows the r of this body.
    std::optional<double> r;
    if (body_.mu().given() || body_.body_argument().given()) r = body_.read_system(law).r();
    return output_.write({portraits::rays_figure(law, r, output_.size(), body_.drive().value_or(0))}, output);
  }

 private:
  BodyOptions body_;
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
