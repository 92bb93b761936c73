#pragma once

#include <optional>
#include <string>
#include <vector>

#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/small_mu.hpp"
#include "options/start_options.hpp"

namespace contensou::program {

/// Everything that `stop` says about one start.
struct StopReport {
  struct OtherLaw {
    std::string law;
    double tau;
  };

  GivenStart start;
  reduction::ReducedSystem system;
  reduction::StopTime stop;
  double T_stop;                                        ///< f g t, the stop time without the paper's factor 3 pi/2
  double sliding_only;                                  ///< tau of a body that did not pivot
  double pivoting_only;                                 ///< tau of a body that did not slide
  std::optional<OtherLaw> other;                        ///< the other law of the paper, beside one of its laws
  std::vector<reduction::StopEstimate> estimates = {};  ///< for small mu; none unless asked for
};

/// @param system  of the start
StopReport make_stop_report(const GivenStart& start, const reduction::ReducedSystem& system, reduction::Route route);

std::string stop_report_as_json(const StopReport& report);
std::string stop_report_as_csv(const StopReport& report);

/// For people.
std::string stop_report_as_text(const StopReport& report, int digits);

}  // namespace contensou::program
