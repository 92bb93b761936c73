#pragma once

#include <functional>
#include <string>
#include <vector>

#include "answers/table/answer.hpp"
#include "answers/table/record.hpp"
#include "contensou/reduction/detail/infinity.hpp"
#include "contensou/reduction/friction_law.hpp"
#include "contensou/reduction/verification.hpp"
#include "contensou/si/description.hpp"
#include "contensou/si/experiment.hpp"

namespace contensou::answers {

/// Deviation of slip or spin between a table and a model.
struct Deviation {
  double error = 0;          ///< largest error, m/s or rad/s
  double relative = 0;       ///< largest error as a share of the start
  double t = infinity;       ///< time of the worst row in the table, s
  double leaves = infinity;  ///< time of the first row whose error is beyond the tolerance, s
};

/// A model whose motion is compared with a table.
struct ModelBeside {
  std::string name;
  std::function<si::SlipAndSpin(double)> motion;  ///< returns the speeds at a time after the first row, s
  Deviation slip = {}, spin = {};

  double worst() const;  ///< the larger one of the relative errors of slip and spin
};

/// A row of a table.
struct Instant {
  long line;
  double t;  ///< time in the table, s
  si::SlipAndSpin speeds;
  std::optional<si::Velocities> body = {};  ///< velocities in the log of a rigid body
};

/// A table of a ball's motion, and the motions of models with the same start.
struct MotionsBeside {
  std::vector<Instant> rows;
  si::SlipAndSpin start;
  double slip_unit, spin_unit;      ///< m/s and rad/s; an error divided by its unit is a relative error
  std::vector<ModelBeside> models;  ///< models; the first is the motion under the law

  /// Another reading of the log with which a model fits, in words; empty if none is needed or found.
  std::string reading = {};

  /// Returns the model with the smallest error. Among equal errors the motion under the law wins.
  const ModelBeside& best() const;

  /// Returns best(), or nullptr if its error exceeds `near`.
  const ModelBeside* nearest() const;
  static constexpr double near = 0.3;  ///< largest relative error of a model that resembles the table
};

/// Compares a table of a motion with models. The slip of a rigid body is computed as |(vx - R wy, vy + R wx)|, the slip
/// of a body that lies flat as |(vx, vy)|.
///
/// If no model fits, the log of a rigid body is also read with y up, with the opposite sense of turning, and both. If
/// the headings name no unit, each log is also read with angular velocities in degrees/s and rpm.
///
/// @param path       file with columns t (or time), slip and spin (or wz, as `roll` writes); for a rigid body it may
///                   have vx, vy, wx, wy, wz in place of slip and spin, and for a flat body x, y, angle (or wz), whose
///                   differences are mean velocities. Units are SI or those behind the names. Rows without a needed
///                   number are left out; "-" is standard input
/// @param ball       ball whose start is the first row
/// @param values     values that replace values of the first row
/// @param tolerance  largest error that passes, as a share of the start, > 0
/// @throws BadLine            for a mistake in the table, or a start that the ball cannot have
/// @throws std::system_error  if the file cannot be read
MotionsBeside compare_with_motions(const std::string& path, const si::Experiment& ball, const si::Description& values,
                                   const reduction::Law& law, double tolerance);

/// The result of a check of a law.
struct CheckedLaw {
  std::string law;  ///< empty for a typed system
  reduction::Check check;
  std::optional<Deviation> deviation = {};  ///< deviation from a table, if the check uses one
};

/// Returns the worst results of the checks of a law over a set of starts. Over this set k0 = v0/(mu u0) runs from
/// almost pure pivoting to almost pure sliding. The routes to the stop time are also compared for starts with a drive.
std::vector<reduction::Check> built_in_checks(const reduction::Law& law);

/// Replaces each check by the same check in `others` if that one is worse. NaN is the worst.
void take_worse(std::vector<reduction::Check>& worst, const std::vector<reduction::Check>& others);

/// Returns the answer of `check` with the given rows.
/// @param built_in  true for rows of built_in_checks; the text then names the starts of built_in_checks
Answer check_answer(const std::vector<CheckedLaw>& rows, bool built_in);

/// Returns the answer for the motion of a typed system from a start.
/// @throws BadInput  if the system has no motion there
Answer check_system_answer(const reduction::SmoothField& field, const Eigen::Vector2d& start);

/// Returns the answer for a table and the motions of a ball: two checks of the motion under the law, and the errors of
/// other models.
/// @param law        name of the law, the first of the models
/// @param tolerance  largest error that passes, as a share of the start
Answer check_against_answer(const MotionsBeside& motions, const std::string& law, double tolerance);

/// Returns the fields of both answers, of check_answer and of check_against_answer.
std::vector<FieldText> check_fields();

}  // namespace contensou::answers
