#pragma once

#include <array>
#include <optional>
#include <string>

#include "contensou/reduction/reduced_system.hpp"
#include "contensou/si/body.hpp"
#include "contensou/si/catalogue.hpp"
#include "contensou/si/quantity.hpp"
#include "contensou/si/run_file.hpp"
#include "options/argument.hpp"

namespace contensou::program {

using si::Body;

/// --mu and --body.
class BodyOptions {
 public:
  void add_mu(CLI::App& app);
  void add_body(CLI::App& app);

  const ArgumentOf<double>& mu() const { return mu_; }
  const ArgumentOf<Body>& argument() const { return body_; }

  /// The body; a homogeneous ball if none was given.
  Body body() const { return body_.value_or({}); }

  /// The body under a law, with its mu: that of --mu, or the one that the body itself decides.
  /// @param ways  to a mu, for a message
  /// @throws BadInput  if there is none, or one that the body cannot have
  reduction::ReducedSystem read(const reduction::Law& law, const std::string& ways = "--mu M") const;

 private:
  ArgumentOf<double> mu_;
  ArgumentOf<Body> body_;
};

/// The built-in ball of a name.
/// @throws NotAllowed  for an unknown name
const si::CatalogueEntry& require_ball(const std::string& name);

/// The start that the command line gives.
struct GivenStart {
  reduction::ReducedSystem system;
  reduction::State state;
  std::optional<si::Experiment> experiment;  ///< where it came from, if it is a ball in SI units

  bool at_rest() const { return state.u == 0 && state.v == 0; }
  bool slides_and_spins() const { return state.u != 0 && state.v != 0; }
};

/// --mu, --u0, --v0 and --body, or --ball with its overrides.
class StartOptions {
 public:
  void add(CLI::App& app);

  /// --ball and its overrides alone, for a verb that is in SI units.
  /// @param starts  whether --slip and --spin are among them
  void add_ball(CLI::App& app, const std::string& help = "a ball in SI units, built in or from a run file",
                bool starts = true);

  /// Whether any of them was given, --body aside.
  bool given() const { return !given_names().empty(); }
  std::string given_names() const;

  /// Whether there is no motion in them: neither --u0 nor --v0 nor --ball.
  bool without_motion() const { return !u0_.given() && !v0_.given() && !ball_.given(); }

  /// @param law  of the system; a measured spin deceleration holds under it
  /// @throws BadInput           if options are missing, exclude each other or have values that no ball can have
  /// @throws si::RunFileError   for a mistake in a run file
  /// @throws std::system_error  for a run file that cannot be read
  GivenStart read(const reduction::Law& law) const;

  bool ball_given() const { return ball_.given(); }

  /// What an option such as --slip gave in place of the ball's own value.
  std::optional<double> override_of(const si::Quantity& quantity) const;

  /// Whether --slip or --spin was given.
  bool overrides_start() const { return override_of(si::slip) || override_of(si::spin); }

  /// The name of the law that the body or the ball brings.
  /// @param start  velocities that take the place of those of [start]
  std::string standard_law(const si::StartOverride& start = {}) const;

  /// The ball of --ball where it has to roll. Throws as read, and BadInput for a body that lies flat.
  si::Experiment read_rolling_ball(const reduction::Law& law, const si::StartOverride& start = {}) const;

  /// The ball of --ball. Throws as read.
  ///
  /// @param start  velocities that take the place of those of [start]
  si::Experiment read_ball(const reduction::Law& law, const si::StartOverride& start = {}) const;

  /// What moves, without how: --mu, a --body with a mu of its own, or --ball is enough. Throws as read.
  reduction::ReducedSystem read_body(const reduction::Law& law) const;

  /// --body, by itself.
  const ArgumentOf<Body>& body_argument() const { return body_.argument(); }
  Body body() const { return body_.body(); }

 private:
  /// What single options can change of a ball.
  static constexpr std::array quantities{
      &si::radius,  &si::mass, &si::friction, &si::patch_radius, &si::spin_deceleration,
      &si::gravity, &si::load, &si::slip,     &si::spin};

  /// The ball's run file, also of one that is built in.
  struct BallText {
    std::string text, source;

    si::Experiment parsed(const si::Overrides& overrides, const si::StartOverride& start) const {
      return si::parse_run_file(text, source, overrides, start);
    }
  };

  const BallText& read_text() const;
  si::Overrides overrides() const;

  /// Says on standard error where the patch that a measured spin deceleration stands for is not that of the ball's own
  /// values, because some of them or the law were replaced.
  void tell_new_patch(const BallText& text, si::Overrides overrides, const si::Experiment& experiment,
                      const reduction::Law& law) const;

  void require_one_kind() const;
  std::string override_names() const;

  BodyOptions body_;
  ArgumentOf<double> u0_, v0_;
  Argument ball_;
  mutable std::optional<BallText> text_;                         ///< a file is read once: it may be a pipe
  std::array<ArgumentOf<double>, quantities.size()> overrides_;  ///< of quantities
};

}  // namespace contensou::program
