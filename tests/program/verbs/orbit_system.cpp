#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <catch2/catch.hpp>

#include "run_program.hpp"

namespace {

Run orbit_of(const std::string& system, double u, double v, std::vector<std::string> more) {
  std::vector<std::string> words{"orbit", "--system",        system,     "--u0", std::to_string(u),
                                 "--v0",  std::to_string(v), "--format", "json"};
  words.insert(words.end(), more.begin(), more.end());
  return run_program(words);
}

nlohmann::json orbit_json(const std::string& system, double u, double v, std::vector<std::string> more) {
  const Run run = orbit_of(system, u, v, std::move(more));
  INFO(run.err);
  REQUIRE(run.status == 0);
  return nlohmann::json::parse(run.out);
}

}  // namespace

TEST_CASE("orbit of a typed system agrees with closed forms, before and after the start", "[cli]") {
  const std::vector<std::string> times{"--at", "0,0.5,7,-3,20"};
  // The pendulum from the lowest point: sin(x/2) = k sn(t, k), k = x'(0)/2.
  const auto pendulum = orbit_json("x'' = -sin(x)", 0, 1, times);
  const auto linear = orbit_json("x' = y; y' = -x", 0, 1, times);
  for (std::size_t i = 0; i < pendulum.at("t").size(); ++i) {
    const double t = pendulum["t"][i], k = 0.5;
    CHECK(pendulum["x"][i].get<double>() ==
          Approx(2 * std::asin(k * boost::math::jacobi_sn(k, t))).epsilon(1e-11).margin(1e-11));
    CHECK(pendulum["x'"][i].get<double>() == Approx(2 * k * boost::math::jacobi_cn(k, t)).epsilon(1e-11).margin(1e-11));
    CHECK(std::abs(pendulum["integral"][i].get<double>()) < 1e-11);
    CHECK(pendulum["by"][i] == "quadrature");
    CHECK(linear["x"][i].get<double>() == Approx(std::sin(t)).margin(1e-12));
    CHECK(linear["y"][i].get<double>() == Approx(std::cos(t)).margin(1e-12));
  }
  CHECK(pendulum.at("variables") == std::vector<std::string>{"x", "x'"});
  CHECK(linear.at("form") == "scaling");
  // Without --at and --until the instants are those of one period.
  const auto period = orbit_json("x'' = -sin(x)", 0, 1, {"--samples", "3"});
  CHECK(period["t"][2].get<double>() == Approx(4 * boost::math::ellint_1(0.5)).epsilon(1e-12));
  // ln(x y) - x - y is constant for predators and prey.
  const auto predators = orbit_json("x' = x-x*y; y' = x*y-y", 1, 2, {"--until", "20", "--samples", "40"});
  for (std::size_t i = 0; i < 40; ++i) {
    const double x = predators["x"][i], y = predators["y"][i];
    CHECK(std::log(x * y) - x - y == Approx(std::log(2) - 3).epsilon(1e-11));
    CHECK(std::abs(predators["integral"][i].get<double>()) < 1e-10);
  }
}

TEST_CASE("instants of y' = F(x, y) are values of x, and steps take over where no quadrature is known", "[cli]") {
  const auto riccati = orbit_json("y' = y^2", 0, 1, {"--at", "0.5,-3,0.75"});
  CHECK(!riccati.contains("t"));
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(riccati["y"][i].get<double>() == Approx(1 / (1 - riccati["x"][i].get<double>())).epsilon(1e-12));
  }
  const auto linear = orbit_json("y' = x - y", 2, 3, {"--until", "-1", "--samples", "4"});
  for (std::size_t i = 0; i < 4; ++i) {
    const double x = linear["x"][i];
    CHECK(x == Approx(2 - static_cast<double>(i)));
    CHECK(linear["y"][i].get<double>() == Approx(x - 1 + 2 * std::exp(2 - x)).epsilon(1e-12));
  }
  const auto abel = orbit_json("y' = x^2 - y^3", 0, 1, {"--until", "1", "--samples", "3"});
  for (const char* const column : {"by", "integral"}) {
    CHECK(abel[column] == std::vector<std::string>(3, std::string(column) == "by" ? "steps" : "inf"));
  }
}

TEST_CASE("orbit of a typed system names the place of its end", "[cli]") {
  const auto refused = [](const std::string& system, double u, double v, const std::string& at) {
    const Run run = orbit_of(system, u, v, {"--at=" + at});
    CHECK(run.status == 2);
    CHECK(run.out.empty());
    return run.err;
  };
  CHECK_THAT(refused("y' = y^2", 0, 1, "0.5,1"),
             Catch::Matchers::Contains("--at 1: the orbit ends at x = 1: it goes to infinity"));
  CHECK_THAT(refused("x' = x^2; y' = -y", -1, 1, "-2"),
             Catch::Matchers::Contains("--at -2: the orbit begins at t = -1: it"));
  CHECK_THAT(refused("y' = x^2 + y^3", 0, 1, "3"), Catch::Matchers::Contains("the orbit is known up to x = 0.49"));
  CHECK_THAT(refused("y' = sqrt(1-x)", 0, 0, "2"), Catch::Matchers::Contains("the orbit ends at x = 1, y = 0.66666"));
  // An orbit that oscillates for ever is followed far: y = sin x - 1 + C exp(-sin x).
  const auto lasts = orbit_json("y' = -y*cos(x) + sin(2*x)/2", 0, 1, {"--at", "10,1000"});
  CHECK(lasts["by"][1] == "quadrature");
  CHECK(lasts["y"][1].get<double>() == Approx(std::sin(1000) - 1 + 2 * std::exp(-std::sin(1000))).epsilon(1e-9));
  // An orbit that comes to rest stays there.
  const auto rests = orbit_json("x' = -x/sqrt(x^2+y^2); y' = -y/sqrt(x^2+y^2)", 3, 4, {"--at", "1,9"});
  CHECK(rests["y"][0].get<double>() == Approx(3.2));
  CHECK(rests["y"][1] == 0);
}

TEST_CASE("check of a typed system compares at least eight statements", "[cli]") {
  const auto rows = [](const std::string& system, double u, double v, const std::string& verdict) {
    const Run run = run_program(
        std::vector<std::string>{"check", "--system", system, "--u0", std::to_string(u), "--v0", std::to_string(v)});
    INFO(run.out << run.err);
    CHECK(run.status == 0);
    long count = 0;
    for (std::size_t at = 0; (at = run.out.find(" " + verdict + "\n", at)) != run.out.npos; ++at) ++count;
    CHECK(count + 1 == std::ranges::count(run.out, '\n'));
    return count;
  };
  CHECK(rows("x'' = -sin(x)", 0, 1, "ok") >= 15);
  CHECK(rows("x' = x-x*y; y' = x*y-y", 1, 2, "ok") >= 12);
  CHECK(rows("x' = y; y' = -x", 0, 1, "ok") >= 12);
  CHECK(rows("y' = y^2", 0, 1, "ok") >= 10);
  CHECK(rows("y' = x - y", 0, 1, "ok") >= 8);
  CHECK(rows("x'' = -x-0.2*sign(x')", 1, 0.5, "ok") >= 11);  // V jumps where x' = 0
  CHECK(rows("y' = x^2 - y^3", 0, 1, "ok") >= 3);
}
