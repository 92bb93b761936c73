#include "answers/verbs/ball_answers.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "answers/asked/formula_law.hpp"
#include "contensou/reduction/laws.hpp"

namespace contensou::answers {

namespace {

using Motion = si::MotionColumns;
constexpr ColumnField<Motion> motion_columns[]{
    {"t", "s", "time since the start", [](const Motion& rows) { return &rows.t; }},
    {"x", "m", "", [](const Motion& rows) { return &rows.x; }},
    {"y", "m", "place of the centre; x = y = 0 at the start", [](const Motion& rows) { return &rows.y; }},
    {"vx", "m/s", "", [](const Motion& rows) { return &rows.vx; }},
    {"vy", "m/s", "velocity of the centre", [](const Motion& rows) { return &rows.vy; }},
    {"wx", "1/s", "", [](const Motion& rows) { return &rows.wx; }},
    {"wy", "1/s", "", [](const Motion& rows) { return &rows.wy; }},
    {"wz", "1/s", "angular velocity; z points up", [](const Motion& rows) { return &rows.wz; }},
    {"slip", "m/s", "slip, the sliding speed of the contact point", [](const Motion& rows) { return &rows.slip; }},
    {"energy", "J", "kinetic energy, if the mass is known",
     [](const Motion& rows) { return rows.energy.hasNaN() ? nullptr : &rows.energy; }},
};

constexpr Field<Roll> start_fields[]{
    {"law", "", "name of the law of friction", [](const Roll& roll) -> Json { return roll.law.name(); }},
    {"route", "", "name of the method of --route",
     [](const Roll& roll) -> Json { return roll.integrated || !roll.whole.is_reduced() ? "integrated" : "reduced"; }},
    {"mu", "", "radius of the patch divided by the radius R of the body",
     [](const Roll& roll) -> Json { return si::patch_ratio(roll.experiment, roll.law); }},
    {"ball", "", "values of the body and of its patch",
     [](const Roll& roll) { return members_of_ball(roll.experiment, roll.law); }},
    {"velocity", "m/s", "velocity of the centre at the start",
     [](const Roll& roll) { return list_of(si::velocities_of(roll.experiment.start).velocity); }},
    {"angular_velocity", "1/s", "angular velocity at the start",
     [](const Roll& roll) { return list_of(si::velocities_of(roll.experiment.start).angular_velocity); }},
    {"t_stop", "s", "time when slip and spin end", [](const Roll& roll) -> Json { return roll.whole.stop_time(); }},
    {"load", "s, N", "columns `t` and `load` of the file that --load names",
     [](const Roll& roll) { return roll.load ? members_of(*roll.load) : Json(); }, nullptr, 0,
     " {`t` [...], `load` [...]}"},
};

/// Events of the motion of a body, under the law or under the uncoupled model.
struct RollEvents {
  si::Events of;
  bool lies_flat;
  std::optional<double> threshold = {};  ///< slip below which the ball rolls, m/s
};

constexpr Field<RollEvents> event_fields[]{
    {"rolls_after", "s, m, m, m/s", "time and place at which the slip falls below --rolling-below (default 0.001 m/s)",
     [](const RollEvents& events) -> Json {
       if (events.lies_flat) return {};
       Json members = members_of(events.of.rolls);
       if (events.threshold) members["threshold"] = *events.threshold;
       return members;
     },
     nullptr, 0, " {`t`, `x`, `y`, `threshold`}"},
    {"spin_ends", "s, m, m", "time and place at which the spin ends; 0 if there was none",
     [](const RollEvents& events) { return members_of(events.of.spin_ends); }, nullptr, 0, " {`t`, `x`, `y`}"},
    {"rest", "s, m, m",
     "time and place at which the centre comes to rest: turning has ended and the slip is below 0.0001 m/s. For a "
     "puck, which has no rolls_after, and for a ball with rolling friction or on a slope",
     [](const RollEvents& events) {
       if (events.lies_flat) return members_of(events.of.rolls);
       return events.of.rest ? members_of(*events.of.rest) : Json();
     },
     nullptr, 0, " {`t`, `x`, `y`}"},
    {"slip_length", "m", "distance that the contact point slides",
     [](const RollEvents& events) -> Json { return events.of.slip_length; }},
    {"turns", "", "number of turns about the vertical",
     [](const RollEvents& events) -> Json { return events.of.turns; }},
    {"path", "m", "length of the path of the centre until the ball rolls or the puck rests",
     [](const RollEvents& events) -> Json { return events.of.path; }},
};

constexpr Field<Roll> rest_of_roll_fields[]{
    {"creeps", "",
     "limit of the slip divided by the patch radius and by |wz| while the ball spins, with --rolling-friction or "
     "--slope",
     [](const Roll& roll) -> Json {
       const auto k = roll.whole.creep_ratio();
       return k ? Json{{"k", *k}} : Json();
     },
     nullptr, 0, " {`k`}"},
    {"integrated", "s; m; 1; 1",
     "results of --route integrated, by which the rows are computed. All other events are computed by the route "
     "reduced",
     [](const Roll& roll) -> Json {
       if (!roll.in_steps) return {};
       const si::Motion& motion = *roll.in_steps;
       Json members{{"t_stop", motion.stop_time()}, {"slip_length", motion.slip_length()}, {"turns", motion.turns()}};
       if (const auto rest = motion.rest()) members["rest"] = members_of(*rest);
       if (!roll.is_driven()) members["steps"] = motion.steps();
       return members;
     },
     nullptr, 0, " {`t_stop`, `slip_length`, `turns`, `steps`}"},
    {"energy_balance", "J",
     "energies at the start, lost and kept at the end, if the mass is known. kept: energy of rolling. `lost_rolling` "
     "only with --rolling-friction, `gained_on_slope` only with --slope. If the ball rolls down for ever, the end is "
     "the time when slip and spin end",
     [](const Roll& roll) -> Json {
       if (!si::mass_is_known(roll.experiment.ball)) return {};
       const auto [start, sliding, pivoting, rolling, gained, kept] = roll.whole.energy_balance();
       Json members{{"start", start}, {"lost_sliding", sliding}, {"lost_spinning", pivoting}, {"kept", kept}};
       if (roll.is_driven()) members["lost_rolling"] = rolling;
       if (roll.experiment.environment.slope != 0) members["gained_on_slope"] = gained;
       return members;
     },
     nullptr, 0, " {`start`, `lost_sliding`, `lost_spinning`, `kept`}"},
    {"textbook", "",
     "events under the uncoupled model, in which friction brakes slip and spin separately; with the threshold of the "
     "ball",
     [](const Roll& roll) {
       return members_of(event_fields, RollEvents{roll.theirs(), roll.lies_flat()});
     }},
    {"gradient", "SI",
     "partial derivatives of the numbers of each event with respect to the numbers of the ball and its start, with "
     "--gradient. They are computed by differences, with an error of 1e-8. A derivative that does not exist is left out",
     [](const Roll& roll) { return roll.gradient ? members_of(*roll.gradient) : Json(); }, nullptr, 0,
     " {`rolls_after` {`t` {NAME: derivative}, ...}, ...}"},
    {"uncertainty", "as the event", "uncertainty of each number of an event, with --uncertainty; members as in stop",
     [](const Roll& roll) { return roll.uncertainty ? members_of(*roll.uncertainty) : Json(); }, nullptr, 0,
     " {`rolls_after` {`t` {`standard`, `quantiles` [...], `shares`, ...}, ...}, ...}"},
};

std::string gradient_text(const si::EventGradient& gradient, const Digits& digits) {
  std::vector columns(static_cast<std::size_t>(gradient.slopes.cols()) + 1, TextTable::right(digits.width()));
  columns.front() = TextTable::left(22);
  TextTable table(columns);
  std::vector<std::string> heading{"derivatives, SI, by"};
  for (const si::Component& by : gradient.by) heading.push_back(by.name());
  table.add(std::move(heading));
  for (std::size_t i = 0; i < gradient.events.size(); ++i) {
    std::vector<std::string> line{label_of(gradient.events[i])};
    for (const double slope : gradient.slopes.row(static_cast<Eigen::Index>(i))) line.push_back(digits(slope));
    table.add(std::move(line));
  }
  return table.text();
}

std::string heading(const si::Experiment& experiment, const reduction::Law& law, const Digits& digits) {
  const si::Velocities start = si::velocities_of(experiment.start);
  return ball_heading(experiment, law, digits) +
         fmt::format("velocity {} m/s, angular velocity {} 1/s: slip {} m/s, spin {} rad/s\n",
                     digits.list(start.velocity), digits.list(start.angular_velocity),
                     digits(si::slip_at_start(experiment)), digits(si::spin_at_start(experiment)));
}

/// Returns a sentence of plain words about the motion.
std::string opening(const Roll& roll) {
  const si::Events ours = roll.ours(), theirs = roll.theirs();
  const Eigen::Vector2d velocity = si::velocities_of(roll.experiment.start).velocity;
  const bool flat = roll.lies_flat(), slips = si::slip_at_start(roll.experiment) > 0;
  const bool spins = si::spin_at_start(roll.experiment) != 0, slopes = roll.experiment.environment.slope != 0;
  const auto when = [&](const si::Event& event) {
    const double way = event.place.stableNorm();
    return time_in_words(event.t) +
           (way == 0 ? ""
                     : fmt::format(", {} {}", length_in_words(way), event.place.dot(velocity) < 0 ? "back" : "on"));
  };
  std::vector<std::string> happens, times, times_of_theirs;
  const auto add = [&](const std::string& what, const si::Event& our, const si::Event& their) {
    happens.push_back(what + " after " + when(our));
    times.push_back(time_in_words(our.t));
    times_of_theirs.push_back(time_in_words(their.t));
  };
  const bool moves = slips || velocity.norm() > 0 || ours.rolls.t > 0;
  if (flat) {
    // A flat body rests when slip and spin have ended. In the uncoupled model the two end at different times.
    const auto last = [](const si::Events& of) { return of.spin_ends.t > of.rolls.t ? of.spin_ends : of.rolls; };
    if (moves) add("rests", last(ours), last(theirs));
  } else if (ours.rolls.t > 0) {
    add("rolls", ours.rolls, theirs.rolls);
  } else if (moves || (slopes && !ours.rest)) {
    happens.push_back(roll.tip && !slips
                          ? fmt::format("rolls at once, for a stroke {:.3g} radii above the centre gives "
                                        "it the spin of rolling",
                                        *roll.tip)
                          : "rolls at once");
  }
  if (!flat && moves && ours.rest && theirs.rest && ours.rest->t > ours.rolls.t) add("rests", *ours.rest, *theirs.rest);
  if (!flat && slopes && !ours.rest) happens.emplace_back("rolls down the slope for ever");
  if (happens.empty() && spins) add("spins in place and stops", ours.spin_ends, theirs.spin_ends);
  if (happens.empty()) return "It is at rest and stays there.\n";
  std::string sentence = fmt::format("It {}", fmt::join(happens, " and "));
  if (!times.empty())
    sentence += times == times_of_theirs
                    ? "; the uncoupled model says the same to two digits"
                    : fmt::format("; the uncoupled model says {}", fmt::join(times_of_theirs, " and "));
  return sentence + ".\n";
}

std::string events_text(const Roll& roll, const Digits& digits) {
  const si::Events ours = roll.ours(), theirs = roll.theirs();
  const auto width = TextTable::right(std::max(26, 2 * digits.count + 16));
  TextTable table({TextTable::left(24), width, width});
  const auto number = [&](const std::string& label, double first, double second, const std::string& unit) {
    table.add({label, digits(first), digits(second), "  " + unit});
  };
  const auto event = [&](const std::string& label, const si::Event& first, const si::Event& second) {
    number(label, first.t, second.t, "s");
    table.add({"  at", digits.list(first.place), digits.list(second.place), "  m"});
  };
  table.add({"", "law " + roll.law.name(), "textbook (uncoupled)", ""});
  const bool flat = roll.lies_flat();
  event(flat ? "its centre rests after" : "rolls after", ours.rolls, theirs.rolls);
  if (ours.rest && theirs.rest && !flat) event("its centre rests after", *ours.rest, *theirs.rest);
  if (si::spin_at_start(roll.experiment) != 0) {
    event("spins no more after", ours.spin_ends, theirs.spin_ends);
    number("turned about vertical", ours.turns, theirs.turns, "turns");
  }
  number("length of slip", ours.slip_length, theirs.slip_length, "m");
  number(flat ? "path until it rests" : "path until it rolls", ours.path, theirs.path, "m");
  std::string text = table.text();
  const bool spins_too = si::spin_at_start(roll.experiment) != 0 && si::slip_at_start(roll.experiment) > 0;
  if (!flat)
    text += fmt::format("\nrolls  once its slip is below {} m/s{} (--rolling-below){}\n", digits(roll.rolling_below),
                        roll.rolling_below == si::rolling_slip ? ", which no eye tells from rolling" : "",
                        spins_too ? ";\n       the last of it ends with the spin" : "");
  if (roll.law.as<reduction::PadeLaw>() != nullptr)
    text += fmt::format("pade   the paper's approximation,\n       {}\n", cost_of_pade);
  return text;
}

/// Returns lines on the effect of rolling resistance and slope, and on the route that computed the motion.
std::string resistance_text(const Roll& roll, const Digits& digits) {
  const si::Environment& environment = roll.experiment.environment;
  std::string text;
  if (environment.slope != 0)
    text += fmt::format("slope  {} degrees, {} along x: gravity pulls by {} m/s^2 and presses by {} m/s^2\n",
                        digits(environment.slope), environment.slope > 0 ? "uphill" : "downhill",
                        digits(si::pull(environment).norm()), digits(si::pressing(environment)));
  if (const double u_r = roll.experiment.contact.rolling_friction; u_r > 0)
    text += fmt::format(
        "rolling resistance slows it down by u_r g = {} m/s^2 when it rolls without slip; it acts all the time\n",
        digits(u_r * si::pressing(environment)));
  if (const auto k = roll.whole.creep_ratio()) {
    const double rim = *k * si::patch_radius_of(roll.experiment, roll.law);
    text +=
        fmt::format("creeps while it spins: its slip tends to {} m times its spin, k = {}\n", digits(rim), digits(*k));
  }
  const auto pieces = roll.whole.pieces();
  text += !roll.whole.is_reduced()
              ? "route  integrated: its slip, its roll and the slope have more than one direction, or "
                "drive it by more than friction holds\n"
          : pieces.empty() ? "route  reduced: it does not slide\n"
                           : fmt::format("route  reduced: it slides the way it rolls, with a drive of {}\n",
                                         digits(pieces.front().flow.system().drive()));
  if (roll.lies_flat()) return text;
  return text + (roll.whole.rest()
                     ? fmt::format("rests  once it no longer turns and slides below {} m/s\n", digits(si::resting_slip))
                     : "then   it rolls down the slope for ever\n");
}

std::string ending(const Roll& roll, const Digits& digits) {
  const si::Experiment& experiment = roll.experiment;
  const auto [velocity, angular_velocity] = si::final_motion(experiment);
  const auto [start, sliding, pivoting, rolling, gained, kept] = roll.whole.energy_balance();
  const bool slopes = experiment.environment.slope != 0;
  const std::string energy =
      !si::mass_is_known(experiment.ball)
          ? ""
          : fmt::format("energy {} J{}: {} lost by sliding, {} by spinning, {}{} kept{}\n", digits(start),
                        slopes ? fmt::format(" and {} J of the slope", digits(gained)) : "", digits(sliding),
                        digits(pivoting), rolling > 0 ? fmt::format("{} by rolling, ", digits(rolling)) : "",
                        digits(kept), slopes && !roll.whole.rest() ? " when slip and spin end" : "");
  const std::string resistance = roll.is_driven() ? resistance_text(roll, digits) : "";
  if (roll.lies_flat()) return resistance + "then   it lies still\n" + energy;
  if (roll.is_driven()) return resistance + energy;
  std::string text = fmt::format("then   it rolls straight on: velocity {} m/s, angular velocity {} 1/s\n",
                                 digits.list(velocity), digits.list(angular_velocity));
  if (velocity.norm() > 0) {
    const double degrees = std::atan2(velocity.y(), velocity.x()) * (180 / std::numbers::pi);
    text += fmt::format("       at {} m/s, {} degrees from the x axis\n", digits(velocity.norm()), digits(degrees));
  }
  return text + energy;
}

}  // namespace

double Roll::standard_end() const {
  const double end = whole.last_time();
  return end > 0 ? 1.1 * end : 1;
}

Answer roll_answer(const Roll& roll, const Eigen::ArrayXd& times) {
  Answer answer{.members = members_of(start_fields, roll), .columns = columns_of(motion_columns, roll.at(times))};
  answer.members.update(members_of(event_fields, {roll.ours(), roll.lies_flat(), roll.rolling_below}));
  answer.members.update(members_of(rest_of_roll_fields, roll));
  answer.remarks = answer.members;
  return answer;
}

std::string roll_text(const Roll& roll, const Digits& digits) {
  const std::string text =
      opening(roll) + heading(roll.experiment, roll.law, digits) +
      (roll.load ? fmt::format("the load changes: {} N is its first, {} N its last\n",
                               digits(roll.load->loads().front()), digits(roll.load->loads().back()))
                 : "") +
      "\n" + events_text(roll, digits) + "\n" + (roll.gradient ? gradient_text(*roll.gradient, digits) + "\n" : "") +
      (roll.uncertainty ? text_of(*roll.uncertainty, digits) + "\n" : "") + ending(roll, digits);
  if (!roll.in_steps) return text;
  const si::Motion& motion = *roll.in_steps;
  if (roll.is_driven()) {
    const auto rest = motion.rest();
    return text + fmt::format("route integrated: {}slip and spin end after {} s\n",
                              rest ? fmt::format("its centre rests after {} s at {} m, ", digits(rest->t),
                                                 digits.list(rest->place))
                                   : "",
                              digits(motion.stop_time()));
  }
  return text +
         fmt::format(
             "route integrated: slip and spin end after {} s, {:.1g} from the reduced route, whose events are those "
             "above;\n       it slips {} m and turns {} times, in {} steps\n",
             digits(motion.stop_time()), std::abs(motion.stop_time() - roll.whole.stop_time()),
             digits(motion.slip_length()), digits(motion.turns()), motion.steps());
}

Json members_of(const si::EventGradient& gradient) {
  Json members = Json::object();
  for (std::size_t i = 0; i < gradient.events.size(); ++i) {
    Json& slopes = place_of(gradient.events[i], members) = Json::object();
    for (std::size_t j = 0; j < gradient.by.size(); ++j)
      slopes[gradient.by[j].name()] = gradient.slopes(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
  }
  return members;
}

std::vector<FieldText> roll_fields() {
  return joined(
      {texts_of(motion_columns), texts_of(start_fields), texts_of(event_fields), texts_of(rest_of_roll_fields)});
}

}  // namespace contensou::answers
