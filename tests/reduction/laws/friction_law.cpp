#include "contensou/reduction/friction_law.hpp"

#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "constants.hpp"
#include "contensou/reduction/laws.hpp"
#include "contensou/reduction/stop_time.hpp"
#include "user_laws.hpp"

using namespace contensou::reduction;
using namespace contensou::tests;
using Catch::Matchers::Contains;

namespace {

struct Named : RootLaw {
  static constexpr std::string_view name = "mine";
};

/// Returns a law from two functions of k. Tests use it for laws that break a requirement.
template <class Force, class Moment>
auto from_ratio(Force force, Moment moment) {
  return [=](Slip slip) {
    const double k = slip.pivoting == 0 ? infinity : slip.sliding / slip.pivoting;
    return Resistance{force(k), moment(k)};
  };
}

double root_force(double k) { return std::isinf(k) ? 1.0 : k / std::hypot(1, k); }
double root_moment(double k) { return 1 / std::hypot(1, k); }

}  // namespace

TEST_CASE("what is a friction law", "[friction_law][domain]") {
  STATIC_REQUIRE(FrictionLaw<HertzLaw>);
  STATIC_REQUIRE(FrictionLaw<PadeLaw>);
  STATIC_REQUIRE(FrictionLaw<RootLaw>);
  STATIC_REQUIRE(FrictionLaw<Law>);
  STATIC_REQUIRE(FrictionLaw<decltype([](Slip) { return Resistance{1, 1}; })>);
  STATIC_REQUIRE_FALSE(FrictionLaw<int>);
  STATIC_REQUIRE_FALSE(FrictionLaw<decltype([](Slip) { return 1.0; })>);
  STATIC_REQUIRE_FALSE(FrictionLaw<decltype([](double) { return Resistance{1, 1}; })>);
}

TEST_CASE("a law keeps what it offers", "[friction_law]") {
  const Law exact = HertzLaw{};
  CHECK(exact.name() == "exact");
  CHECK(exact.pivoting_moment() == HertzLaw{}({0, 1}).moment);
  CHECK(exact.force_slope() == Approx(1.1780972450961724).epsilon(1e-15));
  REQUIRE(exact.sliding_bounds());
  CHECK(exact.sliding_bounds()->min == 0);
  CHECK(exact.sliding_bounds()->max == 1);
  CHECK(exact.moment_deficit({1e-9, 1}) == HertzLaw{}.moment_deficit({1e-9, 1}));
  CHECK(exact.states_force_deficit());
  CHECK(exact.force_deficit({1, 1e-9}) == HertzLaw{}.force_deficit({1, 1e-9}));
  CHECK(Law(PadeLaw{}).name() == "pade");
  CHECK(Law(Named{}).name() == "mine");
  // The type of a law identifies it, not its name.
  CHECK(Law(PadeLaw{}).as<PadeLaw>());
  CHECK_FALSE(Law(PadeLaw{}).as<HertzLaw>());
  CHECK_FALSE(Law(Impostor{}).as<PadeLaw>());
  CHECK_FALSE(Law(Impostor{}).as<HertzLaw>());
}

TEST_CASE("a law of one function has the defaults", "[friction_law]") {
  const Law law = RootLaw{};
  CHECK(law.name() == "user's law");
  CHECK(law.pivoting_moment() == law({0, 1}).moment);
  CHECK(law.force_slope() == 1 / 0.8);
  CHECK_FALSE(law.sliding_bounds());
  CHECK(law.kinks() == std::vector<double>{1});
  CHECK(law.moment_deficit({1, 1}) == 1 - law({1, 1}).moment / law.pivoting_moment());
  CHECK_FALSE(law.states_force_deficit());
  CHECK(law.force_deficit({1, 1}) == 1 - law({1, 1}).force);

  const ReducedSystem system(law, 0.1);
  CHECK(system.stop_time_bounds({1, 1}).lower == 0);
  CHECK(system.stop_time_bounds({1, 1}).upper == infinity);
  CHECK(routes(system) == std::vector{Route::quadrature, Route::regularised, Route::direct});
}

TEST_CASE("a law that was copied or moved from is still a law", "[friction_law]") {
  Law pade = PadeLaw{};
  const Law copy = pade;                            // NOLINT(performance-unnecessary-copy-initialization)
  CHECK(copy.as<PadeLaw>() == pade.as<PadeLaw>());  // both copies share one function
  const Law other = std::move(pade);
  CHECK(pade.name() == other.name());  // NOLINT(bugprone-use-after-move)
  CHECK(pade({1, 1}).force == other({1, 1}).force);
  STATIC_REQUIRE(sizeof(Law) == sizeof(std::shared_ptr<int>));
}

TEST_CASE("a law whose limits are not those of friction is rejected", "[friction_law][domain]") {
  CHECK_NOTHROW(Law(from_ratio(root_force, root_moment)));
  // Here the force has its full size at the slowest sliding: it does not tend to 0 with k, as it does over a patch.
  CHECK_THROWS_WITH(Law(from_ratio([](double k) { return k > 0 ? 1.0 : 0.0; }, root_moment)),
                    Contains("user's law") && Contains("2^-60"));
  // Phi is proportional to sqrt(k) or k^2 near 0. Therefore Phi'(0) is infinite, or 0.
  CHECK_THROWS_AS(Law(from_ratio([](double k) { return std::isinf(k) ? 1.0 : std::sqrt(k / (1 + k)); }, root_moment)),
                  std::domain_error);
  CHECK_THROWS_AS(Law(from_ratio([](double k) { return std::isinf(k) ? 1.0 : k * k / (1 + k * k); }, root_moment)),
                  std::domain_error);
  CHECK_THROWS_AS(Law(from_ratio([](double k) { return -root_force(k); }, root_moment)), std::domain_error);
  // The force of pure sliding must be 1.
  CHECK_THROWS_WITH(Law(from_ratio([](double k) { return 0.9 * root_force(k); }, root_moment)), Contains("0.9"));
  CHECK_THROWS_AS(Law(from_ratio([](double k) { return k == infinity ? NAN : root_force(k); }, root_moment)),
                  std::domain_error);
  // The moment of pure pivoting must be positive.
  for (double moment : {0.0, -1.0, infinity, static_cast<double>(NAN)}) {
    CAPTURE(moment);
    CHECK_THROWS_WITH(Law(from_ratio(root_force, [=](double k) { return k == 0 ? moment : root_moment(k); })),
                      Contains("Psi(0)"));
  }
}

TEST_CASE("a law that depends on more than the ratio of the speeds is rejected, with what was measured",
          "[friction_law][domain]") {
  // Two laws depend on the speeds: friction softened below a speed, as in engines; and friction that falls with speed.
  const auto softened = [](Slip slip) {
    const double size = std::hypot(slip.sliding, slip.pivoting, 1e-3);
    return Resistance{slip.sliding / std::hypot(slip.sliding, slip.pivoting), 0.6 * slip.pivoting / size};
  };
  CHECK_THROWS_WITH(Law(softened), Contains("ratio of the two speeds alone") && Contains("1e-09 times both"));
  const auto falling = [](Slip slip) {
    const double faster = 1 + 1e-4 * std::exp(-std::hypot(slip.sliding, slip.pivoting));
    const double size = std::hypot(slip.sliding, slip.pivoting);
    return Resistance{slip.pivoting == 0 ? 1 : faster * slip.sliding / size, 0.6 * slip.pivoting / size};
  };
  CHECK_THROWS_WITH(Law(falling), Contains("ratio of the two speeds alone"));
  // The error of a user's quadrature does not count as a dependence on the speeds.
  CHECK_NOTHROW(Law([](Slip slip) {
    const auto [force, moment] = RootLaw{}(slip);
    return Resistance{slip.pivoting == 0 ? force : force * (1 + 1e-8 * std::sin(1e3 * slip.sliding)), moment};
  }));
}

TEST_CASE("a law that does not resist, or comes to its limits too slowly, is rejected", "[friction_law][domain]") {
  CHECK_THROWS_WITH(Law(from_ratio(root_force, [](double k) { return k > 2 ? 0.0 : root_moment(k); })),
                    Contains("positive and finite") && Contains("Psi = 0"));
  CHECK_THROWS_WITH(Law(from_ratio([](double k) { return k > 0.2 && k < 2 ? -1.0 : root_force(k); }, root_moment)),
                    Contains("positive and finite") && Contains("Phi = -1"));
  // Under this law the sliding coefficient m would grow like 1/sqrt(k).
  CHECK_THROWS_WITH(Law(from_ratio(root_force, [](double k) { return 1 / (1 + std::sqrt(k) + k); })),
                    Contains("Psi(0) in proportion to k"));
  CHECK_THROWS_WITH(
      Law(from_ratio([](double k) { return std::isinf(k) ? 1.0 : k / (1 + std::sqrt(k) + k); }, root_moment)),
      Contains("Phi must come to 1"));
  // Phi may tend to 1 from above: 1 + 2/k is fast enough, 1 + 1/k^0.75 is too slow.
  CHECK_NOTHROW(
      Law(from_ratio([](double k) { return std::isinf(k) ? 1.0 : k * (k + 3) / (k * k + k + 1); }, root_moment)));
  CHECK_THROWS_WITH(
      Law(from_ratio([](double k) { return std::isinf(k) ? 1.0 : k / (1 + k) + k / std::pow(1 + k, 1.75); },
                     root_moment)),
      Contains("Phi must come to 1"));
  CHECK_THROWS_WITH(Law(from_ratio(root_force, [](double k) { return 1 / std::sqrt(1 + k); })),
                    Contains("k Psi must have a limit"));
}
