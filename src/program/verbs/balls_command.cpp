#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "contensou/si/bridge.hpp"
#include "contensou/si/catalogue.hpp"
#include "contensou/si/run_file.hpp"
#include "options/output_options.hpp"
#include "options/start_options.hpp"
#include "output/columns.hpp"
#include "output/json.hpp"
#include "verb.hpp"

namespace contensou::program {

namespace {

using si::CatalogueEntry;

std::string on_one_line(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  return text;
}

std::string as_text(int digits) {
  std::string text;
  for (const CatalogueEntry& entry : si::catalogue()) {
    text += fmt::format("{:<9}{:<29}mu = {:<{}.{}g}{}\n", entry.name, entry.shot.ball.name, si::patch_ratio(entry.shot),
                        digits + 7, digits, on_one_line(entry.sources));
  }
  return text;
}

/// The numbers of an entry, each with its name.
std::vector<std::pair<std::string, double>> numbers(const CatalogueEntry& entry) {
  const auto& [ball, contact, start, environment] = entry.shot;
  return {{"radius", ball.radius},
          {"mass", ball.mass},
          {"friction", contact.friction},
          {"patch_radius", si::patch_radius_of(entry.shot)},
          {"mu", si::patch_ratio(entry.shot)},
          {"slip", si::slip_at_start(entry.shot)},
          {"spin", si::spin_at_start(entry.shot)},
          {"gravity", environment.gravity}};
}

std::string as_csv() {
  std::string text;
  for (const CatalogueEntry& entry : si::catalogue()) {
    std::vector<std::string> names{"name", "description"};
    std::vector<std::string> values{entry.name, entry.shot.ball.name};
    for (const auto& [name, value] : numbers(entry)) {
      names.push_back(name);
      values.push_back(fmt::format("{}", value));
    }
    names.emplace_back("sources");
    values.push_back(on_one_line(entry.sources));
    if (text.empty()) text = csv_line(names);
    text += csv_line(values);
  }
  return text;
}

std::string as_json() {
  std::vector<std::string> balls;
  for (const CatalogueEntry& entry : si::catalogue()) {
    JsonObject ball;
    ball.add("name", json(entry.name)).add("description", json(entry.shot.ball.name));
    for (const auto& [name, value] : numbers(entry)) ball.add(name, json(value));
    balls.push_back(ball.add("sources", json(on_one_line(entry.sources))).inline_text());
  }
  return JsonObject::document().add("balls", json_array(balls)).text();
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
      output_.read(1).write(si::run_file(entry.shot, entry.sources));
    } else {
      output_.read().write_as(as_text, as_csv, as_json);
    }
    return ExitStatus::done;
  }

 private:
  static const CatalogueEntry* find(const std::string& name) {
    const bool is_file = name.find('/') != std::string::npos || name.ends_with(".toml");
    if (!is_file) return &require_ball(name);
    throw NotAllowed(
        "balls takes no file, only a name: 'contensou balls' lists them; 'contensou stop --ball FILE' uses a file");
  }

  ArgumentOf<const CatalogueEntry*> ball_;
  OutputOptions output_{
      {{"a list of balls", {"text", "csv", "json"}, "text"}, {"a run file", {"toml", "text"}, "toml"}}};
};

const RegisteredVerb<BallsCommand> registered("balls",
                                              "The built-in balls and their sources, or one of them as a run file",
                                              "contensou balls pool -o pool.toml");

}  // namespace

}  // namespace contensou::program
