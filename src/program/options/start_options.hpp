#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "answers/asked/given_start.hpp"
#include "contensou/reduction/reduced_system.hpp"
#include "contensou/si/body.hpp"
#include "contensou/si/catalogue.hpp"
#include "contensou/si/load_history.hpp"
#include "contensou/si/quantity.hpp"
#include "contensou/si/run_file.hpp"
#include "options/argument.hpp"

namespace contensou::program {

using si::Body;

/// --mu, --body and --drive.
class BodyOptions {
 public:
  void add_mu(CLI::App& app);
  /// Lets --mu be a list, for a verb that compares; before add_mu.
  void take_several_mu() { takes_several_mu_ = true; }
  void add_body(CLI::App& app);
  void add_drive(CLI::App& app);

  const ArgumentOf<double>& mu() const { return mu_; }
  /// Those of --mu beside its first.
  const std::vector<double>& more_mu() const { return more_mu_; }
  const ArgumentOf<Body>& argument() const { return body_; }
  const ArgumentOf<double>& drive() const { return drive_; }

  /// The body; a homogeneous ball if none was given.
  Body body() const { return body_.value_or({}); }

  /// The body under a law, with its mu: that of --mu, or the one that the body itself decides.
  /// @param ways  to a mu, for a message
  /// @throws BadInput  if there is none, or one that the body cannot have
  reduction::ReducedSystem read(const reduction::Law& law, const std::string& ways = "--mu M") const;

 private:
  ArgumentOf<double> mu_, drive_;
  bool takes_several_mu_ = false;
  std::vector<double> more_mu_;
  ArgumentOf<Body> body_;
};

/// The built-in ball of a name.
/// @throws NotAllowed  for an unknown name
const si::CatalogueEntry& require_ball(const std::string& name);

/// --mu, --u0, --v0 and --body, or --ball with its overrides.
class StartOptions {
 public:
  void add(CLI::App& app);

  /// Lets --mu be a list, for a verb that compares; before add.
  void take_several_mu() { body_.take_several_mu(); }

  /// The starts of all of --mu under a law, or of its bodies without their motion. Throws as read.
  std::vector<GivenStart> read_several(const reduction::Law& law) const;

  /// --drive, for a verb that has an answer with it.
  void add_drive(CLI::App& app) { body_.add_drive(app); }

  /// Whether a verb that takes a ball offers an option for a quantity.
  using Offer = bool (*)(const si::Quantity& quantity);
  static bool all(const si::Quantity& /*quantity*/) { return true; }
  static bool no_start(const si::Quantity& quantity) { return quantity.section != si::slip.section; }

  /// --ball and its values alone, for a verb that is in SI units.
  /// @param offer  of the values
  void add_ball(CLI::App& app, const std::string& help = "body in SI units", Offer offer = all);

  /// From here on --radius is a ball, too: for a verb that finds what else there is of it.
  void take_radius_for_ball() { radius_is_ball_ = true; }

  /// Whether any of them was given, --body aside.
  bool given() const { return !given_names().empty(); }
  std::string given_names() const;

  /// The same but for --drive, which many starts share.
  std::string names_of_one_start() const;
  double drive() const { return body_.drive().value_or(0); }

  /// That of a ball whose slip points along x, however fast. Throws as read.
  double drive_along_x(si::Experiment ball) const;

  /// Whether there is no motion in them: neither --u0 nor --v0 nor --ball.
  bool without_motion() const { return !u0_.given() && !v0_.given() && !ball_.given(); }

  /// @param law  of the system; a measured spin deceleration holds under it
  /// @throws BadInput           if options are missing, exclude each other or have values that no ball can have
  /// @throws si::RunFileError   for a mistake in a run file
  /// @throws std::system_error  for a run file that cannot be read
  GivenStart read(const reduction::Law& law) const;

  /// --u0 and --v0 of either sign, where they are a point of another system.
  /// @throws BadInput  if one is missing, and for what a ball or a body has
  Eigen::Vector2d read_point() const;

  /// Throws BadInput for what a ball or a body has.
  void require_point_or_none() const;

  bool ball_given() const { return ball_.given(); }

  /// Lets --load name a table of the load against time, too; before add_ball.
  void take_load_history() { takes_load_history_ = true; }

  /// The table that --load names. Throws BadLine, and FileFailure if it cannot be read.
  std::optional<si::LoadHistory> load_history() const;

  /// The values that single options give, --slip among them.
  si::Description given_values() const;

  /// Whether a start of the ball was given, such as --slip.
  bool overrides_start() const { return !start_names().empty(); }
  std::string start_names() const;

  /// The name of the law that the body or the ball brings. Throws as read.
  std::string standard_law() const;

  /// Whether the ball says its law itself, or its body has another than a ball.
  bool brings_law() const;

  /// Says which spreads of the ball's run file do not hold for this experiment, whose numbers are others.
  void tell_spreads_left_out(const si::Experiment& experiment) const;

  /// Says on standard error what a built-in ball does in the world and its motion here leaves out.
  void tell_left_out() const;

  /// The ball of --ball where it has to roll. Throws as read_ball, and BadInput for a body that lies flat.
  /// @param way_out  what may be asked of such a body
  si::Experiment read_rolling_ball(const reduction::Law& law, const std::string& way_out,
                                   const si::Description& between = {}) const;

  /// The ball of --ball. Throws as read.
  ///
  /// @param between  values that take the place of the ball's own, and that options replace
  si::Experiment read_ball(const reduction::Law& law, const si::Description& between = {}) const;

  /// Rejects --ball, with the options that replace its values.
  /// @throws BadInput  always
  [[noreturn]] void reject_ball(const std::string& message) const;

  /// Rejects a ball with rolling friction or on a slope, where there is no answer with them.
  /// @param what  that knows none, for the message
  void require_undriven(const si::Experiment& experiment, const std::string& what) const;

  /// The body without its motion: --mu, a --body with a mu of its own, or --ball is enough. Throws as read.
  reduction::ReducedSystem read_body(const reduction::Law& law) const;

  /// --body, by itself.
  const ArgumentOf<Body>& body_argument() const { return body_.argument(); }
  Body body() const { return body_.body(); }

 private:
  const si::Description& ball_of_its_own() const;

  /// Says on standard error where the patch that a measured spin deceleration stands for is not that of the ball's own
  /// values, because some of them or the law were replaced.
  void tell_new_patch(const si::Experiment& experiment, const reduction::Law& law) const;

  void require_one_kind() const;
  std::string override_names() const;

  BodyOptions body_;
  ArgumentOf<double> u0_, v0_;
  Argument ball_;
  const ArgumentOf<std::vector<double>>& value(const si::Quantity& quantity) const;

  bool radius_is_ball_ = false, takes_load_history_ = false;
  mutable std::optional<si::LoadHistory> load_history_;  ///< read once
  mutable std::optional<si::Description> own_;           ///< of --ball; a file is read once: it may be a pipe
  std::vector<ArgumentOf<std::vector<double>>> values_{si::quantities().size()};
};

/// Name of the group of the options that replace values of a ball.
std::string ball_group();

/// A start at rest, for a verb that brings its own.
si::Description at_rest(const std::string& source);

}  // namespace contensou::program
