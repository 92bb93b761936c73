#include "contensou/reduction/integrating_factor.hpp"

#include <algorithm>
#include <array>

#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>
#include <boost/math/quadrature/gauss_kronrod.hpp>

#include "planar/factor_formula.hpp"
#include "planar/factor_orbit.hpp"
#include "planar/solution.hpp"

namespace contensou::reduction {

using Eigen::Vector2d;

namespace {

/// Returns false if V fails in wider boxes. In a small box every smooth V is near a polynomial: a fit proves no form.
bool holds_widely(const SmoothField& field, const FactorFit& fit) {
  const bool of_basis = fit.factor.form() == FactorForm::basis;
  return std::ranges::all_of(std::array{4., of_basis ? 2. : 64.}, [&](double factor) {
    const auto samples = sample(field, widened(fit.factor.form(), fit.factor.box(), factor));
    if (!samples) return true;  // the field has no values there
    const auto again = fit_factor(fit.factor.form(), *samples);
    return again && again->small;
  });
}

}  // namespace

struct FactorReduction::Solved final : PlanarReduction::Solution,
                                       std::enable_shared_from_this<FactorReduction::Solved> {
  Solved(const SmoothField& given, const Vector2d& from)
      : Solution(given.value, ""), smooth(given), fitted(given), start(from) {}

  SmoothField smooth;
  SmoothField fitted;  ///< field for which V has its form: the field, or its product with the denominator
  Vector2d start;
  bool cleared = false;
  std::vector<TriedForm> tried = {};
  std::optional<InverseFactor> v = {};

  void look_for_factor();

  double factor(const Vector2d& x) const override { return at(x).first; }
  std::vector<FactorPiece> factor_pieces(const Vector2d& low, const Vector2d& high) const override;
  PlanarOrbit orbit(const Vector2d& from) const override {
    constexpr int parts = 32000;
    return followed(from, parts);
  }
  PlanarOrbit part_of_orbit(const Vector2d& from) const override {
    constexpr int parts = 150;
    return followed(from, parts);
  }
  PlanarOrbit followed(const Vector2d& from, int most_parts) const;
  double end_time_error(const Vector2d&) const override { return 1e-12; }
  std::optional<double> first_integral(const Vector2d& x) const override { return integral(x); }
  std::shared_ptr<const Solution> reversed() const override;

  const InverseFactor& found() const {
    if (!v) throw std::domain_error("FactorReduction: no inverse integrating factor was found");
    return *v;
  }

  /// Returns V at a point of the box, and the field at this point.
  std::pair<double, Vector2d> at(const Vector2d& x) const {
    const InverseFactor& fit = found();
    if (!holds_everywhere(fit.form()) && !(fit.box().inside(x).cwiseAbs().maxCoeff() <= 1)) {
      throw std::domain_error(
          fmt::format("FactorReduction: ({}, {}) is outside the box of V about ({}, {}), +-({}, {})", x[0], x[1],
                      start[0], start[1], fit.box().radii[0], fit.box().radii[1]));
    }
    const auto f = value_of(smooth.value, x);
    std::optional<Jet> of_form;
    if (fit.form() == FactorForm::basis) {
      of_form = jet_of(fitted, x);
    } else if (const auto g = cleared ? value_of(fitted.value, x) : f) {
      of_form = {*g, Eigen::Matrix2d::Zero()};
    }
    if (!f || !of_form) {
      throw std::domain_error(fmt::format("FactorReduction: the field has no value at ({}, {})", x[0], x[1]));
    }
    const double value = fit(x, *of_form)[0];
    return {cleared ? value * smooth.denominator(start)[0] / smooth.denominator(x)[0] : value, *f};
  }

  /// Returns the integral of dH along a straight line from the start.
  double integral(const Vector2d& to) const {
    const double sign = at(start).first;
    const Vector2d way = to - start;
    const auto rate = [&](double share) {
      const auto [here, f] = at(start + share * way);
      if (here * sign > 0) return cross(f, way) / here;
      throw std::domain_error("FactorReduction: V = 0 between the start and the point, where H is infinite");
    };
    using Rule = boost::math::quadrature::gauss_kronrod<double, 31>;
    constexpr unsigned halvings = 12;
    return Rule::integrate(rate, 0, 1, halvings, 1e-14);
  }
};

void FactorReduction::Solved::look_for_factor() {
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
    if (fit->small && fit->tried.gap >= large && holds_widely(fitted, *fit)) v = fit->factor;
  }
}

FactorReduction::FactorReduction(const SmoothField& field, const Vector2d& start) {
  const auto value = value_of(field.value, start);
  if (!start.allFinite() || !value) {
    throw std::domain_error(fmt::format("FactorReduction: the field has no value at ({}, {})", start[0], start[1]));
  }
  // V can vanish at an equilibrium, so the search begins beside an equilibrium.
  const Vector2d beside(1.25 * start[0], 0.8 * start[1]);
  auto solved = std::make_shared<Solved>(field, value->isZero(0) ? beside : start);
  solved->look_for_factor();
  if (!solved->v && field.denominator) {
    solved->fitted = with_cleared_denominator(field);
    solved->cleared = true;
    solved->look_for_factor();
  }
  if (solved->v) solved->form = name(solved->v->form());
  solved_ = std::move(solved);
}

std::string_view FactorReduction::form() const { return solved_->form; }
const std::vector<TriedForm>& FactorReduction::tried() const { return solved_->tried; }

std::shared_ptr<const PlanarReduction::Solution> FactorReduction::Solved::reversed() const {
  const auto back = [](const SmoothField& forth) {
    SmoothField turned = forth;
    turned.value = [f = forth.value](const Vector2d& x) -> Vector2d { return -f(x); };
    if (forth.jacobian) {
      turned.jacobian = [slopes = forth.jacobian](const Vector2d& x) -> Eigen::Matrix2d { return -slopes(x); };
    }
    return turned;
  };
  auto other = std::make_shared<Solved>(back(smooth), start);
  other->fitted = back(fitted);
  other->cleared = cleared;
  other->v = v;  // V of the reversed field is the same
  other->form = form;
  return other;
}

PlanarReduction FactorReduction::reduction() const {
  solved_->found();
  return PlanarReduction(solved_);
}

std::vector<FactorPiece> FactorReduction::Solved::factor_pieces(const Vector2d& low, const Vector2d& high) const {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const FactorForm shape = found().form();
  if (shape == FactorForm::constant || shape == FactorForm::product) return {};  // these forms have no zeros
  if (holds_everywhere(shape)) {
    return {{low, high, [solved = shared_from_this()](const Vector2d& x) {
               try {
                 return solved->at(x).first;
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
      pieces.push_back({from, to, [part = fit->factor](const Vector2d& x) { return part(x, {})[0]; }});
    } else if (halvings > 0) {
      for (int i = 0; i < 4; ++i) {
        const Vector2d part(i % 2, i / 2);
        const Vector2d corner = from + part.cwiseProduct(radii);
        add_part(add_part, corner, corner + radii, halvings - 1);
      }
    }
  };
  constexpr int most = 3;
  add(add, low, high, most);
  return pieces;
}

FactorFormula FactorReduction::formula() const {
  solved_->found();
  return recognised(solved_->fitted, solved_->start);
}

PlanarOrbit FactorReduction::Solved::followed(const Vector2d& from, int most_parts) const {
  if (!from.allFinite() || !value_of(smooth.value, from)) {
    throw std::domain_error(fmt::format("FactorReduction: the field has no value at ({}, {})", from[0], from[1]));
  }
  return PlanarOrbit(follow(smooth, fitted, found(), from, most_parts));
}

}  // namespace contensou::reduction
