#include "answers/verbs/engine_answer.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "answers/input/parse.hpp"
#include "answers/table/text_table.hpp"

namespace contensou::answers {

using si::Engine;

namespace {

/// A contact under a setting of an engine, or, without a setting, under the law of the body.
struct Contact {
  std::string label;
  std::string cone;
  double moment_arm;  ///< largest moment divided by the load, m
  si::FadeTimes fade;
};

/// An engine with its settings for a ball, or for a body that lies flat.
struct EngineWithBall {
  const Engine* engine;
  const si::EngineUse* use;
  si::EngineContact contact;
  std::vector<Contact> settings;
};

struct Report {
  si::Experiment experiment;
  reduction::Law law;
  si::EngineContact contact;
  Contact own;
  std::vector<EngineWithBall> engines;
};

EngineWithBall with_ball(const Engine& engine, const si::Experiment& experiment, const si::EngineContact& contact) {
  const si::EngineUse& use = engine.use_of(experiment.ball.body);
  EngineWithBall result{&engine, &use, contact, {}};
  for (const auto& [words, cone, moment_arm, friction_share] : use.settings) {
    const double arm = moment_arm(contact);
    si::Experiment there = experiment;
    there.contact.friction *= friction_share;
    result.settings.push_back(
        {std::string(words), std::string(arm > 0 ? si::name(cone) : "none"), arm, si::fade_times(there, cone, arm)});
  }
  return result;
}

/// Returns the load in N.
double load_of(const si::Experiment& experiment) {
  return experiment.environment.load.value_or(experiment.ball.mass * experiment.environment.gravity);
}

/// Returns a text on one line.
std::string line_of(std::string_view text) {
  std::string line(text);
  std::ranges::replace(line, '\n', ' ');
  return line;
}

Json list_of_texts(const std::vector<std::string_view>& texts) {
  Json list = Json::array();
  for (std::string_view text : texts) list.push_back(line_of(text));
  return list;
}

constexpr Field<Contact> setting_fields[]{
    {"setting", "", "setting of the engine in words; the setting nearest to the law comes first",
     [](const Contact& of) -> Json { return of.label; }},
    {"cone", "",
     "rule that limits force F and moment M, with F0 and M0 the limits of each alone: elliptic (F/F0)^2 + (M/M0)^2 <= 1, box "
     "F <= F0 and M <= M0, pyramid F/F0 + M/M0 <= 1; or points (friction at a few points), none",
     [](const Contact& of) -> Json { return of.cone; }},
    {"moment_arm", "m", "largest moment of friction in the engine divided by the load",
     [](const Contact& of) -> Json { return of.moment_arm; }},
    {"t_slip", "s", "time until 1e-3 of the slip is left, in the engine",
     [](const Contact& of) -> Json { return of.fade.slip; }},
    {"t_spin", "s", "time until 1e-3 of the spin is left, in the engine",
     [](const Contact& of) -> Json { return of.fade.spin; }},
    {"slip_length", "m", "distance that the contact point slides, in the engine",
     [](const Contact& of) -> Json { return of.fade.slip_length; }},
    {"turns", "", "number of turns about the vertical, in the engine",
     [](const Contact& of) -> Json { return of.fade.turns; }},
};

constexpr Field<EngineWithBall> name_fields[]{
    {"name", "", "name of the engine, as in the argument NAME",
     [](const EngineWithBall& of) -> Json { return of.engine->name; }, "engine"},
};
constexpr Field<EngineWithBall> moment_fields[]{
    {"", "", "name and value of the parameter that sets the moment",
     [](const EngineWithBall& of) {
       const auto& all = of.use->parameters;
       return all.empty() ? Json::array({"", ""}) : Json::array({all.back().name, all.back().value(of.contact)});
     },
     "parameter,value"},
};
constexpr Field<EngineWithBall> text_fields[]{
    {"title", "", "full name of the engine", [](const EngineWithBall& of) -> Json { return of.engine->title; }, ""},
    {"repository", "", "repository of the engine on github.com",
     [](const EngineWithBall& of) -> Json { return of.engine->repository; }, ""},
    {"version", "", "version of the engine whose source was read",
     [](const EngineWithBall& of) -> Json { return of.engine->version; }, ""},
    {"parameters", "", "parameters to type into the engine; the last one sets the moment of friction",
     [](const EngineWithBall& of) {
       Json parameters = Json::object();
       for (const auto& [name, unit, value] : of.use->parameters) {
         parameters[std::string(name)] = {{"value", value(of.contact)}, {"unit", unit}, {"formula", value.formula()}};
       }
       return parameters;
     },
     "", 0, " {NAME {`value`, `unit`, `formula`}}"},
    {"limit", "", "rule by which the engine limits the moment of friction",
     [](const EngineWithBall& of) -> Json { return of.use->limit; }, ""},
    {"combination", "", "rule by which the engine makes one number from the numbers of two bodies in contact",
     [](const EngineWithBall& of) -> Json { return of.engine->combination; }, ""},
    {"needs", "", "further settings; without them the engine ignores the parameters",
     [](const EngineWithBall& of) { return list_of_texts(of.use->needs); }, ""},
    {"settings", "",
     "list of settings of the engine, each with setting, cone, moment_arm, t_slip, t_spin, slip_length, turns; one row "
     "of CSV each. Empty if the engine does not support a flat body",
     [](const EngineWithBall& of) {
       Json settings = Json::array();
       for (const Contact& setting : of.settings) settings.push_back(members_of(setting_fields, setting));
       return settings;
     },
     "", 0, " [...]"},
    {"remarks", "", "known faults of the engine",
     [](const EngineWithBall& of) { return list_of_texts(of.engine->remarks); }, ""},
    {"sources", "", "sources of the statements on the engine",
     [](const EngineWithBall& of) { return list_of_texts(of.engine->sources); }, ""},
};

Json members_of_engine(const EngineWithBall& engine) {
  Json members = members_of(name_fields, engine);
  members.update(members_of(text_fields, engine));
  return members;
}

constexpr Field<Report> report_fields[]{
    {"law", "", "name of the law of friction", [](const Report& r) -> Json { return r.law.name(); }},
    {"ball", "", "name of the ball", [](const Report& r) -> Json { return r.experiment.ball.name; }, ""},
    {"body", "", "kind of body: ball, hollow-ball, disc, puck or ring",
     [](const Report& r) -> Json { return r.experiment.ball.body.name; }, ""},
    {"radius", "m", "radius of the ball", [](const Report& r) -> Json { return r.contact.radius; }, ""},
    {"mass", "kg", "mass of the ball", [](const Report& r) -> Json { return r.experiment.ball.mass; }, ""},
    {"load", "N", "normal force on the plane", [](const Report& r) -> Json { return load_of(r.experiment); }, ""},
    {"friction", "", "coefficient of friction f", [](const Report& r) -> Json { return r.contact.friction; }, ""},
    {"patch_radius", "m", "patch radius a", [](const Report& r) -> Json { return r.contact.patch_radius; }, ""},
    {"pivoting_moment", "",
     "Psi(0): moment of friction while the ball spins without sliding, divided by f, load and patch radius",
     [](const Report& r) -> Json { return r.contact.pivoting_moment; }, ""},
    {"moment_arm", "m", "f a Psi(0): moment of friction while the ball spins without sliding, divided by the load",
     [](const Report& r) -> Json { return r.own.moment_arm; }, ""},
    {"slip", "m/s", "slip at the start", [](const Report& r) -> Json { return si::slip_at_start(r.experiment); }, ""},
    {"spin", "1/s", "spin at the start", [](const Report& r) -> Json { return si::spin_at_start(r.experiment); }, ""},
    {"t_slip", "s", "time until 1e-3 of the slip is left, under the law",
     [](const Report& r) -> Json { return r.own.fade.slip; }, "law_t_slip"},
    {"t_spin", "s", "time until 1e-3 of the spin is left, under the law",
     [](const Report& r) -> Json { return r.own.fade.spin; }, "law_t_spin"},
    {"slip_length", "m", "distance that the contact point slides, under the law",
     [](const Report& r) -> Json { return r.own.fade.slip_length; }, "law_slip_length"},
    {"turns", "", "number of turns about the vertical, under the law",
     [](const Report& r) -> Json { return r.own.fade.turns; }, "law_turns"},
    {"engines", "", "list of the engines, each with the fields from name to sources",
     [](const Report& r) {
       Json engines = Json::array();
       for (const EngineWithBall& engine : r.engines) engines.push_back(members_of_engine(engine));
       return engines;
     },
     "", 0, " [...]"},
};

/// Explanation that is printed below the tables.
constexpr const char* explanation =
    "slip, spin   s until 1e-3 of what they were at the start is left (roll: 'rolls after' --rolling-below 1 mm/s)\n"
    "slid, turns  m that the contact slides, and turns about the vertical, until they have ended\n"
    "cone         of force F and moment M: elliptic (F/F0)^2 + (M/M0)^2 <= 1; box F <= F0, M <= M0, as if neither\n"
    "             knew of the other; pyramid F/F0 + M/M0 <= 1, where either slip or spin is braked; points: friction\n"
    "             at each of a few contact points, averaged over a turn\n";

constexpr const char* not_read = "has no body that lies flat, or was not read for it";

std::string heading(const Report& report, const Digits& digits) {
  const auto& [experiment, law, contact, own, engines] = report;
  return fmt::format(
      "{}: radius {} m, mass {} kg, load {} N, friction f = {}, patch radius a = {} m\n"
      "start: slip {} m/s, spin {} rad/s\n"
      "spinning without sliding, law {}: moment = f a Psi(0) load, Psi(0) = {}, f a Psi(0) = {} m\n",
      experiment.ball.name, digits(contact.radius), digits(experiment.ball.mass), digits(load_of(experiment)),
      digits(contact.friction), digits(contact.patch_radius), digits(si::slip_at_start(experiment)),
      digits(si::spin_at_start(experiment)), law.name(), digits(contact.pivoting_moment), digits(own.moment_arm));
}

std::string typed_in(const si::EngineParameter& parameter, const si::EngineContact& contact, const Digits& digits) {
  const auto& [name, unit, value] = parameter;
  return fmt::format("{} = {}{}{}", name, digits(value(contact)), unit.empty() ? "" : " ", unit);
}

std::string text_of_all(const Report& report, const Digits& digits) {
  const TextTable::Column number = TextTable::right(digits.width());
  TextTable table({TextTable::left(10), TextTable::left(50), TextTable::left(10), number, number, number, number});
  const auto add = [&](std::string_view name, const std::string& parameter, const Contact& of) {
    table.add({std::string(name), parameter, of.cone, digits(of.fade.slip), digits(of.fade.spin),
               digits(of.fade.slip_length), digits(of.fade.turns)});
  };
  table.add({"engine", "type in", "cone", "slip (s)", "spin (s)", "slid (m)", "turns"});
  add(fmt::format("the {}", report.experiment.ball.body.name), report.own.label, report.own);
  for (const auto& [engine, use, contact, settings] : report.engines) {
    if (settings.empty()) {
      table.add({std::string(engine->name), not_read});
    } else {
      const auto& all = use->parameters;
      add(engine->name, all.empty() ? "-" : typed_in(all.back(), contact, digits), settings.front());
    }
  }
  return fmt::format(
      "\n{}\n{}\n'contensou engine NAME --ball B' says what else an engine needs, what its defaults do, and where it "
      "says "
      "so.\n",
      table.text(), explanation);
}

/// Returns texts of several lines with a label to the left of them.
std::string block(std::string label, const std::vector<std::string>& texts) {
  TextTable table({TextTable::left(10)});
  for (const std::string& text : texts) {
    for (std::string& line : split(text, '\n')) table.add({std::exchange(label, ""), std::move(line)});
  }
  return table.text();
}

std::string text_of(const EngineWithBall& of, const Report& report, const Digits& digits) {
  const Engine& engine = *of.engine;
  const Contact& own = report.own;
  std::string text = fmt::format("\n{}: github.com/{}, {}\n\n", engine.title, engine.repository, engine.version);
  std::vector<std::string> lines;
  for (const si::EngineParameter& parameter : of.use->parameters) {
    lines.push_back(fmt::format("{}   ({})", typed_in(parameter, of.contact, digits), parameter.value.formula()));
  }
  if (lines.empty()) lines.emplace_back(of.settings.empty() ? not_read : "nothing: it has no such number");
  text += block("type in", lines);
  if (!of.use->limit.empty()) text += block("limit", {std::string(of.use->limit)});
  text += block("combines", {std::string(engine.combination)}) +
          block("needs", {of.use->needs.begin(), of.use->needs.end()});

  const TextTable::Column number = TextTable::right(digits.width());
  TextTable table(
      {TextTable::left(44), TextTable::left(9), number, TextTable::right(10), number, number, number, number});
  table.add({"", "cone", "moment/load", "times", "slip (s)", "spin (s)", "slid (m)", "turns"});
  const auto add = [&](const Contact& contact) {
    table.add({contact.label, contact.cone, digits(contact.moment_arm),
               fmt::format("{:.3g}", contact.moment_arm / own.moment_arm), digits(contact.fade.slip),
               digits(contact.fade.spin), digits(contact.fade.slip_length), digits(contact.fade.turns)});
  };
  Contact ball = own;
  ball.label = fmt::format("the {}, {}", report.experiment.ball.body.name, own.label);
  add(ball);
  for (const Contact& setting : of.settings) add(setting);
  return fmt::format("{}\n{}\n{}times        this moment over that of the law\n\n{}{}", text, table.text(), explanation,
                     block("beware", {engine.remarks.begin(), engine.remarks.end()}),
                     block("source", {engine.sources.begin(), engine.sources.end()}));
}

}  // namespace

Answer engine_answer(const si::Experiment& experiment, const reduction::Law& law, const Engine* only) {
  si::mass_for("engine", experiment.ball);
  const si::EngineContact contact = si::contact_of(experiment, law);
  Report report{
      experiment, law, contact, {"law " + law.name(), "", contact.moment_arm(), si::fade_times(experiment, law)}, {}};
  for (const Engine& engine : si::engines()) {
    if (only == nullptr || &engine == only) report.engines.push_back(with_ball(engine, experiment, contact));
  }
  Answer answer{.members = members_of(report_fields, report)};
  for (const EngineWithBall& engine : report.engines) {
    for (const Contact& setting : engine.settings) {
      Json& row = answer.rows.emplace_back(row_of(name_fields, engine));
      row.update(row_of(setting_fields, setting));
      row.update(row_of(moment_fields, engine));
      row.update(row_of(report_fields, report));
    }
  }
  answer.text = [report = std::move(report), only](const Digits& digits) {
    return heading(report, digits) +
           (only ? text_of(report.engines.front(), report, digits) : text_of_all(report, digits));
  };
  return answer;
}

std::vector<FieldText> engine_fields() {
  return joined({texts_of(report_fields), texts_of(name_fields), texts_of(text_fields), texts_of(moment_fields),
                 texts_of(setting_fields)});
}

}  // namespace contensou::answers
