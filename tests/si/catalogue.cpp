#include "contensou/si/catalogue.hpp"

#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "contensou/reduction/hertz_law.hpp"
#include "contensou/si/bridge.hpp"

using namespace contensou::si;

TEST_CASE("patches of the built-in balls", "[table]") {
  struct Row {
    std::string name;
    double patch;  // m
    double mu;
  };
  // theory: Hertz's formula and the spin deceleration, rounded to three digits there
  const std::vector<Row> rows{{"pool", 2.83e-3, 0.099},
                              {"steel", 3.51e-5, 0.0035},
                              {"bowling", 1.33e-3, 0.0123},
                              {"rubber", 1.71e-3, 0.0685},
                              {"gel", 7.24e-3, 0.241}};
  REQUIRE(catalogue().size() == rows.size());
  const contensou::reduction::HertzLaw law;
  for (const auto& [name, patch, mu] : rows) {
    INFO(name);
    REQUIRE(find_ball(name) != nullptr);
    const Shot& shot = find_ball(name)->shot;
    CHECK(patch_radius_of(shot, law) == Approx(patch).epsilon(2e-3));
    CHECK(patch_ratio(shot, law) == Approx(mu).epsilon(6e-3));
    CHECK_NOTHROW(require_shot(shot));
    CHECK_FALSE(find_ball(name)->sources.empty());
  }
  CHECK(find_ball("hockey") == nullptr);
}

TEST_CASE("the bowling ball's moduli stand for E* = 2.3 GPa", "[table]") {
  CHECK(effective_modulus(std::get<HertzModuli>(find_ball("bowling")->shot.contact.patch)) ==
        Approx(2.3e9).epsilon(1e-15));
}
