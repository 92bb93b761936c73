#include "input/range.hpp"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "exit_status.hpp"
#include "input/number.hpp"
#include "input/quotation.hpp"

namespace contensou::program {

Range::Range(double least, double most, long count, Steps steps)
    : least_(least), most_(most), count_(count), steps_(steps) {
  if (least > most) throw BadInput(fmt::format("MIN = {} exceeds MAX = {}: put the smaller one first", least, most));
  if (count == 1 && least != most) {
    throw BadInput(fmt::format("one value cannot be both MIN = {} and MAX = {}: give N = 2 or more", least, most));
  }
  if (count > 1 && least == most) {
    throw BadInput(
        fmt::format("all {} values would be {}: give different MIN and MAX, or the number alone", count, least));
  }
  if (steps == Steps::logarithmic && !(least > 0)) {
    throw BadInput(fmt::format("logarithmic steps need MIN > 0, got {}: raise MIN, or leave --log out", least));
  }
}

double Range::operator[](long place) const {
  const long last = count_ - 1;
  if (place == 0) return least_;
  if (place == last) return most_;
  const auto before = static_cast<long double>(place);
  const auto after = static_cast<long double>(last - place);
  const auto all = static_cast<long double>(last);
  if (steps_ == Steps::linear) return static_cast<double>((least_ * after + most_ * before) / all);
  return static_cast<double>(std::exp2(
      (std::log2(static_cast<long double>(least_)) * after + std::log2(static_cast<long double>(most_)) * before) /
      all));
}

Range parse_range(std::string_view text, Steps steps) {
  const std::size_t first = text.find(':');
  if (first == std::string_view::npos) return Range(parse_number(text));
  const std::size_t second = text.find(':', first + 1);
  if (second == std::string_view::npos || text.find(':', second + 1) != std::string_view::npos) {
    throw BadInput(fmt::format("{} is not a range; write it MIN:MAX:N, as in 0:2:201", quotation(text)));
  }
  const double least = parse_number(text.substr(0, first));
  const double most = parse_number(text.substr(first + 1, second - first - 1));
  return {least, most, parse_integer(text.substr(second + 1), 1, std::numeric_limits<long>::max()), steps};
}

}  // namespace contensou::program
