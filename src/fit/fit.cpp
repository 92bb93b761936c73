#include "contensou/fit/fit.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include "contensou/reduction/laws.hpp"
#include "contensou/si/scaling.hpp"
#include "fit/search.hpp"
#include "fit/student.hpp"

namespace contensou::fit {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// An eigenvalue of the correlations of derivatives below which the data do not decide.
constexpr double undecided = 1e-10;
/// A relative error from which on a number counts as unknown: catalogues are better.
constexpr double unknown = 0.5;
/// Where friction and patch radius depend on each other more than that, and are known worse than that, a parabola is no
/// good model of the sum of squares; nor where they are known worse than the last.
constexpr double strongly_correlated = 0.95, hardly_nonlinear = 0.01, nonlinear = 0.1;

bool is_of_contact(Parameter parameter) { return static_cast<int>(parameter) < shared_parameters; }

/// The inverse of a matrix of information, and which parameters it does not decide.
struct Inverse {
  MatrixXd covariance;
  std::vector<bool> undecided;
};

Inverse inverse_of(const MatrixXd& information) {
  const VectorXd scale = information.diagonal().cwiseSqrt().unaryExpr([](double x) { return x > 0 ? x : 1; });
  const VectorXd inverse_scale = scale.cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(inverse_scale.asDiagonal() * information *
                                                       inverse_scale.asDiagonal());
  const VectorXd values = solver.eigenvalues().cwiseMax(undecided);
  const MatrixXd& vectors = solver.eigenvectors();
  Inverse result;
  result.covariance = inverse_scale.asDiagonal() * vectors * values.cwiseInverse().asDiagonal() * vectors.transpose() *
                      inverse_scale.asDiagonal();
  for (Index i = 0; i < information.rows(); ++i) {
    double share = 0;
    for (Index k = 0; k < values.size(); ++k) {
      if (values[k] <= undecided) share += vectors(i, k) * vectors(i, k);
    }
    result.undecided.push_back(share > 1e-6);
  }
  return result;
}

/// What the data tell of ln f and ln eps when all else is free, too: of both by itself, the 2 by 2 matrix.
Eigen::Matrix2d information_of_contact(const MatrixXd& information) {
  const Index others = information.rows() - 2;
  if (others == 0) return information;
  const MatrixXd beside = information.topRightCorner(2, others);
  return information.topLeftCorner<2, 2>() -
         beside * inverse_of(information.bottomRightCorner(others, others)).covariance * beside.transpose();
}

/// The combination that the data decide where they decide one only.
std::optional<Combination> only_combination(const MatrixXd& information, double variance, const VectorXd& parameters) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(information_of_contact(information) / variance);
  constexpr double least_share = 1e-8;  // below which it counts as none
  const double strong = solver.eigenvalues()[1];
  const double weak = std::max(solver.eigenvalues()[0], least_share * strong);
  if (!(weak * unknown * unknown < 1) || !(strong * unknown * unknown > 1)) return std::nullopt;
  Eigen::Vector2d powers = solver.eigenvectors().col(1);
  Index larger = 0;
  powers.cwiseAbs().maxCoeff(&larger);
  powers /= powers[larger];
  const auto error = [&](const Eigen::Vector2d& of) {
    const Eigen::Vector2d along = solver.eigenvectors().transpose() * of;
    return std::sqrt(along[0] * along[0] / weak + along[1] * along[1] / strong);
  };
  // A power near 1, -1 or 0 is that one, if the data decide it, too.
  constexpr double near = 0.06;
  Eigen::Vector2d round = powers;
  for (Index i : {0, 1}) {
    if (std::abs(powers[i] - std::round(powers[i])) < near) round[i] = std::round(powers[i]);
  }
  if (error(round) < unknown) powers = round;
  return Combination{powers[0], powers[1], std::exp(powers.dot(parameters.head<2>())),
                     powers == round ? error(round) : powers.norm() / std::sqrt(strong)};
}

/// By how much a parameter can be changed, in one direction, until the cost has risen by so much.
/// @param tangent  how the others go with it, as long as all is linear
double profile_reach(const Search& search, const VectorXd& best, Index place, const VectorXd& tangent, double sign,
                     double standard_error, double rise) {
  constexpr double farthest = 6;  // of a logarithm
  constexpr double tolerance = 1e-5;
  const double least = search.cost(best);
  VectorXd last = best;
  const auto excess = [&](double reach) {
    VectorXd by_last = last;
    by_last[place] = best[place] + sign * reach;
    double lowest = infinity;
    for (const VectorXd& start : {by_last, VectorXd(best + sign * reach * tangent)}) {
      const VectorXd found = search.improved(start, place, tolerance);
      if (const double cost = search.cost(found); cost < lowest) {
        lowest = cost;
        last = found;
      }
      if (lowest < least + rise) break;
    }
    return std::sqrt(std::max(0.0, lowest - least)) - std::sqrt(rise);
  };
  double low = 0, low_excess = -std::sqrt(rise);
  double high = std::min(std::sqrt(rise) * standard_error, 1.0), high_excess = excess(high);
  while (high_excess < 0) {
    low = high;
    low_excess = high_excess;
    high *= 1.6;
    const double limit = search.model.limited(best + VectorXd::Unit(best.size(), place) * sign * high)[place];
    if (high > farthest || limit != best[place] + sign * high) return infinity;
    high_excess = excess(high);
  }
  for (int i = 0; i < 20 && high - low > 1e-2 * high; ++i) {
    const double share = std::clamp(-low_excess / (high_excess - low_excess), 0.1, 0.9);
    const double middle = low + share * (high - low);
    const double at = excess(middle);
    (at < 0 ? low : high) = middle;
    (at < 0 ? low_excess : high_excess) = at;
  }
  return high;
}

/// The report on a solution.
/// @param planned  the film is not made yet: no values, no interval by profile
Fit report(const Search& search, const VectorXd& solution, bool planned) {
  const FitRequest& request = search.request;
  const auto count = static_cast<Index>(search.free.size());
  Fit result;
  result.law = request.law.name();
  result.ball = request.ball;
  result.values = search.values;
  result.degrees_of_freedom = static_cast<double>(search.values - count);
  const VectorXd parameters = search.model.limited(solution);
  result.at_limit = parameters != solution;
  VectorXd values = search.model.values(parameters);
  const VectorXd residuals =
      planned ? VectorXd::Zero(values.size()) : VectorXd((values - search.data).cwiseProduct(search.weight));
  result.chi2 = residuals.squaredNorm();

  const MatrixXd derivatives = search.weight.asDiagonal() * search.model.derivatives(parameters, search.free);
  const MatrixXd information = derivatives.transpose() * derivatives;
  // Huber's loss needs more data for the same error.
  double variance = 1;
  double loss = result.chi2;
  if (request.robust && !planned) {
    double squares = 0, slopes = 0;
    for (double residual : residuals) {
      const double size = std::min(std::abs(residual), huber_bend);
      squares += size * size;
      if (std::abs(residual) <= huber_bend) slopes += 1;
    }
    const auto missing = static_cast<double>(residuals.size() - search.values);
    const double share = (slopes - missing) / static_cast<double>(search.values);
    variance = squares / std::max(result.degrees_of_freedom, 1.0) / (share * share);
    loss = search.cost(parameters);
  }
  double log_weights = 0;
  for (double weight : search.weight) log_weights += weight > 0 ? std::log(weight) : 0;
  result.aic = loss - 2 * log_weights + 2 * static_cast<double>(count);

  const Inverse inverse = inverse_of(information);
  const bool by_student = search.any_estimated() && !planned;
  if (by_student && result.degrees_of_freedom < 1) {
    throw std::domain_error(
        fmt::format("fit: {} values without standard deviations do not decide {} numbers", search.values, count));
  }
  const double quantile = by_student ? student_quantile(result.degrees_of_freedom) : normal_quantile;

  const VectorXd deviation = (variance * inverse.covariance.diagonal()).cwiseSqrt();
  result.correlation =
      variance * deviation.cwiseInverse().asDiagonal() * inverse.covariance * deviation.cwiseInverse().asDiagonal();
  const auto add = [&](Parameter parameter, std::size_t track) {
    const Index place = TrackModel::place(parameter, track);
    const auto found = std::ranges::find(search.free, place);
    const bool of_contact = is_of_contact(parameter);
    Estimate estimate{parameter, track, parameters[place], 0, {}, found != search.free.end()};
    double error = 0;
    if (estimate.free) {
      const auto at = static_cast<std::size_t>(found - search.free.begin());
      error = inverse.undecided[at] ? infinity : deviation[static_cast<Index>(at)];
    }
    if (of_contact) {
      estimate.value = std::exp(estimate.value);
      estimate.standard_error = error == 0 ? 0 : estimate.value * error;
      estimate.interval = {estimate.value * std::exp(-quantile * error), estimate.value * std::exp(quantile * error)};
    } else {
      estimate.standard_error = error;
      estimate.interval = {estimate.value - quantile * error, estimate.value + quantile * error};
    }
    if (estimate.free || static_cast<int>(parameter) < static_cast<int>(Parameter::direction))
      result.estimates.push_back(estimate);
  };
  add(Parameter::friction, 0);
  add(Parameter::patch_radius, 0);
  for (std::size_t track = 0; track < request.tracks.size(); ++track) {
    for (int i = shared_parameters; i < shared_parameters + start_parameters; ++i) {
      add(static_cast<Parameter>(i), track);
    }
  }

  if (request.free.friction && request.free.patch_radius) {
    result.only = only_combination(information, variance, parameters);
    const double worst = std::max(deviation[0], deviation[1]);
    const bool correlated = std::abs(result.correlation(0, 1)) > strongly_correlated;
    // Where something is not decided, a search along one number may not see how far the other lets it go.
    const bool decided = std::ranges::none_of(inverse.undecided, std::identity());
    if (!planned && (correlated ? worst > hardly_nonlinear : decided && worst > nonlinear)) {
      result.profiled = true;
      for (Index place : {0, 1}) {
        Interval& interval = result.estimates[static_cast<std::size_t>(place)].interval;
        const double rise = quantile * quantile * variance;
        const auto reach = [&](double sign) {
          VectorXd tangent = VectorXd::Zero(parameters.size());
          tangent(search.free) = inverse.covariance.col(place) / inverse.covariance(place, place);
          return profile_reach(search, parameters, place, tangent, sign, deviation[place], rise);
        };
        const double value = std::exp(parameters[place]);
        interval = {value * std::exp(-reach(-1)), value * std::exp(reach(1))};
      }
    }
  }
  if (request.free.patch_radius) {  // no patch is larger than the ball
    Interval& interval = result.estimates[1].interval;
    interval.high = std::min(interval.high, request.ball.ball.radius);
  }

  for (const auto& [observable, name, unit, meaning] : observable_kinds()) {
    const auto place = static_cast<std::size_t>(observable);
    const std::vector<Index>& rows = search.rows_of[place];
    if (rows.empty()) continue;
    double squares = 0, variances = 0;
    for (Index row : rows) {
      const double sd = 1 / search.weight[row];
      squares += residuals[row] * residuals[row] * sd * sd;
      variances += sd * sd;
    }
    const auto n = static_cast<double>(rows.size());
    result.noise.push_back({observable, static_cast<Index>(rows.size()), std::sqrt(squares / n),
                            std::sqrt(variances / n), search.estimated[place]});
  }

  Index row = 0;
  for (const Track& track : request.tracks) {
    result.predicted.emplace_back();
    for (std::size_t i = 0; i < track.series.size(); ++i) {
      result.predicted.back().emplace_back(values.segment(row, track.t.size()).array());
      row += track.t.size();
    }
    if (track.stop_time) ++row;
  }

  const auto number = [&](Parameter parameter) { return result.estimate(parameter).value; };
  result.ball.contact = {number(Parameter::friction), si::PatchRadius{number(Parameter::patch_radius)}};
  if (result.law != request.ball.ball.body.law && reduction::find_law(result.law)) result.ball.contact.law = result.law;
  const double slip = std::max(0.0, number(Parameter::slip)), spin = number(Parameter::spin);
  const auto placed = [&](Parameter parameter) {
    return std::ranges::any_of(result.estimates, [&](const Estimate& estimate) {
      return estimate.parameter == parameter && estimate.track == 0 && estimate.free;
    });
  };
  if (placed(Parameter::vx) && placed(Parameter::vy)) {
    const double direction = number(Parameter::direction), radius = request.ball.ball.radius;
    const Eigen::Vector2d velocity(number(Parameter::vx), number(Parameter::vy));
    const Eigen::Vector2d of_contact(slip * std::cos(direction), slip * std::sin(direction));
    const Eigen::Vector2d difference = (velocity - of_contact) / radius;
    result.ball.start = si::Velocities{velocity, {-difference.y(), difference.x(), spin}};
  } else {
    result.ball.start = si::SlipAndSpin{slip, spin};
  }
  return result;
}

/// Turns a slip against its direction, which is the same as the opposite one along it.
VectorXd with_positive_slips(const FitRequest& request, VectorXd parameters) {
  for (std::size_t i = 0; i < request.tracks.size(); ++i) {
    double& slip = parameters[TrackModel::place(Parameter::slip, i)];
    double& direction = parameters[TrackModel::place(Parameter::direction, i)];
    const bool seen = std::ranges::find(request.tracks[i].series, Observable::slip, &Series::observable) !=
                      request.tracks[i].series.end();
    if (slip < 0 && !seen) {
      slip = -slip;
      direction += std::numbers::pi;
    }
    direction = std::remainder(direction, 2 * std::numbers::pi);
  }
  return parameters;
}

FitRequest checked(const FitRequest& request) {
  si::require_experiment(request.ball);
  if (request.ball.ball.body.lies_flat()) throw std::domain_error("fit: a ball is required; this body lies flat");
  if (request.tracks.empty()) throw std::domain_error("fit: there is no track");
  FitRequest result = request;
  for (Track& track : result.tracks) track = checked(std::move(track));
  return result;
}

/// Friction and patch radius of the ball count as they are where they are not only a start: then they must be what the
/// model allows.
void require_limits(const Search& search, bool planned) {
  const VectorXd given = search.given(), limited = search.model.limited(given);
  const auto bound = [&](double far, Index place) {
    return std::exp(search.model.limited(VectorXd::Constant(given.size(), far))[place]);
  };
  for (Index place = 0; place < shared_parameters; ++place) {
    const bool searched = !planned && std::ranges::find(search.free, place) != search.free.end();
    if (searched || limited[place] == given[place]) continue;
    const ParameterKind& kind = kind_of(static_cast<Parameter>(place));
    throw std::domain_error(fmt::format("fit: {} from {:.3g} to {:.3g}{}{} is required under the law {}; got {:.6g}",
                                        kind.name, bound(-infinity, place), bound(infinity, place),
                                        kind.unit.empty() ? "" : " ", kind.unit, search.request.law.name(),
                                        std::exp(given[place])));
  }
}

}  // namespace

const ParameterKind& kind_of(Parameter parameter) {
  static const ParameterKind all[]{
      {"friction", "", "coefficient of dry friction"},
      {"patch_radius", "m", "radius of the contact patch"},
      {"slip", "m/s", "sliding speed at the start"},
      {"spin", "rad/s", "angular velocity about the vertical at the start"},
      {"direction", "rad", "of the slip, from the x axis"},
      {"vx", "m/s", "velocity of the centre at the start"},
      {"vy", "m/s", "velocity of the centre at the start"},
      {"x", "m", "place of the centre at the start"},
      {"y", "m", "place of the centre at the start"},
      {"angle", "rad", "at the start"},
  };
  return all[static_cast<std::size_t>(parameter)];
}

std::string Combination::name() const {
  if (patch_power == 0) return "friction";
  if (friction_power == 0) return "patch_radius";
  if (friction_power == patch_power) return "the product friction patch_radius";
  if (friction_power == -patch_power)
    return friction_power == 1 ? "the ratio friction/patch_radius" : "the ratio patch_radius/friction";
  const auto power = [](const char* name, double exponent) {
    const std::string text = fmt::format("{:.2g}", exponent);
    return text == "1" ? std::string(name) : fmt::format("{}^{}", name, text);
  };
  return power("friction", friction_power) + " " + power("patch_radius", patch_power);
}

const Estimate& Fit::estimate(Parameter parameter, std::size_t track) const {
  const auto found = std::ranges::find_if(estimates, [&](const Estimate& each) {
    return each.parameter == parameter && (is_of_contact(parameter) || each.track == track);
  });
  if (found == estimates.end()) {
    throw std::domain_error(fmt::format("Fit::estimate: track {} has no {}", track, kind_of(parameter).name));
  }
  return *found;
}

std::vector<const Estimate*> Fit::free_estimates() const {
  std::vector<const Estimate*> result;
  for (const Estimate& each : estimates) {
    if (each.free) result.push_back(&each);
  }
  return result;
}

double Fit::correlation_of_contact() const { return estimates[0].free && estimates[1].free ? correlation(0, 1) : 0; }

Fit fit(const FitRequest& asked) {
  const FitRequest request = checked(asked);
  Search search(request);
  require_limits(search, false);
  return report(search, with_positive_slips(request, search.solve()), false);
}

std::vector<Fit> fit_laws(const FitRequest& request, const std::vector<reduction::Law>& laws) {
  std::vector<Fit> fits;
  for (const reduction::Law& law : laws) {
    FitRequest one = request;
    one.law = law;
    fits.push_back(fit(one));
  }
  std::ranges::stable_sort(fits, {}, &Fit::aic);
  return fits;
}

Fit plan(const FitRequest& asked) {
  FitRequest request = asked;
  si::require_experiment(request.ball);
  for (Track& track : request.tracks) {
    for (Series& series : track.series) {
      if (series.sd.size() == 0)
        throw std::domain_error(fmt::format("plan: {} needs standard deviations", kind_of(series.observable).name));
      series.value = Eigen::ArrayXd::Zero(track.t.size());
    }
  }
  request = checked(request);
  const Search search(request);
  require_limits(search, true);
  return report(search, search.given(), true);
}

}  // namespace contensou::fit
