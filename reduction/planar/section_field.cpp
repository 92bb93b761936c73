#include "planar/section_field.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <Eigen/LU>

#include "contensou/reduction/detail/root.hpp"
#include "numerics/decomposition.hpp"
#include "numerics/epsilon.hpp"

namespace contensou::reduction {

using Eigen::Matrix2d;
using Eigen::Vector2d;

std::optional<Vector2d> value_of(const PlanarField& field, const Vector2d& x) {
  try {
    const Vector2d f = field(x);
    if (f.allFinite()) return f;
  } catch (const std::exception&) {  // a border of the points at which the field has values
  }
  return std::nullopt;
}

double cross(const Vector2d& a, const Vector2d& b) { return a[0] * b[1] - a[1] * b[0]; }

namespace {

/// Returns the frame S in which |n| grows along the scaling everywhere: S = L^-T with Q = L L^T and A^T Q + Q A = 1.
Matrix2d frame_of(const Matrix2d& a) {
  Eigen::Matrix3d equations;                 // equations for Q11, Q12, Q22
  equations << 2 * a(0, 0), 2 * a(1, 0), 0,  //
      a(0, 1), a(0, 0) + a(1, 1), a(1, 0),   //
      0, 2 * a(0, 1), 2 * a(1, 1);
  const Eigen::Vector3d q = solution(equations, Eigen::Vector3d(1, 0, 1));
  if (!(q[0] > 0 && q[0] * q[2] > q[1] * q[1])) {
    throw std::domain_error("PlanarReduction: all eigenvalues of the scaling's matrix must have positive real parts");
  }
  // S = L^-T is upper triangular, because L in Q = L L^T is lower triangular.
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
    throw std::domain_error(
        "PlanarReduction: a point is needed that is not the centre of the scaling, at a finite distance from it");
  }
  frame_ *= size;
  frame_inverse_ /= size;
  matrix_ = frame_inverse_ * scaling.matrix * frame_;
  if (scaling.matrix.isDiagonal(0)) matrix_ = scaling.matrix;
}

std::optional<SectionField::Rates> SectionField::operator()(const Vector2d& n) const {
  const auto f = value_of(field_, centre_ + frame_ * n);
  if (!f) return std::nullopt;
  const Vector2d g = frame_inverse_ * *f, along = matrix_ * n;
  const double outward = n.dot(along);
  return Rates{g.dot(n) / outward, cross(along, g) / outward, g.stableNorm(),
               (std::abs(g[0] * n[0]) + std::abs(g[1] * n[1])) / outward,
               (std::abs(along[0] * g[1]) + std::abs(along[1] * g[0])) / outward};
}

bool SectionField::regular() const {
  const auto f = value_of(field_, centre_);
  return f && !f->isZero(0);
}

std::pair<Vector2d, double> SectionField::canonical(const Vector2d& x) const {
  const Vector2d z = frame_inverse_ * (x - centre_);
  const double length = z.stableNorm();
  // The eigenvalues of the symmetric part of A' are the least and largest rate at which ln |z| grows along the scaling.
  const double mean = matrix_.trace() / 2;
  const double spread = std::hypot((matrix_(0, 0) - matrix_(1, 1)) / 2, (matrix_(0, 1) + matrix_(1, 0)) / 2);
  const double ends[] = {std::log(length) / (mean - spread), std::log(length) / (mean + spread)};
  auto [low, high] = std::minmax(ends[0], ends[1]);
  // Move z in several steps, so that no step overflows.
  constexpr double longest = 300;
  const double largest = matrix_.cwiseAbs().rowwise().sum().maxCoeff();
  const auto moved = [&](double p) -> Vector2d {
    const int steps = 1 + static_cast<int>(std::abs(p) * largest / longest);
    const Matrix2d step = matrix_exponential(-p / steps * matrix_);
    Vector2d place = z;
    for (int i = 0; i < steps; ++i) place = step * place;
    return place;
  };
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

}  // namespace contensou::reduction
