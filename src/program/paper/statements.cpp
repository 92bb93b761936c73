#include "paper/statements.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "contensou/reduction/detail/stepped_motion.hpp"
#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/laws.hpp"
#include "contensou/reduction/reduced_system.hpp"
#include "contensou/si/catalogue.hpp"
#include "contensou/si/experiment.hpp"
#include "contensou/si/motion.hpp"

namespace contensou::program {

std::string_view word(Verdict verdict) {
  switch (verdict) {
    case Verdict::holds:
      return "holds";
    case Verdict::erratum:
      return "erratum";
    case Verdict::not_true:
      break;
  }
  return "false";
}

Finding Statement::examine() const {
  Finding found{printed(at), computed(at), std::nullopt, Verdict::not_true};
  const auto agrees = [&](double value) {
    if (allowed == lower_bound) return found.computed >= value;
    return value == found.computed ||
           std::abs(value - found.computed) <= allowed * std::max(1.0, std::abs(found.computed));
  };
  if (corrected) found.corrected = corrected(at);
  if (found.corrected && agrees(*found.corrected)) found.verdict = Verdict::erratum;
  if (agrees(found.printed)) found.verdict = Verdict::holds;
  return found;
}

std::string Examined::correction() const {
  return fmt::format(fmt::runtime(statement.correction), fmt::arg("computed", found.computed),
                     fmt::arg("percent", 100 * found.computed));
}

namespace {

using reduction::Law;

constexpr double rounding = 1e-12, three_digits = 5e-4;

Law law_named(std::string_view name) { return *reduction::find_law(name); }

/// Returns the system of a body that rests on its whole flat face: mu = 1.
/// @param gyration  radius of gyration about the vertical divided by the radius of the body, > 0
reduction::ReducedSystem flat(std::string_view law, double gyration) {
  return {law_named(law), 1, {.chi = 1, .gamma = 1 / (gyration * gyration)}};
}

const double disc_gyration = std::sqrt(0.5);

/// Returns the time at which a puck's spin has fallen to a millionth, divided by the same time for its slip. The puck
/// has a radius of 38 mm and starts with 5 m/s and 100 rad/s. The motion is integrated in steps in time.
double ends_of_puck() {
  const reduction::State start{.u = 3.8, .v = 5};
  const reduction::OrbitColumns steps = reduction::integrate_directly(flat("uniform", disc_gyration), start).points;
  const auto first_below = [&](const Eigen::ArrayXd& speeds) {
    const auto place = std::ranges::find_if(speeds, [&](double speed) { return speed < 1e-6 * speeds[0]; });
    return steps.tau[place - speeds.begin()];
  };
  return first_below(steps.u) / first_below(steps.v);
}

/// Returns the sliding distance of a ring with v = u at the start, divided by the distance with this v and u = 0.
double way_of_ring() {
  const reduction::ReducedSystem ring = flat("ring", 1);
  const reduction::Flow flow(ring);
  const auto way = [&](reduction::State start) { return flow.orbit(start).slip_length(flow.stop_time(start).tau); };
  return way({.u = 1, .v = 1}) / way({.u = 0, .v = 1});
}

/// A bowling ball in an example of textbooks: it starts by sliding at 8 m/s without spin.
struct Bowled {
  double speed = 8;
  si::Experiment ball = [this] {
    si::Experiment experiment = si::find_ball("bowling")->experiment;
    experiment.start = si::Velocities{.velocity = {speed, 0}, .angular_velocity = {0, 0, 0}};
    return experiment;
  }();
  si::Motion motion = si::Motion::reduced(ball, law_named("exact"));
  si::MotionPoint end = motion.at(motion.stop_time());
  double friction = ball.contact.friction * ball.environment.gravity;
};

/// Returns the speed at which a ball begins to roll, divided by its speed v at the start. The backspin is (5/2) v/R.
double speed_of_draw() {
  si::Experiment ball = si::find_ball("pool")->experiment;
  const double speed = 1;
  ball.start = si::Velocities{.velocity = {speed, 0}, .angular_velocity = {0, -2.5 * speed / ball.ball.radius, 0}};
  const si::Motion motion = si::Motion::reduced(ball, law_named("exact"));
  return motion.at(motion.stop_time()).velocity.norm() / speed;
}

/// Returns the height of a level cue's tip above the centre, in radii, at which the stroke makes the ball roll at once.
/// There the slip is 0. The slip divided by the speed is a linear function of this height.
double height_of_rolling() {
  si::Experiment ball = si::find_ball("pool")->experiment;
  const auto slip_over_speed = [&](double above) {
    ball.start = si::struck(ball.ball, {.speed = 1, .right = 0, .above = above, .elevation = 0});
    return si::slip_velocity_at_start(ball).x() / si::velocities_of(ball.start).velocity.x();
  };
  const double centre = slip_over_speed(0), high = 0.45;
  return high * centre / (centre - slip_over_speed(high));
}

/// Returns the moment of a contact that only turns, divided by f N a. It is summed over rings of the patch with Hertz's
/// pressure, in the angle t with rho = sin t. In this angle the trapezoidal rule is exact.
double moment_of_hertz() {
  constexpr int rings = 64;
  constexpr double step = std::numbers::pi / 2 / rings;
  double sum = 0;
  for (int i = 1; i < rings; ++i) {
    const double rho = std::sin(i * step), pressure = 1.5 * std::cos(i * step);  // pi a^2 p/N
    sum += 2 * rho * pressure * rho * std::cos(i * step) * step;
  }
  return sum;
}

/// Returns the angle in degrees between the paths of a rolling cue ball before it hits a ball at rest of the same mass
/// and after it rolls again. The hit is elastic and without friction.
/// @param cut  angle between the first path and the line of the centres, in degrees, 0 < cut < 90
double deflection(double cut) {
  si::Experiment ball = si::find_ball("pool")->experiment;
  const double speed = 1, angle = cut * std::numbers::pi / 180;
  const double kept = speed * std::sin(angle);  // along the tangent of the two balls; the spin is that of the rolling
  ball.start = si::Velocities{.velocity = {kept * std::sin(angle), kept * std::cos(angle)},
                              .angular_velocity = {0, speed / ball.ball.radius, 0}};
  const si::Motion motion = si::Motion::reduced(ball, law_named("exact"));
  const auto velocity = motion.at(motion.stop_time()).velocity;
  return std::atan2(velocity.y(), velocity.x()) * 180 / std::numbers::pi;
}

/// Returns the largest deflection, by a search over the cut angle in thirds.
double largest_deflection() {
  double low = 15, high = 45;
  for (int i = 0; i < 60; ++i) {
    const double left = low + (high - low) / 3, right = high - (high - low) / 3;
    if (deflection(left) < deflection(right)) {
      low = left;
    } else {
      high = right;
    }
  }
  return deflection((low + high) / 2);
}

/// Returns the spin deceleration of a curling stone with its typical spin, multiplied by v, in m/s^3. The stone has the
/// friction of the program DigitalCurling.
/// @param v  slip, m/s, > 0
double spin_decay_of_stone(double v) {
  const si::Experiment& stone = si::find_ball("curling-stone")->experiment;
  const Law ring = law_named("ring");
  const double friction = 0.00200985 / (v + 0.06385782) + 0.00626286;
  const double eps = si::patch_radius_of(stone, ring), R = stone.ball.radius;
  const double moment = ring(reduction::Slip{v, eps * si::spin_at_start(stone)}).moment;
  return stone.ball.body.inertia.gamma * friction * stone.environment.gravity * eps * moment / (R * R) * v;
}

}  // namespace

std::vector<Statement> published_numbers() {
  constexpr Source weidman{
      "P. D. Weidman, C. P. Malhotra, On the terminal motion of sliding spinning disks with uniform Coulomb friction "
      "(2007)",
      "", "abstract"},
      farkas{"Z. Farkas, G. Bartels, T. Unger, D. E. Wolf, Phys. Rev. Lett. 90 (2003) 248302",
             "10.1103/PhysRevLett.90.248302", "abstract"},
      goyal{"S. Goyal, A. Ruina, J. Papadopoulos, Wear 143 (1991) 331", "10.1016/0043-1648(91)90105-4", "as cited"},
      mihaly{"L. Mihaly (2018)", "", "as cited"}, textbooks{"Textbooks of mechanics", "", "in textbooks"},
      grains{"J. S. Marshall, J. Comput. Phys. 228 (2009) 1541, as coded in LAMMPS", "github.com/lammps/lammps",
             "code"},
      coriolis{"G. Coriolis, Theorie mathematique des effets du jeu de billard (1835)", "", "as cited"},
      gazebo{"Gazebo, tutorial on torsional friction", "github.com/osrf/gazebo_tutorials", "text"},
      peace_sign{"D. Alciatore, The 30 degree rule, Billiards Digest (April 2004)", "billiards.colostate.edu",
                 "first page"},
      players{"AzBilliards, thread 107367: tan = sin C cos C/(sin^2 C + 2/5) for the cut C", "", "as cited"},
      stones{"DigitalCurling, simulator_fcv1.cpp: a fit to stones", "github.com/digitalcurling", "code"};
  const auto ray = [](const reduction::ReducedSystem& system) {
    return reduction::Flow(system).terminal().rays.front().k;
  };
  const auto number = [](std::string_view name, const Source& source, double published, double allowed, double computed,
                         Verdict recorded = Verdict::holds) {
    return Statement{"", name, published, computed, allowed, 0, "", recorded, "", nullptr, source};
  };
  const reduction::TerminalRatios disc = reduction::Flow(flat("uniform", disc_gyration)).terminal();
  const Bowled bowled;
  return {
      number("v/(R omega) with which a disc comes to rest", weidman, 0.653, three_digits,
             ray(flat("uniform", disc_gyration))),
      number("when a disc's spin ends, over when its slip ends, by steps in time", farkas, 1, 1e-5, ends_of_puck()),
      number("v/(R omega) with which a ring comes to rest", weidman, 1, rounding, ray(flat("ring", 1))),
      number("radius of gyration over R above which v/(R omega) ends at 0", goyal, std::sqrt(2. / 3), rounding,
             1 / std::sqrt(disc.low)),
      number("radius of gyration over R below which v/(R omega) grows for ever", goyal, 0.5, rounding,
             1 / std::sqrt(disc.high)),
      number("way of a ring with v = R omega over that of one without spin", mihaly, std::numbers::pi / 2, rounding,
             way_of_ring()),
      number("moment of a disc that only turns, over f N R", textbooks, 2. / 3, rounding,
             law_named("uniform").pivoting_moment()),
      number("moment of a contact of grains that only turns, over f N a", grains, 2. / 3, rounding,
             law_named("exact").pivoting_moment(), Verdict::not_true),
      number("moment of a sphere's contact that only turns, over f N a", gazebo, 3 * std::numbers::pi / 16, rounding,
             moment_of_hertz()),
      number("largest deflection of a rolling cue ball by another ball, degrees", players,
             std::atan(std::sqrt(2. / 7) * 5 / 4) * 180 / std::numbers::pi, rounding, largest_deflection()),
      number("its deflection at a half-ball hit, by the 30 degree rule, degrees", peace_sign, 30, three_digits,
             deflection(30), Verdict::not_true),
      number("time after which a ball without spin rolls, in v/(f g)", textbooks, 2. / 7, rounding,
             bowled.motion.stop_time() * bowled.friction / bowled.speed),
      number("its speed then, over v", textbooks, 5. / 7, rounding, bowled.end.velocity.norm() / bowled.speed),
      number("its way until then, in v^2/(f g)", textbooks, 12. / 49, rounding,
             bowled.end.position.norm() * bowled.friction / (bowled.speed * bowled.speed)),
      number("speed, over v, at which a ball with backspin (5/2) v/R ends", textbooks, 0, rounding, speed_of_draw()),
      number("height above the centre, over R, at which a level cue sets a ball rolling", coriolis, 0.4, rounding,
             height_of_rolling()),
      number("decay of a curling stone's spin at 1 m/s, times v, m/s^3", stones, 0.025, three_digits,
             spin_decay_of_stone(1)),
      number("the same at 2.5 m/s", stones, 0.025, three_digits, spin_decay_of_stone(2.5), Verdict::not_true),
  };
}

}  // namespace contensou::program
