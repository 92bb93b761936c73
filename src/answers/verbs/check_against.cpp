#include "answers/verbs/check_answer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <Eigen/Core>

#include "answers/input/tables.hpp"
#include "answers/input/track_file.hpp"
#include "contensou/reduction/laws.hpp"
#include "contensou/si/contact_cone.hpp"
#include "contensou/si/engine.hpp"
#include "contensou/si/motion.hpp"
#include "contensou/si/scaling.hpp"

namespace contensou::answers {

namespace {

/// A way to read the numbers of a log.
struct Reading {
  bool y_up = false;      ///< the y axis points upwards
  bool reversed = false;  ///< angular velocities have the opposite sense, as in left-handed axes
  std::string_view turning_unit = {};
  double turning_factor = 1;  ///< factor that converts angular velocities to those of the headings

  std::string words() const {
    std::vector<std::string> parts;
    if (y_up) parts.emplace_back("with y up, as (x, -z, y)");
    if (reversed) parts.emplace_back("with left-handed axes, so that wx, wy, wz are reversed");
    if (!turning_unit.empty()) parts.push_back(fmt::format("with angular velocities in {}", turning_unit));
    return fmt::format("{}", fmt::join(parts, " and "));
  }
};

/// A row of a table before it is read in one way.
struct LoggedRow {
  long line;
  double t;
  /// Velocities; without a rigid body, slip and spin in the first and the last place. In a table of positions, place
  /// and angle until by_differences() has converted them.
  Eigen::Vector3d velocity, turning;
};

/// The columns of a table that describe a motion.
class MotionColumns {
 public:
  /// @throws BadLine  if a column is missing
  MotionColumns(const CsvReader& table, const si::Ball& ball) : table_(table), ball_(ball) {
    time_ = require_column(table, "t", "s");
    const auto time = find_column(table, "time", "s");
    if (time && time->column.place != time_.column.place)
      fail("columns t and time are both there: leave one of them out");
    const auto slip = find_column(table, "slip", "m/s"), x = find_column(table, "x", "m");
    rigid_ = !slip && find_column(table, "vx", "m/s");
    if (!rigid_ && !slip && x) {
      if (!ball.body.lies_flat()) {
        fail(
            "positions do not tell the slip of a ball: add columns vx, vy, wx, wy, wz, or let 'contensou fit' read x, y "
            "and angle");
      }
      velocity_ = {x, require_column(table, "y", "m")};
      const auto angle = find_column(table, "angle", "rad");
      turning_[2] = angle ? *angle : require_column(table, "wz", "rad/s");
      positions_ = rigid_ = true, angles_ = angle.has_value();
      return;
    }
    if (!rigid_ && !slip) {
      fail(
          "no column is called 'slip': a motion has columns t (or time), slip and spin (or wz), of a rigid body vx, vy, "
          "wx, wy, wz, or of a flat body x, y, angle");
    }
    const auto spin = find_column(table, "spin", "rad/s"), wz = find_column(table, "wz", "rad/s");
    turning_[2] = spin ? *spin : wz ? *wz : require_column(table, rigid_ ? "wz" : "spin", "rad/s");
    if (spin) same_ = wz;
    if (!rigid_) {
      velocity_[0] = *slip;
      return;
    }
    velocity_ = {require_column(table, "vx", "m/s"), require_column(table, "vy", "m/s"),
                 find_column(table, "vz", "m/s")};
    const char* const names[]{"wx", "wy"};
    for (const std::size_t i : {0U, 1U}) {
      turning_[i] =
          ball.body.lies_flat() ? find_column(table, names[i], "rad/s") : require_column(table, names[i], "rad/s");
    }
  }

  /// Returns false for a row in which a needed number is missing.
  bool is_complete(const CsvRow& row) const {
    return std::ranges::all_of(std::array{velocity_[0], rigid_ ? velocity_[1] : std::nullopt, turning_[2],
                                          ball_.body.lies_flat() ? std::nullopt : turning_[0],
                                          ball_.body.lies_flat() ? std::nullopt : turning_[1]},
                               [&](const auto& column) { return !column || is_measured(row[column->column.place]); });
  }

  /// Converts rows of positions to rows of mean velocities between them. Under a constant deceleration, these are the
  /// velocities at the middle of the interval. Angles within one turn may have lost whole turns.
  std::vector<LoggedRow> by_differences(std::vector<LoggedRow> rows) const {
    if (!positions_) return rows;
    constexpr double turn = 2 * std::numbers::pi;
    const auto [least, largest] = std::ranges::minmax(rows, {}, [](const LoggedRow& row) { return row.turning.z(); });
    const bool wrapped = largest.turning.z() - least.turning.z() <= turn * (1 + 1e-9);
    std::vector<LoggedRow> means;
    for (std::size_t i = 1; i < rows.size(); ++i) {
      const LoggedRow &before = rows[i - 1], &after = rows[i];
      const double dt = after.t - before.t;
      if (dt == 0) continue;
      const double angle = after.turning.z() - before.turning.z();
      const double spin = !angles_ ? (after.turning.z() + before.turning.z()) / 2
                                   : (wrapped ? std::remainder(angle, turn) : angle) / dt;
      means.push_back({after.line, before.t + dt / 2, (after.velocity - before.velocity) / dt, {0, 0, spin}});
    }
    return means;
  }

  LoggedRow read(const CsvRow& row) const {
    const auto value = [&](const std::optional<SiColumn>& column) {
      return column ? column->factor * table_.number(row, column->column) : 0;
    };
    LoggedRow logged{row.line(), value(time_), {}, {}};
    for (Eigen::Index i = 0; i < 3; ++i) {
      const auto place = static_cast<std::size_t>(i);
      // Only other readings use the velocity upwards, and how a flat body turns about a horizontal axis.
      const bool needed = i < 2 || !rigid_, turns = i == 2 || !ball_.body.lies_flat();
      const auto number = [&](const std::optional<SiColumn>& column, bool must) {
        return must || !column || is_number(row[column->column.place]) ? value(column) : NAN;
      };
      logged.velocity[i] = number(velocity_[place], needed);
      logged.turning[i] = number(turning_[place], turns);
    }
    if (const double spin = logged.turning.z(); same_ && value(same_) != spin) {
      throw table_.complaint(logged.line,
                             fmt::format("spin {} and wz {} are one angular velocity, and differ: leave one of "
                                         "the columns out",
                                         spin, value(same_)));
    }
    return logged;
  }

  Instant read(const LoggedRow& row, const Reading& reading) const {
    const auto turned = [&](const Eigen::Vector3d& of) -> Eigen::Vector3d {
      return reading.y_up ? Eigen::Vector3d(of.x(), -of.z(), of.y()) : of;
    };
    const Eigen::Vector3d v = turned(row.velocity);
    Eigen::Vector3d w = turned(row.turning) * (reading.reversed ? -reading.turning_factor : reading.turning_factor);
    if (!rigid_) return {row.line, row.t, {v.x(), w.z()}};
    if (ball_.body.lies_flat()) w.x() = w.y() = 0;
    const double slip = std::hypot(v.x() - ball_.radius * w.y(), v.y() + ball_.radius * w.x());
    return {row.line, row.t, {slip, w.z()}, si::Velocities{v.head<2>(), w}};
  }

  /// Returns the ways to read this table, the simplest ones first. The first way is that of the headings.
  std::vector<Reading> readings() const {
    std::vector<Reading> all;
    const bool names_unit =
        std::ranges::any_of(turning_, [](const auto& column) { return column && !column->unit.empty(); });
    constexpr double degree = std::numbers::pi / 180;
    for (const auto& [unit, factor] :
         {std::pair<std::string_view, double>{"", 1}, {"degrees/s", degree}, {"rpm", 6 * degree}}) {
      if (names_unit && !unit.empty()) continue;
      for (const auto& [y_up, reversed] : {std::pair{false, false}, {false, true}, {true, false}, {true, true}}) {
        if ((reversed && !rigid_) || (y_up && !(velocity_[2] && turning_[1]))) continue;
        all.push_back({y_up, reversed, unit, factor});
      }
    }
    return all;
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { throw table_.complaint(table_.header_line(), message); }

  const CsvReader& table_;
  const si::Ball& ball_;
  bool rigid_ = false, positions_ = false, angles_ = false;
  SiColumn time_;
  std::array<std::optional<SiColumn>, 3> velocity_, turning_;
  std::optional<SiColumn> same_;
};

std::vector<LoggedRow> read_rows(CsvReader& table, const MotionColumns& columns) {
  std::vector<LoggedRow> rows;
  table.for_each_row([&](const CsvRow& row) {
    if (!columns.is_complete(row)) return;
    const LoggedRow logged = columns.read(row);
    const Instant instant = columns.read(logged, {});
    if (rows.empty() && instant.speeds.slip < 0)  // a later slip may be negative by an error of measurement
      throw table.complaint(instant.line,
                            fmt::format("slip: the start is a speed, 0 or more, got {}", instant.speeds.slip));
    if (!rows.empty() && instant.t < rows.back().t) {
      throw table.complaint(instant.line, fmt::format("t: {} is before {} of the row above: put the rows in order of "
                                                      "time",
                                                      instant.t, rows.back().t));
    }
    rows.push_back(logged);
  });
  rows = columns.by_differences(std::move(rows));
  if (rows.size() < 2) {
    throw table.complaint(
        rows.empty() ? table.header_line() : rows.back().line,
        fmt::format("two rows or more are needed, got {}: the motion starts as the first says", rows.size()));
  }
  return rows;
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

/// Compares the rows of a table with the motions of all models.
/// @throws std::domain_error  if the first row is no start of the ball
MotionsBeside motions_beside(std::vector<Instant> rows, const si::Experiment& ball, const si::Description& values,
                             const reduction::Law& law, double tolerance) {
  const si::SlipAndSpin first = rows.front().speeds;
  si::Description first_row;
  // Rolling resistance and slope act on the rolling motion. Therefore the start must contain all velocities.
  const bool driven = si::is_driven(ball);
  if (const auto& body = rows.front().body; driven && body) {
    const auto& [velocity, w] = *body;
    first_row.set(si::velocity, {velocity.x(), velocity.y()}, {"", "velocity of the first row", ""});
    first_row.set(si::angular_velocity, {w.x(), w.y(), w.z()}, {"", "angular velocity of the first row", ""});
  } else {
    first_row.set(si::slip, {first.slip}, {"", "slip of the first row", ""});
    first_row.set(si::spin, {first.spin}, {"", "spin of the first row", ""});
  }
  const si::Experiment experiment = [&] {
    try {
      return si::experiment_of(si::describe(ball).under(first_row).under(values));
    } catch (const std::domain_error& error) {
      throw std::domain_error(fmt::format("the start: {}", error.what()));
    }
  }();
  const double slip = si::slip_at_start(experiment), spin = std::abs(si::spin_at_start(experiment));
  if (slip == 0 && spin == 0)
    throw std::domain_error("the ball is at rest in the first row: there is no motion to compare");
  const double R = experiment.ball.radius;
  MotionsBeside result{.rows = std::move(rows),
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

}  // namespace

double ModelBeside::worst() const { return std::max(slip.relative, spin.relative); }

const ModelBeside& MotionsBeside::best() const {
  constexpr double as_close = 1e-9;
  const double least = std::ranges::min_element(models, {}, &ModelBeside::worst)->worst();
  return *std::ranges::find_if(models, [&](const ModelBeside& model) { return model.worst() <= least + as_close; });
}

const ModelBeside* MotionsBeside::nearest() const { return best().worst() <= near ? &best() : nullptr; }

MotionsBeside compare_with_motions(const std::string& path, const si::Experiment& ball, const si::Description& values,
                                   const reduction::Law& law, double tolerance) {
  CsvReader table(path, CsvReader::Separator::any);
  const MotionColumns columns(table, ball.ball);
  const std::vector<LoggedRow> rows = read_rows(table, columns);
  const auto with = [&](const Reading& reading, std::size_t step) {
    std::vector<Instant> instants;
    for (std::size_t i = 0; i < rows.size(); i += step) instants.push_back(columns.read(rows[i], reading));
    return motions_beside(std::move(instants), ball, values, law, tolerance);
  };
  const auto as_written = [&] {
    try {
      return with({}, 1);
    } catch (const std::domain_error& error) {
      throw table.complaint(rows.front().line, error.what());
    }
  };
  MotionsBeside result = as_written();
  const double least = result.best().worst();
  if (least <= tolerance) return result;
  constexpr std::size_t enough = 200;  // number of rows that tell whether a reading fits
  double allowed = std::max(tolerance, std::min(0.1, least / 10));
  std::optional<Reading> found;
  for (const Reading& reading : columns.readings()) {
    try {
      const double off = with(reading, 1 + rows.size() / enough).best().worst();
      constexpr double as_close = 1e-9;
      if (!(off <= allowed - (found ? as_close : 0))) continue;
      allowed = off;
      found = reading;
    } catch (const std::domain_error&) {
      // the first row, read like this, is no start of the ball
    }
  }
  if (found) {
    const MotionsBeside fitting = with(*found, 1);
    result.reading = fmt::format("read {}, the log fits the model {} to {:.2g} of its start", found->words(),
                                 fitting.best().name, fitting.best().worst());
  }
  return result;
}

}  // namespace contensou::answers
