#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "contensou/si/contact_cone.hpp"

namespace contensou::si {

/// The values of an experiment from which the numbers of a physics engine follow.
struct EngineContact {
  double friction;         ///< f
  double patch_radius;     ///< a, m
  double pivoting_moment;  ///< Psi(0) of the law
  double radius;           ///< R, m
  double load;             ///< N, in N

  /// Returns f a Psi(0) in m: the moment of spinning without sliding divided by the load.
  double moment_arm() const { return friction * patch_radius * pivoting_moment; }
};

/// Returns the EngineContact of an experiment.
/// @throws std::domain_error  as patch_radius_of
EngineContact contact_of(const Experiment& experiment, const reduction::Law& law);

/// A number of an engine in SI units: factor times f, a, Psi(0) and the load N, each only if its flag is true, times a
/// power of R.
struct EngineNumber {
  double factor = 1;
  bool f = false, a = false, psi = false;
  int radius = 0;  ///< power of R, -2 to 2
  bool load = false;

  double operator()(const EngineContact& contact) const;

  /// Returns the formula as people write it, such as f a Psi(0)/R^2.
  std::string formula() const;
};

/// The limit to which a parameter of an engine is proportional; by_value: the moment if its value contains a, else the
/// force.
enum class ActsOn { by_value, moment, both };

/// A number that a user types into an engine.
struct EngineParameter {
  std::string_view name;  ///< name of the number in the engine
  std::string_view unit;  ///< SI unit; empty for a pure number
  EngineNumber value;
  ActsOn acts_on = ActsOn::by_value;

  bool acts_on_force() const;
  bool acts_on_moment() const;
};

/// One way to set up an engine, and the resulting limit of its contact.
struct EngineSetting {
  std::string_view words;
  Cone cone;
  EngineNumber moment_arm;  ///< largest moment divided by the load, m; 0: no moment
  /// Effective friction divided by the intended f, for an engine that reduces the number typed in.
  double friction_share = 1;
};

/// The numbers that a user types into an engine for one kind of body, and their effect.
struct EngineUse {
  std::vector<EngineParameter> parameters;  ///< numbers for sliding first; the number for the moment last; may be empty
  std::string_view limit;                   ///< limit of the moment M under the load N, as the engine defines M
  std::vector<std::string_view> needs;      ///< switches that must be on for the numbers to have an effect
  std::vector<EngineSetting> settings;      ///< the setting nearest to the law first, then other common settings
};

/// A physics engine, with or without a moment about the normal of its contacts.
struct Engine {
  std::string_view name;        ///< one lower-case word
  std::string_view title;       ///< name of the engine
  std::string_view repository;  ///< repository on github.com
  std::string_view version;     ///< version whose source was read
  EngineUse ball;
  EngineUse face;                ///< use for a body that lies flat; no settings if no such use exists or was read
  std::string_view combination;  ///< rule by which the numbers of two bodies are combined
  std::vector<std::string_view> remarks;  ///< known problems
  std::vector<std::string_view> sources;  ///< FILE:LINES

  const EngineUse& use_of(const Body& body) const { return body.lies_flat() ? face : ball; }
};

/// Another program that uses one of the engines.
struct EngineAlias {
  std::string_view name;    ///< one lower-case word
  std::string_view engine;  ///< name of the engine that it uses
  std::string_view words;   ///< description
};

/// Returns the known engines.
const std::vector<Engine>& engines();

/// Returns what any engine needs: the limits of force and moment, and the rules for both. Its name is empty.
const Engine& unknown_engine();

/// Returns the known programs that use one of the engines.
const std::vector<EngineAlias>& engine_aliases();

/// Returns the engine with that name, or the engine that a program with that name uses; null if there is none.
const Engine* find_engine(std::string_view name);

}  // namespace contensou::si
