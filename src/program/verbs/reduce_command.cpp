#include <cstdio>
#include <map>

#include <fmt/format.h>

#include "answers/planar_system.hpp"
#include "answers/reduce_answer.hpp"
#include "contensou/portraits/reduction_figure.hpp"
#include "options/figure_options.hpp"
#include "options/law_option.hpp"
#include "options/output_options.hpp"
#include "options/start_options.hpp"
#include "verb.hpp"

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
    figure_.add(app);
    output_.add(app);
  }

  ExitStatus run() override {
    const Output output = output_.read();
    figure_.require_picture(output);
    if (system_.given()) return run_system(output);
    if (parameters_.given()) throw BadInput("--param is for the formulas of --system: add it, or leave it out");
    const GivenStart start = start_.read(law_.read(start_.standard_law()));
    if (!output.picture()) return write(reduce_answer(start), output);
    return draw(portraits::reduction_figure(reduction::Flow(start.system), start.state, figure_.size()), output);
  }

 private:
  ExitStatus run_system(const Output& output) {
    const reduction::PlanarField field = read_field();
    const Eigen::Vector2d start = start_.read_point();
    if (!output.picture()) return write(reduce_answer(field, system_.text(), start), output);
    const reduction::PlanarSymmetries found = reduction::find_symmetries(field, start);
    if (!found.scaling) {
      fmt::print(stderr,
                 "contensou: --system: no scaling was found, so there is nothing to draw; without a picture "
                 "reduce says what was found\n");
      return ExitStatus::check_failed;
    }
    const reduction::PlanarReduction plane(field, *found.scaling, start, found.residual);
    return draw(portraits::reduction_figure(field, plane, start, system_.text(), figure_.size()), output);
  }

  static ExitStatus write(const ReduceAnswer& reduced, const Output& output) {
    output.write(reduced.answer);
    return reduced.found ? ExitStatus::done : ExitStatus::check_failed;
  }

  ExitStatus draw(portraits::Figure figure, const Output& output) {
    output.write({figure_.apply(std::move(figure), output.format)});
    return ExitStatus::done;
  }

  reduction::PlanarField read_field() {
    if (law_.given()) throw BadInput("--system and --law exclude each other: friction is in the formulas");
    std::map<std::string, double> parameters;
    for (const auto& [name, value] : parameters_.all()) {
      if (!parameters.emplace(name, value).second) {
        throw BadInput(fmt::format("--param: {} is given twice", quotation(name)));
      }
    }
    try {
      return parse_planar_system(system_.text(), parameters);
    } catch (const BadInput& error) {
      throw BadInput(fmt::format("--system: {}", error.what()));
    }
  }

  Argument system_;
  ArgumentOf<std::pair<std::string, double>> parameters_;
  StartOptions start_;
  LawOption law_;
  FigureOptions figure_;
  OutputOptions output_{{{"a reduction", with_pictures(answer_formats("text"))}}};
};

const RegisteredVerb<ReduceCommand> reduce_verb("reduce", "The symmetry of a planar system found, its motion solved",
                                                "contensou reduce --mu 0.3 --u0 1 --v0 1");

}  // namespace

}  // namespace contensou::program
