#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <catch2/catch.hpp>

#include "run_program.hpp"

using Catch::Matchers::Contains;

namespace {

using Json = nlohmann::json;

Run reduce(const std::string& system, std::vector<std::string> more = {"--u0", "1", "--v0", "1"}) {
  more.insert(more.begin(), {"reduce", "--system", system});
  return run_program(more);
}

Json json_of_system(const std::string& system, std::vector<std::string> more = {"--u0", "1", "--v0", "1"}) {
  more.insert(more.end(), {"--format", "json"});
  const Run run = reduce(system, more);
  INFO(system << run.err);
  CHECK(run.err.empty());
  CHECK((run.status == 0 || run.status == 1));
  return Json::parse(run.out);
}

}  // namespace

TEST_CASE("reduce finds the symmetry of the paper's system, and all routes agree", "[cli]") {
  for (const std::string start : {"--mu 0.3 --u0 1 --v0 1", "--mu 0.3 --u0 -2 --v0 1e-3 --law pade", "--ball pool",
                                  "--mu 1 --u0 1 --v0 1 --body disc", "--mu 0.3 --u0 0 --v0 1"}) {
    INFO(start);
    const Json reduced = json_of("reduce " + start + " --format json");
    REQUIRE(reduced["generators"].size() == 1);
    CHECK(reduced["generators"][0] == Json::parse(R"({"time": 1, "matrix": [[1, 0], [0, 1]], "shift": [0, 0]})"));
    REQUIRE(reduced["singular_values"].size() == 7);
    CHECK(reduced["singular_values"][0] < 1e-12);
    CHECK(reduced["singular_values"][6] == 1);
    CHECK(reduced["gap"] > 1e6);
    CHECK(reduced["kind"] == "stable node");
    const double tau = reduced["tau_stop"];
    CHECK(tau == json_of("stop " + start + " --format json")["tau_stop"]);
    CHECK(reduced["routes"].size() >= 4);
    CHECK(reduced["routes"].back()["name"] == "section");
    for (const Json& route : reduced["routes"]) {
      CHECK(route["tau_stop"].get<double>() == Approx(tau).epsilon(route["name"] == "section" ? 1e-13 : 1e-9));
    }
  }
}

TEST_CASE("reduce: canonical coordinates, rays and the first integral of the paper's system", "[cli]") {
  const Json ray = json_of("reduce --law uniform --body disc --mu 1 --u0 -1 --v0 2 --format json");
  REQUIRE(ray["rays"].size() == 3);
  CHECK(ray["rays"][0] == Json::parse(R"({"k": 0, "attracts": false})"));
  CHECK(ray["rays"][1]["k"].get<double>() == Approx(0.653001789205597639).epsilon(1e-14));
  CHECK(ray["rays"][1]["attracts"] == true);
  CHECK(ray["rays"][2] == Json::parse(R"({"k": "inf", "attracts": false})"));
  CHECK(ray["canonical"]["q"] == -2);
  CHECK(ray["canonical"]["p"].get<double>() == std::log(2.0));
  const Json one = json_of("reduce --mu 0.3 --u0 1 --v0 1 --format json"),
             three = json_of("reduce --mu 0.3 --u0 3 --v0 3 --format json");
  CHECK(three["first_integral"].get<double>() - one["first_integral"].get<double>() ==
        Approx(std::log(3)).epsilon(1e-14));
  CHECK(one["canonical"]["dp_dq"] == three["canonical"]["dp_dq"]);
  CHECK(json_of("reduce --mu 0.3 --u0 0 --v0 1 --format json")["canonical"]["q"] == "inf");
}

TEST_CASE("reduce: the orbit as a curve of the strip, and the starts of its copies", "[cli]") {
  for (const std::string start :
       {"--mu 0.3 --u0 1 --v0 1", "--mu 1e-3 --u0 -2 --v0 5", "--body disc --mu 1 --u0 1 --v0 3"}) {
    INFO(start);
    const Json reduced = json_of("reduce " + start + " --format json");
    REQUIRE(reduced["strip"].size() == 1);
    const Json& strip = reduced["strip"][0];
    REQUIRE(strip["p"].size() >= 50);
    CHECK(strip["p"].size() <= 101);
    for (std::size_t i = 0; i < strip["p"].size(); ++i) {
      const double u = strip["u"][i], v = strip["v"][i], left = strip["tau_left"][i];
      if (strip["p"][i] < -700) {  // then v is near the least double and has few correct digits
        CHECK(v <= 1e-300);
        continue;
      }
      CHECK(std::log(v) == Approx(strip["p"][i].get<double>()).epsilon(1e-12).margin(1e-12));
      CHECK(std::log(v / (reduced["mu"].get<double>() * std::abs(u))) ==
            Approx(strip["ln_k"][i].get<double>()).epsilon(1e-12).margin(1e-12));
      if (i % 10 != 0) continue;
      const std::string there = fmt::format(" --u0 {} --v0 {} --format json", u, v);
      const Json other = json_of("reduce " + start.substr(0, start.find("--u0")) + there);
      CHECK(other["first_integral"].get<double>() ==
            Approx(reduced["first_integral"].get<double>()).epsilon(1e-10).margin(1e-10));
      CHECK(other["tau_stop"].get<double>() == Approx(left).epsilon(1e-13));
    }
    REQUIRE(reduced["copies"].size() == 6);
    for (const Json& copy : reduced["copies"]) {
      const double factor = copy["factor"];
      for (const char* name : {"u0", "v0", "tau_stop"}) {
        CHECK(copy[name].get<double>() == Approx(factor * reduced[name].get<double>()).epsilon(1e-13));
      }
    }
  }
  const Json weighted = json_of_system("u' = v; v' = -sign(u) - 0.5*sign(v)", {"--u0", "0.5", "--v0", "1"});
  for (const Json& piece : weighted["strip"]) CHECK(piece["q"].size() == piece["tau_left"].size());
  for (const Json& copy : weighted["copies"]) {  // v and t have the same weight, and u has twice this weight
    const double factor = copy["factor"];
    CHECK(copy["u0"].get<double>() == Approx(0.5 * factor).epsilon(1e-13));
    CHECK(copy["v0"].get<double>() == Approx(std::sqrt(factor)).epsilon(1e-13));
    CHECK(copy["tau_stop"].get<double>() ==
          Approx(std::sqrt(factor) * weighted["tau_stop"].get<double>()).epsilon(1e-12));
  }
  // Long before the start, speeds overflow.
  const Json far =
      json_of("reduce --mu 1 --law phi=k/hypot(1,k);psi=1/(1+2*k) --body disc --u0 1 --v0 3 --format json");
  CHECK(far["strip"][0]["u"].size() == far["strip"][0]["tau_left"].size());
  CHECK_FALSE(json_of("reduce --mu 0.3 --u0 0 --v0 1 --format json").contains("strip"));
}

TEST_CASE("reduce --system: known answers", "[cli]") {
  // dry friction with the same limit for u and v; r' = -1 for r = hypot(u, v)
  const Json friction = json_of_system("u' = -u/hypot(u,v); v' = -v/hypot(u,v)", {"--u0", "3", "--v0", "-4"});
  CHECK(friction["kind"] == "stable star");
  CHECK(friction["tau_stop"].get<double>() == Approx(5).epsilon(1e-13));
  // The same friction on a slope a. On v = 0 the slope alone acts on v. From (0, v) the stop takes v/(1 + a).
  const std::string slope = "u' = -u/hypot(u,v); v' = -v/hypot(u,v) - a";
  const Json down = json_of_system(slope, {"--param", "a=0.25", "--u0", "0", "--v0", "1"});
  CHECK(down["tau_stop"].get<double>() == Approx(1 / 1.25).epsilon(1e-13));
  CHECK(json_of_system(slope, {"--param", "a=1.5", "--u0", "1", "--v0", "1"})["end"] == "infinity");
  const Json focus = json_of_system("v' = u - a*v; u' = -a*u - v", {"--param", "a=0.1", "--u0", "1", "--v0", "1"});
  CHECK(focus["kind"] == "stable focus");
  CHECK(focus["generators"].size() == 2);
  CHECK(focus["turn"]["factor"].get<double>() == Approx(std::exp(-0.2 * std::numbers::pi)).epsilon(1e-13));
  CHECK(focus["turn"]["sigma"].get<double>() == Approx(2 * std::numbers::pi).epsilon(1e-13));
  CHECK(focus["tau_stop"] == "inf");
  const Json oscillator = json_of_system("u' = v; v' = -u*|u|^2", {"--u0", "1", "--v0", "0"});
  CHECK(oscillator["generators"][0] == Json::parse(R"({"time": -0.5, "matrix": [[0.5, 0], [0, 1]], "shift": [0, 0]})"));
  CHECK(oscillator["end"] == "periodic");
}

TEST_CASE("a formula's rint and && are those of every other build", "[cli]") {
  for (const std::string twice : {"(1+rint(0.5)+(0.5 && 0.5))", "rint(2.5)", "--2"}) {
    const std::string system = fmt::format("u' = -u/hypot(u,v)*{0}; v' = -v/hypot(u,v)*{0}", twice);
    CHECK(json_of_system(system, {"--u0", "1", "--v0", "0"})["tau_stop"].get<double>() == Approx(0.5).epsilon(1e-12));
  }
}

TEST_CASE("formulas: bars, functions, constants and parameters", "[cli]") {
  const auto time_of = [](const std::string& speed) {
    // at the start (2, 1) the field is -speed (1, 2); each formula of `speed` below has the value 5
    return json_of_system("u' = -sign(u)*(" + speed + "); v' = -2*sign(v)*(" + speed + ")",
                          {"--param", "a=3", "--param", "b_1=-2", "--u0", "2", "--v0", "1"})["canonical"]["dp_dq"];
  };
  const auto reference = time_of("5*a^0*b_1^0");
  for (const std::string formula :
       {"|b_1| + a + 0*|u|", "||b_1| - |-a||+2*|b_1|*a/a^1", "|a*b_1|-1+0*|a|*|b_1|", "hypot(a, 4)+0*b_1",
        "sqrt(25)+0*(a+b_1)", "exp(log(5))+0*a*b_1", "5*sin(pi/2)+0*a*b_1", "(a > b_1 ? 5 : 1)", "-b_1^2+a^2",
        "|-5|*abs(-1)+0*a*b_1", "1e1/2+0*a*b_1", "max(a, 5, b_1)"}) {
    INFO(formula);
    CHECK(time_of(formula).get<double>() == Approx(reference.get<double>()).epsilon(1e-13));
  }
}

TEST_CASE("reduce finds the generator whatever the start, and says what has no value", "[cli]") {
  for (const std::string start : {"--mu 1e-8 --u0 1 --v0 10", "--mu 1e-7 --u0 1 --v0 1", "--mu 1e-9 --u0 1e-3 --v0 1e3",
                                  "--mu 1 --u0 1e-6 --v0 1e6"}) {
    INFO(start);
    const Json reduced = json_of("reduce " + start + " --format json");
    CHECK(reduced["generators"].size() == 1);
    CHECK(reduced["gap"] > 1e3);
  }
  const std::string on_ray =
      "--body disc --u0 1 --v0 " + json_of("terminal --body disc --format json")["k_star"].dump();
  const Json ray = json_of("reduce " + on_ray + " --format json");
  CHECK_FALSE(ray.contains("first_integral"));
  CHECK_THAT(run_program("reduce " + on_ray).out, Contains("integral    none: the start is on the ray"));
  CHECK_THAT(run_program("reduce --mu 0.3 --u0 0 --v0 1").out, Contains("integral    none: the start is on the ray"));
  CHECK_THAT(reduce("u' = -u; v' = -3*v", {"--u0", "1", "--v0", "0"}).out, Contains("integral    none"));
}

TEST_CASE("reduce --system solves a relay about u = 1", "[cli]") {
  const Json relay = json_of_system("u' = v; v' = -sign(u-1) - 0.3*sign(v)", {"--u0", "1.5", "--v0", "2"});
  CHECK(relay["kind"] == "stable focus");
  const double a = 0.7, b = 1.3, out = 2 / b, in = std::sqrt((1 + 4 * out - b * out * out) / a);
  const double half_turn = a * in / b + in * std::sqrt(a / b);
  CHECK(relay["tau_stop"].get<double>() == Approx(out + in + half_turn / (1 - std::sqrt(a / b))).epsilon(1e-12));
}

TEST_CASE("reduce --system is right about multiple rays and poles, or says that it does not know", "[cli]") {
  struct Case {
    std::string system;
    std::vector<std::string> start;
    Json kind, end, tau_stop;
  };
  const std::vector<Case> cases{
      {"u' = v; v' = 0", {"--u0", "1", "--v0", "1"}, "degenerate", "infinity", "inf"},
      {"u' = -u-v; v' = u+v", {"--u0", "1", "--v0", "1"}, "degenerate", "infinity", "inf"},
      {"u' = v; v' = -u-2*v", {"--u0", "1", "--v0", "0.5"}, "stable node", "centre", "inf"},
      {"u' = v; v' = -u-2*v", {"--u0", "1.3", "--v0", "0.7"}, "stable node", "centre", "inf"},
      {"u' = 3*u+v; v' = -u+v", {"--u0", "1", "--v0", "0.5"}, "unstable node", "infinity", "inf"},
      {"u' = u; v' = 2*v+u^2", {"--u0", "1", "--v0", "0.5"}, "unstable node", "infinity", "inf"},
      {"u' = u; v' = 2*v+u^2", {"--u0", "1.3", "--v0", "0.7"}, "unstable node", "infinity", "inf"},
      {"u' = 1; v' = 3*u+2*v^2/u^3", {"--u0", "1.3", "--v0", "0.7"}, "bordered", "infinity", "inf"},
      {"u' = 1; v' = 3*v/u-u", {"--u0", "1.3", "--v0", "0.7"}, "bordered", "infinity", "inf"},
      {"u' = 0.5*u^2/v; v' = u-0.5*v", {"--u0=-1", "--v0", "1"}, "bordered", "centre", 2 * std::log(2)},
      {"u' = 1; v' = v/u+u", {"--u0", "1", "--v0", "1"}, "bordered", "infinity", "inf"},
      {"u' = -u^3; v' = -v^3/2-u^2*v", {"--u0", "1", "--v0", "1"}, "stable node", "centre", "inf"},
      {"u' = -u^99; v' = -v^99", {"--u0", "1", "--v0", "1.5"}, "stable node", "centre", "inf"},
  };
  for (const auto& [system, start, kind, end, tau_stop] : cases) {
    CAPTURE(system, start);
    Json json = json_of_system(system, start);  // missing members become null
    CHECK(json["kind"] == kind);
    CHECK(json["end"] == end);
    if (tau_stop.is_number()) {
      CHECK(json["tau_stop"].get<double>() == Approx(tau_stop.get<double>()).epsilon(json["accuracy"].get<double>()));
    } else {
      CHECK(json["tau_stop"] == tau_stop);
    }
    CHECK(json.contains("undecided") == kind.is_null());
  }
}

TEST_CASE("reduce far from 1", "[cli]") {
  const std::string friction = "u' = -u/hypot(u,v); v' = -v/hypot(u,v)";
  for (const std::string size : {"1e-155", "1e160"}) {
    const double unit = std::stod(size);
    CHECK(json_of_system(friction, {"--u0", size, "--v0", size})["tau_stop"].get<double>() ==
          Approx(std::sqrt(2) * unit).epsilon(1e-13));
    const std::string start = "--mu 0.3 --u0 " + size + " --v0 " + size + " --format json";
    const Json reduced = json_of("reduce " + start);
    CHECK(reduced["routes"].back()["tau_stop"].get<double>() ==
          Approx(reduced["tau_stop"].get<double>()).epsilon(1e-12));
  }
}

TEST_CASE("reduce --system draws sectors too narrow for a double's steps", "[cli]") {
  const Json reduced = json_of_system(
      "u' = -1.6205530169776787*|u|^0.75*sign(u) + 2.2514064359057695*|v|^0.25*sign(v); "
      "v' = -1.4636216884412168*|v|^(11/12)*sign(v)",
      {"--u0", "0.2625076190219131", "--v0", "1.6067465764203765"});
  CHECK(reduced["end"] == "centre");
  CHECK(reduced["strip"].size() == 1);
}

TEST_CASE("reduce solves systems without a scaling by an inverse integrating factor", "[cli]") {
  struct Case {
    const char* system;
    const char* form;
  };
  for (const auto& [system, form] : {Case{"x'' = -sin(x)", "constant"},
                                     {"u' = u*(1-v); v' = v*(u-1)", "polynomial"},
                                     {"y' = x*y", "affine"},
                                     {"y' = x - y**2", "quadratic in v"},
                                     {"y' = y*cos(x) + y^2*x", "quadratic in v"}}) {
    INFO(system);
    const Json reduced = json_of_system(system, {"--u0", "1.3", "--v0", "0.7"});
    CHECK(reduced["form"] == form);
    CHECK(reduced["tried"].back()["form"] == form);
    CHECK(reduced["by_steps"]["difference"] < 1e-10);
    CHECK(reduce(system, {"--u0", "1.3", "--v0", "0.7"}).status == 0);
  }
  // A pendulum that starts at rest at the angle 1 has the period 4 K(k), k = sin(1/2).
  const Json pendulum = json_of_system("x'' = -sin(x)", {"--u0", "1", "--v0", "0"});
  CHECK(pendulum["period"].get<double>() == Approx(6.6999756643704523).epsilon(1e-12));
  CHECK(pendulum["end"] == "periodic");
  const Json none = json_of_system("u' = v; v' = (1-u^2)*v-u");
  CHECK(none["form"].is_null());
  CHECK(none["tried"].size() == 8);
  CHECK(reduce("u' = v; v' = (1-u^2)*v-u").status == 1);
  const Json pole = json_of_system("y' = -y*tan(x)+sin(2*x)", {"--u0", "1.3", "--v0", "0.7"});
  CHECK(pole["end"] == "border");
  CHECK(pole["tau_stop"].is_null());
  const Run picture = reduce("x'' = -sin(x)", {"--u0", "1", "--v0", "0", "--format", "svg"});
  CHECK(picture.status == 2);
  CHECK_THAT(picture.err, Contains("this system has none"));
}

TEST_CASE("reduce solves from an equilibrium, and with a drive from v = 0", "[cli]") {
  const Json rest = json_of_system("u' = u*(1-v); v' = v*(u-1)");
  CHECK(rest["form"] == "polynomial");
  CHECK(rest["end"] == "equilibrium");
  const Json creeping = json_of("reduce --mu 0.3 --u0 1 --v0 0 --drive 0.2 --format json");
  CHECK(creeping["tau_stop"] == json_of("stop --mu 0.3 --u0 1 --v0 0 --drive 0.2 --format json")["tau_stop"]);
  CHECK_FALSE(creeping.contains("first_integral"));
  CHECK(creeping["routes"].back().contains("failure"));  // two motions begin on v = 0
}

TEST_CASE("reduce solves quotients with their denominator cleared", "[cli]") {
  const std::vector<std::string> start{"--u0", "1.3", "--v0", "0.7"};
  const Json plain = json_of_system("y' = x/y + 1/(x*y)", start);
  CHECK_FALSE(plain["tried"].back().contains("cleared"));
  // The inverse integrating factor V is no polynomial, but V times the common denominator D is one.
  const Json reduced = json_of_system("y' = (y^2-3*x^2*y+x)/(x^3-2*x*y)", start);
  CHECK(reduced["form"] == "constant");
  CHECK(reduced["tried"].back()["cleared"] == true);
  CHECK(reduced["factor"] == "1 divided by the denominator");
  CHECK(reduced["by_steps"]["difference"] < 1e-9);
}

TEST_CASE("reduce recognises V and H", "[cli]") {
  struct Case {
    const char *system, *factor, *integral;
  };
  const std::vector<std::string> start{"--u0", "1.3", "--v0", "0.7"};
  for (const auto& [system, factor, integral] :
       {Case{"x'' = -sin(x)", "1", "-cos(u) + v^2/2"}, Case{"x'' = x - x^3", "1", "-u^2/2 + u^4/4 + v^2/2"},
        Case{"u' = u*(1-v); v' = v*(u-1)", "u v", "-u + ln|u| - v + ln|v|"},
        Case{"u' = -v+u*(1-u^2-v^2); v' = u+v*(1-u^2-v^2)", "(u^2 + v^2) (1 - u^2 - v^2)", ""},
        Case{"u' = u*(1-u)*v; v' = v*(1-u)*(1+u)*0.3", "u v (1 - u)", "-3 u/10 - 3 ln|u|/10 + v"}}) {
    INFO(system);
    const Json reduced = json_of_system(system, start);
    CHECK(reduced["factor"] == factor);
    CHECK(reduced.value("integral", "") == integral);
  }
  // The program writes no formula of V if coefficients are not rational.
  CHECK(json_of_system("u' = u*(1-v)+sqrt(2)*u^2; v' = v*(u-1)", start)["factor"] != "");
  CHECK(json_of_system("y' = x - y**2", start)["factor"] == "quadratic in v, 1 at the start");
}

TEST_CASE("reduce looks for V in a basis of one's own", "[cli]") {
  const Json reduced = json_of_system("u' = v; v' = -sin(u)", {"--u0", "1", "--v0", "1", "--basis", "1; u; exp(u)"});
  CHECK(reduced["form"] == "basis");
  CHECK(reduced["factor"] == "1");
  CHECK(reduced["tried"].size() == 1);
  // For Kamke's equation 1.114 no form that is tried is an inverse integrating factor.
  const std::string equation = "y' = sqrt(x^2+y^2) + a*y/x";
  const std::vector<std::string> start{"--u0", "1.3", "--v0", "0.7", "--param", "a=1"};
  CHECK(json_of_system(equation, start)["form"].is_null());
  std::vector<std::string> with_basis = start;
  with_basis.insert(with_basis.end(), {"--basis", "1; x; y; a*sqrt(x^2+y^2)"});
  const Json kamke = json_of_system(equation, with_basis);
  CHECK(kamke["factor"] == "a*sqrt(x^2+y^2)");
  CHECK(kamke["by_steps"]["difference"] < 1e-10);
  const Run none = reduce("u' = v; v' = -sin(u)", {"--u0", "1", "--v0", "1", "--basis", "u; exp(u)"});
  CHECK(none.status == 1);
  const Run wrong = reduce("u' = v; v' = -sin(u)", {"--u0", "1", "--v0", "1", "--basis", "u; epx(u)"});
  CHECK(wrong.status == 2);
  CHECK_THAT(wrong.err, Contains("--basis: 'epx'") && Contains("at character 1 of 'epx(u)'"));
}

TEST_CASE("reduce --system shows equilibria and reversors, solved or not", "[cli]") {
  const Json pendulum = json_of_system("x'' = -sin(x)", {"--u0", "1.3", "--v0", "0"});
  REQUIRE(pendulum["equilibria"].size() == 3);
  const Json& middle = pendulum["equilibria"][1];
  CHECK(std::hypot(middle["u"].get<double>(), middle["v"].get<double>()) < 1e-12);
  CHECK(middle["kind"] == "center");
  CHECK(middle["eigenvalues"] == Json::parse("[[0, -1], [0, 1]]"));
  CHECK(pendulum["equilibria"][0]["kind"] == "saddle");
  CHECK(pendulum["equilibria"][2]["u"].get<double>() == Approx(std::numbers::pi).epsilon(1e-13));
  CHECK(pendulum["reversors"] == Json::array({"(u, -v)", "(-u, v)"}));
  const Json van_der_pol = json_of_system("u' = v; v' = (1-u^2)*v-u");
  CHECK(van_der_pol["equilibria"][0]["kind"] == "unstable focus");
  CHECK(van_der_pol["reversors"].empty());
  // The field has no reversor. But V = u v is not 0 at the center, which proves the center.
  const Json rabbits = json_of_system("u' = u*(1-v); v' = v*(2*u-1)", {"--u0", "1", "--v0", "1.1"});
  CHECK(rabbits["reversors"].empty());
  CHECK(rabbits["equilibria"][1]["kind"] == "center");
  CHECK(json_of_system("u' = 1; v' = 2*v").at("equilibria").empty());
  const Json competition = json_of_system("x' = (1-x-y)*x; y' = (4-7*x-3*y)*y");
  CHECK(competition["equilibria"].size() == 4);
  CHECK(competition["equilibria"][2]["kind"] == "saddle");
  CHECK(competition["equilibria"][2]["index"] == -1);
  CHECK(competition["equilibria_within"] == Json::parse("[[-2.5, 2.5], [-2.5, 2.5]]"));
  CHECK(competition["equilibria_complete"] == true);
  const Json friction = json_of_system("x'' = -x-0.2*sign(x')", {"--u0", "2", "--v0", "0"});
  REQUIRE(friction["equilibria"].size() == 1);
  CHECK(friction["equilibria"][0]["kind"] == "not smooth");
  CHECK(friction["equilibria"][0]["eigenvalues"].is_null());
  // A scaling alone, with a turn that multiplies by 1, proves a center.
  CHECK(json_of_system("u' = 2*u + 5*v; v' = -u - 2*v")["equilibria"][0]["kind"] == "center");
  const Json cusp = json_of_system("u' = v; v' = u^2");
  CHECK(cusp["equilibria"][0]["kind"] == cusp["kind"]);
  CHECK_FALSE(json_of("reduce --mu 0.3 --u0 1 --v0 1 --format json").contains("equilibria"));
}
