#include "contensou/si/engine.hpp"

#include <algorithm>
#include <cctype>
#include <functional>
#include <map>
#include <numbers>
#include <set>
#include <vector>

#include <catch2/catch.hpp>

#include "contensou/reduction/laws.hpp"
#include "contensou/si/catalogue.hpp"

using namespace contensou;
using namespace contensou::si;

namespace {

/// Computes the moment divided by the load, in m, from an engine's numbers, by the formula in the engine's source code.
using Limit = std::function<double(const std::vector<double>& typed, double radius)>;

const Limit the_last = [](const std::vector<double>& typed, double /*radius*/) { return typed.back(); };

const std::map<std::string_view, Limit> limits{
    {"mujoco", the_last},
    {"newton", the_last},
    {"genesis", the_last},
    {"physx", [](const auto& typed, double /*radius*/) { return typed[0] * std::max(typed[1], 0.0); }},
    {"bullet",
     [](const auto& typed, double /*radius*/) {
       const double of_plane = 0;
       return typed[2] * typed[1] + of_plane * typed[0];
     }},
    {"chrono", the_last},
    {"edyn", the_last},
    // The spin deceleration is 5 u_sp g/(2 R) with u_sp = typed[1] R. It is also (5/2) M/(m R^2), M being the moment.
    {"pooltool",
     [](const auto& typed, double radius) { return 5 * (typed[1] * radius) / (2 * radius) * 2 * radius * radius / 5; }},
    {"box3d", [](const auto& typed, double radius) { return typed[1] * radius; }},
    {"lammps", the_last},
    {"ode", the_last},
    {"gazebo", [](const auto& typed, double /*radius*/) { return 3 * std::numbers::pi * typed[2] * typed[1] / 16; }},
    {"webots", the_last},
};

std::vector<double> typed_into(const EngineUse& use, const EngineContact& contact) {
  std::vector<double> typed;
  for (const EngineParameter& parameter : use.parameters) typed.push_back(parameter.value(contact));
  return typed;
}

}  // namespace

TEST_CASE("what is typed into an engine makes the moment of the law, whatever ball and law", "[table]") {
  for (const CatalogueEntry& ball : catalogue()) {
    for (const char* law_name : {"exact", "uniform", "ring"}) {
      const reduction::Law law = *reduction::find_law(law_name);
      const EngineContact contact = contact_of(ball.experiment, law);
      CHECK(contact.moment_arm() ==
            Approx(ball.experiment.contact.friction * patch_radius_of(ball.experiment, law) * law.pivoting_moment()));
      for (const Engine& engine : engines()) {
        INFO(engine.name << ", " << ball.name << ", " << law_name);
        if (engine.ball.parameters.empty()) continue;
        const std::vector<double> typed = typed_into(engine.ball, contact);
        CHECK(typed.front() == contact.friction);
        CHECK(limits.at(engine.name)(typed, contact.radius) == Approx(contact.moment_arm()).epsilon(1e-12));
        CHECK(engine.ball.settings.front().moment_arm(contact) == contact.moment_arm());
      }
    }
  }
}

TEST_CASE("of a body that lies flat the distance of the contact points is the moment", "[table]") {
  const Experiment& puck = find_ball("puck")->experiment;
  for (const char* law_name : {"uniform", "ring", "paraboloid"}) {
    const EngineContact contact = contact_of(puck, *reduction::find_law(law_name));
    for (const Engine& engine : engines()) {
      INFO(engine.name << ", " << law_name);
      if (engine.face.parameters.empty()) continue;
      const std::vector<double> typed = typed_into(engine.face, contact);
      REQUIRE(typed.size() == 2);
      if (engine.name == "box2d") {  // the joint limits the force in N and the torque in N m
        const double load = puck.ball.mass * puck.environment.gravity;
        CHECK(typed[0] == Approx(contact.friction * load).epsilon(1e-15));
        CHECK(typed[1] == Approx(contact.moment_arm() * load).epsilon(1e-12));
        continue;
      }
      // bepuphysics2 divides friction by its four contact points.
      const double friction = typed[0] / (engine.name == "bepu" ? 4 : 1);
      CHECK(friction == Approx(contact.friction).epsilon(1e-15));
      CHECK(friction * typed[1] == Approx(contact.moment_arm()).epsilon(1e-12));
      CHECK(engine.face.settings[0].moment_arm(contact) == contact.moment_arm());
      CHECK(engine.face.settings[0].friction_share == 1);
      CHECK(engine.face.settings[1].moment_arm(contact) == Approx(contact.friction * puck.ball.radius));
    }
  }
}

TEST_CASE("each engine says what it is, from where, and what it does", "[table]") {
  std::set<std::string_view> names;
  for (const Engine& engine : engines()) {
    INFO(engine.name);
    CHECK(names.insert(engine.name).second);
    CHECK(std::ranges::all_of(engine.name,
                              [](unsigned char letter) { return std::islower(letter) || std::isdigit(letter); }));
    CHECK(find_engine(engine.name) == &engine);
    CHECK(engine.ball.parameters.empty() == (limits.count(engine.name) == 0));
    CHECK_FALSE(engine.title.empty());
    CHECK(std::ranges::count(engine.repository, '/') == 1);
    CHECK(engine.version.find_first_of("0123456789") != std::string_view::npos);
    CHECK_FALSE(engine.ball.limit.empty());
    CHECK(engine.face.limit.empty() == engine.face.settings.empty());
    CHECK_FALSE(engine.combination.empty());
    CHECK(engine.ball.settings.empty() == (engine.name == "box2d"));  // no ball rolls in a plane world
    REQUIRE_FALSE(engine.sources.empty());
    for (std::string_view source : engine.sources) CHECK(source.find('.') != std::string_view::npos);
  }
  CHECK(find_engine("havok") == nullptr);
  CHECK(unknown_engine().name.empty());
  for (const EngineAlias& alias : engine_aliases()) {
    INFO(alias.name);
    CHECK(names.insert(alias.name).second);
    CHECK(find_engine(alias.name) == find_engine(alias.engine));
    CHECK(find_engine(alias.name) != nullptr);
  }
}

TEST_CASE("what is published as the radius or diameter of a patch is too much by what is left out", "[table]") {
  const Experiment& pool = find_ball("pool")->experiment;
  const EngineContact contact = contact_of(pool, *reduction::find_law("exact"));
  const auto times = [&](std::string_view engine, std::size_t setting) {
    return find_engine(engine)->ball.settings.at(setting).moment_arm(contact) / contact.moment_arm();
  };
  CHECK(times("mujoco", 3) == Approx(2 / (0.2 * 3 * std::numbers::pi / 16)));  // 17
  CHECK(times("physx", 1) == Approx(16 / (3 * std::numbers::pi)));             // 1.7
  // Gazebo multiplies the patch radius by Hertz's Psi(0) itself.
  CHECK(find_engine("gazebo")->ball.parameters.back().value(contact) == Approx(contact.patch_radius).epsilon(1e-14));
  CHECK(times("gazebo", 1) == Approx(1 / 0.2));
  // The spin deceleration in pooltool is (5/2) u_sp g/R = 10.9 rad/s^2 instead of the intended 10.
  CHECK(times("pooltool", 1) == Approx(2.5 * (10 * 2.0 / 5 / 9) * 9.80665 / 10));
  // LAMMPS: the moment of marshall does not depend on the slip. Its remarks say 13 %, 3 times and 10 times.
  CHECK(times("lammps", 1) == Approx(32 / (9 * std::numbers::pi)));
  const auto marshall_over_law = [](double k) {
    return 2.0 / 3 / reduction::find_law("exact")->operator()(reduction::Slip{k, 1}).moment;
  };
  CHECK(marshall_over_law(0) == Approx(1.13).epsilon(0.002));
  CHECK(marshall_over_law(1) == Approx(3).epsilon(0.01));
  CHECK(marshall_over_law(3) == Approx(10).epsilon(0.01));
}

TEST_CASE("a parameter of an engine acts on the force, the moment or both, as in its source", "[table]") {
  const auto acts = [](const EngineUse& use, std::string_view name) {
    const auto found = std::ranges::find(use.parameters, name, &EngineParameter::name);
    REQUIRE(found != use.parameters.end());
    return std::pair{found->acts_on_force(), found->acts_on_moment()};
  };
  const std::pair force{true, false}, moment{false, true}, both{true, true};
  CHECK(acts(find_engine("mujoco")->ball, "friction[0]") == force);
  CHECK(acts(find_engine("mujoco")->ball, "friction[1]") == moment);
  CHECK(acts(find_engine("physx")->ball, "dynamicFriction") == both);
  CHECK(acts(find_engine("bullet")->ball, "setFriction of the ball") == force);
  CHECK(acts(find_engine("bullet")->ball, "setFriction of the plane") == both);
  CHECK(acts(find_engine("gazebo")->ball, "torsional coefficient") == moment);
  CHECK(acts(find_engine("box2d")->face, "maxForce") == force);
  CHECK(acts(find_engine("box2d")->face, "maxTorque") == moment);
  CHECK(acts(find_engine("jolt")->face, "mFriction") == both);
}
