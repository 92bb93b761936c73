#include "fit/search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <unsupported/Eigen/NonLinearOptimization>

namespace contensou::fit {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

/// Returns r such that r^2/2 is Huber's loss of the residual. `softened_slope` returns the derivative of r.
double softened(double residual) {
  const double size = std::abs(residual);
  return size <= huber_bend ? residual
                            : std::copysign(std::sqrt(2 * huber_bend * size - huber_bend * huber_bend), residual);
}
double softened_slope(double residual) {
  return std::abs(residual) <= huber_bend ? 1 : huber_bend / std::abs(softened(residual));
}

/// The residuals as a function of the free parameters, in the form that the minimiser needs.
struct Functor {
  using Scalar = double;
  using InputType = VectorXd;
  using ValueType = VectorXd;
  using JacobianType = Eigen::MatrixXd;
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

  /// The line on which ln f and ln eps keep a held combination. The functor's first input is the position on this line.
  struct Line {
    Eigen::Vector2d direction;
    double low = -std::numeric_limits<double>::infinity(), high = -low;  ///< positions that keep both within limits
  };

  const Search& search;
  VectorXd start;
  std::vector<Index> free = search.free;  ///< places of the other inputs
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

VectorXd Search::improved(VectorXd parameters, const Coordinate* held, double tolerance) const {
  if (request.each_search) request.each_search();
  // A parameter that the sum of squares pushes beyond its limit stays at the limit until it is pushed back, while
  // the others are improved. Otherwise steps that a limit cuts off are refused, and shorter steps end the search early.
  constexpr int most_rounds = 5;
  std::vector<Index> kept;
  for (int i = 0; i < most_rounds; ++i) {
    // A held combination has its own limits of friction and patch radius: the limits of its line.
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

}  // namespace contensou::fit
