#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "contensou/reduction/laws.hpp"
#include "contensou/reduction/verification.hpp"
#include "input/quotation.hpp"
#include "options/law_option.hpp"
#include "options/output_options.hpp"
#include "options/start_options.hpp"
#include "output/columns.hpp"
#include "output/json.hpp"
#include "verb.hpp"

namespace contensou::program {

namespace {

using reduction::Check;
using reduction::Law;
using reduction::State;

/// The checks of one law.
struct Verdict {
  std::string law;
  std::vector<Check> checks;
};

constexpr std::array built_in_patch_ratios{1e-4, 0.0035, 0.099, 0.3, 1.0};

/// Starts whose k0 = v0/(mu u0) runs from almost pure pivoting to almost pure sliding.
std::vector<State> built_in_starts(double mu) {
  std::vector<State> starts;
  for (int decade = -4; decade <= 6; ++decade) starts.push_back({.u = 1, .v = mu * std::pow(10, decade)});
  return starts;
}

/// Takes the worse of two results of the same check; not a number is the worst.
void merge(std::vector<Check>& worst, const std::vector<Check>& others) {
  for (const Check& other : others) {
    const auto same = std::ranges::find(worst, other.name, &Check::name);
    if (same == worst.end()) {
      worst.push_back(other);
    } else if (!(other.measured <= same->measured) && !std::isnan(same->measured)) {
      same->measured = other.measured;
    }
  }
}

std::vector<Check> built_in_checks(const Law& law) {
  std::vector<Check> worst;
  for (double mu : built_in_patch_ratios) merge(worst, verify({{law, mu}}, built_in_starts(mu)));
  return worst;
}

/// The name of a law, without the words that end a row: that of a file may have them.
std::string label(const std::string& law) {
  std::string text = quotation(law);
  text = text.substr(1, text.size() - 2);
  const auto is_letter = [&](std::size_t i) {
    return i < text.size() && std::isalnum(static_cast<unsigned char>(text[i])) != 0;
  };
  for (const std::string_view word : {"ok", "FAIL"}) {
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
      const bool within_word = is_letter(at - 1) || is_letter(at + word.size());
      if (word == "FAIL" || !within_word) text.replace(at, 1, fmt::format("\\x{:02x}", word.front()));
    }
  }
  return text;
}

class CheckCommand final : public Verb {
 public:
  void add_options(CLI::App& app) override {
    start_.add(app);
    law_.add(app);
    output_.add(app);
  }

  ExitStatus run() override {
    const Output output = output_.read();
    const std::vector<Law> laws = law_.given() ? std::vector{law_.read()} : reduction::paper_laws();
    std::vector<Verdict> verdicts;
    if (start_.given() || start_.body().given()) {
      const GivenStart start = start_.read();
      if (start.state.u == 0 && start.state.v == 0) {
        throw BadInput("u0 = v0 = 0 is rest, there is no motion to check: make one of them positive");
      }
      for (const Law& law : laws) verdicts.push_back({law.name(), verify(start.body.system(law), start.state)});
    } else {
      for (const Law& law : laws) verdicts.push_back({law.name(), built_in_checks(law)});
    }
    output.write_as([&](int digits) { return as_text(verdicts, digits); }, [&] { return as_csv(verdicts); },
                    [&] { return as_json(verdicts); });
    const bool passed = std::ranges::all_of(
        verdicts, [](const Verdict& verdict) { return std::ranges::all_of(verdict.checks, &Check::passed); });
    return passed ? ExitStatus::done : ExitStatus::check_failed;
  }

 private:
  std::string as_text(const std::vector<Verdict>& verdicts, int digits) const {
    const int width = digits + 8;
    std::size_t law_width = 0, check_width = 0;
    for (const auto& [law, checks] : verdicts) {
      law_width = std::max(law_width, label(law).size());
      for (const Check& check : checks) check_width = std::max(check_width, check.name.size());
    }
    std::string text;
    if (!start_.given()) {
      text = fmt::format("The worst of {} starts: mu from {} to {}, v0/(mu u0) from 1e-4 to 1e6.\n\n",
                         built_in_patch_ratios.size() * built_in_starts(1).size(), built_in_patch_ratios.front(),
                         built_in_patch_ratios.back());
    }
    const auto row = [&](const std::string& law, const std::string& check, const std::string& measured,
                         const std::string& allowed, std::string_view verdict) {
      text += fmt::format("{:<{}}  {:<{}}{:>{}}{:>10}{}\n", law, law_width, check, check_width, measured, width,
                          allowed, verdict);
    };
    row("law", "check", "measured", "allowed", "");
    for (const auto& [law, checks] : verdicts) {
      for (const Check& check : checks) {
        row(label(law), check.name, fmt::format("{:.{}g}", check.measured, digits),
            fmt::format("{:.2g}", check.allowed), check.passed() ? "  ok" : "  FAIL");
      }
    }
    return text;
  }

  static std::string as_csv(const std::vector<Verdict>& verdicts) {
    std::string text = csv_line({"law", "check", "measured", "allowed", "verdict"});
    for (const auto& [law, checks] : verdicts) {
      for (const Check& check : checks) {
        text += csv_line({law, check.name, fmt::format("{}", check.measured), fmt::format("{}", check.allowed),
                          check.passed() ? "ok" : "FAIL"});
      }
    }
    return text;
  }

  static std::string as_json(const std::vector<Verdict>& verdicts) {
    std::vector<std::string> rows;
    for (const auto& [law, checks] : verdicts) {
      for (const Check& check : checks) {
        const double measured = std::isnan(check.measured) ? std::numeric_limits<double>::infinity() : check.measured;
        rows.push_back(JsonObject()
                           .add("law", json(law))
                           .add("check", json(check.name))
                           .add("measured", json(measured))
                           .add("allowed", json(check.allowed))
                           .add("passed", check.passed() ? "true" : "false")
                           .inline_text());
      }
    }
    return JsonObject::document().add("checks", json_array(rows)).text();
  }

  StartOptions start_;
  LawOption law_;
  OutputOptions output_{{{"a table of checks", {"text", "csv", "json"}, "text"}}};
};

const RegisteredVerb<CheckCommand> registered("check", "Every statement of the theory as a number that must be small",
                                              "contensou check --mu 0.1 --u0 1 --v0 1");

}  // namespace

}  // namespace contensou::program
