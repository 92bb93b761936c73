#pragma once

#include <array>
#include <optional>

#include "contensou/reduction/reduced_system.hpp"
#include "contensou/si/catalogue.hpp"
#include "contensou/si/quantity.hpp"
#include "contensou/si/run_file.hpp"
#include "options/argument.hpp"
#include "options/body_option.hpp"

namespace contensou::program {

/// The built-in ball of a name.
/// @throws NotAllowed  for an unknown name
const si::CatalogueEntry& require_ball(const std::string& name);

/// What slides and pivots, in the paper's variables.
struct GivenBody {
  double mu;
  reduction::Inertia inertia;

  reduction::ReducedSystem system(const reduction::Law& law) const { return {law, mu, inertia}; }
};

/// The start that the command line gives.
struct GivenStart {
  GivenBody body;
  reduction::State state;
  std::optional<si::Shot> shot;  ///< where it came from, if it is a ball in SI units
};

/// --mu, --u0, --v0 and --body, or --ball with its overrides.
class StartOptions {
 public:
  void add(CLI::App& app);

  /// --ball and its overrides alone, for a verb that is in SI units.
  void add_ball(CLI::App& app);

  /// Whether any of them was given, --body aside.
  bool given() const { return !given_names().empty(); }
  std::string given_names() const;

  /// Whether there is no motion in them: neither --u0 nor --v0 nor --ball.
  bool without_motion() const { return !u0_.given() && !v0_.given() && !ball_.given(); }

  /// @throws BadInput           if options are missing, exclude each other or have values that no ball can have
  /// @throws si::RunFileError   for a mistake in a run file
  /// @throws std::system_error  for a run file that cannot be read
  GivenStart read() const;

  /// Whether --slip or --spin was given.
  bool overrides_start() const;

  /// The ball of --ball. Throws as read.
  ///
  /// @param start  velocities that take the place of those of [start]
  si::Shot read_ball(const si::StartOverride& start = {}) const;

  /// What moves, without how: --mu, a --body with a mu of its own, or --ball is enough. Throws as read.
  GivenBody read_body() const;

  /// --body, by itself.
  const BodyOption& body() const { return body_; }

 private:
  /// What single options can change of a ball.
  static constexpr std::array quantities{
      &si::radius,  &si::mass, &si::friction, &si::patch_radius, &si::spin_deceleration,
      &si::gravity, &si::slip, &si::spin};

  void add_ball(CLI::App& app, const std::string& help);
  si::Shot read_shot(const si::Overrides& overrides, const si::StartOverride& start) const;
  void require_one_kind() const;
  std::string override_names() const;

  ArgumentOf<double> mu_, u0_, v0_;
  Argument ball_;
  BodyOption body_;
  std::array<ArgumentOf<double>, quantities.size()> overrides_;  ///< of quantities
};

}  // namespace contensou::program
