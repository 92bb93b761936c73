#include "contensou/portraits/stop_time_map.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <stdexcept>

#include <fmt/format.h>

namespace contensou::portraits {

namespace {

using reduction::State;
using reduction::StopTimeTable;

void require_axis(const char* name, const Eigen::ArrayXd& values, bool logarithmic) {
  const auto fail = [name](const std::string& what) {
    throw std::domain_error(fmt::format("stop_time_map: {} {}", name, what));
  };
  const Eigen::Index count = values.size();
  if (count < 2) fail(fmt::format("needs two values or more, got {}", count));
  if (!(values.tail(count - 1) > values.head(count - 1)).all()) fail("must increase");
  if (logarithmic && !(values[0] > 0)) fail(fmt::format("must be > 0 on logarithmic axes, got {}", values[0]));
  constexpr double largest = 1e100;
  const double least = logarithmic ? values[0] : values[count - 1] - values[0];
  if (!(values.abs().maxCoeff() <= largest && least >= 1 / largest)) {
    fail(fmt::format("from {} to {} cannot be drawn: choose a unit of speed in which it lies within 1e-100 .. 1e100",
                     values[0], values[count - 1]));
  }
}

/// Round numbers strictly between two, some eight of them: multiples of 1, 2 or 5 times a power of ten.
std::vector<double> round_levels(double least, double most) {
  constexpr double wanted = 9;
  const double rough = (most - least) / wanted;
  const double power = std::pow(10, std::floor(std::log10(rough)));
  double step = 10 * power;
  for (double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= rough) {
      step = factor * power;
      break;
    }
  }
  std::vector<double> levels;
  for (double i = std::floor(least / step) + 1; i * step < most; ++i) levels.push_back(i * step);
  return levels;
}

/// The same in ratios: powers of ten, with 2 and 5 between them where these are few, or every second or third one.
std::vector<double> round_ratios(double least, double most) {
  const double decades = std::log10(most / least);
  if (decades < 0.7) return round_levels(least, most);
  const std::vector<double> factors = decades < 4.5 ? std::vector<double>{1, 2, 5} : std::vector<double>{1};
  const double stride = std::max(1.0, std::ceil(decades / 12));
  std::vector<double> levels;
  for (double power = stride * std::floor(std::log10(least) / stride); power <= std::log10(most); power += stride) {
    for (double factor : factors) {
      const double level = factor * std::pow(10, power);
      if (level > least && level < most) levels.push_back(level);
    }
  }
  return levels;
}

/// The isochrones of one map.
class Isochrones {
 public:
  Isochrones(const StopTimeTable& table, const MapAxes& axes) : table_(table), axes_(axes) {
    const Eigen::ArrayXd &u = axes.u0, &v = axes.v0;
    low_ = {u[0], v[0]};
    high_ = {u[u.size() - 1], v[v.size() - 1]};
    first_ = axes.logarithmic ? std::log(low_.v) - std::log(high_.u) : 0;
    last_ = axes.logarithmic ? std::log(high_.v) - std::log(low_.u) : std::numbers::pi;
  }

  /// Appends the pieces of one that lie inside the map.
  void append(double tau, std::vector<Isochrone>& isochrones) const {
    constexpr int steps = 720;
    std::vector<State> piece;
    double before = first_;
    for (int i = 0; i <= steps; ++i) {
      const double t = first_ + (last_ - first_) * i / steps;
      const State here = at(t, tau);
      const bool enters = inside(here) && piece.empty() && i > 0;
      const bool leaves = !inside(here) && !piece.empty();
      if (enters) piece.push_back(border(before, t, tau));
      if (leaves) piece.push_back(border(t, before, tau));
      if (inside(here)) piece.push_back(here);
      if (leaves || (i == steps && !piece.empty())) {
        isochrones.push_back(isochrone(tau, piece));
        piece.clear();
      }
      before = t;
    }
  }

 private:
  /// Where the ray of that direction meets the isochrone. Directions are angles, or ln(v/u) on logarithmic axes.
  State at(double direction, double tau) const {
    State ray{std::exp(-direction / 2), std::exp(direction / 2)};
    if (!axes_.logarithmic) {
      const double width = std::max(std::abs(low_.u), std::abs(high_.u));
      ray = {width * std::cos(direction), high_.v * std::sin(direction)};
    }
    const double scale = tau / table_(ray.u, std::max(ray.v, 0.0));
    return {scale * ray.u, scale * std::max(ray.v, 0.0)};
  }

  bool inside(State state) const {
    return state.u >= low_.u && state.u <= high_.u && state.v >= low_.v && state.v <= high_.v;
  }

  /// The last point inside, between a direction outside and one inside.
  State border(double outside, double within, double tau) const {
    for (int i = 0; i < 50; ++i) {
      const double middle = (outside + within) / 2;
      (inside(at(middle, tau)) ? within : outside) = middle;
    }
    return at(within, tau);
  }

  static Isochrone isochrone(double tau, const std::vector<State>& states) {
    const auto count = static_cast<Eigen::Index>(states.size());
    Isochrone result{tau, Eigen::ArrayXd(count), Eigen::ArrayXd(count)};
    for (Eigen::Index i = 0; i < count; ++i) {
      result.u[i] = states[static_cast<std::size_t>(i)].u;
      result.v[i] = states[static_cast<std::size_t>(i)].v;
    }
    return result;
  }

  const StopTimeTable& table_;
  const MapAxes& axes_;
  State low_{}, high_{};
  double first_, last_;
};

}  // namespace

StopTimeMap stop_time_map(const StopTimeTable& table, const MapAxes& axes) {
  require_axis("u0", axes.u0, axes.logarithmic);
  require_axis("v0", axes.v0, axes.logarithmic);
  if (axes.v0[0] < 0) throw std::domain_error(fmt::format("stop_time_map: v0 must be >= 0, got {}", axes.v0[0]));

  const reduction::ReducedSystem& system = table.system();
  StopTimeMap map{system.law().name(), system.mu(), axes, {}, {}};
  map.tau.resize(axes.v0.size(), axes.u0.size());
  Eigen::ArrayXd row(axes.u0.size());
  for (Eigen::Index i = 0; i < axes.v0.size(); ++i) {
    table.evaluate_row({axes.u0.data(), static_cast<std::size_t>(axes.u0.size())}, axes.v0[i],
                       {row.data(), static_cast<std::size_t>(row.size())});
    map.tau.row(i) = row;
  }
  if (!map.tau.allFinite()) {
    throw std::domain_error("stop_time_map: a stop time is beyond the largest double: use a larger unit of speed");
  }
  const double least = map.tau.minCoeff();
  const double most = map.tau.maxCoeff();
  const Isochrones isochrones(table, axes);
  for (double tau : axes.logarithmic ? round_ratios(least, most) : round_levels(least, most)) {
    isochrones.append(tau, map.isochrones);
  }
  return map;
}

}  // namespace contensou::portraits
