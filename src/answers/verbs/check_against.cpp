#include "answers/verbs/check_against.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "answers/input/headings.hpp"
#include "contensou/reduction/laws.hpp"
#include "contensou/si/contact_cone.hpp"
#include "contensou/si/engine.hpp"
#include "contensou/si/motion.hpp"
#include "contensou/si/scaling.hpp"

namespace contensou::answers {

namespace {

/// The columns of a table that describe a motion.
class MotionColumns {
 public:
  /// @throws BadLine  if a column is missing
  MotionColumns(const CsvReader& table, const si::Ball& ball)
      : table_(table), radius_(ball.radius), time_(require_column(table, "t", "s")) {
    const auto time = find_column(table, "time", "s");
    if (time && time->column.place != time_.column.place)
      fail("columns t and time are both there: leave one of them out");
    slip_ = find_column(table, "slip", "m/s");
    rigid_ = !slip_ && find_column(table, "vx", "m/s");
    if (!rigid_ && !slip_) {
      fail(
          "no column is called 'slip': a motion has columns t (or time), slip and spin (or wz), or of a rigid body vx, "
          "vy, wx, wy, wz");
    }
    if (rigid_) {
      velocity_ = {require_column(table, "vx", "m/s"), require_column(table, "vy", "m/s")};
      if (!ball.body.lies_flat())
        turning_ = {require_column(table, "wx", "rad/s"), require_column(table, "wy", "rad/s")};
    }
    const auto spin = find_column(table, "spin", "rad/s"), wz = find_column(table, "wz", "rad/s");
    spin_ = spin ? *spin : wz ? *wz : require_column(table, rigid_ ? "wz" : "spin", "rad/s");
    if (spin) same_ = wz;
  }

  Instant read(const CsvRow& row) const {
    const auto value = [&](const SiColumn& column) { return column.factor * table_.number(row, column.column); };
    Instant instant{row.line(), value(time_), {0, value(spin_)}};
    if (same_) {
      if (const double wz = value(*same_); wz != instant.speeds.spin) {
        throw table_.complaint(instant.line,
                               fmt::format("spin {} and wz {} are one angular velocity, and differ: leave one of "
                                           "the columns out",
                                           instant.speeds.spin, wz));
      }
    }
    if (rigid_) {
      double x = value(velocity_[0]), y = value(velocity_[1]);
      if (!turning_.empty()) {
        x -= radius_ * value(turning_[1]);
        y += radius_ * value(turning_[0]);
      }
      instant.speeds.slip = std::hypot(x, y);
      const double wx = turning_.empty() ? 0 : value(turning_[0]), wy = turning_.empty() ? 0 : value(turning_[1]);
      instant.body = {{value(velocity_[0]), value(velocity_[1])}, {wx, wy, instant.speeds.spin}};
    } else {
      instant.speeds.slip = value(*slip_);
    }
    return instant;
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { throw table_.complaint(table_.header_line(), message); }

  const CsvReader& table_;
  double radius_;
  SiColumn time_, spin_{};
  std::optional<SiColumn> slip_, same_;
  bool rigid_ = false;
  std::vector<SiColumn> velocity_, turning_;
};

std::vector<Instant> read_instants(CsvReader& table, const si::Ball& ball) {
  const MotionColumns columns(table, ball);
  std::vector<Instant> instants;
  table.for_each_row([&](const CsvRow& row) {
    const Instant instant = columns.read(row);
    if (instants.empty() && instant.speeds.slip < 0)  // a later slip may be negative by an error of measurement
      throw table.complaint(instant.line,
                            fmt::format("slip: the start is a speed, 0 or more, got {}", instant.speeds.slip));
    if (!instants.empty() && instant.t < instants.back().t) {
      throw table.complaint(instant.line,
                            fmt::format("t: {} is before {} of the row above: put the rows in order of time", instant.t,
                                        instants.back().t));
    }
    instants.push_back(instant);
  });
  if (instants.size() < 2) {
    throw table.complaint(
        instants.empty() ? table.header_line() : instants.back().line,
        fmt::format("two rows or more are needed, got {}: the motion starts as the first says", instants.size()));
  }
  return instants;
}

/// Compares a model with the rows of the table.
void compare(ModelBeside& model, const MotionsBeside& motions, double tolerance) {
  for (const auto& [line, t, speeds, body] : motions.rows) {
    const si::SlipAndSpin modelled = model.motion(t - motions.rows.front().t);
    const auto take = [&, at = t](Deviation& deviation, double error, double unit) {
      if (error > deviation.error || std::isinf(deviation.t)) {
        deviation = {.error = error, .relative = error / unit, .t = at, .leaves = deviation.leaves};
      }
      if (error / unit > tolerance) deviation.leaves = std::min(deviation.leaves, at);
    };
    take(model.slip, std::abs(speeds.slip - modelled.slip), motions.slip_unit);
    take(model.spin, std::abs(speeds.spin - modelled.spin), motions.spin_unit);
  }
}

}  // namespace

double ModelBeside::worst() const { return std::max(slip.relative, spin.relative); }

const ModelBeside& MotionsBeside::nearest() const {
  constexpr double as_close = 1e-9;
  const double least = std::ranges::min_element(models, {}, &ModelBeside::worst)->worst();
  return *std::ranges::find_if(models, [&](const ModelBeside& model) { return model.worst() <= least + as_close; });
}

MotionsBeside compare_with_motions(const std::string& path, const si::Experiment& ball, const si::Description& values,
                                   const reduction::Law& law, double tolerance) {
  CsvReader table(path, CsvReader::Separator::comma_or_tab);
  const std::vector<Instant> instants = read_instants(table, ball.ball);
  const si::SlipAndSpin first = instants.front().speeds;
  si::Description first_row;
  // Rolling resistance and slope act on the rolling motion. Therefore the start must contain all velocities.
  const bool driven = si::is_driven(ball);
  if (const auto& body = instants.front().body; driven && body) {
    const auto& [velocity, w] = *body;
    first_row.set(si::velocity, {velocity.x(), velocity.y()}, {"", "velocity of the first row", ""});
    first_row.set(si::angular_velocity, {w.x(), w.y(), w.z()}, {"", "angular velocity of the first row", ""});
  } else {
    first_row.set(si::slip, {first.slip}, {"", "slip of the first row", ""});
    first_row.set(si::spin, {first.spin}, {"", "spin of the first row", ""});
  }
  si::Experiment experiment = ball;
  try {
    experiment = si::experiment_of(si::describe(ball).under(first_row).under(values));
  } catch (const std::domain_error& error) {
    throw table.complaint(instants.front().line, fmt::format("the start: {}", error.what()));
  }
  const double slip = si::slip_at_start(experiment), spin = std::abs(si::spin_at_start(experiment));
  if (slip == 0 && spin == 0) {
    throw table.complaint(instants.front().line, "the ball is at rest in the first row: there is no motion to compare");
  }
  const double R = experiment.ball.radius;
  MotionsBeside result{.rows = instants,
                       .start = {slip, si::spin_at_start(experiment)},
                       .slip_unit = slip > 0 ? slip : R * spin,
                       .spin_unit = spin > 0 ? spin : slip / R,
                       .models = {}};
  const auto add = [&](std::string name, std::function<si::SlipAndSpin(double)> motion) {
    ModelBeside model{std::move(name), std::move(motion)};
    compare(model, result, tolerance);
    result.models.push_back(std::move(model));
  };
  const auto speeds_of = [](const si::Motion& motion) {
    return [motion = motion.finite()](double t) {
      const si::MotionPoint point = motion.at(t);
      return si::SlipAndSpin{point.slip, point.angular_velocity.z()};
    };
  };
  const auto under = [&](const reduction::Law& of) { return speeds_of(si::Motion::reduced(experiment, of)); };
  add(law.name(), under(law));
  add("textbook (uncoupled)", speeds_of(si::Motion::uncoupled(experiment, law, 0)));
  if (!driven) {
    add("pyramid (engines)", [experiment, arm = si::contact_of(experiment, law).moment_arm()](double t) {
      return si::speeds_under_pyramid(experiment, arm, t);
    });
  }
  for (const reduction::Law& other : reduction::named_laws()) {
    if (other.name() == law.name()) continue;
    try {
      add(other.name(), under(other));
    } catch (const std::domain_error&) {
      // No patch inside the ball has the measured spin deceleration under this law, so this law is not compared.
    }
  }
  return result;
}

}  // namespace contensou::answers
