// Derivatives of the events of a roll are compared with (R11) and the first integrals, by the chain rule.
#include "contensou/si/event_gradient.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include <catch2/catch.hpp>

#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/laws.hpp"
#include "contensou/si/catalogue.hpp"
#include "contensou/si/motion.hpp"
#include "contensou/si/scaling.hpp"

using namespace contensou;
using namespace contensou::si;

namespace {

const reduction::Law of_hertz{reduction::HertzLaw{}};

Experiment gel_shot() {
  Experiment experiment = find_ball("gel")->experiment;
  experiment.contact.patch = PatchRadius{0.006};
  experiment.start = Velocities{{0.5, 0.2}, {3, -5, 80}};
  return experiment;
}

/// The exact derivative of the events t, x, y by a change of start and friction. R, the patch and gravity are constant.
class Exact {
 public:
  Exact(const Experiment& experiment, const Velocities& change, double by_friction)
      : start_(velocities_of(experiment.start)),
        contact_(slip_velocity_at_start(experiment)),
        flow_(undriven_system(experiment, of_hertz)),
        state_(reduced_start(experiment)),
        chi_(experiment.ball.body.inertia.chi),
        second_(seconds(experiment, 1)),
        change_(change),
        ln_second_(-by_friction / experiment.contact.friction) {
    const double R = experiment.ball.radius;
    of_contact_ = {change.velocity.x() - R * change.angular_velocity.y(),
                   change.velocity.y() + R * change.angular_velocity.x()};
    along_ = contact_ / state_.v;
    dv_ = along_.dot(of_contact_);
    du_ = R * change.angular_velocity.z();
  }

  /// Returns the derivatives of t, x, y of the event at which the slip has fallen to a speed.
  Eigen::Vector3d slips(double speed) const {
    const double tau = flow_.orbit(state_).time_of_v(speed);
    const reduction::InstantGradient at = reduction::instant_gradient(flow_, state_, tau);
    return event(at, tau, -(at.v.by_v * dv_ + at.v.by_u * du_) / at.v.by_tau);
  }

  Eigen::Vector3d stops() const {
    const auto by = flow_.stop_time_gradient(state_);
    return event(reduction::instant_gradient(flow_, state_, by.tau), by.tau, by.by_v * dv_ + by.by_u * du_);
  }

  /// Return the derivatives of two integrals over time until the stop: of the slip, and of R omega_z.
  double slip_length() const { return integral(at_stop().slip_length); }
  double turned() const { return integral(at_stop().turned); }

 private:
  reduction::InstantGradient at_stop() const {
    return reduction::instant_gradient(flow_, state_, flow_.stop_time(state_).tau);
  }
  double integral(const reduction::InstantGradient::Part& part) const {
    return second_ * (part.by_v * dv_ + part.by_u * du_ + ln_second_ * part.value);
  }

  Eigen::Vector3d event(const reduction::InstantGradient& at, double tau, double dtau) const {
    const double t = second_ * tau, dt = second_ * dtau + ln_second_ * t;
    const double slid = second_ * at.slip_length.value;
    const double dslid = integral(at.slip_length) + second_ * at.slip_length.by_tau * dtau;
    const Eigen::Vector2d turn = (of_contact_ - along_ * dv_) / state_.v;
    const Eigen::Vector2d place = change_.velocity * t + start_.velocity * dt -
                                  ((dv_ * t + state_.v * dt - dslid) * along_ + (state_.v * t - slid) * turn) / chi_;
    return {dt, place.x(), place.y()};
  }

  Velocities start_;
  Eigen::Vector2d contact_, of_contact_, along_;
  reduction::Flow flow_;
  reduction::State state_;
  double chi_, second_;
  Velocities change_;
  double ln_second_, dv_ = 0, du_ = 0;
};

}  // namespace

TEST_CASE("events change with the start and with friction as the algebra has it", "[invariant]") {
  const Experiment experiment = gel_shot();
  const EventNumbers numbers(experiment, of_hertz, rolling_slip);
  const auto check = [&](const Component& by, const Velocities& change, double by_friction) {
    const Eigen::VectorXd slopes = *numbers.slopes(by);
    const Exact exact(experiment, change, by_friction);
    INFO(by.name());
    const auto near = [](double found, double wanted) {
      return std::abs(found - wanted) < 1e-8 * (1 + std::abs(wanted));
    };
    const Eigen::Vector3d rolls = exact.slips(rolling_slip), stops = exact.stops();
    for (Eigen::Index i = 0; i < 3; ++i) {
      CHECK(near(slopes[i], rolls[i]));
      CHECK(near(slopes[3 + i], stops[i]));
    }
    CHECK(near(slopes[6], exact.slip_length()));
    CHECK(near(slopes[7], exact.turned() / (2 * std::numbers::pi * experiment.ball.radius)));
    CHECK(near(slopes[9], stops[0]));
  };
  for (std::size_t i = 0; i < 2; ++i)
    check({&velocity, i}, {Eigen::Vector2d::Unit(static_cast<Eigen::Index>(i)), Eigen::Vector3d::Zero()}, 0);
  for (std::size_t i = 0; i < 3; ++i)
    check({&angular_velocity, i}, {Eigen::Vector2d::Zero(), Eigen::Vector3d::Unit(static_cast<Eigen::Index>(i))}, 0);
  check({&friction, 0}, {Eigen::Vector2d::Zero(), Eigen::Vector3d::Zero()}, 1);
}

TEST_CASE("the stop time changes with the patch and with R as the exact gradient has it", "[invariant]") {
  Experiment experiment = gel_shot();
  experiment.start = SlipAndSpin{0.5, 80};
  const EventNumbers numbers(experiment, of_hertz, rolling_slip);
  const double R = experiment.ball.radius;
  const auto by = reduction::Flow(undriven_system(experiment, of_hertz)).stop_time_gradient(reduced_start(experiment));
  const double second = seconds(experiment, 1);
  CHECK((*numbers.slopes({&patch_radius, 0})).tail<1>()[0] == Approx(second * by.by_mu / R).epsilon(1e-8));
  CHECK((*numbers.slopes({&radius, 0})).tail<1>()[0] ==
        Approx(second * (by.by_u * 80 - by.by_mu * 0.006 / (R * R))).epsilon(1e-8));
}

TEST_CASE("a ball with rolling friction: its rest, and what has no derivative", "[invariant]") {
  // A rolling ball loses u_r g per second: t = V/(u_r g), x = V^2/(2 u_r g). The spin changes neither of them.
  Experiment experiment = gel_shot();
  experiment.contact.rolling_friction = 0.01;
  const double V = 0.6, R = experiment.ball.radius, g = experiment.environment.gravity;
  experiment.start = Velocities{{V, 0}, {0, V / R, 0}};
  CHECK_THROWS_WITH(EventNumbers(experiment, of_hertz, rolling_slip), "a body at rest has no events");
  experiment.start = SlipAndSpin{0.5, 0};
  const EventNumbers numbers(experiment, of_hertz, rolling_slip);
  const auto names = numbers.names();
  CHECK(names.size() == 13);
  CHECK(names[6].event == "rest");
  // Without spin the slip falls at the rate (f - u_r) chi g until the ball rolls. The centre slows down at the rate (f
  // - u_r) g + u_r g before this time, and at u_r g after it.
  const double v = 0.5, f = experiment.contact.friction, chi = experiment.ball.body.inertia.chi, u_r = 0.01;
  const auto rest_time = [&](double friction_there, double resisting) {
    const double slides = v / (chi * (friction_there - resisting) * g);
    return slides + (v - friction_there * g * slides) / (resisting * g);
  };
  const double h = 1e-6;
  const double by_u_r = (rest_time(f, u_r + h * u_r) - rest_time(f, u_r - h * u_r)) / (2 * h * u_r);
  CHECK(numbers.values()[6] == Approx(rest_time(f, u_r)).epsilon(1e-9));
  CHECK((*numbers.slopes({&rolling_friction, 0}))[6] == Approx(by_u_r).epsilon(1e-7));
  CHECK_FALSE(numbers.slopes({&spin, 0}));
  const EventGradient gradient = event_gradient(numbers);
  CHECK(std::ranges::find(gradient.by, Component{&spin, 0}) == gradient.by.end());
  CHECK(gradient.slopes.cols() == static_cast<Eigen::Index>(gradient.by.size()));
}

// References: differences of an integration in Python that shares no code with the library, accurate to 1e-9.
TEST_CASE("a ball that slides across its roll: what its rest changes with", "[reference]") {
  Experiment experiment = find_ball("pool")->experiment;
  experiment.contact.patch = PatchRadius{0.0028270315380884551};
  experiment.contact.rolling_friction = 0.03;
  experiment.start = Velocities{{1, 0}, {30, -60, 50}};
  const EventNumbers numbers(experiment, of_hertz, rolling_slip);
  CHECK(numbers.values()[6] == Approx(1.7021593006278).epsilon(1e-11));
  for (const auto& [by, wanted] : {std::pair{Component{&velocity, 0}, 1.92660974935},
                                   {Component{&velocity, 1}, -1.11223209823},
                                   {Component{&angular_velocity, 0}, 0.0115651085306},
                                   {Component{&angular_velocity, 1}, 0.0139441862134},
                                   {Component{&angular_velocity, 2}, 0.0062010590741},
                                   {Component{&friction, 0}, -3.36941076323},
                                   {Component{&rolling_friction, 0}, -34.2759049326},
                                   {Component{&patch_radius, 0}, 56.1797729966}}) {
    INFO(by.name());
    CHECK((*numbers.slopes(by))[6] == Approx(wanted).epsilon(1e-8));
  }
}

TEST_CASE("at the threshold of rolling what moves the slip has a corner, and near it none of its steps meets it",
          "[edge]") {
  // Without spin the slip falls at chi f g.
  Experiment experiment = gel_shot();
  const double R = experiment.ball.radius, threshold = 0.5;
  const double slowing =
      experiment.ball.body.inertia.chi * experiment.contact.friction * experiment.environment.gravity;
  for (const auto& [v, wanted] : {std::pair{0.5001, 1 / slowing}, {0.4999, 0.0}, {0.50001, 1 / slowing}}) {
    INFO(v);
    const auto first = [&](const Component& by) {
      return (*EventNumbers(experiment, of_hertz, threshold).slopes(by))[0];
    };
    experiment.start = SlipAndSpin{v, 0};
    CHECK(first({&slip, 0}) == Approx(wanted).epsilon(1e-8).margin(1e-12));
    experiment.start = Velocities{{0, 0}, {0, -v / R, 0}};
    CHECK(first({&velocity, 0}) == Approx(wanted).epsilon(1e-8).margin(1e-12));
    CHECK(first({&angular_velocity, 1}) == Approx(-R * wanted).epsilon(1e-8).margin(1e-12));
    CHECK(first({&radius, 0}) == Approx(v / R * wanted).epsilon(1e-8).margin(1e-12));
  }
  experiment.start = SlipAndSpin{threshold, 20};
  const EventNumbers there(experiment, of_hertz, threshold);
  CHECK_FALSE(there.slopes({&slip, 0}));
  CHECK(there.slopes({&spin, 0}));
}
