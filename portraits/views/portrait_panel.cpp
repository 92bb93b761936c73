#include "views/portrait_panel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "contensou/portraits/layout.hpp"

namespace contensou::portraits {

namespace {

/// Viridis: from dark to light in steps that eyes of any kind see as equal.
constexpr std::array<unsigned, 9> viridis{0x440154, 0x472d7b, 0x3b528b, 0x2c728e, 0x21918c,
                                          0x28ae80, 0x5ec962, 0xaddc30, 0xfde725};

Colour viridis_at(double share) {
  const double place = share * (viridis.size() - 1);
  const auto index = std::min(static_cast<std::size_t>(place), viridis.size() - 2);
  const double part = place - static_cast<double>(index);
  unsigned rgb = 0;
  for (int shift : {16, 8, 0}) {
    const double low = (viridis[index] >> shift) & 0xFF, high = (viridis[index + 1] >> shift) & 0xFF;
    rgb |= static_cast<unsigned>(std::lround(low + part * (high - low))) << shift;
  }
  return {rgb};
}

std::vector<Colour> spread(const std::vector<Colour>& colours, std::size_t count) {
  std::vector<Colour> result;
  for (std::size_t i = 0; i < count; ++i) {
    result.push_back(colours[count == 1 ? 0 : i * (colours.size() - 1) / (count - 1)]);
  }
  return result;
}

Point between(Point a, Point b, double share) { return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)}; }

bool inside(Point place, double margin) {
  return place.x >= margin && place.x <= 1 - margin && place.y >= margin && place.y <= 1 - margin;
}

/// Points on paper that a label of some size keeps off, sorted into cells so that only near ones are asked.
class Obstacles {
 public:
  /// Room beyond which nobody looks, in half sizes of the label.
  static constexpr double most = 2;

  Obstacles(const std::vector<Point>& points, double half_width, double half_height)
      : half_width_(half_width), half_height_(half_height), cells_(columns() * rows()) {
    for (const Point& point : points) {
      if (inside(point, -most * std::max(half_width, half_height)))
        cells_[cell(column(point.x), row(point.y))].push_back(point);
    }
  }

  /// How far a place is from the nearest point, in half widths or half heights, whichever is more; not looked for
  /// further once it is less than enough.
  double room(Point at, double enough) const {
    double room = most;
    for (int i = column(at.x) - 1; i <= column(at.x) + 1; ++i) {
      for (int j = row(at.y) - 1; j <= row(at.y) + 1; ++j) {
        if (i < 0 || j < 0 || i >= columns() || j >= rows()) continue;
        if (room < enough) return room;
        for (const Point& other : cells_[cell(i, j)]) {
          room =
              std::min(room, std::max(std::abs(other.x - at.x) / half_width_, std::abs(other.y - at.y) / half_height_));
        }
      }
    }
    return room;
  }

 private:
  // The paper and one cell around it.
  int columns() const { return static_cast<int>(1 / (most * half_width_)) + 3; }
  int rows() const { return static_cast<int>(1 / (most * half_height_)) + 3; }
  int column(double x) const { return place(x / (most * half_width_), columns()); }
  int row(double y) const { return place(y / (most * half_height_), rows()); }
  static int place(double cells, int count) {
    return std::clamp(static_cast<int>(std::floor(cells)) + 1, 0, count - 1);
  }
  std::size_t cell(int i, int j) const { return static_cast<std::size_t>(i * rows() + j); }

  double half_width_, half_height_;
  std::vector<std::vector<Point>> cells_;
};

}  // namespace

Palette palette(bool screen) {
  std::vector<Colour> times;
  constexpr int steps = 64;
  // Near the stop: on paper the darkest, on a dark screen the lightest.
  for (int i = 0; i <= steps; ++i) {
    const double share = static_cast<double>(i) / steps;
    times.push_back(viridis_at(screen ? 1 - 0.65 * share : 0.8 * share));
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
  const double longest = [&] {
    double most = 0;
    for (const PortraitOrbit& orbit : portrait.orbits) most = std::max(most, orbit.tau_left[0]);
    for (const PortraitOrbit& orbit : portrait.through) most = std::max(most, orbit.tau_left[0]);
    if (most == 0 && portrait.highlight) most = portrait.highlight->tau_left[0];
    return most > 0 ? most : 1.0;
  }();
  constexpr int per_interval = 3;
  const double step = portrait.isochrones.empty() ? round_down(longest / 4) : portrait.isochrones.front().tau_stop;
  TimeBands bands;
  for (int i = 1; i * step / per_interval < longest; ++i) bands.edges.push_back(i * step / per_interval);
  for (int i = 0; i * step < longest; ++i) bands.marked.push_back(i * step);
  bands.colours = spread(palette.times, bands.edges.size() + 1);
  return bands;
}

double stop_time(const PhasePortrait& portrait, double u, double v) {
  const double w = portrait.system.mu() * std::abs(u);
  const auto row = std::min((portrait.profile.ln_k < std::log(v / w)).count(), portrait.profile.ln_k.size() - 1);
  return std::hypot(w, v) * portrait.profile.tau[row];
}

TimeBands logarithmic_bands(double shortest, double longest, double unit, const Palette& palette) {
  constexpr int per_decade = 6;
  // Edges at sixths of decades in the unit that the bar is marked in.
  const int top = static_cast<int>(std::ceil(per_decade * std::log10(longest / unit)));
  const int count = top - static_cast<int>(std::floor(per_decade * std::log10(shortest / unit)));
  TimeBands bands;
  bands.linear = false;
  for (int i = top - count; i < top; ++i) {
    bands.edges.push_back(unit * std::pow(10, static_cast<double>(i) / per_decade));
    if (i % per_decade == 0) bands.marked.push_back(bands.edges.back());
  }
  bands.colours = spread(palette.times, bands.edges.size() + 1);
  return bands;
}

ColourBar colour_bar(const TimeBands& bands, const PortraitCaption& caption) {
  ColourBar bar{fmt::format("time left{}{}", caption.time_unit_name.empty() ? "" : ", ", caption.time_unit_name),
                bands.colours,
                {}};
  // Bands are equal on the bar; a time is where its band begins.
  const double count = static_cast<double>(bands.colours.size());
  for (double time : bands.marked) {
    const auto edge = std::ranges::find_if(bands.edges, [&](double e) { return e > time * (1 - 1e-9); });
    double at = static_cast<double>(edge - bands.edges.begin() + 1) / count;
    if (time == 0) at = 0;
    if (edge == bands.edges.end()) at = 1;
    bar.ticks.push_back({at, number(time / caption.time_unit)});
  }
  return bar;
}

std::string Drawing::speed(const std::string& name) const {
  return caption.speed_unit.empty() ? name : fmt::format("{}, {}", name, caption.speed_unit);
}

std::string number(double value) {
  if (value == 0) return "0";
  const double exponent = std::floor(std::log10(std::abs(value)) + 1e-9);
  if (exponent >= -3 && exponent < 5) return fmt::format("{:.5g}", value);
  const double mantissa = value / std::pow(10, exponent);
  if (std::abs(mantissa - 1) < 1e-6) return fmt::format("10^{{{}}}", exponent);
  return fmt::format("{:.3g}·10^{{{}}}", mantissa, exponent);
}

Polyline PortraitPanel::line_of(const Copy& copy) const {
  Polyline line;
  for (Eigen::Index i = 0; i < copy.orbit.rows(); ++i) {
    Instant instant = copy.orbit.at(i, copy.factor);
    // Also at rest, where u is 0, the side that the orbit comes from.
    instant.u = std::copysign(instant.u, copy.sign * copy.orbit.u[0]);
    line.push_back(place_(instant));
  }
  return line;
}

std::string law_legend(const PhasePortrait& portrait) {
  return fmt::format("law {}", literal(portrait.system.law().name()));
}

void PortraitPanel::add_orbits(const std::function<std::vector<Copy>(const PhasePortrait&)>& copies) {
  const PhasePortrait& portrait = drawing_.portrait;
  if (drawing_.coloured()) {
    add_coloured(copies(portrait));
  } else {
    add_plain(copies(portrait), {drawing_.palette.orbit, 1.3, false},
              portrait.against.empty() ? "orbits" : law_legend(portrait));
  }
  for (const PhasePortrait& rival : portrait.against) {
    add_plain(copies(rival), {drawing_.palette.rival, 1.3, true}, law_legend(rival));
  }
}

void PortraitPanel::add_coloured(const std::vector<Copy>& copies) {
  // A piece of line for each band that an orbit crosses; one layer for each band, the last moments on top.
  std::map<std::size_t, std::vector<Polyline>, std::greater<>> layers;
  std::map<std::size_t, Arrows, std::greater<>> heads;
  for (const Copy& copy : copies) {
    const Polyline line = line_of(copy);
    orbits_.push_back(line);
    if (drawing_.style.arrows != PortraitStyle::Arrows::none) {
      Arrows arrows;
      add_arrows(copy, arrows);
      for (const Arrow& arrow : arrows.arrows) {
        // The colour of the nearest row.
        std::size_t nearest = 0;
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < line.size(); ++i) {
          const double gap = paper_distance(panel_, line[i], arrow.at);
          if (gap < least) {
            least = gap;
            nearest = i;
          }
        }
        const std::size_t band =
            drawing_.bands.band(copy.factor * copy.orbit.tau_left[static_cast<Eigen::Index>(nearest)]);
        heads[band].colour = drawing_.bands.colours[band];
        heads[band].arrows.push_back(arrow);
      }
    }
    Polyline piece{line.front()};
    std::size_t band = drawing_.bands.band(copy.factor * copy.orbit.tau_left[0]);
    for (Eigen::Index i = 1; i < copy.orbit.rows(); ++i) {
      const double before = copy.factor * copy.orbit.tau_left[i - 1], now = copy.factor * copy.orbit.tau_left[i];
      const Point from = line[static_cast<std::size_t>(i) - 1], to = line[static_cast<std::size_t>(i)];
      for (; band > 0 && now < drawing_.bands.edges[band - 1]; --band) {
        const Point cut = between(from, to, (before - drawing_.bands.edges[band - 1]) / (before - now));
        piece.push_back(cut);
        layers[band].push_back(std::exchange(piece, {cut}));
      }
      piece.push_back(to);
    }
    layers[band].push_back(std::move(piece));
  }
  for (auto& [band, lines] : layers) {
    panel_.lines.push_back({std::move(lines), {drawing_.bands.colours[band], 1.5, false}, ""});
  }
  for (auto& [band, arrows] : heads) panel_.arrows.push_back(std::move(arrows));
}

void PortraitPanel::add_plain(const std::vector<Copy>& copies, Stroke stroke, const std::string& legend) {
  Lines lines{{}, stroke, legend};
  Arrows arrows{{}, stroke.colour};
  for (const Copy& copy : copies) {
    lines.lines.push_back(line_of(copy));
    orbits_.push_back(lines.lines.back());
    if (!stroke.dashed && drawing_.style.arrows != PortraitStyle::Arrows::none) add_arrows(copy, arrows);
  }
  panel_.lines.push_back(std::move(lines));
  panel_.arrows.push_back(std::move(arrows));
}

/// Heads where equal times are left, halfway between isochrones; at least one on an orbit, where it is seen best.
void PortraitPanel::add_arrows(const Copy& copy, Arrows& arrows) {
  const Polyline line = line_of(copy);
  const auto add = [&](const Arrow& arrow) {
    const Point place = on_paper(panel_, arrow.at);
    if (!std::isfinite(place.x) || !std::isfinite(place.y) || !inside(place, 0.03)) return false;
    const auto crowds = [&](Point other) { return std::hypot(other.x - place.x, other.y - place.y) < keep_off_; };
    if (std::ranges::any_of(heads_, crowds)) return false;
    heads_.push_back(place);
    arrows.arrows.push_back(arrow);
    return true;
  };
  bool any = false;
  if (drawing_.style.arrows == PortraitStyle::Arrows::time && drawing_.bands.linear &&
      drawing_.bands.marked.size() > 1) {
    std::vector<double> times;
    for (std::size_t i = 1; i < drawing_.bands.marked.size(); ++i) {
      times.push_back((drawing_.bands.marked[i - 1] + drawing_.bands.marked[i]) / 2);
    }
    for (Eigen::Index i = 1; i < copy.orbit.rows(); ++i) {
      const double before = copy.factor * copy.orbit.tau_left[i - 1], now = copy.factor * copy.orbit.tau_left[i];
      const Point from = line[static_cast<std::size_t>(i) - 1], to = line[static_cast<std::size_t>(i)];
      for (double time : times) {
        if (!(now <= time && time < before)) continue;
        if (add({between(from, to, (before - time) / (before - now)), {to.x - from.x, to.y - from.y}})) any = true;
      }
    }
  }
  if (any) return;
  const std::vector<Polyline> parts = clipped(panel_, line);
  if (parts.empty()) return;
  for (double share : {arrow_share_, arrow_share_ + 0.1, arrow_share_ - 0.1}) {
    if (add(arrow_along(panel_, parts.front(), share))) return;
  }
}

void PortraitPanel::add_highlights() {
  if (!drawing_.style.asked) return;
  const PhasePortrait& portrait = drawing_.portrait;
  Stroke stroke{drawing_.palette.highlight, 2.6, false};
  if (!portrait.through.empty()) {
    std::vector<Copy> copies;
    for (const PortraitOrbit& orbit : portrait.through) copies.push_back({orbit});
    heads_.clear();
    add_plain(copies, stroke, "through the points given");
  }
  if (portrait.highlight) {
    heads_.clear();
    add_plain({{*portrait.highlight}}, stroke, drawing_.caption.highlight);
    panel_.marks.push_back({{place_(portrait.highlight->at(0))}, stroke.colour});
  }
}

std::vector<Polyline> PortraitPanel::isochrone(const PhasePortrait& portrait, double time) const {
  const StopProfile& profile = portrait.profile;
  std::vector<Polyline> parts;
  for (double sign : {1.0, -1.0}) {
    Polyline line;
    for (Eigen::Index i = 0; i < profile.ln_k.size(); ++i) {
      const double size = time / profile.tau[i];
      const double angle = std::atan(std::exp(profile.ln_k[i]));
      const double u = i + 1 == profile.ln_k.size() ? 0 : size * std::cos(angle) / portrait.system.mu();
      const double v = size * std::sin(angle);
      line.push_back(place_({sign * u, v, std::log(v), profile.ln_k[i], time}));
    }
    for (Polyline& part : clipped(panel_, line)) parts.push_back(std::move(part));
  }
  return parts;
}

void PortraitPanel::add_rival_isochrones(const std::vector<double>& times, const PhasePortrait& rival) {
  Lines lines{{}, {drawing_.palette.rival, 0.8, true}, ""};
  for (double time : times) {
    for (Polyline& part : isochrone(rival, time)) lines.lines.push_back(std::move(part));
  }
  panel_.lines.insert(panel_.lines.begin(), std::move(lines));
}

void PortraitPanel::add_isochrones(const std::vector<double>& times) {
  if (times.empty()) return;
  std::vector<Point> obstacles = heads_;
  std::vector<Polyline> crossed = orbits_;
  // Those asked for are drawn later, on top.
  for (const PortraitOrbit& orbit : drawing_.portrait.through) crossed.push_back(line_of({orbit}));
  if (drawing_.portrait.highlight) crossed.push_back(line_of({*drawing_.portrait.highlight}));
  for (const Polyline& orbit : crossed) {
    for (std::size_t i = 1; i < orbit.size(); ++i) {
      const Point a = on_paper(panel_, orbit[i - 1]), b = on_paper(panel_, orbit[i]);
      const int pieces = 1 + static_cast<int>(std::min(100.0, std::hypot(a.x - b.x, a.y - b.y) / 0.01));
      for (int j = 0; j <= pieces; ++j) obstacles.push_back(between(a, b, static_cast<double>(j) / pieces));
    }
  }
  Lines lines{{},
              {drawing_.palette.isochrone, 1.1, true},
              fmt::format("time left {}{}{}", drawing_.caption.time_symbol,
                          drawing_.caption.time_unit_name.empty() ? "" : ", ", drawing_.caption.time_unit_name)};
  std::optional<Obstacles> near;  // for labels of one width
  double width_of_near = 0;
  for (double time : times) {
    Polyline candidates;
    for (Polyline& part : isochrone(drawing_.portrait, time)) {
      // Finely, for the label.
      for (std::size_t i = 1; i < part.size(); ++i) {
        const int pieces = 1 + static_cast<int>(paper_distance(panel_, part[i - 1], part[i]) / 0.004);
        for (int j = 0; j < pieces; ++j) {
          candidates.push_back(between(part[i - 1], part[i], static_cast<double>(j) / pieces));
        }
      }
      lines.lines.push_back(std::move(part));
    }
    const std::string text = number(time / drawing_.caption.time_unit);
    const double letters = drawing_.palette.theme.letters;
    const double half_width = letters * (0.75 * static_cast<double>(shown_length(text)) + 0.4) / drawing_.panel_mm.x;
    const double half_height = letters * 1.9 / drawing_.panel_mm.y;
    if (!near || half_width != width_of_near) {
      near.emplace(obstacles, half_width, half_height);
      width_of_near = half_width;
    }
    double best = 0;
    Point where{};
    for (const Point& candidate : candidates) {
      const Point at = on_paper(panel_, candidate);
      if (!inside(at, 0.05)) continue;
      double room = Obstacles::most;
      for (const Label& label : panel_.labels) {
        const Point other = on_paper(panel_, label.at);
        constexpr double spare = 2.2;
        room = std::min(room, std::max(std::abs(other.x - at.x) / (half_width * spare),
                                       std::abs(other.y - at.y) / (half_height * spare)));
      }
      // The axis u = 0.
      if (panel_.x.low < 0) room = std::min(room, std::abs(on_paper(panel_, {0, 0}).x - at.x) / half_width);
      // Of places with equal room the first, whatever the last digits: portraits have two equal halves.
      constexpr double same = 1e-9;
      if (room > best * (1 + same)) room = std::min(room, near->room(at, best));
      if (room > best * (1 + same)) {
        best = room;
        where = candidate;
      }
    }
    if (best >= 1) panel_.labels.push_back({where, text, drawing_.palette.theme.faint, Label::Align::centre});
  }
  panel_.lines.insert(panel_.lines.begin(), std::move(lines));
}

void PortraitPanel::add_invariant(std::vector<Polyline> axes,
                                  const std::function<std::vector<Polyline>(double ln_k)>& ray) {
  if (!drawing_.style.invariant) return;
  if (!axes.empty()) {
    panel_.lines.push_back({std::move(axes), {drawing_.palette.invariant, 2.2, false}, "invariant axes"});
  }
  Lines attracting{{}, {drawing_.palette.rival, 2.2, false}, "invariant ray {/:Italic k} = {/:Italic k}*"};
  Lines repelling{{}, {drawing_.palette.rival, 2.2, true}, "invariant ray that orbits leave"};
  for (const reduction::InvariantRay& of : drawing_.portrait.plane.terminal.rays) {
    Lines& lines = of.attracts_above || of.attracts_below ? attracting : repelling;
    std::ranges::move(ray(std::log(of.k)), std::back_inserter(lines.lines));
  }
  for (Lines& lines : {std::ref(attracting), std::ref(repelling)}) {
    if (!lines.lines.empty()) panel_.lines.push_back(std::move(lines));
  }
}

void PortraitPanel::add_field(const std::function<reduction::State(Point)>& state) {
  using Field = PortraitStyle::Field;
  if (drawing_.style.field == Field::none) return;
  const reduction::ReducedSystem& system = drawing_.portrait.system;
  constexpr int columns = 24, rows = 15;
  struct Needle {
    Point at, direction;  ///< on paper, the direction of length 1
    double size;
  };
  std::vector<Needle> needles;
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (int i = 0; i < columns; ++i) {
    for (int j = 0; j < rows; ++j) {
      const Point at{(i + 0.5) / columns, (j + 0.5) / rows};
      const reduction::State here = state(from_paper(panel_, at));
      if (here.u == 0 && here.v == 0) continue;
      const reduction::Rate rate =
          drawing_.style.field == Field::regularised ? system.regularised_field(here) : system.field(here);
      const auto instant = [&](double u, double v) {
        return Instant{u, v, std::log(v), std::log(v / (system.mu() * std::abs(u))), 0};
      };
      // A step that is small beside both speeds.
      const double fastest = std::max(std::abs(rate.u / here.u), std::abs(rate.v / here.v));
      const double h = 1e-4 / fastest;
      const Point from = on_paper(panel_, place_(instant(here.u, here.v)));
      const Point to = on_paper(panel_, place_(instant(here.u + h * rate.u, here.v + h * rate.v)));
      const double x = to.x - from.x, y = to.y - from.y;
      const double length = std::hypot(x, y);
      const double size = std::hypot(rate.u / drawing_.portrait.window.u, rate.v / drawing_.portrait.window.v);
      if (!(length > 0) || !(size > 0)) continue;
      least = std::min(least, size);
      most = std::max(most, size);
      needles.push_back({at, {x / length, y / length}, size});
    }
  }
  Lines lines{{},
              {drawing_.palette.field, 1, false},
              drawing_.style.field == Field::regularised ? "direction of (2.7)" : "direction of (2.6)"};
  for (const Needle& needle : needles) {
    const double share = most > least ? std::log(needle.size / least) / std::log(most / least) : 1;
    const double cell = 1 / std::max(std::abs(needle.direction.x) * columns, std::abs(needle.direction.y) * rows);
    const double half = (0.25 + 0.6 * share) / 2 * cell;
    const Point tail{needle.at.x - half * needle.direction.x, needle.at.y - half * needle.direction.y};
    const Point tip{needle.at.x + half * needle.direction.x, needle.at.y + half * needle.direction.y};
    lines.lines.push_back({from_paper(panel_, tail), from_paper(panel_, tip)});
  }
  panel_.lines.insert(panel_.lines.begin(), std::move(lines));
}

}  // namespace contensou::portraits
