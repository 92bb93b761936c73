#include "certificate_report.hpp"

#include <fmt/format.h>

#include "contensou/reduction/stop_time.hpp"
#include "csv_table.hpp"
#include "exit_status.hpp"
#include "json.hpp"
#ifdef CONTENSOU_WITH_ARB
#include "contensou/reduction/certificate.hpp"
#endif

namespace contensou::program {

CertificateReport make_certificate_report(const reduction::ReducedSystem& system, reduction::State start) {
  if (!system.law().closed_stop_time()) {
    throw BadInput(
        fmt::format("--certify encloses a closed form, and law {} has none: use --law pade", system.law().name()));
  }
#ifdef CONTENSOU_WITH_ARB
  const double tau = stop_time(system, start, reduction::Route::closed).tau;
  const auto [lower, upper, error_ulp] = certify_stop_time(system, start, tau);
  return {system.law().name(), system.mu(), start, tau, lower, upper, error_ulp};
#else
  static_cast<void>(start);
  throw FileFailure(
      "--certify needs Arb, and this program was built without it: install it (Debian: apt-get install "
      "libflint-arb-dev), then run cmake and build again");
#endif
}

std::string certificate_as_text(const CertificateReport& report) {
  return fmt::format(
      "{:<12}{}\n"
      "{:<12}{:.17g}\n"
      "{:<12}{}\n"
      "{:<12}{}\n"
      "{:<12}{:.3g} ulp ({:g} allowed)  {}\n\n"
      "enclosed by ball arithmetic, the inputs taken as the exact numbers that the doubles are\n",
      "law", report.law, "tau*", report.tau_stop, "at least", report.lower, "at most", report.upper, "error",
      report.error_ulp, CertificateReport::allowed_ulp, report.passed() ? "ok" : "FAIL");
}

std::string certificate_as_csv(const CertificateReport& report) {
  return csv_line({"law", "mu", "u0", "v0", "tau_stop", "lower", "upper", "error_ulp"}) +
         csv_line({report.law, fmt::format("{}", report.mu), fmt::format("{}", report.start.u),
                   fmt::format("{}", report.start.v), fmt::format("{}", report.tau_stop), report.lower, report.upper,
                   fmt::format("{}", report.error_ulp)});
}

std::string certificate_as_json(const CertificateReport& report) {
  return JsonObject::document()
      .add("law", json(report.law))
      .add("route", json("closed"))
      .add("mu", json(report.mu))
      .add("u0", json(report.start.u))
      .add("v0", json(report.start.v))
      .add("tau_stop", json(report.tau_stop))
      .add("enclosure", json_array({json(report.lower), json(report.upper)}))
      .add("error_ulp", json(report.error_ulp))
      .text();
}

}  // namespace contensou::program
