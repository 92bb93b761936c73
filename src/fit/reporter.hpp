#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "fit/dependence.hpp"
#include "fit/profile.hpp"
#include "fit/report.hpp"
#include "fit/student.hpp"

namespace contensou::fit {

/// A relative error from which on a number counts as unknown: catalogues are better.
inline constexpr double unknown = 0.5;

inline bool is_of_contact(Parameter parameter) { return static_cast<int>(parameter) < contact_parameters; }

/// The inverse of a matrix of information, and which parameters it does not decide.
struct Inverse {
  Eigen::MatrixXd covariance;
  Eigen::MatrixXd root;  ///< times its transpose: the covariance
  std::vector<bool> undecided;
};

/// A solution and what follows from it.
class Reporter {
 public:
  Reporter(const Search& search, const Eigen::VectorXd& solution, bool planned)
      : search_(search),
        request_(search.request),
        planned_(planned),
        parameters_(search.model.limited(solution)),
        values_(search.model.values(parameters_)) {}

  Report report();

 private:
  /// What is fitted, how many values, how well.
  void set_size();
  /// Covariance and correlations, by curvature.
  void set_errors();
  void set_covariance(const Eigen::MatrixXd& covariance);
  /// Finds the dependence of errors of unknown size on each other, and adds it to the covariance.
  void set_dependence();
  /// By what the variance of a number is larger than of independent errors.
  double growth_of(const Coordinate& number) const;
  void set_estimates();
  void add_estimate(Parameter parameter, std::size_t track);
  /// Of a plan: the combination that is known where friction and patch radius are not.
  void set_only_by_curvature();
  /// Whether a number is known so badly that a parabola is no good model of the sum of squares.
  bool is_vague() const;
  bool needs_profile() const;
  void set_profiles();
  /// What is profiled, and between which ends.
  struct Number {
    Coordinate coordinate;
    std::optional<std::size_t> estimate;  ///< whose it is
    double error;                         ///< by curvature
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
  /// What the ball's numbers are known to; nothing where the data leave one of them open.
  void set_spreads();
  double held_back(std::size_t free) const;
  void set_misfits();
  void set_rolling_friction_seen();
  void require_numbers() const;

  bool is_free(Eigen::Index place) const { return std::ranges::find(search_.free, place) != search_.free.end(); }
  bool both_free() const { return request_.free.friction && request_.free.patch_radius; }
  /// Whether a number of the start is in the data as such.
  bool is_seen(Parameter parameter, std::size_t track) const;
  /// True if x, y, vx or vy is in the data.
  bool moves(std::size_t track) const;
  /// A residual, or what Huber's loss lets it count for.
  double bounded(double residual) const {
    return request_.robust ? std::clamp(residual, -huber_bend, huber_bend) : residual;
  }

  const Search& search_;
  const FitRequest& request_;
  const bool planned_;
  Eigen::VectorXd parameters_, values_, residuals_;
  Eigen::MatrixXd derivatives_;  ///< of the residuals, by what is free
  Eigen::MatrixXd information_;
  Inverse inverse_;
  Eigen::MatrixXd covariance_;  ///< of the free parameters
  Eigen::VectorXd deviation_;   ///< their standard errors
  Dependence dependence_[7];    ///< of the errors of each observable, where their size is not given
  double variance_ = 1;         ///< by which the robust loss needs more data for the same error
  double quantile_ = normal_quantile;
  Fit fit_;
  std::optional<Eigen::VectorXd> better_;
};

}  // namespace contensou::fit
