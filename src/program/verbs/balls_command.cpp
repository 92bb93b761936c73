#include <algorithm>

#include "answers/table/answer.hpp"
#include "contensou/reduction/laws.hpp"
#include "contensou/si/catalogue.hpp"
#include "contensou/si/run_file.hpp"
#include "contensou/si/scaling.hpp"
#include "options/output_options.hpp"
#include "options/start_options.hpp"
#include "output/help.hpp"
#include "verb.hpp"

namespace contensou::program {

namespace {

using si::CatalogueEntry;

/// Returns the default law of the ball.
reduction::Law own_law(const CatalogueEntry& entry) { return *reduction::find_law(si::law_of(entry.experiment)); }

constexpr Field<CatalogueEntry> ball_fields[]{
    {"name", "", "name of the ball for the option --ball of other verbs",
     [](const CatalogueEntry& of) -> Json { return of.name; }},
    {"description", "", "ball and plane in words",
     [](const CatalogueEntry& of) -> Json { return of.experiment.ball.name; }},
    {"body", "", "kind of body: ball, hollow-ball, disc or ring",
     [](const CatalogueEntry& of) -> Json { return of.experiment.ball.body.name; }},
    {"law", "", "law of friction that the ball uses by default",
     [](const CatalogueEntry& of) -> Json { return own_law(of).name(); }},
    {"radius", "m", "radius of the ball", [](const CatalogueEntry& of) -> Json { return of.experiment.ball.radius; }},
    {"mass", "kg", "mass of the ball", [](const CatalogueEntry& of) -> Json { return of.experiment.ball.mass; }},
    {"friction", "", "coefficient of friction",
     [](const CatalogueEntry& of) -> Json { return of.experiment.contact.friction; }},
    {"patch_radius", "m", "radius of the patch",
     [](const CatalogueEntry& of) -> Json { return si::patch_radius_of(of.experiment, own_law(of)); }},
    {"mu", "", "radius of the patch divided by radius of the ball",
     [](const CatalogueEntry& of) -> Json { return si::patch_ratio(of.experiment, own_law(of)); }},
    {"slip", "m/s", "slip at a typical start",
     [](const CatalogueEntry& of) -> Json { return si::slip_at_start(of.experiment); }},
    {"spin", "1/s", "spin at a typical start",
     [](const CatalogueEntry& of) -> Json { return si::spin_at_start(of.experiment); }},
    {"gravity", "m/s^2", "acceleration of gravity",
     [](const CatalogueEntry& of) -> Json { return of.experiment.environment.gravity; }},
    {"sources", "", "sources of these numbers",
     [](const CatalogueEntry& of) -> Json {
       std::string sources = of.sources;
       std::ranges::replace(sources, '\n', ' ');
       return sources;
     }},
};

Answer list() {
  Answer answer = answer_of_rows("balls", ball_fields, si::catalogue());
  answer.beside = {"description", "sources"};
  answer.text = [rows = answer.rows](const Digits& digits) {
    TextTable table({TextTable::left(15), TextTable::left(29)});
    for (const Json& ball : rows) {
      const auto word = [&](const char* name) { return ball[name].get<std::string>(); };
      table.add({word("name"), word("description"), "mu = " + digits(ball["mu"])});
      std::string sources = help_paragraph(word("sources"), 15);
      sources.pop_back();  // removes the line end
      table.add({sources});
    }
    return table.text();
  };
  return answer;
}

std::vector<FieldText> balls_texts() { return texts_of_rows("balls", ball_fields); }

class BallsCommand final : public Verb {
 public:
  void add_options(CLI::App& app) override {
    ball_.add(app, "NAME", "", "ball that is printed as a run file (default: list of all balls)", find);
    output_.add(app);
  }

  ExitStatus run() override {
    if (!ball_.given()) return output_.read().write(list());
    const Argument& format = output_.format_argument();
    if (format.given() && format.text() != "text" && format.text() != "toml") {
      format.reject("a run file is text: leave it out");
    }
    const CatalogueEntry& entry = **ball_;
    return output_.read(1).write(si::run_file(entry.experiment, entry.sources));
  }

 private:
  static const CatalogueEntry* find(const std::string& name) {
    if (!names_a_file(name, {".toml"})) return &require_ball(name);
    throw NotAllowed(
        "balls takes no file, only a name: 'contensou balls' lists them; 'contensou stop --ball FILE' uses a file");
  }

  ArgumentOf<const CatalogueEntry*> ball_;
  OutputOptions output_{{{"a list of balls", answer_formats("text")}, {"a run file", {"toml", "text"}}}};
};

const RegisteredVerb<BallsCommand> balls_verb(Purpose::bodies, "balls",
                                              "List the built-in balls, or print one as a run file",
                                              "contensou balls pool -o pool.toml", {{"", balls_texts}},
                                              {"slip", "spin", "patch", "run file"});

}  // namespace

}  // namespace contensou::program
