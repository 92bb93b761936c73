// The plane of any planar system as a drawing.
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "contensou/portraits/layout.hpp"
#include "contensou/portraits/planar_portrait.hpp"
#include "contensou/reduction/detail/infinity.hpp"
#include "data/planar_window.hpp"
#include "data/tracing.hpp"
#include "views/panel_layers.hpp"

namespace contensou::portraits {

using Eigen::Vector2d;

namespace {

/// Adds rays in the direction of the motion, between the border of the panel and the centre.
/// @param slopes  true for y' = F(x, y)
void add_rays(PanelLayers& layers, const PlanarPortrait& portrait, const Palette& palette, bool slopes) {
  const auto& [low, high] = portrait.window;
  const reduction::PlanarReduction& plane = portrait.plane;
  double highest = 0;
  for (const Vector2d& corner : {low, high, Vector2d(low[0], high[1]), Vector2d(high[0], low[1])}) {
    const double p = plane.canonical(corner).p;
    if (std::isfinite(p)) highest = std::max(highest, p);
  }
  Lines attracting{
      {}, {palette.comparison, 2.6}, slopes ? "solution that others approach" : "ray that orbits approach"};
  Lines others{{}, {palette.comparison, 2, true}, slopes ? "solution that others leave" : "ray that orbits leave"};
  // A double ray attracts orbits from one side. Beside a line of equilibria orbits end before they come to a ray.
  Lines plain{{}, others.stroke, slopes ? "invariant solution" : "invariant ray"};
  const bool ends_before = std::ranges::any_of(plane.rays(), [](const auto& ray) { return ray.radial == 0; });
  for (const auto& ray : plane.rays()) {
    // Parts of switching curves and lines of equilibria are drawn as such.
    if (ray.order == 0 || ray.radial == 0) continue;
    Polyline line{{plane.centre()[0], plane.centre()[1]}};
    constexpr int pieces = 200;
    constexpr double deep = 20;
    for (int i = 0; i <= pieces; ++i) {
      const Vector2d x = plane.point(ray.q, highest + 1 - deep + deep * i / pieces);
      line.push_back({x[0], x[1]});
    }
    if (ray.to_centre) std::ranges::reverse(line);
    (ray.attracts ? attracting : ray.order == 2 || ends_before ? plain : others).lines.push_back(std::move(line));
  }
  layers.add_invariant(std::move(plain));
  layers.add_invariant(std::move(others));
  layers.add_invariant(std::move(attracting));
}

/// Adds the parts of switching curves along which motions slide, at which they rest, and which they leave to both
/// sides.
void add_switching(PanelLayers& layers, const std::vector<SwitchingPart>& parts, const Palette& palette) {
  using Kind = reduction::SwitchingMotion::Kind;
  Lines slides{{}, {palette.invariant, 3}, "sliding along a jump"}, rests{{}, {palette.invariant, 6}, "rest"};
  Lines leaves{{}, {palette.invariant, 2, true}, "jump with motions to both sides"};
  for (const SwitchingPart& part : parts) {
    Polyline line;
    for (const Vector2d& x : part.points) line.push_back({x[0], x[1]});
    (part.motion == Kind::slides  ? slides
     : part.motion == Kind::rests ? rests
                                  : leaves)
        .lines.push_back(std::move(line));
  }
  layers.add_invariant(std::move(slides));
  for (Lines* plain : {&leaves, &rests}) {
    if (!plain->lines.empty()) layers.panel().lines.push_back(std::move(*plain));
  }
}

/// Returns the name of a variable, with a prime for each apostrophe.
Text variable(std::string name) {
  for (std::size_t at = 0; (at = name.find('\'', at)) != std::string::npos;) name.replace(at, 1, "′");
  return math(name);
}

/// Returns equations as a textbook prints them: with primes, products with a dot, and raised powers.
Text typeset(std::string_view equations) {
  Text result;
  for (std::size_t at = 0; at < equations.size(); ++at) {
    const char c = equations[at];
    if (c == '*') {
      result += "·";
    } else if (c == '-') {
      result += "−";
    } else if (c == '\'') {
      result += "′";
    } else if (c == '^') {
      const auto is_part = [](char x) { return (std::isalnum(static_cast<unsigned char>(x)) != 0) || x == '.'; };
      std::size_t end = at + 1;
      while (end < equations.size() && is_part(equations[end])) ++end;
      if (end > at + 1) {
        result += sup(std::string(equations.substr(at + 1, end - at - 1)));
        at = end - 1;
      } else {
        result += "^";
      }
    } else {
      result += std::string(1, c);
    }
  }
  return result;
}

/// Adds the curves V = 0, without the parts that are drawn as separatrices, limit cycles or curves of equilibria.
void add_invariant_curves(PanelLayers& layers, const PlanarPortrait& portrait, const Palette& palette) {
  constexpr double near = 0.008;  // a fraction of the window
  constexpr std::size_t least = 8;
  std::vector<Point> others;
  const auto add = [&](double u, double v) { others.push_back(on_paper(layers.panel(), {u, v})); };
  const auto add_all = [&](const PortraitOrbit& line) {
    for (Eigen::Index i = 0; i < line.rows(); ++i) add(line.u[i], line.v[i]);
  };
  std::ranges::for_each(portrait.separatrices, add_all);
  std::ranges::for_each(portrait.lines_of_equilibria, add_all);
  for (const reduction::LimitCycle& cycle : portrait.cycles) {
    for (const Vector2d& x : cycle.line) add(x[0], x[1]);
  }
  Lines lines{{},
              {palette.comparison, 3},
              "invariant curves: " + math("V = 0") + " (" + math("V") + ": inverse integrating factor)"};
  for (const TimedLine& curve : layers.lines_of(portrait.invariant)) {
    Polyline part;
    for (std::size_t i = 0; i <= curve.line.size(); ++i) {
      const bool apart = i < curve.line.size() && std::ranges::none_of(others, [&](Point other) {
                           const Point here = on_paper(layers.panel(), curve.line[i]);
                           return std::hypot(here.x - other.x, here.y - other.y) < near;
                         });
      if (apart) {
        part.push_back(curve.line[i]);
      } else if (Polyline whole = std::exchange(part, {}); whole.size() > least) {
        lines.lines.push_back(std::move(whole));
      }
    }
  }
  if (!lines.lines.empty()) layers.panel().lines.push_back(std::move(lines));
}

/// Returns a grey that also a printer shows.
Colour grey_of(const Palette& palette) {
  constexpr double part = 0.35;
  unsigned rgb = 0;
  for (const int shift : {16, 8, 0}) {
    const double light = (palette.region.rgb >> shift) & 0xFFU, dark = (palette.field.rgb >> shift) & 0xFFU;
    rgb |= static_cast<unsigned>(std::lround(std::lerp(light, dark, part))) << shift;
  }
  return {rgb};
}

/// Returns the mark of an equilibrium: a dot if it is stable, a circle if it is an unstable node, focus or star.
Marks::Shape shape_of(std::string_view kind) {
  return kind == "saddle"                                 ? Marks::Shape::square
         : kind.starts_with("stable") || kind == "center" ? Marks::Shape::dot
         : kind.starts_with("unstable")                   ? Marks::Shape::circle
                                                          : Marks::Shape::diamond;
}

/// Returns the place of a point on the axes.
Point shown(const PlanarPortrait& portrait, const Vector2d& x) {
  const Vector2d place = portrait.disc ? portrait.disc->onto(x) : x;
  return {place[0], place[1]};
}

Polyline circle(double radius) {
  Polyline line;
  constexpr int pieces = 360;
  for (int i = 0; i <= pieces; ++i) {
    const double angle = 2 * std::numbers::pi * i / pieces;
    line.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return line;
}

/// Adds the circle at infinity with its motion, the circle of the radius, and the letters of the axes.
void add_infinity(PanelLayers& layers, const PlanarPortrait& portrait, const Palette& palette) {
  const reduction::PoincareDisc& disc = *portrait.disc;
  std::vector<double> angles;
  for (const reduction::Equilibrium& each : disc.at_infinity) angles.push_back(std::atan2(each.x[1], each.x[0]));
  if (angles.empty()) angles = {-2.4, -0.8, 0.8, 2.4};
  Arrows arrows{{}, palette.invariant};
  for (std::size_t i = 0; i < angles.size() && !disc.rests; ++i) {
    const double next = i + 1 < angles.size() ? angles[i + 1] : angles[0] + 2 * std::numbers::pi;
    const double middle = (angles[i] + next) / 2;
    const Vector2d X(std::cos(middle), std::sin(middle)), rate = disc.field(X);
    arrows.arrows.push_back({{X[0], X[1]}, {rate[0], rate[1]}});
  }
  layers.panel().arrows.push_back(std::move(arrows));
  layers.panel().lines.push_back({{circle(1)},
                                  {palette.invariant, disc.rests ? 4 : 1.6, false, disc.rests},
                                  disc.rests ? "equilibria at infinity" : ""});
  const double golden = disc.onto({disc.radius, 0})[0];
  layers.panel().lines.push_back({{circle(golden)},
                                  {palette.theme.faint, 1.2, false, true},
                                  "radius " + math(fmt::format("r = {:g}", disc.radius))});
  constexpr double beyond = 1.08;
  for (const int axis : {0, 1}) {
    const auto i = static_cast<std::size_t>(axis);
    layers.panel().labels.push_back({axis == 0 ? Point{beyond, 0} : Point{0, beyond}, variable(portrait.variables[i]),
                                     palette.theme.ink, Label::Align::centre});
  }
}

/// Adds the limit cycles, each with its period and multiplier in the legend.
void add_cycles(PanelLayers& layers, const PlanarPortrait& portrait, const Palette& palette) {
  for (const reduction::LimitCycle& cycle : portrait.cycles) {
    constexpr double wide = 4;
    Lines line{{{}}, {palette.comparison, wide, !cycle.stable}, ""};
    for (const Vector2d& x : cycle.line) line.lines.front().push_back(shown(portrait, x));
    if (clipped(layers.panel(), line.lines.front()).empty()) continue;
    line.legend = Text(cycle.stable ? "stable limit cycle, " : "unstable limit cycle, ") + math("T") +
                  fmt::format(" = {:.5g}", cycle.period);
    if (std::isfinite(cycle.multiplier)) line.legend += Text(fmt::format(", multiplier {:.3g}", cycle.multiplier));
    layers.add_invariant(std::move(line));
  }
}

Lines lines_of(const PanelLayers& layers, const std::vector<PortraitOrbit>& curves, Stroke stroke, const Text& legend) {
  Lines lines{{}, stroke, legend};
  for (TimedLine& curve : layers.lines_of(curves)) lines.lines.push_back(std::move(curve.line));
  return lines;
}

/// Adds the separatrices, one layer for each manifold.
void add_separatrices(PanelLayers& layers, const PlanarPortrait& portrait, const Palette& palette) {
  struct Look {
    std::string_view manifold;
    bool dashed;
    double width;
    const char* legend;
  };
  for (const Look& look :
       {Look{"stable", true, 2, "stable separatrices"}, Look{"unstable", false, 2, "unstable separatrices"},
        Look{"connection", false, 3, "connections"}}) {
    std::vector<PortraitOrbit> curves;
    std::ranges::copy_if(portrait.separatrices, std::back_inserter(curves),
                         [&](const Separatrix& each) { return each.manifold == look.manifold; });
    if (curves.empty()) continue;
    layers.add_invariant(lines_of(layers, curves, {palette.comparison, look.width, look.dashed}, look.legend));
  }
}

/// Returns the parts of the unit square in which a condition does not hold. Columns of the square are searched; in
/// neighbouring columns with the same number of gaps, the gaps are joined.
std::vector<Polyline> gaps_of(const std::function<bool(Point)>& holds) {
  using Gaps = std::vector<std::pair<double, double>>;
  constexpr int lines = 100, halvings = 12;
  constexpr double thinnest = 1e-3;
  const auto border = [](double from, double to, const auto& is_as_from) {
    for (int i = 0; i < halvings; ++i) {
      const double middle = (from + to) / 2;
      (is_as_from(middle) ? from : to) = middle;
    }
    return std::pair(from, to);
  };
  const auto search = [&](double x) {
    Gaps gaps;
    bool before = true;
    double from = 0;
    for (int i = 0; i <= lines + 1; ++i) {
      const double y = std::clamp((i - 0.5) / lines, 0.0, 1.0);
      const bool now = holds({x, y});
      if (now != before) {
        const auto is_as_before = [&](double at) { return holds({x, at}) == before; };
        const double edge = i == 0 ? 0 : border(from, y, is_as_before).first;
        if (before)
          gaps.emplace_back(edge, 1);
        else
          gaps.back().second = edge;
      }
      before = now;
      from = y;
    }
    std::erase_if(gaps, [&](const auto& gap) { return gap.second - gap.first < thinnest; });
    return gaps;
  };
  std::vector<Polyline> parts;
  std::size_t open = 0;  // number of the last parts that the next column may continue
  const auto add = [&](double x, const Gaps& gaps) {
    if (gaps.size() != open) parts.resize(parts.size() + (open = gaps.size()));
    for (std::size_t i = 0; i < open; ++i) {
      // Points of the lower border stand in the first half of a part, points of the upper border in the second half.
      Polyline& part = parts[parts.size() - open + i];
      const auto middle = static_cast<std::ptrdiff_t>(part.size() / 2);
      part.insert(part.begin() + middle, {{x, gaps[i].first}, {x, gaps[i].second}});
    }
  };
  Gaps last;
  for (int i = 0; i < lines; ++i) {
    const double x = (i + 0.5) / lines;
    Gaps gaps = search(x);
    if (i == 0) add(0, gaps);
    if (i > 0 && gaps.size() != last.size()) {
      const auto is_as_last = [&](double at) { return search(at).size() == last.size(); };
      const auto [left, right] = border(x - 1.0 / lines, x, is_as_last);
      add(left, search(left));
      open = 0;
      add(right, search(right));
    }
    add(x, gaps);
    if (i + 1 == lines) add(1, gaps);
    last = std::move(gaps);
  }
  return parts;
}

}  // namespace

Figure draw(const PlanarPortrait& portrait, const PortraitStyle& style) {
  constexpr double half = 1.16;  // of the axes about the disc
  const Window window = portrait.disc ? Window{Vector2d(-half, -half), Vector2d(half, half)} : portrait.window;
  const Vector2d sides = window.sides();
  const double shape = sides[1] / sides[0];
  // Very long or high windows are not drawn to scale.
  constexpr double highest = 1.4, longest = 3, width = 150;
  const bool to_scale = shape < highest && shape > 1 / longest;
  const double height = to_scale ? std::min(shape, 1.05) : shape < 1 ? 0.66 : 0.9;
  const PaperSize size = fitted({width, std::max(width * height, 90.0)}, 1, style.size);
  const reduction::Generator* scaling = portrait.disc ? nullptr : portrait.plane.scaling();
  PortraitCaption caption;
  caption.highlight = "orbit of the start";
  caption.time_symbol = scaling && scaling->time < 0 ? Text("to infinity") : math("t*");
  CurveDrawing look{look_of(size, 1, style.screen), portrait, caption, style};
  const auto& isochrones = portrait.isochrones;
  const bool even = !isochrones.empty() && portrait.isochrone_step > 0;
  const double most = even ? isochrones.back().tau_stop + portrait.isochrone_step : infinity;
  look.bands = bands_of({&portrait}, 1, look.palette, most);
  Panel axes = panel_of(window);
  axes.bare = portrait.disc.has_value();
  axes.x.name = variable(portrait.variables[0]);
  axes.y.name = variable(portrait.variables[1]);
  axes.to_scale = to_scale;
  const reduction::SmoothField& field = portrait.disc ? portrait.disc->field : portrait.plane.field();
  const auto rate_at = [&](Point at) { return rate_of(field, {at.x, at.y}); };
  for (Polyline& part : gaps_of([&](Point place) { return rate_at(from_paper(axes, place)).has_value(); })) {
    for (Point& point : part) point = from_paper(axes, point);
    axes.regions.push_back({std::move(part), grey_of(look.palette)});
  }
  const bool has_gaps = !axes.regions.empty();
  const auto place = [&](const PortraitOrbit::Instant& at, const PortraitOrbit::Instant&) {
    return shown(portrait, {at.u, at.v});
  };
  PanelLayers layers(look, std::move(axes), {place});

  // The time of y' = F(x, y) is x, which is an axis.
  const bool slopes = is_slope_field(field, portrait.window);
  const bool coloured = layers.add_orbits(layers.lines_of(portrait.orbits), style.colour_by_time && !slopes,
                                          slopes ? "solutions" : "orbits");
  layers.add_isochrones(-1);
  if (style.field != PortraitStyle::Field::none) {
    const auto drift = [&](Point at) -> std::optional<Drift> {
      if (portrait.disc && std::hypot(at.x, at.y) >= 1) return std::nullopt;
      const std::optional<Vector2d> rate = rate_at(at);
      const double speed = rate ? rate->cwiseQuotient(sides).norm() : 0;
      if (!(speed > 0) || !std::isfinite(speed)) return std::nullopt;
      constexpr double step = 1e-4;  // a fraction of the window
      return Drift{at, {at.x + step * (*rate)[0] / speed, at.y + step * (*rate)[1] / speed}, speed};
    };
    // All directions of y' = F(x, y) point to the right: marks without heads show the slopes.
    layers.add_directions(drift, slopes ? "slopes" : "direction of the motion", !slopes);
  }
  if (style.invariant && scaling) add_rays(layers, portrait, look.palette, slopes);
  if (style.invariant) {
    add_invariant_curves(layers, portrait, look.palette);
    add_separatrices(layers, portrait, look.palette);
    add_cycles(layers, portrait, look.palette);
  }
  const auto add_curves = [&](const std::vector<PortraitOrbit>& curves, Stroke stroke, const Text& legend) {
    if (!curves.empty()) layers.panel().lines.push_back(lines_of(layers, curves, stroke, legend));
  };
  add_curves(portrait.lines_of_equilibria, {look.palette.invariant, 4, false, true}, "equilibria");
  for (std::size_t i : {0U, 1U}) {
    add_curves(portrait.nullclines[i], {look.palette.invariant, 1.5, i == 1, i == 0},
               variable(portrait.variables[i] + "'") + " = 0");
  }
  add_switching(layers, portrait.switching, look.palette);
  if (portrait.disc) add_infinity(layers, portrait, look.palette);
  layers.add_highlights();
  if (scaling) {
    // No other equilibrium is isolated.
    const Vector2d& centre = portrait.plane.centre();
    constexpr std::string_view names_of_points[] = {"node", "star", "saddle", "focus", "center", "cusp"};
    const bool is_equilibrium = std::ranges::any_of(
        names_of_points, [&](std::string_view name) { return portrait.plane.kind().ends_with(name); });
    layers.panel().marks.push_back({{{centre[0], centre[1]}},
                                    look.palette.invariant,
                                    1.2,
                                    shape_of(portrait.plane.kind()),
                                    is_equilibrium ? std::string(portrait.plane.kind()) : "centre of the symmetry"});
  } else {
    std::map<std::string_view, Marks> of_kind;
    const auto add = [&](const reduction::Equilibrium& each, Point place_) {
      Marks& marks =
          of_kind
              .try_emplace(each.kind,
                           Marks{{}, look.palette.invariant, 1.2, shape_of(each.kind), std::string(each.kind)})
              .first->second;
      marks.points.push_back(place_);
    };
    for (const reduction::Equilibrium& each : portrait.equilibria.points) {
      // A mark that rounding moves out of the window would not be drawn.
      constexpr double rounding = 1e-9;
      const auto& [low, high] = portrait.window;
      const Vector2d inside = each.x.cwiseMax(low).cwiseMin(high);
      const bool outside = ((inside - each.x).cwiseAbs() - rounding * (high - low)).maxCoeff() > 0;
      add(each, shown(portrait, outside ? each.x : inside));
    }
    if (portrait.disc) {
      for (const reduction::Equilibrium& each : portrait.disc->at_infinity) add(each, {each.x[0], each.x[1]});
    }
    // Kinds with one mark share a line of the legend.
    std::map<Marks::Shape, Marks> of_shape;
    for (auto& [kind, marks] : of_kind) {
      const auto [its, is_new] = of_shape.try_emplace(marks.shape, marks);
      if (is_new) continue;
      its->second.points.insert(its->second.points.end(), marks.points.begin(), marks.points.end());
      its->second.legend += Text(", ") + marks.legend;
    }
    for (auto& each : of_shape) layers.panel().marks.push_back(std::move(each.second));
  }

  Figure figure;
  constexpr std::size_t longest_title = 80;
  figure.title = typeset(shortened(portrait.name, longest_title));
  const std::string kind(portrait.plane.kind().empty() ? "kind not decided" : portrait.plane.kind());
  std::string form(portrait.plane.form());
  for (const std::size_t i : {0U, 1U}) {
    if (form.ends_with(i == 0 ? " u" : " v")) form.replace(form.size() - 1, 1, portrait.variables[i]);
  }
  const char* of_form = form == "affine" ? "generator of the orbits" : "inverse integrating factor";
  figure.subtitle = portrait.disc ? "the Poincaré disc: the whole plane, with infinity as its circle"
                    : !scaling    ? (form.empty() ? std::string("no exact solution found: orbits by time steps")
                                                  : fmt::format("orbits by quadrature; {}: {}", of_form, form))
                    : portrait.plane.star()
                        ? kind
                        : fmt::format("{}all {}{} are one curve, moved by the symmetry",
                                      kind == "bordered" || kind == "mixed" || slopes ? "" : kind + ": ",
                                      slopes ? "solutions" : "orbits",
                                      portrait.plane.sectors().empty() ? ""
                                      : slopes                         ? " between two of these"
                                                                       : " between two rays");
  Text values;
  for (const auto& [letter, value] : portrait.parameters) {
    values += (values.empty() ? Text() : Text(", ")) + math(letter) + fmt::format(" = {}", value);
  }
  if (!values.empty()) figure.subtitle = values + "; " + figure.subtitle;
  if (portrait.disc && !portrait.equilibria.complete) figure.subtitle += "; some equilibria may be missing";
  if (has_gaps) figure.subtitle += "; grey: the field has no value";
  figure.size = size;
  figure.theme = look.palette.theme;
  figure.panels = {std::move(layers.panel())};
  if (coloured) figure.colour_bar = colour_bar(look.bands, caption);
  return figure;
}

}  // namespace contensou::portraits
