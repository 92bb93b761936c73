#include "contensou/si/quantity.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <fmt/format.h>

namespace contensou::si {

std::size_t Quantity::count() const { return 1 + static_cast<std::size_t>(std::ranges::count(components, ',')); }

const std::vector<const Quantity*>& quantities() {
  static const std::vector<const Quantity*> all{&mass,
                                                &radius,
                                                &inertia_factor,
                                                &friction,
                                                &rolling_friction,
                                                &patch_radius,
                                                &spin_deceleration,
                                                &youngs_modulus,
                                                &poisson_ratio,
                                                &counter_radius,
                                                &slip,
                                                &spin,
                                                &velocity,
                                                &angular_velocity,
                                                &gravity,
                                                &load,
                                                &slope};
  return all;
}

Ways::value_type needed_of(const Ways::value_type& way) {
  Ways::value_type needed = way;
  if (way.size() > 1) std::erase_if(needed, [](const Quantity* quantity) { return quantity->standard.has_value(); });
  return needed;
}

const std::vector<Ways>& alternatives() {
  static const std::vector<Ways> all{
      {{&patch_radius}, {&spin_deceleration}, {&youngs_modulus, &poisson_ratio, &counter_radius}},
      {{&slip, &spin}, {&velocity, &angular_velocity}},
      {{&gravity}, {&load}}};
  return all;
}

const std::vector<Dimension>& dimensions() {
  using std::numbers::pi;
  static const std::vector<Dimension> all{
      {"LENGTH", "m", "metres", {{"cm", 1, 100}, {"mm", 1, 1000}, {"in", 254, 1e4}, {"ft", 3048, 1e4}}},
      {"MASS", "kg", "kilograms", {{"g", 1, 1000}, {"lb", 45359237, 1e8}, {"oz", 28349523125, 1e12}}},
      {"TIME", "s", "seconds", {{"ms", 1, 1000}, {"min", 60}}},
      {"SPEED",
       "m/s",
       "metres per second",
       {{"cm/s", 1, 100}, {"mm/s", 1, 1000}, {"km/h", 10, 36}, {"ft/s", 3048, 1e4}, {"mph", 44704, 1e5}}},
      {"ROTATION", "rad/s", "radians per second", {{"deg/s", pi, 180}, {"rev/s", 2 * pi}, {"rpm", pi, 30}}},
      {"DECELERATION", "rad/s^2", "radians per second squared", {{"deg/s^2", pi, 180}, {"rev/s^2", 2 * pi}}},
      {"ACCELERATION", "m/s^2", "metres per second squared", {{"cm/s^2", 1, 100}, {"ft/s^2", 3048, 1e4}}},
      {"ANGLE", "deg", "degrees", {{"rad", 180, pi}}},
      {"FORCE",
       "N",
       "newtons",
       {{"kN", 1e3}, {"mN", 1, 1e3}, {"kgf", 980665, 1e5}, {"gf", 980665, 1e8}, {"lbf", 44482216152605, 1e13}}},
      {"PRESSURE", "Pa", "pascals", {{"kPa", 1e3}, {"MPa", 1e6}, {"GPa", 1e9}}},
  };
  return all;
}

const Dimension* find_dimension(std::string_view symbol) {
  const auto found = std::ranges::find(dimensions(), symbol, &Dimension::symbol);
  return found == dimensions().end() ? nullptr : &*found;
}

std::string units_of(const Dimension& dimension) {
  std::string list(dimension.symbol);
  for (const Unit& unit : dimension.others) {
    list += fmt::format("{} {}", &unit == &dimension.others.back() ? " or" : ",", unit.symbol);
  }
  return list;
}

std::optional<double> parse_quantity(std::string_view text, const Dimension& dimension) {
  constexpr const char* spaces = " \t\r\n";
  text.remove_prefix(std::min(text.find_first_not_of(spaces), text.size()));
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || !std::isfinite(number)) return std::nullopt;
  std::string_view symbol = text.substr(static_cast<std::size_t>(end - text.data()));
  symbol.remove_prefix(std::min(symbol.find_first_not_of(spaces), symbol.size()));
  symbol = symbol.substr(0, symbol.find_last_not_of(spaces) + 1);
  if (symbol == dimension.symbol) return number;
  const auto unit = std::ranges::find(dimension.others, symbol, &Unit::symbol);
  if (unit == dimension.others.end()) return std::nullopt;
  const double scaled = number * unit->factor;
  return std::isfinite(scaled) ? scaled / unit->divisor : number / unit->divisor * unit->factor;
}

void require(const Quantity& quantity, double value) {
  using enum Quantity::Range;
  const auto [allowed, sentence] = [&]() -> std::pair<bool, std::string_view> {
    switch (quantity.range) {
      case any:
        return {true, "finite"};
      case not_zero:
        return {value != 0, "finite and not 0"};
      case not_negative:
        return {value >= 0, "finite and >= 0"};
      case positive:
        return {value > 0, "finite and > 0"};
      case tilt:
        return {value > -90 && value < 90, "above -90 and below 90"};
      case poisson_ratio:
        break;
    }
    return {value > -1 && value <= 0.5, "above -1 and at most 0.5"};
  }();
  if (std::isfinite(value) && allowed) return;
  throw std::domain_error(fmt::format("{} must be {}{}{}, got {}", quantity.name, sentence,
                                      quantity.unit.empty() ? "" : ", in ", quantity.unit, value));
}

}  // namespace contensou::si
