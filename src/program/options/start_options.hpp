#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "answers/asked/given_start.hpp"
#include "contensou/reduction/reduced_system.hpp"
#include "contensou/si/catalogue.hpp"
#include "contensou/si/experiment.hpp"
#include "contensou/si/load_history.hpp"
#include "contensou/si/quantity.hpp"
#include "contensou/si/run_file.hpp"
#include "options/argument.hpp"

namespace contensou::program {

using si::Body;

/// The options --mu, --body and --drive.
class BodyOptions {
 public:
  void add_mu(CLI::App& app);
  /// Allows --mu to be a list, for a verb that compares several mu. This must be called before add_mu.
  void take_several_mu() { takes_several_mu_ = true; }
  void add_body(CLI::App& app);
  void add_drive(CLI::App& app);

  const ArgumentOf<double>& mu() const { return mu_; }
  /// Returns the values of --mu after the first.
  const std::vector<double>& more_mu() const { return more_mu_; }
  const ArgumentOf<Body>& body_argument() const { return body_; }
  const ArgumentOf<double>& drive() const { return drive_; }

  /// Returns the body; a homogeneous ball if none was given.
  Body body() const { return body_.value_or({}); }

  /// Returns the system of the body under a law. Its mu is the value of --mu, or the only mu of the body.
  /// @param ways  options that set mu, for the message about a missing mu
  /// @throws BadInput  if mu is not given, or impossible for the body
  reduction::ReducedSystem read_system(const reduction::Law& law, const std::string& ways = "--mu M") const;

 private:
  ArgumentOf<double> mu_, drive_;
  bool takes_several_mu_ = false;
  std::vector<double> more_mu_;
  ArgumentOf<Body> body_;
};

/// Returns the built-in ball with a name.
/// @throws NotAllowed  for an unknown name
const si::CatalogueEntry& require_ball(const std::string& name);

/// The options --mu, --u0, --v0 and --body, or --ball and the options that replace its values.
class StartOptions : public BodyOptions {
 public:
  void add(CLI::App& app);

  /// Returns a start for each value of --mu under a law; without a motion, the bodies alone. Throws as read.
  std::vector<GivenStart> read_several(const reduction::Law& law) const;

  /// Predicate on a quantity. It is true if a verb with --ball has an option for this quantity.
  using Offer = bool (*)(const si::Quantity& quantity);
  static bool all(const si::Quantity& /*quantity*/) { return true; }
  static bool no_start(const si::Quantity& quantity) { return quantity.section != si::slip.section; }

  /// Adds --ball and the options for its values, for a verb in SI units.
  /// @param offer  selects the values that have an option
  void add_ball(CLI::App& app, const std::string& help = "real body in SI units: built-in, or from a run file",
                Offer offer = all);

  /// Accepts --radius alone as a ball, for a verb that determines the other values. This must be called before
  /// add_ball.
  void take_radius_for_ball() { radius_is_ball_ = true; }

  /// Accepts a body of one's own in place of --ball: --radius and further values, with --body. This must be called
  /// before add_ball.
  void take_own_body() { takes_own_body_ = true; }

  /// Returns true if any of these options was given, except --body alone.
  bool given() const { return !names_given({&mu(), &drive(), &u0_, &v0_}).empty() || ball_given(); }

  /// Returns the arguments that one start has and a table of starts replaces: --mu, --u0, --v0, and velocities of a
  /// ball.
  Arguments of_start() const { return united({{&mu(), &u0_, &v0_}, velocities_}); }

  /// Returns the arguments of a body: --mu, --body and --drive, and --ball with the options for its values.
  Arguments of_body() const { return united({{&mu(), &body_argument(), &drive(), &ball_}, of_ball_}); }

  /// Returns the drive of a ball whose slip points along x. The drive does not depend on the speed. Throws as read.
  double drive_along_x(si::Experiment ball) const;

  /// Returns true if the options give no motion: neither --u0 nor --v0 nor --ball.
  bool without_motion() const { return !u0_.given() && !v0_.given() && !ball_given(); }

  /// Reads the start from the options.
  /// @param law  law of the system; a patch that is given by a spin deceleration is computed under this law
  /// @throws BadInput           if options are missing, exclude each other or have values that no ball can have
  /// @throws si::RunFileError   for a mistake in a run file
  /// @throws std::system_error  for a run file that cannot be read
  GivenStart read(const reduction::Law& law) const;

  /// Returns --u0 and --v0.
  std::array<const ArgumentOf<double>*, 2> speeds() const { return {&u0_, &v0_}; }

  Argument& ball() { return ball_; }
  /// Returns true if --ball or a body of one's own was given.
  bool ball_given() const { return ball_.given() || (takes_own_body_ && value(si::radius).given()); }

  /// Also allows --load to name a table of the load against time. This must be called before add_ball.
  void take_load_history() { takes_load_history_ = true; }

  /// Returns the table that --load names. Throws BadLine for a mistake there, FileFailure if it is unreadable.
  std::optional<si::LoadHistory> load_history() const;

  /// Returns the values that are given by single options, such as --slip.
  si::Description given_values() const;

  /// Returns the name of the law that belongs to the body or the ball. Throws as read.
  std::string standard_law() const;

  /// Returns true if the ball has its own law, or if its body has another default law than a ball.
  bool brings_law() const;

  /// Prints which spreads in the ball's run file do not apply, because options replace their numbers.
  void tell_spreads_left_out(const si::Experiment& experiment) const;

  /// Prints on standard error which effects on a real ball of this kind the model leaves out.
  void tell_left_out() const;

  /// Returns the ball of --ball, which must roll. Throws as read_ball, and BadInput for a body that lies flat.
  /// @param way_out  advice for the message to a user with a body that lies flat
  si::Experiment read_rolling_ball(const reduction::Law& law, const std::string& way_out,
                                   const si::Description& between = {}) const;

  /// Returns the ball of --ball. Throws as read.
  ///
  /// @param between  values that replace values of the ball; values of options replace both
  si::Experiment read_ball(const reduction::Law& law, const si::Description& between = {}) const;

  /// Throws an error about --ball and the options that replace its values.
  /// @throws BadInput  always
  [[noreturn]] void reject_ball(const std::string& message) const;

  /// Throws for a ball with rolling friction or on a slope, on behalf of a verb that cannot compute such motions.
  /// @param what  name of the verb or option, for the message
  void require_undriven(const si::Experiment& experiment, const std::string& what) const;

  /// Returns the body without a motion. This needs --mu, a --body that determines mu, or --ball. Throws as read.
  reduction::ReducedSystem read_body(const reduction::Law& law) const;

 private:
  const si::Description& ball_of_its_own() const;

  /// Prints a warning on standard error if options replace values of the ball or the law, so that a measured spin
  /// deceleration now gives another patch than before.
  /// @throws std::domain_error  if the patch radius that follows from the spin deceleration is impossible
  void tell_new_patch(const si::Experiment& experiment, const reduction::Law& law) const;

  ArgumentOf<double> u0_, v0_;
  Argument ball_;
  const ArgumentOf<std::vector<double>>& value(const si::Quantity& quantity) const;

  bool radius_is_ball_ = false, takes_own_body_ = false, takes_load_history_ = false;
  mutable std::optional<si::LoadHistory> load_history_;  ///< empty until load_history() has read the table, once
  mutable std::optional<si::Description> own_;           ///< ball of --ball, read once, because its file may be a pipe
  std::vector<ArgumentOf<std::vector<double>>> values_{si::quantities().size()};
  Arguments of_ball_, velocities_;  ///< options for values of the ball, and those of them for its start
};

/// Returns the name of the group of options that replace values of a ball.
std::string ball_group();

/// Returns a start at rest, for a verb that sets the start itself.
si::Description at_rest(const std::string& source);

}  // namespace contensou::program
