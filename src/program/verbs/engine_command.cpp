#include <cstdio>

#include <fmt/format.h>

#include "answers/engine_members.hpp"
#include "options/law_option.hpp"
#include "options/output_options.hpp"
#include "options/start_options.hpp"
#include "verb.hpp"

namespace contensou::program {

namespace {

using si::Engine;

/// Below the tables.
constexpr const char* explanation =
    "slip, spin   s until 1e-3 of what they were at the start is left (roll: 'rolls after' --rolling-below 1 mm/s)\n"
    "slid, turns  m that the contact slides, and turns about the vertical, until they have ended\n"
    "cone         of force F and moment M: elliptic (F/F0)^2 + (M/M0)^2 <= 1; box F <= F0, M <= M0, as if neither\n"
    "             knew of the other; pyramid F/F0 + M/M0 <= 1, where either slip or spin is braked; points: friction\n"
    "             at each of a few contact points, averaged over a turn\n";

std::string shown(const Json& value, const Digits& digits) { return digits(value.get<double>()); }

std::string heading(const Json& members, const Digits& digits) {
  const auto of = [&](const char* name) { return shown(members[name], digits); };
  return fmt::format(
      "{}: radius {} m, mass {} kg, load {} N, friction f = {}, patch radius a = {} m\n"
      "start: slip {} m/s, spin {} rad/s\n"
      "spinning without sliding, law {}: moment = f a Psi(0) load, Psi(0) = {}, f a Psi(0) = {} m\n",
      members["ball"].get<std::string>(), of("radius"), of("mass"), of("load"), of("friction"), of("patch_radius"),
      of("slip"), of("spin"), members["law"].get<std::string>(), of("pivoting_moment"), of("moment_arm"));
}

/// The end of a line of a table.
std::string end_of_line(const Json& setting, const Digits& digits) {
  std::string line;
  for (const char* name : {"t_slip", "t_spin", "slip_length", "turns"})
    line += fmt::format("{:>{}}", shown(setting[name], digits), digits.width());
  return line + "\n";
}

std::string headings_of_end(const Digits& digits) {
  std::string line;
  for (const char* name : {"slip (s)", "spin (s)", "slid (m)", "turns"})
    line += fmt::format("{:>{}}", name, digits.width());
  return line + "\n";
}

std::string the_body(const Json& members) { return "the " + members["body"].get<std::string>(); }

constexpr const char* not_read = "has no body that lies flat, or was not read for it";

std::string typed_in(const std::string& name, const Json& parameter, const Digits& digits) {
  const std::string unit = parameter["unit"];
  return fmt::format("{} = {}{}{}", name, shown(parameter["value"], digits), unit.empty() ? "" : " ", unit);
}

std::string text_of_all(const Json& members, const Digits& digits) {
  constexpr int width = 50;
  std::string text =
      fmt::format("\n{:<10}{:<{}}{:<10}", "engine", "type in", width, "cone") + headings_of_end(digits) +
      fmt::format("{:<10}{:<{}}{:<10}", the_body(members), "law " + members["law"].get<std::string>(), width, "") +
      end_of_line(members, digits);
  for (const Json& engine : members["engines"]) {
    std::string parameter = "-";
    if (const Json& all = engine["parameters"]; !all.empty())
      parameter = typed_in(std::prev(all.end()).key(), all.back(), digits);
    if (engine["settings"].empty()) {
      text += fmt::format("{:<10}{}\n", engine["name"].get<std::string>(), not_read);
      continue;
    }
    const Json& setting = engine["settings"][0];
    text += fmt::format("{:<10}{:<{}}{:<10}", engine["name"].get<std::string>(), parameter, width,
                        setting["cone"].get<std::string>()) +
            end_of_line(setting, digits);
  }
  return text + "\n" + explanation +
         "\n'contensou engine NAME --ball B' says what else an engine needs, what its defaults do, and where it says "
         "so.\n";
}

/// Texts of several lines below a name.
std::string block(const std::string& label, const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) {
    all += fmt::format("{:<10}", all.empty() ? label : "");
    for (char letter : text) all += letter == '\n' ? "\n" + std::string(10, ' ') : std::string(1, letter);
    all += '\n';
  }
  return all;
}

std::string text_of(const Engine& engine, const Json& members, const Digits& digits) {
  const Json& of_engine = members["engines"][0];
  std::string text = fmt::format("\n{}: github.com/{}, {}\n\n", engine.title, engine.repository, engine.version);
  std::vector<std::string> lines;
  for (const auto& [name, parameter] : of_engine["parameters"].items())
    lines.push_back(
        fmt::format("{}   ({})", typed_in(name, parameter, digits), parameter["formula"].get<std::string>()));
  const si::EngineUse& use = members["body"] == "ball" ? engine.ball : engine.face;
  if (lines.empty()) lines.emplace_back(use.settings.empty() ? not_read : "nothing: it has no such number");
  text += block("type in", lines);
  if (!use.limit.empty()) text += block("limit", {std::string(use.limit)});
  text += block("combines", {std::string(engine.combination)}) + block("needs", {use.needs.begin(), use.needs.end()});

  constexpr int width = 44;
  const int digit_width = digits.width();
  text += fmt::format("\n{:<{}}{:<9}{:>{}}{:>10}", "", width, "cone", "moment/load", digit_width, "times") +
          headings_of_end(digits);
  const double arm = members["moment_arm"];
  const auto line = [&](const std::string& label, const std::string& cone, const Json& of_line) {
    const double its_arm = of_line["moment_arm"];
    text += fmt::format("{:<{}}{:<9}{:>{}}{:>10.3g}", label, width, cone, digits(its_arm), digit_width, its_arm / arm) +
            end_of_line(of_line, digits);
  };
  line(the_body(members) + ", law " + members["law"].get<std::string>(), "", members);
  for (const Json& setting : of_engine["settings"]) line(setting["setting"], setting["cone"], setting);
  text += "\n" + std::string(explanation) + "times        this moment over that of the law\n\n";
  return text + block("beware", {engine.remarks.begin(), engine.remarks.end()}) +
         block("source", {engine.sources.begin(), engine.sources.end()});
}

/// Of one engine, or of all.
Answer answer_of(const Json& members, const Engine* only) {
  std::vector<Json> rows;
  for (const Json& engine : members["engines"]) {
    const Json& parameters = engine["parameters"];
    for (const Json& setting : engine["settings"]) {
      Json row{{"engine", engine["name"]}};
      row.update(setting);
      row["parameter"] = parameters.empty() ? "" : std::prev(parameters.end()).key();
      row["value"] = parameters.empty() ? Json("") : parameters.back()["value"];
      row.update({{"law", members["law"]},
                  {"law_t_slip", members["t_slip"]},
                  {"law_t_spin", members["t_spin"]},
                  {"law_slip_length", members["slip_length"]},
                  {"law_turns", members["turns"]}});
      rows.push_back(row);
    }
  }
  return {.members = members, .rows = rows, .text = [=](const Digits& digits) {
            return heading(members, digits) + (only ? text_of(*only, members, digits) : text_of_all(members, digits));
          }};
}

class EngineCommand final : public Verb {
 public:
  void add_options(CLI::App& app) override {
    engine_.add(app, "NAME", "", "of the engine, for all that is known of it; without, a line for each", find);
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
    output_.read().write(answer_of(engine_members(start_.read_ball(law), law, only), only));
    return ExitStatus::done;
  }

 private:
  static const Engine* find(const std::string& name) {
    if (const Engine* engine = si::find_engine(name)) return engine;
    std::vector<std::string> names;
    for (const Engine& engine : si::engines()) names.emplace_back(engine.name);
    for (const si::EngineAlias& alias : si::engine_aliases()) names.emplace_back(alias.name);
    throw no_such("engine", name, names);
  }

  ArgumentOf<const Engine*> engine_;
  StartOptions start_;
  LawOption law_;
  OutputOptions output_{{{"a table of engines", answer_formats("text")}}};
};

const RegisteredVerb<EngineCommand> engine_verb(
    "engine", "What to type into a physics engine for torsional friction, and what that does",
    "contensou engine mujoco --ball pool");

}  // namespace

}  // namespace contensou::program
