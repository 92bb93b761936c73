#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "contensou/si/contact_cone.hpp"

namespace contensou::si {

/// The values of an experiment that determine the numbers of an engine.
struct EngineContact {
  double friction;         ///< f
  double patch_radius;     ///< a, m
  double pivoting_moment;  ///< Psi(0) of the law
  double radius;           ///< R, m

  /// Returns f a Psi(0) in m: the moment of spinning without sliding, divided by the load.
  double moment_arm() const { return friction * patch_radius * pivoting_moment; }
};

/// Returns these values of an experiment.
/// @throws std::domain_error  as patch_radius_of
EngineContact contact_of(const Experiment& experiment, const reduction::Law& law);

/// A number of an engine in SI units: a factor, times f, a and Psi(0) if they are set, times a power of R.
struct EngineNumber {
  double factor = 1;
  bool f = false, a = false, psi = false;
  int radius = 0;  ///< power of R, -2 to 2

  double operator()(const EngineContact& contact) const;

  /// Returns the formula for people, such as f a Psi(0)/R^2.
  std::string formula() const;
};

/// A number to type into an engine.
struct EngineParameter {
  std::string_view name;  ///< its name in the engine
  std::string_view unit;  ///< SI unit; empty for a pure number
  EngineNumber value;
};

/// A way to set up an engine, and the resulting limit of the contact.
struct EngineSetting {
  std::string_view words;
  Cone cone;
  EngineNumber moment_arm;  ///< largest moment divided by the load, m; 0: no moment
  /// Effective friction divided by the f that is meant, if the engine reduces the number typed in.
  double friction_share = 1;
};

/// The numbers to type into an engine for a kind of body, and their effect.
struct EngineUse {
  std::vector<EngineParameter> parameters;  ///< sliding first, the number that determines the moment last; may be empty
  std::string_view limit;                   ///< limit of the moment M under the load N, in the engine's words
  std::vector<std::string_view> needs;      ///< switches that must be on for the numbers to act
  std::vector<EngineSetting> settings;      ///< nearest to the law first, then other common settings
};

/// A physics engine, with or without a moment about the normal of its contacts.
struct Engine {
  std::string_view name;        ///< one lower-case word
  std::string_view title;       ///< name of the engine
  std::string_view repository;  ///< repository on github.com
  std::string_view version;     ///< version whose source was read
  EngineUse ball;
  EngineUse face;                ///< use for a body that lies flat; no settings: it has none, or they were not read
  std::string_view combination;  ///< combination of the numbers of two bodies
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

/// Returns programs that use one of the engines.
const std::vector<EngineAlias>& engine_aliases();

/// Returns the engine of that name, or the one that a program of that name uses; null if there is none.
const Engine* find_engine(std::string_view name);

}  // namespace contensou::si
