#include "input/number.hpp"

#include <charconv>
#include <cmath>
#include <optional>
#include <system_error>

#include <fmt/format.h>

#include "exit_status.hpp"
#include "input/quotation.hpp"

namespace contensou::program {

namespace {

/// Without spaces around it and a leading plus, which std::from_chars does not know.
std::string_view digits_of(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  text = text.substr(first, text.find_last_not_of(" \t") - first + 1);
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  return text;
}

struct Number {
  double value;
  std::errc error;  ///< none, or out of range
};

std::optional<Number> read_number(std::string_view text) {
  const std::string_view digits = digits_of(text);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc::invalid_argument || end != digits.data() + digits.size()) return std::nullopt;
  return Number{value, error};
}

}  // namespace

bool is_number(std::string_view text) { return read_number(text).has_value(); }

double parse_number(std::string_view text, Infinity infinity) {
  const auto number = read_number(text);
  if (!number) {
    throw BadInput(fmt::format("{} is not a number; write it like 0.1, -5 or 1e-3{}", quotation(text),
                               text.find(',') == std::string_view::npos ? "" : ": decimals take a point"));
  }
  const auto [value, error] = *number;
  if (error == std::errc::result_out_of_range) {
    throw BadInput(fmt::format("{} does not fit a double (5e-324 to 1.8e308)", quotation(text)));
  }
  const bool infinite = infinity == Infinity::allowed && std::isinf(value);
  if (!std::isfinite(value) && !infinite) throw BadInput(fmt::format("{} is not a finite number", quotation(text)));
  return value;
}

std::vector<double> parse_numbers(std::string_view text, Infinity infinity) {
  std::vector<double> values;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    values.push_back(parse_number(text.substr(begin, end - begin), infinity));
    begin = end + 1;
  }
  return values;
}

long parse_integer(std::string_view text, long lowest, long highest) {
  const std::string_view digits = digits_of(text);
  long value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size() || value < lowest || value > highest) {
    throw BadInput(fmt::format("{} is not a whole number from {} to {}", quotation(text), lowest, highest));
  }
  return value;
}

}  // namespace contensou::program
