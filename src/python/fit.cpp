// contensou::fit in Python, for one film.
#include "contensou/fit/fit.hpp"

#include <memory>
#include <utility>

#include "values.hpp"

namespace contensou::python {

namespace {

/// A law whose call a signal such as Ctrl-C can end. A search in one thread calls the law again and again.
class InterruptibleLaw {
 public:
  explicit InterruptibleLaw(std::shared_ptr<const reduction::Law> law) : law_(std::move(law)) {}

  const std::string& name() const { return law_->name(); }
  const std::vector<double>& kinks() const { return law_->kinks(); }
  reduction::Resistance operator()(reduction::Slip slip) const {
    interruption_->check();
    return (*law_)(slip);
  }

 private:
  std::shared_ptr<const reduction::Law> law_;
  std::shared_ptr<Interruption> interruption_ = std::make_shared<Interruption>();
};

py::dict found_of(const fit::Fit& found) {
  py::dict estimates, noise, result;
  for (const fit::Estimate& estimate : found.estimates) {
    estimates[py::str(std::string(fit::kind_of(estimate.parameter).name))] =
        py::make_tuple(estimate.value, estimate.standard_error, estimate.interval.low, estimate.interval.high);
  }
  for (const fit::Noise& each : found.noise) noise[py::str(std::string(fit::kind_of(each.observable).name))] = each.sd;
  py::array_t<double> matrix({found.correlation.rows(), found.correlation.cols()});
  for (Eigen::Index i = 0; i < found.correlation.rows(); ++i) {
    for (Eigen::Index j = 0; j < found.correlation.cols(); ++j) matrix.mutable_at(i, j) = found.correlation(i, j);
  }
  result["ball"] = fields_of(si::describe(found.ball));
  result["estimates"] = estimates;
  result["names"] = list_of(found.free_estimates(),
                            [](const fit::Estimate* estimate) { return fit::kind_of(estimate->parameter).name; });
  result["correlation_matrix"] = matrix;
  result["correlation"] = found.correlation_of_contact();
  result["noise"] = noise;
  result["reduced_chi2"] = found.reduced_chi2();
  result["aic"] = found.aic;
  result["profiled"] = found.profiled;
  result["predicted"] = list_of(found.predicted.front(), [](const Eigen::ArrayXd& values) {
    return py::array_t<double>(values.size(), values.data());
  });
  result["misfits"] = found.misfits;
  result["other_spins"] = found.other_spins(0);
  if (const auto& seen = found.rolling_friction_seen) {
    result["rolling_friction_seen"] =
        py::make_tuple(seen->value, seen->standard_error, seen->friction, seen->chi2_less);
  } else {
    result["rolling_friction_seen"] = py::none();
  }
  if (const auto& widened = found.widened) {
    result["widened"] = py::make_tuple(widened->friction_varies, widened->least, widened->most);
  } else {
    result["widened"] = py::none();
  }
  if (const auto& only = found.only) {
    result["only"] = py::make_tuple(only->name(), only->value, only->value * only->relative_error, only->interval.low,
                                    only->interval.high);
  } else {
    result["only"] = py::none();
  }
  return result;
}

}  // namespace

void bind_fit(py::module_& module) {
  module.def("fit", [](const si::Experiment& ball, const reduction::Law& law, const Numbers& t,
                       const std::vector<std::tuple<std::string, Numbers, Numbers>>& series,
                       const std::optional<std::vector<std::string>>& free, bool robust, bool planned) {
    fit::Track track;
    track.name = "t";
    track.t = column_of(t);
    track.start = track.t.size() > 0 ? track.t[0] : 0;
    for (const auto& [name, values, sd] : series) {
      const auto kind = entry_of("observable", fit::observable_kinds(), &fit::ObservableKind::name, name);
      track.series.push_back({kind.observable, column_of(values), column_of(sd)});
    }
    fit::FitRequest request{.ball = ball,
                            .law = InterruptibleLaw(std::make_shared<const reduction::Law>(law)),
                            .tracks = {track},
                            .free = free ? fit::Free{false, false, false, false, false} : fit::usually_free(ball)};
    const std::vector<std::pair<std::string, bool fit::Free::*>> parameters{
        {"friction", &fit::Free::friction},
        {"patch_radius", &fit::Free::patch_radius},
        {"rolling_friction", &fit::Free::rolling_friction},
        {"slip", &fit::Free::slip},
        {"spin", &fit::Free::spin}};
    for (const std::string& name : free.value_or(std::vector<std::string>()))
      request.free.*one_of("parameter", parameters, name) = true;
    request.robust = robust;
    const fit::Fit found = [&] {
      const py::gil_scoped_release released;
      return planned ? fit::plan(request) : fit::fit(request);
    }();
    return found_of(found);
  });
}

}  // namespace contensou::python
