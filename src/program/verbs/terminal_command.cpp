#include <array>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "contensou/reduction/reduced_system.hpp"
#include "contensou/reduction/terminal_ratio.hpp"
#include "exit_status.hpp"
#include "options/body_option.hpp"
#include "options/law_option.hpp"
#include "options/output_options.hpp"
#include "output/columns.hpp"
#include "output/json.hpp"
#include "verb.hpp"

namespace contensou::program {

namespace {

using reduction::TerminalRatio;

/// In the order of TerminalRegime.
constexpr std::array<std::string_view, 3> regime_names{"zero", "ray", "infinity"};
constexpr std::array<std::string_view, 3> sentences{
    "sliding dies out first", "sliding and spinning die out together, on an invariant ray", "spinning dies out first"};

class TerminalCommand final : public Verb {
 public:
  void add_options(CLI::App& app) override {
    add_patch_ratio(mu_, app);
    law_.add(app);
    body_.add(app);
    output_.add(app);
  }

  ExitStatus run() override {
    const Body body = body_.read();
    const reduction::ReducedSystem system(law_.read(), BodyOption::read_patch_ratio(mu_, body), body.inertia);
    const TerminalRatio ratio = reduction::terminal_ratio(system.law(), system.r());
    const auto regime = static_cast<std::size_t>(ratio.regime);
    output_.read().write_as([&](int digits) { return as_text(system, ratio, regime, digits); },
                            [&] {
                              return csv_line({"law", "r", "r_low", "r_high", "limit", "k_star"}) +
                                     csv_line({system.law().name(), fmt::format("{}", system.r()),
                                               fmt::format("{}", ratio.low), fmt::format("{}", ratio.high),
                                               std::string(regime_names[regime]), fmt::format("{}", ratio.k)});
                            },
                            [&] {
                              return JsonObject::document()
                                  .add("law", json(system.law().name()))
                                  .add("r", json(system.r()))
                                  .add("r_low", json(ratio.low))
                                  .add("r_high", json(ratio.high))
                                  .add("limit", json(regime_names[regime]))
                                  .add("k_star", json(ratio.k))
                                  .text();
                            });
    return ExitStatus::done;
  }

 private:
  static std::string as_text(const reduction::ReducedSystem& system, const TerminalRatio& ratio, std::size_t regime,
                             int digits) {
    const auto number = [&](double value) { return fmt::format("{:.{}g}", value, digits); };
    return fmt::format(
        "k = v/(mu |u|) tends to {}: {}\n\n"
        "law    {}\n"
        "r      {} = gamma mu^2/chi, gamma = {}, mu = {}, chi = {}\n"
        "ray    exists for {} < r < {}\n",
        number(ratio.k), sentences[regime], system.law().name(), number(system.r()), number(system.inertia().gamma),
        number(system.mu()), number(system.inertia().chi), number(ratio.low), number(ratio.high));
  }

  ArgumentOf<double> mu_;
  LawOption law_;
  BodyOption body_;
  OutputOptions output_{{{"a terminal ratio", {"text", "csv", "json"}, "text"}}};
};

const RegisteredVerb<TerminalCommand> registered(
    "terminal", "What k = v/(mu |u|) tends to at the stop: 0, an invariant ray, infinity",
    "contensou terminal --law uniform --body disc");

}  // namespace

}  // namespace contensou::program
