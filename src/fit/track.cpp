#include "contensou/fit/track.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace contensou::fit {

const std::vector<ObservableKind>& observable_kinds() {
  static const std::vector<ObservableKind> all{
      {Observable::slip, "slip", "m/s", "sliding speed of the contact point"},
      {Observable::spin, "spin", "rad/s", "angular velocity about the vertical"},
      {Observable::x, "x", "m", "place of the centre"},
      {Observable::y, "y", "m", "place of the centre"},
      {Observable::vx, "vx", "m/s", "velocity of the centre"},
      {Observable::vy, "vy", "m/s", "velocity of the centre"},
      {Observable::angle, "angle", "rad", "turned about the vertical"},
  };
  return all;
}

const ObservableKind& kind_of(Observable observable) {
  return observable_kinds()[static_cast<std::size_t>(observable)];
}

namespace {

[[noreturn]] void reject(const Track& track, const std::string& message) {
  throw std::domain_error(fmt::format("fit: track {}: {}", track.name, message));
}

}  // namespace

void require(const Track& track) {
  bool any = track.stop_time.has_value();
  for (Eigen::Index i = 0; i < track.t.size(); ++i) {
    const double t = track.t[i];
    if (i > 0 && t <= track.t[i - 1]) reject(track, fmt::format("t must increase; {} follows {}", t, track.t[i - 1]));
    if (!std::isfinite(t) || t < track.start) {
      reject(track, fmt::format("t >= {}, where the motion begins, is required, in s; got {}", track.start, t));
    }
  }
  if (track.stop_time && !(track.stop_time->value > 0 && std::isfinite(track.stop_time->value))) {
    reject(track, fmt::format("a stop time > 0 is required, in s; got {}", track.stop_time->value));
  }
  if (track.stop_time && !(track.stop_time->sd > 0 && std::isfinite(track.stop_time->sd))) {
    reject(track, fmt::format("a stop time needs a standard deviation > 0, in s; got {}", track.stop_time->sd));
  }
  for (const Series& series : track.series) {
    const std::string_view name = kind_of(series.observable).name;
    if (series.value.size() != track.t.size())
      reject(track, fmt::format("{} has {} values and t has {}", name, series.value.size(), track.t.size()));
    if (series.sd.size() != 0 && series.sd.size() != track.t.size())
      reject(track, fmt::format("{} has {} values and {} standard deviations", name, track.t.size(), series.sd.size()));
    double largest = 0;
    for (Eigen::Index i = 0; i < track.t.size(); ++i) {
      const double value = series.value[i];
      if (std::isnan(value)) continue;
      if (std::isinf(value)) reject(track, fmt::format("{} must be finite", name));
      if (series.sd.size() != 0 && !(series.sd[i] > 0 && std::isfinite(series.sd[i]))) {
        reject(track, fmt::format("a standard deviation of {} must be finite and > 0; got {}", name, series.sd[i]));
      }
      largest = std::max(largest, std::abs(value));
      any = true;
    }
    // A standard deviation below `sharpest` of the values is near their rounding. Sums of squares must not overflow.
    constexpr double sharpest = 1e-15, least = 1e-100, most = 1e100;
    if (largest > most) reject(track, fmt::format("{} up to {:.3g} is required; got {:.3g}", name, most, largest));
    for (Eigen::Index i = 0; i < series.sd.size(); ++i) {
      const double sd = series.sd[i];
      if (std::isnan(series.value[i]) || (sd >= std::max(least, sharpest * largest) && sd <= most)) continue;
      reject(track, fmt::format("a standard deviation of {} from {:.3g} to {:.3g} is required; got {:.3g}", name,
                                std::max(least, sharpest * largest), most, sd));
    }
  }
  if (!any) reject(track, "it has no value and no stop time");
}

}  // namespace contensou::fit
