#pragma once

#include <optional>
#include <string>

#include "contensou/reduction/inertia.hpp"
#include "options/argument.hpp"

namespace contensou::program {

/// An axisymmetric body as --body names it.
struct Body {
  reduction::Inertia inertia = reduction::homogeneous_ball;
  std::optional<double> patch_ratio{};  ///< where the body itself decides it: a flat puck rests on its whole face
  bool rolls_on_a_small_patch = true;   ///< mu <= 1

  /// What is wrong with a mu for this body; empty if nothing is.
  std::string complaint(double mu) const;
};

/// --body.
class BodyOption {
 public:
  void add(CLI::App& app);

  bool given() const { return body_.given(); }

  /// The body; a homogeneous ball if none was given.
  Body read() const { return body_.value_or({}); }

  /// The mu of the body: that of --mu, or the one that the body itself decides.
  /// @throws BadInput  if there is none, or one that the body cannot have
  static double read_patch_ratio(const ArgumentOf<double>& mu, const Body& body);

  /// Throws BadInput with the option and its value before the message.
  [[noreturn]] void reject(const std::string& message) const { body_.reject(message); }

 private:
  ArgumentOf<Body> body_;
};

/// --mu, for a verb that has no --ball.
void add_patch_ratio(ArgumentOf<double>& mu, CLI::App& app);

}  // namespace contensou::program
