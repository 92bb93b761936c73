#include "answers/check_against.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "contensou/reduction/laws.hpp"
#include "contensou/si/ball_motion.hpp"
#include "contensou/si/contact_cone.hpp"
#include "contensou/si/engine.hpp"
#include "contensou/si/uncoupled_motion.hpp"

namespace contensou::answers {

namespace {

struct Instant {
  long line;
  double t;  ///< s
  si::SlipAndSpin speeds;
};

std::vector<Instant> read_instants(CsvReader& table) {
  const CsvColumn t = table.column("t"), slip = table.column("slip");
  const bool both = table.has_column("spin") && table.has_column("wz");
  const CsvColumn spin = table.column(!table.has_column("spin") && table.has_column("wz") ? "wz" : "spin");
  const CsvColumn same = both ? table.column("wz") : spin;
  std::vector<Instant> instants;
  table.for_each_row([&](const CsvRow& row) {
    const Instant instant{row.line(), table.number(row, t), {table.number(row, slip), table.number(row, spin)}};
    if (const double wz = table.number(row, same); wz != instant.speeds.spin) {
      throw table.complaint(instant.line,
                            fmt::format("spin {} and wz {} are one angular velocity, and differ: leave one of "
                                        "the columns out",
                                        instant.speeds.spin, wz));
    }
    if (instant.speeds.slip < 0)
      throw table.complaint(instant.line,
                            fmt::format("slip: a speed, 0 or more, is needed, got {}", instant.speeds.slip));
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

/// @param motion  slip and spin at a time in s from the start
template <class Motion>
ModelBeside beside(std::string name, const Motion& motion, const std::vector<Instant>& instants,
                   const MotionsBeside& scale, double tolerance) {
  ModelBeside model{std::move(name), {}, {}};
  for (const auto& [line, t, speeds] : instants) {
    const si::SlipAndSpin modelled = motion(t - instants.front().t);
    const auto take = [&, at = t](Deviation& deviation, double error, double unit) {
      if (error > deviation.error || std::isinf(deviation.t)) {
        deviation = {.error = error, .relative = error / unit, .t = at, .leaves = deviation.leaves};
      }
      if (error / unit > tolerance) deviation.leaves = std::min(deviation.leaves, at);
    };
    take(model.slip, std::abs(speeds.slip - modelled.slip), scale.slip_unit);
    take(model.spin, std::abs(speeds.spin - modelled.spin), scale.spin_unit);
  }
  return model;
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
  CsvReader table(path);
  const std::vector<Instant> instants = read_instants(table);
  const si::SlipAndSpin first = instants.front().speeds;
  si::Description first_row;
  first_row.set(si::slip, {first.slip}, {"", "slip of the first row", ""});
  first_row.set(si::spin, {first.spin}, {"", "spin of the first row", ""});
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
  MotionsBeside result{
      {slip, si::spin_at_start(experiment)}, slip > 0 ? slip : R * spin, spin > 0 ? spin : slip / R, {}};
  const auto add = [&](std::string name, const auto& motion) {
    result.models.push_back(beside(std::move(name), motion, instants, result, tolerance));
  };
  const auto speeds_of = [](const auto& motion) {
    return [&motion](double t) {
      const si::MotionPoint point = motion.at_time(t);
      return si::SlipAndSpin{point.slip, point.angular_velocity.z()};
    };
  };
  add(law.name(), speeds_of(si::BallMotion(experiment, law)));
  add("textbook (uncoupled)", speeds_of(si::UncoupledMotion(experiment, law)));
  add("pyramid (engines)", [&, arm = si::contact_of(experiment, law).moment_arm()](double t) {
    return si::speeds_under_pyramid(experiment, arm, t);
  });
  for (const reduction::Law& other : reduction::named_laws()) {
    if (other.name() == law.name()) continue;
    try {
      add(other.name(), speeds_of(si::BallMotion(experiment, other)));
    } catch (const std::domain_error&) {
      // Its patch would have to be larger than the ball for the spin deceleration that was measured.
    }
  }
  return result;
}

}  // namespace contensou::answers
