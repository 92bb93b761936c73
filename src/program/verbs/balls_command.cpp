#include <algorithm>

#include <fmt/format.h>

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

Json row_of(const CatalogueEntry& entry) {
  const auto& [ball, contact, start, environment, spreads] = entry.experiment;
  const reduction::Law law = *reduction::find_law(si::law_of(entry.experiment));
  std::string sources = entry.sources;
  std::ranges::replace(sources, '\n', ' ');
  return {{"name", entry.name},
          {"description", ball.name},
          {"body", ball.body.name},
          {"law", law.name()},
          {"radius", ball.radius},
          {"mass", ball.mass},
          {"friction", contact.friction},
          {"patch_radius", si::patch_radius_of(entry.experiment, law)},
          {"mu", si::patch_ratio(entry.experiment, law)},
          {"slip", si::slip_at_start(entry.experiment)},
          {"spin", si::spin_at_start(entry.experiment)},
          {"gravity", environment.gravity},
          {"sources", sources}};
}

Answer list() {
  Answer answer;
  for (const CatalogueEntry& entry : si::catalogue()) answer.rows.push_back(row_of(entry));
  answer.members["balls"] = answer.rows;
  answer.beside = {"description", "sources"};
  answer.text = [rows = answer.rows](const Digits& digits) {
    std::string text;
    for (const Json& ball : rows) {
      const auto word = [&](const char* name) { return ball[name].get<std::string>(); };
      text += fmt::format("{:<14} {:<29}mu = {}\n", word("name"), word("description"), digits(ball["mu"]));
      text += help_paragraph(word("sources"), 15);
    }
    return text;
  };
  return answer;
}

class BallsCommand final : public Verb {
 public:
  void add_options(CLI::App& app) override {
    ball_.add(app, "NAME", "", "print this ball as a run file, to change and to give to --ball", find);
    output_.add(app);
  }

  ExitStatus run() override {
    if (ball_.given()) {
      const Argument& format = output_.format_argument();
      if (format.given() && format.text() != "text" && format.text() != "toml") {
        format.reject("a run file is text: leave it out");
      }
      const CatalogueEntry& entry = **ball_;
      output_.read(1).write(si::run_file(entry.experiment, entry.sources));
    } else {
      output_.read().write(list());
    }
    return ExitStatus::done;
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
                                              "The built-in balls and their sources, or one of them as a run file",
                                              "contensou balls pool -o pool.toml");

}  // namespace

}  // namespace contensou::program
