#include "contensou/si/run_file.hpp"

#include <algorithm>
#include <charconv>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "contensou/reduction/laws.hpp"
#include "contensou/si/catalogue.hpp"

using namespace contensou::si;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

// toml++ reads numbers by streams, which reject subnormal numbers, if the library has no std::from_chars for doubles.
#ifdef __cpp_lib_to_chars
constexpr double smallest = std::numeric_limits<double>::denorm_min();
#else
constexpr double smallest = std::numeric_limits<double>::min();
#endif

const std::string good = R"([ball]
name = "pool ball on cloth"
mass = 0.1701
radius = 0.028575
[contact]
friction = 0.2
spin_deceleration = 10
[start]
slip = 1.0
spin = 100
)";

using Given = std::vector<std::pair<const Quantity*, std::vector<double>>>;

/// Returns the description that options give.
Description options(const Given& given) {
  Description above;
  for (const auto& [quantity, values] : given)
    above.set(*quantity, values, {"", "--" + std::string(quantity->name), ""});
  return above;
}

/// Returns the experiment of a run file, in which values of options replace values of the file.
Experiment read(const std::string& text, const std::string& source, const Given& given = {}) {
  return experiment_of(parse_run_file(text, source).under(options(given)));
}

std::string with(std::string text, const std::string& old, const std::string& replacement) {
  const auto at = text.find(old);
  REQUIRE(at != std::string::npos);
  return text.replace(at, old.size(), replacement);
}

bool same(const PatchSource& a, const PatchSource& b) {
  if (a.index() != b.index()) return false;
  if (std::holds_alternative<WholeFace>(a)) return true;
  if (const auto* x = std::get_if<PatchRadius>(&a)) return x->value == std::get<PatchRadius>(b).value;
  if (const auto* x = std::get_if<SpinDeceleration>(&a)) return x->value == std::get<SpinDeceleration>(b).value;
  const auto& x = std::get<HertzModuli>(a);
  const auto& y = std::get<HertzModuli>(b);
  return x.youngs_modulus == y.youngs_modulus && x.poisson_ratio == y.poisson_ratio;
}

void check_same(const Experiment& a, const Experiment& b) {
  CHECK(a.ball.name == b.ball.name);
  CHECK(a.ball.mass == b.ball.mass);
  CHECK(a.ball.radius == b.ball.radius);
  CHECK(a.contact.friction == b.contact.friction);
  CHECK(a.contact.rolling_friction == b.contact.rolling_friction);
  CHECK(same(a.contact.patch, b.contact.patch));
  CHECK(a.start.index() == b.start.index());
  CHECK(velocities_of(a.start).velocity == velocities_of(b.start).velocity);
  CHECK(velocities_of(a.start).angular_velocity == velocities_of(b.start).angular_velocity);
  CHECK(a.environment.gravity == b.environment.gravity);
}

}  // namespace

TEST_CASE("a run file in full", "[table]") {
  const Experiment experiment = read(good, "x.toml");
  CHECK(experiment.ball.name == "pool ball on cloth");
  CHECK(experiment.ball.mass == 0.1701);
  CHECK(experiment.ball.radius == 0.028575);
  CHECK(experiment.contact.friction == 0.2);
  CHECK(std::get<SpinDeceleration>(experiment.contact.patch).value == 10);
  CHECK(slip_at_start(experiment) == 1);
  CHECK(spin_at_start(experiment) == 100);
  CHECK(experiment.environment.gravity == 9.80665);
  CHECK(read(good + "[environment]\ngravity = 1.62\n", "x.toml").environment.gravity == 1.62);
  const std::string hertz =
      with(good, "spin_deceleration = 10", "hertz = {youngs_modulus = [2.1e11, 7.0e10], poisson_ratio = [0.3, 0.22]}");
  const auto moduli = std::get<HertzModuli>(read(hertz, "x.toml").contact.patch);
  CHECK(moduli.youngs_modulus[1] == 7.0e10);
  CHECK(moduli.poisson_ratio[0] == 0.3);
}

TEST_CASE("what is written reads back to the same doubles", "[invariant]") {
  for (const CatalogueEntry& entry : catalogue()) {
    INFO(entry.name);
    check_same(read(run_file(entry.experiment, entry.sources), entry.name), entry.experiment);
  }
  const Experiment awkward{
      .ball = {.name = "a \"quoted\" 'name' with \\ and \xC3\xA9", .mass = 1.0 / 3, .radius = 1e300},
      .contact = {.friction = smallest, .patch = PatchRadius{1e299 / 3}},
      .start = SlipAndSpin{.slip = 12345678901234567890.0, .spin = -0.1},
      .environment = {.gravity = 123456789}};
  check_same(read(run_file(awkward, "a remark\n\nof three lines"), "awkward"), awkward);
}

TEST_CASE("a start may be given by its velocities", "[table]") {
  const std::string general =
      with(with(good, "slip = 1.0", "velocity = [1, -0.5]"), "spin = 100", "angular_velocity = [3, 1e3, -7.5]");
  const Experiment experiment = read(general, "x.toml");
  const auto& start = std::get<Velocities>(experiment.start);
  CHECK(start.velocity == Eigen::Vector2d(1, -0.5));
  CHECK(start.angular_velocity == Eigen::Vector3d(3, 1000, -7.5));
  check_same(read(run_file(experiment), "written"), experiment);
  const Experiment awkward{.ball = experiment.ball,
                           .contact = experiment.contact,
                           .start = Velocities{{1.0 / 3, -smallest}, {12345678901234567890.0, 0, -1e-300}}};
  check_same(read(run_file(awkward), "written"), awkward);
}

TEST_CASE("a run file may leave out the mass, unless something needs it", "[table]") {
  const std::string without = with(good, "mass = 0.1701\n", "");
  const Experiment experiment = read(without, "x.toml");
  CHECK_FALSE(mass_is_known(experiment.ball));
  const std::string written = run_file(experiment);
  CHECK_THAT(written, !Contains("mass") && StartsWith("[ball]\nname = "));
  CHECK_FALSE(mass_is_known(read(written, "written").ball));
  CHECK(read(without, "x.toml", {{&mass, {0.5}}}).ball.mass == 0.5);
}

TEST_CASE("velocities take the place of a start, one or both", "[table]") {
  const Velocities kept = velocities_of(read(good, "x.toml", {{&velocity, {2, 3}}}).start);
  CHECK(kept.velocity == Eigen::Vector2d(2, 3));
  CHECK(kept.angular_velocity == Eigen::Vector3d(0, 0, 100));
  CHECK(velocities_of(read(good, "x.toml", {{&angular_velocity, {4, 5, 6}}}).start).velocity == Eigen::Vector2d(1, 0));
  // If options give both velocities, the file needs no [start].
  const std::string without = good.substr(0, good.find("[start]"));
  const Given both{{&velocity, {2, 3}}, {&angular_velocity, {4, 5, 6}}};
  CHECK(velocities_of(read(without, "x.toml", both).start).angular_velocity == Eigen::Vector3d(4, 5, 6));
  CHECK_THROWS_WITH(
      read(without, "x.toml", {{&velocity, {2, 3}}}),
      "x.toml:1:1: 'angular_velocity' in [start] is missing: angular velocity about x, y and z (up), in rad/s");
  // An option for slip or spin replaces both velocities. The number without an option is computed from the velocities.
  const std::string general =
      with(with(good, "slip = 1.0", "velocity = [1, 2]"), "spin = 100", "angular_velocity = [10, 0, 7]");
  CHECK(std::get<SlipAndSpin>(read(general, "x.toml", {{&slip, {3}}, {&spin, {4}}}).start).spin == 4);
  const auto slides = std::get<SlipAndSpin>(read(general, "x.toml", {{&slip, {3}}}).start);
  CHECK(slides.slip == 3);
  CHECK(slides.spin == 7);
  const auto spins = std::get<SlipAndSpin>(read(general, "x.toml", {{&spin, {3}}}).start);
  CHECK(spins.spin == 3);
  CHECK(spins.slip == Approx(std::hypot(1, 2 + 10 * 0.028575)).epsilon(1e-15));
}

TEST_CASE("values in quotes may have another unit", "[table]") {
  CHECK(read(with(good, "radius = 0.028575", "radius = \"2.25 in\""), "x.toml").ball.radius == 0.05715);
  CHECK(spin_at_start(read(with(good, "spin = 100", "spin = '60 rpm'"), "x.toml")) ==
        Approx(2 * std::numbers::pi).epsilon(1e-15));
}

TEST_CASE("text that toml++ 3.3 would not survive", "[domain]") {
  const auto refused = [](const std::string& text, const std::string& message) {
    INFO(text.substr(0, 80));
    CHECK_THROWS_AS(read(text, "x.toml"), RunFileError);
    CHECK_THROWS_WITH(read(text, "x.toml"), Contains(message));
  };
  const auto repeated = [](const std::string& piece, int times) {
    std::string text;
    for (int i = 0; i < times; ++i) text += piece;
    return text;
  };
  // Control characters of the file are never printed.
  refused("\"a\\u0007b\" = 1", "x.toml:1:1: unknown key 'a?b'");
  refused("a = t\tx", "saw 't?'");
  // A header that does not begin with a key made toml++ fail an assertion.
  for (const char* header : {"[(x]", "[,x]", "[ .x]", "[[=x]]", "[[[x]]]", "[\n]", "[#]", "a = 1\n [+1]"}) {
    refused(header, "not TOML: ");
  }
  refused("a = [}", "x.toml:1:6: not TOML: a bracket that closes none");
  // A letter behind a quotation mark that can begin no string gave toml++ undefined behaviour.
  refused("a = 0'\xC9\xA0", "x.toml:1:6: ' has no place here: it begins a key or a value");
  refused("a = \"\"\"\\\n\xEF\xBB\xBD\"\"\"", "x.toml:1:5: text of several lines has no place here");
  refused("a = '''b'''", "x.toml:1:5: text of several lines has no place here");
  refused("a = -['\xC9\xA0", "x.toml:1:6: [ has no place here");
  refused("a = 1='\xC9\xA0", "x.toml:1:6: not TOML: '=' follows no key");
  refused("a = [1, 2='\xC9\xA0", "x.toml:1:10: not TOML: '=' follows no key");
  refused("a = 1.'\xC9\xA0", "x.toml:1:7: ' has no place here");
  refused("a = \"b\" 'c'", "x.toml:1:9: ' has no place here");
  // From 80 kB on, nesting made toml++ overflow the stack: in a header, a key, arrays and tables.
  refused("[" + repeated("a.", 40) + "a]", "x.toml:1:35: nested more than 16 deep");
  refused(repeated("a . b . ", 20) + "a = 1", "nested more than 16 deep");
  refused("a = " + repeated("[", 40), "x.toml:1:21: nested more than 16 deep");
  refused("a = " + repeated("{a = ", 40), "nested more than 16 deep");
  refused("[" + repeated("a.", 60000) + "b]", "too long for a run file, which has at most 65536 bytes");

  // Strings and comments may contain all these brackets.
  const std::string dots = repeated("([{.", 20);
  for (const std::string quotes : {"\"", "'"}) {
    const std::string named = with(good, "\"pool ball on cloth\"", quotes + dots + quotes + " # " + dots);
    CHECK(read(named, "x.toml").ball.name == dots);
  }
  refused(with(good, "pool ball on cloth", R"(\"([)" + dots + "\" ("), "x.toml:2:95: not TOML");
  CHECK(read("\xEF\xBB\xBF" + good, "x.toml").ball.mass == 0.1701);
}

TEST_CASE("a run file that never ends, or is not there", "[limit]") {
  CHECK_THROWS_WITH(read_run_file("/dev/zero"), StartsWith("/dev/zero: too long for a run file"));
  CHECK_THROWS_AS(read_run_file("/no/such/file.toml"), std::system_error);
  CHECK_THROWS_WITH(read_run_file("/no/such/file.toml"), Contains("/no/such/file.toml"));
}

TEST_CASE("a load in place of gravity", "[table]") {
  const auto pressed = [](const std::string& environment, const Given& given = {}) {
    return read(good + environment, "x.toml", given).environment;
  };
  const auto is_gravity = [](const Environment& environment, double value) {
    return environment.gravity == value && !environment.load;
  };
  const auto is_load = [](const Environment& environment, double value, double of_mass) {
    return environment.gravity == value / of_mass && environment.load == value;
  };
  CHECK(is_load(pressed("[environment]\nload = 3\n"), 3, 0.1701));
  CHECK(is_load(pressed("[environment]\nload = '3 kN'\n"), 3000, 0.1701));
  CHECK(is_load(pressed("", {{&load, {3}}, {&mass, {0.5}}}), 3, 0.5));
  // A load of the command line replaces the load of the file, whether the file gives a load or gravity.
  CHECK(is_load(pressed("[environment]\ngravity = 1.6\n", {{&load, {3}}, {&mass, {0.5}}}), 3, 0.5));
  CHECK(is_gravity(pressed("[environment]\nload = 3\n", {{&gravity, {1.6}}}), 1.6));
  CHECK(is_load(pressed("[environment]\nload = 3\n", {{&load, {5}}, {&mass, {0.5}}}), 5, 0.5));
  CHECK_THROWS_WITH(pressed("[environment]\nload = 3\ngravity = 9.8\n"),
                    "x.toml:13:1: 'gravity' and 'load' in [environment] exclude each other: give 'gravity' in "
                    "[environment], or 'load' in [environment]");
  CHECK_THROWS_WITH(pressed("[environment]\nload = 0\n"), "x.toml:12:8: load must be finite and > 0, in N, got 0");
  CHECK_THROWS_WITH(pressed("", {{&load, {3}}, {&gravity, {9.8}}}),
                    Contains("--gravity and --load exclude each other"));
  CHECK_THROWS_WITH(pressed("", {{&load, {1e308}}, {&mass, {1e-9}}}), Contains("gravity must be finite"));
  // A description that contains a load is written with this load.
  const Experiment loaded = read(good + "[environment]\nload = 3\n", "x.toml");
  CHECK_THAT(run_file(loaded), Contains("load = 3  # N"));
  CHECK(is_load(read(run_file(loaded), "written").environment, 3, 0.1701));
}

TEST_CASE("options act as if the file had said so", "[invariant]") {
  const Given given{{&radius, {0.03}}, {&mass, {0.2}},    {&friction, {0.3}},          {&slip, {2.0}},
                    {&spin, {-5.0}},   {&gravity, {1.6}}, {&spin_deceleration, {4.0}}, {&rolling_friction, {0.02}}};
  const std::string changed =
      R"([ball]
name = "pool ball on cloth"
mass = 0.2
radius = 0.03
[contact]
friction = 0.3
rolling_friction = 0.02
spin_deceleration = 4
[start]
slip = 2
spin = -5
[environment]
gravity = 1.6
)";
  check_same(read(good, "x.toml", given), read(changed, "y.toml"));

  CHECK(std::get<PatchRadius>(read(good, "x.toml", {{&patch_radius, {0.002}}}).contact.patch).value == 0.002);
  CHECK(slip_at_start(read(with(good, "slip = 1.0\n", ""), "x.toml", {{&slip, {3.0}}})) == 3);
  CHECK_THROWS_WITH(read(good, "x.toml", {{&mass, {-1.0}}}), Contains("mass must be"));
  CHECK_THROWS_WITH(read(good, "x.toml", {{&velocity, {-1.0}}}), Contains("--velocity must be 2 numbers"));
  CHECK_THROWS_WITH(read(good, "x.toml", {{&patch_radius, {1e-3}}, {&spin_deceleration, {3.0}}}),
                    Contains("--patch_radius and --spin_deceleration exclude each other"));
  // A file cannot be shown as the place of a value that only an option gives.
  CHECK_THROWS_AS(read(good, "x.toml", {{&patch_radius, {1}}}), std::domain_error);
  CHECK_THROWS_WITH(read(good, "x.toml", {{&patch_radius, {1}}}), !Contains("x.toml"));
  // A file with a contradiction is refused, even if options replace the contradictory values.
  const std::string two = with(good, "spin_deceleration = 10", "spin_deceleration = 10\npatch_radius = 1e-3");
  CHECK_THROWS_AS(read(two, "x.toml", {{&patch_radius, {2e-3}}}), RunFileError);
  const std::string none = with(good, "spin_deceleration = 10\n", "");
  CHECK(std::get<PatchRadius>(read(none, "x.toml", {{&patch_radius, {2e-3}}}).contact.patch).value == 2e-3);
  // An option for one modulus replaces only this modulus. It cannot replace a patch that is given in another way.
  const Experiment steel = find_ball("steel")->experiment;
  const Given rubber{{&youngs_modulus, {2e6, 2e11}}};
  const auto moduli = std::get<HertzModuli>(experiment_of(describe(steel).under(options(rubber))).contact.patch);
  CHECK((moduli.youngs_modulus[0] == 2e6 && moduli.poisson_ratio[0] == 0.3));
  CHECK_THROWS_WITH(read(good, "x.toml", rubber),
                    Contains("'spin_deceleration' in [contact] and --youngs_modulus exclude"));
}

TEST_CASE("every quantity is a key, and is written back", "[invariant]") {
  for (const CatalogueEntry& entry : catalogue()) {
    for (const Quantity* quantity : quantities()) {
      CAPTURE(entry.name, quantity->name);
      const bool of_a_ball =
          quantity->section == "contact.hertz" || quantity == &angular_velocity || quantity == &rolling_friction;
      if (entry.experiment.ball.body.lies_flat() && (of_a_ball || quantity == &radius)) continue;
      const auto values = [](const Quantity& of) {
        return std::vector<double>(of.count(), &of == &youngs_modulus ? 0x1p30
                                               : &of == &patch_radius ? 0x1p-10
                                                                      : 0x1p-5);
      };
      Given given{{quantity, values(*quantity)}};
      // A modulus needs a Poisson's ratio.
      for (const Ways& ways : alternatives()) {
        for (const auto& way : ways) {
          if (std::ranges::find(way, quantity) == way.end() || quantity == &velocity) continue;
          for (const Quantity* other : way) {
            if (other != quantity) given.emplace_back(other, values(*other));
          }
        }
      }
      const Description changed = describe(entry.experiment).under(options(given));
      const Experiment experiment = experiment_of(changed);
      const std::string written = run_file(experiment);
      CHECK_THAT(written, Contains("\n" + std::string(quantity->name) + " = "));
      CHECK(run_file(read(written, "written")) == written);
      CHECK(describe(experiment).find(*quantity)->numbers == given.front().second);
    }
  }
}

TEST_CASE("a body that lies flat, and a law of its own", "[table]") {
  const std::string flat = with(with(good, "spin_deceleration = 10\n", ""), "mass", "body = \"disc\"\nmass");
  const Experiment disc = read(flat, "f");
  CHECK(disc.ball.body.name == "disc");
  CHECK(std::holds_alternative<WholeFace>(disc.contact.patch));
  CHECK(law_of(disc) == "uniform");
  const auto uniform = *contensou::reduction::find_law("uniform");
  CHECK(patch_radius_of(disc, uniform) == 0.028575);
  CHECK(patch_radius_of(read(flat, "f", {{&radius, {0.04}}}), uniform) == 0.04);
  const Experiment banded = read(with(flat, "friction", "law = \"annulus:0.9\"\npatch_radius = 0.01\nfriction"), "f");
  CHECK(law_of(banded) == "annulus:0.9");
  CHECK(patch_radius_of(banded, uniform) == 0.01);
  CHECK(law_of(read(good, "f")) == "exact");
  // The patch of a body whose spin deceleration is measured: J = m R^2/2.
  const Experiment measured = read(flat, "f", {{&spin_deceleration, {10}}});
  CHECK(patch_radius_of(measured, uniform) ==
        Approx(0.028575 * 0.028575 * 10 / (2 * 0.2 * 9.80665 * (2.0 / 3))).epsilon(1e-14));

  const auto refused = [&](const std::string& text, const std::string& words) {
    CAPTURE(text);
    CHECK_THROWS_WITH(read(text, "f"), Contains(words));
  };
  refused(with(flat, "disc", "disk"),
          "f:3:8: no such body 'disk' (did you mean 'disc'?); bodies: ball, hollow-ball, disc, puck, ring");
  refused(with(flat, "\"disc\"", "2"), "'body' in [ball] must be a string in quotes");
  refused(with(flat, "friction", "law = \"unifrom\"\nfriction"), "no such law 'unifrom' (did you mean 'uniform'?)");
  refused(with(flat, "friction", "law = \"pressure:-2\"\nfriction"), "f:7:7: ");
  refused(with(flat, "[start]", "[contact.hertz]\nyoungs_modulus = [1, 1]\npoisson_ratio = [0.3, 0.3]\n[start]"),
          "a disc lies flat, and the formula of Hertz needs a ball");
  refused(with(with(flat, "slip = 1.0", "velocity = [1, 0]"), "spin = 100", "angular_velocity = [1, 0, 0]"),
          "turns about the vertical only");
}

TEST_CASE("inertia is a key, and that of a name is the name", "[invariant]") {
  const auto read_text = [](const std::string& text) { return experiment_of(parse_run_file(text, "x.toml")); };
  const std::string rest =
      "[contact]\nfriction = 0.3\npatch_radius = 1e-3\n[start]\nslip = 1\nspin = 20\n[environment]\ngravity = 9.8\n";
  const auto inertia_of = [&](const std::string& lines) {
    return read_text("[ball]\nmass = 1\nradius = 0.1\n" + lines + "\n" + rest).ball.body.inertia;
  };
  for (const auto& [name, given] :
       {std::pair{"body = \"ball\"", "inertia = 0.4"}, {"body = \"hollow-ball\"", "inertia = 0.6666666666666666"}}) {
    CHECK(inertia_of(name).chi == inertia_of(given).chi);
    CHECK(inertia_of(name).gamma == inertia_of(given).gamma);
  }
  CHECK(inertia_of("body = \"disc\"\ninertia = 1").gamma == 1);
  CHECK(inertia_of("body = \"disc\"\ninertia = 1").chi == 1);
  Experiment changed = find_ball("curling-stone")->experiment;
  changed.ball.body = changed.ball.body.with_factor(0.45);
  CHECK(read_text(run_file(changed)).ball.body.factor == 0.45);
  CHECK(run_file(read_text(run_file(changed))) == run_file(changed));
  CHECK_THROWS_WITH(inertia_of("inertia = 0.7"),
                    Contains("x.toml:4:1: the inertia of a ball, over m R^2, must be above 0 "
                             "and at most 2/3, as of a hollow-ball with R the radius"));
  CHECK_THROWS_WITH(inertia_of("body = \"disc\"\ninertia = 1.1"), Contains("x.toml:5:1: ") && Contains("as of a ring"));
}

TEST_CASE("[uncertainty]: what the numbers are known to, and the same again from what is written", "[invariant]") {
  const std::string known =
      good + "[uncertainty]\nfriction = \"5%\"\nspin = \"10 rpm\"\nslip = 0.01\n[uncertainty.correlation]\n" +
      "slip = {friction = 0.8, spin = -0.5}\n";
  const Experiment experiment = read(known, "x.toml");
  const Spreads& spreads = experiment.spreads;
  const Component of_friction{&friction, 0}, of_spin{&spin, 0}, of_slip{&slip, 0};
  CHECK(spreads.numbers.size() == 3);
  CHECK(spreads.numbers[static_cast<std::size_t>(*spreads.place(of_friction))].standard == Approx(0.01).epsilon(1e-15));
  CHECK(spreads.numbers[static_cast<std::size_t>(*spreads.place(of_spin))].standard ==
        Approx(10 * std::numbers::pi / 30).epsilon(1e-15));
  CHECK(spreads.correlation(*spreads.place(of_slip), *spreads.place(of_friction)) == 0.8);
  CHECK(spreads.correlation(*spreads.place(of_spin), *spreads.place(of_slip)) == -0.5);
  CHECK(spreads.correlation(*spreads.place(of_spin), *spreads.place(of_friction)) == 0);
  const std::string written = run_file(experiment);
  CHECK(run_file(read(written, "y.toml")) == written);
  CHECK_THAT(written, Contains("[uncertainty.correlation]\n"));
  // An option that replaces a number of the file drops the spread of this number, unless the value is equal.
  CHECK(read(known, "x.toml", {{&slip, {2}}}).spreads.numbers.size() == 2);
  CHECK(read(known, "x.toml", {{&slip, {1}}}).spreads.numbers.size() == 3);
  CHECK(read(known, "x.toml", {{&velocity, {1, 0}}, {&angular_velocity, {0, 0, 1}}}).spreads.numbers.size() == 1);

  const auto refused = [&](const std::string& lines, const std::string& words) {
    INFO(lines);
    CHECK_THROWS_WITH(parse_run_file(good + lines, "f"), Contains(words));
  };
  refused("[uncertainty]\nfricton = 0.1\n",
          "f:12:1: unknown key 'fricton' in [uncertainty] (did you mean 'friction'?)");
  refused("[uncertainty]\npatch_radius = 0.1\n", "f:12:16: patch_radius has a standard deviation and no value here");
  refused("[uncertainty]\nfriction = -0.1\n", "f:12:12: friction: a standard deviation is finite and >= 0, got -0.1");
  refused("[uncertainty]\nslip = \"5 kg\"\n",
          "f:12:8: 'slip' in [uncertainty] must be a number, in m/s, or one in quotes with m/s, ");
  refused("[uncertainty]\nslip = 1\n[uncertainty.correlation]\nslip = 0.4\n",
          "f:14:8: 'slip' in [uncertainty.correlation] must be a table of numbers");
  refused("[uncertainty]\nslip = 1\n[uncertainty.correlation]\nslip = {spin = 0.4}\n",
          "f:14:16: spin has no standard deviation");
  refused("[uncertainty]\nslip = 1\n[uncertainty.correlation]\nslip = {slip = 0.4}\n", "with itself is always 1");
  refused("[uncertainty]\nslip = 1\n[uncertainty.correlation]\nslip = {spun = 0.4}\n",
          "f:14:9: unknown key 'spun' in [uncertainty.correlation.slip] (did you mean 'spin'?)");
  const std::string three = "[uncertainty]\nslip = 1\nspin = 1\nfriction = 0.1\n[uncertainty.correlation]\n";
  refused(three + "slip = {spin = 1.4}\n", "f:16:16: a correlation is at least -1 and at most 1, got 1.4");
  refused(three + "slip = {spin = 0.4}\nspin = {slip = 0.4}\n", "are correlated twice");
  refused(three + "slip = {spin = 0.9, friction = 0.9}\nspin = {friction = -0.9}\n",
          "f:11:1: no numbers have these correlations: of their matrix an eigenvalue is -0.8");
  CHECK_NOTHROW(parse_run_file(good + three + "slip = {spin = 1, friction = -1}\nspin = {friction = -1}\n", "f"));
}
