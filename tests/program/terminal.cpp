#include <catch2/catch.hpp>

#include "run_program.hpp"

TEST_CASE("terminal gives the published ratio of a disc on its own face", "[cli]") {
  const auto disc = json_of("terminal --law uniform --body disc --format json");
  CHECK(disc["schema"] == 1);
  CHECK(disc["law"] == "uniform");
  CHECK(disc["r"] == 2);
  CHECK(disc["limit"] == "ray");
  CHECK(disc["k_star"].get<double>() == Approx(0.653001789205597639).epsilon(1e-14));
  CHECK(disc["r_low"].get<double>() == Approx(1.5).epsilon(1e-14));
  CHECK(disc["r_high"].get<double>() == Approx(4).epsilon(1e-14));
  CHECK(json_of("terminal --law ring --body ring --format json")["k_star"].get<double>() == Approx(1).epsilon(1e-14));
  CHECK(run_program("terminal --law uniform --body disc").out.find("0.653002") != std::string::npos);
}

TEST_CASE("terminal names the three regimes", "[cli]") {
  const auto ball = json_of("terminal --mu 0.3 --format json");
  CHECK(ball["limit"] == "zero");
  CHECK(ball["k_star"] == 0);
  const auto tall = json_of("terminal --mu 3 --body 1,1 --format json");
  CHECK(tall["limit"] == "infinity");
  CHECK(tall["k_star"] == "inf");
  CHECK(rows_of(run_program("terminal --mu 0.3 --format csv").out)[0][5] == "k_star");
  // Both speeds end at one instant, always.
  CHECK_THAT(run_program("terminal --mu 0.3").out,
             Catch::Matchers::Contains("tends to 0: u and v vanish together, v faster"));
}

TEST_CASE("terminal says how good a ray is, next to which its law has few digits, too", "[cli]") {
  const auto ray = json_of("terminal --law exact --mu 1 --body 1,4.999991639655138 --format json");
  CHECK(ray["limit"] == "ray");
  CHECK(ray.at("k_star_accuracy") == ray["rays"][0]["accuracy"]);
  CHECK(ray.at("k_star_accuracy").get<double>() > 1e-12);
  CHECK(json_of("terminal --mu 0.3 --format json").at("k_star_accuracy") == 0);
  CHECK(json_of("terminal --mu 3 --body 1,1 --format json").at("k_star_accuracy") == 0);
  const auto rows = rows_of(run_program("terminal --law exact --mu 1 --body 1,4.999991639655138 --format csv").out);
  CHECK(rows[0].back() == "k_star_accuracy");
  CHECK(std::stod(rows[1].back()) == ray.at("k_star_accuracy"));
}

TEST_CASE("of several ends, the one of the largest sector of starts stands first, with its sector", "[cli]") {
  // Much of the load in the middle, the rest at the rim: Phi/(k Psi) has a minimum.
  const TemporaryDirectory scratch;
  write_file(scratch.file("law.csv"), "rho,pressure\n0,2\n0.1,2\n0.1,0\n0.9,0\n0.9,1\n1,1\n");
  for (const std::string verb : {"terminal", "portrait --facts"}) {
    const auto two = json_of(verb + " --law " + scratch.file("law.csv") + " --mu 1 --body 1,1 --format json");
    INFO(two.dump(2));
    REQUIRE(two["ends"].size() == 2);
    const auto& ray = two["ends"][1];
    CHECK(two["ends"][0]["limit"] == "zero");
    CHECK(ray.at("k_from") == two["rays"][0]["k"]);
    CHECK(ray.at("k_to") == "inf");
    CHECK(two["limit"] == "ray");
    for (const char* key : {"limit", "k_star", "k_star_accuracy", "k_from", "k_to"}) CHECK(two.at(key) == ray.at(key));
    CHECK(two.dump().find("null") == std::string::npos);
    if (verb != "terminal") CHECK(two["contact_order"] == two["tangents"][1]["contact_order"]);
  }
  const auto one = json_of("terminal --mu 0.3 --format json");
  CHECK((one.at("k_from") == 0 && one.at("k_to") == "inf"));
}

TEST_CASE("terminal draws the rays of a law for every body, and marks one that is given", "[cli]") {
  const std::string any = run_program("terminal --law exact -o - --format gp").out;
  const std::string disc = run_program("terminal --law uniform --body disc -o - --format gp").out;
  CHECK_THAT(any, Catch::Matchers::Contains("law: exact") && !Catch::Matchers::Contains("{/:Italic r} = 2}"));
  CHECK_THAT(disc, Catch::Matchers::Contains("law: uniform") && Catch::Matchers::Contains("{/:Italic r} = 2}"));
  check_rejected("terminal --mu 0.3 --size 85", "--size");
  check_rejected("terminal --mu 2 -o rays.svg", "0 < mu <= 1");
}

TEST_CASE("terminal rejects what no body is", "[cli]") {
  check_rejected("terminal", "--mu missing");
  check_rejected("terminal --mu 2", "0 < mu <= 1");
  check_rejected("terminal --mu 0.5 --body disc", "leave --mu out");
  check_rejected("terminal --mu 0.5 --body dsic", "did you mean 'disc'");
  check_rejected("terminal --mu 0.5 --body 1", "CHI,GAMMA");
  check_rejected("terminal --mu 0.5 --body 1,0", "positive");
  check_rejected("terminal --mu 0.5 --body 1,2,3", "2 numbers");
  check_rejected("terminal --mu -1 --body 1,2", "mu > 0 is required");
}
