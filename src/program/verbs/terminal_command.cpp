#include "options/law_option.hpp"
#include "options/output_options.hpp"
#include "options/start_options.hpp"
#include "verb.hpp"
#include "verbs/phase_plane_answer.hpp"

namespace contensou::program {

namespace {

class TerminalCommand final : public Verb {
 public:
  void add_options(CLI::App& app) override {
    app.option_defaults()->group("System");
    body_.add_mu(app);
    law_.add(app);
    body_.add_body(app);
    output_.add(app);
  }

  ExitStatus run() override {
    const Answer answer = terminal_answer(body_.read(law_.read(std::string(body_.body().law))));
    output_.read().write(answer);
    return ExitStatus::done;
  }

 private:
  BodyOptions body_;
  LawOption law_;
  OutputOptions output_{{{"a terminal ratio", answer_formats("text")}}};
};

const RegisteredVerb<TerminalCommand> terminal_verb(
    "terminal", "What k = v/(mu |u|) tends to at the stop: 0, an invariant ray, infinity",
    "contensou terminal --law uniform --body disc");

}  // namespace

}  // namespace contensou::program
