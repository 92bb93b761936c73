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

Json members_of(const Engine& engine, const si::Experiment& experiment, const si::EngineContact& contact) {
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
          {"repository", engine.repository},
          {"version", engine.version},
          {"parameters", parameters},
          {"limit", engine.limit},
          {"combination", engine.combination},
          {"needs", list_of(engine.needs)},
          {"settings", settings},
          {"remarks", list_of(engine.remarks)},
          {"sources", list_of(engine.sources)}};
}

}  // namespace

Json engine_members(const si::Experiment& experiment, const reduction::Law& law, const Engine* only) {
  const si::EngineContact contact = si::contact_of(experiment, law);
  const auto [slip, spin] = si::fade_times(experiment, law);
  Json members{{"law", law.name()},
               {"ball", experiment.ball.name},
               {"radius", contact.radius},
               {"mass", experiment.ball.mass},
               {"load", experiment.environment.load.value_or(experiment.ball.mass * experiment.environment.gravity)},
               {"friction", contact.friction},
               {"patch_radius", contact.patch_radius},
               {"pivoting_moment", contact.pivoting_moment},
               {"moment_arm", contact.moment_arm()},
               {"slip", si::slip_at_start(experiment)},
               {"spin", si::spin_at_start(experiment)},
               {"t_slip", slip},
               {"t_spin", spin},
               {"engines", Json::array()}};
  for (const Engine& engine : si::engines()) {
    if (only == nullptr || &engine == only) members["engines"].push_back(members_of(engine, experiment, contact));
  }
  return members;
}

}  // namespace contensou::answers
