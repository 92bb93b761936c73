#include "contensou/reduction/integrating_factor.hpp"

#include <algorithm>
#include <array>

#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "numerics/legendre_series.hpp"
#include "planar/factor_formula.hpp"
#include "planar/factor_orbit.hpp"
#include "planar/solution.hpp"

namespace contensou::reduction {

using Eigen::Vector2d;

namespace {

/// True unless V fails in wider boxes: in any box that is small a smooth V is near to a polynomial.
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

struct FactorReduction::Solved {
  SmoothField field;
  SmoothField fitted;  ///< field for which the factor has its form: the field, or the field times its denominator
  Vector2d start;
  bool cleared = false;
  std::vector<TriedForm> tried = {};
  std::optional<InverseFactor> factor = {};

  void look_for_factor();

  const InverseFactor& found() const {
    if (!factor) throw std::domain_error("FactorReduction: no inverse integrating factor was found");
    return *factor;
  }

  /// V at a point of the box; the field there.
  std::pair<double, Vector2d> at(const Vector2d& x) const {
    const InverseFactor& v = found();
    if (!holds_everywhere(v.form()) && !(v.box().inside(x).cwiseAbs().maxCoeff() <= 1)) {
      throw std::domain_error(
          fmt::format("FactorReduction: ({}, {}) is outside the box of V about ({}, {}), +-({}, {})", x[0], x[1],
                      start[0], start[1], v.box().radii[0], v.box().radii[1]));
    }
    const auto f = value_of(field, x);
    std::optional<Jet> of_form;
    if (v.form() == FactorForm::basis) {
      of_form = jet_of(fitted, x);
    } else if (const auto g = cleared ? value_of(fitted, x) : f) {
      of_form = {*g, Eigen::Matrix2d::Zero()};
    }
    if (!f || !of_form) {
      throw std::domain_error(fmt::format("FactorReduction: the field has no value at ({}, {})", x[0], x[1]));
    }
    const double value = v(x, *of_form)[0];
    return {cleared ? value * field.denominator(start)[0] / field.denominator(x)[0] : value, *f};
  }

  /// Integral of dH along a straight line.
  double integral(const Vector2d& from, const Vector2d& to, double sign, int depth) const {
    const Vector2d way = to - from;
    LegendreSeries::Samples samples;
    for (int i = 0; i < LegendreSeries::order; ++i) {
      const auto [v, f] = at(from + (1 + LegendreSeries::points()[i]) / 2 * way);
      if (!(v * sign > 0)) {
        throw std::domain_error("FactorReduction: V = 0 between the start and the point, where H is infinite");
      }
      samples[i] = (f[0] * way[1] - f[1] * way[0]) / v / 2;
    }
    constexpr double accurate = 1e-14;
    if (depth == 0 || LegendreSeries::tail(samples) <= accurate * samples.abs().maxCoeff()) {
      return LegendreSeries::through(samples).antiderivative().at_end();
    }
    const Vector2d middle = from + way / 2;
    return integral(from, middle, sign, depth - 1) + integral(middle, to, sign, depth - 1);
  }
};

void FactorReduction::Solved::look_for_factor() {
  Box box = box_about(start);
  std::optional<FieldSamples> samples;
  // A small box would prove nothing: every smooth V is a polynomial there.
  constexpr int halvings = 4;
  for (int i = 0; i <= halvings && !samples; ++i, box.radii /= 2) samples = sample(fitted, box);
  constexpr double large = 1e4;
  const int first = fitted.basis.values ? factor_forms : 0, end = fitted.basis.values ? first + 1 : factor_forms;
  for (int i = first; samples && i < end && !factor; ++i) {
    const auto fit = fit_factor(static_cast<FactorForm>(i), *samples);
    if (!fit) continue;
    tried.push_back(fit->tried);
    tried.back().cleared = cleared;
    if (fit->small && fit->tried.gap >= large && holds_widely(fitted, *fit)) factor = fit->factor;
  }
}

FactorReduction::FactorReduction(SmoothField field, const Vector2d& start) {
  if (!start.allFinite() || !value_of(field, start)) {
    throw std::domain_error(fmt::format("FactorReduction: the field has no value at ({}, {})", start[0], start[1]));
  }
  auto solved = std::make_shared<Solved>(Solved{field, field, start});
  solved->look_for_factor();
  if (!solved->factor && field.denominator) {
    solved->fitted = with_cleared_denominator(field);
    solved->cleared = true;
    solved->look_for_factor();
  }
  solved_ = std::move(solved);
}

std::string_view FactorReduction::form() const { return solved_->factor ? name(solved_->factor->form()) : ""; }
const std::vector<TriedForm>& FactorReduction::tried() const { return solved_->tried; }
double FactorReduction::factor(const Vector2d& x) const { return solved_->at(x).first; }

double FactorReduction::first_integral(const Vector2d& x) const {
  constexpr int halvings = 12;
  return solved_->integral(solved_->start, x, solved_->at(solved_->start).first, halvings);
}

namespace {

struct FactorMotion final : PlanarOrbit::Motion {
  explicit FactorMotion(FactorOrbit of) : orbit(std::move(of)) {
    end = orbit.end();
    end_time = orbit.end_time();
    undecided = orbit.undecided();
    border_time_known = true;
  }
  Vector2d at(double time) const override { return orbit.at(time); }
  Vector2d at_end() const override { return orbit.at(end_time); }
  std::optional<double> period() const override { return orbit.period(); }

  FactorOrbit orbit;
};

struct FactorSolution final : PlanarReduction::Solution {
  FactorSolution(PlanarField of, FactorReduction by) : Solution(std::move(of), by.form()), reduction(std::move(by)) {}

  double factor(const Vector2d& x) const override { return reduction.factor(x); }
  std::vector<FactorPiece> factor_pieces(const Vector2d& low, const Vector2d& high) const override {
    return reduction.factor_pieces(low, high);
  }
  double end_time_error(const Vector2d&) const override { return 1e-12; }
  std::shared_ptr<const PlanarOrbit::Motion> orbit(const Vector2d& start) const override {
    return std::make_shared<const FactorMotion>(reduction.orbit(start));
  }
  std::shared_ptr<const PlanarOrbit::Motion> part_of_orbit(const Vector2d& start) const override {
    return std::make_shared<const FactorMotion>(reduction.orbit(start, FactorReduction::parts_of_a_picture));
  }
  std::optional<double> first_integral(const Vector2d& x) const override { return reduction.first_integral(x); }
  std::shared_ptr<const Solution> reversed() const override {
    return std::make_shared<const FactorSolution>(reversed_field(), reduction.reversed());
  }

  FactorReduction reduction;
};

}  // namespace

FactorReduction FactorReduction::reversed() const {
  const auto back = [](const SmoothField& forth) {
    SmoothField field = forth;
    field.value = [f = forth.value](const Vector2d& x) -> Vector2d { return -f(x); };
    if (forth.jacobian) {
      field.jacobian = [slopes = forth.jacobian](const Vector2d& x) -> Eigen::Matrix2d { return -slopes(x); };
    }
    return field;
  };
  FactorReduction other = *this;
  auto solved = std::make_shared<Solved>(*solved_);
  solved->field = back(solved->field);  // V is the same
  solved->fitted = back(solved->fitted);
  other.solved_ = std::move(solved);
  return other;
}

PlanarReduction FactorReduction::reduction() const {
  solved_->found();
  return PlanarReduction(std::make_shared<const FactorSolution>(solved_->field.value, *this));
}

std::vector<FactorPiece> FactorReduction::factor_pieces(const Vector2d& low, const Vector2d& high) const {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const FactorForm form = solved_->found().form();
  if (form == FactorForm::constant || form == FactorForm::product) return {};  // without zeros
  if (holds_everywhere(form)) {
    return {{low, high, [solved = solved_](const Vector2d& x) {
               try {
                 return solved->at(x).first;
               } catch (const std::domain_error&) {
                 return none;
               }
             }}};
  }
  std::vector<FactorPiece> pieces;
  const auto add = [&](const auto& add_part, const Vector2d& from, const Vector2d& to, int halvings) -> void {
    // A middle beside equilibria, which lie in the middle of many rectangles.
    constexpr double aside = 0.03;
    const Vector2d radii = (to - from) / 2;
    const Vector2d middle = from + radii + aside * Vector2d(radii[0], -radii[1] / 2);
    const auto samples = sample(solved_->fitted, {middle, (1 + aside) * radii});
    const auto fit = samples ? fit_factor(form, *samples) : std::nullopt;
    if (fit && fit->small) {
      if (!fit->unique) return;
      pieces.push_back({from, to, [v = fit->factor](const Vector2d& x) { return v(x, {})[0]; }});
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

FactorOrbit FactorReduction::orbit(const Vector2d& start, int most_parts) const {
  if (!start.allFinite() || !value_of(solved_->field, start)) {
    throw std::domain_error(fmt::format("FactorReduction: the field has no value at ({}, {})", start[0], start[1]));
  }
  return FactorOrbit(follow(solved_->field, solved_->fitted, solved_->found(), start, most_parts));
}

}  // namespace contensou::reduction
