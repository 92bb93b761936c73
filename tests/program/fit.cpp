#include <cmath>
#include <random>
#include <regex>
#include <string>
#include <tuple>

#include <fmt/format.h>
#include <catch2/catch.hpp>

#include "run_program.hpp"

using Catch::Matchers::Contains;

namespace {

/// A film of the pool ball, with errors: columns t, slip and spin, after a `roll` of the program.
std::string film(double slip_sd, double spin_sd, double rate = 100, const std::string& options = "") {
  std::string instants;
  for (int i = 0; i <= 60; ++i) instants += fmt::format("{}{}", i == 0 ? "" : ",", i / rate);
  const auto roll = json_of("roll --ball pool --format json " + options + "--at " + instants);
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  std::string text = "t,slip,spin\n";
  for (std::size_t i = 0; i < roll["t"].size(); ++i) {
    text +=
        fmt::format("{},{},{}\n", roll["t"][i].get<double>(), roll["slip"][i].get<double>() + slip_sd * normal(random),
                    roll["wz"][i].get<double>() + spin_sd * normal(random));
  }
  return text;
}

/// The JSON of a fit to that text.
nlohmann::json fit_of(const std::string& text, const std::string& options = "") {
  const Run run = run_program("fit - --ball pool --format json " + options, text);
  INFO(run.err);
  REQUIRE(run.status == 0);
  return nlohmann::json::parse(run.out);
}

double value(const nlohmann::json& fit, const char* name) { return fit.at(name).at("value"); }

/// A noisy film, some slips of which are too large by 0.5 m/s: of so many rows one, beginning with that place.
std::string film_with_outliers(int period, int first) {
  std::string text = "t,slip,spin\n";
  int place = 0;
  for (const auto& row : rows_of(film(0.01, 1))) {
    if (row[0] == "t") continue;
    text += fmt::format("{},{},{}\n", row[0], std::stod(row[1]) + (place % period == first ? 0.5 : 0), row[2]);
    ++place;
  }
  return text;
}

}  // namespace

TEST_CASE("a film without errors gives back the ball and its start, whatever ball it begins from", "[cli]") {
  const auto pool = json_of("balls --format json")["balls"][0];
  for (const char* start : {"", "--friction 0.9 --patch-radius 1e-4 --slip 0 --spin 0"}) {
    const auto fit = fit_of(film(0, 0), start);
    CHECK(fit["schema"] == 1);
    CHECK(fit["law"] == "exact");
    CHECK(value(fit, "friction") == Approx(pool["friction"].get<double>()).epsilon(1e-6));
    CHECK(value(fit, "patch_radius") == Approx(pool["patch_radius"].get<double>()).epsilon(1e-6));
    CHECK(value(fit, "slip") == Approx(1).epsilon(1e-7));
    CHECK(value(fit, "spin") == Approx(100).epsilon(1e-7));
  }
}

TEST_CASE("a film of a ball with rolling friction gives back the ball, or says that it is one", "[cli]") {
  const std::string film_of_it = film(1e-4, 1e-2, 100, "--rolling-friction 0.01 ");
  const std::string noise = "--noise slip=1e-4,spin=1e-2 ";
  const auto found = fit_of(film_of_it, noise + "--rolling-friction 0.02");
  CHECK(value(found, "friction") == Approx(0.2).epsilon(5e-4));
  CHECK(value(found, "rolling_friction") == Approx(0.01).epsilon(5e-3));
  CHECK(found["rolling_friction"]["determined"] == true);
  CHECK(found["remarks"].empty());
  const auto held = fit_of(film_of_it, noise + "--rolling-friction 0.01 --free friction,patch,slip,spin");
  CHECK(value(held, "friction") == Approx(0.2).epsilon(5e-4));
  CHECK(held["rolling_friction"]["standard_error"] == 0);
  const auto asked = fit_of(film_of_it, noise + "--free friction,patch,rolling_friction,slip,spin");
  CHECK(value(asked, "rolling_friction") == Approx(0.01).epsilon(5e-3));
  const Run toml = run_program("fit - --ball pool --rolling-friction 0.02 " + noise + "-o - --format toml", film_of_it);
  CHECK_THAT(toml.out, Contains("rolling_friction = 0.0100") || Contains("rolling_friction = 0.0099"));
  const Run without =
      run_program("fit - --ball pool --noise slip=0.01,spin=1", film(0.01, 1, 100, "--rolling-friction 0.02 "));
  CHECK_THAT(without.out, Contains("with a rolling friction of about 0.0"));
  CHECK_THAT(run_program("fit - --ball pool --slope 2", film_of_it).err, Contains("level plane"));
  CHECK_THAT(run_program("fit - --ball pool --rolling-friction 0.5 --free slip,spin", film_of_it).err,
             Contains("rolling friction below friction, 0.2, is required; got 0.5"));
  CHECK_THAT(run_program("fit - --ball puck --free rolling_friction", film_of_it).err, Contains("does not roll"));
}

TEST_CASE("a slip that does not fade shows f - u_r only", "[cli][.full]") {
  std::string slip_alone = "t,slip\n";
  for (const auto& row : rows_of(film(0.001, 0.1, 400, "--rolling-friction 0.01 "))) {
    if (row[0] != "t" && std::stod(row[0]) < 0.1) slip_alone += row[0] + "," + row[1] + "\n";
  }
  const auto open = fit_of(slip_alone, "--noise slip=0.001 --rolling-friction 0.01");
  CHECK(open["rolling_friction"]["determined"] == false);
  CHECK(open["friction"]["low"].get<double>() == Approx(0.19).epsilon(0.02));
}

TEST_CASE("of a draw a fit with rolling friction says that it is none of its motions", "[cli][.full]") {
  const auto roll = json_of(
      "roll --ball pool --rolling-friction 0.01 --velocity 1,0 --angular-velocity 0,-20,50 --samples 60 --until 1 "
      "--format json");
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  std::string text = "t,x,y,spin\n";
  for (std::size_t i = 0; i < roll["t"].size(); ++i) {
    text +=
        fmt::format("{},{},{},{}\n", roll["t"][i].get<double>(), roll["x"][i].get<double>() + 5e-4 * normal(random),
                    roll["y"][i].get<double>() + 5e-4 * normal(random), roll["wz"][i].get<double>() + normal(random));
  }
  const Run run = run_program("fit - --ball pool --rolling-friction 0.01 --noise x=0.0005,y=0.0005,spin=1", text);
  CHECK(run.status == 1);
  CHECK_THAT(run.err, Contains("turns against its sliding"));
}

TEST_CASE("a film of a puck gives back the puck", "[cli]") {
  const auto roll = json_of(
      "roll --ball puck --inertia 0.45 --velocity 3,4 --angular-velocity 0,0,100 --samples 60 --until 5 "
      "--format json");
  std::string text = "t,x [mm],y [mm],wz_ignored,spin\n";
  for (std::size_t i = 0; i < roll["t"].size(); ++i) {
    const auto at = [&](const char* name) { return roll[name][i].get<double>(); };
    text += fmt::format("{:.17g},{:.17g},{:.17g},0,{:.17g}\n", at("t"), 1e3 * at("x"), 1e3 * at("y"), at("wz"));
  }
  const Run run = run_program("fit - --ball puck --inertia 0.45 --friction 0.3 --slip 1 --spin 0 --format json", text);
  INFO(run.err);
  REQUIRE(run.status == 0);
  const auto fit = nlohmann::json::parse(run.out);
  CHECK(fit["law"] == "uniform");
  CHECK(value(fit, "friction") == Approx(0.1).epsilon(1e-5));
  CHECK(value(fit, "slip") == Approx(5).epsilon(1e-6));
  CHECK(value(fit, "spin") == Approx(100).epsilon(1e-6));
  CHECK(fit["patch_radius"]["standard_error"] == 0);
  // Of another inertia it is another motion.
  const auto other = nlohmann::json::parse(run_program("fit - --ball puck --format json", text).out);
  CHECK(other["noise"]["x"]["rms"].get<double>() > 1000 * fit["noise"]["x"]["rms"].get<double>());
  const Run toml = run_program("fit - --ball puck --inertia 0.45 --format toml", text);
  CHECK_THAT(toml.out, Contains("inertia = 0.45") && !Contains("patch_radius =") && Contains("velocity = ["));
}

TEST_CASE("a standard deviation has a unit, too: that of an angle is the radian unless it is named", "[cli]") {
  const std::string plan = "fit --plan --ball pool --fps 60 --until 0.5 --format csv --noise ";
  CHECK(run_program(plan + "slip=1cm/s,angle=1deg").out ==
        run_program(plan + "slip=0.01,angle=0.017453292519943295").out);
  CHECK(run_program(plan + "angle=1rad").out == run_program(plan + "angle=1").out);
  CHECK(run_program(plan + "angle=1").out != run_program(plan + "angle=1deg").out);
}

TEST_CASE("units stand behind the names of columns, standard deviations in columns or in --noise", "[cli]") {
  const auto plain = fit_of(film(0.01, 1), "--noise slip=0.01,spin=1");
  CHECK(plain["noise"]["slip"]["estimated"] == false);
  CHECK(plain["noise"]["slip"]["sd"].get<double>() == Approx(0.01).epsilon(1e-14));
  CHECK(plain["reduced_chi2"].get<double>() == Approx(1).margin(0.3));

  // A standard deviation is in the unit of its column unless it has its own.
  std::string in_other_units = "t [ms],slip (cm/s),spin[deg/s],slip_sd [mm/s],spin_sd\n";
  for (const auto& row : rows_of(film(0.01, 1))) {
    if (row[0] == "t") continue;
    in_other_units += fmt::format("{},{},{},10,{}\n", 1e3 * std::stod(row[0]), 100 * std::stod(row[1]),
                                  std::stod(row[2]) * 180 / M_PI, 180 / M_PI);
  }
  const auto converted = fit_of(in_other_units);
  for (const char* name : {"friction", "patch_radius", "slip", "spin"}) {
    INFO(name);
    CHECK(value(converted, name) == Approx(value(plain, name)).epsilon(1e-6));
    CHECK(converted[name]["standard_error"].get<double>() ==
          Approx(plain[name]["standard_error"].get<double>()).epsilon(1e-5));
  }
}

TEST_CASE("the fitted ball is a run file, ready for roll", "[cli]") {
  const TemporaryDirectory scratch;
  write_file(scratch.file("track.csv"), film(0.01, 1));
  const std::string command = "fit " + scratch.file("track.csv") + " --ball pool";
  const auto fit = json_of(command + " --format json");
  CHECK(run_program(command + " -o " + scratch.file("ball.toml")).status == 0);
  const auto roll = json_of("roll --at 0 --format json --ball " + scratch.file("ball.toml"));
  CHECK(roll["slip"][0].get<double>() == Approx(value(fit, "slip")).epsilon(1e-14));
  CHECK(roll["wz"][0].get<double>() == Approx(value(fit, "spin")).epsilon(1e-14));
  CHECK(roll["mu"].get<double>() == Approx(value(fit, "patch_radius") / 0.028575).epsilon(1e-14));
  CHECK_THAT(read_file(scratch.file("ball.toml")), Contains("# fitted to 122 values, law exact: friction +- "));
  const std::string formulas = "phi=k/hypot(c,k);psi=c^2/hypot(c,k)";
  CHECK(run_program(command + " --law " + formulas + " --param c=0.6 -o " + scratch.file("own.toml")).status == 0);
  CHECK_THAT(read_file(scratch.file("own.toml")), Contains(formulas + "; c = 0.6"));
  CHECK(json_of("stop --format json --ball " + scratch.file("own.toml"))["law"] == formulas + "; c = 0.6");
}

TEST_CASE("a mass that nobody gave is neither written nor used", "[cli]") {
  const TemporaryDirectory scratch;
  const std::string track = scratch.file("track.csv"), ball = scratch.file("ball.toml");
  write_file(track, film(0.01, 1));
  REQUIRE(run_program("fit " + track + " --radius 28.575mm -o " + ball).status == 0);
  CHECK_THAT(read_file(ball), Contains("radius = ") && !Contains("mass ="));
  const std::string roll = "roll --ball " + ball;
  const auto motion = json_of(roll + " --format json"), by_steps = json_of(roll + " --route integrated --format json");
  const auto weighed = json_of(roll + " --mass 0.17 --format json");
  for (const auto& each : {motion, by_steps}) {
    CHECK_FALSE(each.contains("energy"));
    CHECK_FALSE(each.contains("energy_balance"));
    CHECK(each["ball"]["mass"].is_null());
    CHECK(each["t_stop"] == weighed["t_stop"]);
  }
  CHECK(motion["x"] == weighed["x"]);
  CHECK(weighed.contains("energy"));
  CHECK(weighed["energy_balance"]["start"] > 0);
  CHECK_THAT(run_program(roll).out, Contains(",wz,slip\n") && !Contains("energy"));
  CHECK_THAT(run_program(roll + " --format text").out, Contains("mass not known") && !Contains("energy"));
  CHECK_THAT(run_program(roll + " --format text --samples 3").out, !Contains("energy"));
  CHECK(run_program(roll + " --rolling-friction 0.01 --slope 1 --format json").status == 0);
  CHECK_THAT(run_program(roll + " --rolling-friction 0.01 --slope 1 --format text").out, !Contains("energy"));
  CHECK_THAT(run_program("stop --ball " + ball).out, Contains("mass not known"));
  CHECK(json_of("stop --format json --ball " + ball)["ball"]["mass"].is_null());
  CHECK(run_program("check --ball " + ball).status == 0);
  CHECK_FALSE(json_of("aim --distance 1 --turns 1 --format json --ball " + ball).contains("strike"));
  CHECK_THAT(run_program("aim --distance 1 --turns 1 --ball " + ball).out, Contains("needs its mass"));
  const std::string way_out = "give mass (--mass, or 'mass' in [ball])";
  for (const auto& [command, user] :
       {std::pair{"roll --strike 1 --ball " + ball, "a cue's stroke"},
        {"roll --load 3 --ball " + ball, "a load"},
        {"stop --youngs-modulus 1e6,2e6 --poisson-ratio 0.4,0.3 --ball " + ball, "Hertz's formula"},
        {"bounce --drop 1 --restitution 0.5 --youngs-modulus 1e6,2e6 --poisson-ratio 0.4,0.3 --ball " + ball,
         "Hertz's formula"},
        {"engine --ball " + ball, "engine"},
        {"engine mujoco --format json --ball " + ball, "engine"}}) {
    INFO(command);
    check_rejected(command, fmt::format("the mass is not known; {} needs it; {}", user, way_out));
    CHECK(run_program(command + " --mass 0.17").status == 0);
  }
  check_rejected(roll + " --slip 0 --spin 0 -o " + scratch.file("rest.svg"), "the ball is at rest");
}

TEST_CASE("fit says when data determine one combination of friction and patch radius only", "[cli]") {
  const auto both = fit_of(film(0.01, 1));
  CHECK_FALSE(both.contains("only"));
  std::string spin_alone = "t,spin\n";
  for (const auto& row : rows_of(film(0.01, 1, 10))) {
    if (row[0] != "t") spin_alone += row[0] + "," + row[2] + "\n";
  }
  const auto product = fit_of(spin_alone);
  REQUIRE(product.contains("only"));
  CHECK(product["only"]["friction_power"] == 1);
  CHECK(product["only"]["patch_power"] == 1);
  CHECK(product["only"]["value"].get<double>() == Approx(0.2 * 2.827e-3).epsilon(0.2));
  CHECK_THAT(run_program("fit - --ball pool", spin_alone).out,
             Contains("Of friction and patch radius these data determine the product friction patch_radius only: "));

  // One stop time of a ball that spins in place: 16 R omega/(5 f g mu) times 2/(3 pi).
  const auto stop = json_of("fit --stop-time 9 --noise stop=0.1 --ball pool --slip 0 --spin 90 --format json");
  CHECK(stop["only"]["name"] == "the product friction patch_radius");
  const double expected = 32 * 0.028575 * 0.028575 * 90 / (15 * M_PI * 9.80665 * 9);
  CHECK(stop["only"]["value"].get<double>() == Approx(expected).epsilon(1e-6));
  // The time is 9 s where the product is the expected one, and goes as one over it.
  const double far = 1.959963984540054 * 0.1 / 9;
  CHECK(stop["only"]["low"].get<double>() == Approx(expected / (1 + far)).epsilon(1e-4));
  CHECK(stop["only"]["high"].get<double>() == Approx(expected / (1 - far)).epsilon(1e-4));
  CHECK(stop["friction"]["standard_error"] == "inf");
  CHECK(stop["friction"]["determined"] == false);
}

TEST_CASE("laws are ranked, the one that the film is of before those that it is not", "[cli]") {
  const auto fit = fit_of(film(0.003, 0.3), "--law pade,ring,exact");
  CHECK(fit["law"] == "exact");
  REQUIRE(fit["laws"].size() == 3);
  CHECK(fit["laws"][1]["aic"].get<double>() > fit["laws"][0]["aic"].get<double>() + 4);
  CHECK_THAT(run_program("fit - --ball pool --law pade,ring,exact", film(0.003, 0.3)).out,
             Contains("exact fits better than all others"));
}

TEST_CASE("what is not free keeps the ball's value", "[cli]") {
  const auto fit = fit_of(film(0.01, 1), "--free friction,spin --slip 1.005 --patch-radius 3e-3");
  CHECK(value(fit, "slip") == 1.005);
  CHECK(value(fit, "patch_radius") == Approx(3e-3).epsilon(1e-14));
  CHECK(fit["slip"]["standard_error"] == 0);
  CHECK(fit["correlation"] == 0);
}

TEST_CASE("rows before --from and after --until are left out", "[cli]") {
  std::string with_strike = film(0, 0);
  with_strike.insert(with_strike.find('\n') + 1, "-0.02,5,5\n-0.01,4,80\n");
  const auto cut = fit_of(with_strike, "--from 0 --until 0.4");
  CHECK(value(cut, "friction") == Approx(0.2).epsilon(1e-6));
  CHECK(cut["noise"]["slip"]["values"] == 41);
  check_rejected("fit - --ball pool --from 7", "no row has a time between --from and --until", film(0, 0));
}

TEST_CASE("outliers count for little with --robust", "[cli]") {
  const std::string text = film_with_outliers(9, 4);
  const double plain = std::abs(value(fit_of(text), "friction") - 0.2);
  const double robust = std::abs(value(fit_of(text, "--robust"), "friction") - 0.2);
  CHECK(plain > 0.02);
  CHECK(robust < 0.01);
}

TEST_CASE("a plan gives the errors that a fit then has", "[cli]") {
  const auto plan = json_of("fit --plan --ball pool --fps 100 --until 0.6 --noise slip=0.01,spin=1 --format json");
  const auto fit = fit_of(film(0.01, 1), "--noise slip=0.01,spin=1");
  for (const char* name : {"friction", "patch_radius", "slip", "spin"}) {
    INFO(name);
    CHECK(plan[name]["standard_error"].get<double>() ==
          Approx(fit[name]["standard_error"].get<double>()).epsilon(0.15));
  }
}

TEST_CASE("fit draws data, fit, residuals and confidence", "[cli]") {
  const TemporaryDirectory scratch;
  write_file(scratch.file("track.csv"), film(0.01, 1));
  CHECK(run_program("fit " + scratch.file("track.csv") + " --ball pool -o " + scratch.file("fit.gp")).status == 0);
  const std::string script = read_file(scratch.file("fit.gp"));
  for (const char* words :
       {"slip, m/s", "spin, rad/s", "spin: residual / sd", "patch radius, mm", "measured", "fitted motion"})
    CHECK_THAT(script, Contains(words));
}

TEST_CASE("the drawing of a fit is no higher than a page, in a column as across it", "[cli]") {
  const TemporaryDirectory scratch;
  const std::string track = scratch.file("track.csv"), drawing = scratch.file("fit.gp");
  write_file(track, run_program("roll --ball pool --samples 61 --equidistant --until 0.5").out);
  for (const auto& [size, width, residuals] : {std::tuple{"single", 85, false}, std::tuple{"double", 170, true}}) {
    INFO(size);
    REQUIRE(run_program("fit " + track + " --ball pool -o " + drawing + " --size " + size).status == 0);
    const std::string script = read_file(drawing);
    std::smatch found;
    REQUIRE(std::regex_search(script, found, std::regex(" size ([0-9.]+),([0-9.]+) ")));
    CHECK(std::stod(found[2]) / std::stod(found[1]) * width < 240);
    for (const char* name : {"slip", "x", "y", "vx", "vy"}) CHECK_THAT(script, Contains(std::string(name) + ", m"));
    CHECK((script.find("residual") != std::string::npos) == residuals);
  }
}

TEST_CASE("three values of slip bound the friction and leave patch and spin open", "[cli]") {
  // Friction alone takes 0.7 m/s in 0.1 s where it is 0.204; with a spin it is more.
  const auto found = nlohmann::json::parse(
      run_program("fit - --ball pool --noise slip=0.01 --format json", "t,slip\n0,1\n0.1,0.3\n0.2,0\n").out);
  CHECK(found["friction"]["low"].get<double>() < 0.2);
  CHECK(found["friction"]["high"].get<double>() > 0.23);
  for (const char* name : {"patch_radius", "spin"}) {
    CHECK(found[name]["standard_error"] == "inf");
    CHECK(found[name]["determined"] == false);
  }
}

TEST_CASE("an interval that reaches much farther to one side has no single error, an open one no end", "[cli]") {
  const std::string text = run_program("fit - --ball pool --noise slip=0.01", "t,slip\n0,1\n0.1,0.3\n0.2,0\n").out;
  std::smatch found;
  REQUIRE(std::regex_search(text, found, std::regex("\npatch_radius, mm +[?] +[?] +not determined.*\n")));
  CHECK(std::regex_search(text, std::regex("\nspin, rad/s +[?] +[?] +not determined.*\n")));
  CHECK_FALSE(std::regex_search(text, std::regex("inf\\b|nan")));
}

TEST_CASE("a column without noise tells no standard deviation of it: that is said, and no nan", "[cli]") {
  std::string slides = "t,slip,spin\n", rests = "t,slip,spin\n";
  for (const auto& row : rows_of(film(0.01, 1))) {
    if (row[0] == "t") continue;
    slides += row[0] + "," + row[1] + ",0\n";
    rests += row[0] + ",0,0\n";
  }
  check_rejected("fit - --ball pool", "spin has the same value in all of its 61 rows", slides);
  check_rejected("fit - --ball pool", "slip has the same value in all of its 61 rows", rests);
  check_rejected("fit - --ball pool --noise slip=1e-308,spin=1", "a standard deviation of slip from", slides);
  // It does not fit: a spin of 0 does not change the slip.
  const auto given = nlohmann::json::parse(run_program("fit - --ball pool --format json --noise spin=0.1", slides).out);
  CHECK(given["patch_radius"]["determined"] == false);
  CHECK(given["patch_radius"]["standard_error"] == "inf");
}

TEST_CASE("a mark that turns more than half a turn between two pictures is followed, and that is said", "[cli]") {
  std::string instants;
  for (int i = 0; i <= 40; ++i) instants += fmt::format("{}{}", i == 0 ? "" : ",", i / 60.0);
  const std::string start = " --ball gel --slip 0.5 --spin 250 ";  // the limit is 188 rad/s
  const auto roll = json_of("roll --format json --samples 4001 --equidistant --until 0.6666666666666667" + start);
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  std::string text = "t,x,y,angle [deg]\n";
  double angle = 0;
  for (std::size_t i = 0; i < roll["t"].size(); ++i) {
    if (i > 0) {
      angle += (roll["wz"][i].get<double>() + roll["wz"][i - 1].get<double>()) / 2 *
               (roll["t"][i].get<double>() - roll["t"][i - 1].get<double>());
    }
    if (i % 100 != 0) continue;
    text += fmt::format("{},{},{},{}\n", roll["t"][i].get<double>(), roll["x"][i].get<double>() + 3e-4 * normal(random),
                        roll["y"][i].get<double>() + 3e-4 * normal(random),
                        std::remainder(angle + 0.02 * normal(random), 2 * M_PI) * 180 / M_PI);
  }
  const Run run = run_program("fit - --ball gel --format json", text);
  INFO(run.err);
  CHECK(run.status == 0);
  const auto fit = nlohmann::json::parse(run.out);
  CHECK(value(fit, "spin") == Approx(250).epsilon(0.02));
  CHECK(value(fit, "friction") == Approx(0.5).epsilon(0.3));
  CHECK(fit["tracks"][0]["half_turn_spin"].get<double>() == Approx(60 * M_PI).epsilon(1e-6));
  CHECK_THAT(run_program("fit - --ball gel", text).out, Contains("more than half a turn between two pictures"));
  CHECK_THAT(run_program("fit --plan --fps 60 --until 0.3 --noise x=0.3mm,angle=2deg" + start).out,
             Contains("up to a spin of 188.5 rad/s"));
}

TEST_CASE("a motion that is not that of the data is not to be overlooked", "[cli]") {
  const Run run = run_program("fit - --ball pool --noise slip=0.001,spin=0.1", film(0.01, 1));
  CHECK(run.status == 1);
  CHECK_THAT(run.out, Contains("THIS DOES NOT FIT"));
  CHECK_THAT(run.err, Contains("does not fit: residuals are"));
  const auto fit = nlohmann::json::parse(
      run_program("fit - --ball pool --noise slip=0.001,spin=0.1 --format json", film(0.01, 1)).out);
  CHECK(fit["fits"] == false);
  CHECK(fit["misfits"].size() == 1);
  CHECK(fit_of(film(0.01, 1), "--noise slip=0.01,spin=1")["fits"] == true);
}

TEST_CASE("frames with --fps, a ball by its radius alone, nan for what was not measured, mm or px for m", "[cli]") {
  std::string frames = "frame,slip,spin\n", in_mm = "t,slip,spin\n";
  int i = 0;
  for (const auto& row : rows_of(film(0.01, 1))) {
    if (row[0] == "t") continue;
    frames += fmt::format("{},{},{}\n", i, i % 7 == 3 ? "NA" : i % 7 == 5 ? "nan" : row[1], row[2]);
    in_mm += fmt::format("{},{},{}\n", row[0], 1e3 * std::stod(row[1]), row[2]);
    ++i;
  }
  const Run run = run_program("fit - --radius 28.575mm --fps 100 --format json", frames);
  INFO(run.err);
  REQUIRE(run.status == 0);
  const auto fit = nlohmann::json::parse(run.out);
  CHECK(fit["noise"]["slip"]["values"] == 44);
  CHECK(value(fit, "friction") == Approx(0.2).epsilon(0.05));
  CHECK_THAT(run_program("fit - --ball pool", in_mm).err, Contains("is it in mm? Then call it 'slip [mm/s]'"));
  std::string in_px = "t,x [px],x_sd [mm],spin\n", in_m = "t,x,x_sd,spin\n";
  for (const auto& row : rows_of(film(0, 1))) {
    if (row[0] == "t") continue;
    const double t = std::stod(row[0]), x = t - t * t;  // m
    in_px += fmt::format("{},{},1,{}\n", row[0], x / 0.4e-3, row[2]);
    in_m += fmt::format("{},{},0.001,{}\n", row[0], x, row[2]);
  }
  CHECK(value(fit_of(in_px, "--pixel 0.4mm"), "slip") == Approx(value(fit_of(in_m), "slip")).epsilon(1e-6));
  check_rejected("fit - --ball pool", "column 'x [px]': pixels need a size: --pixel LENGTH", in_px);
  check_rejected("fit - --ball pool --pixel 1mm", "--pixel 1mm: no file has columns in px", in_m);
  check_rejected("fit - --ball pool --pixel 0", "a length > 0 is needed", in_px);
  check_rejected("fit - --ball pool", "--fps N says how many", frames);
  check_rejected("fit - --ball pool --fps 9", "--fps 9: no file has a column frame and no t", "t,slip\n0,1\n");
}

TEST_CASE("the figure has the textbook's motion beside slip and spin, and no ellipse of data without noise", "[cli]") {
  const Run run = run_program("fit - --ball pool --format svg", film(0, 0));
  INFO(run.err);
  CHECK(run.status == 0);
  CHECK_THAT(run.out, Contains("textbook (uncoupled)") && !Contains("where they lie"));
}

TEST_CASE("outliers are told", "[cli]") {
  const std::string text = film_with_outliers(20, 7);
  const auto noise = fit_of(text)["noise"]["slip"];
  CHECK(noise["outliers"] == 3);
  REQUIRE(noise["outliers_at"].size() == 3);
  const auto row = rows_of(film(0.01, 1))[8];
  CHECK(noise["outliers_at"][0] == nlohmann::json{{"file", "-"}, {"t", std::stod(row[0])}});
  CHECK_THAT(run_program("fit - --ball pool", text).out, Contains("slip: 3 of 61 values are off by more than 6") &&
                                                             Contains("of the others, at t = " + row[0]) &&
                                                             Contains("--robust"));
  CHECK_THAT(run_program("fit - --ball pool --robust", text).out,
             Contains("slip: 3 of 61 values") && !Contains("--robust"));
}

TEST_CASE("without degrees of freedom there is no reduced chi^2", "[cli]") {
  const auto fit = fit_of("t,slip\n0,1\n0.1,0.5\n", "--noise slip=0.01 --free friction,slip");
  CHECK(fit["degrees_of_freedom"] == 0);
  CHECK(fit["reduced_chi2"].is_null());
}

TEST_CASE("columns go by the names that trackers write, between tabs, too", "[cli]") {
  std::string usual = "t,x [mm],y [mm],angle [deg]\n", tracker = "puck\n Time\tX (mm)\tY (mm)\ttheta (deg)\n";
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  const auto roll = json_of("roll --ball puck --slip 2 --spin 30 --samples 60 --until 2 --format json");
  for (std::size_t i = 0; i < roll["t"].size(); ++i) {
    const double t = roll["t"][i], x = 1e3 * roll["x"][i].get<double>() + normal(random), y = normal(random);
    const double angle = 1700 * t - 300 * t * t + normal(random);
    usual += fmt::format("{},{},{},{}\n", t, x, y, angle);
    tracker += fmt::format("{}\t{}\t{}\t{}\n", t, x, y, angle);
  }
  const Run one = run_program("fit - --ball puck --format json --robust --noise angle=1deg", usual);
  const Run other = run_program("fit - --ball puck --format json --robust --noise theta=1deg", tracker);
  CHECK(other.err == one.err);
  CHECK(other.out == one.out);
  CHECK(one.out.size() > 500);
  check_rejected("fit - --ball pool", "<stdin>:3: slip: 'a' is not a number", "t\tslip\n0\t1\n1\ta\n");
  check_rejected("fit - --ball pool", "a comma or a tab must separate columns", "t;slip\n0;1\n");
}

TEST_CASE("standard deviations go by the name of the column", "[cli]") {
  std::string text = film(0.01, 1);
  const auto spin = fit_of(text, "--noise slip=0.01,spin=1");
  text.replace(text.find("spin"), 4, "wz");
  CHECK(fit_of(text, "--noise slip=0.01,wz=1") == spin);
  check_rejected("fit - --ball pool --noise wz=1,spin=1", "spin is given twice", text);
}

TEST_CASE("a puck by x and y has two motions that fit, and both are told", "[cli]") {
  const std::string film_of_it = read_file(CONTENSOU_PUCK_FILM);
  const std::string options = "--ball puck --noise x=0.002,y=0.002 ";
  const auto fit = nlohmann::json::parse(run_program("fit - --format json " + options, film_of_it).out);
  CHECK(value(fit, "spin") == Approx(64).epsilon(0.01));
  REQUIRE(fit["tracks"][0]["other_spins"].size() == 1);
  CHECK(fit["tracks"][0]["other_spins"][0].get<double>() == Approx(27.4).epsilon(0.02));
  CHECK(fit["friction"]["low"].get<double>() < 0.0985);
  CHECK(fit["friction"]["high"].get<double>() > 0.134);
  CHECK(fit["spin"]["low"].get<double>() < 27);
  CHECK_THAT(run_program("fit - " + options, film_of_it).out, Contains("another motion fits as well: friction 0.098"));
}

TEST_CASE("a film by t and one by frames are tracks of one ball", "[cli]") {
  const TemporaryDirectory scratch;
  write_file(scratch.file("t.csv"), film(0.01, 1));
  std::string frames = "frame,slip,spin\n";
  int frame = 0;
  for (const auto& row : rows_of(film(0.01, 1))) {
    if (row[0] != "t") frames += fmt::format("{},{},{}\n", frame++, row[1], row[2]);
  }
  write_file(scratch.file("frames.csv"), frames);
  const std::string t = scratch.file("t.csv");
  const auto same = json_of("fit " + t + " " + t + " --ball pool --format json");
  const auto mixed = json_of("fit " + t + " " + scratch.file("frames.csv") + " --fps 100 --ball pool --format json");
  CHECK(value(mixed, "friction") == Approx(value(same, "friction")).epsilon(1e-9));
}

TEST_CASE("several files are tracks of one ball", "[cli]") {
  const TemporaryDirectory scratch;
  write_file(scratch.file("a.csv"), film(0.01, 1));
  write_file(scratch.file("b.csv"), film(0.01, 1));
  const std::string options = " --ball pool --noise slip=0.01,spin=1 --format json";
  const auto one = json_of("fit " + scratch.file("a.csv") + options);
  const auto two = json_of("fit " + scratch.file("a.csv") + " " + scratch.file("b.csv") + options);
  CHECK(two["tracks"].size() == 2);
  CHECK(value(two, "friction") == Approx(value(one, "friction")).epsilon(1e-5));
  CHECK(two["friction"]["standard_error"].get<double>() ==
        Approx(one["friction"]["standard_error"].get<double>() / std::sqrt(2)).epsilon(0.02));
}

TEST_CASE("fit says what is wrong with a track, and where, and writes nothing", "[cli]") {
  const std::string fit = "fit - --ball pool";
  check_rejected("fit", "--ball missing");
  check_rejected("fit --ball pool", "FILE missing");
  check_rejected(fit, "<stdin>:1: a track has a column t and one or more of slip, spin, x, y, vx, vy, angle",
                 "a,b\n1,2\n");
  check_rejected(fit, "did you mean 'slip'?", "t,slp\n1,2\n");
  check_rejected(fit, "no t is here", "slip,spin\n1,2\n");
  const std::string track = "t,slip,spin\n0,1,100\n0.1,0.4,99\n0.3,0,97\n";
  const std::string given = fit + " --noise slip=0.01,spin=1 --free friction,slip,spin ";
  check_rejected(given + "--law ring --patch-radius 28mm", "to 0.0237 m is required under the law ring; got 0.028",
                 track);
  check_rejected(given + "--patch-radius 1e-9", "patch_radius from 2.38e-08 to", track);
  check_rejected("fit --plan --ball pool --friction 20 --fps 60 --until 0.3 --noise slip=0.01,spin=1",
                 "friction from 0.000101 to 9.97 is required under the law exact; got 20");
  CHECK(run_program(fit + " --noise slip=0.01,spin=1 --law ring --patch-radius 28mm", track).status ==
        0);  // a start only
  check_rejected(fit, "two columns are called 'slip'", "t,slip,slip [m/s]\n1,2,3\n");
  check_rejected(fit, "'furlong' is no unit of it: use m/s, cm/s", "t,slip [furlong]\n1,2\n");
  check_rejected(fit, "spin_sd is the standard deviation of spin, which is not there", "t,slip,spin_sd\n1,2,3\n");
  check_rejected(fit, "<stdin>:3: slip: 'x' is not a number", "t,slip\n0,1\n1,x\n");
  check_rejected(fit, "<stdin>:3: 2 fields where the header has 3", "t,slip,spin\n0,1,2\n1,2\n");
  check_rejected(fit, "<stdin>:3: t must increase: 0 follows 0", "t,slip\n0,1\n0,1\n");
  check_rejected(fit, "<stdin>:2: slip_sd: a standard deviation > 0 is required, got 0", "t,slip,slip_sd\n0,1,0\n");
  check_rejected(fit, "slip has 3 values and no standard deviations", "t,slip\n0,1\n1,0.5\n2,0.1\n");
  check_rejected(fit + " --noise slap=1", "did you mean 'slip'", "t,slip\n0,1\n");
  check_rejected(fit + " --noise slip=0", "a standard deviation is > 0", "t,slip\n0,1\n");
  check_rejected(fit + " --noise slip", "NAME=SD", "t,slip\n0,1\n");
  check_rejected(fit + " --free sleep", "did you mean 'slip'", "t,slip\n0,1\n");
  check_rejected(fit + " --law exact,pdae", "did you mean 'pade'", "t,slip\n0,1\n");
  check_rejected(fit + " --noise slip=0.1,slip=0.2", "slip is given twice", "t,slip\n0,1\n");
  check_rejected(fit + " --noise x=0.1", "no file has a column x", "t,slip\n0,1\n");
  check_rejected("fit --stop-time 9 --ball pool", "add --noise stop=SD");
  check_rejected("fit --plan --ball pool", "--plan needs --fps N and --noise");
  check_rejected("fit --plan --radius 28.6mm --fps 240 --noise x=0.4mm",
                 "--plan needs --friction F and --patch-radius LENGTH and a start, --slip V, --spin W or both");
  check_rejected("fit --plan --ball pool --fps 1e9 --noise slip=1", "pictures; 2 to 1e+07 are allowed");
  check_rejected(fit, "<stdin>:3: slip_sd: empty beside a slip that was measured", "t,slip,slip_sd\n0,1,0.1\n1,0.5,\n");
  const TemporaryDirectory scratch;
  check_rejected(fit + " -o " + scratch.file("fit.json"), "<stdin>:3", "t,slip\n0,1\n0,1\n");
  CHECK(scratch.names().empty());
  write_file(scratch.file("pressure.csv"), "rho,pressure\n0,1\n0.5,0.5625\n1,0\n");
  check_rejected(given + "-o " + scratch.file("ball.toml") + " --law " + scratch.file("pressure.csv"),
                 "a run file has a law by its name or its formulas", track);
  CHECK(scratch.names() == std::vector<std::string>{"pressure.csv"});
}

TEST_CASE("a slip below 0 by more than its error is no speed", "[cli]") {
  const Run run =
      run_program("fit - --ball pool --noise slip=0.01,spin=1",
                  "t,slip,spin\n0,-1,100\n0.05,-0.74,99.6\n0.1,-0.5,99.1\n0.2,-0.15,98.2\n0.3,-0.02,97.1\n");
  CHECK(run.status == 1);
  CHECK_THAT(run.err, Contains("this does not fit: the slip at the start is -") && Contains("turn the sign"));
}

TEST_CASE("columns that are not read are named, an empty field was not measured", "[cli]") {
  std::string text = "frame," + film(0.01, 1);
  std::size_t place = text.find('\n') + 1;
  for (int i = 0; place < text.size(); ++i) {
    text.insert(place, fmt::format("{},", i));
    const std::size_t end = text.find('\n', place);
    if (i % 3 == 1) text.erase(text.rfind(',', end) + 1, end - text.rfind(',', end) - 1);
    place = text.find('\n', place) + 1;
  }
  const Run run = run_program("fit - --ball pool --format json", text);
  CHECK(run.status == 0);
  CHECK_THAT(run.err, Contains("column 'frame' is not read"));
  const auto fit = nlohmann::json::parse(run.out);
  CHECK(fit["noise"]["slip"]["values"] == 61);
  CHECK(fit["noise"]["spin"]["values"] == 41);
  CHECK(value(fit, "friction") == Approx(0.2).epsilon(0.05));
}

TEST_CASE("a column wz, as a motion in CSV has it, is the spin; beside a spin it is not read", "[cli]") {
  const std::string text = film(0, 1);
  std::string as_wz = text, both;
  as_wz.replace(as_wz.find("spin"), 4, "wz");
  CHECK(fit_of(as_wz) == fit_of(text));
  for (const auto& row : rows_of(text))
    both += fmt::format("{},{},{},{}\n", row[0], row[1], row[2], row[0] == "t" ? "wz" : "7");
  const Run run = run_program("fit - --ball pool --format json", both);
  CHECK_THAT(run.err, Contains("column 'wz' is not read"));
  CHECK(value(nlohmann::json::parse(run.out), "friction") == Approx(0.2).epsilon(1e-6));
  CHECK_THAT(run_program("fit --help").out, Contains("[FILE...]"));
}
