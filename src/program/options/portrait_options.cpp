#include "options/portrait_options.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "contensou/si/nearest_name.hpp"
#include "exit_status.hpp"

namespace contensou::program {

namespace {

using portraits::PortraitStyle;

constexpr long most_orbits = 200;
constexpr long most_isochrones = 100;
/// Sides of a figure, mm.
constexpr double smallest = 40;
constexpr double largest = 2000;

/// The value that an argument names.
template <class Value, std::size_t Count>
Value choice(const Argument& argument, const std::array<std::pair<const char*, Value>, Count>& values) {
  std::vector<std::string> names;
  for (const auto& [name, value] : values) {
    if (argument.text() == name) return value;
    names.emplace_back(name);
  }
  argument.reject(fmt::format("one of {} is needed{}", fmt::join(names, ", "), si::suggestion(argument.text(), names)));
}

constexpr std::array arrow_names{
    std::pair{"time", PortraitStyle::Arrows::time},
    std::pair{"one", PortraitStyle::Arrows::one},
    std::pair{"none", PortraitStyle::Arrows::none},
};
constexpr std::array field_names{
    std::pair{"none", PortraitStyle::Field::none},
    std::pair{"motion", PortraitStyle::Field::motion},
    std::pair{"regularised", PortraitStyle::Field::regularised},
};
constexpr std::array switch_names{std::pair{"on", true}, std::pair{"off", false}};
constexpr std::array colour_names{std::pair{"time", true}, std::pair{"none", false}};
constexpr std::array style_names{std::pair{"print", false}, std::pair{"screen", true}};

std::vector<std::string> view_names() {
  std::vector<std::string> names;
  for (portraits::View view : portraits::views()) names.emplace_back(portraits::name(view));
  return names;
}

}  // namespace

void PortraitOptions::add(CLI::App& app) {
  view_.add(app, "--view", "VIEW",
            fmt::format("the axes: {} (default uv; pair for mu < 0.1)", fmt::join(view_names(), ", ")));
  window_.add(app, "--window", "U,V", "show |u| <= U and 0 <= v <= V (default: chosen so that the plane is filled)");
  orbits_.add(app, "--orbits", "N", fmt::format("orbits on each side of u = 0, 0 to {} (default 12)", most_orbits));
  through_.add(app, "--through", "U,V", "also the orbit through this point; may be repeated");
  isochrones_.add_optional(app, "--isochrones", "N",
                           fmt::format("about N isochrones of the stop time, 0 to {} (default 7)", most_isochrones));
  arrows_.add(app, "--arrows", "WHERE", "arrows on orbits: at equal times (time, default), one on each, none");
  field_.add_optional(app, "--field", "FIELD",
                      "the direction field, length by logarithm: motion (2.6), regularised (2.7), none (default)");
  axes_.add(app, "--axes", "on|off", "the invariant axes and the invariant ray, which are the nullclines (default on)");
  colour_.add(app, "--colour", "BY", "orbits by the time left (time, default) or in one colour (none)");
  against_.add(app, "--against", "LAW", "the same for another law, dashed, in the same figure");
  style_.add(app, "--style", "STYLE", "print (default), or screen: light on dark, for a projector");
  size_.add(app, "--size", "WxH",
            fmt::format("size of the figure in mm, each {} to {} (default: by view)", smallest, largest));
}

std::string PortraitOptions::given_names() const {
  const std::string names = names_given(
      {&view_, &window_, &orbits_, &through_, &isochrones_, &arrows_, &field_, &axes_, &colour_, &style_, &size_});
  if (!against_.given()) return names;
  return names.empty() ? "--against" : names + ", --against";
}

std::vector<reduction::State> PortraitOptions::points() const {
  std::vector<reduction::State> points;
  for (const std::vector<double>& pair : through_.number_lists()) {
    const std::string typed = fmt::format("{} {}", through_.name(), fmt::join(pair, ","));
    if (pair.size() != 2) throw BadInput(fmt::format("{}: two numbers are needed, U,V", typed));
    if (pair[0] == 0 || !(pair[1] > 0)) {
      throw BadInput(fmt::format("{}: U must not be 0 and V > 0; the axes are orbits that are drawn anyway", typed));
    }
    points.push_back({pair[0], pair[1]});
  }
  return points;
}

void PortraitOptions::read(portraits::PortraitRequest& request) const {
  if (view_.given()) {
    request.view = portraits::find_view(view_.text());
    if (!request.view) {
      const std::vector<std::string> names = view_names();
      view_.reject(
          fmt::format("no such view{}; views: {}", si::suggestion(view_.text(), names), fmt::join(names, ", ")));
    }
  }
  if (window_.given()) {
    const std::vector<double> sides = window_.numbers();
    if (sides.size() != 2) window_.reject("two numbers are needed, U,V");
    if (!(sides[0] > 0 && sides[1] > 0)) window_.reject("both sides of the window must be positive");
    request.window = {sides[0], sides[1]};
  }
  if (orbits_.given()) request.orbits_per_side = static_cast<int>(orbits_.integer(0, most_orbits));
  if (isochrones_.given() && !isochrones_.text().empty()) {
    request.isochrones = static_cast<int>(isochrones_.integer(0, most_isochrones));
  }
  request.through = points();
  for (const reduction::State& point : request.through) {
    if (request.window && !(std::abs(point.u) <= request.window->u && point.v <= request.window->v)) {
      throw BadInput(fmt::format("{} {},{}: outside the window --window {}; leave it out, or make it larger",
                                 through_.name(), point.u, point.v, window_.text()));
    }
  }
  if (against_.given()) request.against = against_.read();
}

PortraitStyle PortraitOptions::style() const {
  PortraitStyle style;
  if (arrows_.given()) style.arrows = choice(arrows_, arrow_names);
  if (field_.given()) style.field = field_.text().empty() ? PortraitStyle::Field::motion : choice(field_, field_names);
  if (axes_.given()) style.invariant = choice(axes_, switch_names);
  if (colour_.given()) style.colour_by_time = choice(colour_, colour_names);
  if (style_.given()) style.screen = choice(style_, style_names);
  if (size_.given()) {
    const std::string& text = size_.text();
    const std::size_t cross = text.find('x');
    if (cross == std::string::npos) size_.reject("width and height in mm are needed, as in 180x120");
    double sides[2] = {};
    try {
      sides[0] = parse_number(text.substr(0, cross));
      sides[1] = parse_number(text.substr(cross + 1));
    } catch (const BadInput& error) {
      size_.reject(fmt::format("{}; width and height in mm are needed, as in 180x120", error.what()));
    }
    for (double side : sides) {
      if (!(side >= smallest && side <= largest)) {
        size_.reject(fmt::format("width and height must be {} to {} mm", smallest, largest));
      }
    }
    style.width_mm = sides[0];
    style.height_mm = sides[1];
  }
  return style;
}

}  // namespace contensou::program
