#include <string>

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
#include "verbs/phase_plane_report.hpp"

namespace contensou::program {

namespace {

using reduction::InvariantRay;
using reduction::TerminalRatio;
using reduction::TerminalRatios;

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
    const TerminalRatios ratios = reduction::terminal_ratios(system.law(), system.r());
    output_.read().write_as([&](int digits) { return as_text(system, ratios, digits); },
                            [&] { return as_csv(system, ratios); },
                            [&] {
                              JsonObject document = JsonObject::document();
                              document.add("law", json(system.law().name())).add("r", json(system.r()));
                              add_terminal_ratios(document, ratios);
                              return document.text();
                            });
    return ExitStatus::done;
  }

 private:
  /// A row for each end.
  static std::string as_csv(const reduction::ReducedSystem& system, const TerminalRatios& ratios) {
    std::string text =
        csv_line({"law", "r", "r_low", "r_high", "limit", "k_star", "k_from", "k_to", "k_star_accuracy"});
    for (const TerminalRatio& end : ratios.ends) {
      std::vector<std::string> row{system.law().name()};
      for (double value : {system.r(), ratios.low, ratios.high}) row.push_back(fmt::format("{}", value));
      row.emplace_back(limit_name(end.regime));
      for (double value : {end.k, end.from, end.to, accuracy_of(end, ratios)}) row.push_back(fmt::format("{}", value));
      text += csv_line(row);
    }
    return text;
  }

  static std::string as_text(const reduction::ReducedSystem& system, const TerminalRatios& ratios, int digits) {
    const auto number = [&](double value) { return fmt::format("{:.{}g}", value, digits); };
    std::string text;
    if (ratios.ends.size() == 1) {
      const TerminalRatio& end = ratios.ends.front();
      text = fmt::format("k = v/(mu |u|) tends to {}: {}\n", number(end.k), sentence(end.regime));
    } else {
      text = "k = v/(mu |u|) tends to one of several ratios; the k of the start tells which\n";
      for (const TerminalRatio& end : ratios.ends) {
        text += fmt::format("{} < k < {}: to {}, {}\n", number(end.from), number(end.to), number(end.k),
                            sentence(end.regime));
      }
    }
    text += fmt::format(
        "\n"
        "law    {}\n"
        "r      {} = gamma mu^2/chi, gamma = {}, mu = {}, chi = {}\n"
        "rays   where Phi/(k Psi) = r; it is {} at k = 0 and {} at k = infinity\n",
        system.law().name(), number(system.r()), number(system.inertia().gamma), number(system.mu()),
        number(system.inertia().chi), number(ratios.low), number(ratios.high));
    for (const InvariantRay& ray : ratios.rays) {
      text +=
          fmt::format("       k = {} {}, relative error of k below {:.0e}\n", number(ray.k), effect(ray), ray.accuracy);
    }
    return text;
  }

  static std::string_view sentence(reduction::TerminalRegime regime) {
    using enum reduction::TerminalRegime;
    return regime == zero  ? "sliding dies out first"
           : regime == ray ? "sliding and spinning die out together, on an invariant ray"
                           : "spinning dies out first";
  }

  static std::string_view effect(const InvariantRay& ray) {
    return ray.attracts()       ? "attracts"
           : ray.attracts_above ? "attracts from above, repels below"
           : ray.attracts_below ? "attracts from below, repels above"
                                : "repels";
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
