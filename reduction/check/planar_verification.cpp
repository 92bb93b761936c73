#include "contensou/reduction/verification.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include <Eigen/LU>

#include "contensou/reduction/detail/root.hpp"
#include "numerics/epsilon.hpp"
#include "planar/differences.hpp"
#include "planar/inverse_factor.hpp"
#include "planar/region.hpp"
#include "planar/reversal.hpp"

namespace contensou::reduction {

using Eigen::Matrix2d;
using Eigen::Vector2d;

namespace {

// Stated errors: ten times that of states and times by quadrature (PlanarReduction), of difference quotients, and of
// the misfit (R59) with which V is accepted, reduction/planar.md.
constexpr double quadrature_error = 1e-11;
constexpr double quotient_error = 1e-9;
constexpr double misfit_error = 1e-8;

/// The error that is largest in comparison with its limit.
struct WorstError {
  double measured = -1, allowed = 1;

  void see(double error, double limit) {
    if (!std::isfinite(limit) || std::isnan(measured) || error / limit <= measured / allowed) return;
    measured = error;
    allowed = limit;
  }
};

/// Returns the value of a computation; empty if a point or a time has none.
template <class Compute>
auto known(const Compute& compute) -> std::optional<decltype(compute())> {
  try {
    return compute();
  } catch (const std::domain_error&) {
    return std::nullopt;
  }
}

/// Returns the image of x under exp(s X).
Vector2d moved(const Generator& generator, double s, const Vector2d& x) {
  constexpr int terms = 24;
  Eigen::Matrix3d rate = Eigen::Matrix3d::Zero(), sum = Eigen::Matrix3d::Identity(), term = sum;
  rate.topLeftCorner<2, 2>() = s * generator.matrix;
  rate.topRightCorner<2, 1>() = s * generator.shift;
  for (int n = 1; n <= terms; ++n) sum += term = Eigen::Matrix3d(term * rate / n);
  return sum.topLeftCorner<2, 2>() * x + sum.topRightCorner<2, 1>();
}

/// Computes the checks of one motion.
class PlanarExamination {
 public:
  PlanarExamination(const PlanarReduction& plane, const PlanarSymmetries& found, const Vector2d& start)
      : plane_(plane),
        found_(found),
        start_(start),
        around_(sampled_about(plane.field(), start)),
        orbit_(plane.orbit(start)) {
    const SmoothField& field = plane.field();
    size_ = around_.lpNorm<Eigen::Infinity>();
    for (int i = 1; i <= points; ++i) {
      const Box box = box_about(around_);
      const Vector2d x = start_ + (evenly_spread(i) - Vector2d(0.5, 0.5)).cwiseProduct(box.radii);
      if (auto jet = jet_of(field, x)) jets_.emplace_back(x, std::move(*jet));
    }
    follow();
  }

  std::vector<Check> run() {
    if (plane_.solved()) {
      routes();
      first_integral();
      factor();
      canonical();
      time();
    }
    symmetries();
    motion();
    formulas();
    equilibria();
    return std::move(checks_);
  }

 private:
  static constexpr int points = 100;

  void add(std::string name, const WorstError& worst) {
    if (worst.measured < 0) return;  // the statement does not apply to this motion
    checks_.push_back({std::move(name), worst.measured, worst.allowed});
  }

  /// A state by quadrature (by steps if no quadrature solves the system), by steps, and by steps with a tenfold
  /// tolerance.
  struct Instant {
    double t;
    Vector2d x, stepped, coarse;
    double size;   ///< distance from the origin to which errors are relative
    double error;  ///< estimated error of the steps

    /// Errors of the quadrature and of the steps. Rounding that the motion amplifies does not fall with the tolerance.
    double allowed() const {
      constexpr double margin = 10;
      return quadrature_error * size + margin * error;
    }
  };

  static constexpr double tolerance = 1e-12;

  std::optional<Instant> instant(double t) const {
    return known([&] {
      const Vector2d x = orbit_.at(t), stepped = steps_.at(t), coarse = coarse_.at(t);
      if (!x.allFinite() || !stepped.allFinite() || !coarse.allFinite()) throw std::domain_error("no state");
      return Instant{
          t, x, stepped, coarse, std::max(start_.stableNorm(), stepped.stableNorm()), (coarse - stepped).norm()};
    });
  }

  /// Chooses the instants: up to three periods, up to 95 % of a finite end time, or else up to ten times |x|/|x'|.
  void follow() {
    constexpr double share = 0.95, periods = 3, usual = 10;
    double last = orbit_.period()                    ? periods * *orbit_.period()
                  : std::isfinite(orbit_.end_time()) ? share * orbit_.end_time()
                                                     : usual * size_ / plane_.field()(start_).norm();
    constexpr int halvings = 20;
    for (int i = 0; i < halvings && !instant(last); ++i) last /= 2;
    for (const double part : {0.02, 0.1, 0.25, 0.4, 0.55, 0.7, 0.85, 1.}) {
      auto there = instant(part * last);
      if (!there) continue;
      // Half way, the steps have at least the error of their tolerance. The motion amplifies this error.
      for (const Vector2d& way : {Vector2d(1, 0), Vector2d(0, 1)}) {
        const auto moved_by = known([&] {
          constexpr double aside = 1e-6;
          const Vector2d middle = steps_.at(there->t / 2);
          const PlanarOrbit beside = by_steps(plane_.field(), tolerance).orbit(middle + aside * there->size * way);
          return (beside.at(there->t / 2) - there->stepped).norm() / aside;
        });
        constexpr double most = 1e5;
        if (moved_by) there->error = std::max(there->error, tolerance * std::min(*moved_by, most * there->size));
      }
      instants_.push_back(*there);
    }
  }

  void routes() {
    WorstError worst;
    for (const Instant& at : instants_) worst.see((at.x - at.stepped).norm() / at.size, at.allowed() / at.size);
    add("state: quadrature against steps in time", worst);
  }

  /// The distance of states from the level line of H through the start.
  void first_integral() {
    constexpr int count = 60, least = 10, halvings = 12;
    WorstError by_steps, by_quadrature;
    double last = instants_.empty() ? 0 : std::min(instants_.back().t, steps_.first_slide());
    // H is known as far as V can be continued; a shorter part of the orbit may lie there.
    for (int half = 0; half < halvings && last > 0 && by_quadrature.measured < 0; ++half, last /= 2) {
      std::vector<Vector2d> path{start_}, exact = path;
      std::vector<Instant> passed;
      std::vector<double> aside{0};  // sum of the distances between chords and orbit, on which errors of V count
      for (int i = 1; i <= count; ++i) {
        const auto at = instant(last * i / count), middle = instant(last * (i - 0.5) / count);
        if (!at || !middle) break;
        aside.push_back(aside.back() + (middle->x - (exact.back() + at->x) / 2).norm());
        passed.push_back(*at);
        path.push_back(at->stepped);
        exact.push_back(at->x);
      }
      const auto see = [&](WorstError& worst, const std::vector<Vector2d>& states, bool stepped) {
        const std::vector<LevelPoint> levels = plane_.levels(states);
        const auto distance = [&](std::size_t i) {
          const auto f = value_of(plane_.field().value, states[i + 1]);
          return f ? std::abs((levels[i + 1].integral - levels[0].integral) * levels[i + 1].factor) / f->norm()
                   : std::numeric_limits<double>::quiet_NaN();
        };
        std::size_t known_points = 0;
        while (known_points < passed.size() && std::isfinite(distance(known_points))) ++known_points;
        for (std::size_t i = 0; i < known_points && known_points >= least; ++i) {
          const Instant& at = passed[i];
          worst.see(distance(i) / at.size,
                    quadrature_error + misfit_error * aside[i + 1] / at.size + (stepped ? at.error / at.size : 0));
        }
      };
      see(by_steps, path, true);
      see(by_quadrature, exact, false);
    }
    add("first integral H along steps in time", by_steps);
    add("first integral H along the quadrature", by_quadrature);

    if (plane_.scaling() != nullptr) return;
    // dH has no curl, so its integral around a closed curve is 0.
    constexpr double radius = 0.1;
    std::vector<Vector2d> circle;
    const Box box = box_about(around_);
    for (const double u : {1, -1}) {
      for (const double v : {u, -u}) circle.emplace_back(start_ + radius * box.radii.cwiseProduct(Vector2d(u, v)));
    }
    circle.push_back(circle.front());
    const std::vector<LevelPoint> levels = plane_.levels(circle);
    const double around = std::abs((levels.back().integral - levels.front().integral) * levels.front().factor);
    WorstError closed;
    if (std::isfinite(around)) {
      closed.see(around / (plane_.field()(circle[0]).norm() * radius * box.radii.norm()), misfit_error);
    }
    add("dH around a closed curve", closed);
  }

  /// f . grad V = V div f by difference quotients of V.
  void factor() {
    struct Misfit {
      double value, size, error;
    };
    std::vector<Misfit> misfits;
    double mean = 0;
    const Vector2d radii = box_about(around_).radii;
    for (const auto& sampled : jets_) {
      const Vector2d& x = sampled.first;  // clang 14: a lambda cannot capture a structured binding
      const Jet& jet = sampled.second;
      const auto slope_of_factor = [&](int i, double step) {
        const auto at = [&](double steps) { return plane_.factor(x + steps * step * Vector2d::Unit(i)); };
        return (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * step);
      };
      const auto misfit = known([&] {
        constexpr double step = 2e-3;
        Vector2d near, far;
        for (int i = 0; i < 2; ++i) {
          near[i] = slope_of_factor(i, step * radii[i]);
          far[i] = slope_of_factor(i, 2 * step * radii[i]);
        }
        const double v = plane_.factor(x);
        return Misfit{std::abs(jet.f.dot(near) - v * jet.slopes.trace()),
                      jet.f.cwiseAbs().dot(near.cwiseAbs()) + std::abs(v) * jet.slopes.cwiseAbs().sum() +
                          std::abs(v) * jet.f.cwiseQuotient(radii).lpNorm<1>(),
                      jet.f.cwiseAbs().dot((far - near).cwiseAbs())};
      });
      if (!misfit || !std::isfinite(misfit->value) || !std::isfinite(misfit->error)) continue;
      // Beside a kink or jump the quotients do not agree.
      if (misfit->error > 1e-3 * misfit->size) continue;
      misfits.push_back(*misfit);
      mean += misfit->size;
    }
    WorstError worst;
    mean /= static_cast<double>(std::max<std::size_t>(misfits.size(), 1));
    const double limit = plane_.scaling() != nullptr ? quotient_error : misfit_error;
    for (const auto& [value, size, error] : misfits) {
      if (size + mean > 0) worst.see(value / (size + mean), limit + error / (size + mean));
    }
    if (misfits.size() >= points / 4) add("V: f . grad V = V div f", worst);
  }

  void canonical() {
    if (plane_.scaling() == nullptr) return;
    WorstError worst;
    for (const auto& sampled : jets_) {
      const Vector2d& x = sampled.first;
      const auto back = known([&] {
        const auto [q, p, slope] = plane_.canonical(x);
        return plane_.point(q, p);
      });
      // The rounding of p and q moves the point by this error of its size.
      constexpr double roundings = 64;
      const double away = (x - plane_.centre()).norm(), p = back ? std::abs(plane_.canonical(x).p) : 0;
      if (back) worst.see((*back - x).norm() / away, roundings * eps * (1 + p + x.norm() / away));
    }
    add("canonical coordinates q and p, there and back", worst);
  }

  /// The end time or the period.
  void time() {
    const double time = period_or_end(orbit_);
    if (!std::isfinite(time) || !(time > 0) || instants_.empty()) return;
    const bool periodic = orbit_.period().has_value();
    if (periodic) {
      const Vector2d f = plane_.field()(start_);
      const auto returned = instant(time);
      WorstError closes, period;
      if (returned)
        closes.see((returned->stepped - start_).norm() / returned->size, returned->allowed() / returned->size);
      const auto by_steps = known([&] {
        constexpr double share = 1e-3;
        return root_between([&](double t) { return (steps_.at(t) - start_).dot(f); }, (1 - share) * time,
                            (1 + share) * time);
      });
      if (returned && by_steps) {
        period.see(std::abs(*by_steps / time - 1), quadrature_error + returned->error / (f.norm() * time));
      }
      add("steps in time return after a period", closes);
      add("period: quadrature against steps in time", period);
    }
    constexpr double doubtful = 1e-6;  // a larger stated error of the end time is a failure
    const double stated_error = plane_.end_time_error(start_, orbit_);
    // The time that is left from a later state. A change of the state by a part changes the time as from_beside shows.
    const auto left = [&](const Vector2d& x) { return known([&] { return period_or_end(plane_.orbit(x)); }); };
    const auto compare = [&](double passed, const Vector2d& x,
                             double error) -> std::optional<std::pair<double, double>> {
      constexpr double part = 1e-6;
      const auto rest = left(x), from_beside = left(x + part * x.norm() * Vector2d(0.6, 0.8));
      if (!rest || !from_beside || !std::isfinite(*from_beside)) return std::nullopt;
      const double change = std::abs(*from_beside - *rest) / part;
      const double other = *rest + (periodic ? 0 : passed);
      const double stated = std::min(doubtful, stated_error);
      return std::pair{std::abs(other / time - 1),
                       stated + quadrature_error * (1 + change / time) + error / x.norm() * change / time};
    };
    WorstError later, stepped;
    for (const double part : {0.3, 0.6}) {
      const auto at = instant(part * time);
      if (!at) continue;
      if (const auto found = compare(part * time, at->x, 0)) later.see(found->first, found->second);
      if (const auto found = compare(part * time, at->stepped, at->error)) stepped.see(found->first, found->second);
    }
    const std::string name = periodic ? "period" : "end time";
    add(name + " from later states by quadrature", later);
    add(name + " from later states by steps", stepped);
  }

  void symmetries() {
    WorstError fields, orbits;
    for (const Generator& x : found_.generators) {
      if (!x.everywhere) continue;
      constexpr double s = 0.1;
      const double level = found_.scaling ? std::max(found_.residual, found_.level) : found_.level;
      const double growth = std::exp(x.time * s);
      for (const auto& [at, jet] : jets_) {
        // exp(s X) takes f at x to f at its image, and multiplies times by exp(c s).
        const auto there = value_of(plane_.field().value, moved(x, s, at));
        if (!there) continue;
        const Vector2d image = (moved(x, s, jet.f) - moved(x, s, Vector2d::Zero())) / growth;
        const double rounding = 64 * eps * (1 + jet.slopes.norm() * at.norm() / jet.f.norm());
        fields.see((*there - image).norm() / image.norm(),
                   rounding + level * (1 + jet.slopes.norm() * at.norm() / jet.f.norm()));
      }
      const Vector2d from = moved(x, s, start_);
      const auto fine = known([&] { return by_steps(plane_.field(), tolerance).orbit(from); });
      const auto coarse = known([&] { return by_steps(plane_.field(), 10 * tolerance).orbit(from); });
      if (!fine || !coarse) continue;
      for (const Instant& at : instants_) {
        const auto compared = known([&] {
          const double t = growth * at.t;
          return std::pair<Vector2d, Vector2d>(fine->at(t), coarse->at(t));
        });
        if (!compared) continue;
        const double size = std::max(from.norm(), compared->first.norm());
        const double error = (compared->second - compared->first).norm();
        // Steps amplify their tolerance like an error of the generator.
        orbits.see((moved(x, s, at.x) - compared->first).norm() / size,
                   quadrature_error + level + (at.error + error) * (1 + level / tolerance) / size);
      }
    }
    add("symmetry: field to field", fields);
    add("symmetry: orbit to orbit, the other by steps", orbits);
  }

  /// The orbit as a solution of the equations, its second half, and the way back.
  void motion() {
    WorstError equations, halves, back;
    const auto reversed = known([&] { return plane_.reversed(); });
    for (const Instant& at : instants_) {
      const double speed = plane_.field()(at.x).norm();
      const auto derivative = [&](double step) {
        const auto x = [&](double steps) { return orbit_.at(at.t + steps * step); };
        return Vector2d((8 * (x(1) - x(-1)) - (x(2) - x(-2))) / (12 * step));
      };
      const double step = 1e-2 * std::min(at.x.norm() / speed, at.t);
      const auto rates = known([&] { return std::pair(derivative(step), derivative(step / 2)); });
      const auto here = jet_of(plane_.field(), at.x);
      // Along a switching curve the motion has Filippov's velocity.
      if (rates && here && speed > 0 && !onward(plane_.field(), at.x, at.size)) {
        // The error of the state changes the quotient, and the field at the state.
        const double error = (rates->first - rates->second).norm() / speed +
                             quadrature_error * at.size / speed * (1 / step + here->slopes.norm());
        constexpr double smooth = 1e-3;
        if (error < smooth)
          equations.see((rates->second - plane_.field()(at.x)).norm() / speed, quotient_error + error);
      }
    }
    // Orbits from two changed states show how errors of the state grow. If they disagree, the errors are not small.
    const auto compare = [&](WorstError& worst, const PlanarReduction& plane, const Vector2d& x, double t,
                             const Vector2d& end, const Instant& at) {
      const double size = std::max({at.size, x.norm(), end.norm()});
      const auto beside = [&](double part) { return Vector2d(x + part * size * Vector2d(0.6, 0.8)); };
      const auto after = [&](double part) { return plane.part_of_orbit(beside(part)).at(t); };
      constexpr double near = 1e-8, far = 1e-6, most = 1e4, alike = 2;
      // Nearer to a zero of the field than that, the changed states say nothing of this one.
      const Vector2d f = plane.field()(x);
      if (!((plane.field()(beside(far)) - f).norm() <= f.norm() / 2)) return;
      const auto found = known([&] {
        const Vector2d there = after(0);
        return std::array{(there - end).norm() / size, (after(near) - there).norm() / (near * size),
                          (after(far) - there).norm() / (far * size)};
      });
      if (!found) return;
      const auto [error, amplified, again] = *found;
      if (!(std::max(amplified, again) < most) || amplified > alike * again || again > alike * amplified) return;
      worst.see(error, (quadrature_error + (plane.solved() ? 0 : 2 * at.error / size)) * (1 + amplified));
    };
    for (const Instant& at : instants_) {
      if (&at != &instants_[instants_.size() / 2] && &at != &instants_.back()) continue;
      if (const auto middle = known([&] { return orbit_.at(at.t / 2); }))
        compare(halves, plane_, *middle, at.t / 2, at.x, at);
      // Backwards, rounding grows as neighbouring orbits forwards come nearer.
      const auto nearer = known([&] {
        constexpr double part = 1e-6;
        const Vector2d f = plane_.field()(start_), there = plane_.field()(at.x);
        const Vector2d beside = start_ + part * at.size * Vector2d(-f[1], f[0]).normalized();
        return std::abs(cross(there.normalized(), plane_.part_of_orbit(beside).at(at.t) - at.x)) / (part * at.size);
      });
      constexpr double least = 1e-4;
      const bool joined = at.t > steps_.first_slide();  // with others, so backwards the motion is not unique
      if (reversed && !joined && nearer && *nearer > least) compare(back, *reversed, at.x, at.t, start_, at);
    }
    if (orbit_.end() == PlanarEnd::rest && steps_.end() == PlanarEnd::rest && coarse_.end() == PlanarEnd::rest) {
      constexpr double margin = 10;
      const double time = steps_.end_time(), error = std::abs(coarse_.end_time() / time - 1);
      WorstError rest;
      rest.see(plane_.solved() ? std::abs(orbit_.end_time() / time - 1) : error,
               plane_.solved() ? quadrature_error + margin * error : quotient_error);
      add(plane_.solved() ? "time of rest: quadrature against steps" : "time of rest: steps with two tolerances", rest);
    }
    add("derivative of the orbit against the equations", equations);
    add("second half of the orbit from its middle", halves);
    add("motion backwards returns to the start", back);
  }

  void formulas() {
    WorstError slopes;
    const SmoothField& field = plane_.field();
    if (field.jacobian) {
      for (const auto& [x, jet] : jets_) {
        for (int i = 0; i < 2; ++i) {
          const auto found = slope([&](const Vector2d& at) { return value_of(field.value, at); }, x, i,
                                   std::max(std::abs(x[i]), size_ / 8) / 32);
          const double scale = jet.slopes.norm() + jet.f.norm() / size_;
          if (found && found->error < 1e-6 * scale) {
            slopes.see((found->value - jet.slopes.col(i)).norm() / scale, 4 * found->error / scale + quadrature_error);
          }
        }
      }
    }
    add("derivatives of the formulas against differences", slopes);
  }

  void equilibria() {
    WorstError zeros, reversors;
    const Equilibria found = find_equilibria(plane_.field(), around_);
    for (const Equilibrium& each : found.points) {
      const auto f = value_of(plane_.field().value, each.x);
      const double norm = each.slopes.norm(), determinant = std::abs(each.slopes.determinant());
      constexpr double clear = 1e-6;
      if (!f || !each.eigenvalues || !(determinant > clear * norm * norm) || jets_.empty()) continue;
      if (norm < clear * jets_.front().second.slopes.norm()) continue;  // the slopes are 0 within rounding
      // A step of Newton's method moves the zero by rounding alone.
      constexpr double rounding = 256 * eps;
      const double size = std::max(each.x.norm(), size_);
      zeros.see((each.slopes.inverse() * *f).norm() / size, rounding * norm * norm / determinant);
    }
    add("equilibria are zeros of the equations", zeros);
    for (const Reversor& reversor : found.reversors) {
      for (const auto& [x, jet] : jets_) {
        const auto there = value_of(plane_.field().value, reversor.matrix * x);
        if (!there) continue;
        constexpr double roundings = 128;
        const double limit = roundings * eps * (1 + jet.slopes.norm() * x.norm() / jet.f.norm());
        reversors.see((*there + reversor.matrix * jet.f).norm() / jet.f.norm(), limit);
      }
    }
    add("reversors turn the equations round", reversors);
  }

  const PlanarReduction& plane_;
  const PlanarSymmetries& found_;
  Vector2d start_, around_;
  double size_ = 1;
  PlanarOrbit orbit_;
  PlanarOrbit steps_ = by_steps(plane_.field(), tolerance).orbit(start_);
  PlanarOrbit coarse_ = by_steps(plane_.field(), 10 * tolerance).orbit(start_);
  std::vector<std::pair<Vector2d, Jet>> jets_ = {};
  std::vector<Instant> instants_ = {};
  std::vector<Check> checks_ = {};
};

}  // namespace

std::vector<Check> verify(const PlanarReduction& plane, const PlanarSymmetries& found, const Vector2d& start) {
  const auto f = value_of(plane.field().value, start);
  if (!f || f->isZero(0)) throw std::domain_error("verify: the start is no motion, it rests or has no value");
  return PlanarExamination(plane, found, start).run();
}

}  // namespace contensou::reduction
