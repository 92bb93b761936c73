// Layers of a panel: isochrones and their labels.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "contensou/portraits/layout.hpp"
#include "data/round_numbers.hpp"
#include "views/panel_layers.hpp"

namespace contensou::portraits {

namespace {

/// Compares rooms. If two are equal up to rounding, the first wins, because portraits have two equal halves.
bool is_more(double room, double than) { return room > than * (1 + 1e-9); }

/// The place with most room for a label of a given size. Room is the distance from the points that the label avoids, in
/// half widths or half heights of the label. Other labels only need to be far enough away.
class LabelPlace {
 public:
  LabelPlace(double half_width, double half_height) : half_width_(half_width), half_height_(half_height) {}

  /// Tries a place.
  /// @param points  points on paper by increasing x
  /// @param labels  places of other labels on paper, which have about the same size and need more room
  /// @param middle  x of a line to avoid
  void try_at(Point at, const std::vector<Point>& points, const std::vector<Point>& labels, double middle) {
    constexpr double spare = 2.2;
    double room = std::min(max_room, std::abs(middle - at.x) / half_width_);
    for (const Point& other : labels) room = std::min(room, distance(at, other) / spare);
    if (room < 1) return;
    // A place that touches the border is the last choice.
    constexpr double over = 0.05;
    const double edge = std::min(std::min(at.x, 1 - at.x) / half_width_, std::min(at.y, 1 - at.y) / half_height_);
    room = std::min(room, std::max(edge, over));
    if (!is_more(room, best_)) return;
    // Search from the nearest x in both directions. Points whose x is farther away than the room found have no effect.
    const auto here = std::ranges::lower_bound(points, at.x, {}, &Point::x);
    const auto matters = [&](Point other) {
      return is_more(room, best_) && std::abs(other.x - at.x) < room * half_width_;
    };
    for (auto other = here; other != points.end() && matters(*other); ++other)
      room = std::min(room, distance(at, *other));
    for (auto other = here; other != points.begin() && matters(*--other);) room = std::min(room, distance(at, *other));
    if (!is_more(room, best_)) return;
    best_ = room;
    where_ = at;
  }

  bool found() const { return best_ > 0; }
  bool has_room() const { return best_ >= 1; }
  Point where() const { return where_; }

 private:
  static constexpr double max_room = 2;  ///< more room than this is no advantage

  double distance(Point a, Point b) const {
    return std::max(std::abs(a.x - b.x) / half_width_, std::abs(a.y - b.y) / half_height_);
  }

  double half_width_, half_height_;
  double best_ = 0;
  Point where_{};
};

}  // namespace

/// Returns points on paper that labels avoid, by increasing x: orbits, also those drawn later on top, and arrows.
std::vector<Point> PanelLayers::obstacles() const {
  std::vector<Point> points = heads_;
  const auto add = [&](const Polyline& line) {
    std::ranges::copy(on_paper_along(line, 0.01), std::back_inserter(points));
  };
  std::ranges::for_each(orbits_, add);
  for (const auto* asked : {&look_.curves.through, &look_.curves.highlight}) {
    for (const PortraitOrbit& orbit : *asked) add(map_.line(orbit));
  }
  std::erase_if(points, [](Point point) { return !inside(point, -1); });
  std::ranges::sort(points, {}, &Point::x);
  return points;
}

void PanelLayers::add_isochrones(double middle) {
  const std::vector<Isochrone>& pieces = look_.curves.isochrones;
  if (pieces.empty()) return;
  Lines lines{{}, {look_.palette.isochrone, 1.1, true}, time_left(look_.caption)};
  const std::vector<Point> points = obstacles();
  std::vector<Point> labels;
  for (auto piece = pieces.begin(); piece != pieces.end();) {
    const double time = piece->tau_stop;
    const Text text = number(time / look_.caption.time_unit);
    // Labels stand on the right if there is room, so that numbers stand above one another; else anywhere, or on a line.
    LabelPlace right(look_.letter * (0.45 * text_width(text) + 0.15) / look_.panel_mm.x,
                     look_.letter * 0.7 / look_.panel_mm.y);
    LabelPlace anywhere = right;
    for (; piece != pieces.end() && piece->tau_stop == time; ++piece) {
      const Polyline& line = lines.lines.emplace_back(line_of(*piece));
      for (const Point& at : on_paper_along(line, 0.004)) {
        if (!inside(at, 0)) continue;
        if (at.x > middle) right.try_at(at, points, labels, middle);
        anywhere.try_at(at, points, labels, middle);
      }
    }
    const LabelPlace& place = right.has_room() ? right : anywhere;
    if (!place.found()) continue;
    labels.push_back(place.where());
    panel_.labels.push_back({from_paper(panel_, place.where()), text, look_.palette.theme.faint, Label::Align::centre});
  }
  panel_.lines.insert(panel_.lines.begin(), std::move(lines));
}

}  // namespace contensou::portraits
