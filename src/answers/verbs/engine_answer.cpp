#include "answers/verbs/ball_answers.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "answers/input/errors.hpp"
#include "answers/input/parse.hpp"

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
  std::vector<TypedValue> typed;  ///< if there are any, the last setting has these values
};

struct Report {
  si::Experiment experiment;
  reduction::Law law;
  si::EngineContact contact;
  Contact own;
  std::vector<EngineWithBall> engines;
};

/// @param friction_share  friction in the engine divided by the intended f
Contact contact_under(std::string label, si::Cone cone, double arm, double friction_share,
                      const si::Experiment& experiment) {
  si::Experiment there = experiment;
  there.contact.friction *= friction_share;
  return {std::move(label), std::string(arm > 0 ? si::name(cone) : "none"), arm, si::fade_times(there, cone, arm)};
}

EngineWithBall with_ball(const Engine& engine, const si::Experiment& experiment, const si::EngineContact& contact,
                         const std::vector<TypedValue>& typed) {
  const si::EngineUse& use = engine.use_of(experiment.ball.body);
  EngineWithBall result{&engine, &use, contact, {}, typed};
  for (const auto& [words, cone, moment_arm, friction_share] : use.settings) {
    result.settings.push_back(contact_under(std::string(words), cone, moment_arm(contact), friction_share, experiment));
  }
  if (!typed.empty()) {
    const si::EngineSetting& nearest = use.settings.front();
    double arm = nearest.moment_arm(contact), friction_share = nearest.friction_share;
    std::vector<std::string> labels;
    for (const auto& [parameter, value] : typed) {
      const double times = value / parameter->value(contact);
      if (parameter->acts_on_force()) friction_share *= times;
      if (parameter->acts_on_moment()) arm *= times;
      labels.push_back(fmt::format("{} = {:.6g}", parameter->name, value));
    }
    result.settings.push_back(
        contact_under(fmt::format("{}", fmt::join(labels, ", ")), nearest.cone, arm, friction_share, experiment));
  }
  return result;
}

/// Returns the letters and digits of a name, in lower case.
std::string plain(std::string_view name) {
  std::string letters;
  for (const char letter : name) {
    const auto byte = static_cast<unsigned char>(letter);
    if (std::isalnum(byte) != 0) letters += static_cast<char>(std::tolower(byte));
  }
  return letters;
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
    {"setting", "",
     "setting of the engine in words; the setting nearest to the law comes first, the values of --set last",
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
    {"name", "", "name of the engine, as in the argument NAME; empty for an engine that is not known",
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
       for (const auto& [name, unit, value, acts_on] : of.use->parameters) {
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
     "of CSV each. Empty if the engine does not support this kind of body",
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
    {"load", "N", "normal force on the plane", [](const Report& r) -> Json { return r.contact.load; }, ""},
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
    "cone         bound of force F and moment M: elliptic (F/F0)^2 + (M/M0)^2 <= 1; box F <= F0, M <= M0: each has\n"
    "             its own limit; pyramid F/F0 + M/M0 <= 1: a large force leaves no moment; points: friction at each of\n"
    "             a few contact points, averaged over a turn\n";

const char* not_read(const Report& report) {
  return report.experiment.ball.body.lies_flat() ? "has no body that lies flat, or was not read for it"
                                                 : "has only bodies that lie flat";
}

std::string heading(const Report& report, const Digits& digits) {
  const auto& [experiment, law, contact, own, engines] = report;
  return fmt::format(
      "{}: radius {} m, mass {} kg, load {} N, friction f = {}, patch radius a = {} m\n"
      "start: slip {} m/s, spin {} rad/s\n"
      "spinning without sliding, law {}: moment = f a Psi(0) load, Psi(0) = {}, f a Psi(0) = {} m\n",
      experiment.ball.name, digits(contact.radius), digits(experiment.ball.mass), digits(contact.load),
      digits(contact.friction), digits(contact.patch_radius), digits(si::slip_at_start(experiment)),
      digits(si::spin_at_start(experiment)), law.name(), digits(contact.pivoting_moment), digits(own.moment_arm));
}

std::string typed_in(const si::EngineParameter& parameter, const si::EngineContact& contact, const Digits& digits) {
  const auto& [name, unit, value, acts_on] = parameter;
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
  for (const auto& [engine, use, contact, settings, typed] : report.engines) {
    if (settings.empty()) {
      table.add({std::string(engine->name), not_read(report)});
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

/// Returns sentences that compare the typed values with the right ones; empty if none was typed.
std::string text_of_typed(const EngineWithBall& of, const Report& report, const Digits& digits) {
  if (of.typed.empty()) return "";
  std::vector<std::string> values;
  for (const auto& [parameter, value] : of.typed) {
    values.push_back(fmt::format("{} = {} instead of {}{}{}", parameter->name, digits(value),
                                 digits(parameter->value(of.contact)), parameter->unit.empty() ? "" : " ",
                                 parameter->unit));
  }
  const Contact& right = of.settings.front();
  const Contact& typed = of.settings.back();
  return fmt::format(
      "\n{}:\nthe moment is {} times that of the law; the slip ends after {} s instead of {} s;\n"
      "the spin ends after {} s instead of {} s, and {} turns instead of {}\n",
      fmt::join(values, ", "), digits(typed.moment_arm / report.own.moment_arm), digits(typed.fade.slip),
      digits(right.fade.slip), digits(typed.fade.spin), digits(right.fade.spin), digits(typed.fade.turns),
      digits(right.fade.turns));
}

/// Returns the names of the known engines, in lines.
std::vector<std::string> known_engines() {
  std::vector<std::string> lines{""};
  const auto add = [&lines](std::string_view name) {
    if (lines.back().size() + name.size() > 95) lines.emplace_back();
    lines.back() += (lines.back().empty() ? "" : ", ") + std::string(name);
  };
  for (const Engine& engine : si::engines()) add(engine.name);
  for (const si::EngineAlias& alias : si::engine_aliases()) add(alias.name);
  return lines;
}

std::string text_of(const EngineWithBall& of, const Report& report, const Digits& digits) {
  const Engine& engine = *of.engine;
  const Contact& own = report.own;
  const bool known = &engine != &si::unknown_engine();
  std::string text = known ? fmt::format("\n{}: github.com/{}, {}\n", engine.title, engine.repository, engine.version)
                           : "\nThis engine is not known. Any engine needs:\n";
  text += text_of_typed(of, report, digits) + "\n";
  std::vector<std::string> lines;
  for (const si::EngineParameter& parameter : of.use->parameters) {
    lines.push_back(fmt::format("{}   ({})", typed_in(parameter, of.contact, digits), parameter.value.formula()));
  }
  if (lines.empty()) lines.emplace_back(of.settings.empty() ? not_read(report) : "nothing: it has no such number");
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
  return fmt::format(
      "{}\n{}\n{}times        moment divided by the moment of the law\n\n{}{}", text, table.text(), explanation,
      block("beware", {engine.remarks.begin(), engine.remarks.end()}),
      known ? block("source", {engine.sources.begin(), engine.sources.end()}) : block("known", known_engines()));
}

}  // namespace

TypedValue parse_typed_value(const std::string& typed, const si::EngineUse& use) {
  const std::size_t equals = typed.rfind('=');
  if (equals == std::string::npos) throw BadInput("NAME=VALUE is needed, such as spinningFriction=1.0");
  const std::string name = plain(typed.substr(0, equals));
  std::vector<const si::EngineParameter*> found;
  std::vector<std::string> names;
  for (const si::EngineParameter& parameter : use.parameters) {
    names.emplace_back(parameter.name);
    if (!name.empty() && plain(parameter.name).find(name) != std::string::npos) found.push_back(&parameter);
  }
  if (names.empty()) throw BadInput("the engine has no such number for this body");
  const auto exact = std::ranges::find_if(
      found, [&name](const si::EngineParameter* parameter) { return plain(parameter->name) == name; });
  if (exact != found.end()) found = {*exact};
  if (found.size() != 1) {
    throw BadInput("{} of the engine's parameters is called so; parameters: {}",
                   found.empty() ? "none" : "more than one", fmt::join(names, ", "));
  }
  const si::EngineParameter& parameter = *found.front();
  const double value = parse_number(typed.substr(equals + 1));
  const bool allowed = parameter.acts_on_force() ? value > 0 : value >= 0;
  if (!allowed || !std::isfinite(value)) {
    throw BadInput("{} must be {} and finite{}{}", parameter.name, parameter.acts_on_force() ? "above 0" : "0 or more",
                   parameter.unit.empty() ? "" : ", in ", parameter.unit);
  }
  return {&parameter, value};
}

Answer engine_answer(const si::Experiment& experiment, const reduction::Law& law, const Engine* only,
                     const std::vector<TypedValue>& typed) {
  si::mass_for("engine", experiment.ball);
  const si::EngineContact contact = si::contact_of(experiment, law);
  Report report{
      experiment, law, contact, {"law " + law.name(), "", contact.moment_arm(), si::fade_times(experiment, law)}, {}};
  if (only != nullptr) {
    report.engines.push_back(with_ball(*only, experiment, contact, typed));
  } else {
    for (const Engine& engine : si::engines()) report.engines.push_back(with_ball(engine, experiment, contact, {}));
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
