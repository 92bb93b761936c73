// contensou::portraits in Python: a portrait as data, as a figure and as a file.
#include <algorithm>
#include <functional>
#include <variant>

#include "answers/asked/portrait_spec.hpp"
#include "contensou/portraits/figure_members.hpp"
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

/// Writer of a figure (portraits::members_of) for Python.
struct ToPython {
  /// Returns the runs of a text, each (words, italic, level).
  static py::tuple text(const portraits::Text& text) {
    return list_of(text.runs(),
                   [](const portraits::Run& run) { return py::make_tuple(run.words, run.italic, run.level); });
  }
  static py::tuple tick(double at, const portraits::Text& words) { return py::make_tuple(at, text(words)); }
  /// Returns points as an array of two columns.
  static py::array_t<double> points(const std::vector<Point>& points) {
    static_assert(sizeof(Point) == 2 * sizeof(double));
    py::array_t<double> array({static_cast<py::ssize_t>(points.size()), py::ssize_t{2}});
    std::copy(points.begin(), points.end(), reinterpret_cast<Point*>(array.mutable_data()));
    return array;
  }
  static py::list lines(const Panel&, const std::vector<portraits::Polyline>& lines) { return list_of(lines, points); }

  static py::list list(const auto& range, const auto& value) { return list_of(range, value); }
  static py::object optional(const auto& value, const auto& function) {
    return value ? py::object(function(*value)) : py::none();
  }
  static py::dict object(const auto&... keys_and_values) {
    const py::tuple all = py::make_tuple(keys_and_values...);
    py::dict object;
    for (std::size_t i = 0; i < all.size(); i += 2) object[all[i]] = all[i + 1];
    return object;
  }
};

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
    const portraits::PortraitRequest request = request_of(asked);
    const auto compute =
        request.view == portraits::View::disc ? portraits::portrait_on_disc : portraits::planar_portrait;
    portraits::PlanarPortrait data = compute(planar.plane, system, request);
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
      .def("figure", [](const Portrait& portrait) { return portraits::members_of(portrait.figure, ToPython()); });
}

}  // namespace contensou::python
