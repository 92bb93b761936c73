#include <algorithm>

#include <fmt/format.h>

#include "contensou/si/engine.hpp"
#include "options/law_option.hpp"
#include "options/output_options.hpp"
#include "options/start_options.hpp"
#include "verb.hpp"

namespace contensou::program {

namespace {

using si::Engine;

/// On one line.
std::string line_of(std::string_view text) {
  std::string line(text);
  std::ranges::replace(line, '\n', ' ');
  return line;
}

template <class Texts>
Json list_of(const Texts& texts) {
  Json list = Json::array();
  for (const auto& text : texts) list.push_back(line_of(text));
  return list;
}

/// A ball as engines see it, under the law that their numbers are to stand for.
struct Asked {
  si::Experiment experiment;
  reduction::Law law;
  si::EngineContact contact{si::contact_of(experiment, law)};
  si::FadeTimes fades{si::fade_times(experiment, law)};

  Json members_of(const Engine& engine) const {
    Json parameters = Json::object();
    for (const auto& [name, unit, formula, value] : engine.parameters)
      parameters[std::string(name)] = {{"value", value(contact)}, {"unit", unit}, {"formula", formula}};
    Json settings = Json::array();
    for (const auto& [words, cone, moment_arm] : engine.settings) {
      const double arm = moment_arm(contact);
      const auto [slip, spin] = si::fade_times(experiment, cone, arm);
      settings.push_back({{"setting", words},
                          {"cone", arm > 0 ? si::name(cone) : "none"},
                          {"moment_arm", arm},
                          {"t_slip", slip},
                          {"t_spin", spin}});
    }
    return {{"name", engine.name},
            {"title", engine.title},
            {"version", engine.version},
            {"parameters", parameters},
            {"limit", engine.limit},
            {"combination", engine.combination},
            {"needs", list_of(engine.needs)},
            {"settings", settings},
            {"remarks", list_of(engine.remarks)},
            {"sources", list_of(engine.sources)}};
  }

  Json members() const {
    return {{"law", law.name()},
            {"ball", experiment.ball.name},
            {"friction", contact.friction},
            {"patch_radius", contact.patch_radius},
            {"pivoting_moment", contact.pivoting_moment},
            {"moment_arm", contact.moment_arm()},
            {"slip", si::slip_at_start(experiment)},
            {"spin", si::spin_at_start(experiment)},
            {"t_slip", fades.slip},
            {"t_spin", fades.spin}};
  }

  std::string heading(const Digits& digits) const {
    return fmt::format(
        "{}: radius {} m, friction f = {}, patch radius a = {} m, slip {} m/s, spin {} rad/s\n"
        "spinning without sliding, law {}: moment = f a Psi(0) load, Psi(0) = {}, f a Psi(0) = {} m\n",
        experiment.ball.name, digits(experiment.ball.radius), digits(contact.friction), digits(contact.patch_radius),
        digits(si::slip_at_start(experiment)), digits(si::spin_at_start(experiment)), law.name(),
        digits(contact.pivoting_moment), digits(contact.moment_arm()));
  }
};

/// Below the tables.
constexpr const char* explanation =
    "slip, spin   s until 1e-3 of what they were at the start is left\n"
    "cone         of force F and moment M: elliptic (F/F0)^2 + (M/M0)^2 <= 1; box F <= F0, M <= M0, as if neither\n"
    "             knew of the other; pyramid F/F0 + M/M0 <= 1, where either slip or spin is braked\n";

std::string number(const Json& value, const Digits& digits) { return digits(value.get<double>()); }

/// What a line of a table says of a setting: its times, and its moment as a multiple of the ball's own.
std::string times(const Json& setting, const Digits& digits) {
  return fmt::format("{:>{}}{:>{}}\n", number(setting["t_slip"], digits), digits.width(),
                     number(setting["t_spin"], digits), digits.width());
}

std::string typed_in(const std::string& name, const Json& parameter, const Digits& digits) {
  const std::string unit = parameter["unit"];
  return fmt::format("{} = {}{}{}", name, number(parameter["value"], digits), unit.empty() ? "" : " ", unit);
}

std::string text_of_all(const Json& members, const Digits& digits) {
  constexpr int width = 50;
  std::string text = fmt::format("\n{:<10}{:<{}}{:<10}{:>{}}{:>{}}\n{:<10}{:<{}}{:<10}", "engine", "type in", width,
                                 "cone", "slip (s)", digits.width(), "spin (s)", digits.width(), "the ball", "", width,
                                 members["law"].get<std::string>()) +
                     times(members, digits);
  for (const Json& engine : members["engines"]) {
    std::string parameter = "-";
    if (const Json& all = engine["parameters"]; !all.empty())
      parameter = typed_in(std::prev(all.end()).key(), all.back(), digits);
    const Json& setting = engine["settings"][0];
    text += fmt::format("{:<10}{:<{}}{:<10}", engine["name"].get<std::string>(), parameter, width,
                        setting["cone"].get<std::string>()) +
            times(setting, digits);
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
  std::string text = fmt::format("\n{}, {}\n\n", engine.title, engine.version);
  std::vector<std::string> lines;
  for (const auto& [name, parameter] : of_engine["parameters"].items())
    lines.push_back(
        fmt::format("{}   ({})", typed_in(name, parameter, digits), parameter["formula"].get<std::string>()));
  if (lines.empty()) lines.emplace_back("nothing: it has no such number");
  text += block("type in", lines) + block("limit", {std::string(engine.limit)}) +
          block("combines", {std::string(engine.combination)}) +
          block("needs", {engine.needs.begin(), engine.needs.end()});

  constexpr int width = 44;
  const int digit_width = digits.width();
  text += fmt::format("\n{:<{}}{:<9}{:>{}}{:>8}{:>{}}{:>{}}\n", "", width, "cone", "moment/load", digit_width, "times",
                      "slip (s)", digit_width, "spin (s)", digit_width);
  const double arm = members["moment_arm"];
  const auto line = [&](const std::string& label, const std::string& cone, const Json& of_line) {
    const double its_arm = of_line["moment_arm"];
    text += fmt::format("{:<{}}{:<9}{:>{}}{:>8.3g}", label, width, cone, digits(its_arm), digit_width, its_arm / arm) +
            times(of_line, digits);
  };
  line("the ball, law " + members["law"].get<std::string>(), "", members);
  for (const Json& setting : of_engine["settings"]) line(setting["setting"], setting["cone"], setting);
  text += "\n" + std::string(explanation) + "times        this moment over the ball's\n\n";
  return text + block("beware", {engine.remarks.begin(), engine.remarks.end()}) +
         block("source", {engine.sources.begin(), engine.sources.end()});
}

/// Of one engine, or of all.
Answer answer_of(const Asked& asked, const Engine* only) {
  Answer answer;
  answer.members = asked.members();
  for (const Engine& engine : si::engines()) {
    if (only != nullptr && &engine != only) continue;
    const Json of_engine = asked.members_of(engine);
    answer.members["engines"].push_back(of_engine);
    const Json& parameters = of_engine["parameters"];
    for (const Json& setting : of_engine["settings"]) {
      Json row{{"engine", engine.name}};
      row.update(setting);
      row["parameter"] = parameters.empty() ? "" : std::prev(parameters.end()).key();
      row["value"] = parameters.empty() ? Json("") : parameters.back()["value"];
      row["law"] = {{"law", asked.law.name()}, {"law_t_slip", asked.fades.slip}, {"law_t_spin", asked.fades.spin}};
      answer.rows.push_back(row);
    }
  }
  answer.text = [asked, only, members = answer.members](const Digits& digits) {
    return asked.heading(digits) + (only ? text_of(*only, members, digits) : text_of_all(members, digits));
  };
  return answer;
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
    const reduction::Law law = law_.read();
    const Asked asked{start_.read_ball(law), law};
    output_.read().write(answer_of(asked, engine_.given() ? *engine_ : nullptr));
    return ExitStatus::done;
  }

 private:
  static const Engine* find(const std::string& name) {
    if (const Engine* engine = si::find_engine(name)) return engine;
    std::vector<std::string> names;
    for (const Engine& engine : si::engines()) names.emplace_back(engine.name);
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
