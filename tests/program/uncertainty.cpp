// `stop` and `roll --uncertainty` are compared with differences of the program's own events, and with quantiles that
// can be computed without samples.
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

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

TEST_CASE("quantiles where each sample has its own mu are the stop times at its quantiles", "[cli]") {
  // Solutions exist for some values of mu, and results for others are interpolated.
  for (const std::string law : {"exact", "ring"}) {
    const std::string start = "--ball pool --slip 2 --spin 30 --law " + law + " --patch-radius ";
    const auto wide = uncertainty(start + "3mm --uncertainty patch-radius=30%");
    CHECK(wide.at("samples").get<long>() > 9900);
    for (const auto& [i, z] : {std::pair{1, 0.994458}, {2, 0.0}, {3, -0.994458}}) {
      CHECK(wide.at("quantiles")[static_cast<std::size_t>(i)].at("value").get<double>() ==
            Approx(t_stop(fmt::format("{}{:.17g}", start, 3e-3 * (1 + 0.3 * z)))).epsilon(4e-3));
    }
  }
}

TEST_CASE("quantiles of what rises or falls with one number are its values at normal quantiles", "[cli]") {
  struct Kind {
    std::string ball;
    std::vector<std::pair<std::string, double>> numbers;  ///< numbers that may vary, in addition to slip and spin
  };
  const std::vector<Kind> kinds{
      {"pool", {{"friction", 0.2}, {"spin-deceleration", 10}, {"radius", 0.03}, {"gravity", 9}}},
      {"gel", {{"friction", 0.5}, {"patch-radius", 7e-3}, {"radius", 0.03}}},
      {"steel", {{"friction", 0.15}, {"mass", 0.5}, {"radius", 0.02}}},
      {"puck", {{"friction", 0.1}, {"radius", 0.04}, {"gravity", 9}}}};
  constexpr std::array z{-1.959963984540054, -0.994457883209753, 0.0, 0.994457883209753, 1.959963984540054};
  std::mt19937_64 random(1);
  const auto among = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  int compared = 0;
  for (int i = 0; i < (CONTENSOU_FULL_TESTS ? 200 : 16); ++i) {
    const Kind& kind = kinds[static_cast<std::size_t>(i) % kinds.size()];
    const std::string& ball = kind.ball;
    const bool of_stop = random() % 2 == 0;
    const double share = std::pow(10, among(-3, -0.7));
    // A slow slide of a ball whose patch follows from its spin deceleration lasts nearly as long for every friction.
    const double slip = std::pow(10, among(-2, 0.7)), spin = among(20, 150);
    auto numbers = kind.numbers;
    numbers.insert(numbers.end(), {{"slip", std::max(slip, 0.05)}, {"spin", spin}});
    const std::string name = numbers[random() % numbers.size()].first;
    const double value = std::ranges::find(numbers, name, &std::pair<std::string, double>::first)->second;
    const std::string others = fmt::format("{} --format json --ball {}", of_stop ? "stop" : "roll --samples 2", ball) +
                               (name == "slip" ? "" : fmt::format(" --slip {:.17g}", slip)) +
                               (name == "spin" ? "" : fmt::format(" --spin {:.17g}", spin));
    const auto at = [&](double times) { return json_of(fmt::format("{} --{} {:.17g}", others, name, value * times)); };
    const auto known =
        json_of(fmt::format("{} --{} {:.17g} --uncertainty {}={:.17g}%", others, name, value, name, 100 * share))
            .at("uncertainty");
    std::vector<nlohmann::json> there;
    for (const double each : z) there.push_back(at(1 + share * each));
    for (const std::string part : {"/t_stop", "/rolls_after/t", "/rolls_after/x", "/rest/t", "/rest/x", "/spin_ends/t",
                                   "/spin_ends/x", "/slip_length", "/turns", "/path"}) {
      const nlohmann::json::json_pointer place(part);
      if (of_stop && part != "/t_stop") continue;
      if (!there.front().contains(place) || !there.front().at(place).is_number()) continue;
      std::array<double, 5> values{};
      std::ranges::transform(there, values.begin(),
                             [&](const auto& each) { return each.at(place).template get<double>(); });
      if (values[0] > values[4]) std::ranges::reverse(values);
      if (!(std::ranges::is_sorted(values) && values[0] < values[4])) continue;
      const auto& quantiles = (of_stop ? known : known.at(place)).at("quantiles");
      const bool to_rounding = part == "/t_stop" || part == "/spin_ends/t";
      const double error = 1e-3 * (values[4] - values[0]) / 4 + (to_rounding ? 1e-14 : 1e-9) * std::abs(values[2]);
      for (std::size_t j = 0; j < z.size(); ++j) {
        INFO(others << " --uncertainty " << name << '=' << 100 * share << "% " << part << " quantile " << j);
        CHECK(std::abs(quantiles[j].at("value").get<double>() - values[j]) <= error);
        ++compared;
      }
    }
  }
  CHECK(compared > 100);
}

TEST_CASE("--uncertainty says whether the first order does", "[cli]") {
  CHECK(uncertainty("--ball pool --uncertainty slip=1%,spin=1%,friction=1%").at("first_order_holds") == true);
  CHECK(uncertainty("--ball pool --uncertainty spin-deceleration=30%").at("first_order_holds") == false);
  CHECK_THAT(run_program("stop --ball pool --uncertainty spin_deceleration=30%").out,
             Contains("the first order fails here"));
  // Variances of independent numbers add up. Spreads may have units. Each run uses the same samples.
  const auto json = uncertainty("--ball pool --uncertainty slip=1cm/s,spin=2rad/s");
  const auto& shares = json.at("shares");
  CHECK(json.at("standard").get<double>() ==
        Approx(std::hypot(shares.at("slip").get<double>(), shares.at("spin").get<double>())).epsilon(1e-14));
  CHECK(json == uncertainty("--ball pool --uncertainty slip=1%,spin=2%"));
  CHECK(uncertainty("--mu 0.3 --u0 1 --v0 1 --law pade --uncertainty v0=1%").at("standard").get<double>() ==
        Approx(0.0152868423111).epsilon(1e-10));
}

TEST_CASE("--uncertainty fit: the ball's own, correlated", "[cli]") {
  // Friction and radius of the ball, completely correlated, vary with one number z; z gives the quantiles of t_stop.
  const TemporaryDirectory directory;
  const std::string ball = run_program("balls gel").out;
  const auto with = [&](const std::string& correlation) {
    write_file(directory.file("ball.toml"), ball +
                                                "[uncertainty]\nfriction = 0.05\nradius = \"1 mm\"\nspin = \"2%\"\n" +
                                                "[uncertainty.correlation]\n" + correlation);
    return "--ball " + directory.file("ball.toml") + " --slip 0.5 --spin 300 ";
  };
  const double friction = 0.5, radius = 0.03;
  const auto at = [&](double z, int sign) {
    return t_stop(fmt::format("--ball gel --slip 0.5 --spin 300 --friction {:.17g} --radius {:.17g}",
                              friction + 0.05 * z, radius + sign * 1e-3 * z));
  };
  for (const int sign : {1, -1}) {
    const std::string start = with(fmt::format("radius = {{friction = {}}}\n", sign));
    const auto known = uncertainty(start + "--uncertainty fit");
    constexpr double step = 1e-3;
    CHECK(known.at("standard").get<double>() ==
          Approx(std::abs(at(step, sign) - at(-step, sign)) / (2 * step)).epsilon(1e-5));
    CHECK(known.at("shares").size() == 2);  // the spread of the spin in the file is not used
    const bool falls = at(1, sign) < at(-1, sign);
    for (const auto& [i, z] : {std::pair{0, -1.959964}, {1, -0.994458}, {2, 0.0}, {3, 0.994458}, {4, 1.959964}}) {
      CHECK(known.at("quantiles")[static_cast<std::size_t>(i)].at("value").get<double>() ==
            Approx(at(falls ? -z : z, sign)).epsilon(3e-3));
    }
    if (sign < 0) continue;
    // A spread on the command line replaces the spread of the ball. Radius and friction then have independent errors.
    const auto named = uncertainty(start + "--uncertainty fit,radius=1mm");
    const auto& shares = named.at("shares");
    CHECK(shares == known.at("shares"));
    CHECK(named.at("standard").get<double>() ==
          Approx(std::hypot(shares.at("friction").get<double>(), shares.at("radius").get<double>())).epsilon(1e-14));
  }
  CHECK_THAT(run_program("stop " + with("radius = {friction = 0.5}\n") + "--uncertainty fit").out,
             Contains(" s, correlated\n"));
  CHECK_THAT(run_program("roll --ball " + directory.file("ball.toml") + " --spin 77 --uncertainty fit").err,
             Contains("fit leaves out spin: the file has its spread"));
  check_rejected("stop --ball gel --uncertainty fit", "fit: the ball has no [uncertainty]");
  check_rejected("stop --mu 0.3 --u0 1 --v0 1 --uncertainty fit", "fit: the ball has no [uncertainty]");
}

TEST_CASE("a run file of fit carries what it is known to", "[cli]") {
  const TemporaryDirectory directory;
  const std::string film = directory.file("film.csv"), ball = directory.file("ball.toml");
  const auto seen = [&](const std::string& start) {
    std::string rows = run_program("roll --ball gel --samples 40 --until 0.6 " + start).out;
    write_file(film, rows.replace(rows.find("wz,slip"), 2, "spin"));
    const std::string fit = "fit " + film + " --ball gel --noise spin=1,slip=0.01,x=5e-4,y=5e-4,vx=0.02,vy=0.02";
    CHECK(run_program(fit + " -o " + ball).status == 0);
    return nlohmann::json::parse(run_program(fit + " --format json").out);
  };
  const auto found = seen("--velocity 0.4,0.3 --angular-velocity 2,-1,80");
  // The file gives velocities, but the stop time needs slip and spin. The errors of both must be those of the fit.
  const auto known = uncertainty("--ball " + ball + " --uncertainty fit");
  std::string errors;
  for (const std::string name : {"friction", "patch_radius", "slip", "spin"})
    errors +=
        fmt::format("{}{}={:.17g}", errors.empty() ? "" : ",", name, found.at(name).at("standard_error").get<double>());
  const auto apart = uncertainty("--ball " + ball + " --uncertainty " + errors);
  for (const auto& [name, share] : apart.at("shares").items())
    CHECK(known.at("shares").at(name).get<double>() == Approx(share.get<double>()).epsilon(1e-9));
  CHECK_THAT(read_file(ball), Contains("[uncertainty.correlation]\n") && Contains("wy = {friction = "));
  const auto roll = json_of("roll --format json --samples 2 --ball " + ball + " --uncertainty fit").at("uncertainty");
  CHECK(roll.at("t_stop").at("standard").get<double>() == Approx(known.at("standard").get<double>()).epsilon(1e-5));
  // If a film does not determine a number, the ball of the fit has no spread for this number.
  write_file(film, "t,spin\n0,100\n0.1,99\n0.2,98.02\n0.3,97\n");
  CHECK(run_program("fit " + film + " --ball pool --noise spin=0.1 -o " + ball).status == 0);
  CHECK_THAT(read_file(ball), !Contains("[uncertainty]\n") && Contains("no [uncertainty]"));
}

TEST_CASE("roll --uncertainty: each share is a spread times a derivative of --gradient", "[cli]") {
  struct Asked {
    std::string start, spreads;
    std::vector<std::pair<std::string, double>> by;  ///< spreads of the numbers, SI
  };
  for (const Asked& asked :
       {Asked{"gel --radius 0.03 --velocity 0.5,0.2 --angular-velocity 3,-5,80",
              "vx=2%,wz=3rad/s,radius=4%",
              {{"vx", 0.01}, {"wz", 3}, {"radius", 0.0012}}},
        Asked{
            "pool --patch-radius 8mm --rolling-friction 0.01", "rolling-friction=5%", {{"rolling_friction", 5e-4}}}}) {
    const auto roll =
        json_of("roll --format json --samples 2 --gradient --ball " + asked.start + " --uncertainty " + asked.spreads);
    const auto& known = roll.at("uncertainty");
    CHECK(known.at("samples") == 1000);
    for (const std::string part : {"/rolls_after/t", "/rolls_after/y", "/spin_ends/x", "/turns", "/path", "/t_stop"}) {
      const nlohmann::json::json_pointer number(part);
      for (const auto& [name, spread] : asked.by) {
        INFO(part << ' ' << name);
        const auto& slopes = roll.at("gradient").at(number);
        CHECK(slopes.contains(name) == known.at(number).at("shares").contains(name));
        if (slopes.contains(name)) {
          CHECK(known.at(number).at("shares").at(name).get<double>() ==
                Approx(spread * slopes.at(name).get<double>()).epsilon(1e-12).margin(1e-15));
        }
      }
      CHECK(std::abs(known.at(number).at("quantiles")[2].at("value").get<double>() - roll.at(number).get<double>()) <
            0.2 * known.at(number).at("standard").get<double>() + 1e-15);
    }
  }
  CHECK_THAT(run_program("roll --ball puck --uncertainty friction=20% --format text").out,
             Contains("rest t") && Contains("+-") && Contains("*"));
  CHECK_THAT(run_program("roll --ball pool --gradient --format text").out,
             Contains("derivatives, SI, by") && Contains("spin_deceleration"));
}
