#include "answers/engine_members.hpp"

#include <algorithm>
#include <string>

namespace contensou::answers {

namespace {

using Json = nlohmann::ordered_json;
using si::Engine;

/// On one line.
std::string line_of(std::string_view text) {
  std::string line(text);
  std::ranges::replace(line, '\n', ' ');
  return line;
}

Json list_of(const std::vector<std::string_view>& texts) {
  Json list = Json::array();
  for (std::string_view text : texts) list.push_back(line_of(text));
  return list;
}

Json members_of(const si::FadeTimes& times) {
  return {{"t_slip", times.slip}, {"t_spin", times.spin}, {"slip_length", times.slip_length}, {"turns", times.turns}};
}

Json members_of(const Engine& engine, const si::Experiment& experiment, const si::EngineContact& contact) {
  const si::EngineUse& use = engine.use_of(experiment.ball.body);
  Json parameters = Json::object();
  for (const auto& [name, unit, formula, value] : use.parameters)
    parameters[std::string(name)] = {{"value", value(contact)}, {"unit", unit}, {"formula", formula}};
  Json settings = Json::array();
  for (const auto& [words, cone, moment_arm, friction_share] : use.settings) {
    const double arm = moment_arm(contact);
    si::Experiment there = experiment;
    there.contact.friction *= friction_share;
    Json setting{{"setting", words}, {"cone", arm > 0 ? si::name(cone) : "none"}, {"moment_arm", arm}};
    setting.update(members_of(si::fade_times(there, cone, arm)));
    settings.push_back(setting);
  }
  return {{"name", engine.name},
          {"title", engine.title},
          {"repository", engine.repository},
          {"version", engine.version},
          {"parameters", parameters},
          {"limit", use.limit},
          {"combination", engine.combination},
          {"needs", list_of(use.needs)},
          {"settings", settings},
          {"remarks", list_of(engine.remarks)},
          {"sources", list_of(engine.sources)}};
}

}  // namespace

Json engine_members(const si::Experiment& experiment, const reduction::Law& law, const Engine* only) {
  const si::EngineContact contact = si::contact_of(experiment, law);
  Json members{{"law", law.name()},
               {"ball", experiment.ball.name},
               {"body", experiment.ball.body.name},
               {"radius", contact.radius},
               {"mass", experiment.ball.mass},
               {"load", experiment.environment.load.value_or(experiment.ball.mass * experiment.environment.gravity)},
               {"friction", contact.friction},
               {"patch_radius", contact.patch_radius},
               {"pivoting_moment", contact.pivoting_moment},
               {"moment_arm", contact.moment_arm()},
               {"slip", si::slip_at_start(experiment)},
               {"spin", si::spin_at_start(experiment)}};
  members.update(members_of(si::fade_times(experiment, law)));
  members["engines"] = Json::array();
  for (const Engine& engine : si::engines()) {
    if (only == nullptr || &engine == only) members["engines"].push_back(members_of(engine, experiment, contact));
  }
  return members;
}

}  // namespace contensou::answers
