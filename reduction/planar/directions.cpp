#include "planar/directions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <utility>

#include <boost/math/tools/minima.hpp>

#include "contensou/reduction/detail/infinity.hpp"
#include "contensou/reduction/detail/root.hpp"

namespace contensou::reduction {

using Eigen::Vector2d;
using std::numbers::pi;
using Samples = LegendreSeries::Samples;

namespace {

constexpr double accurate = 1e-13;  ///< error of a series, relative to the largest sample

/// The product of x^order and a series in x, 0 <= x <= 1. The series is not 0 at x = 0, unless the product is 0.
struct PowerSeries {
  double order = 0;
  LegendreSeries rest;
};

/// Splits a function into x^order and a smooth factor. The result is empty if no order gives a smooth factor.
///
/// @param values    values of the function at x = (1 + points())/2
/// @param rounding  absolute errors of the values
/// @param shift     error of all x
std::optional<PowerSeries> split(const Samples& values, const Samples& rounding, double shift) {
  const Samples x = (1 + LegendreSeries::points()) / 2;
  constexpr int poles = 8, zeros = 12;
  Samples power = Samples::Ones();
  for (int pole = 0; pole <= poles; ++pole, power *= x) {
    const Samples finite = values * power;
    const Samples shifted = pole * shift * finite.abs() / x;  // an error of x changes the values near a pole much
    const double largest = finite.abs().maxCoeff(), noise = (rounding * power + shifted).maxCoeff();
    if (largest <= 32 * noise) return PowerSeries{infinity, {}};
    if (LegendreSeries::tail(finite) > accurate * largest + 4 * noise) continue;
    // In a series of degree n, errors of samples grow like n^(2 k + 1)/(2^k k!) in the k-th derivative at the end.
    LegendreSeries rest = LegendreSeries::through(finite).without_noise(8 * noise);
    // A true pole is clear in a narrower interval; a weak broken power such as 1 + 1e-6 x^0.58 seems to have one.
    const double clear = pole > 0 ? 1e3 * accurate : 0;
    double amplified = std::max({32 * noise, 32 * shift * largest, clear * largest});
    for (int zero = 0; zero <= zeros; ++zero, amplified *= 100) {
      if (std::abs(rest(-1)) > amplified) {
        if (zero > 0 && pole > 0) return std::nullopt;
        // Division by x^zero magnifies structure close to x = 0, so the quotient must be smooth, too.
        const Samples quotient = finite / x.pow(zero);
        const Samples errors = (rounding * power + shifted + shift * largest) / x.pow(zero);
        if (LegendreSeries::tail(quotient) > accurate * quotient.abs().maxCoeff() + 4 * errors.maxCoeff()) {
          return std::nullopt;
        }
        return PowerSeries{static_cast<double>(zero - pole), rest};
      }
      rest = rest.divided_by_x();
    }
    return std::nullopt;
  }
  return std::nullopt;
}

struct Sample {
  double z, value, rounding;
};

/// Returns the power of z through three samples. The two slopes of ln |value| against ln z must be equal.
std::optional<LeadingPower> power_through(const std::array<Sample, 3>& samples, double allowed) {
  if (std::ranges::all_of(samples, [](const Sample& at) { return at.value == 0; })) return LeadingPower{infinity, 0};
  const auto clear = [=](const Sample& at) { return std::abs(at.value) * allowed > at.rounding; };
  if (!std::ranges::all_of(samples, clear)) return std::nullopt;
  const auto slope = [&](std::size_t i) {
    return std::log(samples[i].value / samples[i - 1].value) / std::log(samples[i].z / samples[i - 1].z);
  };
  const double first = slope(1), second = slope(2);
  if (!(std::abs(first - second) <= allowed)) return std::nullopt;
  // If functions are given as formulas, their orders are simple fractions.
  constexpr double parts = 12;
  const double near = std::round(second * parts) / parts;
  const bool simple = std::abs(near - second) <= allowed;
  constexpr double certain = 1e-6;
  if (!simple && allowed > certain) return std::nullopt;
  const double order = simple ? near : second;
  return LeadingPower{order, samples[2].value / std::pow(samples[2].z, order)};
}

}  // namespace

Approach::Approach(const SectionField& field, const Place& place, double side, double length, double noise)
    : n_(place.n), side_(side), error_(place.error) {
  constexpr double widest = 0.4, near = 1e-6;
  const double narrowest = error_ > 0 ? 1e-9 : near;  // an axis is exact, so smaller distances can be used
  exists_ = field(turned(n_, side * std::min(near, length / 8))).has_value();
  if (!exists_) return;
  for (int root = 1; root <= 3; ++root) {
    for (const bool componentwise : {true, false}) {
      for (double width = std::min(length / 2, widest); width > narrowest; width /= 2) {
        if (find_series(field, width, root, noise, componentwise)) return;
      }
    }
  }
  find_slopes(field, length, noise);
}

/// @param componentwise  true: `noise` is relative to each component of the field; false: to the field's magnitude
bool Approach::find_series(const SectionField& field, double width, int root, double noise, bool componentwise) {
  Samples angular, radial, angular_noise, radial_noise;
  for (int i = 0; i < LegendreSeries::order; ++i) {
    const double z = width * std::pow((1 + LegendreSeries::points()[i]) / 2, root);
    const auto rates = field(turned(n_, side_ * z));
    if (!rates) return false;
    angular[i] = side_ * rates->angular;
    radial[i] = rates->radial;
    angular_noise[i] = noise * (componentwise ? rates->angular_terms : rates->size);
    radial_noise[i] = noise * (componentwise ? rates->radial_terms : rates->size);
  }
  const double shift = (componentwise ? error_ : std::max(error_, 2 * eps)) / width;
  const auto t = split(angular, angular_noise, shift), r = split(radial, radial_noise, shift);
  if (!t || !r || t->order == infinity) return false;
  width_ = width;
  root_ = root;
  angular_rest_ = t->rest;
  radial_rest_ = r->rest;
  angular_ = {t->order / root, t->rest(-1) / std::pow(width, t->order / root)};
  radial_ = {r->order / root, r->order == infinity ? 0 : r->rest(-1) / std::pow(width, r->order / root)};
  // Between the direction and the nearest sample the field could follow another formula, so the series is tested there.
  decided_ = true;
  for (double z = width / 10; z > 1e-15 && decided_; z /= 10) {
    const auto rates = field(turned(n_, side_ * z));
    const Rates expected = series(z);
    const auto like = [&](double value, double there, double terms) {
      constexpr double close = 1e-12;
      const double size = componentwise ? terms : rates->size;
      return std::abs(value - there) <= 64 * noise * size + (close + 16 * shift * width / z) * std::abs(there);
    };
    decided_ = rates && like(side_ * rates->angular, expected.angular, rates->angular_terms) &&
               like(rates->radial, expected.radial, rates->radial_terms);
  }
  if (!decided_) width_ = 0;
  return decided_;
}

Approach::Rates Approach::series(double z) const {
  const double t = 2 * std::pow(z / width_, 1 / root_) - 1;
  const auto value = [&](const LeadingPower& power, const LegendreSeries& rest) {
    return power.factor == 0 ? 0 : std::pow(z / width_, power.order) * rest(t);
  };
  return {value(radial_, radial_rest_), value(angular_, angular_rest_), 0, 0, 0};
}

void Approach::find_slopes(const SectionField& field, double length, double noise) {
  // On an axis even tiny angles have all digits, unless the addition of the centre of the scaling loses them.
  const bool on_axis = n_[0] == 0 || n_[1] == 0;
  const std::array<std::pair<double, std::array<double, 3>>, 3> tries{{
      {1e-8, {1e-20, 1e-28, 1e-36}},
      {1e-8, {1e-180, 1e-210, 1e-240}},  // orders that are nearly equal differ only at tiny angles
      {1e-3, {1e-4, 1e-5, 1e-6}},
  }};
  for (const auto& [allowed, distances] : tries) {
    if (distances[0] < 1e-6 && !on_axis) continue;
    std::array<Sample, 3> angular, radial;
    bool complete = distances[0] < length / 4;
    for (std::size_t i = 0; i < distances.size() && complete; ++i) {
      const double z = distances[i];
      const auto rates = field(turned(n_, side_ * z));
      complete = rates.has_value();
      if (!complete) break;
      angular[i] = {z, side_ * rates->angular, noise * rates->angular_terms};
      radial[i] = {z, rates->radial, noise * rates->radial_terms};
    }
    if (!complete) continue;
    const auto t = power_through(angular, allowed), r = power_through(radial, allowed);
    if (!t || !r || t->order == infinity) continue;
    decided_ = true;
    angular_ = *t;
    radial_ = *r;
    return;
  }
}

namespace {

/// The value of a function of the direction, and the magnitude of the terms of this value, which can cancel.
struct Sized {
  double value, size;
};

/// Returns the zero near a direction, if its order is at least 2: it is a simple zero of a derivative of the function.
template <class Function>
std::optional<Vector2d> multiple_zero(const Function& function, const Vector2d& n, double widest, double noise) {
  for (double width = widest; width > widest * 1e-3; width /= 4) {
    Samples values;
    double size = 0;
    bool complete = true;
    for (int i = 0; i < LegendreSeries::order && complete; ++i) {
      const std::optional<Sized> here = function(turned(n, width * LegendreSeries::points()[i]));
      complete = here.has_value();
      if (!complete) break;
      values[i] = here->value;
      size = std::max(size, here->size);
    }
    if (!complete || LegendreSeries::tail(values) > accurate * size) continue;
    constexpr std::size_t highest = 6;
    std::array<LegendreSeries, highest + 1> derivatives{
        LegendreSeries::through(values).without_noise(8 * noise * size)};
    for (std::size_t k = 1; k <= highest; ++k) derivatives[k] = derivatives[k - 1].derivative();
    for (std::size_t order = highest; order >= 2; --order) {
      double t = 0;
      for (int step = 0; step < 20; ++step) t -= derivatives[order - 1](t) / derivatives[order](t);
      if (!(std::abs(t) < 0.5)) continue;
      // In derivative k within (-1/2, 1/2), errors of samples are multiplied by up to n^k, n = LegendreSeries::order.
      double allowed = 32 * noise * size;
      bool zero = true;
      for (std::size_t k = 0; k + 1 < order; ++k, allowed *= LegendreSeries::order) {
        zero &= std::abs(derivatives[k](t)) <= allowed;
      }
      if (zero) return turned(n, width * t);
    }
    return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace

Place sharpened_zero(const SectionField& field, const Vector2d& n, double noise) {
  const auto angular = [&](const Vector2d& at) -> std::optional<Sized> {
    const auto rates = field(at);
    if (!rates) return std::nullopt;
    return Sized{rates->angular, rates->size};
  };
  constexpr double width = 0.1, error = 2e-12;
  const auto place = multiple_zero(angular, n, width, noise);
  return place ? Place{*place, error} : Place{n};
}

Place sharpened_pole(const SectionField& field, const Vector2d& n, double noise) {
  // A pole of g is a zero of g/|g|^2. Values of g/|g|^2 become more accurate towards the pole, so search twice.
  Place best{n};
  for (const double width : {0.1, 1e-3}) {
    const auto beside = field(turned(best.n, width / 10));
    if (!beside) break;
    const bool radial = std::abs(beside->radial) > std::abs(beside->angular);
    const auto inverse = [&](const Vector2d& at) -> std::optional<Sized> {
      const auto rates = field(at);
      if (!rates) return std::nullopt;
      return Sized{(radial ? rates->radial : rates->angular) / rates->size / rates->size, 1 / rates->size};
    };
    const auto place = multiple_zero(inverse, best.n, width, noise);
    if (!place) break;
    best.n = *place;
  }
  return best;
}

double angle_between(const Vector2d& a, const Vector2d& b) {
  const double angle = std::atan2(a[0] * b[1] - a[1] * b[0], a.dot(b));
  return angle > 0 ? angle : angle + 2 * pi;
}

namespace {

using Rates = SectionField::Rates;

class Scan {
 public:
  Scan(const SectionField& field, double noise, std::vector<Vector2d> between)
      : field_(field), noise_(noise), between_(std::move(between)) {}

  Directions directions() {
    constexpr std::size_t most = 16;
    const std::size_t given = between_.size();
    do {
      sample();
      if (between_.size() > given + most) throw UndecidedDirection{between_.back()};
    } while (add_pairs_of_zeros());
    Directions found;
    found.star = star_;
    if (found.star) return found;
    find_candidates();
    for (std::size_t i = 0; i < candidates_.size(); ++i) divide(i, found);
    return found;
  }

 private:
  /// A sample at an angle from an anchor. Anchor and angle are stored apart, because their sum has fewer digits.
  struct Probe {
    double offset;
    Vector2d anchor;
    std::optional<Rates> rates;

    Vector2d n() const { return turned(anchor, offset); }
  };

  std::optional<Rates> at(const Vector2d& anchor, double offset) const { return field_(turned(anchor, offset)); }
  bool is_zero(const Rates& rates) const { return std::abs(rates.angular) <= 16 * noise_ * rates.size; }
  static bool across_anchor(const Probe& a, const Probe& b) { return a.offset < 0 && b.offset > 0; }
  static double gap(const Probe& a, const Probe& b) { return angle_between(a.n(), b.n()); }

  void sample();
  bool add_pairs_of_zeros();
  void find_candidates();
  void add_zero_or_pole(const Probe& here, const Probe& next);
  void add_pole(const Probe& before, const Probe& here, const Probe& after);
  Vector2d least(const Probe& before, const Probe& here, const Probe& after,
                 const std::function<double(const Rates&)>& size) const;
  void divide(std::size_t i, Directions& found) const;

  const SectionField& field_;
  double noise_;
  std::vector<Vector2d> between_, anchors_;
  std::vector<Place> candidates_;
  std::vector<Probe> probes_;
  bool star_ = false;
};

void Scan::sample() {
  anchors_.clear();
  probes_.clear();
  for (int i = 0; i < 8; ++i) {
    constexpr int u[] = {1, 1, 0, -1, -1, -1, 0, 1}, v[] = {0, 1, 1, 1, 0, -1, -1, -1};
    anchors_.push_back(field_.on_section(Vector2d(u[i], v[i])));
  }
  const auto insert = [&](std::ptrdiff_t first, const Probe& probe) {
    const auto order = [](const Probe& x) { return std::pair(x.offset < 0, x.offset); };
    probes_.insert(std::ranges::upper_bound(probes_.begin() + first, probes_.end(), order(probe), {}, order), probe);
  };
  const double nearest = std::max(4e-13, 1e3 * noise_);
  for (std::size_t i = 0; i < anchors_.size(); ++i) {
    const Vector2d &here = anchors_[i], &next = anchors_[(i + 1) % anchors_.size()];
    const double way = angle_between(here, next);
    std::vector<double> offsets;
    for (double offset = way / 4; offset > nearest; offset /= 2) offsets.push_back(offset);
    std::ranges::reverse(offsets);
    constexpr int pieces = 8;
    for (int j = 1; j <= pieces; ++j) offsets.push_back(way / 4 * (1 + static_cast<double>(j) / pieces));
    const auto first = std::ssize(probes_);
    for (double offset : offsets) probes_.push_back({offset, here, at(here, offset)});
    for (auto offset = offsets.rbegin() + 1; offset != offsets.rend(); ++offset) {
      probes_.push_back({-*offset, next, at(next, -*offset)});
    }
    for (const Vector2d& n : between_) {
      const double offset = angle_between(here, n);
      if (offset < way)
        insert(first, offset < way / 2 ? Probe{offset, here, field_(n)} : Probe{offset - way, next, field_(n)});
    }
  }
  if (std::ranges::none_of(probes_, [](const Probe& probe) { return probe.rates.has_value(); })) {
    throw std::domain_error("PlanarReduction: the field has no values on the curve about the centre");
  }
  star_ = std::ranges::all_of(probes_, [&](const Probe& probe) { return !probe.rates || is_zero(*probe.rates); });
  // Next to a multiple zero of T off the axes, T and its sign are only rounding.
  std::erase_if(probes_, [&](const Probe& probe) {
    const bool on_axis = probe.anchor[0] == 0 || probe.anchor[1] == 0;
    return !on_axis && probe.rates && is_zero(*probe.rates);
  });
}

/// Returns the direction between three samples at which a function of the rates is least (infinite without rates).
Vector2d Scan::least(const Probe& before, const Probe& here, const Probe& after,
                     const std::function<double(const Rates&)>& size) const {
  const auto function = [&](double offset) {
    const auto rates = at(here.anchor, offset);
    return rates ? size(*rates) : infinity;
  };
  constexpr int bits = 26;
  std::uintmax_t steps = 60;
  const double offset = boost::math::tools::brent_find_minima(function, here.offset - gap(before, here),
                                                              here.offset + gap(here, after), bits, steps)
                            .first;
  return turned(here.anchor, offset);
}

/// Adds a sample between three samples of one sign of T, if T has the other sign there.
bool Scan::add_pairs_of_zeros() {
  const std::size_t known = between_.size();
  for (std::size_t i = 1; i + 1 < probes_.size(); ++i) {
    const Probe &before = probes_[i - 1], &here = probes_[i], &after = probes_[i + 1];
    if (!before.rates || !here.rates || !after.rates) continue;
    if (across_anchor(before, here) || across_anchor(here, after)) continue;
    const double sign = std::copysign(1, here.rates->angular), lowest = sign * here.rates->angular;
    const double left = sign * before.rates->angular, right = sign * after.rates->angular;
    constexpr double flat = 1e-6;
    if (!(lowest <= left && lowest <= right && std::max(left, right) > (1 + flat) * lowest)) continue;
    const Vector2d n = least(before, here, after, [&](const Rates& rates) { return sign * rates.angular; });
    const auto rates = field_(n);
    if (!rates) continue;
    const double size = std::max(before.rates->size, after.rates->size), value = std::abs(rates->angular);
    // Only half of the digits of the place of the least |T| are accurate.
    constexpr double nearly = 1e-12;
    const Place place = value <= nearly * size ? sharpened_zero(field_, n, noise_) : Place(n);
    if (place.n != n || value <= 16 * noise_ * size) {
      candidates_.push_back(place);
    } else if (sign * rates->angular < 0) {
      between_.push_back(n);
    }
  }
  if (between_.size() == known) return false;
  candidates_.clear();
  return true;
}

void Scan::add_zero_or_pole(const Probe& here, const Probe& next) {
  const double left = here.offset, right = left + gap(here, next);
  if (!here.rates || !next.rates) {
    const auto has_value = [&](double offset) { return at(here.anchor, offset).has_value(); };
    candidates_.emplace_back(
        turned(here.anchor, last_where(has_value, here.rates ? left : right, here.rates ? right : left)));
    return;
  }
  const auto angular = [&](double offset) {
    const auto rates = at(here.anchor, offset);
    return rates ? rates->angular : 0;
  };
  const double root = root_between(angular, left, right, here.rates->angular, next.rates->angular);
  candidates_.push_back(sharpened_zero(field_, turned(here.anchor, root), noise_));
}

/// Adds a pole at which T does not change its sign: the field is largest there.
void Scan::add_pole(const Probe& before, const Probe& here, const Probe& after) {
  constexpr double large = 1e3;
  const Vector2d n = least(before, here, after, [](const Rates& rates) { return 1 / rates.size; });
  const auto rates = field_(n);
  const double size = rates ? rates->size : infinity;
  if (!(size > large * here.rates->size)) return;
  candidates_.push_back(sharpened_pole(field_, n, noise_));
  if (std::signbit(before.rates->radial) == std::signbit(after.rates->radial)) return;
  const auto radial = [&](double offset) {
    const auto there = at(here.anchor, offset);
    return there ? there->radial : 0;
  };
  const double left = here.offset - gap(before, here), right = here.offset + gap(here, after);
  const Vector2d root =
      turned(here.anchor, root_between(radial, left, right, before.rates->radial, after.rates->radial));
  const auto there = field_(root);
  if (!there || there->size > size) candidates_.back() = Place(root);
}

void Scan::find_candidates() {
  for (std::size_t i = 0; i < probes_.size(); ++i) {
    const Probe &here = probes_[i], &next = probes_[(i + 1) % probes_.size()];
    if (across_anchor(here, next)) {
      // Look for a zero between the anchor and the sample nearest to it.
      const auto on = field_(next.anchor);
      if (!here.rates || !next.rates || !on || is_zero(*on)) continue;
      if (std::signbit(here.rates->angular) == std::signbit(next.rates->angular)) continue;
      add_zero_or_pole({here.offset, next.anchor, here.rates}, next);
      if (angle_between(next.anchor, candidates_.back().n) <= 4 * eps) candidates_.pop_back();
      continue;
    }
    if (here.rates.has_value() != next.rates.has_value() ||
        (here.rates && std::signbit(here.rates->angular) != std::signbit(next.rates->angular))) {
      add_zero_or_pole(here, next);
      continue;
    }
    const Probe& before = probes_[(i + probes_.size() - 1) % probes_.size()];
    if (!before.rates || !here.rates || !next.rates || across_anchor(before, here)) continue;
    if (here.rates->size > before.rates->size && here.rates->size > next.rates->size) add_pole(before, here, next);
  }
  const std::size_t inner = candidates_.size();
  candidates_.insert(candidates_.end(), anchors_.begin(), anchors_.end());
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < candidates_.size(); ++i)
    order.emplace_back(angle_between(anchors_[0], candidates_[i].n), i);
  std::ranges::sort(order);
  // Rounding can turn one direction into several. If an anchor is among them it is kept, because it is exact.
  constexpr double same = 1e-11;
  std::vector<Place> kept;
  bool last_is_anchor = false;
  for (const auto& [position, i] : order) {
    const bool anchor = i >= inner;
    if (!kept.empty() && angle_between(kept.back().n, candidates_[i].n) < same) {
      if (anchor && !last_is_anchor) kept.back() = candidates_[i];
      last_is_anchor |= anchor;
      continue;
    }
    kept.push_back(candidates_[i]);
    last_is_anchor = anchor;
  }
  if (kept.size() > 1 && angle_between(kept.back().n, kept.front().n) < same) kept.pop_back();
  candidates_ = std::move(kept);
}

/// Decides whether a candidate divides the section.
void Scan::divide(std::size_t i, Directions& found) const {
  const Place& place = candidates_[i];
  const Vector2d& n = place.n;
  const double after = angle_between(n, candidates_[(i + 1) % candidates_.size()].n);
  const double before = angle_between(candidates_[(i + candidates_.size() - 1) % candidates_.size()].n, n);
  Direction direction{n, Approach(field_, place, -1, before, noise_), Approach(field_, place, 1, after, noise_),
                      field_(n)};
  const Approach &left = direction.before, &right = direction.after;
  if (!left.exists() && !right.exists()) return;
  const auto crossed = [&] {
    if (!left.exists() || !right.exists()) return false;
    if (left.decided() && right.decided()) {
      return left.regular() && right.regular() && (left.angular().factor < 0) == (right.angular().factor > 0);
    }
    // Orbits cross a finite change of the field, but not a singular one such as a logarithm.
    constexpr double far = 1e-3, nearer = 1e-6;
    const auto step = std::min({far, before / 4, after / 4});
    std::array<std::optional<Rates>, 4> steps;
    for (std::size_t j = 0; j < 4; ++j)
      steps[j] = field_(turned(n, (j < 2 ? -1 : 1) * (j % 2 == 0 ? step : step * nearer)));
    if (!std::ranges::all_of(steps, [](const auto& there) { return there.has_value(); })) return false;
    const auto like = [](double a, double b) {
      return std::abs(a) <= 1.5 * std::abs(b) && std::abs(b) <= 1.5 * std::abs(a);
    };
    return like(steps[0]->angular, steps[1]->angular) && like(steps[2]->angular, steps[3]->angular) &&
           steps[1]->angular * steps[3]->angular > 0 && like(steps[0]->size, steps[1]->size) &&
           like(steps[2]->size, steps[3]->size);
  };
  if (crossed()) {
    found.smooth.push_back(n);
  } else {
    found.dividing.push_back(std::move(direction));
  }
}

}  // namespace

Directions find_directions(const SectionField& field, double noise, std::vector<Vector2d> between) {
  return Scan(field, noise, std::move(between)).directions();
}

}  // namespace contensou::reduction
