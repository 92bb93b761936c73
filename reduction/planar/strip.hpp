#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "contensou/reduction/planar_symmetry.hpp"
#include "numerics/legendre_series.hpp"

namespace contensou::reduction {

/// f on the closed curve x_0 + S n(q) that the scaling moves over the plane (README (R42)).
class SectionField {
 public:
  /// p' = R and q' = T in the time sigma.
  struct Rates {
    double radial, angular;
    double size;  ///< |S^-1 f|
  };

  /// @throws std::domain_error  unless all eigenvalues of the scaling's matrix have positive real parts
  SectionField(PlanarField field, const Generator& scaling, const Eigen::Vector2d& around);

  /// At a unit vector n; none where the field has no value.
  std::optional<Rates> operator()(const Eigen::Vector2d& n) const;

  /// Whether the field has a value at the centre that is not 0.
  bool regular() const;

  double time_degree() const { return time_; }  ///< c: dt = exp(c p) d sigma
  const Eigen::Vector2d& centre() const { return centre_; }
  const Eigen::Matrix2d& frame() const { return frame_; }  ///< S

  /// n and p of a point other than the centre.
  std::pair<Eigen::Vector2d, double> canonical(const Eigen::Vector2d& x) const;
  /// n of a direction seen from the centre, on the curve.
  Eigen::Vector2d on_section(const Eigen::Vector2d& direction) const;
  Eigen::Vector2d point(const Eigen::Vector2d& n, double p) const;

 private:
  PlanarField field_;
  double time_;
  Eigen::Vector2d centre_;
  Eigen::Matrix2d frame_, frame_inverse_, matrix_;  ///< S, S^-1, A' = S^-1 A S
};

/// n turned counter-clockwise, to the last bits of each component for small angles.
Eigen::Vector2d turned(const Eigen::Vector2d& n, double angle);

/// Where a sector ends: a ray, or a border that no orbit crosses.
struct SectorEnd {
  Eigen::Vector2d n;
  bool ray;
  double radial = 0;  ///< R on the ray
};

/// T has the other sign within a sector, or cannot be told from 0 on a turn: here.
struct MissedRay {
  Eigen::Vector2d n;
  bool crossed;  ///< the first of both
};

/// The orbits of one sector between two ends, or of the whole plane where there are none: copies of one curve p = L(xi).
///
/// xi falls along every orbit. In a sector exp(xi) = z/(1 - z/length), z the angle from the end that it comes to; else
/// xi is the angle against the motion, and L and M go on over the turns.
class Strip {
 public:
  Strip(const SectionField& field, const SectorEnd& to, const SectorEnd& from, double sense, double length,
        double tolerance);
  /// Without ends. Both throw MissedRay.
  Strip(const SectionField& field, double sense, double tolerance);

  bool closed() const { return !to_; }
  const SectorEnd& to() const { return *to_; }
  const SectorEnd& from() const { return *from_; }
  double to_rate() const { return -to_series_.at_end; }     ///< dT/dq at the end that it comes to: <= 0
  double from_rate() const { return from_series_.at_end; }  ///< and at the other: >= 0
  double turn() const { return turn_; }                     ///< what p grows by in a turn
  double turn_sigma() const;

  /// In a sector: next to its end nearer than this s and R are as on the ray.
  static constexpr double first = -40;

  /// xi of a direction; none outside. -infinity and infinity on the ends.
  std::optional<double> locate(const Eigen::Vector2d& n) const;
  Eigen::Vector2d direction(double xi) const;

  /// L(xi); 0 at xi = 0.
  double ln_rho(double xi) const;

  /// Whether orbits come to their end in finite time; then the time left over exp(c p).
  bool timed() const { return timed_; }
  double time_left(double xi) const;

  /// d sigma = -d xi/s(xi).
  double rate(double xi) const { return terms(xi).rate; }

 private:
  struct Terms {
    double rate;      ///< s
    double radial;    ///< R
    double rounding;  ///< relative error of s
  };
  /// s and R next to a ray, where T loses its digits.
  struct EndSeries {
    double width = 0;   ///< none: 0
    double at_end = 0;  ///< s there
    LegendreSeries rate, radial;
  };
  struct Panel {
    double left, right;
    LegendreSeries ln_rho, time;
  };

  double sector_angle(double xi, bool from_far) const;
  Terms terms(double xi) const;
  EndSeries series_at(bool far) const;
  void solve(std::vector<double> edges, double first_time);
  void march(double left, double right, int depth);
  const Panel& find(double xi) const;

  const SectionField* field_;
  std::optional<SectorEnd> to_, from_;
  double sense_;  ///< of growing xi: 1 counter-clockwise
  double length_;
  double tolerance_;
  EndSeries to_series_, from_series_;
  bool timed_ = false;
  double turn_ = 0;
  double last_time_ = 0;
  std::vector<Panel> panels_;
};

}  // namespace contensou::reduction
