#include <map>

#include <fmt/format.h>

#include "input/planar_system.hpp"
#include "options/law_option.hpp"
#include "options/output_options.hpp"
#include "options/start_options.hpp"
#include "verb.hpp"
#include "verbs/reduce_answer.hpp"

namespace contensou::program {

namespace {

std::pair<std::string, double> parse_parameter(const std::string& typed) {
  const std::size_t equals = typed.find('=');
  if (equals == std::string::npos) throw NotAllowed("a parameter is NAME=VALUE");
  return {typed.substr(0, equals), parse_number(std::string_view(typed).substr(equals + 1))};
}

class ReduceCommand final : public Verb {
 public:
  void add_options(CLI::App& app) override {
    app.option_defaults()->group("Another system");
    system_.add(app, "--system", "\"u' = F; v' = G\"",
                "in place of (2.6): formulas in u and v with + - * / ^, |x|, hypot, sqrt, sign, exp, ...; "
                "--u0 and --v0 of either sign are its start");
    parameters_.add(app, "--param", "NAME=VALUE", "a parameter of the formulas; may be given often", parse_parameter,
                    true);
    start_.add(app);
    law_.add(app);
    output_.add(app);
  }

  ExitStatus run() override {
    const Output output = output_.read();
    const auto [answer, found] = read();
    output.write(answer);
    return found ? ExitStatus::done : ExitStatus::check_failed;
  }

 private:
  ReduceAnswer read() {
    if (!system_.given()) {
      if (parameters_.given()) throw BadInput("--param is for the formulas of --system: add it, or leave it out");
      return reduce_answer(start_.read(law_.read(start_.standard_law())));
    }
    if (law_.given()) throw BadInput("--system and --law exclude each other: friction is in the formulas");
    std::map<std::string, double> parameters;
    for (const auto& [name, value] : parameters_.all()) {
      if (!parameters.emplace(name, value).second) {
        throw BadInput(fmt::format("--param: {} is given twice", quotation(name)));
      }
    }
    const reduction::PlanarField field = [&] {
      try {
        return parse_planar_system(system_.text(), parameters);
      } catch (const BadInput& error) {
        throw BadInput(fmt::format("--system: {}", error.what()));
      }
    }();
    return reduce_answer(field, system_.text(), start_.read_point());
  }

  Argument system_;
  ArgumentOf<std::pair<std::string, double>> parameters_;
  StartOptions start_;
  LawOption law_;
  OutputOptions output_{{{"a reduction", answer_formats("text")}}};
};

const RegisteredVerb<ReduceCommand> reduce_verb("reduce", "The symmetry of a planar system found, its motion solved",
                                                "contensou reduce --mu 0.3 --u0 1 --v0 1");

}  // namespace

}  // namespace contensou::program
