#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "contensou/fit/fit.hpp"
#include "fit/search.hpp"

namespace contensou::fit {

/// Intervals by profile likelihood. A value of a number is in its interval if the sum of squares rises by at most a
/// given amount when all other numbers are fitted anew.
///
/// The search follows the valley of small sums of squares outward from the farthest known point. Then it takes wide
/// steps to the limits of the model. Minimisations start from the guesses and from all points found before, also for
/// the intervals of other numbers. A second valley that is found belongs to the interval.
class Profile {
 public:
  /// @param search  search in which all standard deviations are set; kept by reference
  /// @param best    the estimate
  /// @param rise    rise of the sum of squares at the ends of an interval, > 0
  /// @param wide    true if there may be valleys other than the valley of the estimate
  Profile(const Search& search, const Eigen::VectorXd& best, double rise, bool wide);

  /// Sets the rise for the intervals that follow.
  void set_rise(double rise) { rise_ = rise; }

  /// Returns the interval of a number. An end is infinite if only a limit of this or of another number determines it.
  /// @param error      standard error of the number by curvature; infinite or 0 if there is none
  /// @param low, high  limits of the number
  Interval of(const Coordinate& number, double error, double low, double high);

  /// Parameters, and their sum of squares minus the sum of squares of the estimate.
  struct Point {
    Eigen::VectorXd parameters;
    double excess;
  };

  /// Finds minima other than the estimate whose excess is below the rise. Between each minimum and the estimate there
  /// is a value of the number at which the excess, with all other numbers fitted anew, is above the rise. Later
  /// intervals include these minima.
  /// @param values  values of the number, increasing, so close that no two minima lie between neighbours
  std::vector<Point> other_minima(const Coordinate& number, const std::vector<double>& values);

  /// Returns true if a search along another number found points of the valley beyond this interval of a number.
  bool reaches_beyond(const Coordinate& number, const Interval& interval) const;

  /// Returns a better estimate if a search found one. The intervals are then invalid.
  const std::optional<Eigen::VectorXd>& better() const { return better_; }

 private:
  /// Improves the best guess for each friction and for each patch radius, so that guesses surround the valley.
  void spread();

  /// Finds the upper (sign = 1) or the lower (sign = -1) end of an interval; infinite as in `of`.
  double end(const Coordinate& number, double sign, double error, double limit);

  /// Returns the point with the lowest sum of squares that is found with the number held at a value.
  /// @param foretold  extrapolated parameters of the valley
  /// @param most      largest number of starts
  const Point& lowest(const Coordinate& number, double at, const Eigen::VectorXd& foretold, std::size_t most);

  /// Returns starts for a search with the number held, the best first. They are points found before, also along other
  /// numbers, moved to the held value.
  std::vector<Eigen::VectorXd> starts_at(const Coordinate& number, double at, const Eigen::VectorXd& foretold,
                                         std::size_t most) const;

  /// Returns true if, with the number held, only a limit of another number keeps the sum of squares from falling.
  bool is_held_by_limit(const Coordinate& number, const Eigen::VectorXd& parameters) const;

  /// Returns the best guess whose number is within 1 of `at`, else the nearest guess; null without guesses.
  const Eigen::VectorXd* nearest_guess(const Coordinate& number, double at) const;

  const Search& search_;
  Eigen::VectorXd best_;
  double rise_, least_;
  bool wide_;
  std::vector<Point> points_;
  std::optional<Eigen::VectorXd> better_;
};

}  // namespace contensou::fit
