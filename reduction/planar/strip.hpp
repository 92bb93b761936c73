#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "numerics/legendre_series.hpp"
#include "planar/directions.hpp"
#include "planar/section_field.hpp"

namespace contensou::reduction {

/// Thrown if T of planar.md (R64) changes its sign within a sector, or if within a turn T is 0 up to its errors.
struct MissedRay {
  Eigen::Vector2d n;
  bool crossed;  ///< true: T has the other sign at n; false: T is 0 up to its errors
};

/// The end of an orbit at an end of a sector: the centre (p -> -infinity), infinity, a point (finite p), or not known.
enum class Limit { centre, infinity, point, undecided };

/// The orbits of one sector between two dividing directions, or of the whole plane if there are none: copies of one
/// curve p = L(xi). xi falls along every orbit. In a sector exp(xi) = z/(1 - z/length), where z is the angle from the
/// end to which orbits tend. Without dividing directions xi is the angle against the motion; L and M, the time left
/// divided by exp(c p), then continue over the turns.
class Strip {
 public:
  /// @param breaks     directions within the strip at which R and T might not be smooth
  /// @param sense      direction in which xi grows: 1 for counter-clockwise, else -1
  /// @param length     angle between the ends
  /// @param tolerance  relative error of the panels
  /// @param slide      R along the end `to`, if orbits slide along it
  /// @throws MissedRay
  Strip(const SectionField& field, const Approach& to, const Approach& from, const std::vector<Eigen::Vector2d>& breaks,
        double sense, double length, double tolerance, std::optional<double> slide = {});

  /// Makes the strip of the whole plane, without ends.
  Strip(const SectionField& field, const std::vector<Eigen::Vector2d>& breaks, double sense, double tolerance);

  bool closed() const { return !to_; }
  const Approach& to() const { return *to_; }
  const Approach& from() const { return *from_; }
  /// Return the limits of p at the end of the orbit and at its beginning.
  Limit limit() const;
  Limit origin() const;
  /// Returns the growth of p in one turn; 0 if the growth is smaller than its error.
  double turn() const { return turn_; }
  double turn_sigma() const;
  /// Returns M at xi = 2 pi, the time of a turn that begins there, divided by exp(c p). Only if orbits are not timed.
  double turn_time() const { return last_time_; }

  /// In a sector, below this xi, R and T equal their leading powers.
  static constexpr double first = -40;

  /// Returns xi of a direction; -infinity or infinity at the ends of the strip; empty for a direction beyond the ends.
  std::optional<double> locate(const Eigen::Vector2d& n) const;
  Eigen::Vector2d direction(double xi) const;

  /// Returns L(xi), which is 0 at xi = 0.
  double ln_rho(double xi) const;

  /// Returns true if orbits reach their end in finite time. time_left is then the time left divided by exp(c p). In a
  /// closed strip it is otherwise the time until the next xi that is a multiple of 2 pi.
  bool timed() const { return timed_; }
  double time_left(double xi) const;

  /// Returns true if orbits come to a ray in finite time and then continue along the ray.
  bool joins_ray() const;
  /// Returns true if orbits come to a curve along which they slide.
  bool slides() const { return slide_.has_value(); }
  /// Returns R on this ray.
  double along_ray() const { return slide_.value_or(to_->radial().factor); }

  /// Returns the largest panel edge below xi; -infinity if there is none. Between the edge and xi, s and R are smooth.
  double smooth_from(double xi) const;

  /// Returns the rate s(xi) at which xi falls: d sigma = -d xi/s(xi).
  double rate(double xi) const { return terms(xi).rate; }

 private:
  struct Terms {
    double rate;       ///< s
    double radial;     ///< R
    double rounding;   ///< relative error of s
    double of_radial;  ///< error of R by rounding; its terms can cancel
  };
  struct Panel : SeriesPanel {
    LegendreSeries ln_rho, time;
  };

  double sector_angle(double xi, bool from_far) const;
  Terms terms(double xi) const;
  double first_time();
  void solve(std::vector<double> edges, double first_time);
  void march(double left, double right, int depth);
  std::optional<double> jump(double left, double right) const;

  const SectionField* field_;
  std::optional<Approach> to_, from_;
  std::optional<double> slide_ = {};
  double sense_;  ///< 1: xi grows counter-clockwise; -1: clockwise
  double length_;
  double tolerance_;
  bool timed_ = false;
  double time_order_ = 0;  ///< exponent a in M ~ exp(a xi) next to the end
  double turn_ = 0, turn_error_ = 0;
  double last_time_ = 0;
  std::vector<Panel> panels_;
};

}  // namespace contensou::reduction
