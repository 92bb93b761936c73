#include "contensou/portraits/stop_time_map.hpp"

#include <stdexcept>

#include <fmt/format.h>

#include "data/round_numbers.hpp"
#include "data/tracing.hpp"

namespace contensou::portraits {

namespace {

void require_axis(const char* name, const Eigen::ArrayXd& values, bool logarithmic) {
  const auto fail = [name](const std::string& what) {
    throw std::domain_error(fmt::format("stop_time_map: {} {}", name, what));
  };
  const Eigen::Index count = values.size();
  if (count < 2) fail(fmt::format("needs two values or more, got {}", count));
  if (!(values.tail(count - 1) > values.head(count - 1)).all()) fail("must increase");
  if (logarithmic && !(values[0] > 0)) fail(fmt::format("must be > 0 on logarithmic axes, got {}", values[0]));
  constexpr double largest = 1e100;
  const double least = logarithmic ? values[0] : values[count - 1] - values[0];
  if (!(values.abs().maxCoeff() <= largest && least >= 1 / largest)) {
    fail(fmt::format("from {} to {} cannot be drawn: choose a unit of speed in which it lies within 1e-100 .. 1e100",
                     values[0], values[count - 1]));
  }
}

}  // namespace

StopTimeMap stop_time_map(const reduction::Flow& flow, const MapAxes& axes, double time_unit) {
  const auto& [u0, v0, logarithmic] = axes;
  require_axis("u0", u0, logarithmic);
  require_axis("v0", v0, logarithmic);
  if (v0[0] < 0) throw std::domain_error(fmt::format("stop_time_map: v0 must be >= 0, got {}", v0[0]));

  const Eigen::Index columns = u0.size(), rows = v0.size();
  StopTimeMap map{flow.system().law().name(), flow.system().mu(), axes, Eigen::ArrayXXd(rows, columns), {}};
  std::vector<double> row(static_cast<std::size_t>(columns));
  for (Eigen::Index i = 0; i < rows; ++i) {
    const std::vector<double> same(row.size(), v0[i]);
    flow.stop_times({u0.data(), row.size()}, same, row, 1, static_cast<std::size_t>(map.tau.size()));
    map.tau.row(i) = Eigen::Map<const Eigen::RowVectorXd>(row.data(), columns).array();
  }
  if (!map.tau.allFinite()) {
    throw std::domain_error("stop_time_map: a stop time is beyond the largest double: use a larger unit of speed");
  }
  const double low = map.tau.minCoeff() / time_unit, high = map.tau.maxCoeff() / time_unit;
  constexpr double few_decades = 4.5, pieces = 7;
  std::vector<double> times =
      logarithmic ? round_ratios(low, high, few_decades) : multiples(low, high, round_step(high - low, pieces));
  for (double& time : times) time *= time_unit;
  map.isochrones = isochrones(flow, {{u0[0], v0[0]}, {u0[columns - 1], v0[rows - 1]}}, times, logarithmic);
  return map;
}

}  // namespace contensou::portraits
