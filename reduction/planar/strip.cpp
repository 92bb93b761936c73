// Notation (README (R42) to (R44)): p' = R, q' = T in sigma, dt = exp(c p) d sigma; xi falls at the rate s >= 0;
//   dL/dxi = -R/s,   s dM/dxi - c R M = 1
#include "planar/strip.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <boost/math/quadrature/gauss_kronrod.hpp>

#include "contensou/reduction/infinity.hpp"
#include "contensou/reduction/root.hpp"
#include "numerics/epsilon.hpp"
#include "numerics/linear_ode.hpp"
#include "planar/matrix_exponential.hpp"

namespace contensou::reduction {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using std::numbers::pi;
using Samples = LegendreSeries::Samples;

namespace {

double cross(const Vector2d& a, const Vector2d& b) { return a[0] * b[1] - a[1] * b[0]; }

/// The frame S in which |n| grows along the scaling everywhere: with Q of A^T Q + Q A = 1, Q = S^-T S^-1.
Matrix2d frame_of(const Matrix2d& a) {
  Eigen::Matrix3d equations;                 // for Q11, Q12, Q22
  equations << 2 * a(0, 0), 2 * a(1, 0), 0,  //
      a(0, 1), a(0, 0) + a(1, 1), a(1, 0),   //
      0, 2 * a(0, 1), 2 * a(1, 1);
  const Eigen::Vector3d q = equations.partialPivLu().solve(Eigen::Vector3d(1, 0, 1));
  if (!(q[0] > 0 && q[0] * q[2] > q[1] * q[1])) {
    throw std::domain_error("PlanarReduction: all eigenvalues of the scaling's matrix must have positive real parts");
  }
  // S = L^-T of Q = L L^T: upper triangular.
  const double l11 = std::sqrt(q[0]), l21 = q[1] / l11, l22 = std::sqrt(q[2] - l21 * l21);
  return (Matrix2d() << 1 / l11, -l21 / (l11 * l22), 0, 1 / l22).finished();
}

}  // namespace

SectionField::SectionField(PlanarField field, const Generator& scaling, const Vector2d& around)
    : field_(std::move(field)), time_(scaling.time), frame_(frame_of(scaling.matrix)) {
  centre_ = scaling.centre();
  frame_inverse_ = frame_.inverse();
  const double size = Vector2d(frame_inverse_ * (around - centre_)).stableNorm();
  if (!(size > 0) || !std::isfinite(size)) {
    throw std::domain_error("PlanarReduction: a finite point other than the centre of the scaling is needed");
  }
  frame_ *= size;
  frame_inverse_ /= size;
  matrix_ = frame_inverse_ * scaling.matrix * frame_;
  if (scaling.matrix.isDiagonal(0)) matrix_ = scaling.matrix;
}

std::optional<SectionField::Rates> SectionField::operator()(const Vector2d& n) const {
  Vector2d f;
  try {
    f = field_(centre_ + frame_ * n);
  } catch (const std::exception&) {
    return std::nullopt;
  }
  if (!f.allFinite()) return std::nullopt;
  const Vector2d g = frame_inverse_ * f, along = matrix_ * n;
  const double outward = n.dot(along);
  return Rates{g.dot(n) / outward, cross(along, g) / outward, g.stableNorm()};
}

bool SectionField::regular() const {
  try {
    const Vector2d f = field_(centre_);
    return f.allFinite() && !f.isZero(0);
  } catch (const std::exception&) {
    return false;
  }
}

std::pair<Vector2d, double> SectionField::canonical(const Vector2d& x) const {
  const Vector2d z = frame_inverse_ * (x - centre_);
  const double length = z.stableNorm();
  const Matrix2d symmetric = (matrix_ + matrix_.transpose()) / 2;
  const Vector2d speeds = Eigen::SelfAdjointEigenSolver<Matrix2d>(symmetric, Eigen::EigenvaluesOnly).eigenvalues();
  const double ends[] = {std::log(length) / speeds[0], std::log(length) / speeds[1]};
  auto [low, high] = std::minmax(ends[0], ends[1]);
  const auto moved = [&](double p) -> Vector2d { return matrix_exponential(-p * matrix_) * z; };
  double p = low;
  if (high - low > 4 * eps * std::abs(low)) {
    const double wider = 1e-12 * (1 + std::abs(low) + std::abs(high));
    p = root_between([&](double at) { return std::log(moved(at).stableNorm()); }, low - wider, high + wider);
  }
  return {moved(p).stableNormalized(), p};
}

Vector2d SectionField::on_section(const Vector2d& direction) const {
  return Vector2d(frame_inverse_ * direction).stableNormalized();
}

Vector2d SectionField::point(const Vector2d& n, double p) const {
  return centre_ + frame_ * (matrix_exponential(p * matrix_) * n);
}

Vector2d turned(const Vector2d& n, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {n[0] * c - n[1] * s, n[1] * c + n[0] * s};
}

Strip::Strip(const SectionField& field, const SectorEnd& to, const SectorEnd& from, double sense, double length,
             double tolerance)
    : field_(&field), to_(to), from_(from), sense_(sense), length_(length), tolerance_(tolerance) {
  to_series_ = series_at(false);
  from_series_ = series_at(true);
  const double c = field.time_degree();
  timed_ = to.ray && c * to.radial < 0;
  // Beyond these, one term of each expansion is exact to the last bit.
  constexpr double last = 44, width = 2;
  std::vector<double> edges;
  for (double edge = first; edge <= last; edge += width) edges.push_back(edge);
  for (const Vector2d& axis : {Vector2d(1, 0), Vector2d(0, 1), Vector2d(-1, 0), Vector2d(0, -1)}) {
    const double edge = locate(field.on_section(axis)).value_or(infinity);
    if (edge > first && edge < last) edges.push_back(edge);
  }
  std::ranges::sort(edges);
  edges.erase(std::unique(edges.begin(), edges.end(), [](double a, double b) { return b - a < 1e-14; }), edges.end());
  solve(edges, timed_ ? -1 / (c * to.radial) : 0);
}

Strip::Strip(const SectionField& field, double sense, double tolerance)
    : field_(&field), sense_(sense), length_(2 * pi), tolerance_(tolerance) {
  constexpr int parts = 16;
  std::vector<double> edges;
  for (int i = 0; i <= parts; ++i) edges.push_back(2 * pi * i / parts);
  solve(edges, 0);
  turn_ = -panels_.back().ln_rho.at_end();
  const double change = field.time_degree() * turn_;
  if (std::abs(turn_) < 1e-13) turn_ = 0;
  timed_ = turn_ != 0 && change < 0;
  if (!timed_) return;
  // M is the solution that returns to its start, M(2 pi) = M_0(2 pi) + exp(change) M(0).
  const double first_time = last_time_ / -std::expm1(change);
  solve(edges, first_time);
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
  // On a ray that is no axis, n is rounded.
  const auto on = [&](const SectorEnd& end) {
    const double distance = std::abs(cross(end.n, n));
    return end.n.dot(n) > 0 && distance <= (end.n[0] == 0 || end.n[1] == 0 ? 0 : 4 * eps);
  };
  if (on(*to_)) return -infinity;
  if (on(*from_)) return infinity;
  const double z = angle(sense_, to_->n, n);
  if (z > length_) return std::nullopt;
  return std::log(z) - std::log(angle(-sense_, from_->n, n) / length_);
}

double Strip::sector_angle(double xi, bool from_far) const {
  const double growth = std::exp(from_far ? xi : -xi);  // z = l e/(l + e), l - z = l^2/(l + e), e = exp(xi)
  return from_far ? length_ / (1 + growth / length_) : 1 / (1 / length_ + growth);
}

Vector2d Strip::direction(double xi) const {
  if (closed()) return turned({1, 0}, sense_ * xi);
  const double z = sector_angle(xi, false);
  return z < length_ / 2 ? turned(to_->n, sense_ * z) : turned(from_->n, -sense_ * sector_angle(xi, true));
}

Strip::Terms Strip::terms(double xi) const {
  double factor = 1;
  bool inside = true;
  if (!closed()) {
    const double z = sector_angle(xi, false), y = sector_angle(xi, true);
    for (const auto& [series, distance] : {std::pair(&to_series_, z), std::pair(&from_series_, y)}) {
      if (distance < series->width) {
        const double t = 2 * (distance / series->width) - 1;
        return {series->rate(t), series->radial(t), eps};
      }
    }
    factor = length_ / (z * y);
    constexpr double located = 1e-9;  // to which an end is, at the worst
    inside = std::min(z, y) > located;
  }
  const Vector2d n = direction(xi);
  const auto rates = (*field_)(n);
  if (!rates) return {infinity, 0, 1};
  const double rate = -sense_ * rates->angular * factor;
  const double rounding = rates->size * factor * eps, zero = 2 * tolerance_ * rates->size * factor;
  if (inside && rate < (closed() ? zero : -zero)) throw MissedRay{n, rate < -zero};
  return {std::max(rate, rounding), rates->radial, rounding / std::max(rate, rounding)};
}

Strip::EndSeries Strip::series_at(bool far) const {
  const SectorEnd& end = far ? *from_ : *to_;
  EndSeries series;
  if (!end.ray) return series;
  constexpr double narrowest = 1e-13;
  for (double width = length_ / 2; width > narrowest * length_; width /= 2) {
    Samples rate, radial;
    bool complete = true;
    for (int i = 0; i < LegendreSeries::order && complete; ++i) {
      const double z = width / 2 * (1 + LegendreSeries::points()[i]);
      const auto rates = (*field_)(turned(end.n, (far ? -sense_ : sense_) * z));
      complete = rates.has_value();
      if (!complete) break;
      rate[i] = -sense_ * rates->angular * (length_ / (z * (length_ - z)));
      radial[i] = rates->radial;
    }
    if (!complete) continue;
    const double accuracy = std::max(5 * tolerance_, 64 * eps / width);
    if (LegendreSeries::tail(rate) > accuracy * rate.abs().maxCoeff() ||
        LegendreSeries::tail(radial) > accuracy * radial.abs().maxCoeff() || !(rate > 0).all()) {
      continue;
    }
    series = {width, 0, LegendreSeries::through(rate), LegendreSeries::through(radial)};
    series.at_end = series.rate(-1);
    if (!(series.at_end > accuracy * rate.abs().maxCoeff())) series.width = series.at_end = 0;  // T only touches 0
    return series;
  }
  return series;
}

void Strip::solve(std::vector<double> edges, double first_time) {
  panels_.clear();
  last_time_ = first_time;
  for (std::size_t i = 1; i < edges.size(); ++i) march(edges[i - 1], edges[i], 0);
  // L from xi = 0 to both sides: next to the ends it may be large.
  const auto zero = std::ranges::lower_bound(panels_, 0.0, {}, &Panel::left);
  double level = 0;
  for (auto panel = zero; panel != panels_.end(); ++panel) level = (panel->ln_rho += level).at_end();
  level = 0;
  for (auto panel = std::make_reverse_iterator(zero); panel != panels_.rend(); ++panel) {
    level -= panel->ln_rho.at_end();
    panel->ln_rho += level;
  }
}

void Strip::march(double left, double right, int depth) {
  constexpr int max_depth = 40;
  constexpr std::size_t max_panels = 20'000;
  const double half = (right - left) / 2;
  const double c = field_->time_degree();
  Samples rate, radial;
  double rounding = 0;
  for (int i = 0; i < LegendreSeries::order; ++i) {
    const Terms at = terms(left + half * (1 + LegendreSeries::points()[i]));
    rate[i] = at.rate;
    radial[i] = at.radial;
    rounding = std::max(rounding, at.rounding);
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
  if (left_out > tolerance_ + 4 * rounding && depth < max_depth && panels_.size() < max_panels) {
    march(left, left + half, depth + 1);
    march(left + half, right, depth + 1);
    return;
  }
  last_time_ = time.at_end();
  panels_.push_back({left, right, ln_rho, time});
}

const Strip::Panel& Strip::find(double xi) const {
  const auto after = std::ranges::upper_bound(panels_, xi, {}, &Panel::left);
  return after == panels_.begin() ? panels_.front() : *std::prev(after);
}

double Strip::ln_rho(double xi) const {
  double beyond = 0;
  if (closed()) {
    const double turns = std::floor(xi / length_);
    xi -= turns * length_;
    beyond = -turns * turn_;
  }
  const Panel& panel = find(xi);
  const double inside = std::clamp(xi, panel.left, panel.right);
  if (xi != inside) {
    const SectorEnd& end = xi < inside ? *to_ : *from_;
    const double rate = xi < inside ? to_series_.at_end : from_series_.at_end;
    if (rate > 0) beyond = -end.radial / rate * (xi - inside);
  }
  return beyond + panel.ln_rho(2 * ((inside - panel.left) / (panel.right - panel.left)) - 1);
}

double Strip::time_left(double xi) const {
  if (closed()) xi -= std::floor(xi / length_) * length_;
  const Panel& panel = find(xi);
  const double inside = std::clamp(xi, panel.left, panel.right);
  return panel.time(2 * ((inside - panel.left) / (panel.right - panel.left)) - 1);
}

}  // namespace contensou::reduction
