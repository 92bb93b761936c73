#include "contensou/reduction/planar_reduction.hpp"

#include <algorithm>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>
#include <boost/math/quadrature/gauss_kronrod.hpp>

#include "planar/inverse_factor.hpp"
#include "planar/solution.hpp"

namespace contensou::reduction {

using Eigen::Vector2d;

namespace {

/// Returns the distance from the origin, in steps of a factor 2, at which the field first changes along several
/// directions: a component or a switching function changes its sign, or f comes to differ from f(0) by half of f(0). 0
/// if there is no change.
double first_change(const SmoothField& field) {
  constexpr int directions = 16, farthest = 60;
  struct There {
    std::optional<Vector2d> f;
    Eigen::VectorXd switches;
  };
  const auto at = [&](const Vector2d& x) {
    There there{value_of(field.value, x), {}};
    if (field.switches) there.switches = field.switches(x).col(0);
    return there;
  };
  const auto origin = value_of(field.value, Vector2d::Zero());
  const auto differs = [&](const Vector2d& f) {
    constexpr double half = 0.5;
    return origin && !origin->isZero(0) && (f - *origin).stableNorm() > half * origin->stableNorm();
  };
  const auto changes = [&](const There& before, const There& there) {
    if (before.f && there.f) {
      if ((before.f->array() * there.f->array() < 0).any()) return true;
      if (differs(*there.f) && !differs(*before.f)) return true;  // a jump at the origin is no length
    }
    return (before.switches.array() * there.switches.array() < 0).any();
  };
  std::vector<There> before(directions);
  for (int k = -farthest; k <= farthest; ++k) {
    const double length = std::ldexp(1, k);
    for (int i = 0; i < directions; ++i) {
      const double angle = (i + std::numbers::phi - 1) * 2 * std::numbers::pi / directions;
      There there = at(length * Vector2d(std::cos(angle), std::sin(angle)));
      There& last = before[static_cast<std::size_t>(i)];
      if (k > -farthest && changes(last, there)) return length;
      last = std::move(there);
    }
  }
  return 0;
}

/// Returns false if the misfit of a V of few terms exceeds rounding at 100 points that the fit did not use. Then V has
/// only nearly this form, which derivatives that are exact except for rounding can tell. Rounding is compared with the
/// terms at the point and with their mean, because all terms can be small at a single point. Rounding differs in sign
/// from point to point, but a term that V misses does not; so the root mean square has a stricter limit.
bool holds_exactly(const SmoothField& field, const FieldSamples& samples, const InverseFactor& factor) {
  constexpr double rounding = 1e-14, on_average = 3e-15;
  if (!field.jacobian || factor.form() > FactorForm::polynomial) return true;
  std::vector<InverseFactor::Misfit> misfits;
  double mean = 0, square = 0;
  for (auto i = static_cast<std::size_t>(samples.fitted()); i < samples.points.size(); ++i) {
    misfits.push_back(factor.misfit(samples.points[i], samples.jets[i]));
    mean += misfits.back().size;
    square += misfits.back().value * misfits.back().value;
  }
  const auto count = static_cast<double>(misfits.size());
  mean /= count;
  return std::sqrt(square / count) <= on_average * mean && std::ranges::all_of(misfits, [&](const auto& at) {
           return std::abs(at.value) <= rounding * (at.size + mean);
         });
}

/// Returns false if V fails in wider boxes, or farther from the origin if the box is much nearer to it than all changes
/// of sign of the field. In a small box every smooth V is near a polynomial: a fit proves no form.
/// @param size  distance from the origin within which the field changes its signs
bool holds_widely(const SmoothField& field, const FactorFit& fit, double size) {
  const FactorForm form = fit.factor.form();
  const Box& box = fit.factor.box();
  std::vector<Box> boxes{widened(form, box, 4), widened(form, box, form == FactorForm::basis ? 2 : 64)};
  constexpr double near = 0.25, farther = 3;
  const double distance = box.centre.lpNorm<Eigen::Infinity>();
  if (distance < near * size) {
    // A series in one variable keeps its radius, because farther out V can need more terms.
    const double factor = farther * size / distance;
    const Vector2d centre = factor * box.centre;
    boxes.push_back(form == FactorForm::product ? box_about(centre) : widened(form, {centre, box.radii}, factor));
  }
  return std::ranges::all_of(boxes, [&](const Box& wide) {
    const auto samples = sample(field, wide);
    if (!samples) return true;  // the field has no values there
    const auto again = fit_factor(form, *samples);
    if (!again || !again->small) return false;
    // In a still wider box the terms of high degree hide a misfit.
    return &wide != &boxes.front() || holds_exactly(field, *samples, again->factor);
  });
}

/// The solution in units of length: all members except those of Solution divide u and v by `unit`.
struct FactorSolution final : PlanarReduction::Solution, std::enable_shared_from_this<FactorSolution> {
  FactorSolution(SmoothField of, const Vector2d& from, double length)
      : Solution(std::move(of), ""),
        unit(length),
        smooth(in_units(field, length)),
        fitted(smooth),
        start(from / length) {}

  void clear_denominator() {
    fitted = with_cleared_denominator(smooth);
    cleared = true;
  }

  double unit;
  SmoothField smooth;
  SmoothField fitted;  ///< field for which V has its form: the field, or its product with the denominator
  Vector2d start;
  bool cleared = false;
  std::optional<InverseFactor> v = {};

  void look_for_factor();

  double factor(const Vector2d& x) const override { return at(x / unit).first; }
  std::vector<FactorPiece> factor_pieces(const Vector2d& low, const Vector2d& high) const override;
  static constexpr int most_evaluations = 1'000'000;  ///< about half a second
  PlanarOrbit orbit(const Vector2d& from) const override { return followed(from, most_evaluations); }
  PlanarOrbit part_of_orbit(const Vector2d& from) const override {
    constexpr int evaluations = 100'000;
    return followed(from, evaluations);
  }
  PlanarOrbit followed(const Vector2d& from, int most_work) const;
  double end_time_error(const Vector2d& x, const PlanarOrbit& from_x) const override;
  std::optional<double> first_integral(const Vector2d& x) const override { return unit * unit * integral(x / unit); }
  std::shared_ptr<const Solution> reversed() const override;

  std::string formula() const override {
    const Vector2d from = unit * (start.isZero(0) ? Vector2d(1, 1) : start);
    return recognised(cleared ? with_cleared_denominator(field) : field, from);
  }

  /// Returns V at a point of the box, and the field at this point.
  std::pair<double, Vector2d> at(const Vector2d& x) const {
    const InverseFactor& fit = *v;
    if (!holds_everywhere(fit.form()) && !(fit.box().inside(x).cwiseAbs().maxCoeff() <= 1)) {
      throw std::domain_error(fmt::format(
          "PlanarReduction: ({}, {}) is outside the box of V about ({}, {}), +-({}, {})", unit * x[0], unit * x[1],
          unit * start[0], unit * start[1], unit * fit.box().radii[0], unit * fit.box().radii[1]));
    }
    if (const auto found = scaled(fit, cleared ? smooth.denominator(start)[0] : 1, x)) return *found;
    throw std::domain_error(
        fmt::format("PlanarReduction: the field has no value at ({}, {})", unit * x[0], unit * x[1]));
  }

  /// Returns a fitted V times `scale` at a point, and the field there; empty if the field has no value.
  std::optional<std::pair<double, Vector2d>> scaled(const InverseFactor& fit, double scale, const Vector2d& x) const {
    const auto f = value_of(smooth.value, x);
    std::optional<Jet> of_form;
    if (fit.form() == FactorForm::basis) {
      of_form = jet_of(fitted, x);
    } else if (const auto g = cleared ? value_of(fitted.value, x) : f) {
      of_form = {*g, Eigen::Matrix2d::Zero()};
    }
    if (!f || !of_form) return std::nullopt;
    const double value = scale * fit(x, *of_form)[0];
    return std::pair(cleared ? value / smooth.denominator(x)[0] : value, *f);
  }

  /// Returns the integral of dH along the straight line between two points.
  /// @param value  V and the field at a point
  template <class Value>
  static double line_integral(const Vector2d& from, const Vector2d& to, double sign, unsigned halvings,
                              const Value& value) {
    const Vector2d way = to - from;
    const auto rate = [&](double share) {
      const auto [here, f] = value(Vector2d(from + share * way));
      if (here * sign > 0) return cross(f, way) / here;
      throw std::domain_error("PlanarReduction: V = 0 between the start and the point, where H is infinite");
    };
    using Rule = boost::math::quadrature::gauss_kronrod<double, 31>;
    return Rule::integrate(rate, 0, 1, halvings, 1e-14);
  }

  double integral(const Vector2d& to) const {
    return line_integral(start, to, at(start).first, 12, [this](const Vector2d& x) { return at(x); });
  }

  std::vector<LevelPoint> levels(const std::vector<Vector2d>& path) const override;
};

/// A walk along a path on which dH is integrated. Where the walk leaves the box of V, V is fitted anew.
class FactorWalk {
 public:
  FactorWalk(const FactorSolution& solution)  // NOLINT(google-explicit-constructor): used at one place
      : solution_(solution), factor_(*solution.v), box_(solution.v->box()), x_(solution.start) {
    if (solution.cleared) scale_ = solution.smooth.denominator(x_)[0];
  }

  /// Goes straight to a point. Returns H and V there.
  /// @throws std::domain_error  if V or the field has no value on the way, or V is not unique
  LevelPoint to(const Vector2d& target) {
    constexpr double inner = 0.9;
    if (const auto& switches = solution_.smooth.switches) {
      // Across a jump the form of V goes on, but V does not.
      const Eigen::ArrayXd there = switches(target).col(0).array();
      if (sides_.size() == 0) sides_ = switches(solution_.start).col(0).array();
      sides_ = (sides_ == 0).select(there, sides_);  // from a jump H is continued to the first side
      if ((sides_ * there < 0).any()) throw std::domain_error("PlanarReduction: V jumps on the way");
    }
    constexpr unsigned halvings = 2;  // V is smooth in its box, and near the orbit the integral is about 0
    bool centred = false;             // the box has just been put about x_
    while (x_ != target) {
      double part = 1;  // share of the way that lies well within the box
      if (!holds_everywhere(factor_.form())) {
        const Vector2d here = box_.inside(x_), way = box_.inside(target) - here;
        for (int i = 0; i < 2; ++i) {
          if (way[i] != 0) part = std::min(part, ((way[i] > 0 ? inner : -inner) - here[i]) / way[i]);
        }
      }
      constexpr double least = 1e-3;
      if (!(part > least) && part < 1 && !centred) {
        fit_anew();
        centred = true;
        continue;
      }
      centred = false;
      const Vector2d next = part >= 1 ? target : Vector2d(x_ + part * (target - x_));
      integral_ += FactorSolution::line_integral(x_, next, value(x_).first, halvings,
                                                 [this](const Vector2d& x) { return value(x); });
      x_ = next;
    }
    return {integral_, value(x_).first};
  }

 private:
  std::pair<double, Vector2d> value(const Vector2d& x) const {
    if (const auto found = solution_.scaled(factor_, scale_, x)) return *found;
    throw std::domain_error("PlanarReduction: the field has no value on the way");
  }

  void fit_anew() {
    constexpr int most = 200, halvings = 6;
    const auto known = [&](const Vector2d& x) {
      const auto f = value_of(solution_.fitted.value, x);
      return f && box_.inside(x).lpNorm<Eigen::Infinity>() <= 1 ? factor_(x, Jet{*f, Eigen::Matrix2d::Zero()})[0]
                                                                : std::numeric_limits<double>::quiet_NaN();
    };
    Box box = box_about(x_);
    for (int i = 0; i <= halvings && fits_ < most; ++i, box.radii /= 2) {
      ++fits_;
      const auto samples = sample(solution_.fitted, box);
      const auto fit = samples ? fit_factor(factor_.form(), *samples, known) : std::nullopt;
      if (!fit || !fit->small || fit->factor.vanishes) continue;
      const double before = value(x_).first;
      factor_ = fit->factor;
      box_ = box;
      scale_ *= before / value(x_).first;
      return;
    }
    throw std::domain_error("PlanarReduction: V is not known on the way");
  }

  const FactorSolution& solution_;
  InverseFactor factor_;
  Box box_;
  Vector2d x_;
  double scale_ = 1, integral_ = 0;
  Eigen::ArrayXd sides_ = {};  ///< values of the switching functions on the side of the jumps on which H is known
  int fits_ = 0;
};

std::vector<LevelPoint> FactorSolution::levels(const std::vector<Vector2d>& path) const {
  std::vector<LevelPoint> all;
  try {
    FactorWalk walk(*this);
    for (const Vector2d& x : path) {
      const LevelPoint there = walk.to(x / unit);
      all.push_back({unit * unit * there.integral, there.factor});
    }
  } catch (const std::domain_error&) {
    // From this point on H is not known.
  }
  all.resize(path.size(), LevelPoint());
  return all;
}

void FactorSolution::look_for_factor() {
  Box box = box_about(start);
  std::optional<FieldSamples> samples;
  // If the field has no values, halve the box at most 4 times: in a small box every smooth V is close to a polynomial.
  constexpr int halvings = 4;
  for (int i = 0; i <= halvings && !samples; ++i, box.radii /= 2) samples = sample(fitted, box);
  constexpr double large = 1e4;
  const int first = fitted.basis.values ? factor_forms : 0, end = fitted.basis.values ? first + 1 : factor_forms;
  for (int i = first; samples && i < end && !v; ++i) {
    const auto fit = fit_factor(static_cast<FactorForm>(i), *samples);
    if (!fit) continue;
    tried.push_back(fit->tried);
    tried.back().cleared = cleared;
    if (fit->small && fit->tried.gap >= large && holds_exactly(fitted, *samples, fit->factor) &&
        holds_widely(fitted, *fit, first_change(fitted))) {
      v = fit->factor;
    }
  }
}

std::shared_ptr<const PlanarReduction::Solution> FactorSolution::reversed() const {
  auto other = std::make_shared<FactorSolution>(backward(field), unit * start, unit);
  if (cleared) other->clear_denominator();
  other->v = v;  // V of the reversed field is the same
  other->form = form;
  return other;
}

std::vector<FactorPiece> FactorSolution::factor_pieces(const Vector2d& low, const Vector2d& high) const {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const FactorForm shape = v->form();
  if (shape == FactorForm::constant || shape == FactorForm::product) return {};  // these forms have no zeros
  if (holds_everywhere(shape)) {
    return {{low, high, [solved = shared_from_this()](const Vector2d& x) {
               try {
                 return solved->at(x / solved->unit).first;
               } catch (const std::domain_error&) {
                 return none;
               }
             }}};
  }
  std::vector<FactorPiece> pieces;
  const auto add = [&](const auto& add_part, const Vector2d& from, const Vector2d& to, int halvings) -> void {
    // Equilibria often lie in the middle of a rectangle, so the box is centred beside the middle.
    constexpr double aside = 0.03;
    const Vector2d radii = (to - from) / 2;
    const Vector2d middle = from + radii + aside * Vector2d(radii[0], -radii[1] / 2);
    const auto samples = sample(fitted, {middle, (1 + aside) * radii});
    const auto fit = samples ? fit_factor(shape, *samples) : std::nullopt;
    if (fit && fit->small) {
      if (!fit->unique) return;
      pieces.push_back({unit * from, unit * to,
                        [part = fit->factor, length = unit](const Vector2d& x) { return part(x / length, {})[0]; }});
    } else if (halvings > 0) {
      for (int i = 0; i < 4; ++i) {
        const Vector2d part(i % 2, i / 2);
        const Vector2d corner = from + part.cwiseProduct(radii);
        add_part(add_part, corner, corner + radii, halvings - 1);
      }
    }
  };
  constexpr int most = 3;
  add(add, low / unit, high / unit, most);
  return pieces;
}

/// Compares with an orbit that begins a little later and is therefore divided into other parts.
double FactorSolution::end_time_error(const Vector2d&, const PlanarOrbit& from_x) const {
  constexpr double least = 1e-12, margin = 8, early = 0.01;
  const double time = period_or_end(from_x);
  const PlanarOrbit again = orbit(from_x.at(early * time));
  if (again.end() != from_x.end()) return 1;
  const double other = again.period().value_or(early * time + again.end_time());
  return std::max(least, margin * std::abs(other / time - 1));
}

PlanarOrbit FactorSolution::followed(const Vector2d& from, int most_work) const {
  if (!from.allFinite() || !value_of(field.value, from)) {
    throw std::domain_error(fmt::format("PlanarReduction: the field has no value at ({}, {})", from[0], from[1]));
  }
  return PlanarOrbit(follow(smooth, cleared, *v, from / unit, unit, most_work));
}

}  // namespace

Vector2d sampled_about(const SmoothField& field, const Vector2d& start) {
  // In the units of a start that is much nearer to the origin than all changes of the field, they could not be seen.
  constexpr double near = 1e-6, smallest = 1e-290;  // below, units of length underflow
  const double size = start.lpNorm<Eigen::Infinity>(), change = first_change(field);
  if (size < near * change) return Vector2d::Constant(std::max(change, smallest));
  return size >= smallest ? start : Vector2d::Constant(size > 0 ? smallest : 1);
}

Vector2d valued_near(const SmoothField& field, const Vector2d& point) {
  return value_of(field.value, point) ? point : Vector2d(0.83 * point[0], 1.27 * point[1]);
}

std::shared_ptr<PlanarReduction::Solution> solved_by_factor(const SmoothField& field, const Vector2d& start) {
  const auto value = value_of(field.value, start);
  if (!start.allFinite() || !value) {
    throw std::domain_error(fmt::format("by_factor: the field has no value at ({}, {})", start[0], start[1]));
  }
  // V can vanish at an equilibrium, so the search begins beside an equilibrium.
  const Vector2d beside(1.25 * start[0], 0.8 * start[1]);
  const double unit = std::ldexp(1, std::ilogb(sampled_about(field, start).lpNorm<Eigen::Infinity>()));
  auto solved = std::make_shared<FactorSolution>(field, value->isZero(0) ? beside : start, unit);
  solved->look_for_factor();
  if (!solved->v && field.denominator) {
    solved->clear_denominator();
    solved->look_for_factor();
  }
  if (solved->v) {
    solved->form = name(solved->v->form());
    return solved;
  }
  auto stepped = solved_by_steps(field);
  stepped->tried = std::move(solved->tried);
  stepped->why_not = field.basis.values ? "no sum of the functions of the basis is an inverse integrating factor"
                                        : "no inverse integrating factor of the forms that are tried";
  return stepped;
}

}  // namespace contensou::reduction
