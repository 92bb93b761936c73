#include "fit/scaled_orbit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace contensou::fit {

namespace {

constexpr int pieces = 8;
constexpr int max_halvings = 40;

}  // namespace

ScaledOrbit::ScaledOrbit(const reduction::Flow& flow, reduction::State start, double end, double accuracy) {
  const double tolerance = 4 * accuracy;  // a last halving makes it up to 16 times smaller
  constexpr double tau_of_one = 3 * std::numbers::pi / 2;
  const double sign = start.v < 0 ? -1 : 1;
  start.v = std::abs(start.v);
  const reduction::Orbit orbit = flow.orbit(start);
  stop_ = orbit.stop_time() / tau_of_one;
  const double v_scale = start.v > 0 ? start.v : std::abs(start.u),
               u_scale = start.u != 0 ? std::abs(start.u) : start.v;

  const auto node_at = [&](double T) {
    const double tau = std::min(tau_of_one * T, orbit.stop_time());
    reduction::OrbitPoint point = orbit.at_time(tau);
    const Node speeds{T, sign * point.v, point.u, 0, 0};
    // The rates depend on k alone, and have a limit at the stop.
    if (point.u == 0 && point.v == 0) point = orbit.at_time_left(1e-9 * orbit.stop_time());
    const reduction::Rate rate = flow.system().field({point.u, point.v});
    return Node{speeds.T, speeds.v, speeds.u, sign * tau_of_one * rate.v, tau_of_one * rate.u};
  };
  nodes_.push_back({0, sign * start.v, start.u, 0, 0});
  const double last = std::min(end, stop_);
  if (!(last > 0)) return;
  nodes_.front() = node_at(0);

  const auto far_off = [&](double y0, double d0, double y, double d, double y1, double d1, double width, double scale) {
    const double value = (y0 + y1) / 2 + width * (d0 - d1) / 8;
    const double slope = 1.5 * (y1 - y0) - width * (d0 + d1) / 4;
    return std::abs(value - y) > tolerance * scale || std::abs(slope - width * d) > 8 * tolerance * scale;
  };
  std::vector<std::pair<Node, int>> ahead;  // right ends that are still to be reached, the next one last
  for (int i = pieces; i > 0; --i) ahead.emplace_back(node_at(i == pieces ? last : last * i / pieces), 0);
  while (!ahead.empty()) {
    const auto [right, halvings] = ahead.back();
    const Node left = nodes_.back();
    const double width = right.T - left.T;
    const Node middle = node_at(left.T + width / 2);
    if (halvings < max_halvings && (far_off(left.v, left.dv, middle.v, middle.dv, right.v, right.dv, width, v_scale) ||
                                    far_off(left.u, left.du, middle.u, middle.du, right.u, right.du, width, u_scale))) {
      ahead.back().second = halvings + 1;
      ahead.emplace_back(middle, halvings + 1);
      continue;
    }
    nodes_.push_back(middle);
    nodes_.push_back(right);
    ahead.pop_back();
  }
  for (std::size_t i = 1; i < nodes_.size(); ++i) {
    const Node& left = nodes_[i - 1];
    Node& right = nodes_[i];
    const double h = right.T - left.T;
    right.slid = left.slid + h * ((left.v + right.v) / 2 + h * (left.dv - right.dv) / 12);
    right.turned = left.turned + h * ((left.u + right.u) / 2 + h * (left.du - right.du) / 12);
  }
}

OrbitColumns ScaledOrbit::operator()(const Eigen::ArrayXd& at) const {
  const Eigen::Index rows = at.size();
  OrbitColumns columns{Eigen::ArrayXd::Zero(rows), Eigen::ArrayXd::Zero(rows), Eigen::ArrayXd(rows),
                       Eigen::ArrayXd(rows),       Eigen::ArrayXd::Zero(rows), Eigen::ArrayXd::Zero(rows)};
  std::size_t cell = 1;
  for (Eigen::Index row = 0; row < rows; ++row) {
    const double T = at[row];
    if (T >= nodes_.back().T) {  // past the stop; without a motion, at the start
      columns.slid[row] = nodes_.back().slid;
      columns.turned[row] = nodes_.back().turned;
      if (T < stop_ || T == 0) {
        columns.v[row] = nodes_.back().v;
        columns.u[row] = nodes_.back().u;
        columns.dv[row] = nodes_.back().dv;
        columns.du[row] = nodes_.back().du;
      }
      continue;
    }
    if (T < nodes_[cell - 1].T) cell = 1;
    while (T >= nodes_[cell].T) ++cell;
    const Node& left = nodes_[cell - 1];
    const Node& right = nodes_[cell];
    const double h = right.T - left.T;
    const double s = (T - left.T) / h;
    const auto cubic = [&](double y0, double d0, double y1, double d1, double& y, double& d, double& integral) {
      const double c2 = 3 * (y1 - y0) - h * (2 * d0 + d1);
      const double c3 = h * (d0 + d1) - 2 * (y1 - y0);
      y = y0 + s * (h * d0 + s * (c2 + s * c3));
      d = d0 + s * (2 * c2 + 3 * s * c3) / h;
      integral = h * s * (y0 + s * (h * d0 / 2 + s * (c2 / 3 + s * c3 / 4)));
    };
    cubic(left.v, left.dv, right.v, right.dv, columns.v[row], columns.dv[row], columns.slid[row]);
    cubic(left.u, left.du, right.u, right.du, columns.u[row], columns.du[row], columns.turned[row]);
    columns.slid[row] += left.slid;
    columns.turned[row] += left.turned;
  }
  return columns;
}

}  // namespace contensou::fit
