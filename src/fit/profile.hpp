#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "contensou/fit/fit.hpp"
#include "fit/search.hpp"

namespace contensou::fit {

/// Profile likelihood: how far a number can go, all else fitted anew, until the sum of squares has risen by so much.
///
/// From the farthest point that is known it goes outward along the valley, each point from its neighbours, then in wide
/// steps to the end of what the model allows, from the guesses and from all points that were found before, also along other
/// numbers: a valley that is met anew belongs to the interval.
class Profile {
 public:
  /// @param search  with all standard deviations; kept by reference
  /// @param best    the estimate
  /// @param rise    of the sum of squares at the ends of an interval
  /// @param wide    whether there may be more than the valley about the estimate
  Profile(const Search& search, const Eigen::VectorXd& best, double rise, bool wide);

  /// The rise that counts from now on.
  void set_rise(double rise) { rise_ = rise; }

  /// What a number may be; infinite where the data set no end: also where the end is that of another number, which would
  /// go beyond its limit.
  /// @param error   its standard error, by curvature; any where there is none
  /// @param low, high  its least and largest values that can be
  Interval of(const Coordinate& number, double error, double low, double high);

  /// Parameters, and by how much more their sum of squares is than that of the estimate.
  struct Point {
    Eigen::VectorXd parameters;
    double excess;
  };

  /// Finds the minima apart from the estimate that an interval allows: between it and each of them is a value of the number
  /// that no interval allows, all else fitted anew. An interval that is asked for later spans them.
  /// @param values  of the number, increasing, so close that no two minima lie between neighbours
  std::vector<Point> other_minima(const Coordinate& number, const std::vector<double>& values);

  /// Whether the valley was met beyond an interval of a number, when another one was followed.
  bool reaches_beyond(const Coordinate& number, const Interval& interval) const;

  /// A better estimate, where one was met: then no interval counts.
  const std::optional<Eigen::VectorXd>& better() const { return better_; }

 private:
  /// Improves the best guess of each friction and of each patch radius, which lie about the valley.
  void spread();

  /// Where the interval ends on one side.
  double end(const Coordinate& number, double sign, double error, double limit);

  /// The lowest sum of squares found with the number held there.
  /// @param foretold  where the valley seems to go
  /// @param most      starts
  const Point& lowest(const Coordinate& number, double at, const Eigen::VectorXd& foretold, std::size_t most);

  /// Where to begin from, the best first: of the points found before, also along other numbers.
  std::vector<Eigen::VectorXd> starts_at(const Coordinate& number, double at, const Eigen::VectorXd& foretold,
                                         std::size_t most) const;

  /// Whether the sum of squares would be lower there, with the number held, if another one could go beyond its limit.
  bool is_held_by_limit(const Coordinate& number, const Eigen::VectorXd& parameters) const;

  /// The best guess with a value near that one.
  const Eigen::VectorXd* nearest_guess(const Coordinate& number, double at) const;

  const Search& search_;
  Eigen::VectorXd best_;
  double rise_, least_;
  bool wide_;
  std::vector<Point> points_;
  std::optional<Eigen::VectorXd> better_;
};

}  // namespace contensou::fit
