#include "fit/report.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

namespace contensou::fit {

using Eigen::Index;
using Eigen::VectorXd;

/// Returns how many standard errors a free parameter at a limit would go beyond it; 0 for a parameter within limits.
double Reporter::held_back(std::size_t free) const {
  const Index place = search_.free[free];
  const auto [low, high] = search_.model.range(place);
  const bool below = parameters_[place] <= low, above = parameters_[place] >= high;
  if (!below && !above) return 0;
  const double outward = search_.slope(parameters_, VectorXd::Unit(parameters_.size(), place)) * (below ? -1 : 1);
  const auto at = static_cast<Index>(free);
  return -outward / 2 * inverse_.covariance(at, at) / deviation_[at];
}

double Reporter::by_chance(double values) {
  // Among few values any correlation may be due to chance. A correlation of 0.9 means that the common error of
  // neighbours is four times their independent error.
  constexpr double surely = 0.9;
  return std::min(surely, too_rare / std::sqrt(values));
}

bool Reporter::neighbours_depend(Observable observable) const {
  const auto place = static_cast<std::size_t>(observable);
  const std::vector<Index>& rows = search_.rows_of[place];
  // The errors of rounded values are correlated with the errors of their neighbours.
  return search_.estimated[place] && !rows.empty() && 1 / search_.weight[rows.front()] > search_.rounding[place] &&
         dependence_[place].neighbours > by_chance(static_cast<double>(rows.size()));
}

void Reporter::set_misfits() {
  for (std::size_t i = 0; i < search_.free.size(); ++i) {
    if (held_back(i) < too_rare) continue;
    const Parameter parameter = TrackModel::parameter_at(search_.free[i]);
    if (parameter != Parameter::rolling) {
      fit_.misfits.push_back(fmt::format(
          "the film asks for a {} beyond what it may be: friction 1e-4 to 10, a patch not larger than the ball "
          "nor so large that the law has an invariant ray, slip and R spin up to 100 m/s; are the units right?",
          kind_of(parameter).name));
    } else {
      fit_.misfits.emplace_back(
          "the ball turns against its sliding at first, as after a draw, which a fit with rolling friction does not "
          "know: "
          "leave it out, and the film's end, too (until)");
    }
  }
  for (const Estimate& slip : fit_.estimates) {
    constexpr double clearly = 4;
    if (slip.parameter == Parameter::slip && slip.value < -clearly * slip.standard_error)
      fit_.misfits.push_back(fmt::format(
          "the slip at the start is {:.4g} m/s, and a speed is 0 or more: turn the sign of what was measured, "
          "vx - R wy of a ball that spins faster than it rolls",
          slip.value));
  }
  const bool varies_too_much = fit_.widened && fit_.widened->friction_varies > most_varying;
  for (const Noise& noise : fit_.noise) {
    const auto& [observable, name, unit, meaning] = kind_of(noise.observable);
    const auto place = static_cast<std::size_t>(observable);
    constexpr double blurred = 0.5;
    if (observable == Observable::angle && noise.estimated && noise.sd > blurred) {
      fit_.misfits.push_back(fmt::format(
          "the angle is off by {:.2g} rad on the average, so that its whole turns are not known", noise.sd));
      continue;
    }
    // Errors of a camera are up to a hundredth of the way that it shows, or a degree.
    constexpr double share = 0.01;
    const double least = observable == Observable::angle ? std::numbers::pi / 180 : 0;
    const bool of_camera = fit_.widened && rest_[place] <= std::max(share * range_of(place), least);
    if (neighbours_depend(observable) && (!of_camera || varies_too_much)) {
      fit_.misfits.push_back(fmt::format(
          "{} is off by {:.2g} {} on the average, and neighbours are off alike: their correlation is {:.2f}, "
          "by chance up to {:.2f}",
          name, noise.sd, unit, dependence_[place].neighbours, by_chance(static_cast<double>(noise.values))));
    }
  }
  if (varies_too_much)
    fit_.misfits.push_back(
        fmt::format("friction would have to vary by {:.2g} % along the path; up to {:.0f} % are allowed",
                    100 * fit_.widened->friction_varies, 100 * most_varying));
  if (std::ranges::all_of(fit_.noise, &Noise::estimated) && !fit_.noise.empty()) return;
  // Approximation of Wilson and Hilferty: the cube root of chi^2 has a normal distribution.
  constexpr double too_much = 2;
  const double n = fit_.degrees_of_freedom, share = 2 / (9 * n);
  double reduced = fit_.reduced_chi2();
  if (request_.robust) {  // Huber's loss allows outliers, so the median is used
    std::vector<double> sizes;
    for (Index row = 0; row < residuals_.size(); ++row) {
      if (search_.weight[row] > 0) sizes.push_back(std::abs(residuals_[row]));
    }
    reduced = std::pow(sd_by_median(sizes), 2);
  }
  if (n >= 1 && reduced > too_much && std::cbrt(reduced) > 1 - share + too_rare * std::sqrt(share)) {
    fit_.misfits.push_back(fmt::format(
        "residuals are {:.2g} times as large as the standard deviations that are given (reduced chi^2 {:.3g})",
        std::sqrt(reduced), reduced));
  }
}

void Reporter::set_patch_seen() {
  FitRequest with_patch = request_;
  with_patch.free.patch_radius = true;
  Search search(with_patch, accuracy_of_guess);
  try {
    const VectorXd found = search.solve();
    constexpr double far_better = 12, whole = 0.99;
    const double radius = std::exp(found[1]), less = fit_.aic - search.criterion(found);
    if (!(less > far_better && radius < whole * request_.ball.ball.radius)) return;
    fit_.patch_seen = {radius, std::exp(found[0]), less};
    with_patch_ = std::move(search.guesses);
    with_patch_.insert(with_patch_.begin(), found);
  } catch (const std::runtime_error&) {
    // No patch is proposed if the search for one does not converge.
  }
}

void Reporter::set_rolling_friction_seen() {
  // Express the same motion by parameters that include a rolling friction of 0.
  VectorXd start = parameters_;
  for (std::size_t track = 0; track < request_.tracks.size(); ++track) {
    const auto of = [&](Parameter parameter) -> double& { return start[TrackModel::place(parameter, track)]; };
    if (of(Parameter::slip) < 0) {
      of(Parameter::slip) *= -1;
      of(Parameter::direction) += std::numbers::pi;
    }
    const double along =
        std::cos(of(Parameter::direction)) * of(Parameter::vx) + std::sin(of(Parameter::direction)) * of(Parameter::vy);
    of(Parameter::rolling) = std::max(0.0, along - of(Parameter::slip));
  }
  const TrackModel model(request_.ball, request_.law, request_.tracks, accuracy_of_guess, true);
  VectorXd beside = start;
  constexpr double step = 0.01;  // rolling friction divided by friction; so large that accuracy_of_guess suffices
  double& rolling_friction = beside[TrackModel::place(Parameter::rolling_friction)];
  rolling_friction = step * std::exp(start[0]);
  const VectorXd by_it = (model.values(beside) - model.values(start)).cwiseProduct(search_.weight) / rolling_friction;
  // Subtract the changes that the other free parameters can make, too.
  const VectorXd others = inverse_.covariance * (derivatives_.transpose() * by_it);
  const double alone = by_it.squaredNorm() - (derivatives_.transpose() * by_it).dot(others);
  constexpr double hardly_any = 1e-6, far_better = 12;
  if (!(alone > hardly_any * by_it.squaredNorm())) return;
  const VectorXd sizes = residuals_.unaryExpr([this](double each) { return bounded(each); });
  const double value = -sizes.dot(by_it - derivatives_ * others) / alone;
  const double chi2_less = value * value * alone / variance_;
  if (!(value > 0 && chi2_less > far_better)) return;
  const double friction = std::exp(parameters_[0] - (request_.free.friction ? others[0] * value : 0));
  fit_.rolling_friction_seen = {value, std::sqrt(variance_ / alone), friction, chi2_less};
}

}  // namespace contensou::fit
