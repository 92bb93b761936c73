// Limit cycles, and separatrices of equilibria whose eigenvalues are both 0: orbits by steps about a point.
//
// Limit cycles. A closed orbit turns about equilibria whose indices have the sum 1. Therefore it crosses a ray from one
// of them. The return map of the ray moves the place s, at which an orbit crosses the ray, to the place P(s) after one
// turn. A fixed point with a change of sign of ln P(s)/s is a limit cycle: stable if the sign changes from + to -.
//
// The map of the reversed motion, P^-1, replaces P for an orbit that does not return. P contracts towards a stable
// cycle and P^-1 towards an unstable one, so Newton's or any other method for roots meets no growth of errors.
//
// Multiplier. Let d be the distance of a neighbouring orbit across the motion. The rate of |f| d is div f |f| d
// (Liouville). Where f jumps from f- to f+ on a curve with the normal n, d f is multiplied by (n . f+)/(n . f-),
// because both orbits cross the curve along its tangent. The product over a turn is P'(s) at the fixed point. The slope
// of the map by differences is the second source.
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <boost/math/quadrature/gauss_kronrod.hpp>

#include "contensou/reduction/detail/root.hpp"
#include "contensou/reduction/planar_reduction.hpp"
#include "planar/inverse_factor.hpp"
#include "planar/region.hpp"

namespace contensou::reduction {

using Eigen::Vector2d;
using std::numbers::pi;

namespace {

constexpr double rough = 1e-9;  ///< tolerance of the orbits that only show where cycles are

/// The way of an orbit about a point, in steps in which neither its direction from the point nor its distance changes
/// much. Lengths are divided by half axes of an ellipse about the point.
class Winding {
 public:
  /// @param widest  largest change of the angle, and of the logarithm of the distance, in a step
  /// @param step    time of the first step that is tried
  /// @param least   shortest step towards a time at which the orbit has no state
  Winding(PlanarOrbit orbit, const Vector2d& start, const Vector2d& centre, const Vector2d& half, double widest,
          double step, double least = 0)
      : orbit_(std::move(orbit)),
        centre_(centre),
        half_(half),
        widest_(widest),
        step_(step),
        least_(least),
        here_(scaled(start)) {}

  /// Goes on by a step. Returns false if there is no step.
  bool advance() {
    for (; time_ + step_ > time_; step_ /= 2) {
      const Vector2d next = state(time_ + step_);
      if (!next.allFinite() && step_ < least_) return false;
      const double turned = std::atan2(cross(here_, next), here_.dot(next));
      const double grown = std::log(next.norm() / here_.norm());
      if (!(std::abs(turned) < widest_ && std::abs(grown) < widest_)) continue;
      before_ = time_;
      time_ += step_;
      angle_ += turned;
      moved_ = (next - here_).norm();
      here_ = next;
      if (std::abs(turned) < widest_ / 3 && std::abs(grown) < widest_ / 3) step_ *= 1.5;
      return true;
    }
    return false;
  }

  const PlanarOrbit& orbit() const { return orbit_; }
  Vector2d scaled(const Vector2d& x) const { return (x - centre_).cwiseQuotient(half_); }
  const Vector2d& here() const { return here_; }  ///< place after the last step, from the point
  double angle() const { return angle_; }         ///< by which the direction has turned from the start on
  double moved() const { return moved_; }         ///< length of the last step
  double before() const { return before_; }       ///< time before the last step
  double time() const { return time_; }
  double step() const { return step_; }

 private:
  /// Returns the scaled state at a time; NaN if the orbit has none.
  Vector2d state(double time) const {
    try {
      return scaled(orbit_.at(time));
    } catch (const std::domain_error&) {
      return Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
    }
  }

  PlanarOrbit orbit_;
  Vector2d centre_, half_;
  double widest_, step_, least_;
  Vector2d here_;
  double angle_ = 0, moved_ = 0, before_ = 0, time_ = 0;
};

/// Returns the field with a limited number of values; after that many, it throws.
SmoothField limited(const SmoothField& field, const std::shared_ptr<int>& left) {
  SmoothField result = field;
  result.value = [value = field.value, left](const Vector2d& x) {
    if (--*left < 0) throw std::domain_error("the search for limit cycles has taken too many values of the field");
    return value(x);
  };
  if (field.branch) {
    result.branch = [branch = field.branch, left](const Vector2d& x) { return limited(branch(x), left); };
  }
  return result;
}

/// One turn of an orbit about a point, from a ray to the ray.
struct Turn {
  double place;  ///< place on the ray at the end
  PlanarOrbit orbit;
  std::vector<double> times;  ///< times between which the orbit turns by a small angle; the last is that of the turn
};

/// The return map of a ray.
class ReturnMap {
 public:
  /// @param half  unit of lengths along both coordinates
  /// @param way   direction of the ray, in this unit
  ReturnMap(const SmoothField& field, const Vector2d& centre, const Vector2d& half, const Vector2d& way,
            double tolerance)
      : forth_(by_steps(field, tolerance)),
        back_(by_steps(backward(field), tolerance)),
        centre_(centre),
        half_(half),
        way_(way) {}

  Vector2d point(double place) const { return centre_ + place * half_.cwiseProduct(way_); }

  /// Returns the turn that begins at a place on the ray; empty if the orbit does not turn.
  std::optional<Turn> turn(double place, bool back) const;

  /// Returns ln P(s)/s, or -ln P^-1(s)/s from the reversed motion; NaN if the orbit does not turn.
  double growth(double place, bool back) const {
    const auto made = turn(place, back);
    const double grown = made ? std::log(made->place / place) : std::numeric_limits<double>::quiet_NaN();
    return back ? -grown : grown;
  }
  /// Returns ln P(s)/s of the motion that turns; NaN if neither does.
  /// @param back  the direction of time that is tried first
  double growth_either_way(double place, bool back = false) const {
    const double grown = growth(place, back);
    return std::isfinite(grown) ? grown : growth(place, !back);
  }

 private:
  PlanarReduction forth_, back_;
  Vector2d centre_, half_, way_;
};

std::optional<Turn> ReturnMap::turn(double place, bool back) const {
  constexpr int most = 500;
  constexpr double widest = 0.6, least = 1e-4, far = 1e3, still = 1e-6, long_time = 1e3, first = 0.1;
  try {
    const PlanarReduction& system = back ? back_ : forth_;
    const Vector2d start = point(place);
    const double speed = system.field()(start).cwiseQuotient(half_).norm(), unit = place / speed;
    if (!(speed > 0)) return std::nullopt;
    Turn turn{place, system.part_of_orbit(start), {0}};
    Winding winding(turn.orbit, start, centre_, half_, widest, first * unit, still * unit);
    // An orbit that turns about another point goes to and fro as seen from this one.
    constexpr int idle = 40;
    int last_progress = 0;
    double turned = 0;
    for (int i = 0; i < most && i - last_progress < idle && winding.advance(); ++i) {
      if (std::abs(winding.angle()) > turned) {
        turned = std::abs(winding.angle());
        last_progress = i;
      }
      if (std::abs(winding.angle()) >= 2 * pi) {
        const auto across = [&](double t) { return cross(way_, winding.scaled(turn.orbit.at(t))); };
        turn.times.push_back(root_between(across, winding.before(), winding.time()));
        turn.place = winding.scaled(turn.orbit.at(turn.times.back())).norm() / way_.norm();
        return turn;
      }
      const double distance = winding.here().norm();
      if (distance < least * place || distance > far * place) return std::nullopt;
      if (winding.moved() < still * distance && winding.time() - winding.before() > long_time * unit) {
        return std::nullopt;
      }
      turn.times.push_back(winding.time());
    }
  } catch (const std::domain_error&) {
    // The field has no value at the place.
  }
  return std::nullopt;
}

/// Returns the factor by which the distance from a closed orbit grows in a turn, by the integral of the divergence.
double multiplier_of(const SmoothField& field, const Turn& turn) {
  constexpr unsigned depth = 8;
  constexpr double accurate = 1e-9, beside = 1e-12;
  double exponent = 0, factor = 1;
  const auto divergence = [&](double t) {
    const auto jet = jet_of(field, turn.orbit.at(t));
    return jet ? jet->slopes.trace() : std::numeric_limits<double>::quiet_NaN();
  };
  const auto switches = [&](double t) { return Eigen::VectorXd(field.switches(turn.orbit.at(t)).col(0)); };
  for (std::size_t i = 1; i < turn.times.size(); ++i) {
    const double from = turn.times[i - 1], to = turn.times[i];
    std::vector<double> ends{from, to};
    if (field.switches) {
      const Eigen::VectorXd before = switches(from), after = switches(to);
      for (Eigen::Index row = 0; row < before.size(); ++row) {
        if (!(before[row] * after[row] < 0)) continue;
        const double at = root_between([&](double t) { return switches(t)[row]; }, from, to);
        const Vector2d x = turn.orbit.at(at), normal = field.switches(x).row(row).tail<2>();
        const auto flux = [&](double t, double sign) {
          const Vector2d way = field(turn.orbit.at(t));
          return normal.dot(Region(field, x, sign * way).field()(x));
        };
        factor *= flux(at + beside * (to - from), 1) / flux(at - beside * (to - from), -1);
        ends.push_back(at);
      }
      std::ranges::sort(ends);
    }
    for (std::size_t k = 1; k < ends.size(); ++k) {
      exponent += boost::math::quadrature::gauss_kronrod<double, 15>::integrate(divergence, ends[k - 1], ends[k], depth,
                                                                                accurate);
    }
  }
  return factor * std::exp(exponent);
}

/// Returns the slope of the return map, or of the reversed map, at a fixed point.
double slope_of(const ReturnMap& map, double place, bool back) {
  constexpr double step = 5e-4;
  const auto slope = [&](double part) {
    const auto above = map.turn(place * (1 + part), back), below = map.turn(place * (1 - part), back);
    return above && below ? (above->place - below->place) / (2 * part * place)
                          : std::numeric_limits<double>::quiet_NaN();
  };
  return (4 * slope(step) - slope(2 * step)) / 3;
}

/// The search for limit cycles about equilibria.
class CycleSearch {
 public:
  CycleSearch(const SmoothField& field, const Vector2d& half)
      : left_(std::make_shared<int>(0)), field_(limited(field, left_)), half_(half) {}

  /// @param way  direction of the ray on which cycles are sought
  void about(const Vector2d& centre, const Vector2d& way, double reach);
  std::vector<LimitCycle> take() { return std::move(found_); }

 private:
  struct Sample {
    double place, growth;  ///< ln P(s)/s; NaN if the orbit does not turn
  };

  void examine(const Vector2d& centre, const Vector2d& way, const Sample& inside, const Sample& outside);

  std::shared_ptr<int> left_;  ///< values of the field that the search may still take
  SmoothField field_;
  Vector2d half_;
  std::vector<LimitCycle> found_;
};

/// Finds the fixed point between two places with growths of different signs.
void CycleSearch::examine(const Vector2d& centre, const Vector2d& way, const Sample& inside, const Sample& outside) {
  constexpr double accurate = 1e-12, closed = 1e-9, beside = 0.01, differ = 1e-6, still = 1e-9, same = 1e-6;
  constexpr int most_values = 2'000'000;
  const bool stable = inside.growth > 0;
  *left_ = most_values;
  const ReturnMap coarse(field_, centre, half_, way, rough), fine(field_, centre, half_, way, accurate);
  // The motion that nears the cycle gives the place best. Beside a loop of a saddle it may turn elsewhere, so that its
  // growth jumps; the samples are those of the motion forwards.
  const auto root = [&](const ReturnMap& map, double low, double high, bool back) {
    return root_between([&](double place) { return map.growth_either_way(place, back); }, low, high);
  };
  const bool agrees = coarse.growth(inside.place, !stable) * inside.growth > 0 &&
                      coarse.growth(outside.place, !stable) * outside.growth > 0;
  constexpr double around = 1e-4;
  double place = root(coarse, inside.place, outside.place, !stable && agrees);
  place = root(fine, place * (1 - around), std::min(place * (1 + around), outside.place), !stable);
  const auto turn = fine.turn(place, !stable);
  if (!turn || !(std::abs(std::log(turn->place / place)) <= closed)) return;
  // The growth changes its sign here and not only somewhere between the two places.
  const double below = fine.growth_either_way(std::max(place * (1 - beside), (inside.place + place) / 2), !stable);
  const double above = fine.growth_either_way(std::min(place * (1 + beside), (outside.place + place) / 2), !stable);
  if (!(below * inside.growth > 0 && above * outside.growth > 0)) return;
  if (!(std::min(std::abs(below), std::abs(above)) > closed)) return;
  LimitCycle cycle{fine.point(place), turn->times.back(), std::numeric_limits<double>::quiet_NaN(), stable, {}};
  constexpr int parts = 24;  // enough for a smooth line on paper
  for (std::size_t i = 1; i < turn->times.size(); ++i) {
    for (int k = 0; k < parts; ++k) {
      const double from = turn->times[i - 1], to = turn->times[i];
      cycle.line.push_back(turn->orbit.at(from + (to - from) * k / parts));
    }
  }
  cycle.line.push_back(cycle.x);
  const auto is_same = [&](const LimitCycle& other) {
    const auto distance = [&](const Vector2d& x) { return (x - cycle.x).cwiseQuotient(half_).norm(); };
    double nearest = infinity, longest = 0;
    for (std::size_t i = 1; i < other.line.size(); ++i) {
      nearest = std::min(nearest, distance(other.line[i]));
      longest = std::max(longest, (other.line[i] - other.line[i - 1]).cwiseQuotient(half_).norm());
    }
    return other.stable == stable && std::abs(other.period / cycle.period - 1) < same && nearest < longest;
  };
  if (std::ranges::any_of(found_, is_same)) return;
  // Along the reversed motion the multiplier is the inverse.
  const double slope = slope_of(fine, place, !stable),
               product = multiplier_of(stable ? field_ : backward(field_), *turn);
  const auto slides = [&](const Vector2d& x) {
    const auto next = onward(stable ? field_ : backward(field_), x, half_.norm());
    return next && next->region && next->region->slides();
  };
  if (field_.switches && std::abs(slope) < still && std::ranges::any_of(cycle.line, slides)) {
    cycle.multiplier = stable ? 0 : infinity;  // neighbouring orbits join where the motion slides along a jump
  } else if (std::abs(slope - product) <= differ && !(product > 1 + differ)) {
    cycle.multiplier = stable ? product : 1 / product;
  }
  if (!stable) std::ranges::reverse(cycle.line);
  found_.push_back(std::move(cycle));
}

void CycleSearch::about(const Vector2d& centre, const Vector2d& way, double reach) {
  constexpr double nearest = 1e-4;
  // Orbits that are stiff far outside must not use up the values of the others.
  constexpr int most_values = 600'000, most_of_sample = 50'000, halvings = 12, sections = 8;
  int remaining = most_values;
  const ReturnMap map(field_, centre, half_, way, rough);
  const auto sample = [&](double place) {
    const auto growth = [&](bool back) {
      const int allowed = *left_ = std::min(remaining, most_of_sample);
      const double grown = map.growth(place, back);
      remaining -= allowed - *left_;
      return grown;
    };
    const double forth = growth(false);
    return Sample{place, std::isfinite(forth) ? forth : growth(true)};
  };
  // Every stride halves the distances, so that the values of the field last for a search that is at least coarse.
  std::vector<Sample> samples;
  const auto insert = [&](const Sample& next) {
    if (*left_ < 0) return;  // the sample is missing, although the orbit may turn
    samples.insert(std::ranges::upper_bound(samples, next.place, {}, &Sample::place), next);
  };
  constexpr int count = 48, first = 8;
  for (int stride = first; stride > 0; stride /= 2) {
    for (int i = 0; i <= count && remaining > 0; i += stride) {
      if (stride == first || i % (2 * stride) != 0) insert(sample(reach * std::pow(nearest, 1 - 1. * i / count)));
    }
  }
  const auto divide = [&](const Sample& from, const Sample& to) {
    for (const double part : {0.25, 0.5, 0.75}) insert(sample(from.place * std::pow(to.place / from.place, part)));
  };
  // A change of sign may hide three cycles. Beside a loop of a saddle all cycles lie just within the orbits that turn.
  std::vector<Sample> scanned = samples;
  for (std::size_t i = 1; i < scanned.size(); ++i) {
    Sample turns = scanned[i - 1], other = scanned[i];
    if (turns.growth * other.growth < 0) divide(turns, other);
    if (std::isfinite(turns.growth) == std::isfinite(other.growth)) continue;
    if (!std::isfinite(turns.growth)) std::swap(turns, other);
    for (int k = 0; k < halvings; ++k) {
      const Sample middle = sample(std::sqrt(turns.place * other.place));
      (std::isfinite(middle.growth) ? turns : other) = middle;
      insert(middle);
    }
  }
  // The growth may turn twice, and cross 0 in between, where it changes less than on both sides.
  scanned = samples;
  const auto slope = [&](std::size_t i) {
    return std::abs((scanned[i].growth - scanned[i - 1].growth) / std::log(scanned[i].place / scanned[i - 1].place));
  };
  for (std::size_t i = 2; i + 1 < scanned.size(); ++i) {
    if (slope(i) < slope(i - 1) && slope(i) < slope(i + 1)) divide(scanned[i - 1], scanned[i]);
  }
  // A growth below the error of the orbits is 0. Two such growths in sequence are those of a center's closed orbits.
  constexpr double roundings = 300;
  const auto sign = [&](const Sample& at) {
    const Vector2d x = map.point(at.place);
    const double error = roundings * rough * (1 + x.cwiseQuotient(half_).norm() / at.place);
    return at.growth > error ? 1 : at.growth < -error ? -1 : 0;
  };
  // Two cycles may lie between three places: there |growth| is small in the middle.
  for (std::size_t i = 1; i + 1 < samples.size(); ++i) {
    const int its = sign(samples[i]);
    if (its == 0 || sign(samples[i - 1]) != its || sign(samples[i + 1]) != its) continue;
    const auto size = [](const Sample& at) { return std::abs(at.growth); };
    if (size(samples[i]) > size(samples[i - 1]) || size(samples[i]) > size(samples[i + 1])) continue;
    Sample left = samples[i - 1], middle = samples[i], right = samples[i + 1];
    for (int k = 0; k < sections && sign(middle) == its; ++k) {
      const bool inner = middle.place / left.place > right.place / middle.place;
      const Sample tried = sample(std::sqrt(middle.place * (inner ? left : right).place));
      if (!std::isfinite(tried.growth)) break;
      const bool better = its * tried.growth < its * middle.growth;
      (better ? (inner ? right : left) : (inner ? left : right)) = better ? middle : tried;
      if (better) middle = tried;
    }
    if (sign(middle) == -its) insert(middle);
  }
  const Sample* last = nullptr;  // last sample with a sign
  int zeros = 0;
  for (const Sample& next : samples) {
    const int its = sign(next);
    if (!std::isfinite(next.growth)) {
      last = nullptr;
    } else if (its == 0) {
      ++zeros;
      continue;
    } else {
      if (last && sign(*last) == -its && zeros < 2) {
        try {
          examine(centre, way, *last, next);
        } catch (const std::domain_error&) {
          // The cycle takes too many values of the field.
        }
      }
      last = &next;
    }
    zeros = 0;
  }
}

/// The fate of a motion that begins near an equilibrium.
struct Passage {
  enum class End { leaves, arrives, unknown } end;
  double angle = 0;    ///< direction from the equilibrium at the end, continued over turns
  double nearest = 1;  ///< smallest and largest distance from the equilibrium, in radii of the ellipse
  double farthest = 1;
};

/// Follows motions from an ellipse about an equilibrium, forwards or backwards.
class Surroundings {
 public:
  Surroundings(const PlanarReduction& steps, const Vector2d& centre, const Vector2d& half)
      : steps_(steps), centre_(centre), half_(half) {}

  Vector2d point(double angle) const {
    return centre_ + half_.cwiseProduct(Vector2d(std::cos(angle), std::sin(angle)));
  }

  Passage passage(double angle) const {
    constexpr double outside = 1.5, arrived = 1e-3;
    Passage passage{Passage::End::unknown, angle};
    try {
      Winding winding = motion(angle);
      for (int i = 0; i < most && winding.advance(); ++i) {
        const double distance = winding.here().norm();
        passage.angle = angle + winding.angle();
        passage.nearest = std::min(passage.nearest, distance);
        passage.farthest = std::max(passage.farthest, distance);
        if (distance > outside || distance < arrived) {
          passage.end = distance < arrived ? Passage::End::arrives : Passage::End::leaves;
          return passage;
        }
      }
    } catch (const std::domain_error&) {
      // No motion begins at the start.
    }
    return passage;
  }

  /// Returns the angle at which a motion comes to a smaller ellipse; NaN if it does not.
  /// @param part  ratio of the two ellipses
  double angle_at(double part, double angle) const {
    Winding winding = motion(angle);
    for (int i = 0; winding.here().norm() > part; ++i) {
      if (i == most || !winding.advance()) return std::numeric_limits<double>::quiet_NaN();
    }
    const auto place = [&](double time) { return winding.scaled(winding.orbit().at(time)); };
    const Vector2d there =
        place(last_where([&](double t) { return place(t).norm() > part; }, winding.before(), winding.time()));
    return std::atan2(there[1], there[0]);
  }

  /// Returns the angles at which separatrices start.
  std::vector<double> separatrices() const {
    constexpr int count = 96, halvings = 40;
    constexpr double apart = 1, same = 0.02;
    constexpr auto arrives = Passage::End::arrives, leaves = Passage::End::leaves;
    std::vector<double> found;
    // The ellipse is not divided at the axes, because axes often are separatrices.
    const auto angle_at = [](int i) { return 2 * pi * (i + 0.37) / count; };
    Passage last = passage(angle_at(0));
    for (int i = 1; i <= count; ++i) {
      double low = angle_at(i - 1), high = angle_at(i);
      Passage before = last, after = passage(high);
      last = after;
      bool arrived = before.end == arrives || after.end == arrives;
      if (before.end == Passage::End::unknown || after.end == Passage::End::unknown) continue;
      if (before.end == arrives && after.end == arrives) continue;
      if (!arrived && std::abs(after.angle - before.angle) < apart) continue;
      for (int k = 0; k < halvings; ++k) {
        const double middle = (low + high) / 2;
        const Passage here = passage(middle);
        if (here.end == Passage::End::unknown) break;
        const bool is_as_before =
            here.end == before.end &&
            (here.end == arrives || std::abs(here.angle - before.angle) < std::abs(here.angle - after.angle));
        if (here.end == arrives && before.end == leaves && after.end == leaves) {
          arrived = true;
          low = high = middle;
          before = after = here;
          break;
        }
        (is_as_before ? low : high) = middle;
        (is_as_before ? before : after) = here;
      }
      // Motions also differ where they touch the outer border; there they do not come near to the equilibrium.
      constexpr double near = 0.3, far = 1.3;
      const auto passes_near = [](const Passage& each) {
        return each.end == arrives ? each.farthest < far : each.nearest < near;
      };
      if (!arrived || !passes_near(before) || !passes_near(after)) continue;
      const double angle = (low + high) / 2;
      if (!found.empty() && angle - found.back() < same) {
        found.back() = (found.back() + angle) / 2;
      } else {
        found.push_back(angle);
      }
    }
    return found;
  }

 private:
  static constexpr int most = 600;  // steps along a motion

  /// @throws std::domain_error  if the field is 0 or has no value at the start
  Winding motion(double angle) const {
    constexpr double widest = 0.4, first = 0.1;
    const Vector2d start = point(angle);
    const double speed = steps_.field()(start).cwiseQuotient(half_).norm();
    if (!(speed > 0)) throw std::domain_error("Surroundings: the start is at rest");
    return {steps_.part_of_orbit(start), start, centre_, half_, widest, first / speed};
  }

  const PlanarReduction& steps_;
  Vector2d centre_, half_;
};

}  // namespace

std::vector<LimitCycle> find_limit_cycles(const SmoothField& field, const Equilibria& equilibria, double reach) {
  constexpr int most = 6;
  CycleSearch search(field, (equilibria.high - equilibria.low) / 2);
  Vector2d mean(0, 0);
  for (const Equilibrium& each : equilibria.points) mean += each.x / static_cast<double>(equilibria.points.size());
  // The direction is no axis, because axes often are orbits. It leads away from other equilibria, near which saddles
  // turn orbits away.
  const auto about = [&](const Vector2d& centre) {
    const Vector2d way(0.98, 0.2);
    search.about(centre, (centre - mean).dot(way) < 0 ? Vector2d(-way) : way, reach);
  };
  int centres = 0;
  for (const Equilibrium& each : equilibria.points) {
    if (each.index.value_or(1) > 0 && ++centres <= most) about(each.x);
  }
  if (equilibria.on_curve && centres < most) about(*equilibria.on_curve);
  return search.take();
}

bool nears(const SmoothField& field, const LimitCycle& cycle, const Vector2d& start) {
  constexpr int most = 100;
  constexpr double close = 1e-3, closed = 1e-6;
  Vector2d low = cycle.x, high = cycle.x;
  for (const Vector2d& x : cycle.line) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  const auto distance = [&](const Vector2d& way) { return way.cwiseQuotient(high - low).norm(); };
  try {
    const PlanarOrbit orbit = by_steps(field, rough).part_of_orbit(start);
    Vector2d here = start;
    for (int i = 1; cycle.stable && i <= most; ++i) {
      const Vector2d next = orbit.at(i * cycle.period), moved = next - here;
      here = next;
      if (!(distance(moved) <= closed)) continue;
      for (std::size_t k = 1; k < cycle.line.size(); ++k) {
        const Vector2d side = cycle.line[k] - cycle.line[k - 1], way = here - cycle.line[k - 1];
        const double part = std::clamp(way.dot(side) / side.squaredNorm(), 0., 1.);
        if (distance(way - part * side) <= close) return true;
      }
      return false;
    }
  } catch (const std::domain_error&) {
    // The steps do not follow the orbit so far.
  }
  return false;
}

std::vector<SeparatrixPoint> degenerate_separatrices(const SmoothField& field, const Vector2d& centre,
                                                     const Vector2d& sides) {
  constexpr double tolerance = 1e-9, radius = 0.01, smaller = 0.4;
  const PlanarReduction forth = by_steps(field, tolerance), back = forth.reversed();
  std::vector<SeparatrixPoint> points;
  for (const bool stable : {true, false}) {
    const PlanarReduction& steps = stable ? forth : back;
    const Surroundings wide(steps, centre, radius * sides), narrow(steps, centre, smaller * radius * sides);
    const std::vector<double> angles = wide.separatrices(), inner = narrow.separatrices();
    if (inner.size() != angles.size()) return {};
    for (const double angle : angles) {
      // Motions that arrive are told from motions that turn away at a distance that is not 0. If motions turn away
      // slowly, like a logarithm, this finds an ordinary orbit, which depends on the ellipse.
      const double there = wide.angle_at(smaller, angle);
      constexpr double same = 2e-3;
      if (std::ranges::none_of(inner,
                               [&](double each) { return std::abs(std::remainder(each - there, 2 * pi)) < same; }))
        return {};
      points.push_back({wide.point(angle), stable});
    }
  }
  return points;
}

}  // namespace contensou::reduction
