#include "answers/verbs/ball_answers.hpp"

#include <cmath>

#include <fmt/format.h>

namespace contensou::answers {

namespace {

struct AimReport {
  si::Experiment experiment;  ///< ball with the start that reaches the goal
  reduction::Law law;
  si::Velocities start;
  double slip;                   ///< slip at the start, m/s
  double distance, turns, time;  ///< results of the start: m, number of turns, s
  si::Velocities final;
  std::optional<si::Event> rolls;  ///< event at which rolling begins; empty for a body that lies flat
  std::optional<si::CueStrike> strike;
  std::optional<si::Event> rest;  ///< event at which the ball comes to rest; empty without rolling friction

  bool is_ball() const { return !experiment.ball.body.lies_flat(); }
};

constexpr Field<AimReport> aim_row[]{
    {"law", "", "name of the law of friction", [](const AimReport& r) -> Json { return r.law.name(); }},
    {"ball", "", "values of --ball and of its contact patch",
     [](const AimReport& r) { return members_of_ball(r.experiment, r.law); }, ""},
    {"slip", "m/s", "sliding speed of the contact point at the start, along x",
     [](const AimReport& r) -> Json { return r.slip; }},
    {"spin", "1/s", "spin at the start, about the vertical",
     [](const AimReport& r) -> Json { return r.start.angular_velocity.z(); }},
    {"velocity", "m/s", "velocity of the centre at the start",
     [](const AimReport& r) -> Json {
       return {r.start.velocity.x(), r.start.velocity.y()};
     },
     "vx,", 0, " [x, y]"},
    {"angular_velocity", "1/s", "angular velocity at the start",
     [](const AimReport& r) -> Json {
       const Eigen::Vector3d& w = r.start.angular_velocity;
       return {w.x(), w.y(), w.z()};
     },
     ",wy,", 0, " [x, y, z]"},
    {"distance", "m",
     "distance from the start to the place where slip and spin end; with rolling friction, to the place of rest",
     [](const AimReport& r) -> Json { return r.distance; }},
    {"turns", "", "number of turns about the vertical until slip and spin end",
     [](const AimReport& r) -> Json { return r.turns; }},
    {"time", "s", "time when slip and spin end; with rolling friction, time of rest",
     [](const AimReport& r) -> Json { return r.time; }},
    {"final_velocity", "m/s", "speed of rolling after slip and spin have ended; not with rolling friction",
     [](const AimReport& r) { return r.is_ball() && !r.rest ? Json(r.final.velocity.x()) : Json(); }},
    {"rolls_after", "s, m, m, m/s", "time and place at which a ball begins to roll: its slip falls below the threshold",
     [](const AimReport& r) -> Json {
       if (!r.rolls) return {};
       Json members = members_of(*r.rolls);
       members["threshold"] = si::rolling_slip;
       return members;
     },
     "", 0, " {`t`, `x`, `y`, `threshold`}"},
    {"rest", "s, m, m", "time and place at which the ball comes to rest, with rolling friction",
     [](const AimReport& r) { return r.rest ? members_of(*r.rest) : Json(); }, "", 0, " {`t`, `x`, `y`}"},
    {"strike", "m/s; 1; kg",
     "level stroke of a cue that gives this start: speed and mass of the cue, and the point that it hits, right of and "
     "above the centre, in radii of the ball",
     [](const AimReport& r) -> Json {
       if (!r.strike) return {};
       const auto& [speed, right, above, elevation, mass] = *r.strike;
       return {{"speed", speed}, {"right", right}, {"above", above}, {"mass", mass}};
     },
     "", 0, " {`speed`, `right`, `above`, `mass`}"},
};

std::string text_of(const AimReport& r, const Digits& number) {
  const std::string side = r.strike && r.strike->right < 0 ? "left" : "right";
  const double turning = r.start.angular_velocity.y();
  std::string text = ball_heading(r.experiment, r.law, number) +
                     fmt::format("law {}\n\nstart  slip {} m/s, spin {} rad/s\n", r.law.name(), number(r.slip),
                                 number(r.start.angular_velocity.z()));
  if (turning != 0) {
    text += fmt::format("       its centre at {} m/s, turning {} at {} rad/s\n", number(r.start.velocity.x()),
                        turning < 0 ? "backwards" : "forwards", number(std::abs(turning)));
  }
  if (r.strike) {
    const double above = r.strike->above;
    text += fmt::format(
        "       struck by a level cue of {} kg at {} m/s, {} radii {} of the centre{}\n", number(r.strike->mass),
        number(r.strike->speed), number(std::abs(r.strike->right)), side,
        above == 0 ? "" : fmt::format(" and {} {} it", number(std::abs(above)), above < 0 ? "below" : "above"));
  } else if (r.is_ball() && r.start.velocity.isZero(0) && r.start.angular_velocity.isZero(0)) {
    text += "       it is at rest\n";
  } else if (r.is_ball() && !si::mass_is_known(r.experiment.ball)) {
    text += "       the level stroke that starts it needs its mass (--mass)\n";
  } else if (r.is_ball()) {
    text +=
        fmt::format("       no level stroke gives it: its tip would meet the ball more than {} radii off the centre\n",
                    number(si::largest_tip_offset));
  }
  text += fmt::format("end    {} m from the start, after {} turns and {} s: {} end\n", number(r.distance),
                      number(r.turns), number(r.time), r.rest ? "rolling and spin" : "slip and spin");
  if (r.is_ball()) {
    text += fmt::format("       it {}; its slip is below {} m/s from {} s and {} m on\n",
                        r.rest                      ? fmt::format("rests after {} s", number(r.rest->t))
                        : r.final.velocity.x() == 0 ? "stays there"
                                                    : fmt::format("rolls on at {} m/s", number(r.final.velocity.x())),
                        number(si::rolling_slip), number(r.rolls->t), number(r.rolls->place.x()));
  }
  return text;
}

}  // namespace

Answer aim_answer(si::Experiment experiment, const reduction::Law& law, const AimGoal& goal) {
  const reduction::Flow flow(si::undriven_system(experiment, law));
  const auto* const rolling = std::get_if<si::RollingGoal>(&goal);
  if (rolling) {
    experiment.start = si::aimed_to_roll(experiment, flow, *rolling);
  } else {
    experiment.start = si::aimed(experiment, flow, std::get<si::Goal>(goal));
  }
  const si::Velocities start = si::velocities_of(experiment.start);
  const si::Motion motion = si::Motion::reduced(experiment, flow).finite();
  const double time = motion.last_time();
  const std::optional<si::Event> rest = motion.rest();
  std::optional<si::Event> rolls;
  std::optional<si::CueStrike> strike;
  si::Velocities final = si::final_motion(experiment);
  if (rolling) final.velocity.x() = rolling->speed;
  if (!experiment.ball.body.lies_flat()) {
    rolls = motion.event(motion.rolls());
    strike = si::level_strike(experiment.ball, start);
  }
  AimReport report{experiment,
                   law,
                   start,
                   start.velocity.x() - experiment.ball.radius * start.angular_velocity.y(),
                   rest ? rest->place.x() : motion.at(time).position.x(),
                   motion.turns(),
                   time,
                   final,
                   rolls,
                   strike,
                   rest};
  Answer answer{.members = members_of(aim_row, report), .rows = {row_of(aim_row, report)}};
  answer.text = [report = std::move(report)](const Digits& digits) { return text_of(report, digits); };
  return answer;
}

std::vector<FieldText> aim_fields() { return texts_of(aim_row); }

}  // namespace contensou::answers
