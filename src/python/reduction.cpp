// contensou::reduction in Python: laws, flows, orbits, checks.
#include <cstddef>
#include <limits>
#include <memory>
#include <tuple>
#include <variant>

#include "answers/asked/formula_law.hpp"
#include "contensou/reduction/detail/stop_times_of_mu.hpp"
#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/laws.hpp"
#include "contensou/reduction/phase_plane.hpp"
#include "contensou/reduction/tabulated_pressure_law.hpp"
#include "contensou/reduction/verification.hpp"
#include "contensou/si/experiment.hpp"
#include "values.hpp"

namespace contensou::python {

namespace {

using reduction::Flow;
using reduction::Law;
using reduction::Orbit;
using reduction::OrbitPoint;
using reduction::Resistance;
using reduction::Slip;

/// A law that is a function of Python.
class FunctionLaw {
 public:
  FunctionLaw(py::function function, std::string name, std::vector<double> kinks)
      : function_(new py::function(std::move(function)),
                  [](py::function* last) {
                    const py::gil_scoped_acquire acquired;
                    delete last;
                  }),
        name_(std::move(name)),
        kinks_(std::move(kinks)) {}

  const std::string& name() const { return name_; }
  const std::vector<double>& kinks() const { return kinks_; }

  /// @throws py::error_already_set  the exception of the function, with its type and traceback
  Resistance operator()(Slip slip) const {
    const py::gil_scoped_acquire acquired;
    const py::object answer = (*function_)(slip.sliding, slip.pivoting);
    try {
      const auto [force, moment] = answer.cast<std::pair<double, double>>();
      return {force, moment};
    } catch (const py::cast_error&) {
      throw py::type_error(fmt::format("law {}: a pair of numbers (force, moment) is needed, got {}", name_,
                                       py::repr(answer).cast<std::string>()));
    }
  }

 private:
  std::shared_ptr<py::function> function_;  ///< the last copy may end in any thread, so the deleter takes Python's lock
  std::string name_;
  std::vector<double> kinks_;
};

Law law_of_name(const std::string& name) {
  if (auto law = answers::find_law_or_formulas(name)) return *law;
  std::vector<std::string> families;
  for (const auto& family : reduction::law_families()) families.push_back(family.form());
  return entry_of("law", reduction::named_laws(), &Law::name, name, families);
}

si::Body body_of(const std::variant<std::string, std::pair<double, double>>& given) {
  if (const auto* ratios = std::get_if<1>(&given)) {
    return {"", {.chi = ratios->first, .gamma = ratios->second}, std::nullopt, false};
  }
  return entry_of("body", si::bodies(), &si::Body::name, std::get<0>(given), {"(chi, gamma)"});
}

reduction::ReducedSystem system_of(const std::optional<Law>& law, std::optional<double> mu,
                                   const std::variant<std::string, std::pair<double, double>>& given, double drive) {
  const si::Body body = body_of(given);
  if (!mu) mu = body.patch_ratio;
  if (!mu) throw std::domain_error("mu is missing: the radius of the contact patch over that of the body");
  if (const std::string complaint = body.complaint(*mu); !complaint.empty()) {
    throw std::domain_error(fmt::format("mu = {}: {}", *mu, complaint));
  }
  return {law ? *law : law_of_name(std::string(body.law)), *mu, body.inertia, drive};
}

/// Writes the stop times to `out`, a contiguous array with one entry for each start; NaN for an invalid start.
void stop_times(const Flow& flow, const Numbers& u, const Numbers& v, py::array_t<double>& out, unsigned threads) {
  const auto count = static_cast<std::size_t>(out.size());
  const double* const us = u.data();
  const double* const vs = v.data();
  double* const taus = out.mutable_data();
  const py::gil_scoped_release released;
  Interruption interruption;
  constexpr std::size_t most = 1'000'000;  // starts between two looks for signals
  for (std::size_t i = 0; i < count; i += most) {
    const std::size_t part = std::min(most, count - i);
    flow.stop_times({us + i, part}, {vs + i, part}, {taus + i, part}, threads);
    interruption.look();
  }
}

/// Returns rows of tau and of its derivatives by u, v, mu, chi, gamma and drive. An invalid start gives NaN in all
/// rows, a start at rest NaN in the derivatives.
/// @param gradient  computes a start's tau and derivatives from the index of the start and the start
template <class Gradient>
py::array_t<double> stop_time_gradients(const Numbers& u, const Numbers& v, Gradient gradient) {
  const py::ssize_t count = u.size();
  py::array_t<double> result({py::ssize_t{7}, count});
  double* const out = result.mutable_data();
  const double* const us = u.data();
  const double* const vs = v.data();
  const py::gil_scoped_release released;
  Interruption interruption;
  for (py::ssize_t i = 0; i < count; ++i) {
    interruption.check();
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    const reduction::State start{us[i], vs[i]};
    const bool at_rest = start.u == 0 && start.v == 0;
    const auto found = is_state(start) && !at_rest
                           ? gradient(i, start)
                           : reduction::StopTimeGradient{at_rest ? 0 : none, none, none, none, none, none, none};
    const double row[]{found.tau, found.by_u, found.by_v, found.by_mu, found.by_chi, found.by_gamma, found.by_drive};
    for (py::ssize_t j = 0; j < 7; ++j) out[j * count + i] = row[j];
  }
  return result;
}

/// Computes stop times like stop_times, but each start has its own mu.
void stop_times_of_mus(const reduction::StopTimesOfMu& stop_time, const Numbers& u, const Numbers& v, const Numbers& mu,
                       py::array_t<double>& out) {
  const auto count = static_cast<std::size_t>(out.size());
  const double* const mus = mu.data();
  const double* const us = u.data();
  const double* const vs = v.data();
  double* const taus = out.mutable_data();
  const py::gil_scoped_release released;
  Interruption interruption;
  for (std::size_t i = 0; i < count; ++i) {
    interruption.check();
    const reduction::State start{us[i], vs[i]};
    taus[i] = is_state(start) ? stop_time(mus[i], start) : std::numeric_limits<double>::quiet_NaN();
  }
}

py::tuple terminal(const Flow& flow) {
  const reduction::TerminalRatios& ratios = flow.terminal();
  static constexpr const char* regimes[] = {"zero", "ray", "infinity"};
  return py::make_tuple(
      flow.system().r(), ratios.low, ratios.high,
      list_of(ratios.rays,
              [](const reduction::InvariantRay& ray) { return py::make_tuple(ray.k, ray.attracts(), ray.accuracy); }),
      list_of(ratios.ends, [](const reduction::TerminalRatio& end) {
        return py::make_tuple(regimes[static_cast<int>(end.regime)], end.k, end.from, end.to);
      }));
}

py::list facts(const Flow& flow) {
  return list_of(reduction::phase_plane(flow).points, [](const reduction::SingularPoint& point) {
    return py::make_tuple(name(point.direction), name(point.place), point.k, point.q, point.radial, point.angular,
                          point.kind);
  });
}

}  // namespace

void bind_reduction(py::module_& module) {
  PYBIND11_NUMPY_DTYPE(OrbitPoint, tau, u, v, ln_v, k, beta);

  py::class_<Law>(module, "Law")
      .def(py::init(&law_of_name))
      .def(py::init(&answers::parse_formula_law))
      .def(py::init([](py::function function, std::string name, std::vector<double> kinks) {
        return Law(FunctionLaw(std::move(function), std::move(name), std::move(kinks)));
      }))
      .def(py::init([](std::string name, const Numbers& rho, const Numbers& pressure) {
        return Law(reduction::TabulatedPressureLaw(std::move(name), column_of(rho), column_of(pressure)));
      }))
      .def_property_readonly("name", &Law::name)
      .def_property_readonly("pivoting_moment", &Law::pivoting_moment)
      .def_property_readonly("force_slope", &Law::force_slope)
      .def("force",
           [](const Law& law, const Numbers& k) {
             return mapped<double>(k, [&](double ratio) { return law(reduction::slip_of_ratio(ratio)).force; });
           })
      .def("moment", [](const Law& law, const Numbers& k) {
        return mapped<double>(k, [&](double ratio) { return law(reduction::slip_of_ratio(ratio)).moment; });
      });

  py::class_<reduction::StopTimesOfMu>(module, "StopTimesOfMu")
      .def(py::init([](const std::optional<Law>& law, const std::variant<std::string, std::pair<double, double>>& body,
                       double drive) {
             const reduction::ReducedSystem system = system_of(law, 1, body, drive);
             return reduction::StopTimesOfMu(system.law(), system.inertia(), drive);
           }),
           Released())
      .def_static("require",
                  [](std::optional<double> mu, const std::variant<std::string, std::pair<double, double>>& body) {
                    system_of({}, mu, body, 0);
                  })
      .def("stop_times", &stop_times_of_mus)
      .def("stop_time_gradients",
           [](const reduction::StopTimesOfMu& stop_time, const Numbers& u, const Numbers& v, const Numbers& mu) {
             return stop_time_gradients(u, v, [&, mus = mu.data()](py::ssize_t i, reduction::State start) {
               return stop_time.gradient(mus[i], start);
             });
           });

  py::class_<Flow>(module, "Flow")
      .def(py::init([](const std::optional<Law>& law, std::optional<double> mu,
                       const std::variant<std::string, std::pair<double, double>>& body,
                       double drive) { return Flow(system_of(law, mu, body, drive)); }),
           Released())
      .def_property_readonly("law", [](const Flow& flow) { return flow.system().law(); })
      .def_property_readonly("mu", [](const Flow& flow) { return flow.system().mu(); })
      .def_property_readonly("drive", [](const Flow& flow) { return flow.system().drive(); })
      .def(
          "stop_time",
          [](const Flow& flow, double u, double v) {
            return flow.stop_time({u, v}).tau;
          },
          Released())
      .def("stop_times", &stop_times)
      .def("stop_time_gradients",
           [](const Flow& flow, const Numbers& u, const Numbers& v) {
             return stop_time_gradients(
                 u, v, [&](py::ssize_t, reduction::State start) { return flow.stop_time_gradient(start); });
           })
      .def(
          "orbit",
          [](const Flow& flow, double u, double v) {
            return flow.orbit({u, v});
          },
          Released())
      .def("instant_gradients",
           [](const Flow& flow, double u, double v, const Numbers& tau) {
             const py::ssize_t count = tau.size();
             py::array_t<double> result({py::ssize_t{4}, py::ssize_t{4}, count});
             double* const out = result.mutable_data();
             for (py::ssize_t i = 0; i < count; ++i) {
               const reduction::InstantGradient all = instant_gradient(flow, {u, v}, tau.data()[i]);
               double* to = out + i;
               for (const auto& [value, by_u, by_v, by_tau] : {all.u, all.v, all.slip_length, all.turned}) {
                 for (double each : {value, by_u, by_v, by_tau}) {
                   *to = each;
                   to += count;
                 }
               }
             }
             return result;
           })
      .def("at_beta",
           [](const Flow& flow, double u, double v, const Numbers& betas) {
             return mapped<OrbitPoint>(betas, [&](double beta) { return reduction::at_beta(flow, {u, v}, beta); });
           })
      .def("terminal", &terminal)
      .def("facts", &facts)
      .def(
          "check",
          [](const Flow& flow, double u, double v) {
            std::vector<std::tuple<std::string, double, double, bool>> rows;
            for (const reduction::Check& check : reduction::verify(flow, reduction::State{u, v})) {
              rows.emplace_back(check.name, check.measured, check.allowed, check.passed());
            }
            return rows;
          },
          Released());

  py::class_<Orbit>(module, "Orbit")
      .def_property_readonly("stop_time", &Orbit::stop_time)
      .def_property_readonly("accuracy", &Orbit::accuracy)
      .def("at",
           [](const Orbit& orbit, const Numbers& tau) {
             return mapped<OrbitPoint>(tau, [&](double time) { return orbit.at_time(time); });
           })
      .def("at_left",
           [](const Orbit& orbit, const Numbers& left) {
             return mapped<OrbitPoint>(left, [&](double time) { return orbit.at_time_left(time); });
           })
      .def("slip_length", [](const Orbit& orbit, const Numbers& tau) {
        return mapped<double>(tau, [&](double time) { return orbit.slip_length(time); });
      });
}

}  // namespace contensou::python
