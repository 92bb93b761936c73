#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>
#include <boost/math/quadrature/gauss_kronrod.hpp>

#include "contensou/reduction/detail/infinity.hpp"
#include "contensou/reduction/detail/root.hpp"
#include "numerics/epsilon.hpp"
#include "planar/directions.hpp"
#include "planar/inverse_factor.hpp"
#include "planar/region.hpp"
#include "planar/reversal.hpp"
#include "planar/solution.hpp"
#include "planar/strip.hpp"

namespace contensou::reduction {

using Eigen::Vector2d;
using std::numbers::pi;

namespace {

/// Returns the root, below `high`, of a function that grows with x and is not negative at `high`.
double root_below(const std::function<double(double)>& function, double high) {
  double width = 1, low = high - width;
  constexpr double widest = 1e300;
  while (function(low) > 0) {
    if (width > widest) return low;
    high = std::exchange(low, low - (width *= 2));
  }
  return root_between(function, low, high);
}

/// The motion from a centre that the field leaves in more than one way, or in none that is known.
struct OpenMotion final : PlanarOrbit::Motion {
  explicit OpenMotion(const Vector2d& from) : x(from) {
    end = PlanarEnd::undecided;
    end_time = std::numeric_limits<double>::quiet_NaN();
    unique = false;
  }
  Vector2d at(double time) const override {
    if (time == 0) return x;
    throw std::domain_error(fmt::format("PlanarOrbit: the point at the time {} is not known: {}", time, undecided));
  }
  Vector2d at_end() const override { return x; }
  Vector2d x;
};

/// A motion that comes to the centre, and the motion that leaves the centre then.
struct MotionThroughCentre final : PlanarOrbit::Motion {
  MotionThroughCentre(PlanarOrbit to_centre, PlanarOrbit from_centre)
      : to(std::move(to_centre)), from(std::move(from_centre)) {
    end = from.end();
    end_time = to.end_time() + from.end_time();
    undecided = from.undecided();
    unique = from.unique();
    limit = from.limit();
  }
  Vector2d at(double time) const override { return time < to.end_time() ? to.at(time) : from.at(time - to.end_time()); }
  Vector2d at_end() const override { throw std::logic_error("a motion from the centre goes to infinity"); }

  PlanarOrbit to, from;
};

/// The place of a point among the orbits: its strip, and xi in this strip. An orbit with constant q has no strip.
struct StripPlace {
  const Strip* strip = nullptr;
  double xi = 0;
  double radial = 0;  ///< R; used only without a strip
};

/// The solution by a scaling: planar.md (R64), (R66), (R67), (R69).
struct ScalingSolution final : SectionSolution, std::enable_shared_from_this<ScalingSolution> {
  ScalingSolution(SmoothField given, const Generator& generator, const Vector2d& around, double given_noise);

  PlanarOrbit orbit(const Vector2d& start) const override;
  PlanarOrbit orbit_from_centre() const override;
  bool passes_centre() const;
  double end_time_error(const Vector2d& x, const PlanarOrbit& from_x) const override;
  std::optional<double> first_integral(const Vector2d& x) const override;
  std::shared_ptr<const Solution> reversed() const override {
    return std::make_shared<const ScalingSolution>(backward(field), *scaling, point(0, 0), noise);
  }

  void leave_doubtful_open();
  std::optional<double> slide_along(const Direction& end) const;
  void make_strips();
  bool proves_center() const;
  std::string_view classify() const;
  StripPlace place(const Vector2d& n) const;
  PlanarEnd end(const StripPlace& place) const;
  double end_time(const StripPlace& place, double p) const;
  Vector2d along_ray(const Vector2d& n, double radial, double p, double time) const;

  double noise;  ///< relative error of the field's values
  Directions directions;
  std::vector<Strip> strips;
};

ScalingSolution::ScalingSolution(SmoothField given, const Generator& generator, const Vector2d& around,
                                 double given_noise)
    : SectionSolution(std::move(given), generator, around), noise(std::max(given_noise, eps)) {
  const auto refuse = [](const Vector2d& n) {
    throw UndecidedRays(
        fmt::format("at the angle {:.6g} the field points along the scaling within rounding: "
                    "its values do not tell if rays are there, one or two",
                    angle_of(n)));
  };
  std::vector<Vector2d> between;
  constexpr std::size_t most = 16;
  for (;;) {
    try {
      directions = find_directions(section, noise, between);
      make_strips();
      break;
    } catch (const MissedRay& missed) {
      if (!missed.crossed || between.size() == most) refuse(missed.n);
      between.push_back(missed.n);
    } catch (const UndecidedDirection& missed) {
      refuse(missed.n);
    }
  }
  star = directions.star;
  kind = classify();
}

/// Makes the end undecided for orbits that join a ray in finite time, if the field does not determine how they
/// continue: other orbits leave the ray, too, or the field on the ray is not the limit of its values beside the ray.
/// Also makes the end undecided for orbits that near an axis, if rounding hides the motion on the axis beside it.
void ScalingSolution::leave_doubtful_open() {
  constexpr double close = 1e-6;
  const bool exact = centre.isZero(0) && scaling->matrix.isDiagonal(0);
  for (Direction& end : directions.dividing) {
    const bool on_axis = exact && (end.n[0] == 0 || end.n[1] == 0);
    const bool moves = on_axis && end.rates && end.rates->radial != 0;
    for (Approach* side : {&end.before, &end.after}) {
      if (!moves || !side->ray() || !side->decided() || side->radial().order == 0) continue;
      side->leave_open();
      undecided =
          fmt::format("beside the angle {:.6g} rounding hides the motion along this axis, {:.2g} in scaled units",
                      angle_of(end.n), end.rates->radial);
    }
    const auto joins = [](const Approach& side) {
      return side.ray() && side.angular().order < 1 && side.angular().factor < 0 && side.radial().order == 0;
    };
    const auto leaves = [](const Approach& side) { return side.angular().order < 1 && side.angular().factor > 0; };
    const auto divides = [&](const Approach& side, const Approach& other) {
      const double along = side.radial().factor;
      const bool continues = end.rates && std::abs(end.rates->radial - along) <= close * std::abs(along);
      // Where the field ends at the ray, the ray alone continues.
      return joins(side) && ((other.exists() && leaves(other)) || !continues);
    };
    const bool before = divides(end.before, end.after), after = divides(end.after, end.before);
    if (before) end.before.leave_open();
    if (after) end.after.leave_open();
    if (before || after) {
      branches = true;
      undecided = fmt::format(
          "orbits come to the angle {:.6g} in finite time, and the field determines no single motion from there on",
          angle_of(end.n));
    }
  }
}

/// Returns R of the motion along a direction on which orbits of one side or both arrive in finite time, by Filippov's
/// convex combination (R62): T of the combination is 0. Empty if an orbit leaves the direction or can cross it.
std::optional<double> ScalingSolution::slide_along(const Direction& end) const {
  const auto comes = [](const Approach& side) { return side.regular() && side.angular().factor < 0; };
  // Orbits beside a ray of this side need for ever to leave it.
  const auto stays = [&](const Approach& side) {
    return comes(side) || (side.ray() && (side.angular().order >= 1 || side.angular().factor <= 0));
  };
  if (!field.switches || !stays(end.before) || !stays(end.after)) return std::nullopt;
  if (!comes(end.before) && !comes(end.after)) return std::nullopt;
  const auto rate = [&](const Approach& side) { return comes(side) ? -side.angular().factor : 0; };
  const auto radial = [](const Approach& side) { return side.radial().order == 0 ? side.radial().factor : 0; };
  const double before = rate(end.before), after = rate(end.after);
  const double along = (before * radial(end.after) + after * radial(end.before)) / (before + after);
  constexpr double rounding = 1e-12;
  const double size = std::abs(radial(end.before)) + std::abs(radial(end.after)) + before + after;
  return std::abs(along) > rounding * size ? along : 0;
}

void ScalingSolution::make_strips() {
  const double tolerance = std::max(2e-14, 10 * noise);
  strips.clear();
  sectors.clear();
  rays.clear();
  undecided.clear();
  if (directions.star) return;
  leave_doubtful_open();
  const std::vector<Direction>& ends = directions.dividing;
  if (ends.empty()) {
    const auto rates = section(turned({1, 0}, 0.5));
    strips.emplace_back(section, directions.smooth, rates->angular > 0 ? -1.0 : 1.0, tolerance);
    const Strip& strip = strips.back();
    turn = {std::exp(strip.turn()), strip.turn_sigma()};
    if (strip.turn() == 0 && !proves_center()) {
      undecided = "a turn multiplies the distance by 1 within its error, and no reversor proves that orbits are closed";
    }
    return;
  }
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const Direction &here = ends[i], &next = ends[(i + 1) % ends.size()];
    const double length = angle_between(here.n, next.n);
    const auto middle = section(turned(here.n, length / 2));
    if (!middle || !here.after.exists() || !next.before.exists()) continue;
    const bool forward = middle->angular > 0;
    const Approach &to = forward ? next.before : here.after, &from = forward ? here.after : next.before;
    if ((to.decided() && to.angular().factor > 0) || (from.decided() && from.angular().factor < 0)) {
      throw MissedRay{(to.decided() && to.angular().factor > 0 ? to : from).n(), false};
    }
    strips.emplace_back(section, to, from, directions.smooth, forward ? -1.0 : 1.0, length, tolerance,
                        slide_along(forward ? next : here));
    const double q = angle_of(here.n);
    sectors.push_back(forward ? PlanarSector{q, q + length, from.ray(), to.ray()}
                              : PlanarSector{q + length, q, from.ray(), to.ray()});
  }
  if (strips.empty()) throw std::domain_error("PlanarReduction: the field has no values on the curve about the centre");
  for (const Direction& end : ends) {
    for (const Approach* side : {&end.before, &end.after}) {
      if (side->exists() && !side->decided() && undecided.empty()) {
        undecided =
            fmt::format("next to the angle {:.6g} the field follows no power of the angle that its values determine",
                        angle_of(end.n));
      }
    }
    if (const auto along = slide_along(end)) {
      rays.push_back({angle_of(end.n), true, *along < 0, *along, -infinity, 0});
      continue;
    }
    if (!end.before.ray() && !end.after.ray()) continue;
    const auto leaves = [](const Approach& side) { return side.angular().factor > 0; };
    const Approach& side = end.after.ray() ? end.after : end.before;
    const bool exact = (end.n[0] == 0 || end.n[1] == 0) && end.rates;
    const double along = exact ? end.rates->radial : side.radial().order == 0 ? side.radial().factor : 0;
    const double order = side.angular().order;
    const double across = order < 1   ? std::copysign(infinity, side.angular().factor)
                          : order > 1 ? 0
                                      : side.angular().factor;
    rays.push_back({angle_of(end.n), !leaves(end.before) && !leaves(end.after), along < 0, along, across, order});
  }
  std::ranges::sort(rays, {}, &PlanarRay::q);
}

/// Returns true if a proof shows that orbits which turn with a factor of 1 within its error are closed: a reflection
/// about an axis through the centre reverses all motions, or the field is divergence-free. The latter needs exact
/// derivatives.
bool ScalingSolution::proves_center() const {
  constexpr int angles = 60;
  std::vector<Vector2d> points;
  for (int i = 0; i < angles; ++i) {
    points.push_back(point(2 * pi * (i + std::numbers::phi - 1) / angles, static_cast<double>(i % 3 - 1) / 2));
  }
  const auto keeps_p = [&](const Vector2d& x) {
    const auto rates = section(section.canonical(x).first);
    constexpr double roundings = 8;
    return rates && std::abs(rates->radial) <= roundings * eps * rates->radial_terms;
  };
  if (std::ranges::all_of(points, keeps_p)) return true;
  const auto free_of_divergence = [&](const Vector2d& x) {
    const auto here = jet_of(field, x);
    constexpr double rounding = 1e-14;
    return here && std::abs(here->slopes.trace()) <= rounding * here->slopes.cwiseAbs().sum();
  };
  if (field.jacobian && std::ranges::all_of(points, free_of_divergence)) return true;
  return std::ranges::any_of(maps_to_try, [&](const Reversor& reversor) {
    const auto holds = [&](const Vector2d& x) { return reverses(field, reversor.matrix, centre, x).value_or(true); };
    return is_reflection(reversor) && std::ranges::all_of(points, holds);
  });
}

std::string_view ScalingSolution::classify() const {
  const auto of_sign = [](bool all_in, bool all_out, std::string_view in, std::string_view out) {
    return all_in ? in : all_out ? out : planar_kind("mixed");
  };
  if (directions.star) {
    bool all_in = true, all_out = true;
    for (int i = 0; i < 64; ++i) {
      const auto rates = section(turned({1, 0}, 2 * pi * i / 64));
      all_in &= !rates || rates->radial < 0;
      all_out &= !rates || rates->radial > 0;
    }
    return of_sign(all_in, all_out, planar_kind("stable star"), planar_kind("unstable star"));
  }
  if (turn && strips.front().turn() == 0 && !undecided.empty()) return planar_kind("center or focus");
  if (!undecided.empty()) return "";
  if (directions.dividing.empty()) {
    const double turn_growth = strips.front().turn();
    return turn_growth < 0   ? planar_kind("stable focus")
           : turn_growth > 0 ? planar_kind("unstable focus")
                             : planar_kind("center");
  }
  const auto between_rays = [](const Direction& end) { return end.before.ray() && end.after.ray(); };
  if (!std::ranges::all_of(directions.dividing, between_rays)) return planar_kind("bordered");
  const auto all = [&](auto test) { return std::ranges::all_of(strips, test); };
  const auto comes_in = [](const Strip& strip) { return strip.limit() == Limit::centre; };
  const auto came_out = [](const Strip& strip) { return strip.origin() == Limit::centre; };
  if (!std::ranges::all_of(rays, &PlanarRay::radial)) return planar_kind("degenerate");
  if (all([&](const Strip& strip) { return !comes_in(strip) && !came_out(strip); })) {
    return strips.size() > 2   ? planar_kind("saddle")
           : section.regular() ? planar_kind("regular point")
                               : planar_kind("cusp");
  }
  return of_sign(all([&](const Strip& strip) { return comes_in(strip) && !came_out(strip); }),
                 all([&](const Strip& strip) { return !comes_in(strip) && came_out(strip); }),
                 planar_kind("stable node"), planar_kind("unstable node"));
}

StripPlace ScalingSolution::place(const Vector2d& n) const {
  for (const Strip& strip : strips) {
    const auto xi = strip.locate(n);
    if (!xi) continue;
    if (std::isfinite(*xi)) return {&strip, *xi};
    const double q = angle_of((*xi < 0 ? strip.to() : strip.from()).n());
    const auto ray = std::ranges::find(rays, q, &PlanarRay::q);
    if (ray != rays.end()) return {.radial = ray->radial};
  }
  const auto rates = section(n);
  if (!directions.star || !rates) {
    throw std::domain_error("PlanarReduction: no single motion leaves this point, or the field has no value there");
  }
  return {.radial = rates->radial};
}

PlanarEnd ScalingSolution::end(const StripPlace& place) const {
  const auto by_sign = [](double radial) {
    return radial < 0 ? PlanarEnd::centre : radial > 0 ? PlanarEnd::infinity : PlanarEnd::rest;
  };
  if (place.strip == nullptr) return by_sign(place.radial);
  const Strip& strip = *place.strip;
  if (strip.closed()) {
    if (strip.turn() != 0) return by_sign(strip.turn());
    return undecided.empty() ? PlanarEnd::periodic : PlanarEnd::undecided;
  }
  switch (strip.limit()) {
    case Limit::centre:
      return PlanarEnd::centre;
    case Limit::infinity:
      return PlanarEnd::infinity;
    case Limit::point:
      return strip.to().ray() || strip.slides() ? PlanarEnd::rest : PlanarEnd::border;
    case Limit::undecided:
      break;
  }
  return PlanarEnd::undecided;
}

/// Returns the time until the orbit reaches its end (possibly a border); infinity if it never reaches an end.
double ScalingSolution::end_time(const StripPlace& place, double p) const {
  const double c = section.time_degree();
  if (place.strip != nullptr)
    return place.strip->timed() ? std::exp(c * p) * place.strip->time_left(place.xi) : infinity;
  return c * place.radial < 0 ? std::exp(c * p) / (-c * place.radial) : infinity;
}

/// Moves the point with the canonical coordinate p along the ray with the direction n for a time.
Vector2d ScalingSolution::along_ray(const Vector2d& n, double radial, double p, double time) const {
  const double c = section.time_degree(), way = time * std::exp(-c * p), growth = c * radial;
  return section.point(n, p + (growth == 0 ? radial * way : std::log1p(growth * way) / c));
}

double ScalingSolution::end_time_error(const Vector2d& x, const PlanarOrbit& from_x) const {
  constexpr double other = 1.37, margin = 8, least = 1e-13;
  const auto again = std::make_shared<const ScalingSolution>(field, *scaling, centre + other * (x - centre), noise);
  return std::max(least, margin * std::abs(period_or_end(again->orbit(x)) / period_or_end(from_x) - 1));
}

std::optional<double> ScalingSolution::first_integral(const Vector2d& x) const {
  const auto [n, p] = section.canonical(x);
  const StripPlace at = place(n);
  if (at.strip == nullptr) return std::nullopt;
  return p - at.strip->ln_rho(at.xi);
}

/// A walk along an orbit in the direction of the motion, that is, of falling xi; it also computes the time.
struct Walk {
  const Strip& strip;
  double c, integral;  ///< p - L(q)
  double xi;
  double passed = 0;  ///< time since the start of the walk

  double elapsed(double left, double right) const {
    using Rule = boost::math::quadrature::gauss_kronrod<double, 15>;
    const auto rate = [&](double at) { return std::exp(c * (integral + strip.ln_rho(at))) / strip.rate(at); };
    constexpr unsigned halvings = 3;  // the integrand and its factors are smooth between ends of panels
    return Rule::integrate(rate, left, right, halvings, 1e-13);
  }

  /// Continues until the time `wanted` has passed or xi is `last`, in steps that change the integrand moderately.
  /// @return true if the time `wanted` has passed
  bool go(double wanted, double last) {
    while (xi > last) {
      constexpr double longest = 1, change = 4;
      const double growth = std::abs(c * (strip.ln_rho(xi) - strip.ln_rho(xi - 1e-3)) / 1e-3);
      const double step = growth * longest > change ? change / growth : longest;
      const double left = std::max({xi - step, last, strip.smooth_from(xi)}), part = elapsed(left, xi);
      if (!(passed + part < wanted)) {
        xi = root_between([&](double at) { return passed + elapsed(at, xi) - wanted; }, left, xi);
        return true;
      }
      if (part == 0) return false;  // the centre, except for underflow
      passed += part;
      xi = left;
    }
    return false;
  }
};

struct ScalingMotion final : PlanarOrbit::Motion {
  Vector2d at(double time) const override;
  Vector2d at_end() const override {
    if (end == PlanarEnd::centre) return solution->centre;
    if (!place.strip) return solution->section.point(n, p);  // a point of a ray at rest
    const Strip& strip = *place.strip;
    return solution->section.point(strip.to().n(), p + (strip.ln_rho(-infinity) - strip.ln_rho(place.xi)));
  }

  /// Returns the time from xi to the next multiple of 2 pi below xi on a closed strip that is not timed.
  double until_mark(double xi, double integral) const {
    const double c = solution->section.time_degree();
    return std::exp(c * (integral + place.strip->ln_rho(xi))) * place.strip->time_left(xi);
  }
  /// Returns the time of a turn from a multiple of 2 pi to the next.
  double from_mark(double integral) const {
    const double c = solution->section.time_degree();
    return std::exp(c * (integral + place.strip->ln_rho(2 * pi))) * place.strip->turn_time();
  }

  /// Returns the time of one turn, for orbits that turn for ever.
  double turn_time() const {
    const Strip& strip = *place.strip;
    const double integral = p - strip.ln_rho(place.xi);
    if (!strip.timed()) {
      const double next = integral + strip.turn();
      return until_mark(place.xi, integral) + (from_mark(next) - until_mark(place.xi, next));
    }
    Walk turn{strip, solution->section.time_degree(), integral, place.xi};
    turn.go(infinity, place.xi - 2 * pi);
    return turn.passed;
  }

  /// Returns xi after a time of less than a turn, on a closed strip that is not timed.
  double xi_within_turn(double time) const {
    const Strip& strip = *place.strip;
    const double integral = p - strip.ln_rho(place.xi), first = until_mark(place.xi, integral);
    if (time < first) {
      return root_between([&](double xi) { return until_mark(xi, integral) - (first - time); }, 0, place.xi);
    }
    const double next = integral + strip.turn(), whole = from_mark(next);
    const auto left = [&](double xi) {
      return (xi < 2 * pi ? until_mark(xi, next) : whole) - (whole - (time - first));
    };
    return root_between(left, place.xi, 2 * pi) - 2 * pi;
  }
  std::optional<double> period() const override {
    return end == PlanarEnd::periodic ? std::optional(turn_time()) : std::nullopt;
  }

  std::shared_ptr<const ScalingSolution> solution;
  Vector2d n;
  double p = 0;
  StripPlace place;
};

/// The motion from a centre at which the field f is not 0. X maps f onto itself, so that the orbit through the centre
/// is invariant, too: it leaves along a ray. There dp/dt = exp(-c p) R, so that exp(c p) = c R t.
struct MotionFromCentre final : PlanarOrbit::Motion {
  Vector2d at(double time) const override {
    const double c = solution->section.time_degree();
    return time == 0 ? solution->centre : solution->section.point(n, std::log(c * radial * time) / c);
  }
  Vector2d at_end() const override { throw std::logic_error("a motion from the centre goes to infinity"); }

  std::shared_ptr<const ScalingSolution> solution;
  Vector2d n;
  double radial = 0;
};

/// Returns true if a motion leaves the centre although it lies on a switching curve.
bool ScalingSolution::passes_centre() const {
  const auto from_curve = onward(field, centre, section.frame().norm());
  return from_curve && from_curve->region;
}

PlanarOrbit ScalingSolution::orbit_from_centre() const {
  if (!section.regular() && !passes_centre()) return SectionSolution::orbit_from_centre();
  auto motion = std::make_shared<MotionFromCentre>();
  motion->solution = shared_from_this();
  motion->end_time = infinity;
  const auto leaves = [&](const PlanarRay& ray) { return section.time_degree() * ray.radial > 0; };
  if (std::ranges::count_if(rays, leaves) == 1) {
    const PlanarRay& ray = *std::ranges::find_if(rays, leaves);
    motion->end = PlanarEnd::infinity;
    motion->n = std::ranges::find(directions.dividing, ray.q, [](const Direction& end) { return angle_of(end.n); })->n;
    motion->radial = ray.radial;
    return PlanarOrbit(std::move(motion));
  }
  auto open = std::make_shared<OpenMotion>(centre);
  open->undecided = "the field determines no single motion from the centre";
  return PlanarOrbit(std::move(open));
}

PlanarOrbit ScalingSolution::orbit(const Vector2d& start) const {
  const auto from_curve = onward(field, start, (start - centre).norm());
  if (from_curve && from_curve->ambiguous) {
    auto open = std::make_shared<OpenMotion>(start);
    open->undecided = from_curve->reason;
    return PlanarOrbit(std::move(open));
  }
  auto motion = std::make_shared<ScalingMotion>();
  motion->solution = shared_from_this();
  std::tie(motion->n, motion->p) = section.canonical(start);
  motion->place = place(motion->n);
  motion->end = end(motion->place);
  motion->end_time = end_time(motion->place, motion->p);
  motion->border_time_known = motion->place.strip != nullptr && motion->place.strip->timed();
  if (motion->end == PlanarEnd::undecided) {
    motion->undecided = undecided;
    motion->unique = !branches;
    motion->end_time = std::numeric_limits<double>::quiet_NaN();
  }
  const bool goes_on = motion->end == PlanarEnd::centre && std::isfinite(motion->end_time) && passes_centre();
  PlanarOrbit orbit(std::move(motion));
  if (!goes_on) return orbit;
  return PlanarOrbit(std::make_shared<const MotionThroughCentre>(std::move(orbit), orbit_from_centre()));
}

Vector2d ScalingMotion::at(double time) const {
  const SectionField& section = solution->section;
  if (place.strip == nullptr) return solution->along_ray(n, place.radial, p, time);
  const Strip& strip = *place.strip;
  const double c = section.time_degree();
  const double integral = p - strip.ln_rho(place.xi);
  const auto at_coordinate = [&](double xi) { return section.point(strip.direction(xi), integral + strip.ln_rho(xi)); };
  const auto on_ray = [&](double time_there) {
    return solution->along_ray(strip.to().n(), strip.along_ray(), integral + strip.ln_rho(-infinity), time_there);
  };
  if (time == 0) return at_coordinate(place.xi);
  constexpr double early = 0.02;  // from this fraction of end_time on, the time left has all its digits
  if (strip.timed() && time > early * end_time) {
    const double left = end_time - time, ln_left = std::log(left);
    if (strip.joins_ray()) {
      const double on_arrival = std::exp(c * (integral + strip.ln_rho(-infinity))) * strip.time_left(-infinity);
      if (left < on_arrival) return on_ray(on_arrival - left);
    }
    // The logarithm of the time left falls along the orbit, so xi is the root of a monotone function.
    return at_coordinate(root_below(
        [&](double xi) { return c * (integral + strip.ln_rho(xi)) + std::log(strip.time_left(xi)) - ln_left; },
        place.xi));
  }
  Walk walk{strip, c, integral, place.xi};
  // Returns the sum of the first `count` terms of a geometric series that begins with 1 and has the ratio exp(growth).
  const auto terms = [](double growth, double count) {
    return growth == 0 ? count : std::expm1(growth * count) / std::expm1(growth);
  };
  if (strip.closed()) {
    const double turn = turn_time(), growth = c * strip.turn();
    const double turns = std::floor(growth == 0 ? time / turn : std::log1p(time / turn * std::expm1(growth)) / growth);
    const double rest = (time - turn * terms(growth, turns)) * std::exp(-growth * turns);
    if (!strip.timed()) return at_coordinate(xi_within_turn(rest) - 2 * pi * turns);
    walk.go(rest, place.xi - 2 * pi);
    return at_coordinate(walk.xi - 2 * pi * turns);
  }
  const bool decided = strip.to().decided(), joins = strip.joins_ray();
  const bool linear = decided && !joins && strip.to().angular().order == 1;
  constexpr double farthest = -1e4;  // at this xi the angle z from the end underflows to 0
  // Near a ray that orbits join in finite time, the time left is proportional to z^(1 - a), with a of PlanarRay::order.
  const double last = joins                ? Strip::first / (1 - strip.to().angular().order)
                      : linear || !decided ? Strip::first
                                           : farthest;
  if (walk.go(time, std::min(place.xi, last))) return at_coordinate(walk.xi);
  if (!decided) {
    throw std::domain_error(
        fmt::format("PlanarOrbit: the point at the time {} is not known: {}", time, solution->undecided));
  }
  if (joins) return on_ray(time - walk.passed);
  if (!linear) return at_coordinate(walk.xi);
  // Beyond this xi, the rate s at which xi falls is constant. R is constant, too, if p has no bound.
  const double rate = std::abs(strip.to().angular().factor);
  const double growth = strip.to().radial().order == 0 ? c * strip.to().radial().factor : 0;
  const double sigma = (time - walk.passed) * std::exp(-c * (integral + strip.ln_rho(walk.xi)));
  return at_coordinate(walk.xi - rate * (growth == 0 ? sigma : std::log1p(growth * sigma) / growth));
}

}  // namespace

std::shared_ptr<const PlanarReduction::Solution> solved_by_scaling(SmoothField field, const Generator& scaling,
                                                                   const Vector2d& around, double noise) {
  return std::make_shared<const ScalingSolution>(std::move(field), scaling, around, noise);
}

}  // namespace contensou::reduction
