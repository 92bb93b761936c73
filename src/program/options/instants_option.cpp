#include "options/instants_option.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "answers/input/csv.hpp"
#include "answers/input/formulas.hpp"
#include "contensou/si/quantity.hpp"

namespace contensou::program {

Eigen::ArrayXd instants(Eigen::Index count, double busy, double end) {
  const Eigen::Index early = count / 2, late = count - early;
  if (early < 2 || !(busy > 0 && 2 * busy < end)) return Eigen::ArrayXd::LinSpaced(count, 0, end);
  Eigen::ArrayXd all(count);
  all << Eigen::ArrayXd::LinSpaced(early + 1, 0, busy).head(early), Eigen::ArrayXd::LinSpaced(late, busy, end);
  return all;
}

InstantsOption::Times InstantsOption::read_times(const std::string& typed, const std::string& time,
                                                 std::string_view unit, bool signs) {
  const std::vector<std::string> texts = split(typed, ',');
  const bool plain = std::ranges::all_of(texts, is_constant);
  const bool is_file = typed == "-" || (!plain && names_a_file(typed, {".csv", ".txt"}));  // pi/2 is none
  const bool in_seconds = unit.empty() && !is_file && !plain;
  const std::vector<double> times =
      is_file ? read_column(typed, time, Infinity::forbidden) : parse_quantities(texts, in_seconds ? "s" : unit);
  const Times all{Eigen::Map<const Eigen::ArrayXd>(times.data(), static_cast<Eigen::Index>(times.size())), in_seconds};
  if (!signs) require_not_negative(all, time);
  return all;
}

void InstantsOption::require_not_negative(const Times& times, const std::string& time) {
  for (const double at : times.values) {
    if (at < 0) throw NotAllowed("{} is not allowed: {} >= 0 is required", at, time);
  }
}

void InstantsOption::add(CLI::App& app, const std::string& time, const std::string& unit, const std::string& extent,
                         bool signs) {
  constexpr long max_samples = 10'000'000;
  app.option_defaults()->group("Instants");
  const auto read = [=](const std::string& typed) { return read_times(typed, time, unit, signs); };
  at_.add(app, "--at", "T1,T2,...|FILE",
          fmt::format("list of times {0} >= 0{1}, in any order. FILE has a column {0}, or one number a line", time,
                      unit.empty() ? ", or with --ball in seconds, such as '1,2 s'"
                                   : ", in " + std::string(si::find_dimension(unit)->words)),
          read);
  samples_.add(
      app, "--samples", "N",
      fmt::format("number of instants{}, 2 or more, instead of --at (default {}). Half of them lie in the time in "
                  "which the body slides",
                  extent, standard_samples),
      whole_number(2, max_samples));
  equidistant_.add(app, "--equidistant", "equal time steps between the instants of --samples");
  at_.excludes({&samples_, &equidistant_});
}

}  // namespace contensou::program
