// Layers of a portrait's panel: isochrones, and where their labels have room.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "contensou/portraits/layout.hpp"
#include "data/round_numbers.hpp"
#include "views/portrait_panel.hpp"

namespace contensou::portraits {

namespace {

/// Of places with equal room the first, whatever the last digits: portraits have two equal halves.
bool is_more(double room, double than) { return room > than * (1 + 1e-9); }

/// Where a label of that size has most room: the candidate that is farthest, in half widths or half heights, from
/// points that it keeps off.
class LabelPlace {
 public:
  LabelPlace(double half_width, double half_height) : half_width_(half_width), half_height_(half_height) {}

  /// @param points     on paper, by growing x
  /// @param labels     on paper; others of about the same size, which need more room
  /// @param middle     x of a line to keep off
  void try_at(Point at, const std::vector<Point>& points, const std::vector<Point>& labels, double middle) {
    constexpr double spare = 2.2;
    double room = std::min(max_room, std::abs(middle - at.x) / half_width_);
    for (const Point& other : labels) room = std::min(room, distance(at, other) / spare);
    if (!is_more(room, best_)) return;
    // From the nearest along x on, both ways: what is farther along x than the room that is left does not matter.
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

  bool found() const { return best_ >= 1; }
  Point where() const { return where_; }

 private:
  static constexpr double max_room = 2;  ///< beyond which nobody looks

  double distance(Point a, Point b) const {
    return std::max(std::abs(a.x - b.x) / half_width_, std::abs(a.y - b.y) / half_height_);
  }

  double half_width_, half_height_;
  double best_ = 0;
  Point where_{};
};

}  // namespace

/// Points on paper that labels keep off, by growing x: orbits, also those that are drawn later on top, and arrows.
std::vector<Point> PortraitPanel::obstacles() const {
  std::vector<Point> points = heads_;
  std::vector<Polyline> crossed = orbits_;
  for (const PortraitOrbit& orbit : drawing_.portrait.through) crossed.push_back(line_of({orbit}));
  if (drawing_.portrait.highlight) crossed.push_back(line_of({*drawing_.portrait.highlight}));
  for (const Polyline& orbit : crossed) std::ranges::copy(on_paper_along(orbit, 0.01), std::back_inserter(points));
  std::erase_if(points, [](Point point) { return !inside(point, -1); });
  std::ranges::sort(points, {}, &Point::x);
  return points;
}

void PortraitPanel::add_isochrones() {
  const std::vector<Isochrone>& isochrones = drawing_.portrait.isochrones;
  if (isochrones.empty()) return;
  Lines lines{{}, {drawing_.palette.isochrone, 1.1, true}, time_left(drawing_.caption)};
  const std::vector<Point> points = obstacles();
  std::vector<Point> labels;
  const double middle = panel_.x.low < 0 ? on_paper(panel_, {0, 0}).x : -1;
  for (auto piece = isochrones.begin(); piece != isochrones.end();) {
    const double time = piece->tau_stop;
    const Text text = number(time / drawing_.caption.time_unit);
    LabelPlace place(drawing_.letter * (0.45 * text_width(text) + 0.15) / drawing_.panel_mm.x,
                     drawing_.letter * 0.7 / drawing_.panel_mm.y);
    for (; piece != isochrones.end() && piece->tau_stop == time; ++piece) {
      const Polyline line = line_of(*piece);
      for (const Point& at : on_paper_along(line, 0.004)) {
        if (inside(at, 0.05)) place.try_at(at, points, labels, middle);
      }
      lines.lines.push_back(line);
    }
    if (!place.found()) continue;
    labels.push_back(place.where());
    panel_.labels.push_back(
        {from_paper(panel_, place.where()), text, drawing_.palette.theme.faint, Label::Align::centre});
  }
  panel_.lines.insert(panel_.lines.begin(), lines);
  for (const PhasePortrait& other : drawing_.portrait.comparisons) {
    Lines its_lines{{}, {drawing_.palette.comparison, 1.3, false, true}, lines.legend + ", " + law_legend(other)};
    for (const Isochrone& isochrone : other.isochrones) its_lines.lines.push_back(line_of(isochrone));
    panel_.lines.insert(panel_.lines.begin(), std::move(its_lines));
  }
}

}  // namespace contensou::portraits
