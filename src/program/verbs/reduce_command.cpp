#include <optional>
#include <string>

#include <fmt/format.h>

#include "answers/equation/equation.hpp"
#include "answers/input/expression.hpp"
#include "answers/verbs/plane_answers.hpp"
#include "contensou/portraits/reduction_figure.hpp"
#include "options/law_option.hpp"
#include "options/output_options.hpp"
#include "options/start_options.hpp"
#include "options/system_option.hpp"
#include "output/help.hpp"
#include "verb.hpp"

namespace contensou::program {

namespace {

class ReduceCommand final : public Verb {
 public:
  void add_options(CLI::App& app) override {
    system_.add(app);
    start_.add(app);
    start_.add_drive(app);
    law_.add(app);
    output_.add(app);
    app.option_defaults()->group("Another system");
    details_.add(app, "--details", "print also the numbers of the search: singular values and tried forms");
    until_.add(app, "--until", "T",
               "time at which the state is added, or x for y' = F(x, y); it may lie before the start", number);
    details_.needs(system_.argument(), "is for typed equations");
    until_.needs(system_.argument(), "is for typed equations");
    app.footer([] {
      std::string text = help_paragraph(
          "Kinds of equations that the answer names; behind \"orbits:\" those of dy/dx = y'/x' for a system:");
      for (const auto& [name, meaning] : equation_kinds()) text += help_entry(name, meaning);
      text += "\n" + help_paragraph(
                         "Motions at a jump of the equations cross, slide, rest, or are not unique: 'contensou help "
                         "formulas'.");
      return text;
    });
    system_.argument().excludes({&law_.argument()}, "friction is in the formulas");
    system_.argument().excludes(start_.of_body(), "its numbers are in the formulas, or --param");
  }

  ExitStatus run() override {
    const Output output = output_.read();
    if (system_.given()) return run_system(output);
    if (!start_.given()) {
      throw BadInput(
          "--system missing: give equations, such as --system \"x' = y; y' = -x\", or a body, by --ball NAME|FILE.toml "
          "or --mu M --u0 U --v0 V");
    }
    const GivenStart start = start_.read(law_.read(start_.standard_law()));
    if (!output.picture) return output.write(reduce_answer(start));
    return draw(reduction::reduced(start.system), {start.state.u, start.state.v}, {"(2.6)"}, output, nullptr);
  }

 private:
  ExitStatus run_system(const Output& output) {
    const TypedSystem typed = system_.read(law_.parameters());
    const reduction::SmoothField& field = typed.field;
    if (!output.picture) {
      const auto start = system_.read_start(typed, start_);
      Answer answer = reduce_answer(typed.formulas, field, system_.text(), start, details_);
      if (until_.given())
        add_state_at(answer, {field, typed.formulas, system_.text(), system_.require_start(typed, start_)}, *until_);
      return output.write(answer);
    }
    const Eigen::Vector2d start = system_.require_start(typed, start_);
    const reduction::PlanarSymmetries found = reduction::find_symmetries(field, reduction::sampled_about(field, start));
    const reduction::PlanarReduction plane = reduction::reduce(field, start, found);
    portraits::ReducedNames names{system_.text(), typed.variables()};
    if (plane.scaling() && plane.kind() != "bordered") return draw(plane, start, names, output, nullptr);
    const auto equation = equation_of(typed.formulas, reduction::sampled_about(field, start));
    const auto coordinates = equation ? coordinates_of(*equation, found) : std::nullopt;
    if (!coordinates || !coordinates->motion) {
      throw BadInput(
          "the picture of reduce shows how a scaling, shift or turn moves orbits, and {}: "
          "'contensou portrait --system' draws its plane",
          found.scaling ? "this field has borders or jumps between the orbits that its scaling moves"
                        : "this system has none");
    }
    const auto shown = [&](const char* letter, const Expression& e) {
      const std::string formula = e.text(equation->names);
      return formula == letter ? formula : fmt::format("{} = {}", letter, formula);
    };
    names.q = shown("q", coordinates->q);
    names.p = shown("p", coordinates->p);
    return draw(plane, start, names, output, &*coordinates->motion);
  }

  ExitStatus draw(const reduction::PlanarReduction& plane, const Eigen::Vector2d& start,
                  const portraits::ReducedNames& names, const Output& output, const reduction::Generator* motion) {
    return output_.write({portraits::reduction_figure(plane, start, names, output_.size(), motion)}, output);
  }

  SystemOption system_;
  Flag details_;
  ArgumentOf<double> until_;
  StartOptions start_;
  LawOption law_;
  PictureOptions output_{{{"a reduction", with_pictures(answer_formats("text"))}}};
};

const RegisteredVerb<ReduceCommand> reduce_verb(Purpose::check, "reduce",
                                                "Find the symmetry of a planar system and solve its motion",
                                                "contensou reduce --mu 0.3 --u0 1 --v0 1",
                                                {{"", reduce_fields}, {"--system", reduce_system_fields}},
                                                {"u", "v", "mu", "k", "f, N", "tau", "chi, gamma", "(2.6), (2.7)",
                                                 "orbit", "symmetry", "centre", "ray", "(speed)"});

}  // namespace

}  // namespace contensou::program
