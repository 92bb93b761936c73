#include "fit/search.hpp"

#include <cmath>
#include <stdexcept>

#include <Eigen/QR>

namespace contensou::fit {

using Eigen::Index;
using Eigen::VectorXd;

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
  read_data();
  begin_noise();
  choose_free();
  if (free.empty()) throw std::domain_error("fit: nothing is free, so there is nothing to be found");
}

void Search::read_data() {
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
        ++values;
      }
      if (series.sd.size() == 0) estimated[place] = true;
    }
    if (track.stop_time) {
      data[row] = track.stop_time->value;
      weight[row++] = 1 / track.stop_time->sd;
      ++values;
    }
  }
}

void Search::choose_free() {
  if (request.free.friction) free.push_back(TrackModel::place(Parameter::friction));
  if (request.free.patch_radius) free.push_back(TrackModel::place(Parameter::patch_radius));
  if (request.free.rolling_friction) free.push_back(TrackModel::place(Parameter::rolling_friction));
  for (std::size_t i = 0; i < request.tracks.size(); ++i) {
    const auto has = [&](Observable observable) { return series_of(request.tracks[i], observable) != nullptr; };
    const bool along_x = has(Observable::x) || has(Observable::vx), along_y = has(Observable::y) || has(Observable::vy);
    const auto add = [&](Parameter parameter, bool is_free) {
      if (is_free) free.push_back(TrackModel::place(parameter, i));
    };
    add(Parameter::slip, request.free.slip);
    add(Parameter::spin, request.free.spin);
    add(Parameter::direction, along_x && along_y);
    // The slip of a body that lies flat equals its velocity.
    const bool rolls = !request.ball.ball.body.lies_flat();
    add(Parameter::vx, along_x && rolls && !resisted);
    add(Parameter::vy, along_y && rolls && !resisted);
    add(Parameter::x, has(Observable::x));
    add(Parameter::y, has(Observable::y));
    add(Parameter::angle, has(Observable::angle));
    add(Parameter::rolling, (along_x || along_y) && resisted);
  }
}

VectorXd Search::residuals(const VectorXd& parameters) const {
  VectorXd result = model.values(parameters);
  result.array() = (result.array() - data.array()) * weight.array();
  return result;
}

double Search::criterion(const VectorXd& parameters) const {
  double log_weights = 0;
  for (double each : weight) log_weights += each > 0 ? std::log(each) : 0;
  return cost(parameters) - 2 * log_weights + 2 * static_cast<double>(free.size());
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

VectorXd Search::solve() {
  // Fit a part of a long film first, then the whole film.
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

}  // namespace contensou::fit
