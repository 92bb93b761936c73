#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace contensou::fit {

/// The numbers of a ball that a film can show. Position and velocity are those of the centre, in any axes on the plane.
/// The angle is the turning angle about the vertical, the integral of omega_z.
enum class Observable { slip, spin, x, y, vx, vy, angle };

/// The name of an observable, its unit and its meaning.
struct ObservableKind {
  Observable observable;
  std::string_view name;
  std::string_view unit;  ///< SI unit, the symbol of a si::Dimension if one exists; rad for the angle
  std::string_view meaning;
};
const std::vector<ObservableKind>& observable_kinds();
const ObservableKind& kind_of(Observable observable);

/// One observable of a track, with a value for each time.
struct Series {
  Observable observable;
  Eigen::ArrayXd value;  ///< in SI units; NaN for a missing value. An angle may be known only up to whole turns
  Eigen::ArrayXd sd;     ///< standard deviations of the values, > 0; if empty, they are unknown and all equal
};

/// A number and its standard deviation.
struct Measured {
  double value;
  double sd;
};

/// One motion of the ball in a film. It begins at the time `start`. The fitted numbers of its start, such as slip and
/// spin, apply at this time.
struct Track {
  std::string name = {};
  Eigen::ArrayXd t = {};  ///< times, s, increasing
  std::vector<Series> series = {};
  std::optional<Measured> stop_time = {};  ///< time after `start`, s, at which slip and spin end
  double start = 0;                        ///< time at which the motion begins, s
};

/// Throws for a track to which no motion can be fitted.
/// @throws std::domain_error  with the name of the series: if sizes differ, if a time or a standard deviation is
///                            invalid, if a time is before the start,
///                            or if there is neither a value nor a stop time
void require(const Track& track);

}  // namespace contensou::fit
