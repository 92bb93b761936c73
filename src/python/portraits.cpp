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

using Sides = std::pair<double, double>;

/// A window: its sides (U, V), or both ends of each side.
using AskedWindow = std::variant<Sides, std::pair<Sides, Sides>>;

/// A number of isochrones, or the times of isochrones.
using AskedIsochrones = std::variant<int, std::vector<double>>;

/// Returns the request that portraits of all systems share.
portraits::PortraitRequest request_of(const std::optional<AskedWindow>& window, std::optional<int> orbits,
                                      const std::vector<Sides>& through,
                                      const std::optional<AskedIsochrones>& isochrones) {
  portraits::PortraitRequest request{.orbits = orbits};
  if (window && std::holds_alternative<Sides>(*window)) {
    const auto& [u, v] = std::get<Sides>(*window);
    request.sides = Eigen::Vector2d(u, v);
  } else if (window) {
    const auto& [u, v] = std::get<1>(*window);
    request.window = {{u.first, v.first}, {u.second, v.second}};
  }
  for (const auto& [u, v] : through) request.through.push_back({u, v});
  if (!isochrones) return request;
  if (const int* count = std::get_if<int>(&*isochrones)) {
    request.isochrones = *count;
    return request;
  }
  request.isochrone_times = std::get<1>(*isochrones);
  if (request.isochrone_times.empty()) request.isochrones = 0;
  return request;
}

using Size = std::pair<std::optional<double>, std::optional<double>>;

/// Returns the style that portraits of all systems share.
PortraitStyle style_of(const std::string& arrows, bool axes, const std::string& colour, const std::string& style,
                       const Size& size) {
  using Arrows = PortraitStyle::Arrows;
  return {.arrows = one_of<Arrows>("arrow place",
                                   {{"time", Arrows::time}, {"one", Arrows::one}, {"none", Arrows::none}}, arrows),
          .invariant = axes,
          .colour_by_time = one_of<bool>("colour", {{"time", true}, {"none", false}}, colour),
          .screen = one_of<bool>("style", {{"print", false}, {"screen", true}}, style),
          .size = {size.first, size.second}};
}

Figure titled(Figure figure, const std::optional<std::string>& title, const Size& size) {
  if (title) {
    figure.title = portraits::shortened(*title, 200);
    figure.subtitle = "";
  }
  return size.second ? figure : portraits::trimmed(std::move(figure));
}

/// Returns a portrait.
/// @param flows  one or more, of planes to compare; the other arguments apply to all
Portrait portrait_of(const std::vector<reduction::Flow>& flows, const std::optional<si::Experiment>& experiment,
                     const std::optional<Sides>& start, const std::optional<std::string>& view,
                     const std::optional<AskedWindow>& window, std::optional<int> orbits,
                     const std::vector<Sides>& through, const std::optional<AskedIsochrones>& isochrones,
                     const std::optional<reduction::Law>& against, const std::string& arrows, const std::string& field,
                     bool axes, const std::string& colour, const std::string& style, const std::string& scale,
                     bool estimate, const Size& size, const std::optional<std::string>& title) {
  using Field = PortraitStyle::Field;
  answers::PortraitSpec asked{.flow = flows.at(0),
                              .experiment = experiment,
                              .request = request_of(window, orbits, through, isochrones),
                              .style = style_of(arrows, axes, colour, style, size)};
  if (start) asked.start = reduction::State{start->first, start->second};
  if (experiment) asked.start = si::reduced_start(*experiment);
  const auto name_of_view = [](portraits::View each) { return name(each); };
  if (view) asked.request.view = entry_of("view", portraits::views(), name_of_view, *view);
  asked.request.comparison = against;
  asked.request.linear = one_of<bool>("scale", {{"bent", false}, {"linear", true}}, scale);
  asked.style.field = one_of<Field>(
      "field", {{"none", Field::none}, {"motion", Field::motion}, {"regularised", Field::regularised}}, field);
  if (estimate && asked.request.view != portraits::View::time) {
    throw std::domain_error("estimate is drawn against time: view=\"time\" is needed");
  }
  if (estimate && against) throw std::domain_error("estimate and against exclude each other: both would be dashed");
  asked.style.estimate = estimate;
  std::vector<answers::PortraitSpec> all;
  for (const reduction::Flow& flow : flows) {
    all.push_back(asked);
    all.back().flow = flow;
  }
  std::vector<PhasePortrait> data = answers::portraits_of(all);
  Figure figure = titled(answers::figure_of(all, data), title, size);
  return {std::move(figure),
          [data = std::move(data), source = asked.source()] { return portraits::to_json(data, source); }};
}

Portrait portrait_of_plane(const Planar& planar, const std::string& system, const std::optional<Sides>& start,
                           const std::optional<AskedWindow>& window, std::optional<int> orbits,
                           const std::vector<Sides>& through, const std::optional<AskedIsochrones>& isochrones,
                           const std::string& arrows, const std::string& field, bool axes, bool nullclines,
                           const std::string& colour, const std::string& style, const Size& size,
                           const std::optional<std::string>& title) {
  using Field = PortraitStyle::Field;
  portraits::PortraitRequest asked = request_of(window, orbits, through, isochrones);
  if (start) asked.highlight = {start->first, start->second};
  asked.nullclines = nullclines;
  PortraitStyle looks = style_of(arrows, axes, colour, style, size);
  looks.field = one_of<Field>("field", {{"none", Field::none}, {"motion", Field::motion}}, field);
  return interruptible([&]() -> Portrait {
    portraits::PlanarPortrait data = portraits::planar_portrait(planar.plane, system, asked);
    data.variables = planar.variables;
    data.parameters = planar.parameters;
    Figure figure = titled(portraits::draw(data, looks), title, size);
    return {std::move(figure),
            [data = std::move(data)] { return portraits::to_json(data, {.version = CONTENSOU_VERSION}); }};
  });
}

}  // namespace

void bind_portraits(py::module_& module) {
  py::class_<Portrait>(module, "Portrait")
      .def(py::init(&portrait_of), py::arg("flows"), py::arg("experiment"), py::arg("start"), py::kw_only(),
           py::arg("view"), py::arg("window"), py::arg("orbits"), py::arg("through"), py::arg("isochrones"),
           py::arg("against"), py::arg("arrows"), py::arg("field"), py::arg("axes"), py::arg("colour"),
           py::arg("style"), py::arg("scale"), py::arg("estimate"), py::arg("size"), py::arg("title"), Released())
      .def_static("of_plane", &portrait_of_plane, py::arg("planar"), py::arg("system"), py::arg("start"), py::kw_only(),
                  py::arg("window"), py::arg("orbits"), py::arg("through"), py::arg("isochrones"), py::arg("arrows"),
                  py::arg("field"), py::arg("axes"), py::arg("nullclines"), py::arg("colour"), py::arg("style"),
                  py::arg("size"), py::arg("title"))
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
