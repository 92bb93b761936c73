#include "answers/input/parse.hpp"

#include <charconv>
#include <cmath>
#include <system_error>

#include <fmt/format.h>

#include "answers/input/errors.hpp"

namespace contensou::answers {

namespace {

/// Reads a whole text as a number. Unlike std::from_chars it accepts a leading plus, and spaces.
template <class Value>
std::errc read(std::string_view text, Value& value) {
  const auto first = std::min(text.find_first_not_of(" \t"), text.size());
  text = text.substr(first, text.find_last_not_of(" \t") + 1 - first);
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return end == text.data() + text.size() ? error : std::errc::invalid_argument;
}

}  // namespace

std::string escaped(std::string_view input) {
  const std::string in_quotes = fmt::format("{:?}", input);
  return in_quotes.substr(1, in_quotes.size() - 2);
}

std::string quotation(std::string_view input) {
  constexpr std::size_t max_size = 80;
  if (input.size() <= max_size) return fmt::format("'{}'", escaped(input));
  std::size_t size = max_size;
  while (size > 0 && (static_cast<unsigned char>(input[size]) & 0xC0) == 0x80) --size;  // not inside a UTF-8 character
  return fmt::format("'{}...'", escaped(input.substr(0, size)));
}

const char* decimal_hint(std::string_view text) {
  return text.find(',') == std::string_view::npos ? "" : ": decimals take a point";
}

bool is_number(std::string_view text) {
  double value = 0;
  return read(text, value) != std::errc::invalid_argument;
}

double parse_number(std::string_view text, Infinity infinity) {
  double value = 0;
  const std::errc error = read(text, value);
  if (error == std::errc::invalid_argument) {
    throw BadInput("{} is not a number; write it like 0.1, -5 or 1e-3{}", quotation(text), decimal_hint(text));
  }
  if (error == std::errc::result_out_of_range) {
    throw BadInput("{} does not fit a double (5e-324 to 1.8e308)", quotation(text));
  }
  const bool infinite = infinity == Infinity::allowed && std::isinf(value);
  if (!std::isfinite(value) && !infinite) throw BadInput("{} is not a finite number", quotation(text));
  return value;
}

std::vector<std::string> split(std::string_view text, char mark) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(mark, begin), text.size());
    parts.emplace_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

std::vector<double> parse_numbers(std::string_view text, Infinity infinity) {
  std::vector<double> values;
  for (const std::string& part : split(text, ',')) values.push_back(parse_number(part, infinity));
  return values;
}

long parse_integer(std::string_view text, long lowest, long highest) {
  long value = 0;
  if (read(text, value) != std::errc() || value < lowest || value > highest) {
    throw BadInput("{} is not a whole number from {} to {}", quotation(text), lowest, highest);
  }
  return value;
}

}  // namespace contensou::answers
