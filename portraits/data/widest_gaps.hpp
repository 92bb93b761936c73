#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "contensou/portraits/figure.hpp"

namespace contensou::portraits {

/// Places through which a further orbit of a picture may go. Each place lies in a sector that no orbit leaves, and has
/// a State. The next orbit goes through the middle of the widest gap of all sectors.
template <class Sector, class State>
class WidestGaps {
 public:
  struct Seed {
    Point place;
    State state;
    Sector sector;
    double border = first;  ///< twice the distance to the nearest place of another sector
    double gap = first;     ///< distance to the nearest orbit of the sector, at most `border`
  };

  /// @param columns, rows  numbers of places along the two sides of the panel
  /// @param seed_at        returns the seed at a place; empty if no orbit may go through the place
  /// @param unit           lengths on paper of the vectors (1, 0) and (0, 1)
  template <class SeedAt>
  WidestGaps(int columns, int rows, SeedAt seed_at, Point unit) : unit_(unit) {
    for (int i = 0; i < columns; ++i) {
      for (int j = 0; j < rows; ++j) {
        if (std::optional<Seed> seed = seed_at(Point{(i + 0.5) / columns, (j + 0.5) / rows})) seeds_.push_back(*seed);
      }
    }
    for (Seed& seed : seeds_) {
      for (const Seed& other : seeds_) {
        if (other.sector != seed.sector) seed.border = std::min(seed.border, 2 * distance(seed.place, other.place));
      }
      seed.gap += seed.border;  // the middle of each sector comes first, so that each gets an orbit
    }
  }

  bool empty() const { return seeds_.empty(); }
  Seed& widest() { return *std::ranges::max_element(seeds_, {}, &Seed::gap); }
  Seed& nearest(Point place) {
    return *std::ranges::min_element(seeds_, {}, [&](const Seed& seed) { return distance(seed.place, place); });
  }

  /// Reduces the gaps of a sector to the distances from a point of one of its orbits.
  void pass(const Sector& sector, Point point) {
    for (Seed& seed : seeds_) {
      if (seed.sector == sector) seed.gap = std::min({seed.gap, seed.border, distance(seed.place, point)});
    }
  }

  /// Removes the places whose gap is smaller than a limit.
  void drop_below(double gap) {
    std::erase_if(seeds_, [&](const Seed& seed) { return seed.gap < gap; });
  }

 private:
  static constexpr double first = 1e3;  ///< larger than any distance in a picture
  double distance(Point a, Point b) const { return std::hypot((a.x - b.x) * unit_.x, (a.y - b.y) * unit_.y); }

  std::vector<Seed> seeds_;
  Point unit_;
};

}  // namespace contensou::portraits
