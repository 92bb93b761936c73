#include "views/portrait_panel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "contensou/portraits/layout.hpp"
#include "data/round_numbers.hpp"

namespace contensou::portraits {

namespace {

constexpr std::array<unsigned, 9> viridis_steps{0x440154, 0x472d7b, 0x3b528b, 0x2c728e, 0x21918c,
                                                0x28ae80, 0x5ec962, 0xaddc30, 0xfde725};

std::vector<Colour> spread(const std::vector<Colour>& colours, std::size_t count) {
  std::vector<Colour> result;
  for (std::size_t i = 0; i < count; ++i) {
    result.push_back(colours[count == 1 ? 0 : i * (colours.size() - 1) / (count - 1)]);
  }
  return result;
}

bool inside(Point place, double margin) {
  return place.x >= margin && place.x <= 1 - margin && place.y >= margin && place.y <= 1 - margin;
}

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

Colour viridis(double fraction, double white) {
  const double place = fraction * (viridis_steps.size() - 1);
  const auto index = std::min(static_cast<std::size_t>(place), viridis_steps.size() - 2);
  const double part = place - static_cast<double>(index);
  unsigned rgb = 0;
  for (int shift : {16, 8, 0}) {
    const double low = (viridis_steps[index] >> shift) & 0xFF, high = (viridis_steps[index + 1] >> shift) & 0xFF;
    rgb |= static_cast<unsigned>(std::lround(white * 255 + (1 - white) * (low + part * (high - low)))) << shift;
  }
  return {rgb};
}

Palette palette(bool screen) {
  std::vector<Colour> times;
  constexpr int steps = 64;
  // Near the stop: on paper the darkest, on a dark screen the lightest. All have 3:1 to the ground, regions included.
  for (int i = 0; i <= steps; ++i) {
    const double fraction = static_cast<double>(i) / steps;
    times.push_back(viridis(screen ? 1 - 0.6 * fraction : 0.55 * fraction));
  }
  if (screen) {
    return {{{0x10141c}, {0xe3e8f0}, {0x9aa5b8}, 1.25, 1.15},
            {0x7fb4e6},
            {0xf0a35e},
            {0xff6f91},
            {0xe3e8f0},
            {0x6b778c},
            {0x55627a},
            {0x1a2130},
            times};
  }
  return {{}, {0x0b4f8a}, {0xc8621a}, {0xc2185b}, {0x222222}, {0x8a8f98}, {0xa9b0ba}, {0xf6f7f9}, times};
}

std::size_t TimeBands::band(double tau) const {
  return static_cast<std::size_t>(std::ranges::upper_bound(edges, tau) - edges.begin());
}

TimeBands linear_bands(const PhasePortrait& portrait, const Palette& palette) {
  double longest = 0;
  for (const PortraitOrbit& orbit : portrait.orbits) longest = std::max(longest, orbit.tau_left[0]);
  for (const PortraitOrbit& orbit : portrait.through) longest = std::max(longest, orbit.tau_left[0]);
  if (longest == 0 && portrait.highlight) longest = portrait.highlight->tau_left[0];
  if (longest == 0) longest = 1;
  constexpr std::size_t per_interval = 3;
  const double step = portrait.isochrones.empty() ? round_down(longest / 4) : portrait.isochrones.front().tau_stop;
  TimeBands bands;
  bands.edges = multiples(0, longest, step / per_interval);
  bands.colours = spread(palette.times, bands.edges.size() + 1);
  for (std::size_t band = 0; band <= bands.edges.size(); band += per_interval) {
    if (band > 0) bands.arrows.push_back((bands.begin(bands.marked.back()) + bands.begin(band)) / 2);
    bands.marked.push_back(band);
  }
  return bands;
}

TimeBands logarithmic_bands(double shortest, double longest, double unit, const Palette& palette) {
  constexpr int per_decade = 6;
  // Edges at sixths of decades in the unit that the bar is marked in.
  const int top = static_cast<int>(std::ceil(per_decade * std::log10(longest / unit)));
  TimeBands bands;
  for (int i = static_cast<int>(std::floor(per_decade * std::log10(shortest / unit))); i < top; ++i) {
    bands.edges.push_back(unit * std::pow(10, static_cast<double>(i) / per_decade));
    if (i % per_decade == 0) bands.marked.push_back(bands.edges.size());
  }
  bands.colours = spread(palette.times, bands.edges.size() + 1);
  return bands;
}

ColourBar colour_bar(const TimeBands& bands, const PortraitCaption& caption) {
  ColourBar bar{time_left(caption), bands.colours, {}};
  std::vector<double> begins;
  for (std::size_t band : bands.marked) begins.push_back(bands.begin(band) / caption.time_unit);
  const bool equal = begins.front() == 0;
  const std::vector<std::string> powers = equal ? std::vector<std::string>{} : powers_of_ten(begins);
  // Bands are equal on the bar.
  for (std::size_t i = 0; i < begins.size(); ++i) {
    bar.ticks.push_back({static_cast<double>(bands.marked[i]) / static_cast<double>(bands.colours.size()),
                         equal ? number(begins[i]) : powers[i]});
  }
  return bar;
}

std::string time_left(const PortraitCaption& caption) {
  const std::string& unit = caption.time_unit_name;
  return fmt::format("time left {}{}{}", caption.time_symbol, unit.empty() ? "" : ", ", unit);
}

std::string Drawing::speed(const std::string& name) const {
  return caption.speed_unit.empty() ? name : fmt::format("{}, {}", name, caption.speed_unit);
}

std::string law_legend(const PhasePortrait& portrait) {
  return fmt::format("law {}", literal(portrait.system().law().name()));
}

std::vector<double> ray_log_ratios(const PhasePortrait& portrait) {
  std::vector<double> ln_k;
  for (const reduction::InvariantRay& ray : portrait.plane.terminal.rays) ln_k.push_back(std::log(ray.k));
  return ln_k;
}

Instant at_log_ratio(const PortraitOrbit& curve, double ln_k) {
  for (Eigen::Index i = 1; i < curve.rows(); ++i) {
    const double before = curve.ln_k[i - 1], now = curve.ln_k[i];
    if ((before - ln_k) * (now - ln_k) > 0 || before == now) continue;
    const double fraction = std::isfinite(now) ? (ln_k - before) / (now - before) : 0;
    const auto mixed = [&](double a, double b) {
      return b > 0 ? std::exp((1 - fraction) * std::log(a) + fraction * std::log(b)) : a;
    };
    return {mixed(curve.u[i - 1], curve.u[i]), mixed(curve.v[i - 1], curve.v[i]),
            std::isfinite(curve.ln_v[i]) ? curve.ln_v[i - 1] + fraction * (curve.ln_v[i] - curve.ln_v[i - 1])
                                         : curve.ln_v[i - 1],
            ln_k, mixed(curve.tau_left[i - 1], curve.tau_left[i])};
  }
  return curve.at(curve.rows() - 2);
}

Instant instant_at(double mu, double u, double ln_v) {
  return {u, std::exp(ln_v), ln_v, ln_v - std::log(mu * std::abs(u)), 0};
}

Instant instant_at_logarithms(double mu, double ln_k, double ln_v) {
  return {std::exp(ln_v - ln_k) / mu, std::exp(ln_v), ln_v, ln_k, 0};
}

Polyline PanelMap::line(const PortraitOrbit& orbit) const {
  Polyline line;
  for (Eigen::Index i = 0; i < orbit.rows(); ++i) line.push_back(place(orbit.at(i), orbit.at(0)));
  return line;
}

Polyline PortraitPanel::line_of(const Copy& copy) const {
  const auto row = [&](Eigen::Index i) {
    Instant at = copy.orbit.at(i, copy.factor);
    at.u *= copy.sign;
    return at;
  };
  Polyline line;
  for (Eigen::Index i = 0; i < copy.orbit.rows(); ++i) line.push_back(map_.place(row(i), row(0)));
  return line;
}

Polyline PortraitPanel::line_of(const Isochrone& isochrone) const {
  Polyline line;
  for (Eigen::Index i = 0; i < isochrone.u.size(); ++i) line.push_back(place(isochrone.u[i], isochrone.v[i]));
  return line;
}

Point PortraitPanel::place(double u, double v) const {
  const Instant at{u, v, std::log(v), std::log(v / (drawing_.portrait.system().mu() * std::abs(u))), 0};
  return map_.place(at, at);
}

void PortraitPanel::add_orbits() {
  add_layers([](const PhasePortrait& of) {
    std::vector<Copy> copies;
    for (const PortraitOrbit& orbit : of.orbits) copies.push_back({orbit});
    return copies;
  });
}

void PortraitPanel::add_copies(const std::function<std::vector<Copy>(const PortraitOrbit& curve)>& copies,
                               bool mirrored) {
  const bool has_rays = !drawing_.portrait.plane.terminal.rays.empty();
  add_layers([&](const PhasePortrait& of) {
    if (has_rays || !of.plane.terminal.rays.empty()) return filling(of.flow, mirrored);
    // From so steep that it passes the whole window.
    const double steepest = std::log(of.window.v / (of.system().mu() * of.window.u)) + 7;
    return copies(traced_.emplace_back(orbit_through(of.flow, 0, 0, std::max(upstream_of_copies, steepest))));
  });
}

std::vector<PortraitPanel::Copy> PortraitPanel::filling(const reduction::Flow& flow, bool mirrored) {
  constexpr double gap_mm = 4, first = 1e3;
  constexpr std::size_t max_count = 60;
  struct Seed {
    Point at;  ///< on paper
    Instant state;
    const reduction::SimilarityCurve* sector;  ///< between two invariant half-lines, which no orbit crosses
    double border = first;                     ///< mm to another sector, twice
    double gap = first;                        ///< mm to the nearest line of its sector, or to the border
  };
  const auto distance = [mm = drawing_.panel_mm](Point a, Point b) {
    return std::hypot((a.x - b.x) * mm.x, (a.y - b.y) * mm.y);
  };
  std::vector<Seed> seeds;
  constexpr int columns = 48, rows = 32;
  for (int i = mirrored ? columns / 2 : 0; i < columns; ++i) {
    for (int j = 0; j < rows; ++j) {
      const Point at{(i + 0.5) / columns, (j + 0.5) / rows};
      if (const auto there = map_.state(from_paper(panel_, at))) {
        seeds.push_back({at, *there, flow.solution().through(there->ln_k).get()});
      }
    }
  }
  for (Seed& seed : seeds) {
    for (const Seed& other : seeds) {
      if (other.sector != seed.sector) seed.border = std::min(seed.border, 2 * distance(seed.at, other.at));
    }
    seed.gap += seed.border;  // a sector has one orbit at least, in its middle
  }
  std::vector<Copy> copies;
  while (!seeds.empty() && copies.size() < max_count) {
    const Seed widest = *std::ranges::max_element(seeds, {}, &Seed::gap);
    if (widest.gap < gap_mm) break;
    constexpr double upstream = 12;
    copies.push_back({traced_.emplace_back(orbit_through(flow, widest.state.ln_k, widest.state.ln_v, upstream))});
    for (const Polyline& part : clipped(panel_, line_of(copies.back()))) {
      for (const Point& at : on_paper_along(part, 0.01)) {
        for (Seed& seed : seeds) {
          if (seed.sector == widest.sector) seed.gap = std::min({seed.gap, seed.border, distance(seed.at, at)});
        }
      }
    }
    std::erase_if(seeds, [&](const Seed& seed) { return seed.gap < gap_mm; });
    if (mirrored) copies.push_back({traced_.back(), 1, -1});
  }
  return copies;
}

void PortraitPanel::add_layers(const std::function<std::vector<Copy>(const PhasePortrait&)>& copies) {
  const PhasePortrait& portrait = drawing_.portrait;
  if (drawing_.coloured()) {
    add_coloured(copies(portrait));
  } else {
    add_plain(copies(portrait), {drawing_.palette.orbit, 1.3, false},
              portrait.comparisons.empty() ? "orbits" : law_legend(portrait));
  }
  for (const PhasePortrait& other : portrait.comparisons) {
    add_plain(copies(other), {drawing_.palette.comparison, 1.3, true}, law_legend(other));
  }
}

void PortraitPanel::add_coloured(const std::vector<Copy>& copies) {
  // A piece of line for each band that an orbit crosses; one layer for each band, the last moments on top.
  const TimeBands& bands = drawing_.bands;
  std::map<std::size_t, std::vector<Polyline>, std::greater<>> layers;
  std::map<std::size_t, Arrows, std::greater<>> heads;
  for (const Copy& copy : copies) {
    const Polyline line = line_of(copy);
    orbits_.push_back(line);
    for (const auto& [arrow, left] : arrows_on(copy, line)) heads[bands.band(left)].arrows.push_back(arrow);
    Polyline piece{line.front()};
    std::size_t band = bands.band(copy.factor * copy.orbit.tau_left[0]);
    for (Eigen::Index i = 1; i < copy.orbit.rows(); ++i) {
      const double before = copy.factor * copy.orbit.tau_left[i - 1], now = copy.factor * copy.orbit.tau_left[i];
      const Point from = line[static_cast<std::size_t>(i) - 1], to = line[static_cast<std::size_t>(i)];
      for (; band > 0 && now < bands.begin(band); --band) {
        const Point cut = between(from, to, (before - bands.begin(band)) / (before - now));
        piece.push_back(cut);
        layers[band].push_back(std::exchange(piece, {cut}));
      }
      piece.push_back(to);
    }
    layers[band].push_back(std::move(piece));
  }
  for (auto& [band, lines] : layers) panel_.lines.push_back({std::move(lines), {bands.colours[band], 1.5, false}, ""});
  for (auto& [band, arrows] : heads) panel_.arrows.push_back({std::move(arrows.arrows), bands.colours[band]});
}

void PortraitPanel::add_plain(const std::vector<Copy>& copies, Stroke stroke, const std::string& legend) {
  Lines lines{{}, stroke, legend};
  Arrows arrows{{}, stroke.colour};
  for (const Copy& copy : copies) {
    lines.lines.push_back(line_of(copy));
    orbits_.push_back(lines.lines.back());
    if (stroke.dashed) continue;
    for (const TimedArrow& timed : arrows_on(copy, lines.lines.back())) arrows.arrows.push_back(timed.arrow);
  }
  panel_.lines.push_back(std::move(lines));
  panel_.arrows.push_back(std::move(arrows));
}

/// Heads where equal times are left, halfway between isochrones; at least one on an orbit, where it is seen best.
std::vector<PortraitPanel::TimedArrow> PortraitPanel::arrows_on(const Copy& copy, const Polyline& line) {
  using Style = PortraitStyle::Arrows;
  std::vector<TimedArrow> result;
  if (drawing_.style.arrows == Style::none) return result;
  const auto has_room = [&](const Arrow& arrow) {
    const Point at = on_paper(panel_, arrow.at);
    if (!std::isfinite(at.x) || !std::isfinite(at.y) || !inside(at, 0.03)) return false;
    const auto crowds = [&](Point other) {
      return std::hypot((other.x - at.x) * drawing_.panel_mm.x, (other.y - at.y) * drawing_.panel_mm.y) <
             keep_off_ * drawing_.letter;
    };
    if (std::ranges::any_of(heads_, crowds)) return false;
    heads_.push_back(at);
    return true;
  };
  // With the time of the nearest row.
  const auto add_there = [&](const Arrow& arrow) {
    if (!has_room(arrow)) return;
    const auto nearest =
        std::ranges::min_element(line, {}, [&](Point point) { return paper_distance(panel_, point, arrow.at); });
    result.push_back({arrow, copy.factor * copy.orbit.tau_left[nearest - line.begin()]});
  };
  if (drawing_.style.arrows == Style::time) {
    // In the order of the motion, along which the time left falls.
    const double *first = copy.orbit.tau_left.data(), *last = first + copy.orbit.rows();
    const auto is_before = [&](double left, double time) { return copy.factor * left > time; };
    for (auto time = drawing_.bands.arrows.rbegin(); time != drawing_.bands.arrows.rend(); ++time) {
      const double* row = std::lower_bound(first, last, *time, is_before);
      if (row == first || row == last) continue;
      const double before = copy.factor * row[-1], now = copy.factor * *row;
      const Point from = line[static_cast<std::size_t>(row - first) - 1],
                  to = line[static_cast<std::size_t>(row - first)];
      const Arrow arrow{between(from, to, (before - *time) / (before - now)), {to.x - from.x, to.y - from.y}};
      if (has_room(arrow)) result.push_back({arrow, *time});
    }
  }
  const std::vector<Polyline> parts = clipped(panel_, line);
  if (parts.empty()) return result;
  if (!drawing_.portrait.scale.linear() && drawing_.style.arrows == Style::time) {
    // Where it slides hardly any time passes: one there, too.
    const Arrow arrow = arrow_along(panel_, parts.front(), 0.2);
    if (on_paper(panel_, arrow.at).y > 0.6) add_there(arrow);
  }
  if (!result.empty()) return result;
  for (double fraction : {arrow_fraction_, arrow_fraction_ + 0.1, arrow_fraction_ - 0.1}) {
    add_there(arrow_along(panel_, parts.front(), fraction));
    if (!result.empty()) break;
  }
  return result;
}

void PortraitPanel::add_highlights() {
  if (!drawing_.style.asked) return;
  const PhasePortrait& portrait = drawing_.portrait;
  if (!portrait.through.empty()) {
    const Stroke stroke = asked_stroke(drawing_.palette, false);
    std::vector<Copy> copies;
    Marks points{{}, stroke.colour, 0.9, Marks::Shape::circle, through_legend};
    for (const PortraitOrbit& orbit : portrait.through) copies.push_back({orbit});
    for (const reduction::State& point : portrait.points) points.points.push_back(place(point.u, point.v));
    heads_.clear();
    add_plain(copies, stroke, through_legend);
    panel_.marks.push_back(std::move(points));
  }
  if (portrait.highlight) {
    heads_.clear();
    const Stroke stroke = asked_stroke(drawing_.palette, true);
    const std::string& legend = drawing_.caption.highlight;
    add_plain({{*portrait.highlight}}, stroke, legend);
    panel_.marks.push_back({{map_.line(*portrait.highlight).front()}, stroke.colour, 0.6, Marks::Shape::dot, legend});
  }
}

/// Points on paper along a line, no farther apart than a step.
std::vector<Point> PortraitPanel::on_paper_along(const Polyline& line, double step) const {
  std::vector<Point> points;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Point from = on_paper(panel_, line[i - 1]), to = on_paper(panel_, line[i]);
    const int pieces = 1 + static_cast<int>(std::min(1 / step, std::hypot(to.x - from.x, to.y - from.y) / step));
    for (int j = 0; j < pieces; ++j) points.push_back(between(from, to, static_cast<double>(j) / pieces));
  }
  if (!line.empty()) points.push_back(on_paper(panel_, line.back()));
  return points;
}

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
    const std::string text = number(time / drawing_.caption.time_unit);
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

void PortraitPanel::add_invariant(std::vector<Polyline> axes,
                                  const std::function<std::vector<Polyline>(double ln_k)>& ray) {
  if (!drawing_.style.invariant) return;
  const auto add_arrows = [this](const Lines& lines) {
    if (drawing_.style.arrows == PortraitStyle::Arrows::none) return;
    Arrows arrows{{}, lines.stroke.colour};
    for (const Polyline& line : lines.lines) {
      for (const Polyline& part : clipped(panel_, line)) {
        for (double fraction : {0.3, 0.7}) arrows.arrows.push_back(arrow_along(panel_, part, fraction));
      }
    }
    panel_.arrows.push_back(std::move(arrows));
  };
  if (!axes.empty()) {
    panel_.lines.push_back({std::move(axes), {drawing_.palette.invariant, 1.8, false}, "invariant axes"});
    add_arrows(panel_.lines.back());
  }
  Lines attracting{{}, {drawing_.palette.comparison, 3, false}, "invariant ray {/:Italic k} = {/:Italic k}*"};
  Lines repelling{{}, {drawing_.palette.comparison, 2.2, true}, "invariant ray that orbits leave"};
  for (const reduction::InvariantRay& of : drawing_.portrait.plane.terminal.rays) {
    Lines& lines = of.attracts_above || of.attracts_below ? attracting : repelling;
    std::ranges::move(ray(std::log(of.k)), std::back_inserter(lines.lines));
  }
  for (Lines& lines : {std::ref(attracting), std::ref(repelling)}) {
    if (lines.lines.empty()) continue;
    add_arrows(lines);
    panel_.lines.push_back(std::move(lines));
  }
}

void PortraitPanel::add_field() {
  using Field = PortraitStyle::Field;
  if (drawing_.style.field == Field::none) return;
  const reduction::ReducedSystem& system = drawing_.portrait.system();
  constexpr double cell_mm = 6.5;
  const int columns = static_cast<int>(drawing_.panel_mm.x / cell_mm),
            rows = static_cast<int>(drawing_.panel_mm.y / cell_mm);
  struct Needle {
    Point at, direction;  ///< on paper, the direction of length 1
    double size;
  };
  std::vector<Needle> needles;
  double min_size = std::numeric_limits<double>::infinity(), max_size = 0;
  for (int i = 0; i < columns; ++i) {
    for (int j = 0; j < rows; ++j) {
      const Point at{(i + 0.5) / columns, (j + 0.5) / rows};
      const auto there = map_.state(from_paper(panel_, at));
      if (!there) continue;
      const reduction::State here{there->u, there->v};
      const reduction::Rate rate =
          drawing_.style.field == Field::regularised ? system.regularised_field(here) : system.field(here);
      // A step that is small beside both speeds.
      const double fastest = std::max(std::abs(rate.u / here.u), std::abs(rate.v / here.v));
      const double h = 1e-4 / fastest;
      const Point from = on_paper(panel_, place(here.u, here.v));
      const Point to = on_paper(panel_, place(here.u + h * rate.u, here.v + h * rate.v));
      const double x = to.x - from.x, y = to.y - from.y;
      const double length = std::hypot(x, y);
      const double size = std::hypot(rate.u / drawing_.portrait.window.u, rate.v / drawing_.portrait.window.v);
      if (!(length > 0) || !(size > 0)) continue;
      min_size = std::min(min_size, size);
      max_size = std::max(max_size, size);
      needles.push_back({at, {x / length, y / length}, size});
    }
  }
  Lines lines{{},
              {drawing_.palette.field, 1, false},
              drawing_.style.field == Field::regularised ? "direction of the regularised motion (2.7)"
                                                         : "direction of the motion (2.6)"};
  Arrows heads{{}, drawing_.palette.field, 0.6};
  for (const Needle& needle : needles) {
    const double fraction = max_size > min_size ? std::log(needle.size / min_size) / std::log(max_size / min_size) : 1;
    const double cell = 1 / std::max(std::abs(needle.direction.x) * columns, std::abs(needle.direction.y) * rows);
    const double half = (0.25 + 0.6 * fraction) / 2 * cell;
    const Point tail{needle.at.x - half * needle.direction.x, needle.at.y - half * needle.direction.y};
    const Point tip{needle.at.x + half * needle.direction.x, needle.at.y + half * needle.direction.y};
    lines.lines.push_back({from_paper(panel_, tail), from_paper(panel_, tip)});
    heads.arrows.push_back(arrow_along(panel_, lines.lines.back(), 1));
  }
  panel_.lines.insert(panel_.lines.begin(), std::move(lines));
  panel_.arrows.insert(panel_.arrows.begin(), std::move(heads));
}

}  // namespace contensou::portraits
