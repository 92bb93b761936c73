#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace contensou::fit {

/// What a film shows of a ball. Position and velocity are of the centre, in any axes on the plane; the angle is what the
/// ball has turned about the vertical: the integral of omega_z.
enum class Observable { slip, spin, x, y, vx, vy, angle };

/// How an observable is called, and what it is.
struct ObservableKind {
  Observable observable;
  std::string_view name;
  std::string_view unit;  ///< SI, as the symbol of a si::Dimension where there is one; rad of the angle
  std::string_view meaning;
};
const std::vector<ObservableKind>& observable_kinds();
const ObservableKind& kind_of(Observable observable);

/// One observable of a track, a value for each instant.
struct Series {
  Observable observable;
  Eigen::ArrayXd value;  ///< SI; NaN: not measured then. An angle may be known up to whole turns
  Eigen::ArrayXd sd;     ///< standard deviations, > 0, of the same size; empty: unknown, one for all of the observable
};

/// A number and its standard deviation.
struct Measured {
  double value;
  double sd;
};

/// One motion of the ball as it was seen. It begins at the time `start`: slip, spin and all else that is fitted of its
/// start are those of that instant.
struct Track {
  std::string name = {};
  Eigen::ArrayXd t = {};  ///< s, increasing
  std::vector<Series> series = {};
  std::optional<Measured> stop_time = {};  ///< s after `start`, when slip and spin end
  double start = 0;                        ///< s
};

/// Rejects a track that no motion can be fitted to.
/// @throws std::domain_error  naming the series: if sizes differ, a time or a standard deviation is not what it must be,
///                            a time is before the start, or there is neither a value nor a stop time
void require(const Track& track);

}  // namespace contensou::fit
