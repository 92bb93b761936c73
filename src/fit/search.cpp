#include "fit/search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>
#include <Eigen/QR>
#include <unsupported/Eigen/NonLinearOptimization>

#include "contensou/si/scaling.hpp"

namespace contensou::fit {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr Index min_of_unknown_noise = 10;
constexpr Index max_of_guess = 30;
/// No value is taken to be sharper than that, of the largest one.
constexpr double least_sd = 1e-9;
constexpr double accuracy_of_score = 1e-4, tolerance_of_guess = 1e-5;

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// The step that all differences of values are multiples of, by Euclid's algorithm; 0 where no values differ.
double resolution(const VectorXd& data, const std::vector<Index>& rows) {
  const VectorXd values = data(rows);
  constexpr double sharp = 1e-9;
  const double none = sharp * (values.maxCoeff() - values.minCoeff());
  double step = 0;
  for (double value : values) {
    for (double other = std::abs(value - values[0]); other > none;) {
      const double rest = std::abs(std::remainder(step, other));
      step = other;
      other = rest;
    }
  }
  return step;
}

/// What Huber's loss makes of a residual, so that half the square of the result is the loss; and its derivative.
double softened(double residual) {
  const double size = std::abs(residual);
  return size <= huber_bend ? residual
                            : std::copysign(std::sqrt(2 * huber_bend * size - huber_bend * huber_bend), residual);
}
double softened_slope(double residual) {
  return std::abs(residual) <= huber_bend ? 1 : huber_bend / std::abs(softened(residual));
}

/// Errors of a series by how far values are off the line between their neighbours.
std::vector<double> local_errors(const Track& track, const Series& series) {
  std::vector<Index> known;
  for (Index i = 0; i < track.t.size(); ++i) {
    if (!std::isnan(series.value[i])) known.push_back(i);
  }
  std::vector<double> errors;
  for (std::size_t i = 1; i + 1 < known.size(); ++i) {
    const Index before = known[i - 1], at = known[i], after = known[i + 1];
    const double fraction = (track.t[at] - track.t[before]) / (track.t[after] - track.t[before]);
    const double error = series.value[at] - (1 - fraction) * series.value[before] - fraction * series.value[after];
    errors.push_back(std::abs(error) / std::sqrt(1 + fraction * fraction + (1 - fraction) * (1 - fraction)));
  }
  return errors;
}

const Series* find(const Track& track, Observable observable) {
  const auto found = std::ranges::find(track.series, observable, &Series::observable);
  return found == track.series.end() ? nullptr : &*found;
}

/// The first values of a series, and their times.
struct Beginning {
  double value = NAN;
  double slope = NAN;
};
Beginning beginning(const Track& track, Observable observable) {
  const Series* series = find(track, observable);
  if (series == nullptr) return {};
  const Index wanted = std::clamp<Index>(track.t.size() / 30, 3, 30);
  std::vector<double> t, y;
  for (Index i = 0; i < track.t.size() && static_cast<Index>(t.size()) < wanted; ++i) {
    if (std::isnan(series->value[i])) continue;
    t.push_back(track.t[i] - track.start);
    y.push_back(series->value[i]);
  }
  if (y.empty()) return {};
  return {median(y), t.size() > 1 ? (y.back() - y.front()) / (t.back() - t.front()) : NAN};
}

/// The residuals as a function of what is free.
struct Functor {
  using Scalar = double;
  using InputType = VectorXd;
  using ValueType = VectorXd;
  using JacobianType = Eigen::MatrixXd;
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

  /// Where a combination of ln f and ln eps is held, the first input goes along the line of both.
  struct Line {
    Eigen::Vector2d direction;
    double low = -std::numeric_limits<double>::infinity(), high = -low;  ///< where both are what they may be
  };

  const Search& search;
  VectorXd start;
  std::vector<Index> free = search.free;  ///< of the other inputs
  std::optional<Line> line = {};

  Functor(const Search& of, VectorXd from, const Coordinate* held, const std::vector<Index>& kept)
      : search(of), start(std::move(from)) {
    std::erase_if(free, [&](Index place) { return std::ranges::count(kept, place) > 0; });
    if (held == nullptr) return;
    if (!held->of_contact()) {
      std::erase(free, held->place);
      return;
    }
    const auto shared = std::erase_if(free, [](Index place) { return place < contact_parameters; });
    if (shared < contact_parameters) return;
    line = Line{{-held->powers[1], held->powers[0]}};
    for (Index i = 0; i < contact_parameters; ++i) {
      const double slope = line->direction[i];
      if (slope == 0) continue;
      const auto [low, high] = search.model.range(i);
      const double ends[]{(low - start[i]) / slope, (high - start[i]) / slope};
      line->low = std::max(line->low, std::min(ends[0], ends[1]));
      line->high = std::min(line->high, std::max(ends[0], ends[1]));
    }
    line->high = std::max(line->low, line->high);
  }

  int inputs() const { return static_cast<int>(free.size()) + (line ? 1 : 0); }
  int values() const { return std::max(inputs(), static_cast<int>(search.data.size())); }

  VectorXd first_inputs() const {
    VectorXd x(inputs());
    if (line) x[0] = std::clamp(0.0, line->low, line->high);
    x.tail(static_cast<Index>(free.size())) = start(free);
    return x;
  }

  VectorXd whole(const VectorXd& x) const {
    VectorXd parameters = start;
    parameters(free) = x.tail(static_cast<Index>(free.size()));
    if (line) parameters.head<2>() += std::clamp(x[0], line->low, line->high) * line->direction;
    return parameters;
  }

  int operator()(const VectorXd& x, VectorXd& f) const {
    if (!x.allFinite()) return -1;
    f.setZero();
    const VectorXd residuals = search.residuals(whole(x));
    f.head(residuals.size()) = residuals;
    if (search.request.robust) f = f.unaryExpr(&softened);
    return 0;
  }

  int df(const VectorXd& x, Eigen::MatrixXd& jacobian) const {
    const VectorXd parameters = whole(x);
    jacobian.setZero();
    VectorXd weight = search.weight;
    if (search.request.robust) weight.array() *= search.residuals(parameters).unaryExpr(&softened_slope).array();
    const Index rows = search.data.size();
    jacobian.topRightCorner(rows, static_cast<Index>(free.size())).noalias() =
        weight.asDiagonal() * search.model.derivatives(parameters, free);
    if (line && line->low <= x[0] && x[0] <= line->high) {
      jacobian.col(0).head(rows) =
          weight.asDiagonal() * (search.model.derivatives(parameters, {0, 1}) * line->direction);
    }
    return 0;
  }
};

}  // namespace

std::size_t other_axis(std::size_t place) {
  using enum Observable;
  constexpr std::pair<Observable, Observable> axes[]{{x, y}, {y, x}, {vx, vy}, {vy, vx}};
  const auto* found =
      std::ranges::find(axes, static_cast<Observable>(place), &std::pair<Observable, Observable>::first);
  return found == std::end(axes) ? place : static_cast<std::size_t>(found->second);
}

double sd_by_median(std::vector<double> sizes) { return median(std::move(sizes)) / 0.6744897501960817; }

std::vector<Track> thinned(const std::vector<Track>& tracks, Index most) {
  std::vector<Track> result = tracks;
  for (Track& track : result) {
    const Index step = (track.t.size() + most - 1) / most;
    if (step <= 1) continue;
    const Index count = (track.t.size() + step - 1) / step;
    const auto take = [&](Eigen::ArrayXd& values) {
      if (values.size() == 0) return;
      const Eigen::ArrayXd taken = values(Eigen::seqN(0, count, step));
      values = taken;
    };
    take(track.t);
    for (Series& series : track.series) {
      take(series.value);
      take(series.sd);
    }
  }
  return result;
}

Search::Search(const FitRequest& asked, double accuracy)
    : request(asked),
      resisted(asked.free.rolling_friction || asked.ball.contact.rolling_friction > 0),
      model(asked.ball, asked.law, asked.tracks, accuracy, resisted),
      data(model.rows()),
      weight(model.rows()) {
  const auto set_sd = [&](std::size_t place, double sd) {
    for (Index row : rows_of[place]) weight[row] = 1 / sd;
  };
  // A standard deviation that is not known begins as that of the values about their neighbours.
  std::vector<double> errors[7];
  double largest[7] = {};
  Index row = 0;
  for (const Track& track : request.tracks) {
    for (const Series& series : track.series) {
      const auto place = static_cast<std::size_t>(series.observable);
      for (Index i = 0; i < track.t.size(); ++i, ++row) {
        const bool measured = !std::isnan(series.value[i]);
        data[row] = measured ? series.value[i] : 0;
        weight[row] = !measured ? 0 : series.sd.size() == 0 ? 1 : 1 / series.sd[i];
        if (!measured) continue;
        rows_of[place].push_back(row);
        largest[place] = std::max(largest[place], std::abs(series.value[i]));
        ++values;
      }
      if (series.sd.size() != 0) continue;
      estimated[place] = true;
      const std::vector<double> more = local_errors(track, series);
      errors[place].insert(errors[place].end(), more.begin(), more.end());
    }
    if (track.stop_time) {
      data[row] = track.stop_time->value;
      weight[row++] = 1 / track.stop_time->sd;
      ++values;
    }
  }
  for (const auto& [observable, name, unit, meaning] : observable_kinds()) {
    const auto place = static_cast<std::size_t>(observable);
    if (!estimated[place]) continue;
    const auto count = static_cast<Index>(rows_of[place].size());
    if (count < min_of_unknown_noise || errors[place].empty()) {
      throw std::domain_error(fmt::format(
          "fit: {} has {} values and no standard deviations; from fewer than {} values they cannot be estimated", name,
          count, min_of_unknown_noise));
    }
    rounding[place] = resolution(data, rows_of[place]);
    if (rounding[place] == 0) {
      // The same value everywhere: as sharp as what the same camera says across.
      const std::size_t other = other_axis(place);
      const bool varies = other != place && !rows_of[other].empty() && resolution(data, rows_of[other]) > 0;
      if (!varies) {
        throw std::domain_error(
            fmt::format("fit: {0} has the same value in all of its {1} rows, which tells no standard deviation of it: "
                        "give one, or leave {0} out",
                        name, count));
      }
      sharp_as[place] = other;
      continue;
    }
    set_sd(place, std::max(sd_by_median(errors[place]), least_sd * largest[place]));
  }
  follow_other_axes();

  if (request.free.friction) free.push_back(TrackModel::place(Parameter::friction));
  if (request.free.patch_radius) free.push_back(TrackModel::place(Parameter::patch_radius));
  if (request.free.rolling_friction) free.push_back(TrackModel::place(Parameter::rolling_friction));
  for (std::size_t i = 0; i < request.tracks.size(); ++i) {
    const auto has = [&](Observable observable) { return find(request.tracks[i], observable) != nullptr; };
    const bool along_x = has(Observable::x) || has(Observable::vx), along_y = has(Observable::y) || has(Observable::vy);
    const auto add = [&](Parameter parameter, bool is_free) {
      if (is_free) free.push_back(TrackModel::place(parameter, i));
    };
    add(Parameter::slip, request.free.slip);
    add(Parameter::spin, request.free.spin);
    add(Parameter::direction, along_x && along_y);
    // The slip of a body that lies flat is its velocity.
    const bool rolls = !request.ball.ball.body.lies_flat();
    add(Parameter::vx, along_x && rolls && !resisted);
    add(Parameter::vy, along_y && rolls && !resisted);
    add(Parameter::x, has(Observable::x));
    add(Parameter::y, has(Observable::y));
    add(Parameter::angle, has(Observable::angle));
    add(Parameter::rolling, (along_x || along_y) && resisted);
  }
  if (free.empty()) throw std::domain_error("fit: nothing is free, so there is nothing to be found");
}

void Search::follow_other_axes() {
  for (std::size_t place = 0; place < std::size(rows_of); ++place) {
    if (!sharp_as[place]) continue;
    for (Index row : rows_of[place]) weight[row] = weight[rows_of[*sharp_as[place]].front()];
  }
}

bool Search::any_estimated() const {
  return std::ranges::any_of(estimated, [](bool each) { return each; });
}

VectorXd Search::residuals(const VectorXd& parameters) const {
  VectorXd result = model.values(parameters);
  result.array() = (result.array() - data.array()) * weight.array();
  return result;
}

double Search::cost(const VectorXd& parameters) const {
  const VectorXd all = residuals(parameters);
  return request.robust ? all.unaryExpr(&softened).squaredNorm() : all.squaredNorm();
}

double Search::slope(const VectorXd& parameters, const VectorXd& direction) const {
  VectorXd all = residuals(parameters);
  if (request.robust) all = all.cwiseMax(-huber_bend).cwiseMin(huber_bend);
  const VectorXd change = model.derivatives(parameters, free) * direction(free);
  return 2 * all.dot(change.cwiseProduct(weight));
}

std::vector<Index> Search::pushed_out(const VectorXd& parameters) const {
  std::vector<Index> pushed;
  for (Index place : free) {
    const auto [low, high] = model.range(place);
    const bool below = parameters[place] <= low, above = parameters[place] >= high;
    if (!below && !above) continue;
    const double rising = slope(parameters, VectorXd::Unit(parameters.size(), place));
    if (below ? rising > 0 : rising < 0) pushed.push_back(place);
  }
  return pushed;
}

VectorXd Search::carried(VectorXd parameters) const {
  std::vector<Index> places;
  for (Index place : free) {
    using enum Parameter;
    const Parameter parameter = TrackModel::parameter_at(place);
    if (parameter == vx || parameter == vy || parameter == x || parameter == y || parameter == angle)
      places.push_back(place);
  }
  if (places.empty()) return parameters;
  const Eigen::MatrixXd jacobian = weight.asDiagonal() * model.derivatives(parameters, places);
  parameters(places) -= jacobian.colPivHouseholderQr().solve(residuals(parameters));
  return model.limited(std::move(parameters));
}

VectorXd Search::improved(VectorXd parameters, const Coordinate* held, double tolerance) const {
  if (request.each_search) request.each_search();
  // A parameter that the sum of squares pushes beyond its limit is kept there while the others are improved, until it is
  // pushed back: a step that is cut off at a limit is refused, and shorter and shorter ones would end the search too early.
  constexpr int most_rounds = 5;
  std::vector<Index> kept;
  for (int i = 0; i < most_rounds; ++i) {
    // What is held finds its limits itself.
    VectorXd limited = model.limited(parameters);
    if (held != nullptr && held->of_contact()) limited.head<2>() = parameters.head<2>();
    std::vector<Index> pushed = pushed_out(limited);
    if (held != nullptr && held->of_contact()) std::erase_if(pushed, [](Index place) { return place < 2; });
    if (i > 0 && limited == parameters && pushed == kept) break;
    kept = std::move(pushed);
    Functor functor(*this, std::move(limited), held, kept);
    VectorXd x = functor.first_inputs();
    if (x.size() == 0) return functor.start;
    Eigen::LevenbergMarquardt<Functor> method(functor);
    method.parameters.ftol = method.parameters.xtol = tolerance;
    method.parameters.maxfev = 300;
    method.parameters.factor = 1;
    method.minimize(x);
    if (!x.allFinite()) throw std::runtime_error("fit: the search for the parameters did not converge");
    parameters = functor.whole(x);
  }
  return model.limited(parameters);
}

double Search::estimate_noise(const VectorXd& parameters) {
  const VectorXd all = model.values(parameters) - data;
  const double share =
      std::max(1.0, static_cast<double>(values) - static_cast<double>(free.size())) / static_cast<double>(values);
  double largest = 0;
  for (std::size_t place = 0; place < std::size(rows_of); ++place) {
    if (!estimated[place] || sharp_as[place]) continue;
    const std::vector<Index>& rows = rows_of[place];
    double sd = 0, scale = 0;
    if (request.robust) {
      std::vector<double> sizes;
      for (Index row : rows) sizes.push_back(std::abs(all[row]));
      sd = sd_by_median(std::move(sizes)) / std::sqrt(share);
    } else {
      for (Index row : rows) sd += all[row] * all[row];
      sd = std::sqrt(sd / (share * static_cast<double>(rows.size())));
    }
    for (Index row : rows) scale = std::max(scale, std::abs(data[row]));
    sd = std::max(sd, least_sd * scale);
    largest = std::max(largest, std::abs(sd * weight[rows.front()] - 1));
    for (Index row : rows) weight[row] = 1 / sd;
  }
  follow_other_axes();
  return largest;
}

VectorXd Search::given() const {
  VectorXd parameters = VectorXd::Zero(model.parameters());
  const si::Experiment& ball = request.ball;
  parameters[0] = std::log(ball.contact.friction);
  parameters[1] = std::log(si::patch_radius_of(ball, request.law));
  parameters[2] = ball.contact.rolling_friction;
  const Eigen::Vector2d slip = si::slip_velocity_at_start(ball);
  const si::Velocities start = si::velocities_of(ball.start);
  for (std::size_t i = 0; i < request.tracks.size(); ++i) {
    const auto set = [&](Parameter parameter, double value) { parameters[TrackModel::place(parameter, i)] = value; };
    const auto has = [&](Observable observable) { return find(request.tracks[i], observable) != nullptr; };
    const bool along_x = has(Observable::x) || has(Observable::vx), along_y = has(Observable::y) || has(Observable::vy);
    set(Parameter::slip, slip.norm());
    set(Parameter::spin, si::spin_at_start(ball));
    set(Parameter::direction, along_y && !along_x ? std::numbers::pi / 2 : std::atan2(slip.y(), slip.x()));
    if (ball.ball.body.lies_flat()) continue;
    if (resisted) {
      const Eigen::Vector2d along = si::direction_at_start(ball), rolling = start.velocity - slip;
      const bool is_searched = std::ranges::count(free, TrackModel::place(Parameter::rolling, i)) > 0;
      if (!is_searched && !si::points_along(rolling, along))
        throw std::domain_error("fit: with rolling friction a ball must roll the way it slides, or not at all");
      set(Parameter::rolling, std::max(0.0, rolling.dot(along)));
      continue;
    }
    if (along_x) set(Parameter::vx, start.velocity.x());
    if (along_y) set(Parameter::vy, start.velocity.y());
  }
  return parameters;
}

VectorXd Search::solve() {
  // Of a long film first a part, then all of it.
  std::vector<Track> part = with_noise(thinned(request.tracks, max_of_first_solution));
  FitRequest smaller = request;
  smaller.tracks = std::move(part);
  Search first(smaller, accuracy_of_guess);
  VectorXd parameters = first.improved_from_guesses();
  guesses = std::move(first.guesses);
  return settled(std::move(parameters));
}

VectorXd Search::settled(VectorXd parameters) {
  if (any_estimated()) estimate_noise(parameters);
  constexpr int most_rounds = 30;
  for (int round = 0; round < most_rounds; ++round) {
    parameters = improved(parameters);
    if (!any_estimated() || estimate_noise(parameters) < 1e-3) break;
  }
  return parameters;
}

double Search::criterion(const VectorXd& parameters) const {
  double log_weights = 0;
  for (double each : weight) log_weights += each > 0 ? std::log(each) : 0;
  return cost(parameters) - 2 * log_weights + 2 * static_cast<double>(free.size());
}

std::vector<Track> Search::with_noise(std::vector<Track> tracks) const {
  for (Track& track : tracks) {
    for (Series& series : track.series) {
      if (series.sd.size() != 0) continue;
      const Index row = rows_of[static_cast<std::size_t>(series.observable)].front();
      series.sd = Eigen::ArrayXd::Constant(track.t.size(), 1 / weight[row]);
    }
  }
  return tracks;
}

VectorXd Search::placed(VectorXd parameters) const {
  const Index direction = TrackModel::place(Parameter::direction);
  std::vector<Index> linear;
  for (Index place : free) {
    if (place > direction && TrackModel::parameter_at(place) != Parameter::rolling) linear.push_back(place);
  }
  const bool turns = std::ranges::find(free, direction) != free.end();
  if (linear.empty() && !turns) return parameters;
  VectorXd still = parameters;
  for (Index place : linear) still[place] = 0;
  const Eigen::MatrixXd matrix = model.derivatives(parameters, linear);
  const auto solved = [&](const Eigen::MatrixXd& columns, const VectorXd& right, const VectorXd& weights) {
    return VectorXd(
        Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(weights.asDiagonal() * columns).solve(weights.cwiseProduct(right)));
  };
  if (turns) {
    // Along any direction, what friction takes of x and y is this times its cosine, and that times its sine.
    VectorXd weights = VectorXd::Zero(weight.size());
    for (Observable observable : {Observable::x, Observable::y, Observable::vx, Observable::vy}) {
      for (Index row : rows_of[static_cast<std::size_t>(observable)]) weights[row] = weight[row];
    }
    Eigen::MatrixXd columns(matrix.rows(), matrix.cols() + 2);
    columns.leftCols(matrix.cols()) = matrix;
    still[direction] = 0;
    columns.col(matrix.cols()) = model.values(still);
    still[direction] = std::numbers::pi / 2;
    columns.col(matrix.cols() + 1) = model.values(still);
    const VectorXd found = solved(columns, data, weights);
    still[direction] = std::atan2(found[matrix.cols() + 1], found[matrix.cols()]);
  }
  if (linear.empty()) return still;
  const VectorXd found = solved(matrix, data - model.values(still), weight);
  for (std::size_t i = 0; i < linear.size(); ++i) still[linear[i]] = found[static_cast<Index>(i)];
  return still;
}

VectorXd Search::improved_from_guesses() {
  constexpr std::size_t most_improved = 2;
  const VectorXd given = this->given();
  const double radius = request.ball.ball.radius;
  std::vector<double> frictions{given[0]}, patches{given[1]};
  if (request.free.friction) {
    for (double friction : {0.01, 0.03, 0.06, 0.1, 0.15, 0.22, 0.35, 0.6, 1.0}) frictions.push_back(std::log(friction));
  }
  if (request.free.patch_radius) {
    for (double ratio : {1e-3, 4e-3, 0.015, 0.05, 0.15, 0.5}) patches.push_back(std::log(ratio * radius));
  }
  // Each track by itself, of few instants.
  const std::vector<Track> few = with_noise(thinned(request.tracks, max_of_guess));
  std::vector<FitRequest> requests;
  for (const Track& track : few) {
    requests.push_back({request.ball, request.law, {track}, request.free, true});
  }
  std::vector<std::pair<double, VectorXd>> scored;
  for (double patch : patches) {
    for (double friction : frictions) {
      scored.emplace_back(0, given);
      scored.back().second.head<contact_parameters>() << friction, patch;
    }
  }
  for (std::size_t i = 0; i < few.size(); ++i) {
    const Search alone(requests[i], accuracy_of_score);
    for (auto& [cost, parameters] : scored) {
      double least = std::numeric_limits<double>::infinity();
      VectorXd best;
      for (const auto& [slip, spin, rolling] : starts_of(few[i], given)) {
        VectorXd guess(alone.model.parameters());
        guess << parameters.head(shared_parameters),
            given.segment(TrackModel::place(Parameter::slip, i), start_parameters);
        guess[TrackModel::place(Parameter::slip)] = slip;
        guess[TrackModel::place(Parameter::spin)] = spin;
        guess[TrackModel::place(Parameter::rolling)] = rolling;
        guess = alone.placed(guess);
        const double loss = alone.cost(guess);
        if (loss < least || best.size() == 0) {
          least = loss;
          best = guess;
        }
      }
      cost += least;
      parameters.segment(TrackModel::place(Parameter::slip, i), start_parameters) = best.tail(start_parameters);
    }
  }
  const VectorXd given_placed = scored.front().second;
  std::ranges::sort(scored, {}, [](const auto& guess) { return guess.first; });
  for (const auto& [cost, parameters] : scored) guesses.push_back(parameters);
  // The ball's own values are the first to be improved, and kept where others are no better to speak of.
  constexpr double no_better = 0.1;
  VectorXd best = improved(given_placed, nullptr, tolerance_of_guess);
  double least = cost(best) - no_better;
  for (std::size_t i = 0; i < std::min(most_improved, guesses.size()); ++i) {
    const VectorXd parameters = improved(guesses[i], nullptr, tolerance_of_guess);
    if (const double loss = cost(parameters); loss < least) {
      least = loss;
      best = parameters;
    }
  }
  return best;
}

std::vector<Search::Begun> Search::starts_of(const Track& track, const VectorXd& given) const {
  const double slip_of_ball = given[TrackModel::place(Parameter::slip)];
  const double spin_of_ball = given[TrackModel::place(Parameter::spin)];
  const double radius = request.ball.ball.radius;
  std::vector<double> slips{slip_of_ball}, spins{spin_of_ball};
  const auto first = [&](Observable place, Observable velocity) {
    const double by_velocity = beginning(track, velocity).value;
    if (!std::isnan(by_velocity)) return by_velocity;
    const double by_place = beginning(track, place).slope;
    return std::isnan(by_place) ? 0 : by_place;
  };
  const double speed = std::hypot(first(Observable::x, Observable::vx), first(Observable::y, Observable::vy));
  if (request.free.slip) {
    if (const double seen = beginning(track, Observable::slip).value; !std::isnan(seen)) {
      slips = {seen};
    } else if (speed > 0) {
      slips = {speed / 2, speed, 2 * speed};
    }
  }
  if (request.free.spin) {
    if (const double seen = beginning(track, Observable::spin).value; !std::isnan(seen)) {
      spins = {seen};
    } else if (const double turning = beginning(track, Observable::angle).slope; !std::isnan(turning)) {
      spins = {turning};
    } else if (spin_of_ball == 0) {
      spins = {slips[slips.size() / 2] / radius};
    }
  }
  const bool rolls = std::ranges::any_of(free, [](Index place) {  // which goes into the speed, too
    return TrackModel::parameter_at(place) == Parameter::rolling;
  });
  const auto begun = [&](double slip, double spin) {
    return Begun{slip, spin, rolls ? std::max(0.0, speed - slip) : given[TrackModel::place(Parameter::rolling)]};
  };
  std::vector<Begun> starts;
  for (double slip : slips) {
    for (double spin : spins) {
      if (slip != 0 || spin != 0) starts.push_back(begun(slip, spin));
    }
  }
  if (starts.empty()) starts.push_back(begun(slip_of_ball, spin_of_ball));
  return starts;
}

}  // namespace contensou::fit
