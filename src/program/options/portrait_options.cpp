#include "options/portrait_options.hpp"

#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "exit_status.hpp"

namespace contensou::program {

namespace {

constexpr long most_orbits = 200;
constexpr long most_isochrones = 100;
/// Sides of a figure, mm.
constexpr double smallest = 40;
constexpr double largest = 2000;

}  // namespace

void PortraitOptions::add(CLI::App& app) {
  Choices<portraits::View> views;
  std::vector<std::string_view> names;
  for (portraits::View view : portraits::views()) {
    names.push_back(name(view));
    views.emplace_back(name(view), view);
  }
  view_.add(app, "--view", "VIEW", fmt::format("the axes: {} (default uv; pair for mu < 0.1)", fmt::join(names, ", ")),
            one_of(views, "view"));
  window_.add(app, "--window", "U,V", "show |u| <= U and 0 <= v <= V (default: chosen so that the plane is filled)",
              parse_window);
  orbits_.add(app, "--orbits", "N", fmt::format("orbits on each side of u = 0, 0 to {} (default 12)", most_orbits),
              whole_number(0, most_orbits));
  through_.add(app, "--through", "U,V", "also the orbit through this point; may be repeated", parse_point);
  through_.make_repeatable();
  isochrones_
      .add(app, "--isochrones", "N",
           fmt::format("about N isochrones of the stop time, 0 to {} (default 7)", most_isochrones),
           [](const std::string& typed) {
             return typed.empty() ? portraits::PortraitRequest{}.isochrones : parse_integer(typed, 0, most_isochrones);
           })
      ->expected(0, 1);
  arrows_.add(app, "--arrows", "WHERE", "arrows on orbits: at equal times (time, default), one on each, none",
              one_of<Style::Arrows>(
                  {{"time", Style::Arrows::time}, {"one", Style::Arrows::one}, {"none", Style::Arrows::none}}));
  field_
      .add(app, "--field", "FIELD",
           "the direction field, length by logarithm: motion (2.6), regularised (2.7), none (default)",
           one_of<Style::Field>({{"none", Style::Field::none},
                                 {"motion", Style::Field::motion},
                                 {"regularised", Style::Field::regularised},
                                 {"", Style::Field::motion}}))
      ->expected(0, 1);
  axes_.add(app, "--axes", "on|off", "the invariant axes and the invariant ray, which are the nullclines (default on)",
            one_of<bool>({{"on", true}, {"off", false}}));
  colour_.add(app, "--colour", "BY", "orbits by the time left (time, default) or in one colour (none)",
              one_of<bool>({{"time", true}, {"none", false}}));
  against_.add(app, "--against", "LAW", "the same for another law, dashed, in the same figure");
  style_.add(app, "--style", "STYLE", "print (default), or screen: light on dark, for a projector",
             one_of<bool>({{"print", false}, {"screen", true}}));
  size_.add(app, "--size", "WxH",
            fmt::format("size of the figure in mm, each {} to {} (default: by view)", smallest, largest), parse_size);
}

std::string PortraitOptions::given_names() const {
  return names_given({&view_, &window_, &orbits_, &through_, &isochrones_, &arrows_, &field_, &axes_, &colour_, &style_,
                      &size_, &against_.argument()});
}

portraits::Window PortraitOptions::parse_window(const std::string& typed) {
  const std::vector<double> sides = parse_numbers(typed);
  if (sides.size() != 2) throw NotAllowed("two numbers are needed, U,V");
  if (!(sides[0] > 0 && sides[1] > 0)) throw NotAllowed("both sides of the window must be positive");
  return {sides[0], sides[1]};
}

reduction::State PortraitOptions::parse_point(const std::string& typed) {
  const std::vector<double> pair = parse_numbers(typed);
  if (pair.size() != 2) throw NotAllowed("two numbers are needed, U,V");
  if (pair[0] == 0 || !(pair[1] > 0)) {
    throw NotAllowed("U must not be 0 and V > 0; the axes are orbits that are drawn anyway");
  }
  return {pair[0], pair[1]};
}

PortraitOptions::Size PortraitOptions::parse_size(const std::string& typed) {
  constexpr const char* wanted = "width and height in mm are needed, as in 180x120";
  const std::size_t cross = typed.find('x');
  if (cross == std::string::npos) throw NotAllowed(wanted);
  try {
    const Size size{parse_number(typed.substr(0, cross)), parse_number(typed.substr(cross + 1))};
    for (double side : {size.width_mm, size.height_mm}) {
      if (!(side >= smallest && side <= largest)) {
        throw NotAllowed(fmt::format("width and height must be {} to {} mm", smallest, largest));
      }
    }
    return size;
  } catch (const NotAllowed&) {
    throw;
  } catch (const BadInput& error) {
    throw NotAllowed(fmt::format("{}; {}", error.what(), wanted));
  }
}

void PortraitOptions::read(portraits::PortraitRequest& request) const {
  if (view_.given()) request.view = *view_;
  if (window_.given()) request.window = *window_;
  if (orbits_.given()) request.orbits_per_side = static_cast<int>(*orbits_);
  request.isochrones = static_cast<int>(isochrones_.value_or(request.isochrones));
  request.through = through_.all();
  for (const reduction::State& point : request.through) {
    if (request.window && !(std::abs(point.u) <= request.window->u && point.v <= request.window->v)) {
      throw BadInput(fmt::format("{} {},{}: outside the window {}; leave it out, or make it larger", through_.name(),
                                 point.u, point.v, window_.typed()));
    }
  }
  if (against_.given()) request.comparison = against_.read();
}

portraits::PortraitStyle PortraitOptions::style() const {
  Style style;
  style.arrows = arrows_.value_or(style.arrows);
  style.field = field_.value_or(style.field);
  style.invariant = axes_.value_or(style.invariant);
  style.colour_by_time = colour_.value_or(style.colour_by_time);
  style.screen = style_.value_or(style.screen);
  if (size_.given()) {
    style.width_mm = (*size_).width_mm;
    style.height_mm = (*size_).height_mm;
  }
  return style;
}

}  // namespace contensou::program
