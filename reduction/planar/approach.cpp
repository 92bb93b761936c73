#include "planar/approach.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "contensou/reduction/detail/infinity.hpp"
#include "numerics/epsilon.hpp"

namespace contensou::reduction {

using Eigen::Vector2d;
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
    double amplified = std::max(32 * noise, 32 * shift * largest);
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

}  // namespace contensou::reduction
