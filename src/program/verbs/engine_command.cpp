#include <cstdio>

#include <fmt/format.h>

#include "answers/verbs/ball_answers.hpp"
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
    set_.add(
        app, "--set", "NAME=VALUE",
        "value of a parameter of the engine (SI) that is compared with the right one, such as spinningFriction=1; "
        "may be given more than once",
        [](const std::string& typed) { return typed; }, true);
    set_.needs(engine_, "belongs to one engine");
    start_.take_own_body();
    start_.add_body(app);
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
    std::vector<answers::TypedValue> typed;
    if (set_.given()) {
      for (const std::string& value : set_.all()) {
        try {
          typed.push_back(answers::parse_typed_value(value, only->use_of(ball.ball.body)));
        } catch (const BadInput& error) {
          throw BadInput("--set {}: {}", value, error.what());
        }
      }
    }
    if (only == &si::unknown_engine()) {
      const std::string hint = suggestion(engine_.text(), names());
      fmt::print(stderr, "note: engine '{}' is not known{}; this is what any engine needs\n", engine_.text(), hint);
    }
    return output_.read().write(engine_answer(ball, law, only, typed));
  }

 private:
  static std::vector<std::string> names() {
    std::vector<std::string> names;
    for (const Engine& engine : si::engines()) names.emplace_back(engine.name);
    for (const si::EngineAlias& alias : si::engine_aliases()) names.emplace_back(alias.name);
    return names;
  }

  static const Engine* find(const std::string& name) {
    const Engine* const engine = si::find_engine(name);
    return engine != nullptr ? engine : &si::unknown_engine();
  }

  ArgumentOf<const Engine*> engine_;
  ArgumentOf<std::string> set_;
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
