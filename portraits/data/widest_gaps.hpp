#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "contensou/portraits/figure.hpp"

namespace contensou::portraits {

/// Places at which a further orbit may go through a picture, each in the sector that no orbit leaves. The next orbit goes
/// through the middle of the widest gap.
/// @tparam Sector  compares
/// @tparam State   belongs to a place
template <class Sector, class State>
class WidestGaps {
 public:
  struct Seed {
    Point place;
    State state;
    Sector sector;
    double border = first;  ///< twice the distance to another sector
    double gap = first;     ///< distance to the nearest orbit of its sector, or to the border
  };

  /// @param seeds  one for each place
  /// @param unit   lengths of (1, 0) and (0, 1)
  WidestGaps(std::vector<Seed> seeds, Point unit) : seeds_(std::move(seeds)), unit_(unit) {
    for (Seed& seed : seeds_) {
      for (const Seed& other : seeds_) {
        if (other.sector != seed.sector) seed.border = std::min(seed.border, 2 * distance(seed.place, other.place));
      }
      seed.gap += seed.border;  // a sector has one orbit at least, in its middle
    }
  }

  bool empty() const { return seeds_.empty(); }
  Seed& widest() { return *std::ranges::max_element(seeds_, {}, &Seed::gap); }
  Seed& nearest(Point place) {
    return *std::ranges::min_element(seeds_, {}, [&](const Seed& seed) { return distance(seed.place, place); });
  }

  /// Takes a point of an orbit of that sector into account.
  void pass(const Sector& sector, Point point) {
    for (Seed& seed : seeds_) {
      if (seed.sector == sector) seed.gap = std::min({seed.gap, seed.border, distance(seed.place, point)});
    }
  }

  /// Forgets the places with less room than that.
  void drop_below(double gap) {
    std::erase_if(seeds_, [&](const Seed& seed) { return seed.gap < gap; });
  }

 private:
  static constexpr double first = 1e3;  ///< more than any distance in a picture
  double distance(Point a, Point b) const { return std::hypot((a.x - b.x) * unit_.x, (a.y - b.y) * unit_.y); }

  std::vector<Seed> seeds_;
  Point unit_;
};

}  // namespace contensou::portraits
