#pragma once

#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "contensou/reduction/planar_reduction.hpp"
#include "planar/section_field.hpp"

namespace contensou::reduction {

/// A method that solves a planar system. PlanarReduction checks the arguments, then calls these functions.
struct PlanarReduction::Solution {
  Solution(SmoothField of, std::string_view way) : field(std::move(of)), form(way) {}
  Solution(const Solution&) = delete;
  Solution& operator=(const Solution&) = delete;
  virtual ~Solution() = default;

  virtual double factor(const Eigen::Vector2d& x) const = 0;
  virtual std::vector<FactorPiece> factor_pieces(const Eigen::Vector2d&, const Eigen::Vector2d&) const { return {}; }
  virtual PlanarOrbit orbit(const Eigen::Vector2d& start) const = 0;
  /// Returns the motion from the centre of the scaling: it rests there unless the field has a value other than 0.
  virtual PlanarOrbit orbit_from_centre() const;
  virtual PlanarOrbit part_of_orbit(const Eigen::Vector2d& start) const { return orbit(start); }
  /// @param orbit  orbit from x
  virtual double end_time_error(const Eigen::Vector2d& x, const PlanarOrbit& orbit) const = 0;
  virtual std::optional<double> first_integral(const Eigen::Vector2d& x) const = 0;
  virtual std::vector<LevelPoint> levels(const std::vector<Eigen::Vector2d>& path) const;
  virtual std::shared_ptr<const Solution> reversed() const = 0;
  virtual std::string formula() const { return {}; }

  /// Returns the canonical coordinates of the scaling. A solution without a scaling throws here, and in `point`.
  /// @param x  finite, and not the centre
  virtual PlanarCanonical canonical(const Eigen::Vector2d&) const { throw without_scaling(); }
  virtual Eigen::Vector2d point(double, double) const { throw without_scaling(); }

  virtual const Flow* flow() const { return nullptr; }

  static std::domain_error without_scaling() {
    return std::domain_error("the system has no scaling, and no canonical coordinates of one");
  }

  SmoothField field;
  std::string_view form;
  std::string why_not;
  std::vector<TriedForm> tried;
  std::optional<Generator> scaling;
  Eigen::Vector2d centre = Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
  bool star = false;
  std::vector<PlanarRay> rays;
  std::vector<PlanarSector> sectors;
  std::optional<PlanarTurn> turn;
  std::string undecided;
  bool branches = false;  ///< true if an undecided end is a place that motions leave in several ways
  std::string_view kind;
};

/// A solution by a scaling, in the coordinates of its section.
struct SectionSolution : PlanarReduction::Solution {
  SectionSolution(SmoothField given, const Generator& generator, const Eigen::Vector2d& around)
      : Solution(std::move(given), "scaling"), section(field, generator, around) {
    scaling = generator;
    centre = section.centre();
  }

  static double angle_of(const Eigen::Vector2d& n) { return std::atan2(n[1], n[0]); }

  PlanarCanonical canonical(const Eigen::Vector2d& x) const override {
    const auto [n, p] = section.canonical(x);
    const auto rates = section(n);
    return {angle_of(n), p, rates ? rates->radial / rates->angular : std::numeric_limits<double>::quiet_NaN()};
  }
  Eigen::Vector2d point(double q, double p) const override { return section.point(turned({1, 0}, q), p); }
  double factor(const Eigen::Vector2d& x) const override { return cross(field(x), scaling->matrix * (x - centre)); }

  SectionField section;
};

/// Solves a system by its scaling. Arguments and exceptions are those of the constructor of PlanarReduction.
std::shared_ptr<const PlanarReduction::Solution> solved_by_scaling(SmoothField field, const Generator& scaling,
                                                                   const Eigen::Vector2d& around, double noise);

/// Returns the period of an orbit, or else its end time.
inline double period_or_end(const PlanarOrbit& orbit) { return orbit.period().value_or(orbit.end_time()); }

/// Returns the solution of by_factor, which has no form if it is by steps.
std::shared_ptr<PlanarReduction::Solution> solved_by_factor(const SmoothField& field, const Eigen::Vector2d& start);

/// Returns a solution by steps, as by_steps.
std::shared_ptr<PlanarReduction::Solution> solved_by_steps(SmoothField field, double tolerance = 1e-12,
                                                           std::size_t most_steps = 10'000);

struct PlanarOrbit::Motion {
  virtual ~Motion() = default;

  /// @param time  0 <= time < end_time
  virtual Eigen::Vector2d at(double time) const = 0;

  virtual std::optional<double> period() const { return std::nullopt; }

  virtual double first_slide() const { return std::numeric_limits<double>::infinity(); }

  /// Returns the point at which the orbit stays from end_time on; it is used only if the orbit has such a point.
  virtual Eigen::Vector2d at_end() const = 0;

  PlanarEnd end = PlanarEnd::centre;
  double end_time = 0;  ///< time of the end, also if the orbit ends at a border
  Eigen::Vector2d limit =
      Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());  ///< for an end at infinity
  bool border_time_known = false;  ///< false: PlanarOrbit::end_time returns infinity at a border
  std::string undecided = {};
  bool unique = true;  ///< false if several motions go on after the last time of at()
};

}  // namespace contensou::reduction
