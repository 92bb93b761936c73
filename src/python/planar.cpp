// The symmetries of any planar field, and its motions.
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <pybind11/complex.h>
#include <pybind11/eigen.h>

#include "answers/asked/planar_system.hpp"
#include "answers/verbs/plane_answers.hpp"
#include "contensou/reduction/detail/infinity.hpp"
#include "contensou/reduction/flow.hpp"
#include "planar.hpp"

namespace contensou::python {

namespace {

using Eigen::Vector2d;
using reduction::PlanarEnd;
using reduction::PlanarField;
using reduction::PlanarOrbit;
using reduction::PlanarReduction;

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

PlanarField field_of(py::function function) {
  return [function = std::make_shared<py::function>(std::move(function))](const Vector2d& x) {
    try {
      const auto [u, v] = (*function)(x[0], x[1]).cast<std::pair<double, double>>();
      return Vector2d(u, v);
    } catch (const py::cast_error&) {
      throw Interrupted{[] {
        PyErr_SetString(PyExc_TypeError, "reduce: the field must return a pair of numbers (u', v')");
        return py::error_already_set();
      }()};
    } catch (py::error_already_set& error) {
      if (error.matches(PyExc_Exception)) throw;
      throw Interrupted{error};
    }
  };
}

double stop_time_of(const PlanarOrbit& orbit) {
  if (orbit.end() == PlanarEnd::border || orbit.end() == PlanarEnd::undecided) return nothing;
  return orbit.end() == PlanarEnd::centre ? orbit.end_time() : infinity;
}

/// Returns the value of a function at each of the points; NaN at points where the function throws an error.
template <class Function>
py::array_t<double> at_points(const Numbers& u, const Numbers& v, Function function) {
  auto result = array_like<double>(u);
  for (py::ssize_t i = 0; i < u.size(); ++i) {
    try {
      result.mutable_data()[i] = interruptible([&] { return function(Vector2d(u.data()[i], v.data()[i])); });
    } catch (const std::domain_error&) {
      result.mutable_data()[i] = nothing;
    }
  }
  return result;
}

}  // namespace

void bind_planar(py::module_& module) {
  py::class_<Planar>(module, "Planar")
      .def_static("of_function",
                  [](py::function function, double u, double v) {
                    return Planar({field_of(std::move(function))}, {u, v});
                  })
      .def_static("of_text",
                  [](const std::string& text, const std::map<std::string, double>& parameters, double u, double v) {
                    const answers::FormulaField field = answers::parse_planar_system(text, parameters);
                    reduction::SmoothField typed = with_signals(field, std::make_shared<Interruption>());
                    typed.polynomials = field.polynomials();
                    Planar planar(std::move(typed), {u, v});
                    planar.variables = {field.variables.at(0), field.variables.at(1)};
                    planar.parameters = parameters;
                    planar.answer = [=, smooth = planar.field] {
                      return answers::reduce_answer(field, smooth, text, Vector2d(u, v), false);
                    };
                    return planar;
                  })
      .def("answer",
           [](const Planar& planar) {
             const answers::Answer answer = interruptible([&] { return planar.answer(); });
             constexpr answers::Digits digits{6};
             return std::pair(answer.text(digits), answer.members.dump());
           })
      .def_static("of_flow",
                  [](const reduction::Flow& flow) {
                    return Planar({reduction::planar_field(flow.system())}, {1, flow.system().mu()}, reduced(flow));
                  })
      .def_property_readonly("generators",
                             [](const Planar& planar) {
                               return list_of(planar.symmetries.generators, [](const reduction::Generator& x) {
                                 return py::make_tuple(x.time, x.matrix, x.shift, x.everywhere);
                               });
                             })
      .def_property_readonly("verdict",
                             [](const Planar& planar) {
                               constexpr const char* verdicts[] = {"found", "none", "undecided"};
                               return verdicts[static_cast<int>(planar.symmetries.verdict)];
                             })
      .def_property_readonly("singular_values", [](const Planar& planar) { return planar.symmetries.singular_values; })
      .def_property_readonly("level", [](const Planar& planar) { return planar.symmetries.level; })
      .def_property_readonly("gap", [](const Planar& planar) { return planar.symmetries.gap; })
      .def_property_readonly("form",
                             [](const Planar& planar) -> std::optional<std::string> {
                               if (!planar.plane.solved()) return std::nullopt;
                               return std::string(planar.plane.form());
                             })
      .def_property_readonly("tried",
                             [](const Planar& planar) {
                               return list_of(planar.plane.tried(), [](const reduction::TriedForm& tried) {
                                 const auto& [form, value, gap, residual, cleared] = tried;
                                 return py::make_tuple(form, value, gap, residual, cleared);
                               });
                             })
      .def("factor",
           [](const Planar& planar, const Numbers& u, const Numbers& v) {
             const PlanarReduction& plane = planar.solved();
             return at_points(u, v, [&](const Vector2d& x) { return plane.factor(x); });
           })
      .def_property_readonly("equilibria",
                             [](const Planar& planar) {
                               return list_of(planar.equilibria().points, [](const reduction::Equilibrium& each) {
                                 return py::make_tuple(each.x[0], each.x[1], each.kind, each.eigenvalues, each.index);
                               });
                             })
      .def_property_readonly("equilibria_within",
                             [](const Planar& planar) {
                               const auto &low = planar.equilibria().low, &high = planar.equilibria().high;
                               return std::pair(std::pair(low[0], high[0]), std::pair(low[1], high[1]));
                             })
      .def_property_readonly("equilibria_complete", [](const Planar& planar) { return planar.equilibria().complete; })
      .def_property_readonly(
          "reversors",
          [](const Planar& planar) { return list_of(planar.equilibria().reversors, &reduction::Reversor::name); })
      .def_property_readonly("solved", [](const Planar& planar) { return planar.plane.solved(); })
      .def_property_readonly("kind",
                             [](const Planar& planar) -> std::optional<std::string> {
                               const std::string_view kind = planar.solved().kind();
                               if (kind.empty()) return std::nullopt;
                               return std::string(kind);
                             })
      .def_property_readonly("rays",
                             [](const Planar& planar) {
                               return list_of(planar.solved().rays(), [](const reduction::PlanarRay& ray) {
                                 return py::make_tuple(ray.q, ray.attracts, ray.to_centre, ray.radial, ray.angular);
                               });
                             })
      .def_property_readonly("turn",
                             [](const Planar& planar) -> std::optional<std::pair<double, double>> {
                               const auto* turn = planar.solved().turn();
                               if (turn == nullptr) return std::nullopt;
                               return std::pair(turn->factor, turn->sigma);
                             })
      .def("canonical",
           [](const Planar& planar, const Numbers& u, const Numbers& v) {
             const PlanarReduction& plane = planar.solved();
             return py::make_tuple(at_points(u, v, [&](const Vector2d& x) { return plane.canonical(x).q; }),
                                   at_points(u, v, [&](const Vector2d& x) { return plane.canonical(x).p; }));
           })
      .def("first_integral",
           [](const Planar& planar, const Numbers& u, const Numbers& v) {
             const PlanarReduction& plane = planar.solved();
             return at_points(u, v, [&](const Vector2d& x) { return plane.first_integral(x); });
           })
      .def("stop_time",
           [](const Planar& planar, const Numbers& u, const Numbers& v) {
             const PlanarReduction& plane = planar.solved();
             return at_points(u, v, [&](const Vector2d& x) { return stop_time_of(plane.orbit(x)); });
           })
      .def("orbit", [](const Planar& planar, double u, double v) {
        return interruptible([&] { return planar.plane.orbit({u, v}); });
      });

  py::class_<PlanarOrbit>(module, "PlanarOrbit")
      .def_property_readonly("end",
                             [](const PlanarOrbit& orbit) -> std::optional<std::string> {
                               if (orbit.end() == PlanarEnd::undecided) return std::nullopt;
                               return std::string(name(orbit.end()));
                             })
      .def_property_readonly("end_time", &PlanarOrbit::end_time)
      .def_property_readonly("stop_time", &stop_time_of)
      .def_property_readonly("period", &PlanarOrbit::period)
      .def("at", [](const PlanarOrbit& orbit, const Numbers& times) {
        auto us = array_like<double>(times), vs = array_like<double>(times);
        for (py::ssize_t i = 0; i < times.size(); ++i) {
          const double time = times.data()[i];
          Vector2d x(nothing, nothing);
          try {
            x = interruptible([&] { return orbit.at(time); });
          } catch (const std::domain_error&) {
            if (!(time >= 0)) throw;  // a later time gives NaN: the orbit has ended
          }
          us.mutable_data()[i] = x[0];
          vs.mutable_data()[i] = x[1];
        }
        return py::make_tuple(us, vs);
      });
}

}  // namespace contensou::python
