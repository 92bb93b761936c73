#pragma once

#include <string>

#include "contensou/reduction/reduced_system.hpp"

namespace contensou::program {

/// What `check --certify` says of one start.
struct CertificateReport {
  std::string law;
  double mu;
  reduction::State start;
  double tau_stop;    ///< of the closed form
  std::string lower;  ///< decimals that enclose the true stop time
  std::string upper;
  double error_ulp;

  /// What the closed form may miss the truth by.
  static constexpr double allowed_ulp = 4;
  bool passed() const { return error_ulp <= allowed_ulp; }
};

/// @throws BadInput     if the law has no closed form
/// @throws FileFailure  if this program was built without Arb
CertificateReport make_certificate_report(const reduction::ReducedSystem& system, reduction::State start);

std::string certificate_as_text(const CertificateReport& report);
std::string certificate_as_csv(const CertificateReport& report);
std::string certificate_as_json(const CertificateReport& report);

}  // namespace contensou::program
