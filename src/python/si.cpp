// contensou::si in Python: balls and their motion.
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <exception>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "answers/asked/formula_law.hpp"
#include "answers/verbs/ball_answers.hpp"
#include "contensou/portraits/json.hpp"
#include "contensou/si/catalogue.hpp"
#include "contensou/si/experiment.hpp"
#include "contensou/si/motion.hpp"
#include "contensou/si/quantity.hpp"
#include "contensou/si/run_file.hpp"
#include "contensou/si/scaling.hpp"
#include "contensou/si/wrench.hpp"
#include "values.hpp"

namespace contensou::python {

namespace {

using reduction::Flow;
using reduction::Law;

using Pair = std::array<double, 2>;

/// The state of a motion at one instant, an entry of the array.
struct Instant {
  double t, x, y, vx, vy, wx, wy, wz, slip, energy;
};

Instant instant_of(const si::MotionPoint& point) {
  const auto& [t, position, velocity, w, slip, energy] = point;
  return {t, position.x(), position.y(), velocity.x(), velocity.y(), w.x(), w.y(), w.z(), slip, energy};
}

/// Returns a value of the caller as text for a message; for an array, its shape.
std::string words_of(const py::handle& value) {
  if (py::hasattr(value, "shape")) return "an array of shape " + py::repr(value.attr("shape")).cast<std::string>();
  constexpr std::size_t most = 60;
  const auto words = py::repr(value).cast<std::string>();
  return words.size() > most ? words.substr(0, most) + "..." : words;
}

/// Numbers of a result, by their first entry, and their number for each contact.
struct Result {
  double* first;
  py::ssize_t size;
};

/// Calls `compute` for each contact, with its index, its motion and its other numbers. Writes NaN where one of them is
/// NaN.
/// @param given    other numbers; each has one value for each contact, or one for all
/// @param compute  function that writes the results and returns a description of a wrong number; null if there is none
/// @throws std::domain_error  for the first contact with a wrong number; the message names this contact by its index
template <std::size_t size, class Compute>
void for_contacts(const Numbers& motions, const std::array<Numbers, size>& given, const std::vector<Result>& results,
                  const Compute& compute) {
  const double* const speeds = motions.data();
  std::array<const double*, size> from{};
  std::array<py::ssize_t, size> stride{};
  for (std::size_t j = 0; j < size; ++j) from[j] = given[j].data(), stride[j] = given[j].size() == 1 ? 0 : 1;
  const py::ssize_t count = motions.size() / 3;
  const py::gil_scoped_release released;
  Interruption interruption;
  for (py::ssize_t i = 0; i < count; ++i) {
    interruption.check();
    const Eigen::Vector3d motion(speeds[3 * i], speeds[3 * i + 1], speeds[3 * i + 2]);
    Eigen::Array<double, size, 1> numbers;
    for (std::size_t j = 0; j < size; ++j) numbers[j] = from[j][i * stride[j]];
    const char* const fault = compute(i, motion, numbers);
    if (fault == nullptr) continue;
    if (!motion.hasNaN() && !numbers.hasNaN()) throw std::domain_error(fmt::format("contact {}: {}", i, fault));
    for (const Result& result : results)
      std::fill_n(result.first + result.size * i, result.size, std::numeric_limits<double>::quiet_NaN());
  }
}

/// Writes the friction of contacts to `values`, and its slopes to `slopes`, if that has entries.
/// @param given  loads, then friction, radius and creep of the patches
void wrenches(const si::PatchFriction& friction, const Numbers& motions, const std::array<Numbers, 4>& given,
              py::array_t<double>& values, py::array_t<double>& slopes) {
  std::vector<Result> results{{values.mutable_data(), 3}};
  if (slopes.size() > 0) results.push_back({slopes.mutable_data(), 9});
  for_contacts(motions, given, results, [&](py::ssize_t i, const Eigen::Vector3d& motion, const auto& at) {
    si::Wrench wrench;
    const char* const fault = friction.evaluate(motion, at[0], {at[1], at[2], at[3]}, wrench);
    Eigen::Map<Eigen::Vector3d>(results[0].first + 3 * i) = wrench.value;
    if (results.size() > 1)
      Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(results[1].first + 9 * i) = wrench.jacobian;
    return fault;
  });
}

/// Writes slip and spin of contacts after a time step to `motions_after`, and their mean friction to `values`.
/// @param given  loads, friction and radius of the patches, changes of slip and spin by units of impulse, time steps
void steps(const si::PatchFriction& friction, const Numbers& motions, const std::array<Numbers, 6>& given,
           py::array_t<double>& motions_after, py::array_t<double>& values) {
  const std::vector<Result> results{{motions_after.mutable_data(), 3}, {values.mutable_data(), 3}};
  for_contacts(motions, given, results, [&](py::ssize_t i, const Eigen::Vector3d& motion, const auto& at) {
    kernel::Step<double> after;
    const char* const fault = friction.step(motion, {at[3], at[4]}, at[0], {at[1], at[2], 0}, at[5], after);
    Eigen::Map<Eigen::Vector3d>(results[0].first + 3 * i) << after.vx, after.vy, after.w;
    Eigen::Map<Eigen::Vector3d>(results[1].first + 3 * i) << after.fx, after.fy, after.m;
    return fault;
  });
}

/// Reads a float or an int; returns false for another type and for an int beyond doubles.
bool read_number(PyObject* given, double& to) {
  static const PyObject* const of_numpy = py::object(py::dtype::of<double>().attr("type")).release().ptr();
  const bool known = PyFloat_CheckExact(given) || PyLong_CheckExact(given) ||
                     reinterpret_cast<const PyObject*>(Py_TYPE(given)) == of_numpy;
  if (!known) return false;
  to = PyFloat_AsDouble(given);
  if (PyErr_Occurred() == nullptr) return true;
  PyErr_Clear();
  return false;
}

/// Reads the size - 2 arguments of one contact: a motion in a tuple, a list or an array, then single numbers. Returns
/// nothing if they have other types. The functions for arrays compute these, and they report wrong numbers.
template <std::size_t size>
std::optional<Eigen::Array<double, size, 1>> one_contact(const py::args& given) {
  PyObject* const motion = given[0].ptr();
  const bool known = PyTuple_CheckExact(motion) || PyList_CheckExact(motion) ||
                     Py_TYPE(motion) == py::detail::npy_api::get().PyArray_Type_;
  if (!known || PySequence_Size(motion) != 3) return PyErr_Clear(), std::nullopt;
  const auto speeds = py::reinterpret_steal<py::object>(PySequence_Fast(motion, ""));
  Eigen::Array<double, size, 1> numbers;
  for (py::ssize_t i = 0; i < numbers.size(); ++i) {
    PyObject* const each = i < 3 ? PySequence_Fast_GET_ITEM(speeds.ptr(), i) : PyTuple_GET_ITEM(given.ptr(), i - 2);
    if (!read_number(each, numbers[i])) return std::nullopt;
  }
  return numbers;
}

py::array_t<double> array_of(const Eigen::Vector3d& vector) { return py::array_t<double>(3, vector.data()); }

/// Calls `work` for each of `count` rows on several threads.
/// @throws std::domain_error, std::runtime_error  with the number of the first row that fails; other exceptions
///                                                unchanged
template <class Work>
void for_rows(py::ssize_t count, unsigned threads, const Work& work) {
  std::atomic<py::ssize_t> next = 0;
  std::mutex guard;
  py::ssize_t failed = count;
  std::exception_ptr failure;
  const auto fails = [&](py::ssize_t row, std::exception_ptr with) {
    const std::scoped_lock lock(guard);
    if (row < failed) std::tie(failed, failure) = std::pair(row, std::move(with));
    next = count;
  };
  const auto run = [&](bool looks) {
    Interruption interruption;
    for (py::ssize_t row = next++; row < count; row = next++) {
      try {
        if (looks) interruption.check();
        work(row);
      } catch (const std::domain_error& error) {
        fails(row, std::make_exception_ptr(std::domain_error(fmt::format("row {}: {}", row, error.what()))));
      } catch (const std::runtime_error& error) {
        fails(row, dynamic_cast<const py::error_already_set*>(&error) != nullptr
                       ? std::current_exception()
                       : std::make_exception_ptr(std::runtime_error(fmt::format("row {}: {}", row, error.what()))));
      } catch (...) {
        fails(row, std::current_exception());
      }
    }
  };
  {
    const py::gil_scoped_release released;
    std::vector<std::thread> others;
    for (unsigned i = 1; i < threads; ++i) others.emplace_back(run, false);
    run(true);
    for (std::thread& other : others) other.join();
  }
  if (failure) std::rethrow_exception(failure);
}

/// Returns the start in a row: vx, vy, wx, wy, wz.
si::Velocities start_of(const double* row) { return {{row[0], row[1]}, {row[2], row[3], row[4]}}; }

constexpr py::ssize_t columns_of_start = 5;

/// Writes the numbers of the events of a motion, and its stop time.
void write_events(const si::Motion& motion, double rolling_below, double* row) {
  const si::Events events = motion.finite().events(rolling_below);
  for (const si::EventNumber& number : si::event_numbers()) *row++ = number.value(events);
  *row = motion.stop_time();
}

const auto columns_of_events = static_cast<py::ssize_t>(si::event_numbers().size()) + 1;

constexpr const char *uncertainty_field = "uncertainty", *correlation_field = "correlation";

/// Calls `take` for each name and number of a dict.
/// @param what  name of the dict, for a message
template <class Take>
void for_numbers(const py::handle& dict, const std::string& what, const Take& take) {
  if (!py::isinstance<py::dict>(dict))
    throw py::type_error(fmt::format("{}: a dict of numbers by their names is needed; got {}", what, words_of(dict)));
  for (const auto& [key, value] : py::reinterpret_borrow<py::dict>(dict)) {
    const auto name = py::str(key).cast<std::string>();
    if (name == correlation_field) continue;
    const auto of = si::find_component(name);
    if (!of) {
      throw std::domain_error(fmt::format("{}: {}", what, no_such("number", name, si::uncertain_names())));
    }
    take(*of, value, fmt::format("{} of {}", what, name));
  }
}

double number_in(const py::handle& value, const std::string& what) {
  try {
    return value.cast<double>();
  } catch (const py::cast_error&) {
    throw py::type_error(fmt::format("{}: a number is needed; got {}", what, words_of(value)));
  }
}

/// Returns a value as text in the form of a run file.
std::string line_in(const py::handle& value, const std::string& what) {
  if (!py::isinstance<py::str>(value))
    throw py::type_error(fmt::format("{}: text is needed; got {}", what, words_of(value)));
  const auto text = value.cast<std::string>();
  if (!std::ranges::any_of(text, [](unsigned char c) { return c < ' ' || c == 0x7f; })) return text;
  throw std::domain_error(
      fmt::format("{}: one line of text without control characters is needed; got {}", what, words_of(value)));
}

/// Reads the field uncertainty of a Ball, which has the form of the table of a run file.
void add_spreads(si::Description& described, const py::handle& field) {
  for_numbers(field, uncertainty_field, [&](const si::Component& of, const py::handle& value, const std::string& what) {
    described.add_spread(of, number_in(value, what), {"", what, ""});
  });
  const auto fields = py::reinterpret_borrow<py::dict>(field);
  if (!fields.contains(correlation_field)) return;
  for_numbers(fields[correlation_field], correlation_field,
              [&](const si::Component& one, const py::handle& row, const std::string& what) {
                for_numbers(row, what, [&](const si::Component& other, const py::handle& value, const std::string& of) {
                  described.correlate(one, other, number_in(value, of), {"", of, ""});
                });
              });
}

py::dict dict_of(const si::Spreads& spreads) {
  py::dict result, correlation;
  for (std::size_t i = 0; i < spreads.numbers.size(); ++i) {
    const py::str name(spreads.numbers[i].of.name());
    result[name] = spreads.numbers[i].standard;
    py::dict row;
    for (std::size_t j = 0; j < i; ++j) {
      const double both = spreads.correlation(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      if (both != 0) row[py::str(spreads.numbers[j].of.name())] = both;
    }
    if (!row.empty()) correlation[name] = row;
  }
  if (!correlation.empty()) result[correlation_field] = correlation;
  return result;
}

/// Returns the description of a ball from the fields of Python's Ball; fields that are None are left out.
si::Description described_by(const py::dict& fields) {
  si::Description described;
  for (const auto& [key, value] : fields) {
    const auto name = key.cast<std::string>();
    const auto quantity = std::ranges::find(si::quantities(), name, &si::Quantity::name);
    if (quantity == si::quantities().end() || value.is_none()) continue;
    std::vector<double> numbers;
    try {
      numbers = (*quantity)->count() == 1 ? std::vector{value.cast<double>()} : value.cast<std::vector<double>>();
    } catch (const py::cast_error&) {
      const std::size_t count = (*quantity)->count();
      throw py::type_error(fmt::format(
          "{}: {} needed, {}{}{}; got {}", name, count == 1 ? "a number is" : fmt::format("{} numbers are", count),
          (*quantity)->meaning, (*quantity)->unit.empty() ? "" : ", in ", (*quantity)->unit, words_of(value)));
    }
    described.set(**quantity, std::move(numbers), {"", name, ""});
  }
  if (fields.contains("name")) described.set_name(line_in(fields["name"], "name"));
  if (fields.contains("body")) described.set_body(line_in(fields["body"], "body"), {"", "body", ""});
  if (fields.contains(uncertainty_field) && !fields[uncertainty_field].is_none())
    add_spreads(described, fields[uncertainty_field]);
  return described;
}

si::Description at_rest() {
  si::Description still;
  for (const si::Quantity* quantity : {&si::slip, &si::spin})
    still.set(*quantity, {0}, {"", std::string(quantity->name), ""});
  return still;
}

}  // namespace

py::dict fields_of(const si::Description& described) {
  py::dict fields;
  if (!described.name().empty()) fields["name"] = described.name();
  if (described.body()) fields["body"] = py::str(std::string(described.body()->name));
  for (const si::Quantity* quantity : si::quantities()) {
    const auto* given = described.find(*quantity);
    if (given == nullptr) continue;
    const py::str name{std::string(quantity->name)};
    fields[name] = given->numbers.size() == 1 ? py::object(py::float_(given->numbers[0]))
                                              : py::object(py::tuple(py::cast(given->numbers)));
  }
  if (!described.spreads().empty()) fields[uncertainty_field] = dict_of(described.spreads());
  return fields;
}

namespace {

/// Returns all fields of Python's Ball, including default values.
py::dict fields_of_ball(const si::Description& described) {
  py::dict fields = fields_of(described);
  fields["law"] = si::law_of(si::experiment_of(described));
  return fields;
}

}  // namespace

void bind_si(py::module_& module) {
  PYBIND11_NUMPY_DTYPE(Instant, t, x, y, vx, vy, wx, wy, wz, slip, energy);

  py::class_<si::LoadHistory>(module, "LoadHistory")
      .def(py::init<std::vector<double>, std::vector<double>>())
      .def_property_readonly("nominal", &si::LoadHistory::nominal);

  py::class_<si::Experiment>(module, "Experiment")
      .def(py::init([](const py::dict& fields) { return si::experiment_of(at_rest().under(described_by(fields))); }))
      .def("struck",
           [](si::Experiment experiment, double speed, Pair tip, double elevation, double cue_mass) {
             experiment.start = si::struck(
                 experiment.ball,
                 {.speed = speed, .right = tip[0], .above = tip[1], .elevation = elevation, .mass = cue_mass});
             si::require_experiment(experiment);
             return experiment;
           })
      .def(
          "flow",
          [](const si::Experiment& experiment, const Law& law) { return Flow(si::reduced_system(experiment, law)); },
          Released())
      .def("patch_and_body",
           [](const si::Experiment& experiment, const Law& law) {
             const reduction::ReducedSystem system = si::undriven_system(experiment, law);
             return std::pair(system.mu(), std::pair(system.inertia().chi, system.inertia().gamma));
           })
      .def_property_readonly("gravity", [](const si::Experiment& experiment) { return experiment.environment.gravity; })
      .def_property_readonly("law", [](const si::Experiment& experiment) { return si::law_of(experiment); })
      .def_property_readonly("slip", &si::slip_at_start)
      .def_property_readonly("spin", &si::spin_at_start)
      .def_property_readonly("start", [](const si::Experiment& experiment) {
        const auto [velocity, w] = si::velocities_of(experiment.start);
        return py::make_tuple(py::make_tuple(velocity.x(), velocity.y()), py::make_tuple(w.x(), w.y(), w.z()));
      });

  py::class_<si::Motion>(module, "Motion")
      .def_static(
          "reduced",
          [](const si::Experiment& experiment, const Flow& flow, const std::optional<si::LoadHistory>& load) {
            return si::Motion::reduced(experiment, flow, load).finite();
          },
          Released())
      .def_static(
          "uncoupled",
          [](const si::Experiment& experiment, const Law& law, const std::optional<si::LoadHistory>& load,
             double rolling_below) { return si::Motion::uncoupled(experiment, law, rolling_below, load).finite(); },
          Released())
      .def_property_readonly("stop_time", &si::Motion::stop_time)
      .def("at",
           [](const si::Motion& motion, const Numbers& times) {
             return mapped<Instant>(times, [&](double t) { return instant_of(motion.at(t)); });
           })
      .def("events", [](const si::Motion& motion, double rolling_below) {
        py::array_t<double> row(columns_of_events);
        write_events(motion, rolling_below, row.mutable_data());
        return row;
      });

  py::class_<si::Shots>(module, "Shots")
      .def(py::init<const si::Experiment&, const Law&>(), Released())
      .def("events",
           [](const si::Shots& shots, const Numbers& starts, double rolling_below, py::array_t<double>& out,
              unsigned threads) {
             const double* const from = starts.data();
             double* const to = out.mutable_data();
             for_rows(starts.size() / columns_of_start, threads, [&](py::ssize_t row) {
               write_events(shots.from(start_of(from + row * columns_of_start)), rolling_below,
                            to + row * columns_of_events);
             });
           })
      .def("at", [](const si::Shots& shots, const Numbers& starts, const Numbers& times, unsigned threads) {
        const py::ssize_t rows = starts.size() / columns_of_start, columns = times.size();
        py::array_t<Instant> result({rows, columns});
        const double *const from = starts.data(), *const at = times.data();
        Instant* const to = result.mutable_data();
        for_rows(rows, threads, [&](py::ssize_t row) {
          const si::Motion motion = shots.from(start_of(from + row * columns_of_start)).finite();
          for (py::ssize_t i = 0; i < columns; ++i) to[row * columns + i] = instant_of(motion.at(at[i]));
        });
        return result;
      });
  module.attr("event_numbers") = list_of(
      si::event_numbers(), [](const si::EventNumber& number) { return py::make_tuple(number.event, number.of); });
  module.def("struck_starts", [](const si::Experiment& experiment, const Numbers& strikes) {
    constexpr py::ssize_t columns = 5;  // columns: speed, right, above, degrees, mass
    const py::ssize_t rows = strikes.size() / columns;
    py::array_t<double> result({rows, columns_of_start});
    const double* from = strikes.data();
    double* to = result.mutable_data();
    for_rows(rows, 1, [&](py::ssize_t row) {
      const double* const each = from + row * columns;
      const auto [velocity, w] =
          si::struck(experiment.ball,
                     {.speed = each[0], .right = each[1], .above = each[2], .elevation = each[3], .mass = each[4]});
      const std::array start{velocity.x(), velocity.y(), w.x(), w.y(), w.z()};
      std::ranges::copy(start, to + row * columns_of_start);
    });
    return result;
  });

  module.def("ball", [](const std::string& name) {
    const auto entry = entry_of("ball", si::catalogue(), &si::CatalogueEntry::name, name);
    return fields_of_ball(si::describe(entry.experiment));
  });
  module.attr("balls") = list_of(si::catalogue(), &si::CatalogueEntry::name);
  module.def("run_file", [](si::Experiment experiment, const std::string& law) {
    experiment.contact.law = law;
    return si::run_file(experiment);
  });
  module.def("parse_run_file", [](const std::string& text, const std::string& source) {
    return fields_of_ball(si::parse_run_file(text, source, answers::find_law_or_formulas));
  });
  module.def("changed", [](const py::dict& fields, const py::dict& changes) {
    return fields_of(described_by(fields).under(described_by(changes)));
  });
  module.attr("quantities") = list_of(si::quantities(), &si::Quantity::name);
  py::class_<si::PatchFriction>(module, "PatchFriction")
      .def(py::init<const Law&>())
      .def("wrenches", &wrenches)
      .def("steps", &steps)
      .def("wrench",
           [](const si::PatchFriction& friction, bool slopes, const py::args& given) -> py::object {
             const auto at = one_contact<7>(given);
             si::Wrench found;
             if (!at || friction.evaluate(at->head<3>(), (*at)[3], {(*at)[4], (*at)[5], (*at)[6]}, found) != nullptr)
               return py::none();
             if (!slopes) return array_of(found.value);
             const Eigen::Matrix3d rows = found.jacobian.transpose();
             return py::make_tuple(array_of(found.value), py::array_t<double>({3, 3}, rows.data()));
           })
      .def("step", [](const si::PatchFriction& friction, const py::args& given) -> py::object {
        const auto at = one_contact<9>(given);
        kernel::Step<double> after;
        if (!at || friction.step(at->head<3>(), {(*at)[6], (*at)[7]}, (*at)[3], {(*at)[4], (*at)[5], 0}, (*at)[8],
                                 after) != nullptr)
          return py::none();
        return py::make_tuple(array_of({after.vx, after.vy, after.w}), array_of({after.fx, after.fy, after.m}));
      });
  module.def(
      "engines",
      [](const si::Experiment& experiment, const Law& law, const std::optional<std::string>& name) {
        std::vector<std::pair<std::string, const si::Engine*>> engines;
        for (const si::Engine& engine : si::engines()) engines.emplace_back(engine.name, &engine);
        for (const si::EngineAlias& alias : si::engine_aliases())
          engines.emplace_back(alias.name, si::find_engine(alias.name));
        si::require_undriven(experiment, "engine");
        const si::Engine* const only = name ? one_of("engine", engines, *name) : nullptr;
        return portraits::json_document(answers::engine_answer(experiment, law, only).members);
      },
      Released());
  module.def(
      "aim",
      [](const si::Experiment& experiment, const Law& law, std::optional<double> distance, std::optional<double> turns,
         std::optional<double> time) {
        return portraits::json_document(answers::aim_answer(experiment, law, si::Goal{distance, turns, time}).members);
      },
      Released());
  module.def(
      "aim_to_roll",
      [](const si::Experiment& experiment, const Law& law, double place, double speed, double spin) {
        return portraits::json_document(
            answers::aim_answer(experiment, law, si::RollingGoal{place, speed, spin}).members);
      },
      Released());
  module.def(
      "roll_uncertainty",
      [](const si::Experiment& experiment, const Law& law, double rolling_below, const std::string& spreads) {
        Interruption interruption;
        return portraits::json_document(answers::members_of(
            answers::roll_uncertainty(experiment, law, rolling_below, spreads, [&] { interruption.look(); })));
      },
      Released());
  module.def(
      "roll_gradient",
      [](const si::Experiment& experiment, const Law& law, double rolling_below) {
        const si::EventNumbers numbers(experiment, law, rolling_below);
        return portraits::json_document(answers::members_of(si::event_gradient(numbers)));
      },
      Released());
  module.attr("rolling_slip") = si::rolling_slip;
  module.attr("standard_cue_mass") = si::standard_cue_mass;
}

}  // namespace contensou::python
