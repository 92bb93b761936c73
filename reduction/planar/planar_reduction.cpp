#include "contensou/reduction/planar_reduction.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/tools/minima.hpp>

#include "contensou/reduction/infinity.hpp"
#include "contensou/reduction/root.hpp"
#include "numerics/epsilon.hpp"
#include "planar/strip.hpp"

namespace contensou::reduction {

using Eigen::Vector2d;
using std::numbers::pi;

namespace {

double angle_of(const Vector2d& n) { return std::atan2(n[1], n[0]); }

/// Counter-clockwise, in (0, 2 pi].
double angle_between(const Vector2d& a, const Vector2d& b) {
  const double angle = std::atan2(a[0] * b[1] - a[1] * b[0], a.dot(b));
  return angle > 0 ? angle : angle + 2 * pi;
}

/// The root of a function that grows with x, below `high`, where it is not negative.
double root_below(const std::function<double(double)>& function, double high) {
  double width = 1, low = high - width;
  constexpr double widest = 1e300;
  while (function(low) > 0) {
    if (width > widest) return low;
    high = std::exchange(low, low - (width *= 2));
  }
  return root_between(function, low, high);
}

/// How an orbit is found again: the strip that it is in, or that q stays.
struct StripPlace {
  const Strip* strip = nullptr;
  double xi = 0;
  double radial = 0;  ///< without a strip
};

}  // namespace

std::string_view name(PlanarEnd end) {
  constexpr std::string_view names[]{"centre", "infinity", "rest", "border", "periodic"};
  return names[static_cast<std::size_t>(end)];
}

struct PlanarReduction::Solved {
  Solved(PlanarField given, const Generator& generator, const Vector2d& around, double given_noise)
      : scaling(generator), field(std::move(given), generator, around), noise(std::max(given_noise, eps)) {
    std::vector<Vector2d> between;
    constexpr std::size_t most = 16;
    while (!scan(between)) {
      if (between.size() > most) undecided(between.back());
    }
  }
  Solved(const Solved&) = delete;

  bool scan(std::vector<Vector2d>& between);
  [[noreturn]] void undecided(const Vector2d& n) const;
  void make_strips();
  std::string_view classify() const;
  StripPlace place(const Vector2d& n) const;
  PlanarEnd end(const StripPlace& place) const;
  double end_time(const StripPlace& place, double p) const;

  Generator scaling;
  SectionField field;
  double noise;  ///< of the field, relative
  bool star = false, bordered = false;
  std::vector<SectorEnd> ends;  ///< counter-clockwise
  std::vector<Strip> strips;
  std::vector<PlanarRay> rays;
  std::vector<PlanarSector> sectors;
  std::optional<PlanarTurn> turn;
  std::string_view kind;
};

void PlanarReduction::Solved::undecided(const Vector2d& n) const {
  throw UndecidedRays(
      fmt::format("at the angle {:.6g} the field points along the scaling but for rounding: "
                  "whether rays are there, one or two, its values do not tell",
                  angle_of(n)));
}

/// Finds the zeros of T and the borders, and solves what is between them. Samples are evenly spaced, and closer and
/// closer to u = 0, v = 0 and the directions between them, where a law may have all of its structure, and where a ray is
/// known exactly; between them where |T| is least.
///
/// @param between  more directions to sample in; where T is found to be of another sign than the samples say is added
/// @return false   if one was added
bool PlanarReduction::Solved::scan(std::vector<Vector2d>& between) {
  ends.clear();
  strips.clear();
  rays.clear();
  sectors.clear();
  bordered = false;
  struct Probe {
    double offset;  ///< from its anchor
    Vector2d anchor;
    std::optional<SectionField::Rates> rates;
  };
  const auto at = [&](const Vector2d& anchor, double offset) { return field(turned(anchor, offset)); };
  // A ray, or a jump: whether T becomes small on both sides.
  const double nearest = std::max(4e-13, 1e3 * noise);
  const auto vanishes = [&](const Vector2d& anchor, double offset) {
    return std::ranges::all_of(std::array{-nearest, nearest}, [&](double step) {
      const auto here = at(anchor, offset + step), there = at(anchor, offset + 64 * step);
      return here && there && std::abs(here->angular) <= std::abs(there->angular) / 2;
    });
  };
  const auto is_zero = [&](const SectionField::Rates& rates) {
    return std::abs(rates.angular) <= 16 * noise * rates.size;
  };
  std::vector<Vector2d> anchors;
  for (int i = 0; i < 8; ++i) {
    constexpr int u[] = {1, 1, 0, -1, -1, -1, 0, 1}, v[] = {0, 1, 1, 1, 0, -1, -1, -1};
    anchors.push_back(field.on_section(Vector2d(u[i], v[i])));
  }
  std::vector<Probe> probes;
  const auto insert = [&](std::ptrdiff_t first, const Probe& probe) {
    const auto order = [](const Probe& x) { return std::pair(x.offset < 0, x.offset); };
    probes.insert(std::ranges::upper_bound(probes.begin() + first, probes.end(), order(probe), {}, order), probe);
  };
  for (std::size_t i = 0; i < anchors.size(); ++i) {
    const Vector2d &here = anchors[i], &next = anchors[(i + 1) % anchors.size()];
    const double gap = angle_between(here, next);
    std::vector<double> offsets;
    for (double offset = gap / 4; offset > nearest; offset /= 2) offsets.push_back(offset);
    std::ranges::reverse(offsets);
    constexpr int pieces = 8;
    for (int j = 1; j <= pieces; ++j) offsets.push_back(gap / 4 * (1 + static_cast<double>(j) / pieces));
    const auto first = std::ssize(probes);
    for (double offset : offsets) probes.push_back({offset, here, at(here, offset)});
    for (auto offset = offsets.rbegin() + 1; offset != offsets.rend(); ++offset) {
      probes.push_back({-*offset, next, at(next, -*offset)});
    }
    for (const Vector2d& n : between) {
      const double offset = angle_between(here, n);
      if (offset < gap)
        insert(first, offset < gap / 2 ? Probe{offset, here, field(n)} : Probe{offset - gap, next, field(n)});
    }
  }
  const auto has_values = [](const Probe& probe) { return probe.rates.has_value(); };
  if (std::ranges::none_of(probes, has_values)) {
    throw std::domain_error("PlanarReduction: the field has no values on the curve about the centre");
  }
  star = std::ranges::all_of(probes, [&](const Probe& probe) { return !probe.rates || is_zero(*probe.rates); });
  if (star) {
    kind = classify();
    return true;
  }
  // Two rays between two samples: T is least there.
  const std::size_t known = between.size();
  for (std::size_t i = 1; i + 1 < probes.size(); ++i) {
    const Probe &before = probes[i - 1], &here = probes[i], &after = probes[i + 1];
    if (!before.rates || !here.rates || !after.rates) continue;
    if ((before.offset < 0 && here.offset > 0) || (here.offset < 0 && after.offset > 0)) continue;
    const double sign = std::copysign(1, here.rates->angular), least = sign * here.rates->angular;
    const double left = sign * before.rates->angular, right = sign * after.rates->angular;
    constexpr double flat = 1e-6;
    if (!(least <= left && least <= right && std::max(left, right) > (1 + flat) * least)) continue;
    const auto size = [&](double offset) {
      const auto rates = at(here.anchor, offset);
      return rates ? sign * rates->angular : infinity;
    };
    const auto angle = [](const Probe& a, const Probe& b) {
      return angle_between(turned(a.anchor, a.offset), turned(b.anchor, b.offset));
    };
    constexpr int bits = 26;
    std::uintmax_t steps = 60;
    const auto [offset, value] = boost::math::tools::brent_find_minima(size, here.offset - angle(before, here),
                                                                       here.offset + angle(here, after), bits, steps);
    const Vector2d n = turned(here.anchor, offset);
    if (value < 0) {
      between.push_back(n);
    } else if (const auto on = field(here.anchor); is_zero(*field(n)) && !(on && is_zero(*on))) {
      undecided(n);
    }
  }
  if (between.size() > known) return false;
  double largest = 0;
  for (const Probe& probe : probes) largest = std::max(largest, probe.rates ? probe.rates->size : 0);
  const auto add = [&](const Vector2d& n, bool ray) {
    const auto rates = field(n);
    // On an axis n is exact, and R; elsewhere rounded.
    const bool exact = n[0] == 0 || n[1] == 0;
    const bool rests = rates && !exact && std::abs(rates->radial) <= 16 * noise * largest;
    ends.push_back({n, ray && rates, rates && !rests ? rates->radial : 0});
    bordered |= !ends.back().ray;
  };
  for (std::size_t i = 0; i < probes.size(); ++i) {
    const Probe &here = probes[i], &next = probes[(i + 1) % probes.size()];
    if (!here.rates && !next.rates) continue;
    const bool changes =
        !here.rates || !next.rates || std::signbit(here.rates->angular) != std::signbit(next.rates->angular);
    if (here.offset < 0 && next.offset > 0) {
      // Across an anchor.
      const bool ray = vanishes(here.anchor, 0);
      const auto on = field(here.anchor);
      if (changes || (ray && on && is_zero(*on))) add(here.anchor, ray);
      continue;
    }
    if (!changes) continue;
    const double step = angle_between(turned(here.anchor, here.offset), turned(next.anchor, next.offset));
    const double left = here.offset, right = here.offset + step;
    if (here.rates && next.rates) {
      const auto angular = [&](double offset) {
        const auto rates = at(here.anchor, offset);
        return rates ? rates->angular : 0;
      };
      const double root = root_between(angular, left, right, here.rates->angular, next.rates->angular);
      add(turned(here.anchor, root), vanishes(here.anchor, root));
    } else {
      const auto has_value = [&](double offset) { return at(here.anchor, offset).has_value(); };
      const double last = last_where(has_value, here.rates ? left : right, here.rates ? right : left);
      add(turned(here.anchor, last), false);
    }
  }
  try {
    make_strips();
  } catch (const MissedRay& missed) {
    if (!missed.crossed) undecided(missed.n);
    between.push_back(missed.n);
    return false;
  }
  return true;
}

void PlanarReduction::Solved::make_strips() {
  const double tolerance = std::max(2e-14, 10 * noise);
  if (ends.empty()) {
    const auto rates = field(Vector2d(1, 0));
    strips.emplace_back(field, rates->angular > 0 ? -1.0 : 1.0, tolerance);
    const Strip& strip = strips.back();
    turn = {std::exp(strip.turn()), strip.turn_sigma()};
  }
  std::vector<std::pair<double, double>> slopes(ends.size());  // dT/dq after and before each
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const std::size_t j = (i + 1) % ends.size();
    const double length = angle_between(ends[i].n, ends[j].n);
    const auto middle = field(turned(ends[i].n, length / 2));
    if (!middle) continue;
    const bool forward = middle->angular > 0;
    strips.emplace_back(field, ends[forward ? j : i], ends[forward ? i : j], forward ? -1.0 : 1.0, length, tolerance);
    const double q = angle_of(ends[i].n);
    sectors.push_back(forward ? PlanarSector{q, q + length, ends[i].ray, ends[j].ray}
                              : PlanarSector{q + length, q, ends[j].ray, ends[i].ray});
    const Strip& strip = strips.back();
    slopes[i].first = forward ? strip.from_rate() : strip.to_rate();
    slopes[j].second = forward ? strip.to_rate() : strip.from_rate();
  }
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (!ends[i].ray) continue;
    const auto comes = [&](const Strip& strip) { return strip.to().n == ends[i].n; };
    const auto touching = [&](const Strip& strip) { return comes(strip) || strip.from().n == ends[i].n; };
    bool attracts = true;
    for (const Strip& strip : strips) attracts &= !touching(strip) || comes(strip);
    rays.push_back({angle_of(ends[i].n), attracts, ends[i].radial < 0, ends[i].radial, slopes[i].first});
  }
  std::ranges::sort(rays, {}, &PlanarRay::q);
  kind = classify();
}

std::string_view PlanarReduction::Solved::classify() const {
  const auto of_sign = [](bool all_in, bool all_out, std::string_view in, std::string_view out) {
    return all_in ? in : all_out ? out : std::string_view("mixed");
  };
  if (star) {
    bool all_in = true, all_out = true;
    for (int i = 0; i < 64; ++i) {
      const auto rates = field(turned({1, 0}, 2 * pi * i / 64));
      all_in &= !rates || rates->radial < 0;
      all_out &= !rates || rates->radial > 0;
    }
    return of_sign(all_in, all_out, "stable star", "unstable star");
  }
  if (bordered) return "bordered";
  if (strips.front().closed()) {
    const double turn_growth = strips.front().turn();
    return turn_growth < 0 ? "stable focus" : turn_growth > 0 ? "unstable focus" : "center";
  }
  const auto all = [&](auto test) { return std::ranges::all_of(strips, test); };
  const auto comes_in = [](const Strip& strip) { return strip.to().radial < 0; };
  const auto came_out = [](const Strip& strip) { return strip.from().radial > 0; };
  if (!std::ranges::all_of(ends, &SectorEnd::radial)) return "degenerate";
  if (all([&](const Strip& strip) { return !comes_in(strip) && !came_out(strip); })) {
    return strips.size() > 2 ? "saddle" : field.regular() ? "regular point" : "cusp";
  }
  return of_sign(all([&](const Strip& strip) { return comes_in(strip) && !came_out(strip); }),
                 all([&](const Strip& strip) { return !comes_in(strip) && came_out(strip); }), "stable node",
                 "unstable node");
}

StripPlace PlanarReduction::Solved::place(const Vector2d& n) const {
  if (!star) {
    for (const Strip& strip : strips) {
      const auto xi = strip.locate(n);
      if (!xi) continue;
      if (std::isfinite(*xi)) return {&strip, *xi};
      const SectorEnd& end = *xi < 0 ? strip.to() : strip.from();
      if (end.ray) return {.radial = end.radial};
    }
  }
  const auto rates = field(n);
  if (!star || !rates) throw std::domain_error("PlanarReduction: the field has no value at this point");
  return {.radial = rates->radial};
}

PlanarEnd PlanarReduction::Solved::end(const StripPlace& place) const {
  double radial = place.radial;
  if (place.strip != nullptr) {
    if (!place.strip->closed() && !place.strip->to().ray) return PlanarEnd::border;
    if (place.strip->closed() && place.strip->turn() == 0) return PlanarEnd::periodic;
    radial = place.strip->closed() ? place.strip->turn() : place.strip->to().radial;
  }
  return radial < 0 ? PlanarEnd::centre : radial > 0 ? PlanarEnd::infinity : PlanarEnd::rest;
}

double PlanarReduction::Solved::end_time(const StripPlace& place, double p) const {
  const double c = field.time_degree();
  if (place.strip != nullptr)
    return place.strip->timed() ? std::exp(c * p) * place.strip->time_left(place.xi) : infinity;
  return c * place.radial < 0 ? std::exp(c * p) / (-c * place.radial) : infinity;
}

PlanarReduction::PlanarReduction(PlanarField field, const Generator& scaling, const Vector2d& around, double noise)
    : solved_(std::make_shared<const Solved>(std::move(field), scaling, around, noise)) {}

const Generator& PlanarReduction::scaling() const { return solved_->scaling; }
const Vector2d& PlanarReduction::centre() const { return solved_->field.centre(); }
bool PlanarReduction::star() const { return solved_->star; }
const std::vector<PlanarRay>& PlanarReduction::rays() const { return solved_->rays; }
const std::vector<PlanarSector>& PlanarReduction::sectors() const { return solved_->sectors; }
const PlanarTurn* PlanarReduction::turn() const { return solved_->turn ? &*solved_->turn : nullptr; }
std::string_view PlanarReduction::kind() const { return solved_->kind; }

PlanarCanonical PlanarReduction::canonical(const Vector2d& x) const {
  if (!x.allFinite()) throw std::domain_error(fmt::format("PlanarReduction: ({}, {}) is no point", x[0], x[1]));
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  if (x == centre()) return {nothing, -infinity, nothing};
  const auto [n, p] = solved_->field.canonical(x);
  const auto rates = solved_->field(n);
  return {angle_of(n), p, rates ? rates->radial / rates->angular : nothing};
}

Vector2d PlanarReduction::point(double q, double p) const { return solved_->field.point(turned({1, 0}, q), p); }

PlanarEnd PlanarReduction::end(const Vector2d& x) const { return orbit(x).end(); }
double PlanarReduction::end_time(const Vector2d& x) const { return orbit(x).end_time(); }

double PlanarReduction::first_integral(const Vector2d& x) const {
  canonical(x);
  if (x != centre()) {
    const auto [n, p] = solved_->field.canonical(x);
    const StripPlace place = solved_->place(n);
    if (place.strip != nullptr) return p - place.strip->ln_rho(place.xi);
  }
  throw std::domain_error(fmt::format(
      "PlanarReduction: the first integral has no value on a ray and at the centre, got ({}, {})", x[0], x[1]));
}

struct PlanarOrbit::Motion {
  std::shared_ptr<const PlanarReduction::Solved> solved;
  bool at_centre;
  Vector2d n;
  double p;
  StripPlace place;
  PlanarEnd end;
  double end_time;

  /// xi where the orbit is at a time.
  double coordinate(double time) const;
};

PlanarOrbit PlanarReduction::orbit(const Vector2d& start) const {
  canonical(start);
  PlanarOrbit orbit;
  auto motion = std::make_shared<PlanarOrbit::Motion>();
  motion->solved = solved_;
  motion->at_centre = start == centre();
  motion->end = PlanarEnd::centre;
  motion->end_time = 0;
  if (!motion->at_centre) {
    std::tie(motion->n, motion->p) = solved_->field.canonical(start);
    motion->place = solved_->place(motion->n);
    motion->end = solved_->end(motion->place);
    motion->end_time = solved_->end_time(motion->place, motion->p);
  }
  orbit.motion_ = std::move(motion);
  return orbit;
}

PlanarEnd PlanarOrbit::end() const { return motion_->end; }
double PlanarOrbit::end_time() const { return motion_->end_time; }

double PlanarOrbit::Motion::coordinate(double time) const {
  const Strip& strip = *place.strip;
  const double c = solved->field.time_degree();
  const double integral = p - strip.ln_rho(place.xi);
  if (strip.timed()) {
    // ln of the time left falls with xi.
    const double ln_left = std::log(end_time - time);
    return root_below(
        [&](double xi) { return c * (integral + strip.ln_rho(xi)) + std::log(strip.time_left(xi)) - ln_left; },
        place.xi);
  }
  const auto elapsed = [&](double xi) {
    using Rule = boost::math::quadrature::gauss_kronrod<double, 15>;
    double sum = 0;
    for (double left = xi, right = 0; left < place.xi; left = right) {
      right = std::min(left + 1, place.xi);
      const auto rate = [&](double at) { return std::exp(c * (integral + strip.ln_rho(at))) / strip.rate(at); };
      sum += Rule::integrate(rate, left, right, 10, 1e-13);
    }
    return sum;
  };
  const auto at = [&](double left) { return root_below([&](double xi) { return left - elapsed(xi); }, place.xi); };
  // sum of the first n terms of a geometric series, of ratio exp(growth), and n of a sum
  const auto terms = [](double growth, double count) {
    return growth == 0 ? count : std::expm1(growth * count) / std::expm1(growth);
  };
  if (strip.closed()) {
    const double turn = elapsed(place.xi - 2 * pi), growth = c * strip.turn();
    const double turns = std::floor(growth == 0 ? time / turn : std::log1p(time / turn * std::expm1(growth)) / growth);
    return at((time - turn * terms(growth, turns)) * std::exp(-growth * turns)) - 2 * pi * turns;
  }
  const double near = std::min(place.xi, Strip::first);
  const double left = time - elapsed(near);
  if (left <= 0) return at(time);
  if (!strip.to().ray) throw std::domain_error(fmt::format("PlanarOrbit: at the time {} it is beyond a border", time));
  const double growth = c * strip.to().radial;
  const double sigma = left * std::exp(-c * (integral + strip.ln_rho(near)));
  return near + strip.to_rate() * (growth == 0 ? sigma : std::log1p(growth * sigma) / growth);
}

Vector2d PlanarOrbit::at(double time) const {
  const Motion& motion = *motion_;
  const SectionField& field = motion.solved->field;
  if (!(time >= 0)) throw std::domain_error(fmt::format("PlanarOrbit: times >= 0 are required, got {}", time));
  if (time >= motion.end_time) {
    if (motion.end == PlanarEnd::centre) return field.centre();
    throw std::domain_error(fmt::format("PlanarOrbit: the orbit is at infinity at the time {}", motion.end_time));
  }
  const double c = field.time_degree();
  if (motion.place.strip == nullptr) {
    const double growth = c * motion.place.radial;
    const double change = growth == 0 ? motion.place.radial * time * std::exp(-c * motion.p)
                                      : std::log1p(growth * time * std::exp(-c * motion.p)) / c;
    return field.point(motion.n, motion.p + change);
  }
  const Strip& strip = *motion.place.strip;
  const double xi = time == 0 ? motion.place.xi : motion.coordinate(time);
  return field.point(strip.direction(xi), motion.p + (strip.ln_rho(xi) - strip.ln_rho(motion.place.xi)));
}

}  // namespace contensou::reduction
