// contensou::si in Python: balls and their motion.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <type_traits>

#include <fmt/format.h>

#include "contensou/portraits/json.hpp"
#include "contensou/reduction/laws.hpp"
#include "contensou/si/ball_motion.hpp"
#include "contensou/si/catalogue.hpp"
#include "contensou/si/course.hpp"
#include "contensou/si/cue_strike.hpp"
#include "contensou/si/quantity.hpp"
#include "contensou/si/run_file.hpp"
#include "contensou/si/scaling.hpp"
#include "contensou/si/uncoupled_motion.hpp"
#include "values.hpp"
#include "verbs/engine_members.hpp"

namespace contensou::python {

namespace {

using reduction::Flow;
using reduction::Law;

using Pair = std::array<double, 2>;
using Triple = std::array<double, 3>;

/// An entry of the array that a motion gives.
struct Instant {
  double t, x, y, vx, vy, wx, wy, wz, slip, energy;
};

Instant instant_of(const si::MotionPoint& point) {
  const auto& [t, position, velocity, w, slip, energy] = point;
  return {t, position.x(), position.y(), velocity.x(), velocity.y(), w.x(), w.y(), w.z(), slip, energy};
}

/// The fields of a Ball of Python that say what its patch follows from.
si::PatchSource patch_of(const py::object& ball) {
  const auto radius = ball.attr("patch_radius").cast<std::optional<double>>();
  const auto deceleration = ball.attr("spin_deceleration").cast<std::optional<double>>();
  const auto modulus = ball.attr("youngs_modulus").cast<std::optional<Pair>>();
  const auto ratio = ball.attr("poisson_ratio").cast<std::optional<Pair>>();
  if (modulus.has_value() != ratio.has_value() ||
      radius.has_value() + deceleration.has_value() + modulus.has_value() != 1) {
    throw std::domain_error(
        "a ball's patch is given by one of patch_radius, spin_deceleration, and youngs_modulus with poisson_ratio");
  }
  if (radius) return si::PatchRadius{*radius};
  if (deceleration) return si::SpinDeceleration{*deceleration};
  return si::HertzModuli{.youngs_modulus = *modulus, .poisson_ratio = *ratio};
}

/// A Ball of Python with its own start, or with what takes the place of it.
si::Experiment experiment_of(const py::object& ball, const std::optional<Pair>& velocity,
                             const std::optional<Triple>& angular_velocity) {
  const auto number = [&](const char* field) { return ball.attr(field).cast<double>(); };
  si::Experiment experiment{
      .ball = {.name = ball.attr("name").cast<std::string>(), .mass = number("mass"), .radius = number("radius")},
      .contact = {.friction = number("friction"), .patch = patch_of(ball)},
      .start = si::SlipAndSpin{.slip = number("slip"), .spin = number("spin")},
      .environment = {.gravity = number("gravity")}};
  if (velocity || angular_velocity) {
    si::Velocities start = si::velocities_of(experiment.start);
    if (velocity) start.velocity = Eigen::Vector2d(velocity->data());
    if (angular_velocity) start.angular_velocity = Eigen::Vector3d(angular_velocity->data());
    experiment.start = start;
  }
  si::require_experiment(experiment);
  return experiment;
}

/// The fields of a Ball of Python.
py::dict fields_of(const si::Experiment& experiment) {
  if (experiment.ball.body.lies_flat()) {
    const auto [chi, gamma] = experiment.ball.body.inertia;
    const std::string law = si::law_of(experiment);
    throw std::domain_error(
        fmt::format("{} is a {}, which lies flat, and a Ball rolls: use Flow(mu={}, law=\"{}\", body=({}, {}))",
                    experiment.ball.name, experiment.ball.body.name,
                    si::patch_ratio(experiment, *reduction::find_law(law)), law, chi, gamma));
  }
  py::dict fields;
  fields["name"] = experiment.ball.name;
  fields["mass"] = experiment.ball.mass;
  fields["radius"] = experiment.ball.radius;
  fields["friction"] = experiment.contact.friction;
  fields["gravity"] = experiment.environment.gravity;
  fields["slip"] = si::slip_at_start(experiment);
  fields["spin"] = si::spin_at_start(experiment);
  fields["law"] = si::law_of(experiment);
  for (const auto& [quantity, values] : si::given_by(experiment.contact.patch)) {
    const py::str name(std::string(quantity->name));
    fields[name] = values.size() == 1 ? py::object(py::float_(values[0])) : py::make_tuple(values[0], values[1]);
  }
  return fields;
}

py::tuple place_of(const si::Event& event) { return py::make_tuple(event.t, event.place.x(), event.place.y()); }

template <class Motion, class Given>
void bind_course(py::module_& module, const char* name) {
  using Course = si::Course<Motion>;
  py::class_<Course>(module, name)
      .def(py::init(
               [](const si::Experiment& experiment, const Given& given, double rolling_below, double rolling_friction) {
                 return Course(experiment, Motion(experiment, given), rolling_below, rolling_friction);
               }),
           Released())
      .def_property_readonly("stop_time",
                             [](const Course& course) {
                               if constexpr (std::is_same_v<Motion, si::BallMotion>)
                                 return course.motion.stop_time();
                               else
                                 return std::max(course.motion.slip_time(0), course.motion.spin_end());
                             })
      .def("at",
           [](const Course& course, const Numbers& times) {
             return mapped<Instant>(times, [&](double t) { return instant_of(course.at_time(t)); });
           })
      .def_property_readonly("rolls_after", [](const Course& course) { return place_of(course.event(course.rolls)); })
      .def_property_readonly("spin_ends",
                             [](const Course& course) { return place_of(course.event(course.motion.spin_end())); })
      .def_property_readonly(
          "rest",
          [](const Course& course) {
            return course.friction
                       ? std::optional(place_of({course.friction->rest_time(), course.friction->rest_position()}))
                       : std::nullopt;
          })
      .def_property_readonly("slip_length", [](const Course& course) { return course.motion.slip_length(); })
      .def_property_readonly("turns",
                             [](const Course& course) { return course.motion.spin_angle() / (2 * std::numbers::pi); })
      .def_property_readonly("path", [](const Course& course) { return course.motion.path_length(course.rolls); });
}

}  // namespace

void bind_si(py::module_& module) {
  PYBIND11_NUMPY_DTYPE(Instant, t, x, y, vx, vy, wx, wy, wz, slip, energy);

  py::class_<si::Experiment>(module, "Experiment")
      .def(py::init(&experiment_of))
      .def(py::init([](const py::object& ball, double speed, Pair tip, double elevation, double cue_mass) {
        si::Experiment experiment = experiment_of(ball, {}, {});
        experiment.start = si::struck(experiment.ball, {.speed = speed,
                                                        .right = tip[0],
                                                        .above = tip[1],
                                                        .elevation = elevation * (std::numbers::pi / 180),
                                                        .mass = cue_mass});
        si::require_experiment(experiment);
        return experiment;
      }))
      .def(
          "flow",
          [](const si::Experiment& experiment, const Law& law) { return Flow(si::reduced_system(experiment, law)); },
          Released())
      .def_property_readonly("start", [](const si::Experiment& experiment) {
        const auto [velocity, w] = si::velocities_of(experiment.start);
        return py::make_tuple(py::make_tuple(velocity.x(), velocity.y()), py::make_tuple(w.x(), w.y(), w.z()));
      });

  bind_course<si::BallMotion, Flow>(module, "BallMotion");
  bind_course<si::UncoupledMotion, Law>(module, "UncoupledMotion");

  module.def("ball", [](const std::string& name) {
    std::vector<std::pair<std::string, si::Experiment>> balls;
    for (const si::CatalogueEntry& entry : si::catalogue()) balls.emplace_back(entry.name, entry.experiment);
    return fields_of(one_of("ball", "balls", balls, name));
  });
  module.def("parse_run_file", [](const std::string& text, const std::string& source) {
    return fields_of(si::parse_run_file(text, source));
  });
  module.def(
      "engines",
      [](const si::Experiment& experiment, const Law& law, const std::optional<std::string>& name) {
        std::vector<std::pair<std::string, const si::Engine*>> engines;
        for (const si::Engine& engine : si::engines()) engines.emplace_back(engine.name, &engine);
        const si::Engine* const only = name ? one_of("engine", "engines", engines, *name) : nullptr;
        return portraits::json_document(program::engine_members(experiment, law, only));
      },
      Released());
  module.attr("rolling_slip") = si::rolling_slip;
  module.attr("standard_cue_mass") = si::standard_cue_mass;
}

}  // namespace contensou::python
