#pragma once

#include <functional>
#include <string>
#include <vector>

#include "answers/input/csv.hpp"
#include "contensou/reduction/friction_law.hpp"
#include "contensou/reduction/infinity.hpp"
#include "contensou/si/description.hpp"
#include "contensou/si/experiment.hpp"

namespace contensou::answers {

/// How far slip or spin of a table is from that of a model.
struct Deviation {
  double error = 0;          ///< the worst, in m/s or rad/s
  double relative = 0;       ///< the same, of the start
  double t = infinity;       ///< s in the table, of the worst row
  double leaves = infinity;  ///< s in the table, of the first row beyond the tolerance
};

/// A model of the motion beside a table.
struct ModelBeside {
  std::string name;
  std::function<si::SlipAndSpin(double)> motion;  ///< at a time in s from the first row
  Deviation slip = {}, spin = {};

  double worst() const;  ///< relative
};

/// A row of a table.
struct Instant {
  long line;
  double t;  ///< s
  si::SlipAndSpin speeds;
  std::optional<si::Velocities> body = {};  ///< of a rigid body
};

/// A table of a ball's motion beside those of a ball that starts as it does.
struct MotionsBeside {
  std::vector<Instant> rows;
  si::SlipAndSpin start;
  double slip_unit, spin_unit;      ///< what errors are shares of, in m/s and rad/s
  std::vector<ModelBeside> models;  ///< the law's own first

  /// The model that is closest, the law's own before others as close.
  const ModelBeside& nearest() const;
};

/// The log of a rigid body: slip is |(vx - R wy, vy + R wx)|, Zh98 (2.1), of a body that lies flat |(vx, vy)|.
///
/// @param path       of a file with columns t (or time), slip and spin (or wz, as roll calls it), or, of a rigid body, vx, vy,
///                   wx, wy, wz in place of slip and spin; in SI units or in those behind their names; "-" is standard input
/// @param ball       starts as the first row says
/// @param values     in place of those of the first row
/// @param tolerance  a share of the start
/// @throws BadLine            for a mistake in the table, a start among them that the ball cannot have
/// @throws std::system_error  if the file cannot be read
MotionsBeside compare_with_motions(const std::string& path, const si::Experiment& ball, const si::Description& values,
                                   const reduction::Law& law, double tolerance);

}  // namespace contensou::answers
