// Notation (planar.md (R64), (R66), (R67)): p' = R, q' = T in sigma, dt = exp(c p) dsigma; xi falls at a rate s >= 0. p
// = L(xi) on one orbit; exp(c p) M(xi) is the time left:   dL/dxi = -R/s,   s dM/dxi - c R M = 1
#include "planar/strip.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <boost/math/quadrature/gauss_kronrod.hpp>

#include "contensou/reduction/detail/infinity.hpp"
#include "contensou/reduction/detail/root.hpp"
#include "numerics/epsilon.hpp"

namespace contensou::reduction {

using Eigen::Vector2d;
using std::numbers::pi;
using Samples = LegendreSeries::Samples;

namespace {

constexpr double same_order = 1e-9;

/// Returns the limit of p at an end. `sign` is 1 if the motion goes towards the end, and -1 if it comes from the end.
Limit limit_at(const Approach& end, double sign) {
  if (!end.decided()) return Limit::undecided;
  const double radial = sign * end.radial().factor;
  const bool along = end.ray() && end.radial().order == 0;  // p has no bound on the ray itself, perhaps only there
  if (radial == 0 || (end.growth() > same_order && !along)) return Limit::point;
  return radial < 0 ? Limit::centre : Limit::infinity;
}

}  // namespace

Strip::Strip(const SectionField& field, const Approach& to, const Approach& from, const std::vector<Vector2d>& breaks,
             double sense, double length, double tolerance, std::optional<double> slide)
    : field_(&field), to_(to), from_(from), slide_(slide), sense_(sense), length_(length), tolerance_(tolerance) {
  constexpr double last = -first, middle = 8, width = 2;
  const double start = first_time();
  std::vector<double> edges;
  // Far from the middle R and T are nearly their leading powers, so panels can be wider.
  for (double edge = first; edge <= last; edge += edge < -middle || edge >= middle ? 2 * width : width)
    edges.push_back(edge);
  for (const Vector2d& n : breaks) {
    const double edge = locate(n).value_or(infinity);
    if (edge > first && edge < last) edges.push_back(edge);
  }
  solve(edges, start);
}

Strip::Strip(const SectionField& field, const std::vector<Vector2d>& breaks, double sense, double tolerance)
    : field_(&field), sense_(sense), length_(2 * pi), tolerance_(tolerance) {
  constexpr int parts = 16;
  std::vector<double> edges;
  for (int i = 0; i <= parts; ++i) edges.push_back(2 * pi * i / parts);
  for (const Vector2d& n : breaks) edges.push_back(*locate(n));
  solve(edges, 0);
  turn_ = -panels_.back().ln_rho.at_end();
  const double change = field.time_degree() * turn_;
  constexpr double least = 1e-13, margin = 8;
  if (std::abs(turn_) <= std::max(least, margin * turn_error_)) turn_ = 0;
  timed_ = turn_ != 0 && change < 0;
  if (!timed_) return;
  // M is the solution that repeats after a turn: M(2 pi) = M_0(2 pi) + exp(change) M(0) = M(0), where M_0(0) = 0.
  const double first_time = last_time_ / -std::expm1(change);
  solve(edges, first_time);
}

Limit Strip::limit() const {
  if (!slide_) return limit_at(*to_, 1);
  return *slide_ < 0 ? Limit::centre : *slide_ > 0 ? Limit::infinity : Limit::point;
}
Limit Strip::origin() const { return limit_at(*from_, -1); }

bool Strip::joins_ray() const {
  if (slide_) return *slide_ != 0;
  return !closed() && to_->ray() && to_->radial().order == 0 && to_->angular().order < 1;
}

/// Returns M, time left divided by exp(c p), at the first edge (planar.md (R68)). Below this edge M is a power of
/// exp(xi).
double Strip::first_time() {
  if (!to_->decided()) return 0;
  const double c = field_->time_degree(), a = to_->angular().order, b = to_->radial().order;
  const double angular = std::abs(to_->angular().factor), radial = to_->radial().factor;
  const double gamma = to_->growth();
  double factor;
  if (joins_ray() || (gamma < -same_order && c != 0)) {
    time_order_ = slide_ ? 0 : -b;
    factor = -1 / (c * (joins_ray() ? along_ray() : radial));
  } else {
    time_order_ = 1 - a;
    factor = 1 / (angular * (1 - a) - (gamma < same_order ? c * radial : 0));
  }
  timed_ = factor > 0 && std::isfinite(factor);
  return timed_ ? factor * std::exp(time_order_ * first) : 0;
}

double Strip::turn_sigma() const {
  using Rule = boost::math::quadrature::gauss_kronrod<double, 31>;
  double sum = 0;
  for (const Panel& panel : panels_) {
    sum += Rule::integrate([&](double xi) { return 1 / rate(xi); }, panel.left, panel.right, 0);
  }
  return sum;
}

std::optional<double> Strip::locate(const Vector2d& n) const {
  const auto angle = [](double sense, const Vector2d& from, const Vector2d& to) {
    const double turn = sense * std::atan2(cross(from, to), from.dot(to));
    return turn < 0 ? turn + 2 * pi : turn;
  };
  if (closed()) return angle(sense_, Vector2d(1, 0), n);
  // If n lies on a ray off the axes, n is rounded.
  const auto on = [&](const Vector2d& end) {
    const double distance = std::abs(cross(end, n));
    return end.dot(n) > 0 && distance <= (end[0] == 0 || end[1] == 0 ? 0 : 4 * eps);
  };
  if (on(to_->n())) return -infinity;
  if (on(from_->n())) return infinity;
  const double z = angle(sense_, to_->n(), n);
  if (z > length_) return std::nullopt;
  return std::log(z) - std::log(angle(-sense_, from_->n(), n) / length_);
}

double Strip::sector_angle(double xi, bool from_far) const {
  const double growth = std::exp(from_far ? xi : -xi);  // z = l e/(l + e), l - z = l^2/(l + e), e = exp(xi), l = length
  return from_far ? length_ / (1 + growth / length_) : 1 / (1 / length_ + growth);
}

Vector2d Strip::direction(double xi) const {
  if (closed()) return turned({1, 0}, sense_ * xi);
  const double z = sector_angle(xi, false);
  return z < length_ / 2 ? turned(to_->n(), sense_ * z) : turned(from_->n(), -sense_ * sector_angle(xi, true));
}

Strip::Terms Strip::terms(double xi) const {
  double factor = 1;
  bool inside = true;
  if (!closed()) {
    const double z = sector_angle(xi, false), y = sector_angle(xi, true);
    for (const auto& [end, distance] : {std::pair(&*to_, z), std::pair(&*from_, y)}) {
      if (!(distance < end->width())) continue;
      const auto rates = end->series(distance);
      return {std::abs(rates.angular) * (length_ / (z * y)), rates.radial, eps, eps * std::abs(rates.radial)};
    }
    factor = length_ / (z * y);
    constexpr double located = 1e-9;  // largest error of the angle of an end of the strip
    inside = std::min(z, y) > located;
  }
  const Vector2d n = direction(xi);
  const auto rates = (*field_)(n);
  if (!rates) return {infinity, 0, 1, 0};
  const double rate = -sense_ * rates->angular * factor;
  const double rounding = rates->size * factor * eps, crossed = -2 * tolerance_ * rates->size * factor;
  constexpr double nearly = 1e-9;  // below this share of its terms, T has lost most of its digits
  const bool missed = rate < crossed || (closed() && rate < nearly * rates->angular_terms * factor);
  if (inside && missed) throw MissedRay{n, rate < crossed};
  return {std::max(rate, rounding), rates->radial, rounding / std::max(rate, rounding), eps * rates->radial_terms};
}

void Strip::solve(std::vector<double> edges, double first_time) {
  std::ranges::sort(edges);
  edges.erase(std::unique(edges.begin(), edges.end(), [](double a, double b) { return b - a < 1e-14; }), edges.end());
  panels_.clear();
  last_time_ = first_time;
  turn_error_ = 0;
  for (std::size_t i = 1; i < edges.size(); ++i) march(edges[i - 1], edges[i], 0);
  join(panels_, &Panel::ln_rho, 0);  // from the middle, because L can be large next to the ends
}

void Strip::march(double left, double right, int depth) {
  constexpr int max_depth = 40;
  constexpr std::size_t max_panels = 20'000;
  const double half = (right - left) / 2;
  const double c = field_->time_degree();
  Samples rate, radial;
  double rounding = 0, of_radial = 0;
  for (int i = 0; i < LegendreSeries::order; ++i) {
    const Terms at = terms(left + half * (1 + LegendreSeries::points()[i]));
    rate[i] = at.rate;
    radial[i] = at.radial;
    rounding = std::max(rounding, at.rounding);
    of_radial = std::max(of_radial, at.of_radial);
  }
  const Samples slope = -radial / rate;
  LegendreSeries ln_rho = LegendreSeries::through(half * slope).antiderivative();
  LegendreSeries time;
  double left_out = LegendreSeries::tail(slope) / std::max(slope.abs().maxCoeff(), 1.0);
  const bool with_time = timed_ || closed();
  if (with_time) {
    time = solve_linear_ode(rate / half, -c * radial, Samples::Ones(), last_time_);
    const double largest = std::max(rate.maxCoeff(), (c * radial).abs().maxCoeff());
    left_out = std::max({left_out, LegendreSeries::tail(rate) / largest, LegendreSeries::tail(c * radial) / largest,
                         time.tail() / std::max(std::abs(time.at_end()), 1 / largest)});
  }
  left_out *= std::min(right - left, 1.0);
  // A jump of R or s beyond the outermost samples shows only in the values at the ends. In a narrow panel next to a
  // kink the rounding of xi is no small part of the panel.
  const double placed = 4 * eps * std::max(std::abs(left), std::abs(right)) / half;
  const auto jumps_at = [&](int end) {
    constexpr double inside = 1 - 1e-12;
    const Terms there = terms(left + half * (1 + inside * end));
    const auto differs = [&](double value, const Samples& samples, double error) {
      const double largest = samples.abs().maxCoeff();
      return std::abs(LegendreSeries::at_end(samples, end) - value) >
             (1e-10 + 100 * rounding + placed) * largest + 100 * error;
    };
    return differs(there.rate, rate, 0) || differs(there.radial, radial, of_radial);
  };
  if (left_out <= tolerance_ + 4 * rounding && (jumps_at(-1) || jumps_at(1))) left_out = infinity;
  if (left_out > tolerance_ + 4 * rounding && depth < max_depth && panels_.size() < max_panels) {
    constexpr int narrow = 6;
    const double middle = depth % narrow == narrow - 1 ? jump(left, right).value_or(left + half) : left + half;
    march(left, middle, depth + 1);
    march(middle, right, depth + 1);
    return;
  }
  last_time_ = time.at_end();
  panels_.push_back({{left, right}, ln_rho, time});
  // The series are cut off, and the values of the field have errors of a tenth of the tolerance.
  const double of_values = tolerance_ / 10 * rounding / eps * (1 + slope.abs().maxCoeff());
  turn_error_ += (right - left) * (LegendreSeries::tail(slope) + of_values);
}

/// Finds a jump of R or s between two xi by bisection. Each step keeps the half between whose ends R or s differs more.
std::optional<double> Strip::jump(double left, double right) const {
  Terms at_left = terms(left), at_right = terms(right);
  const double largest_rate = std::max(at_left.rate, at_right.rate);
  const double largest_radial = std::max(std::abs(at_left.radial), std::abs(at_right.radial));
  const auto change = [=](const Terms& a, const Terms& b) {
    return std::abs(a.rate - b.rate) / largest_rate + std::abs(a.radial - b.radial) / largest_radial;
  };
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = left + (right - left) / 2;
    const Terms here = terms(middle);
    const bool before = change(at_left, here) > change(here, at_right);
    (before ? right : left) = middle;
    (before ? at_right : at_left) = here;
  }
  constexpr double least = 1e-6;
  if (!(change(at_left, at_right) > least)) return std::nullopt;
  return left;
}

double Strip::smooth_from(double xi) const {
  const double turns = closed() ? std::floor(xi / length_) : 0, nearest = xi - 1e-12 * (1 + std::abs(xi));
  for (const double turn : {turns, turns - 1}) {
    const auto after = std::ranges::lower_bound(panels_, nearest - turn * length_, {}, &Panel::left);
    if (after != panels_.begin()) return std::prev(after)->left + turn * length_;
    if (!closed()) break;
  }
  return -infinity;
}

double Strip::ln_rho(double xi) const {
  double beyond = 0;
  if (closed()) {
    const double turns = std::floor(xi / length_);
    xi -= turns * length_;
    beyond = -turns * turn_;
  }
  const Panel& panel = panel_at(panels_, xi);
  const double inside = std::clamp(xi, panel.left, panel.right);
  if (xi != inside) {
    // dL/dz = -R/T or R/T, with the leading powers of R and T.
    const Approach& end = xi < inside ? *to_ : *from_;
    const double slope = end.radial().factor / std::abs(end.angular().factor), gamma = end.growth();
    const auto distance = [&](double at) { return xi < inside ? std::exp(at) : length_ * length_ * std::exp(-at); };
    if (!end.decided() || slope == 0) return panel.ln_rho(xi < inside ? -1 : 1);
    if (std::abs(gamma) < same_order) {
      beyond = -slope * (xi - inside);
    } else {
      const double change = (std::pow(distance(xi), gamma) - std::pow(distance(inside), gamma)) / gamma;
      beyond = xi < inside ? -slope * change : slope * change;
    }
  }
  return beyond + panel.ln_rho(panel.t(inside));
}

double Strip::time_left(double xi) const {
  if (closed()) xi -= std::floor(xi / length_) * length_;
  const Panel& panel = panel_at(panels_, xi);
  const double inside = std::clamp(xi, panel.left, panel.right);
  const double beyond = xi < inside && !closed() && time_order_ != 0 ? std::exp(time_order_ * (xi - inside)) : 1;
  return beyond * panel.time(panel.t(inside));
}

}  // namespace contensou::reduction
