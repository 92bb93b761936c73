// `stop --uncertainty`: against differences of the program's own stop times, and against quantiles that need no samples.
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <catch2/catch.hpp>

#include "run_program.hpp"

using Catch::Matchers::Contains;

namespace {

double t_stop(const std::string& options) { return json_of("stop --format json " + options).at("t_stop"); }

nlohmann::json uncertainty(const std::string& options) {
  return json_of("stop --format json " + options).at("uncertainty");
}

}  // namespace

TEST_CASE("the first order of --uncertainty is that of differences", "[cli]") {
  struct Known {
    const char *ball, *name, *option;
    double value;
  };
  for (const Known& known : {Known{"pool", "slip", "--slip", 1.5},
                             {"pool", "friction", "--friction", 0.2},
                             {"pool", "spin_deceleration", "--spin-deceleration", 10},
                             {"pool --patch-radius 3mm", "friction", "--friction", 0.2},
                             {"pool --patch-radius 3mm", "radius", "--radius", 0.028575},
                             {"steel", "mass", "--mass", 0.5},
                             {"steel", "radius", "--radius", 0.02},
                             {"puck", "radius", "--radius", 0.0381}}) {
    // No structured binding: clang 14 does not capture one.
    const std::string ball = known.ball, name = known.name, option = known.option;
    const double value = known.value;
    const std::string start =
        fmt::format("--ball {}{}{}", ball, name == "slip" ? "" : " --slip 1.5", name == "spin" ? "" : " --spin -60");
    const auto at = [&](double times) { return t_stop(fmt::format("{} {} {:.17g}", start, option, value * times)); };
    constexpr double step = 1e-3;
    const double slope = (8 * (at(1 + step) - at(1 - step)) - (at(1 + 2 * step) - at(1 - 2 * step))) / (12 * step);
    const auto json = uncertainty(fmt::format("{} {} {:.17g} --uncertainty {}=2%", start, option, value, name));
    INFO(ball << ' ' << name);
    CHECK(std::abs(json.at("shares").at(name).get<double>()) ==
          Approx(std::abs(slope) * 0.02).epsilon(1e-7).margin(1e-10));
    CHECK(json.at("standard").get<double>() == std::abs(json.at("shares").at(name).get<double>()));
  }
}

TEST_CASE("the quantiles of one number are the stop times at its quantiles", "[cli]") {
  // t_stop falls as friction grows, and grows with the slip.
  const auto at = [](double f) { return t_stop(fmt::format("--ball puck --slip 3 --spin 40 --friction {:.17g}", f)); };
  const auto json = uncertainty("--ball puck --slip 3 --spin 40 --uncertainty friction=20%").at("quantiles");
  for (const auto& [i, z] : {std::pair{0, 1.959964}, {1, 0.994458}, {2, 0.0}, {3, -0.994458}, {4, -1.959964}}) {
    CHECK(json[static_cast<std::size_t>(i)].at("value").get<double>() == Approx(at(0.1 * (1 + 0.2 * z))).epsilon(4e-3));
  }
  // A patch of its own in each sample: the table of stop times of any mu.
  const auto wide = uncertainty("--ball pool --patch-radius 3mm --slip 2 --spin 30 --uncertainty patch-radius=30%");
  CHECK(wide.at("samples").get<long>() > 990000);
  for (const auto& [i, z] : {std::pair{1, 0.994458}, {2, 0.0}, {3, -0.994458}}) {
    CHECK(wide.at("quantiles")[static_cast<std::size_t>(i)].at("value").get<double>() ==
          Approx(t_stop(fmt::format("--ball pool --slip 2 --spin 30 --patch-radius {:.17g}", 3e-3 * (1 + 0.3 * z))))
              .epsilon(4e-3));
  }
}

TEST_CASE("--uncertainty says whether the first order does", "[cli]") {
  CHECK(uncertainty("--ball pool --uncertainty slip=1%,spin=1%,friction=1%").at("first_order_holds") == true);
  CHECK(uncertainty("--ball pool --uncertainty spin-deceleration=30%").at("first_order_holds") == false);
  CHECK_THAT(run_program("stop --ball pool --uncertainty spin_deceleration=30%").out,
             Contains("the first order does not do here"));
  // Independent numbers add by their squares; units; the same samples each time.
  const auto json = uncertainty("--ball pool --uncertainty slip=1cm/s,spin=2rad/s");
  const auto& shares = json.at("shares");
  CHECK(json.at("standard").get<double>() ==
        Approx(std::hypot(shares.at("slip").get<double>(), shares.at("spin").get<double>())).epsilon(1e-14));
  CHECK(json == uncertainty("--ball pool --uncertainty slip=1%,spin=2%"));
  CHECK(uncertainty("--mu 0.3 --u0 1 --v0 1 --law pade --uncertainty v0=1%").at("standard").get<double>() ==
        Approx(0.0152868423111).epsilon(1e-10));
}

TEST_CASE("what --uncertainty refuses", "[cli][errors]") {
  const auto refused = [](const std::string& options, const std::string& words) {
    check_rejected("stop " + options, words);
  };
  refused("--ball pool --uncertainty slipp=1%",
          "no such number 'slipp' (did you mean 'slip'?); numbers of this start: ");
  refused("--ball pool --uncertainty slip", "NAME=SPREAD is needed");
  refused("--ball pool --uncertainty slip=x%", "'x' is not a number");
  refused("--ball pool --uncertainty slip=-1%", "a spread must be >= 0");
  refused("--ball pool --uncertainty slip=1kg", "is no number with %, m/s, cm/s");
  refused("--ball pool --uncertainty slip=1%,slip=2%", "slip is given twice");
  refused("--ball pool --spin 0 --uncertainty spin=1%", "spin is 0, where the stop time has a corner");
  refused("--ball pool --rolling-friction 0.01 --uncertainty slip=1%",
          "--uncertainty is of a motion without rolling friction");
  refused("--ball pool --batch x.csv --uncertainty slip=1%", "--uncertainty is for one start");
}
