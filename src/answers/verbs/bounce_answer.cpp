#include "answers/verbs/ball_answers.hpp"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace contensou::answers {

namespace {

struct BounceReport {
  si::Experiment experiment;  ///< ball with the patch of the impact
  reduction::Law law;
  si::Impact impact;
  std::optional<double> height;  ///< height of the drop, m
  double rolling_below;          ///< slip below which the ball rolls, m/s
  bool by_moduli;                ///< true: the patch radius follows from the moduli
  si::Rebound ours, textbook;

  si::Velocities start() const { return si::velocities_of(experiment.start); }
  double up() const { return impact.restitution * impact.normal_speed; }
};

/// Returns the angle of a velocity from the normal of the plane, in degrees.
double angle(const Eigen::Vector2d& along, double normal) {
  return std::atan2(along.stableNorm(), normal) * (180 / std::numbers::pi);
}

Json motion(const si::Velocities& velocities, double normal, double slip) {
  const auto& [v, w] = velocities;
  return {{"vx", v.x()}, {"vy", v.y()}, {"vz", normal}, {"wx", w.x()},
          {"wy", w.y()}, {"wz", w.z()}, {"slip", slip}, {"angle", angle(v, std::abs(normal))}};
}

Json rebound(const BounceReport& r, const si::Rebound& of) {
  Json members = motion(of.velocities, r.up(), of.slip);
  const auto [v0, w0] = r.start();
  const Eigen::Vector2d dv = of.velocities.velocity - v0;
  members.update({{"change_vx", dv.x()},
                  {"change_vy", dv.y()},
                  {"change_wz", of.velocities.angular_velocity.z() - w0.z()},
                  {"grip", of.grip}});
  return members;
}

constexpr const char* rebound_columns = "vx,vy,vz,wx,wy,wz,slip,angle,change_vx,change_vy,change_wz,grip";
constexpr const char* textbook_columns =
    "textbook_vx,textbook_vy,textbook_vz,textbook_wx,textbook_wy,textbook_wz,textbook_slip,textbook_angle,"
    "textbook_change_vx,textbook_change_vy,textbook_change_wz,textbook_grip";

constexpr Field<BounceReport> bounce_row[]{
    {"law", "", "name of the law of friction", [](const BounceReport& r) -> Json { return r.law.name(); }},
    {"mu", "", "radius of the patch divided by radius of the ball",
     [](const BounceReport& r) -> Json { return si::patch_ratio(r.experiment, r.law); }},
    {"ball", "", "values of the ball and of its patch at the impact",
     [](const BounceReport& r) { return members_of_ball(r.experiment, r.law); }, ""},
    {"height", "m", "height of the drop, with --drop",
     [](const BounceReport& r) -> Json { return r.height ? Json(*r.height) : Json(); }, ""},
    {"normal_speed", "m/s", "speed towards the plane before the impact",
     [](const BounceReport& r) -> Json { return r.impact.normal_speed; }},
    {"restitution", "", "value of --restitution", [](const BounceReport& r) -> Json { return r.impact.restitution; }},
    {"impulse", "m/s", "impulse perpendicular to the plane, divided by the mass",
     [](const BounceReport& r) -> Json { return r.impact.impulse(); }},
    {"threshold", "m/s", "slip below which the ball counts as rolling",
     [](const BounceReport& r) -> Json { return r.rolling_below; }, ""},
    {"start", "m/s, 1/s, degrees",
     "motion before the impact: velocity of the centre, angular velocity (z up), slip, and angle between path and "
     "normal of the plane",
     [](const BounceReport& r) { return motion(r.start(), -r.impact.normal_speed, si::slip_at_start(r.experiment)); },
     "", 0, " {`vx`, `vy`, `vz`, `wx`, `wy`, `wz`, `slip`, `angle`}"},
    {"after", "m/s, 1/s, degrees, 1",
     "motion after the impact. change_*: value after minus value before. grip: impulse until the ball rolls, "
     "divided by the whole impulse; above 1 if it still slips when it leaves the plane",
     [](const BounceReport& r) { return rebound(r, r.ours); }, rebound_columns, 0,
     " {as `start`, `change_vx`, `change_vy`, `change_wz`, `grip`}"},
    {"textbook", "", "motion after the impact under the uncoupled model, with members as after",
     [](const BounceReport& r) { return rebound(r, r.textbook); }, textbook_columns, 0, " {as `after`}"},
};

std::string text_of(const BounceReport& r, const Digits& digits) {
  const auto [v0, w0] = r.start();
  std::string text = ball_heading(r.experiment, r.law, digits);
  text += r.by_moduli ? "       by Hertz's formula, the mean over the impulse of an elastic impact, held\n"
                      : "       held as it is: it does not grow with the load of the impact\n";
  text +=
      fmt::format("normal speed {} m/s{}, restitution {}: impulse over mass {} m/s\n\n", digits(r.impact.normal_speed),
                  r.height ? fmt::format(", dropped from {} m", digits(*r.height)) : "", digits(r.impact.restitution),
                  digits(r.impact.impulse()));
  const TextTable::Column number = TextTable::right(std::max(24, 2 * digits.count + 14));
  TextTable table({TextTable::left(25), number, number, number});
  table.add({"", "before", "after, law " + r.law.name(), "textbook (uncoupled)"});
  const auto& [ours, slip, grip] = r.ours;
  const auto& [theirs, their_slip, their_grip] = r.textbook;
  const auto row = [&](const std::string& label, const auto& show, const si::Velocities& start) {
    table.add({label, show(start), show(r.ours.velocities), show(r.textbook.velocities)});
  };
  row("velocity (m/s)", [&](const si::Velocities& of) { return digits.list(of.velocity); }, {v0, w0});
  table.add({"  changed by", "", digits.list(Eigen::Vector2d(ours.velocity - v0)),
             digits.list(Eigen::Vector2d(theirs.velocity - v0))});
  row("angular velocity (1/s)", [&](const si::Velocities& of) { return digits.list(of.angular_velocity); }, {v0, w0});
  table.add({"  spin changed by", "", digits(ours.angular_velocity.z() - w0.z()),
             digits(theirs.angular_velocity.z() - w0.z())});
  table.add({"slip (m/s)", digits(si::slip_at_start(r.experiment)), digits(slip), digits(their_slip)});
  table.add({"angle from the normal", digits(angle(v0, r.impact.normal_speed)), digits(angle(ours.velocity, r.up())),
             digits(angle(theirs.velocity, r.up()))});
  const auto when = [&](double part) {
    return part == 0 ? std::string("before") : part <= 1 ? fmt::format("{} %", digits(100 * part)) : std::string("no");
  };
  table.add({"rolls after, of impulse", "", when(grip), when(their_grip)});
  text += table.text();
  text += fmt::format("\nrolls  once its slip is below {} m/s (--rolling-below){}\n", digits(r.rolling_below),
                      grip <= 1        ? ": it grips within the impact"
                      : their_grip > 1 ? ": it slips through the whole impact"
                                       : ": it slips through the whole impact, where the textbook's grips");
  return text + "time   friction is in proportion to the load: the impulse counts, not how the load comes and goes\n";
}

}  // namespace

std::vector<FieldText> bounce_fields() { return texts_of(bounce_row); }

Answer bounce_answer(const si::Experiment& experiment, const reduction::Law& law, const si::Impact& impact,
                     std::optional<double> height, double rolling_below) {
  BounceReport report{experiment,
                      law,
                      impact,
                      height,
                      rolling_below,
                      std::holds_alternative<si::HertzModuli>(experiment.contact.patch),
                      si::bounce(experiment, law, impact, rolling_below),
                      si::uncoupled_bounce(experiment, law, impact, rolling_below)};
  report.experiment.contact.patch = si::pressed_in(impact, experiment, law).contact.patch;
  Answer answer{.members = members_of(bounce_row, report), .rows = {row_of(bounce_row, report)}};
  answer.text = [report = std::move(report)](const Digits& digits) { return text_of(report, digits); };
  return answer;
}

}  // namespace contensou::answers
