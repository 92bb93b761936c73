#include "contensou/si/load_history.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

namespace contensou::si {

LoadHistory::LoadHistory(std::vector<double> t, std::vector<double> load) : t_(std::move(t)), load_(std::move(load)) {
  if (t_.size() != load_.size() || t_.size() < 2)
    throw std::domain_error("a load that changes has two instants or more, and a load for each");
  for (std::size_t i = 0; i < t_.size(); ++i) {
    if (!(std::isfinite(t_[i]) && (i == 0 ? t_[i] == 0 : t_[i] >= t_[i - 1])))
      throw WrongLoad(i, fmt::format("t must begin with 0 and not decrease, in s; got {}", t_[i]));
    if (!(std::isfinite(load_[i]) && load_[i] >= 0))
      throw WrongLoad(i, fmt::format("a load must be 0 or more, in N; got {}", load_[i]));
    if (nominal_ == 0) nominal_ = load_[i];
  }
  if (nominal_ == 0) throw std::domain_error("the load is 0 at every instant: nothing presses the body down");
  clock_.push_back(0);
  for (std::size_t i = 1; i < t_.size(); ++i)
    clock_.push_back(clock_.back() + (load_[i - 1] + load_[i]) / nominal_ * (t_[i] - t_[i - 1]) / 2);
}

double LoadHistory::clock(double t) const {
  const auto after = std::ranges::upper_bound(t_, t);
  const auto i = static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - t_.begin(), 1) - 1);
  const double passed = t - t_[i];
  const bool last = after == t_.end();
  const double slope = last ? 0 : (load_[i + 1] - load_[i]) / (t_[i + 1] - t_[i]);
  return clock_[i] + (load_[i] + slope * passed / 2) / nominal_ * passed;
}

double LoadHistory::time_of(double clock) const {
  const auto after = std::ranges::lower_bound(clock_, clock);
  const auto i = static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - clock_.begin(), 1) - 1);
  const double missing = (clock - clock_[i]) * nominal_;
  if (missing <= 0) return t_[i];
  const bool last = after == clock_.end();
  if (last) return load_.back() > 0 ? t_.back() + missing / load_.back() : std::numeric_limits<double>::infinity();
  const double slope = (load_[i + 1] - load_[i]) / (t_[i + 1] - t_[i]);
  // The time passed is the smaller solution of load passed + (dload/dt) passed^2/2 = missing, without cancellation.
  const double root = std::sqrt(std::max(0.0, load_[i] * load_[i] + 2 * slope * missing));
  return std::min(t_[i + 1], t_[i] + 2 * missing / (load_[i] + root));
}

}  // namespace contensou::si
