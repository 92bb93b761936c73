#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "contensou/si/contact_cone.hpp"

namespace contensou::si {

/// What the numbers of an engine follow from.
struct EngineContact {
  double friction;         ///< f
  double patch_radius;     ///< a, m
  double pivoting_moment;  ///< Psi(0) of the law
  double radius;           ///< R, m

  /// f a Psi(0) in m: the moment of spinning without sliding, over the load.
  double moment_arm() const { return friction * patch_radius * pivoting_moment; }
};

/// @throws std::domain_error  as patch_radius_of
EngineContact contact_of(const Experiment& experiment, const reduction::Law& law);

/// A number of an engine, in SI units: the factor times f, a and Psi(0), as far as they count, and a power of R.
struct EngineNumber {
  double factor = 1;
  bool f = false, a = false, psi = false;
  int radius = 0;  ///< -2 to 2, the power of R

  double operator()(const EngineContact& contact) const;

  /// Returns it for people, as in f a Psi(0)/R^2.
  std::string formula() const;
};

/// A number that is typed into an engine.
struct EngineParameter {
  std::string_view name;  ///< the engine's own
  std::string_view unit;  ///< SI; empty for a pure number
  EngineNumber value;
};

/// A way to set an engine, and what it then does.
struct EngineSetting {
  std::string_view words;
  Cone cone;
  EngineNumber moment_arm;    ///< m, the greatest moment over the load; 0: it has no moment
  double friction_share = 1;  ///< of the f that is meant, where the engine makes less of what is typed in
};

/// What is typed into an engine for a body, and what that does.
struct EngineUse {
  std::vector<EngineParameter> parameters;  ///< sliding first, the one that decides the moment last; empty without any
  std::string_view limit;                   ///< of the moment M under the load N, in the engine's own words
  std::vector<std::string_view> needs;      ///< switches without which the numbers do nothing
  std::vector<EngineSetting> settings;      ///< the one that comes nearest to the law first, then what else is met
};

/// A physics engine whose contact has a moment about the normal, or has not.
struct Engine {
  std::string_view name;        ///< one lower-case word
  std::string_view title;       ///< its own name
  std::string_view repository;  ///< on github.com
  std::string_view version;     ///< that the rest was read in
  EngineUse ball;
  EngineUse face;                ///< of a body that lies flat; no settings: it has none, or was not read for it
  std::string_view combination;  ///< of the numbers of the two bodies
  std::vector<std::string_view> remarks;  ///< what goes wrong
  std::vector<std::string_view> sources;  ///< FILE:LINES

  const EngineUse& use_of(const Body& body) const { return body.lies_flat() ? face : ball; }
};

/// A name under which an engine is met, too.
struct EngineAlias {
  std::string_view name;    ///< one lower-case word
  std::string_view engine;  ///< that it stands on
  std::string_view words;   ///< what it is
};

/// The engines that are known.
const std::vector<Engine>& engines();

/// Names of programs that stand on one of the engines.
const std::vector<EngineAlias>& engine_aliases();

/// The engine of that name, or that a program of that name stands on; null if there is none.
const Engine* find_engine(std::string_view name);

}  // namespace contensou::si
