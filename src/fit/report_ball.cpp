#include "fit/report.hpp"

#include <algorithm>
#include <cmath>

#include "contensou/reduction/laws.hpp"
#include "contensou/si/quantity.hpp"

namespace contensou::fit {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

void Reporter::set_ball() {
  const auto number = [&](Parameter parameter) { return fit_.estimate(parameter).value; };
  const bool whole_face = std::holds_alternative<si::WholeFace>(request_.ball.contact.patch);
  fit_.ball.contact = {.friction = number(Parameter::friction), .patch = request_.ball.contact.patch};
  if (search_.resisted) fit_.ball.contact.rolling_friction = number(Parameter::rolling_friction);
  if (request_.free.patch_radius || !whole_face)
    fit_.ball.contact.patch = si::PatchRadius{number(Parameter::patch_radius)};
  if (fit_.law != request_.ball.ball.body.law && reduction::find_law(fit_.law)) fit_.ball.contact.law = fit_.law;
  fit_.ball.spreads = {};
  const double slip = std::max(0.0, number(Parameter::slip)), spin = number(Parameter::spin);
  if (!is_free(TrackModel::place(Parameter::direction))) {
    fit_.ball.start = si::SlipAndSpin{slip, spin};
    return;
  }
  const double direction = number(Parameter::direction), radius = request_.ball.ball.radius;
  const Eigen::Vector2d of_contact(slip * std::cos(direction), slip * std::sin(direction));
  if (request_.ball.ball.body.lies_flat()) {
    fit_.ball.start = si::Velocities{of_contact, {0, 0, spin}};
    return;
  }
  const Eigen::Vector2d velocity = search_.resisted
                                       ? Eigen::Vector2d((slip + number(Parameter::rolling)) *
                                                         Eigen::Vector2d(std::cos(direction), std::sin(direction)))
                                       : Eigen::Vector2d(number(Parameter::vx), number(Parameter::vy));
  const Eigen::Vector2d difference = (velocity - of_contact) / radius;
  fit_.ball.start = si::Velocities{velocity, {-difference.y(), difference.x(), spin}};
}

void Reporter::set_spreads() {
  const auto number = [&](Parameter parameter) { return fit_.estimate(parameter).value; };
  const bool placed = is_free(TrackModel::place(Parameter::direction)), flat = request_.ball.ball.body.lies_flat();
  // `start_by` returns derivatives of the velocities at the start by a parameter. The rolling is velocity minus slip.
  const double along = placed ? number(Parameter::direction) : 0;
  const Eigen::Vector2d e(std::cos(along), std::sin(along)), across(-e.y(), e.x()), none = Eigen::Vector2d::Zero();
  const auto start_by = [&](Parameter parameter) -> Eigen::Matrix<double, 5, 1> {
    const bool with_slip = flat || search_.resisted;
    const double slip = number(Parameter::slip);
    Eigen::Vector2d centre = none, contact = none;
    if (parameter == Parameter::slip) contact = e;
    if (parameter == Parameter::direction) contact = slip * across;
    if (with_slip) centre = contact;
    if (parameter == Parameter::direction && search_.resisted) centre += number(Parameter::rolling) * across;
    if (parameter == Parameter::rolling) centre = e;
    if (parameter == Parameter::vx) centre = {1, 0};
    if (parameter == Parameter::vy) centre = {0, 1};
    const Eigen::Vector2d rolls = (centre - contact) / request_.ball.ball.radius;
    return {centre.x(), centre.y(), -rolls.y(), rolls.x(), parameter == Parameter::spin ? 1.0 : 0.0};
  };
  std::vector<si::Component> named{{&si::friction, 0}, {&si::patch_radius, 0}, {&si::rolling_friction, 0}};
  if (placed) {
    for (const std::size_t i : {0U, 1U}) named.push_back({&si::velocity, i});
    for (const std::size_t i : {0U, 1U, 2U}) named.push_back({&si::angular_velocity, i});
  } else {
    named.insert(named.end(), {{&si::slip, 0}, {&si::spin, 0}});
  }
  const auto free = fit_.free_estimates();
  MatrixXd slopes = MatrixXd::Zero(static_cast<Index>(named.size()), static_cast<Index>(free.size()));
  VectorXd errors = VectorXd::Zero(slopes.cols());
  for (Index i = 0; i < errors.size(); ++i) {
    const auto& [parameter, track, value, error, interval, is_free] = *free[static_cast<std::size_t>(i)];
    const auto row = static_cast<Index>(parameter);
    const bool of_place = parameter == Parameter::x || parameter == Parameter::y || parameter == Parameter::angle;
    const bool in_ball = placed ? !of_place : row < slopes.rows();
    if (!in_ball || track > 0) continue;
    if (!std::isfinite(error)) return;  // the data do not determine a number, so no spread describes it
    errors[i] = error;
    if (placed && row >= shared_parameters)
      slopes.col(i).tail<5>() = start_by(parameter);
    else
      slopes(row, i) = 1;  // `named` continues with slip and spin, in the order of Parameter
  }
  slopes = slopes * errors.asDiagonal();
  fit_.ball.spreads = si::spreads_of(slopes * fit_.correlation * slopes.transpose(), named);
}

}  // namespace contensou::fit
