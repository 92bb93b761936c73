// Notation (theory.md and numerics.md (R5), (R26), (R35)): tau* = P + m S, y = m k/(1 + k), s = w/(r Psi(0)) + (w + v)
// y (tau* scaled). A function f(k, r) is interpolated at Chebyshev's points r_j:  f = sum_j l_j(r) f_j(k)
#include "contensou/reduction/detail/stop_times_of_mu.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "contensou/reduction/detail/tangent.hpp"
#include "numerics/epsilon.hpp"
#include "numerics/later.hpp"
#include "similarity/regular_solution.hpp"
#include "similarity/sliding_derivatives.hpp"

namespace contensou::reduction {

namespace {

using PlaceInK = SlidingDerivatives::Place;

/// The Chebyshev points of an interval of r.
class PointsOfR {
 public:
  PointsOfR(double low, double high) : points_(high < steep ? few : many) {
    for (std::size_t j = 0; j < points_.size(); ++j) {
      const auto size = static_cast<double>(points_.size());
      const double angle = std::numbers::pi * (static_cast<double>(j) + 0.5) / size;
      const double sign = j % 2 == 0 ? 1 : -1;
      points_[j] = {.r = low + (high - low) * (1 - std::cos(angle)) / 2,
                    .weight = sign * std::sin(angle),
                    .last = 2 / size * sign * std::sin(angle),
                    .last_but_one = 2 / size * sign * std::sin(2 * angle)};
    }
  }

  std::size_t size() const { return points_.size(); }
  double operator[](std::size_t j) const { return points_[j].r; }

  /// Values of N functions at one r. errors[i]: the larger of the last two Chebyshev coefficients of function i in r.
  template <std::size_t N>
  struct Found {
    std::array<double, N> values{}, errors{};
  };

  /// @param functions  returns the values of all N functions at point number j
  template <std::size_t N, class Functions>
  Found<N> at(double x, Functions functions) const {
    std::array<double, N> sum{}, last{}, last_but_one{};
    std::optional<std::array<double, N>> on_point;
    double shares = 0;
    for (std::size_t j = 0; j < points_.size(); ++j) {
      const Point& point = points_[j];
      const std::array<double, N> here = functions(j);
      if (x == point.r) on_point = here;
      const double share = point.weight / (x - point.r);
      shares += share;
      for (std::size_t i = 0; i < N; ++i) {
        sum[i] += share * here[i];
        last[i] += point.last * here[i];
        last_but_one[i] += point.last_but_one * here[i];
      }
    }
    Found<N> found;
    for (std::size_t i = 0; i < N; ++i) {
      found.values[i] = on_point ? (*on_point)[i] : sum[i] / shares;
      found.errors[i] = std::max(std::abs(last[i]), std::abs(last_but_one[i]));
    }
    return found;
  }

 private:
  struct Point {
    double r;
    double weight;              ///< weight of barycentric interpolation
    double last, last_but_one;  ///< factors of a value at this point in the last two Chebyshev coefficients
  };

  /// The nearest r at which a function can be singular is 1/2 or more. Small r are far from it and need fewer points.
  static constexpr double steep = 0.05;
  static constexpr std::size_t many = 16, few = 12;
  std::vector<Point> points_;
};

/// One function of k (PlaceInK) at one r, on each curve of the system with this r.
template <class Curve>
class CurvesAtR {
 public:
  CurvesAtR(const Law& law, double r, double drive, Curve (*solved)(const Law&, double, const TerminalChart&, double)) {
    for (const TerminalChart& chart : charts_of(terminal_ratios(law, r, drive))) {
      curves_.push_back({chart, solved(law, r, chart, drive)});
    }
  }

  struct OnChart {
    TerminalChart chart;
    Curve curve;
  };
  const OnChart& through(double ln_k) const {
    for (const OnChart& each : curves_) {
      if (each.chart.reaches(ln_k)) return each;
    }
    throw std::runtime_error("StopTimesOfMu: no curve through this k");
  }

 private:
  std::vector<OnChart> curves_;
};

/// N functions of k and r. `Kind` makes the functions at one r and judges their errors:
///   AtR              type of the functions at one r: (const PlaceInK&) -> std::array<double, N>
///   at_r(r)          makes the functions at r
///   place(k)         returns a place
///   allowed(place, r, values, errors)  returns true if these errors of the functions are small enough
template <class Kind>
class FunctionsOfR {
 public:
  static constexpr std::size_t count = Kind::count;
  using Values = std::array<double, count>;

  /// @param edges  r at which intervals meet, increasing; each interval is solved at its first use
  FunctionsOfR(Kind kind, const std::vector<double>& edges) : kind_(std::move(kind)) {
    for (std::size_t i = 1; i < edges.size(); ++i)
      intervals_.push_back(std::make_unique<Interval>(edges[i - 1], edges[i], 0));
  }

  const Kind& kind() const { return kind_; }

  /// Returns the values of the functions; empty if an error is not allowed.
  std::optional<Values> operator()(double r, const PlaceInK& place) const {
    const auto above = std::ranges::upper_bound(intervals_, r, {}, [](const auto& each) { return each->low; });
    if (above == intervals_.begin() || r > intervals_.back()->high) return {};
    const Interval* interval = std::prev(above)->get();
    const Solved* solved = &interval->solved.made([&] { return this->solved(*interval); });
    while (solved->lower) {
      interval = (r < solved->upper->low ? solved->lower : solved->upper).get();
      solved = &interval->solved.made([&] { return this->solved(*interval); });
    }
    if (solved->at.empty()) return {};
    const auto found = interpolated(interval->points, solved->at, r, place);
    if (!kind_.allowed(place, r, found.values, found.errors)) return {};
    return found.values;
  }

 private:
  struct Interval;
  /// The functions at the points of an interval; or the interval's halves, if an error is too large; or nothing.
  struct Solved {
    std::vector<typename Kind::AtR> at;
    std::unique_ptr<const Interval> lower, upper;
  };
  struct Interval {
    Interval(double from, double to, int halved) : low(from), high(to), depth(halved), points(from, to) {}
    double low, high;
    int depth;
    PointsOfR points;
    Later<Solved> solved;
  };

  static auto interpolated(const PointsOfR& points, const std::vector<typename Kind::AtR>& at, double r,
                           const PlaceInK& place) {
    return points.at<count>(r, [&](std::size_t j) { return at[j](place); });
  }

  Solved solved(const Interval& interval) const {
    constexpr int most_halved = 4;
    Solved made;
    const std::size_t size = interval.points.size();
    try {
      for (std::size_t j = 0; j < size; ++j) made.at.push_back(kind_.at_r(interval.points[j]));
      // The error of the interpolation is largest between two points. Compute the functions themselves there, too.
      const double r = (interval.points[size / 2 - 1] + interval.points[size / 2]) / 2;
      const auto exact = kind_.at_r(r);
      bool told = false, silent = false;
      for (double ln_k = -12; ln_k < 44; ln_k += std::abs(ln_k) < 6 ? 0.3 : 2) {
        const PlaceInK place = kind_.place(std::exp(ln_k));
        auto found = interpolated(interval.points, made.at, r, place);
        const bool tells = !kind_.allowed(place, r, found.values, found.errors);
        const Values wanted = exact(place);
        for (std::size_t i = 0; i < count; ++i) found.errors[i] = std::abs(found.values[i] - wanted[i]);
        silent = silent || (!tells && !kind_.allowed(place, r, wanted, found.errors));
        told = told || tells;
      }
      const bool halved = (told || silent) && interval.depth < most_halved;
      if (halved) {
        const double middle = (interval.low + interval.high) / 2;
        made.lower = std::make_unique<const Interval>(interval.low, middle, interval.depth + 1);
        made.upper = std::make_unique<const Interval>(middle, interval.high, interval.depth + 1);
      }
      if (halved || silent) made.at.clear();
    } catch (const std::domain_error&) {
      made.at.clear();  // the error is thrown again for a start that is solved alone
    } catch (const std::runtime_error&) {
      made.at.clear();
    }
    return made;
  }

  Kind kind_;
  std::vector<std::unique_ptr<const Interval>> intervals_;
};

/// Law and drive of the systems of all r.
struct System {
  Law law;
  double drive;

  double pivoting(double r) const { return 1 / (r * law.pivoting_moment()); }
};

/// m without a drive; r y under a drive, because y grows like 1/r as r -> 0.
struct StopTimes {
  static constexpr std::size_t count = 1;
  using Values = std::array<double, count>;
  System system;

  struct AtR {
    CurvesAtR<RegularSolution> curves;
    double drive, factor;

    Values operator()(const PlaceInK& place) const {
      if (place.ln_k > max_ln_k) return {factor / (1 - drive)};
      const auto& [chart, m] = curves.through(place.ln_k);
      const bool is_y = drive == 0 || reaches_rest(chart, drive);
      return {factor * m(place.ln_k) * (is_y ? 1 : place.k / (1 + place.k))};
    }
  };
  AtR at_r(double r) const {
    return {{system.law, r, system.drive, sliding_solution}, system.drive, system.drive > 0 ? r : 1};
  }

  static PlaceInK place(double k) { return {k, std::log(k), {}, 0}; }

  bool allowed(const PlaceInK& place, double r, const Values& values, const Values& errors) const {
    const double speed = system.drive > 0 ? (1 + place.k) / r : place.k;
    const double share = (system.drive > 0 ? 8 : 6) * eps / (1 - system.drive);
    return errors[0] * speed <= share * (system.pivoting(r) + values[0] * speed);
  }
};

/// The numbers of SlidingDerivatives::Values, but by_w times r. Under a drive by_r grows like 1/r^2 as r -> 0, and
/// by_drive like 1/r. Without a drive by_drive grows like 1/r, too, unless Psi'(0) = 0.
struct Derivatives {
  static constexpr std::size_t count = 4;
  using Values = std::array<double, count>;
  System system;
  bool creeps;         ///< true if by_drive grows like 1/r
  double slope_error;  ///< tangent_error of the law

  struct AtR {
    CurvesAtR<SlidingDerivatives> curves;
    Values factors;

    Values operator()(const PlaceInK& place) const {
      const SlidingDerivatives::Values by = curves.through(place.ln_k).curve.at(place, {});
      return {factors[0] * by.by_w, factors[1] * by.by_v, factors[2] * by.by_r, factors[3] * by.by_drive};
    }
  };
  Values factors(double r) const { return {r, 1, system.drive > 0 ? r * r : 1, creeps ? r : 1}; }
  AtR at_r(double r) const {
    constexpr auto solved = [](const Law& law, double at, const TerminalChart& chart, double drive) {
      return SlidingDerivatives(law, at, chart, drive);
    };
    return {{system.law, r, system.drive, solved}, factors(r)};
  }

  PlaceInK place(double k) const { return PlaceInK::at(system.law, k); }

  /// Returns true if by_w and by_v follow from m with enough digits.
  bool by_m(const PlaceInK& place, double r) const {
    return system.drive == 0 && place.k <= SlidingDerivatives::fast_slide &&
           SlidingDerivatives::is_clear(place.friction.force, r * place.k * place.friction.moment);
  }

  SlidingDerivatives::Values unscaled(double r, const Values& values) const {
    const Values by = factors(r);
    return {values[0] / by[0], values[1] / by[1], values[2] / by[2], values[3] / by[3]};
  }

  bool allowed(const PlaceInK& place, double r, const Values& values, const Values& errors) const {
    const auto value = unscaled(r, values), error = unscaled(r, errors);
    const double k = place.k, time = value.by_w + k * value.by_v;
    // If a law has slopes by differences, they limit the error wherever by_w and by_v do not follow from m.
    const double share = 64 * eps / (1 - system.drive) + (by_m(place, r) ? 0 : slope_error);
    // In a fast slide w by_w is a small part of the time, so the error of by_w is relative to by_w itself.
    const double share_of_w =
        k > SlidingDerivatives::fast_slide ? std::max(1e-11, slope_error) * value.by_w : share * time;
    const bool speeds = by_m(place, r) || (error.by_w <= share_of_w && k * error.by_v <= share * time);
    return speeds && (1 + k) * r * error.by_r <= share * time &&
           (1 + k) * error.by_drive <= share * std::max(time, (1 + k) * std::abs(value.by_drive));
  }
};

/// Returns Phi'(0)/Psi(0), the r from which on a law has a ray if there is no drive.
double first_ray(const Law& law) { return law.force_slope() / law.pivoting_moment(); }

/// Returns the edges of the intervals, up to max_r. If there is a pole at r = 0 an interval must not be long, because
/// the error at its upper end would be felt at its lower end.
std::vector<double> edges(const Law& law, bool pole, double max_r) {
  constexpr double ratio = 16, least = 1e-20;
  // Next to the first ray the functions are smooth in r, but their series converge slowly.
  const double low = first_ray(law);
  std::vector<double> edges;
  for (double r = low / 2; r < max_r; r += low / 4) edges.push_back(r);
  edges.push_back(max_r);
  if (!pole) edges.insert(edges.begin(), 0);
  while (pole && edges.front() > least) edges.insert(edges.begin(), edges.front() / ratio);
  return edges;
}

bool ordinary_size(double x) { return x > 0x1p-300 && x < 0x1p300; }

}  // namespace

struct StopTimesOfMu::Tables {
  Tables(const Law& law, Inertia body, double drive)
      : unit(law, 1, body, drive),
        closed(closed_solution(law, max_r, drive)),
        shared(law.remembered()),
        stop_times({{shared, drive}}, edges(law, drive > 0, max_r)),
        derivatives({{shared, drive}, creeps(law, drive), tangent_error(law)},
                    edges(law, creeps(law, drive), max_r_of_derivatives(law, drive))) {}

  /// Returns true if by_drive has a pole at r = 0: with a drive, and for Psi'(0) != 0.
  static bool creeps(const Law& law, double drive) {
    constexpr double slow = 1e-6;
    return drive > 0 || law.moment_deficit({slow, 1}) > 1e-3 * slow;
  }

  /// Next to a ray, slopes by differences have too few digits.
  static double max_r_of_derivatives(const Law& law, double drive) {
    return tangent_error(law) > 0 && drive == 0 ? std::min(max_r, 0.875 * first_ray(law)) : max_r;
  }

  ReducedSystem at(double mu) const { return {unit.law(), mu, unit.inertia(), unit.drive()}; }

  double r(double mu) const { return unit.inertia().gamma * mu * mu / unit.inertia().chi; }

  bool on_axis(State start) const { return start.u == 0 || (start.v == 0 && unit.drive() == 0); }

  /// Returns true if speeds and r are in the range of the intervals.
  bool covered(double mu, State start) const {
    const double u = std::abs(start.u), x = r(mu);
    return x <= max_r && x > std::numeric_limits<double>::min() && ordinary_size(u) && ordinary_size(mu * u) &&
           (ordinary_size(start.v) || start.v == 0);
  }

  std::optional<double> stop_time(double mu, State start) const {
    const double drive = unit.drive();
    if (on_axis(start)) {
      const ReducedSystem system = at(mu);
      require_state("StopTimesOfMu", start);
      return start.u == 0 ? system.sliding_limit(start.v) / (1 - drive) : system.pivoting_limit(start.u);
    }
    if (!covered(mu, start)) return {};
    if (closed) return Flow(at(mu)).stop_time(start).tau;
    const double w = mu * std::abs(start.u);
    const auto found = stop_times(r(mu), StopTimes::place(start.v / w));
    if (!found) return {};
    const double speed = drive > 0 ? (w + start.v) / r(mu) : start.v;
    const double tau = unit.pivoting_limit(start.u) / mu + unit.sliding_limit(speed) * (*found)[0];
    return std::isfinite(tau) ? std::optional(tau) : std::nullopt;
  }

  std::optional<StopTimeGradient> gradient(double mu, State start) const {
    const auto tau = stop_time(mu, start);
    if (!tau) return {};
    SlidingDerivatives::Values by{};
    if (!on_axis(start)) {
      const double k = start.v / (mu * std::abs(start.u)), x = r(mu);
      const PlaceInK place = PlaceInK::at(unit.law(), k);
      const auto found = derivatives(x, place);
      if (!found) return {};
      by = derivatives.kind().unscaled(x, *found);
      if (const auto m = closed ? std::nullopt : stop_times(x, place); m && derivatives.kind().by_m(place, x)) {
        const auto speeds = SlidingDerivatives::by_m(place, x, unit.law().pivoting_moment(), (*m)[0]);
        by.by_w = speeds.w;
        by.by_v = speeds.v;
      }
    }
    return stop_time_gradient(at(mu), start, *tau, [&](double) { return by; });
  }

  ReducedSystem unit;  ///< law, body and drive, and mu = 1
  bool closed;         ///< true if stop times have a closed form
  Law shared;
  FunctionsOfR<StopTimes> stop_times;
  FunctionsOfR<Derivatives> derivatives;
};

StopTimesOfMu::StopTimesOfMu(const Law& law, Inertia body, double drive)
    : tables_(std::make_shared<const Tables>(law, body, drive)) {}

double StopTimesOfMu::operator()(double mu, State start) const {
  const auto found = tables_->stop_time(mu, start);
  return found ? *found : Flow(tables_->at(mu)).stop_time(start).tau;
}

StopTimeGradient StopTimesOfMu::gradient(double mu, State start) const {
  const auto found = tables_->gradient(mu, start);
  return found ? *found : Flow(tables_->at(mu)).stop_time_gradient(start);
}

bool StopTimesOfMu::solves_alone(double mu, State start, bool gradient) const {
  return gradient ? !tables_->gradient(mu, start) : !tables_->stop_time(mu, start);
}

}  // namespace contensou::reduction
