#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "fit/dependence.hpp"
#include "fit/profile.hpp"
#include "fit/student.hpp"

namespace contensou::fit {

/// A number with at least this relative error counts as unknown, because catalogues are more accurate.
inline constexpr double unknown = 0.5;

/// A normal error exceeds this many standard deviations on one side by chance in about one of ten thousand films.
inline constexpr double too_rare = 3.7;

/// Errors below this share of the range of values are not the noise of a film: the values are computed or rounded.
inline constexpr double sharpest_film = 1e-4;

inline bool is_of_contact(Parameter parameter) { return static_cast<int>(parameter) < contact_parameters; }

/// The inverse of an information matrix, and the parameters that the matrix does not determine.
struct Inverse {
  Eigen::MatrixXd covariance;
  Eigen::MatrixXd root;  ///< the product with its transpose is the covariance
  std::vector<bool> undecided;
};

/// The report on a solution. If `better` is set, a better solution was found on the way, and the intervals are invalid.
struct Report {
  Fit fit;
  std::optional<Eigen::VectorXd> better = {};
  /// Starts for a fit in which the patch radius is free, its solution first; empty if no patch is seen.
  std::vector<Eigen::VectorXd> with_patch = {};
};

/// Computes the report from a solution.
class Reporter {
 public:
  /// @param planned  true for a film that is not made yet: there are no values, and no intervals by profile likelihood
  Reporter(const Search& search, const Eigen::VectorXd& solution, bool planned)
      : search_(search),
        request_(search.request),
        planned_(planned),
        parameters_(search.model.limited(solution)),
        values_(search.model.values(parameters_)) {}

  Report report();

 private:
  /// Sets the ball and the law, the number of values and the goodness of the fit.
  void set_size();
  /// Sets covariance and correlations from the curvature of the sum of squares.
  void set_errors();
  void set_covariance(const Eigen::MatrixXd& covariance);
  /// Estimates the dependence of errors of unknown size on each other, and increases the covariance accordingly.
  void set_dependence();
  /// Estimates the dependence of the residuals of an observable.
  /// @param rows_of_A  rows s a_i as in dependence.hpp, for all residuals
  Dependence dependence_of(std::size_t place, const Eigen::VectorXd& residuals, const Eigen::MatrixXd& rows_of_A) const;
  /// Returns the correlation of neighbouring residuals that chance exceeds in one film of ten thousand.
  static double by_chance(double values);
  /// Returns true if neighbouring residuals of an observable are more alike than chance makes them.
  bool neighbours_depend(Observable observable) const;
  /// Largest variation of the friction of a real table. Beyond that the law of the motion is another one.
  static constexpr double most_varying = 0.1;
  /// Widens the errors for friction that varies along the path and for dependent errors of the camera.
  void set_widened(const Eigen::VectorXd& residuals);
  /// Returns the largest range of the values of an observable, or of the other axis beside it.
  double range_of(std::size_t place) const;
  /// Returns the variance of a number divided by the variance that independent errors would give.
  double growth_of(const Coordinate& number) const;
  void set_estimates();
  void add_estimate(Parameter parameter, std::size_t track);
  /// Sets, for a plan, the combination that the film determines if it does not separate friction and patch radius.
  void set_only_by_curvature();
  /// Returns true if a number is so uncertain that a parabola is a poor model of the sum of squares.
  bool is_vague() const;
  bool needs_profile() const;
  void set_profiles();
  /// A number whose profile likelihood is computed, and its limits.
  struct Number {
    Coordinate coordinate;
    std::optional<std::size_t> estimate;  ///< index in Fit::estimates; empty for a combination
    double error;                         ///< standard error by curvature
    double low, high;
    Interval interval;
  };
  std::optional<Number> number_of(std::size_t estimate) const;
  Number combined(const Eigen::Vector2d& powers) const;
  void set_other_motions(Profile& profile);
  void set_profile(const Number& number);
  void set_only(const std::vector<Number>& numbers);
  Outlier place_of(Eigen::Index row) const;
  void set_noise();
  void set_predicted();
  void set_ball();
  /// Sets the spreads of the numbers of the ball. They remain empty if the data do not determine one of the numbers.
  void set_spreads();
  double held_back(std::size_t free) const;
  void set_misfits();
  void set_rolling_friction_seen();
  void set_patch_seen();
  void require_numbers() const;

  bool is_free(Eigen::Index place) const { return std::ranges::find(search_.free, place) != search_.free.end(); }
  bool both_free() const { return request_.free.friction && request_.free.patch_radius; }
  /// Returns true if a series shows this number of the start: slip shows the slip; spin or angle shows the spin.
  bool is_seen(Parameter parameter, std::size_t track) const;
  /// Returns true if the data contain x, y, vx or vy.
  bool moves(std::size_t track) const;
  /// Returns the residual. In a robust fit it is clamped to the limits beyond which Huber's loss is linear.
  double bounded(double residual) const {
    return request_.robust ? std::clamp(residual, -huber_bend, huber_bend) : residual;
  }

  const Search& search_;
  const FitRequest& request_;
  const bool planned_;
  Eigen::VectorXd parameters_, values_, residuals_;
  Eigen::MatrixXd derivatives_;  ///< derivatives of the residuals by the free parameters
  Eigen::MatrixXd information_;
  Inverse inverse_;
  Eigen::MatrixXd covariance_;  ///< covariance of the free parameters
  Eigen::VectorXd deviation_;   ///< standard errors of the free parameters
  Dependence dependence_[7];    ///< dependence of the errors of each observable whose standard deviation is not given
  double rest_[7] = {};         ///< standard deviation of the residuals that varying friction leaves, in SI units
  double variance_ = 1;         ///< factor of all variances in a robust fit, else 1
  double quantile_ = normal_quantile;
  Fit fit_;
  std::optional<Eigen::VectorXd> better_;
  std::vector<Eigen::VectorXd> with_patch_;
};

}  // namespace contensou::fit
