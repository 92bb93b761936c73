#include "fit/profile.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include <boost/math/tools/toms748_solve.hpp>

namespace contensou::fit {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr double endless = std::numeric_limits<double>::infinity();
constexpr double tolerance = 1e-4;
/// An estimate counts as better if its sum of squares is lower by at least this much.
constexpr double better_by = 0.01;
/// A number counts as at a limit if its distance from the limit is below the share `near_limit` of its range. The limit
/// alone sets the end if the sum of squares would fall beyond the limit by more than the share `telling` of the rise.
constexpr double near_limit = 1e-6, telling = 0.1;
constexpr Index patch_place = 1;
/// Widest step of ln f or ln eps, and the ratio of the lengths of successive steps.
constexpr double widest = 1.2, growth = 1.6;
/// Largest error of an end, as a share of its distance from the estimate.
constexpr double sharp = 2e-3;
constexpr int most_refinements = 12;
/// Largest number of starts at a point: `most_starts` on the way along the valley, `few_starts` once the end is
/// bracketed, and for the search of another valley.
constexpr std::size_t most_starts = 6, few_starts = 2;

}  // namespace

Profile::Profile(const Search& search, const VectorXd& best, double rise, bool wide)
    : search_(search), best_(best), rise_(rise), least_(search.cost(best)), wide_(wide) {
  points_.push_back({best, 0});
  if (wide_) spread();
}

void Profile::spread() {
  std::vector<double> seen[2];
  for (const VectorXd& guess : search_.guesses) {
    bool is_new = false;
    for (Index shared : {0, 1}) {
      if (std::ranges::count(seen[shared], guess[shared]) > 0) continue;
      seen[shared].push_back(guess[shared]);
      is_new = true;
    }
    if (!is_new) continue;
    const VectorXd parameters = search_.improved(guess, nullptr, tolerance);
    points_.push_back({parameters, search_.cost(parameters) - least_});
    if (points_.back().excess < -better_by) better_ = parameters;
  }
}

std::vector<VectorXd> Profile::starts_at(const Coordinate& number, double at, const VectorXd& foretold,
                                         std::size_t most) const {
  // Divide the valley by friction and patch radius. From each part take the nearest points below and above `at`.
  struct Nearest {
    const VectorXd* parameters = nullptr;
    double distance = endless;
  };
  std::map<std::tuple<double, double, bool>, Nearest> parts;
  const auto part_of = [](double logarithm) { return std::round(logarithm / 1.5); };
  const auto offer = [&](const VectorXd& parameters) {
    const double away = number.of(parameters) - at;
    Nearest& nearest = parts[{part_of(parameters[0]), part_of(parameters[1]), away < 0}];
    if (std::abs(away) < nearest.distance) nearest = {&parameters, std::abs(away)};
  };
  for (const Point& point : points_) {
    if (point.excess < 4 * rise_) offer(point.parameters);
  }
  if (const VectorXd* guess = nearest_guess(number, at)) offer(*guess);
  std::vector<std::pair<double, VectorXd>> found;
  const auto judge = [&](const VectorXd& parameters) {
    VectorXd start = search_.carried(number.moved(parameters, at));
    const double cost = search_.cost(start);
    found.emplace_back(cost, std::move(start));
  };
  judge(foretold);
  for (const auto& [part, nearest] : parts) judge(*nearest.parameters);
  std::ranges::sort(found, {}, [](const auto& each) { return each.first; });
  // The first start is the best point. The following starts are the best points of other parts.
  std::vector<VectorXd> starts;
  for (auto& [cost, parameters] : found) {
    const bool is_new = std::ranges::none_of(starts, [&parameters = parameters](const VectorXd& start) {
      return (start - parameters).head<2>().cwiseAbs().maxCoeff() < 0.5;
    });
    if (is_new) starts.push_back(std::move(parameters));
    if (starts.size() == most) break;
  }
  return starts;
}

const VectorXd* Profile::nearest_guess(const Coordinate& number, double at) const {
  constexpr double near = 1;  // take the best guess nearer than this; if there is none, the nearest guess
  const VectorXd* nearest = nullptr;
  double least = endless;
  for (const VectorXd& guess : search_.guesses) {
    const double away = std::abs(number.of(guess) - at);
    if (away < near) return &guess;
    if (away < least) nearest = &guess;
    least = std::min(least, away);
  }
  return nearest;
}

const Profile::Point& Profile::lowest(const Coordinate& number, double at, const VectorXd& foretold, std::size_t most) {
  Point found{{}, endless};
  for (const VectorXd& start : starts_at(number, at, foretold, most)) {
    const VectorXd parameters = search_.improved(start, &number, tolerance);
    const double excess = search_.cost(parameters) - least_;
    if (excess < found.excess || found.parameters.size() == 0) found = {parameters, excess};
    if (excess < rise_) break;
  }
  if (found.excess < -better_by) better_ = found.parameters;
  points_.push_back(std::move(found));
  return points_.back();
}

double Profile::end(const Coordinate& number, double sign, double error, double limit) {
  const double from = number.of(best_), room = sign * (limit - from);
  struct Reach {
    double distance, height;  ///< distance from the estimate; sqrt of the rise there minus sqrt of the allowed rise
  };
  Reach inside{0, -std::sqrt(rise_)}, outside{endless, endless};
  VectorXd last = best_;  // last point inside the interval
  const auto look = [&](double distance, const VectorXd& foretold, std::size_t starts = few_starts) {
    const double excess = lowest(number, from + sign * distance, foretold, starts).excess;
    const Reach found{distance, std::sqrt(std::max(0.0, excess)) - std::sqrt(rise_)};
    if (found.height < 0) {
      inside = found;
      last = points_.back().parameters;
      if (outside.distance < distance) outside = {endless, endless};
    } else if (distance < outside.distance) {
      outside = found;
    }
    return found.height;
  };

  // Follow the valley from the farthest known point: extrapolate from the last two points.
  for (const Point& point : points_) {
    const double distance = sign * (number.of(point.parameters) - from);
    if (point.excess >= rise_ || distance <= inside.distance) continue;
    inside = {distance, std::sqrt(std::max(0.0, point.excess)) - std::sqrt(rise_)};
    last = point.parameters;
  }
  VectorXd before = last;
  const double longest = number.of_contact() ? widest : endless;
  double step =
      std::min({std::isfinite(error) && error > 0 ? std::sqrt(rise_) * error : room / 256, room / 4, longest});
  for (double ahead = 0; inside.distance < room && !better_; step = std::min(growth * step, longest)) {
    const double distance = std::min(room, inside.distance + step);
    const VectorXd foretold =
        ahead > 0 ? VectorXd(last + (distance - inside.distance) / ahead * (last - before)) : last;
    ahead = distance - inside.distance;
    before = last;
    if (look(distance, foretold, most_starts) >= 0) break;
  }
  // Another valley may begin beyond the end of the valley that was followed.
  double stride = number.of_contact() ? widest : room / 64;
  for (double distance = outside.distance; wide_ && distance < room && !better_; stride *= growth) {
    distance = std::min(room, distance + stride);
    look(distance, points_.back().parameters);
  }
  if (inside.distance >= room) return sign * endless;
  if (!better_) {
    const auto height_at = [&](double distance) { return better_ ? 0 : look(distance, last); };
    const auto is_sharp = [](double left, double right) { return right - left <= sharp * right; };
    std::uintmax_t looks = most_refinements;
    boost::math::tools::toms748_solve(height_at, inside.distance, outside.distance, inside.height, outside.height,
                                      is_sharp, looks);
  }
  if (is_held_by_limit(number, last)) return sign * endless;
  return from + sign * (inside.distance + outside.distance) / 2;
}

bool Profile::is_held_by_limit(const Coordinate& number, const VectorXd& parameters) const {
  const VectorXd limited = search_.model.limited(parameters);
  for (Index place : search_.free) {
    const auto [low, high] = search_.model.range(place);
    if (place == number.place || !std::isfinite(high)) continue;
    // No patch is larger than the ball, so the upper limit of the patch radius is a real end.
    const bool below = limited[place] - low < near_limit * (high - low);
    const bool above = high - limited[place] < near_limit * (high - low) && place != patch_place;
    if (!below && !above) continue;
    VectorXd outward = VectorXd::Unit(limited.size(), place) * (above ? 1 : -1);
    if (number.of_contact() && place < contact_parameters) {
      const Eigen::Vector2d line(-number.powers[1], number.powers[0]);
      if (line[place] == 0) continue;
      outward.head<2>() = line * (outward[place] / line[place]);
    }
    // The step changes friction or patch radius by a factor of e, and another number by the size of its limit.
    if (place >= contact_parameters) outward *= std::abs(limited[place]);
    if (-search_.slope(limited, outward) > telling * rise_) return true;
  }
  return false;
}

Interval Profile::of(const Coordinate& number, double error, double low, double high) {
  if (better_) return {low, high};
  return {end(number, -1, error, low), end(number, 1, error, high)};
}

std::vector<Profile::Point> Profile::other_minima(const Coordinate& number, const std::vector<double>& values) {
  std::vector<Point> along(values.size());
  const auto middle = static_cast<std::size_t>(std::ranges::lower_bound(values, number.of(best_)) - values.begin());
  const auto follow = [&](std::size_t i, const VectorXd& last) -> const VectorXd& {
    along[i] = lowest(number, values[i], last, few_starts);
    return along[i].parameters;
  };
  VectorXd last = best_;
  for (std::size_t i = middle; i < values.size(); ++i) last = follow(i, last);
  last = best_;
  for (std::size_t i = middle; i-- > 0;) last = follow(i, last);

  std::vector<Point> minima{{best_, 0}};
  const auto is_apart = [&](const Point& one, const Point& other) {
    const auto [low, high] = std::minmax({number.of(one.parameters), number.of(other.parameters)});
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (low < values[i] && values[i] < high && along[i].excess > rise_) return true;
    }
    return false;
  };
  for (std::size_t i = 0; i < values.size() && !better_; ++i) {
    const double before = i > 0 ? along[i - 1].excess : endless;
    const double after = i + 1 < values.size() ? along[i + 1].excess : endless;
    if (along[i].excess > std::min(before, after)) continue;
    const VectorXd parameters = search_.improved(along[i].parameters, nullptr, tolerance);
    const Point found{parameters, search_.cost(parameters) - least_};
    if (found.excess < -better_by) better_ = parameters;
    if (!(found.excess < rise_)) continue;
    points_.push_back(found);
    if (std::ranges::all_of(minima, [&](const Point& each) { return is_apart(each, found); })) minima.push_back(found);
  }
  return {minima.begin() + 1, minima.end()};
}

bool Profile::reaches_beyond(const Coordinate& number, const Interval& interval) const {
  const double value = number.of(best_);
  const double low = value - (1 + 4 * sharp) * (value - interval.low);
  const double high = value + (1 + 4 * sharp) * (interval.high - value);
  return std::ranges::any_of(points_, [&](const Point& point) {
    const double at = number.of(point.parameters);
    return point.excess < rise_ && (at < low || at > high);
  });
}

}  // namespace contensou::fit
