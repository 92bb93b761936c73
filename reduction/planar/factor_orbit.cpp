// An orbit of f = (F, G) is a level line of H, dH = (F dv - G du)/V, computed part by part, planar.md (R60), (R61).
// There are no steps in time. A part is a curve w(s): one coordinate w as a function of the other, s, moved onto the
// level by Newton's method. The time is the integral of ds/F (ds/G if s is v).
#include "planar/inverse_factor.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <Eigen/LU>
#include <boost/math/quadrature/gauss_kronrod.hpp>

#include "contensou/reduction/detail/infinity.hpp"
#include "contensou/reduction/detail/root.hpp"
#include "numerics/decomposition.hpp"
#include "numerics/epsilon.hpp"
#include "numerics/legendre_series.hpp"
#include "planar/region.hpp"
#include "planar/reversal.hpp"

namespace contensou::reduction {

using Eigen::Matrix2d;
using Eigen::Vector2d;

namespace {

/// A motion along a level line of H.
struct FactorMotion final : PlanarOrbit::Motion {
  /// A part of the orbit, on which the coordinate `along` grows or falls.
  struct Panel {
    int along;            ///< index of the coordinate s: 0 for u, 1 for v
    double from, length;  ///< coordinate at the start of the part, and its change
    double begin;         ///< time at the start of the part
    LegendreSeries other, time;

    Vector2d at(double t) const {
      Vector2d x;
      x[along] = from + length * (1 + t) / 2;
      x[1 - along] = other(t);
      return x;
    }
  };

  FactorMotion(const Vector2d& from, double length) : start(from), unit(length) {
    end = PlanarEnd::undecided;
    end_time = std::numeric_limits<double>::quiet_NaN();
    border_time_known = true;
  }
  Vector2d at(double time) const override { return unit * in_units(time); }
  Vector2d at_end() const override { return unit * rest; }
  std::optional<double> period() const override {
    return end == PlanarEnd::periodic ? std::optional(turn_end) : std::nullopt;
  }
  Vector2d in_units(double time) const;
  Vector2d in_panels(double time) const;

  Vector2d start;
  double unit;  ///< length by which all coordinates of this motion are divided
  std::vector<Panel> panels = {};
  double followed = 0;                  ///< time up to which the orbit is computed
  double turn_begin = 0, turn_end = 0;  ///< times at the beginning and end of the last turn
  // Near an equilibrium the state at the time `followed` + t, t > 0, is rest + exp(t flow) offset.
  Vector2d rest = Vector2d::Zero(), offset = rest;
  Matrix2d flow = Matrix2d::Zero();
};

/// Returns the state at a time that the panels cover.
Vector2d FactorMotion::in_panels(double time) const {
  const Panel& panel = *std::prev(std::ranges::upper_bound(panels, time, {}, &Panel::begin));
  const double left = time - panel.begin;
  return panel.at(root_between([&](double t) { return panel.time(t) - left; }, -1, 1));
}

Vector2d FactorMotion::in_units(double time) const {
  if ((end == PlanarEnd::periodic || end == PlanarEnd::cycle) && time > turn_end) {
    time = turn_begin + std::fmod(time - turn_begin, turn_end - turn_begin);
  }
  if (time >= followed) {
    if (end == PlanarEnd::equilibrium) {
      const Vector2d away = matrix_exponential((time - followed) * flow) * offset;
      return away.allFinite() ? Vector2d(rest + away) : rest;
    }
    if (time > followed || panels.empty()) {
      throw std::domain_error(fmt::format("PlanarOrbit: the orbit was followed up to the time {}{}{}", followed,
                                          undecided.empty() ? "" : ": ", undecided));
    }
  }
  return in_panels(time);
}

/// Follows an orbit from part to part, and from one box, in which V is fitted, to the next.
// NOLINTNEXTLINE(clang-analyzer-optin.performance.Padding): one object exists for each orbit
class Follower {
  using Samples = LegendreSeries::Samples;
  using Panel = FactorMotion::Panel;

 public:
  Follower(const SmoothField& field, bool cleared, const InverseFactor& factor, FactorMotion& motion)
      : whole_(field),
        cleared_(cleared),
        motion_(motion),
        x_(motion.start),
        form_(factor.form()),
        box_(factor.box()),
        first_(jet_of(field, x_)),
        size_(x_.norm() + box_about(x_).radii.norm()),
        scale_(x_.cwiseAbs()),
        anchor_(x_),
        forward_(x_),
        passed_(x_) {
    const auto way = value_of(field.value, x_);
    if (const auto from_curve = onward(field, x_, size_)) {
      arrive(*from_curve);
    } else if (way) {
      enter_region(Region(whole_, x_, *way));
    }
    if (!region_ && way) enter_region(Region(whole_, x_, *way));
    first_ = jet_of(field_, x_);
    if (box_.centre == x_ && !(region_ && region_->slides())) {
      factor_ = factor;
      on_curve_ = factor.vanishes;
      unfitted_ = false;
    }
  }

  void follow(int most_work) {
    // The first look comes early only for an orbit that has gone far: the rest of another one may be asked for.
    constexpr int early = 100'000, usual = 500'000;
    constexpr double distant = 1e4;
    int next_anchor = 0, next_look = early;
    if (ended_) return;
    for (int i = 0; work_ < most_work; ++i) {
      const auto here = jet_of(field_, x_);
      if (!here) {
        if (ends_at_pole()) return;
        return stop("the field has no derivatives");
      }
      if (work_ >= next_look) {
        if ((work_ >= usual || x_.norm() > distant * size_) && leaves_for_ever()) return;
        next_look = next_look < usual ? usual : 2 * next_look;
      }
      if (i == next_anchor) {
        anchor(here->f);
        next_anchor = std::max(64, 2 * i);
      }
      noise_ = eps * (here->slopes.cwiseAbs() * x_.cwiseAbs() + region_->cancelled(x_));
      if (rests(*here) || escapes(*here)) return;
      if (at_border(*here, 4)) return end(PlanarEnd::border, motion_.followed);
      constexpr double edge = 0.7, near = 0.2, shortest = 256;
      if (region_->slides()) box_ = {x_, box_about(scale_ = scale_.cwiseMax(x_.cwiseAbs())).radii};
      const bool enters =
          !region_->slides() &&
          (unfitted_ || (i > 0 && (box_.inside(x_).cwiseAbs().maxCoeff() > edge || rest_in(*here, box_) < near)));
      const bool holds = !enters || enter(*here);
      unfitted_ &= !holds;
      if (!holds || !step(*here)) {
        // A switching function can have a kink where another one is 0. Parts of a slide end as near as rounding lets
        // them.
        if (const auto next = region_->slides() ? onward(whole_, x_, size_) : std::nullopt) {
          arrive(*next, false);
          if (ended_) return;
          continue;
        }
        if (at_border(*here, shortest)) return end(PlanarEnd::border, motion_.followed);
        if (leaves_for_ever() || ends_at_pole()) return;
        return stop(holds ? "the field is not smooth" : "the form of V does not hold");
      }
      if (ended_) return;
      if (on_curve_ && factor_) return_to_curve();
      if (returns()) return;
    }
    if (leaves_for_ever() || ends_at_pole()) return;
    stop(fmt::format("the orbit takes more than {} evaluations of the field; it comes", most_work));
  }

 private:
  /// Goes on in a region that begins at this point.
  void enter_region(Region region) {
    region_.emplace(std::move(region));
    field_ = region_->field();
    fitted_ = cleared_ && !region_->slides() ? with_cleared_denominator(field_) : field_;
    factor_.reset();
    unfitted_ = !region_->slides();  // no V is needed along a curve
    on_curve_ &= unfitted_;
    if (region_->slides()) slid_ = motion_.followed;
  }

  /// Goes on at a switching curve, or ends there.
  /// @param moved  true if the orbit has moved since the last curve
  void arrive(const Onward& next, bool moved = true) {
    x_ = next.x;
    still_ = moved ? 0 : still_ + 1;
    constexpr int most_at_a_point = 8;
    if (still_ > most_at_a_point) {
      ended_ = true;
      if (changes_in_rounding(x_, 0) || changes_in_rounding(x_, 1)) return end(PlanarEnd::border, motion_.followed);
      return stop("rounding hides which motion leaves a switching curve");
    }
    if (next.region) return enter_region(*next.region);
    ended_ = true;
    motion_.rest = next.x;
    if (next.rests) return end(PlanarEnd::rest, motion_.followed);
    if (next.ambiguous) return stop(fmt::format("{};", next.reason));
    end(PlanarEnd::border, motion_.followed);
  }

  void end(PlanarEnd kind, double time) {
    motion_.end = kind;
    motion_.end_time = time;
  }

  void stop(std::string_view reason) {
    const Vector2d at = motion_.unit * x_;
    constexpr double vast = 1e100;
    if (at.lpNorm<Eigen::Infinity>() > vast) reason = "formulas overflow";
    motion_.undecided = fmt::format("{} near ({:.6g}, {:.6g})", reason, at[0], at[1]);
  }

  /// Returns true if the orbit tends to a zero of the field, so near that the linear flow is exact except for rounding.
  bool rests(const Jet& here) {
    motion_.rest = x_;
    motion_.offset.setZero();
    if (here.f.isZero(0)) {
      end(PlanarEnd::equilibrium, motion_.followed);
      return true;
    }
    // The distance from the origin falls to the smallest numbers, while every part of the orbit takes longer.
    constexpr double tiny = 1e-30, longer = 0.01;
    if (!motion_.panels.empty() && x_.stableNorm() <= tiny * motion_.start.stableNorm() &&
        motion_.panels.back().time.at_end() > longer * motion_.followed) {
      motion_.rest.setZero();
      end(PlanarEnd::equilibrium, infinity);
      return true;
    }
    constexpr double close = 0.1;
    Vector2d rest;
    Matrix2d slopes;
    Vector2d left;
    constexpr double clear = 1e-10;
    const bool slides = region_->slides();
    const auto is_singular = [](const Matrix2d& matrix) {
      return std::abs(matrix.determinant()) <= clear * matrix.squaredNorm();
    };
    // Along a line of zeros, the way to rest is that of the flow.
    const auto finds_rest = [&](bool on_line) {
      const auto step_to_rest = [&](const Jet& at) {
        return on_line || is_singular(at.slopes) ? Vector2d(at.f / at.slopes.trace()) : newton_step(at);
      };
      rest = x_;
      Vector2d way = step_to_rest(here);
      if (!(way.norm() <= close * size_)) return false;
      constexpr int steps = 8;
      for (int i = 0; i == 0 || (i < steps && way.norm() > 4 * eps * rest.norm()); ++i) {
        rest = region_->on_curve(rest - way);
        const auto there = jet_of(field_, rest);
        if (!there) return false;
        slopes = there->slopes;
        left = there->f;
        way = step_to_rest(*there);
        if (!(way.norm() <= (x_ - rest).norm())) return false;
      }
      return true;
    };
    // Zeros of a sliding velocity always form a line: there the two fields are parallel. Those of other fields show as
    // a line at the zero.
    if (!finds_rest(slides)) return false;
    if (!slides && is_singular(slopes) && !is_singular(here.slopes) && !finds_rest(true)) return false;
    if (!region_->contains(rest)) return false;
    const Vector2d offset = x_ - rest;
    // Each component vanishes, also one that is tiny beside the other.
    constexpr double found = 1e-6, roundings = 8;
    if (!(left.cwiseAbs().array() <= (found * here.f.cwiseAbs() + roundings * noise_).array()).all()) return false;
    const double trace = slopes.trace(), determinant = slides ? 0 : slopes.determinant(), norm = slopes.norm();
    const bool saddle = determinant < -clear * norm * norm;
    // Components of the offset along the two eigenvectors of a saddle.
    const double root = std::sqrt(std::max(trace * trace / 4 - determinant, 0.)), in = trace / 2 - root,
                 out = trace / 2 + root;
    const Vector2d stable = (slopes * offset - out * offset) / (in - out), unstable = offset - stable;
    const bool on_line = on_curve_ || unstable.norm() <= 8 * eps * offset.norm();
    constexpr double hidden = 5e-5;
    const bool arrives = !motion_.panels.empty() && offset.dot(here.f) < 0;
    if (saddle && !on_line && arrives && offset.norm() < hidden * size_) {
      stop("rounding decides on which side the orbit passes a saddle; it comes");
      return true;
    }
    const double change = (here.slopes - slopes).norm() / norm;
    constexpr double exact = 1e-14;
    const double size = slides ? size_ : std::max(rest.norm(), offset.norm());
    if (!(change * offset.norm() <= exact * size)) return false;
    if (determinant > clear * norm * norm && trace < -clear * norm) {
      motion_.flow = slopes;
      motion_.offset = offset;
    } else if (saddle && on_line && offset.dot(here.f) < 0) {
      motion_.flow = in * Matrix2d::Identity();
      motion_.offset = stable;
    } else if (std::abs(determinant) <= clear * norm * norm && trace < -clear * norm) {
      motion_.flow = trace * Matrix2d::Identity();
      motion_.offset = offset;
    } else {
      return false;
    }
    if (!region_->keeps(rest, motion_.offset, motion_.flow)) return false;
    motion_.rest = rest;
    end(PlanarEnd::equilibrium, infinity);
    return true;
  }

  /// Returns true if the orbit goes to infinity; |x'| ~ |x|^p along the orbit.
  bool escapes(const Jet& here) {
    constexpr double farther = 1e12;
    const Vector2d direction = here.f.stableNormalized();  // the squares in norm() can overflow
    const double distance = x_.stableNorm(), growth = (x_ / distance).dot(here.f / distance);
    if (!(distance > far_ * size_) || !(growth > 0)) return false;

    const double power = direction.dot(here.slopes * direction) / growth;
    constexpr double above = 1.02, below = 1 + 1e-4;
    if (power > above) {
      const double left = 1 / (growth * (power - 1));
      if (!(left <= eps * motion_.followed)) return false;
      if (lost_) {
        stop("one coordinate was so small that rounding hides whether the orbit ends; it comes");
        return true;
      }
      end(PlanarEnd::infinity, motion_.followed + left);
      return true;
    }
    if (!(power < below) || distance < farther * size_) return false;
    end(PlanarEnd::infinity, infinity);
    return true;
  }

  /// Returns true if one coordinate, s, goes to infinity: its rate g depends on s alone, and the other
  /// coordinate w exists for every s, because its equation is linear or because w stays between two barriers. All
  /// conditions are tested at 1000 values of s, up to 1e12 times the present one.
  bool leaves_for_ever() {
    if (!whole_.jacobian || whole_.switches || motion_.panels.empty()) return false;
    return drifts() || std::ranges::any_of(std::array{0, 1}, [&](int along) { return leaves_along(along); });
  }

  static constexpr int far_points = 1000;
  static constexpr double decades_ = 12;

  /// Returns true if the field is affine, f = J x + b, and l . x grows at the constant rate l . b, where l J = 0.
  bool drifts() {
    const auto here = jet_of(whole_, x_);
    if (!here) return false;
    const Matrix2d& slopes = here->slopes;
    const double norm = slopes.norm();
    constexpr double singular = 1e-14, clear = 1e-6;
    if (!(std::abs(slopes.determinant()) <= singular * norm * norm)) return false;
    for (int i = 1; i <= far_points; ++i) {
      const Vector2d x = (2 * evenly_spread(i) - Vector2d(1, 1)) * std::pow(10, decades_ * (evenly_spread(i)[0] - 0.5));
      const auto there = jet_of(whole_, size_ * x);
      if (!there || !((there->slopes - slopes).norm() <= 4 * eps * norm)) return false;
    }
    const int row = slopes.col(0).norm() > slopes.col(1).norm() ? 0 : 1;
    const Vector2d left = Vector2d(-slopes(1, row), slopes(0, row)).normalized();
    if (!(std::abs(left.dot(here->f)) > clear * first_->f.norm())) return false;
    end(PlanarEnd::infinity, infinity);
    return true;
  }

  bool leaves_along(int along) {
    const int across = 1 - along;
    const double s0 = x_[along], w0 = x_[across];
    const double denominator = whole_.denominator ? whole_.denominator(x_)[0] : 1;
    const auto at = [&](double s, double w) {
      Vector2d x;
      x[along] = s;
      x[across] = w;
      auto jet = jet_of(whole_, x);
      if (jet && whole_.denominator && !(whole_.denominator(x)[0] * denominator > 0)) jet.reset();
      return jet;
    };
    const auto here = at(s0, w0);
    constexpr double away = 10;
    if (!here || !(s0 * here->f[along] > 0) || !(std::abs(s0) > away * size_)) return false;
    const double rate = here->f[along] / s0;

    bool linear = true, slow = true, fast = true;
    for (int i = 1; i <= far_points; ++i) {
      const Vector2d spread = evenly_spread(i);
      const double s = s0 * std::pow(10, decades_ * spread[0]);
      const auto there = at(s, w0);
      if (!there || there->slopes(along, across) != 0 || !(there->f[along] * s > 0)) return false;
      constexpr double at_most = 2, power = 0.02;
      const double growth = there->f[along] / s / rate;
      slow &= growth <= at_most;
      fast &= growth >= std::pow(s / s0, power);
      constexpr double rounding = 1e-13;
      const auto beside = at(s, 20 * (std::abs(w0) + size_) * (spread[1] - 0.5));
      if (beside && beside->slopes(along, across) != 0) return false;
      linear &= beside && std::abs(beside->slopes(across, across) - there->slopes(across, across)) <=
                              rounding * std::abs(there->slopes(across, across));
    }
    if (slow == fast) return false;

    struct Barrier {
      double level, power;  ///< w = level (s/s0)^power
      double operator()(double ratio) const { return level * std::pow(ratio, power); }
    };
    // Orbits cross a barrier on this side of w0 only towards w0, or the barrier is an orbit.
    const auto holds = [&](const Barrier& barrier, double side) {
      for (int i = 0; i <= far_points; ++i) {
        const double ratio = std::pow(10, decades_ * (i > 0 ? evenly_spread(i)[0] : 0));
        const double w = barrier(ratio), slope = barrier.power * w / (s0 * ratio);
        const auto there = at(s0 * ratio, w);
        if (!there) return false;
        const double excess = side * (here->f[along] > 0 ? 1 : -1) * (there->f[across] - slope * there->f[along]);
        if (!(excess < 0 || (there->f[across] == 0 && slope == 0))) return false;
      }
      return true;
    };
    const auto barrier_on = [&](double side) -> std::optional<Barrier> {
      if (side * w0 < 0 && holds({0, 0}, side)) return Barrier{0, 0};
      // An orbit that nears a line on which f vanishes: the line has a short number in the letters of the field.
      for (double unit = 1; unit > 1e-7; unit /= 10) {
        const double line = unit * std::round(motion_.unit * w0 / unit) / motion_.unit;
        if (side * (line - w0) > 0 && holds({line, 0}, side)) return Barrier{line, 0};
      }
      constexpr double least = 1e-6;
      constexpr int widths = 20;  // up to 1e18 times w0
      for (const double power : {0, 1, 2, 3}) {
        double width = least * (std::abs(w0) + least * size_);
        for (int i = 0; i < widths; ++i, width *= 16) {
          if (const Barrier barrier{w0 + side * width, power}; holds(barrier, side)) return barrier;
        }
      }
      return std::nullopt;
    };
    if (!linear) {
      const auto low = barrier_on(-1), high = low ? barrier_on(1) : std::nullopt;
      if (!high) return false;
      for (int i = 1; i <= far_points; ++i) {
        const auto [share, between] = std::pair(evenly_spread(i)[0], evenly_spread(i)[1]);
        const double ratio = std::pow(10, decades_ * share);
        if (!at(s0 * ratio, (*low)(ratio) + between * ((*high)(ratio) - (*low)(ratio)))) return false;
      }
    }
    double left = infinity;
    if (fast) {
      // The substitution s = s0/z turns the integral of ds/g into one over 0 < z < 1.
      const auto inverse = [&](double z) {
        const auto there = at(s0 / z, w0);
        return there ? s0 / (z * z * there->f[along]) : std::numeric_limits<double>::quiet_NaN();
      };
      constexpr double accurate = 1e-12;
      double error = infinity;
      left = boost::math::quadrature::gauss_kronrod<double, 31>::integrate(inverse, 0, 1, 12, accurate, &error);
      if (!(left > 0) || !(error <= accurate * (left + motion_.followed))) return false;
    }
    end(PlanarEnd::infinity, motion_.followed + left);
    motion_.limit[along] = std::copysign(infinity, s0);
    // Two barriers around w0, so near that they have the same digits, show the limit of w.
    constexpr double digits = 1e-9;
    const double near = digits * std::max(std::abs(w0), size_);
    if (holds({w0 - near, 0}, -1) && holds({w0 + near, 0}, 1)) {
      motion_.limit[across] = std::abs(w0) > near ? motion_.unit * w0 : 0;
    }
    return true;
  }

  /// Returns true at a pole or a border of the field, if the last part took only a few rounding errors of the time.
  bool at_border(const Jet& here, double roundings) const {
    constexpr double overflows = 1e100;
    const double rounding = roundings * eps * motion_.followed;
    if (motion_.panels.empty() || motion_.panels.back().time.at_end() > rounding) return false;
    if (!(x_.norm() <= far_ * size_) || !(here.slopes.norm() < overflows)) return false;
    constexpr double singular = 1e4, short_way = 0.01;
    const Vector2d way = rounding * here.f;
    if (!(way.norm() < short_way * size_)) return false;
    if (!value_of(field_.value, x_ + way)) return true;
    // At a pole the field changes by its own size within rounding, even if the orbit is smooth there: v' = -v tan u.
    if (here.slopes.norm() * way.norm() > here.f.norm()) return true;
    // A speed that grows only over a longer way is no pole: the orbit can go to infinity like a logarithm.
    const Vector2d direction = here.f.normalized();
    const double speed = here.f.norm(), growth = direction.dot(here.slopes * direction);
    return speed > singular * first_->f.norm() && speed < short_way * size_ * growth;
  }

  /// Returns true if the field changes by a part of itself within the last digit of a coordinate, as next to a pole.
  bool changes_in_rounding(const Vector2d& x, int i) const {
    constexpr double part = 0.01;
    const auto there = jet_of(field_, x);
    return there && there->slopes.col(i).norm() * eps * std::abs(x[i]) >= part * there->f.norm();
  }

  /// Ends the orbit at a pole of the field that it nears so slowly that rounding stops one coordinate before, as for
  /// y' = x/(2 - x) or y' = tan(x) y. What the panels say from there on is wrong.
  bool ends_at_pole() {
    constexpr std::size_t many = 100;
    const auto& panels = motion_.panels;
    for (int i = 0; i < 2; ++i) {
      std::size_t first = panels.size();
      while (first > 0 && panels[first - 1].at(-1)[i] == x_[i]) --first;
      if (panels.size() - first < many) continue;
      if (!changes_in_rounding(panels[first].at(-1), i)) continue;
      // The pole is the place of the largest speed ahead of a state that rounding does not reach.
      constexpr double clear = 1e-8, reach = 10;
      std::size_t k = first;
      while (k > 0 && std::abs(x_[i] - panels[k].at(-1)[i]) < clear * std::abs(x_[i])) --k;
      const Vector2d before = panels[k].at(-1);
      const auto from = jet_of(field_, before);
      if (!from || from->f[i] == 0) continue;
      const auto speed = [&](double way) {
        const auto f = value_of(field_.value, before + way * Vector2d::Unit(i));
        return f ? f->norm() : infinity;
      };
      double low = 0, high = std::copysign(reach * from->f.norm() / from->slopes.col(i).norm(), from->f[i]);
      for (int step = 0; step < 100; ++step) {
        const double left = low + (high - low) / 3, right = high - (high - low) / 3;
        (speed(left) < speed(right) ? low : high) = speed(left) < speed(right) ? left : right;
      }
      end(PlanarEnd::border, panels[k].begin + low / from->f[i]);
      return true;
    }
    return false;
  }

  /// Returns the estimated distance to an equilibrium in units of the box; infinity if no estimate is finite.
  static double rest_in(const Jet& here, const Box& box) {
    const double distance = newton_step(here).cwiseQuotient(box.radii).norm();
    return std::isfinite(distance) ? distance : infinity;
  }

  static Vector2d newton_step(const Jet& here) { return here.slopes.inverse() * here.f; }

  /// Fits V in a box about the current point.
  bool enter(const Jet& here) {
    scale_ = x_.cwiseAbs().cwiseMax(scale_ / 2);
    box_ = {x_, box_about(scale_).radii};
    // Near an equilibrium V is small. The box is made so small that the equilibrium lies outside the box.
    constexpr double part = 0.7;
    const double distance = rest_in(here, box_);
    box_.radii *= std::min(1., part * distance) * fraction_;
    for (int i = 0; i < 2; ++i) {
      const auto ends_have_values = [&] {
        const Vector2d side = box_.radii[i] * Vector2d::Unit(i);
        return value_of(field_.value, x_ + side) && value_of(field_.value, x_ - side);
      };
      while (!ends_have_values() && box_.radii[i] > eps * std::abs(x_[i])) box_.radii[i] /= 2;
    }
    const auto last = std::exchange(factor_, {});
    const auto of_form = holds_everywhere(form_) ? jet_of(fitted_, x_) : std::nullopt;
    const bool lasts = of_form && last && last->residual(x_, *of_form) <= accurate_;
    if (lasts && (distance > 1 || form_ == FactorForm::basis)) {
      factor_ = last;
      return true;
    }

    // In a region a field is analytic, so that V continues with its form: fitted once, a series need not be fitted
    // again. A V of few terms is fitted again, because it proves that orbits are closed.
    if (!unfitted_ && !on_curve_ && whole_.jacobian && form_ > FactorForm::polynomial && form_ < FactorForm::basis) {
      return true;
    }
    // If the rounding of x alone hides the form of V, do not fit V: the rest of the orbit does not need V.
    constexpr double hidden = 1e-12;
    if (noise_.norm() > hidden * here.f.norm()) return true;
    constexpr int halvings = 10;
    for (int i = 0; i <= halvings; ++i, box_.radii /= 2, fraction_ /= 2) {
      const auto samples = sample(fitted_, box_);
      if (!samples) continue;
      const auto fit = fit_factor(form_, *samples);
      // The singular values take as long as so many evaluations of the field.
      work_ += static_cast<int>(samples->points.size()) + (fit ? 3 * fit->factor.terms() * fit->factor.terms() : 0);
      if (!fit || !fit->small) continue;
      factor_ = fit->factor;
      on_curve_ = fit->factor.vanishes;
      constexpr double wide = 4;
      const bool global = form_ <= FactorForm::polynomial;
      fraction_ = std::min(global ? wide : 1, 2 * fraction_);
      return true;
    }
    if (lasts) factor_ = last;
    return lasts;
  }

  /// Adds one part (panel), as long as its series converge. Returns false if they do not.
  bool step(const Jet& here) {
    const Vector2d speed = here.f.cwiseQuotient(box_about(scale_).radii).cwiseAbs();
    const int along = speed[0] >= speed[1] ? 0 : 1;
    const double sense = here.f[along] > 0 ? 1 : -1;
    const double room = 1 - sense * box_.inside(x_)[along];
    double length = std::min(2 * stretch_, room) * box_.radii[along];
    for (; length > 64 * eps * std::abs(x_[along]) && length > least_length_ * size_; length /= 2) {
      const auto panel = solve(along, sense * length, here);
      if (!panel) continue;
      stretch_ = length / box_.radii[along];
      const auto inside = [&](double t) { return region_->contains(panel->at(t)); };
      const auto leaves = std::ranges::find_if_not(LegendreSeries::points(), inside);
      if (leaves == LegendreSeries::points().end() && inside(1)) {
        append(*panel);
        return true;
      }
      if (crosses_by_rounding(here)) {
        ended_ = true;
        stop("rounding hides whether the orbit comes to a switching curve or a pole; it comes");
        return true;
      }
      // Cut the panel where it leaves the region.
      const double before = leaves == LegendreSeries::points().begin() ? -1 : *std::prev(leaves);
      const double last = last_where(inside, before, leaves == LegendreSeries::points().end() ? 1 : *leaves);
      if (const auto part = last > -1 ? solve(along, sense * length * (1 + last) / 2, here) : std::nullopt) {
        append(*part);
      }
      arrive(region_->leave(x_, size_), last > -1);
      return true;
    }
    return false;
  }

  /// Returns true if the orbit stays so near a switching curve or a pole that the rounding of the state, which hides
  /// digits of the field, can move it across, as far out on y = 1 - x of y' = 1/(x + y - 2).
  bool crosses_by_rounding(const Jet& here) const {
    constexpr std::size_t some = 8;
    constexpr double near = 2e-10, nears = 2, hides = 1e-9;
    if (!whole_.switches || motion_.panels.size() < some || region_->slides()) return false;
    if (!(noise_.norm() > hides * here.f.norm())) return false;
    const Eigen::MatrixX3d now = whole_.switches(x_);
    const Eigen::MatrixX3d then = whole_.switches(motion_.panels[motion_.panels.size() - some].at(-1));
    for (Eigen::Index i = 0; i < now.rows(); ++i) {
      const double h = std::abs(now(i, 0));
      if (h < near * now.row(i).tail<2>().norm() * x_.norm() && std::abs(then(i, 0)) < nears * h) return true;
    }
    return false;
  }

  void append(const Panel& panel) {
    x_ = panel.at(1);
    motion_.followed += panel.time.at_end();
    // A coordinate below the accuracy of a panel (solve) has lost its digits, for a part of the motion that counts.
    constexpr double counts = 1e-3;
    const double least = x_.cwiseAbs().minCoeff();
    lost_ |= least > 0 && least < eps * small_ * x_.norm() && panel.time.at_end() > counts * motion_.followed;
    motion_.panels.push_back(panel);
  }

  /// Finds the coordinate w (across) at the points of a panel of s (along). q approximates dw/ds. Along w = w_0 +
  /// integral of q ds, H changes by the integral of (q - G/F) F/V ds, and dH/dw = F/V. Newton's method, planar.md
  /// (R60).
  std::optional<Panel> solve(int along, double length, const Jet& start) {
    const int across = 1 - along;
    // Along a switching curve the rounding of its function is that of the largest coordinates.
    const double half = length / 2,
                 size = region_->slides() ? scale_.norm() : std::abs(x_[across]) + small_ * x_.norm();
    const double noise = noise_[along] / std::abs(start.f[along]);
    const double noise_across = noise_[across] * std::abs(half / start.f[along]);  // noise of w
    const Samples s = x_[along] + half * (1 + LegendreSeries::points()), one = Samples::Ones();
    Samples q = Samples::Constant(start.f[across] / start.f[along]), slopes, rate, growth;
    double missed = infinity;
    constexpr int most = 12, first = 2;
    constexpr double coarse = 1e-6;
    for (int iteration = 0;; ++iteration) {
      const Samples w = x_[across] + half * LegendreSeries::through(q).antiderivative().samples();
      constexpr double edge = 1.05;
      const bool inside = ((w - box_.centre[across]).abs() <= edge * box_.radii[across]).all();
      if (iteration >= first && !inside) return std::nullopt;
      const bool linearised = missed > coarse * (size + std::abs(half * q[0]));
      work_ += LegendreSeries::order;
      for (int i = 0; i < LegendreSeries::order; ++i) {
        Vector2d x;
        x[along] = s[i];
        x[across] = w[i];
        std::optional<Jet> here;
        if (linearised) {
          here = jet_of(field_, x);
        } else if (const auto f = value_of(field_.value, x)) {
          here = {*f, Matrix2d::Zero()};
        }
        if (!here) return std::nullopt;
        rate[i] = 1 / here->f[along];
        slopes[i] = here->f[across] * rate[i];
        if (!(rate[i] * length > 0)) return std::nullopt;
        if (linearised) growth[i] = (here->slopes(across, across) - slopes[i] * here->slopes(along, across)) * rate[i];
      }
      const Samples defect = slopes - q;
      const double before = missed;
      missed = std::abs(half) * LegendreSeries::through(defect).antiderivative().samples().abs().maxCoeff();
      const double largest = std::abs(half) * slopes.abs().maxCoeff();
      q = slopes + growth * solve_linear_ode(one, -half * growth, half * defect, 0).samples();
      if (missed <= 4 * (eps * (size + largest) + noise_across + noise * largest)) break;
      if (iteration == most || (iteration > first && !(missed < before / 2))) return std::nullopt;
    }
    constexpr double accurate = 1e-14, timed = 1e-13, smooth = 1e-3, little = 1e-6, varied = 100;
    const double largest = std::abs(half) * q.abs().maxCoeff();
    // Poles that the orbit would pass smoothly show in ln V (growth) or as zeros of dt/ds (rate).

    const bool resolved = rate.abs().maxCoeff() <= varied * rate.abs().minCoeff() &&
                          LegendreSeries::tail(q) * std::abs(half) <=
                              accurate * (size + largest) + 8 * (noise_across + noise * largest) &&
                          LegendreSeries::tail(rate) <= std::max(timed, 8 * noise) * rate.abs().maxCoeff() &&
                          LegendreSeries::tail(growth) <= smooth * growth.abs().maxCoeff() + little / std::abs(half);
    if (!resolved) {
      return std::nullopt;
    }
    Panel panel{along,
                x_[along],
                length,
                motion_.followed,
                LegendreSeries::through(half * q).antiderivative(),
                LegendreSeries::through(half * rate).antiderivative()};
    panel.other += x_[across];
    return panel;
  }

  /// Moves the point onto the curve V = 0, along which the orbit runs.
  void return_to_curve() {
    const auto here = jet_of(fitted_, x_);
    if (!here) return;
    const InverseFactor::Value v = (*factor_)(x_, *here);

    const int across = 1 - motion_.panels.back().along;
    const double step = v[0] / v[1 + across];
    if (std::abs(v[0]) > factor_->error * factor_->size(x_, *here) && std::abs(step) <= near_ * x_.norm())
      x_[across] -= step;
  }

  /// Makes this point the anchor: from now on, a return of the orbit to this point is looked for.
  void anchor(const Vector2d& f) {
    anchor_ = passed_ = x_;
    forward_ = f;
    extent_ = along_ = 0;
    motion_.turn_end = motion_.followed;
  }

  /// Returns true if the orbit has returned to its position one turn ago.
  bool returns() {
    extent_ = std::max(extent_, (x_ - passed_).norm());
    const double before = std::exchange(along_, (x_ - anchor_).dot(forward_));
    if (!(before < 0 && along_ >= 0)) return false;
    const Panel& panel = motion_.panels.back();
    const double t = root_between([&](double at) { return (panel.at(at) - anchor_).dot(forward_); }, -1, 1);
    const Vector2d last = std::exchange(passed_, panel.at(t));
    const double extent = std::exchange(extent_, 0);
    motion_.turn_begin = std::exchange(motion_.turn_end, panel.begin + panel.time(t));
    if (!((passed_ - last).norm() <= near_ * extent)) return false;
    // Compare with the extent of the first turn: from beside a focus it is much smaller than the closed orbit.
    const double turn = motion_.turn_end - motion_.turn_begin;
    const auto from_start_after = [&](double time) { return (motion_.in_panels(time) - motion_.start).norm(); };
    const double missed = from_start_after(turn);
    double first_extent = 0;
    for (const double part : {0.2, 0.4, 0.6, 0.8}) first_extent = std::max(first_extent, from_start_after(part * turn));
    const bool from_start = missed <= near_ * first_extent;
    constexpr double doubtful = 1e-6;
    if (missed <= doubtful * first_extent && !(from_start && proves_return())) {
      stop("rounding hides whether the orbit returns or nears a closed one; it comes");
      return true;
    }
    if (from_start) motion_.turn_end -= std::exchange(motion_.turn_begin, 0);
    end(from_start ? PlanarEnd::periodic : PlanarEnd::cycle, infinity);
    return true;
  }

  /// Returns true if the orbit that has returned within rounding is closed. Either the equation of V holds up to
  /// rounding with a form of few terms, so that H is constant; or the orbit lies on a curve V = 0, which is closed; or
  /// a reversor maps the orbit onto itself, and the orbit meets its axis.
  bool proves_return() const {
    if (slid_ >= motion_.turn_begin) return true;  // orbits that slide become one
    const bool of_few_terms = form_ <= FactorForm::polynomial || form_ == FactorForm::basis;
    if (on_curve_ || (of_few_terms && whole_.jacobian)) return true;
    return std::ranges::any_of(maps_to_try, [this](const Reversor& reversor) {
      if (!is_reflection(reversor)) return false;
      int sides[2] = {0, 0};
      for (const Panel& panel : motion_.panels) {
        for (const double t : {-0.6, 0.1, 0.8}) {
          const Vector2d x = panel.at(t), away = x - reversor.matrix * x;
          ++sides[away[0] + away[1] * std::numbers::phi > 0 ? 1 : 0];
          if (!reverses(whole_, reversor.matrix, Vector2d::Zero(), x).value_or(false)) return false;
        }
      }
      return sides[0] > 0 && sides[1] > 0;
    });
  }

  static constexpr double near_ = 1e-11, accurate_ = 1e-8, far_ = 1e6, least_length_ = 1e-150, small_ = 1e-4;

  const SmoothField& whole_;
  bool cleared_;  ///< V is fitted for the product of the field and its denominator
  std::optional<Region> region_ = {};
  SmoothField field_ = {};   ///< the field of the region
  SmoothField fitted_ = {};  ///< the field of the region for which V is fitted
  bool unfitted_ = true;     ///< V is not fitted yet in this region
  FactorMotion& motion_;
  Vector2d x_;
  FactorForm form_;
  Box box_;
  std::optional<InverseFactor> factor_ = {};
  std::optional<Jet> first_ = {};       ///< jet at the start
  bool on_curve_ = false;               ///< the orbit runs along V = 0
  double size_;                         ///< distance of the start from the origin plus the radius of its box
  Vector2d scale_;                      ///< typical size of both coordinates
  Vector2d noise_ = Vector2d::Zero();   ///< errors of f by the rounding of x, and of the terms of a sliding velocity
  double fraction_ = 1;                 ///< radius of boxes divided by their largest allowed radius
  double stretch_ = 0.25;               ///< length of the last panel divided by the radius of its box
  Vector2d anchor_, forward_, passed_;  ///< returns are sought on the line through anchor_ normal to forward_
  double extent_ = 0, along_ = 0;
  bool lost_ = false;   ///< one coordinate was smaller than the errors of the panels
  int work_ = 0;        ///< evaluations of the field
  bool ended_ = false;  ///< the orbit ended at a switching curve
  double slid_ = -1;    ///< time at which the last slide began; -1 if none has begun
  int still_ = 0;       ///< number of borders met without a part between them
};

}  // namespace

std::shared_ptr<const PlanarOrbit::Motion> follow(const SmoothField& field, bool cleared, const InverseFactor& factor,
                                                  const Vector2d& start, double unit, int most_work) {
  auto motion = std::make_shared<FactorMotion>(start, unit);
  Follower(field, cleared, factor, *motion).follow(most_work);
  return motion;
}

}  // namespace contensou::reduction
