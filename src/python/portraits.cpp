// contensou::portraits in Python: a portrait as data, as a figure and as a file.
#include <algorithm>
#include <functional>
#include <variant>

#include "answers/asked/portrait_spec.hpp"
#include "contensou/portraits/layout.hpp"
#include "contensou/portraits/planar_portrait.hpp"
#include "contensou/portraits/render.hpp"
#include "contensou/si/scaling.hpp"
#include "planar.hpp"

namespace contensou::python {

namespace {

using portraits::Figure;
using portraits::Panel;
using portraits::PhasePortrait;
using portraits::Point;
using portraits::PortraitStyle;

struct Portrait {
  Figure figure;
  std::function<std::string()> json;
};

/// Returns points as an array of two columns.
py::array_t<double> array_of(const std::vector<Point>& points) {
  static_assert(sizeof(Point) == 2 * sizeof(double));
  py::array_t<double> array({static_cast<py::ssize_t>(points.size()), py::ssize_t{2}});
  std::copy(points.begin(), points.end(), reinterpret_cast<Point*>(array.mutable_data()));
  return array;
}

std::string colour_of(portraits::Colour colour) { return fmt::format("#{:06x}", colour.rgb); }

/// Returns the runs of a text, each (words, italic, level).
py::tuple text_of(const portraits::Text& text) {
  return list_of(text.runs(),
                 [](const portraits::Run& run) { return py::make_tuple(run.words, run.italic, run.level); });
}

py::list ticks_of(const std::vector<portraits::Axis::Tick>& ticks) {
  return list_of(ticks, [](const portraits::Axis::Tick& tick) { return py::make_tuple(tick.at, text_of(tick.text)); });
}

py::dict axis_of(const portraits::Axis& axis) {
  return py::dict(py::arg("name") = text_of(axis.name), py::arg("low") = axis.low, py::arg("high") = axis.high,
                  py::arg("ticks") = ticks_of(axis.ticks));
}

py::dict dict_of(const Panel& panel) {
  static constexpr const char* shapes[] = {"dot", "circle", "square"};
  static constexpr const char* sides[] = {"left", "center", "right"};
  return py::dict(py::arg("title") = text_of(panel.title), py::arg("x") = axis_of(panel.x),
                  py::arg("y") = axis_of(panel.y), py::arg("bare") = panel.bare, py::arg("to_scale") = panel.to_scale,
                  py::arg("regions") = list_of(panel.regions,
                                               [](const portraits::Region& region) {
                                                 return py::dict(py::arg("border") = array_of(region.border),
                                                                 py::arg("colour") = colour_of(region.colour));
                                               }),
                  py::arg("lines") = list_of(panel.lines,
                                             [](const portraits::Lines& layer) {
                                               return py::dict(py::arg("lines") = list_of(layer.lines, array_of),
                                                               py::arg("colour") = colour_of(layer.stroke.colour),
                                                               py::arg("width") = layer.stroke.width,
                                                               py::arg("dashed") = layer.stroke.dashed,
                                                               py::arg("dotted") = layer.stroke.dotted,
                                                               py::arg("legend") = text_of(layer.legend));
                                             }),
                  py::arg("arrows") = list_of(panel.arrows,
                                              [](const portraits::Arrows& layer) {
                                                std::vector<Point> ends;
                                                for (const auto& [at, direction] : layer.arrows)
                                                  ends.insert(ends.end(), {at, direction});
                                                return py::dict(py::arg("arrows") = array_of(ends),
                                                                py::arg("colour") = colour_of(layer.colour));
                                              }),
                  py::arg("marks") = list_of(panel.marks,
                                             [](const portraits::Marks& layer) {
                                               return py::dict(py::arg("points") = array_of(layer.points),
                                                               py::arg("colour") = colour_of(layer.colour),
                                                               py::arg("size") = layer.size,
                                                               py::arg("shape") = shapes[static_cast<int>(layer.shape)],
                                                               py::arg("legend") = text_of(layer.legend));
                                             }),
                  py::arg("labels") = list_of(panel.labels, [](const portraits::Label& label) {
                    return py::dict(py::arg("x") = label.at.x, py::arg("y") = label.at.y,
                                    py::arg("text") = text_of(label.text), py::arg("colour") = colour_of(label.colour),
                                    py::arg("align") = sides[static_cast<int>(label.align)]);
                  }));
}

py::dict dict_of(const Figure& figure) {
  const auto& bar = figure.colour_bar;
  return py::dict(
      py::arg("title") = text_of(figure.title), py::arg("subtitle") = text_of(figure.subtitle),
      py::arg("width_mm") = figure.size.width_mm, py::arg("height_mm") = figure.size.height_mm,
      py::arg("letter_pt") = portraits::letter_mm(figure.size.width_mm) * figure.theme.letters * 72 / 25.4,
      py::arg("ground") = colour_of(figure.theme.ground), py::arg("ink") = colour_of(figure.theme.ink),
      py::arg("faint") = colour_of(figure.theme.faint),
      py::arg("panels") = list_of(figure.panels, [](const Panel& panel) { return dict_of(panel); }),
      py::arg("colour_bar") = bar ? std::optional(py::dict(py::arg("name") = text_of(bar->name),
                                                           py::arg("colours") = list_of(bar->colours, colour_of),
                                                           py::arg("ticks") = ticks_of(bar->ticks)))
                                  : std::nullopt);
}

/// Returns an argument of Python's function, or a default if the function does not have it.
template <class Value>
Value argument(const py::dict& asked, const char* name, Value otherwise = {}) {
  if (!asked.contains(name)) return otherwise;
  try {
    return asked[name].cast<Value>();
  } catch (const py::cast_error&) {
    throw py::type_error(
        fmt::format("{}: a value of another type is needed; got {}", name, py::repr(asked[name]).cast<std::string>()));
  }
}

/// Returns the contents that the arguments of a portrait request.
portraits::PortraitRequest request_of(const py::dict& asked) {
  using Sides = std::pair<double, double>;
  portraits::PortraitRequest request{.orbits = argument<std::optional<int>>(asked, "orbits"),
                                     .nullclines = argument<bool>(asked, "nullclines")};
  if (const auto u = argument<std::optional<double>>(asked, "u"))
    request.highlight = {*u, argument<double>(asked, "v")};
  const auto name_of_view = [](portraits::View each) { return name(each); };
  if (const auto view = argument<std::optional<std::string>>(asked, "view"))
    request.view = entry_of("view", portraits::views(), name_of_view, *view);
  request.linear =
      one_of<bool>("scale", {{"bent", false}, {"linear", true}}, argument<std::string>(asked, "scale", "bent"));
  // A window is given by its sides (U, V), or by both ends of each side.
  const auto window = argument<std::optional<std::variant<Sides, std::pair<Sides, Sides>>>>(asked, "window");
  if (window && std::holds_alternative<Sides>(*window)) {
    const auto& [u, v] = std::get<Sides>(*window);
    request.sides = Eigen::Vector2d(u, v);
  } else if (window) {
    const auto& [u, v] = std::get<1>(*window);
    request.window = {{u.first, v.first}, {u.second, v.second}};
  }
  for (const auto& [u, v] : argument<std::vector<Sides>>(asked, "through")) request.through.push_back({u, v});
  const auto isochrones = argument<std::optional<std::variant<int, std::vector<double>>>>(asked, "isochrones");
  if (isochrones && std::holds_alternative<int>(*isochrones)) {
    request.isochrones = std::get<int>(*isochrones);
  } else if (isochrones) {
    request.isochrone_times = std::get<1>(*isochrones);
    if (request.isochrone_times.empty()) request.isochrones = 0;
  }
  return request;
}

using Field = PortraitStyle::Field;

/// Returns the style that the arguments of a portrait request.
PortraitStyle style_of(const py::dict& asked, const std::vector<std::pair<std::string, Field>>& fields) {
  using Arrows = PortraitStyle::Arrows;
  const auto chosen = [&]<class Value>(const char* name, const char* kind,
                                       const std::vector<std::pair<std::string, Value>>& choices) {
    return one_of(kind, choices, argument<std::string>(asked, name));
  };
  const auto [width, height] = argument<std::pair<std::optional<double>, std::optional<double>>>(asked, "size");
  return {.arrows = chosen.operator()<Arrows>("arrows", "arrow place",
                                              {{"time", Arrows::time}, {"one", Arrows::one}, {"none", Arrows::none}}),
          .field = chosen("field", "field", fields),
          .invariant = argument<bool>(asked, "axes"),
          .colour_by_time = chosen.operator()<bool>("colour", "colour", {{"time", true}, {"none", false}}),
          .estimate = argument<bool>(asked, "estimate"),
          .screen = chosen.operator()<bool>("style", "style", {{"print", false}, {"screen", true}}),
          .size = {width, height}};
}

/// Returns a figure with the requested title, without the room that a shorter figure leaves.
Figure finished(Figure figure, const std::optional<std::string>& title, const portraits::AskedSize& size) {
  if (title) {
    figure.title = portraits::shortened(*title, 200);
    figure.subtitle = "";
  }
  return size.height_mm ? figure : portraits::trimmed(std::move(figure));
}

/// Returns a portrait of planes of (2.6).
/// @param flows  one or more, of planes to compare; the other arguments apply to all
Portrait portrait_of(const std::vector<reduction::Flow>& flows, const std::optional<si::Experiment>& experiment,
                     const std::optional<reduction::Law>& against, const py::dict& asked) {
  const auto title = argument<std::optional<std::string>>(asked, "title");
  answers::PortraitSpec spec{
      .flow = flows.at(0),
      .experiment = experiment,
      .request = request_of(asked),
      .style =
          style_of(asked, {{"none", Field::none}, {"motion", Field::motion}, {"regularised", Field::regularised}})};
  spec.start = experiment ? std::optional(si::reduced_start(*experiment)) : spec.request.highlight;
  spec.request.comparison = against;
  if (spec.style.estimate && spec.request.view != portraits::View::time) {
    throw std::domain_error("estimate is drawn against time: view=\"time\" is needed");
  }
  if (spec.style.estimate && against)
    throw std::domain_error("estimate and against exclude each other: both would be dashed");
  std::vector<answers::PortraitSpec> all(flows.size(), spec);
  for (std::size_t i = 0; i < flows.size(); ++i) all[i].flow = flows[i];
  const py::gil_scoped_release released;
  std::vector<PhasePortrait> data = answers::portraits_of(all);
  Figure figure = finished(answers::figure_of(all, data), title, spec.style.size);
  return {std::move(figure),
          [data = std::move(data), source = spec.source()] { return portraits::to_json(data, source); }};
}

/// Returns a portrait of the plane of another system.
Portrait portrait_of_plane(const Planar& planar, const std::string& system, const py::dict& asked) {
  const auto title = argument<std::optional<std::string>>(asked, "title");
  const PortraitStyle looks = style_of(asked, {{"none", Field::none}, {"motion", Field::motion}});
  return interruptible([&]() -> Portrait {
    portraits::PlanarPortrait data = portraits::planar_portrait(planar.plane, system, request_of(asked));
    data.variables = planar.variables;
    data.parameters = planar.parameters;
    Figure figure = finished(portraits::draw(data, looks), title, looks.size);
    return {std::move(figure),
            [data = std::move(data)] { return portraits::to_json(data, {.version = CONTENSOU_VERSION}); }};
  });
}

}  // namespace

void bind_portraits(py::module_& module) {
  py::class_<Portrait>(module, "Portrait")
      .def(py::init(&portrait_of), py::arg("flows"), py::arg("experiment"), py::arg("against"), py::arg("asked"))
      .def(py::init(&portrait_of_plane), py::arg("planar"), py::arg("system"), py::arg("asked"))
      .def("render",
           [](const Portrait& portrait, const std::string& ending, const std::string& font, double dpi) {
             const auto format = portraits::find_picture_format(ending);
             if (!format) {
               const auto formats = portraits::picture_formats();
               throw std::domain_error(
                   no_such("format", ending, std::vector<std::string>(formats.begin(), formats.end())));
             }
             const auto drawn = [&] {
               const py::gil_scoped_release released;
               Figure figure = portrait.figure;
               figure.font = font;
               figure.dpi = dpi;
               return portraits::render(figure, *format);
             };
             return py::bytes(drawn());
           })
      .def("json", [](const Portrait& portrait) { return portrait.json(); })
      .def("figure", [](const Portrait& portrait) { return dict_of(portrait.figure); });
}

}  // namespace contensou::python
