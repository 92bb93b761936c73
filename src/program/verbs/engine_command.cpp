#include <cstdio>

#include <fmt/format.h>

#include "answers/verbs/engine_answer.hpp"
#include "options/law_option.hpp"
#include "options/output_options.hpp"
#include "options/start_options.hpp"
#include "verb.hpp"

namespace contensou::program {

namespace {

using si::Engine;

class EngineCommand final : public Verb {
 public:
  void add_options(CLI::App& app) override {
    engine_.add(app, "NAME", "", "engine that is described in full (default: one line for each engine)", find);
    start_.add_ball(app);
    law_.add(app);
    output_.add(app);
  }

  ExitStatus run() override {
    const reduction::Law law = law_.read(start_.standard_law());
    const Engine* const only = engine_.given() ? *engine_ : nullptr;
    for (const si::EngineAlias& alias : si::engine_aliases()) {
      if (only && engine_.text() == alias.name) fmt::print(stderr, "note: {}\n", alias.words);
    }
    const si::Experiment ball = start_.read_ball(law);
    start_.require_undriven(ball, "engine");
    try {
      si::mass_for("engine", ball.ball);
    } catch (const std::domain_error& error) {
      start_.reject_ball(error.what());
    }
    return output_.read().write(engine_answer(ball, law, only));
  }

 private:
  static const Engine* find(const std::string& name) {
    if (const Engine* engine = si::find_engine(name)) return engine;
    std::vector<std::string> names;
    for (const Engine& engine : si::engines()) names.emplace_back(engine.name);
    for (const si::EngineAlias& alias : si::engine_aliases()) names.emplace_back(alias.name);
    throw NotAllowed(no_such("engine", name, names, false));
  }

  ArgumentOf<const Engine*> engine_;
  StartOptions start_;
  LawOption law_;
  OutputOptions output_{{{"a table of engines", answer_formats("text")}}};
};

const RegisteredVerb<EngineCommand> engine_verb(Purpose::bodies, "engine",
                                                "Print the settings of physics engines for the moment of friction",
                                                "contensou engine mujoco --ball pool", {{"", engine_fields}},
                                                {"slip", "spin", "patch", "law"});

}  // namespace

}  // namespace contensou::program
