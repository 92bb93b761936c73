#include "data/round_numbers.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "contensou/reduction/detail/infinity.hpp"

namespace contensou::portraits {

double round_down(double x) {
  const double power = std::pow(10, std::floor(std::log10(x)));
  for (double digit : {5.0, 2.0}) {
    if (digit * power <= x) return digit * power;
  }
  return power;
}

double round_step(double range, double pieces) { return round_down(range / pieces * 1.7); }

double step_for(double x, int count, std::initializer_list<double> digits) {
  const double near = std::floor(std::log10(x / count));
  double best = 0, off = infinity;
  for (double digit : digits) {
    for (double power : {near - 1, near, near + 1}) {
      const double step = digit * std::pow(10, power);
      const double its_off = std::abs(std::ceil(x / step) - 1 - count);
      if (its_off < off) std::tie(best, off) = std::pair(step, its_off);
    }
  }
  return best;
}

std::vector<double> multiples(double low, double high, double step) {
  std::vector<double> result;
  for (double i = std::floor(low / step) + 1; i * step < high; ++i) result.push_back(i * step);
  return result;
}

std::vector<double> round_ratios(double low, double high, double few_decades) {
  const double decades = std::log10(high / low);
  constexpr double pieces = 7;
  if (decades < 0.7) return multiples(low, high, round_step(high - low, pieces));
  const std::vector<double> digits = decades < few_decades ? std::vector<double>{1, 2, 5} : std::vector<double>{1};
  const double stride = std::max(1.0, std::ceil(decades / 12));
  std::vector<double> result;
  for (double power = stride * std::floor(std::log10(low) / stride); power <= std::log10(high); power += stride) {
    for (double digit : digits) {
      const double value = digit * std::pow(10, power);
      if (value > low && value < high) result.push_back(value);
    }
  }
  return result;
}

Text number(double value, int digits) {
  if (value == 0) return "0";
  const std::string rounded = fmt::format("{:.{}g}", value, digits);
  std::from_chars(rounded.data(), rounded.data() + rounded.size(), value);
  const double exponent = std::floor(std::log10(std::abs(value)) + 1e-9);
  if (exponent >= -3 && exponent < 5) return fmt::format("{:.{}g}", value, std::max(digits, 5));
  const double mantissa = value / std::pow(10, exponent);
  if (std::abs(mantissa - 1) < 1e-6) return "10" + sup(fmt::format("{}", exponent));
  return fmt::format("{:.{}g}·10", mantissa, digits > 5 ? digits : 3) + sup(fmt::format("{}", exponent));
}

std::vector<Text> powers_of_ten(const std::vector<double>& values) {
  std::vector<Text> plain, powers;
  for (double value : values) {
    plain.push_back(number(value));
    powers.push_back("10" + sup(fmt::format("{:.0f}", std::log10(value))));
  }
  return std::ranges::none_of(plain,
                              [&](const Text& text) { return text.runs().size() > 1 && text.runs()[0].words == "10"; })
             ? plain
             : powers;
}

}  // namespace contensou::portraits
