#include "options/instants.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "input/csv.hpp"
#include "options/argument.hpp"

namespace contensou::program {

namespace {

bool names_a_file(const std::string& typed) {
  return typed == "-" || typed.find('/') != std::string::npos || typed.ends_with(".csv") || typed.ends_with(".txt");
}

}  // namespace

std::function<Eigen::ArrayXd(const std::string& typed)> read_instants(std::string column) {
  return [column = std::move(column)](const std::string& typed) -> Eigen::ArrayXd {
    const std::vector<double> times =
        names_a_file(typed) ? read_column(typed, column, Infinity::forbidden) : parse_numbers(typed);
    if (const auto early = std::ranges::find_if(times, [](double time) { return time < 0; }); early != times.end()) {
      throw NotAllowed(fmt::format("{} is before the start: {} >= 0 is required", *early, column));
    }
    return Eigen::Map<const Eigen::ArrayXd>(times.data(), static_cast<Eigen::Index>(times.size()));
  };
}

}  // namespace contensou::program
