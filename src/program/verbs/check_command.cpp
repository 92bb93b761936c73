#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "answers/check_against.hpp"
#include "contensou/reduction/laws.hpp"
#include "contensou/reduction/verification.hpp"
#include "options/law_option.hpp"
#include "options/output_options.hpp"
#include "options/start_options.hpp"
#include "verb.hpp"

namespace contensou::program {

namespace {

using reduction::Check;
using reduction::Law;
using reduction::State;

/// A check of a law.
struct Row {
  std::string law;
  Check check;
  Json more = Json::object();  ///< that the row has of its own
};

const char* verdict(const Check& check) { return check.passed() ? "ok" : "FAIL"; }

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

std::string heading() {
  return fmt::format("The worst of {} starts: mu from {} to {}, v0/(mu u0) from 1e-4 to 1e6.\n\n",
                     built_in_patch_ratios.size() * built_in_starts(1).size(), built_in_patch_ratios.front(),
                     built_in_patch_ratios.back());
}

std::string as_text(const std::vector<Row>& rows, const Digits& digits) {
  std::size_t law_width = 0, check_width = 0;
  for (const auto& [law, check, more] : rows) {
    law_width = std::max(law_width, label(law).size());
    check_width = std::max(check_width, check.name.size());
  }
  std::string text;
  const auto add = [&](const std::string& law, const std::string& check, const std::string& measured,
                       const std::string& allowed, std::string_view end) {
    text += fmt::format("{:<{}}  {:<{}}{:>{}}{:>10}{}\n", law, law_width, check, check_width, measured, digits.width(),
                        allowed, end);
  };
  add("law", "check", "measured", "allowed", "");
  for (const auto& [law, check, more] : rows) {
    add(label(law), check.name, digits(check.measured), fmt::format("{:.2g}", check.allowed),
        fmt::format("  {}", verdict(check)));
  }
  return text;
}

Answer answer_of(const std::vector<Row>& rows) {
  Answer answer;
  answer.members["checks"] = Json::array();
  for (const auto& [law, check, more] : rows) {
    Json row{
        {"law", law}, {"check", check.name}, {"measured", or_infinity(check.measured)}, {"allowed", check.allowed}};
    answer.rows.push_back(row);
    answer.rows.back()["verdict"] = verdict(check);
    answer.rows.back().update(more);
    row["passed"] = check.passed();
    row.update(more);
    answer.members["checks"].push_back(std::move(row));
  }
  return answer;
}

std::string deviation_text(const char* speed, const char* unit, const Deviation& off, const Digits& digits) {
  return fmt::format("{} is off by up to {} {}, at t = {} s; {}\n", speed, digits(off.error), unit, digits(off.t),
                     std::isinf(off.leaves) ? "never by more than allowed"
                                            : fmt::format("by more than allowed from t = {} s", digits(off.leaves)));
}

std::string text_beside(const MotionsBeside& motions, const Digits& digits) {
  const ModelBeside& own = motions.models.front();
  std::string text =
      "\n" + deviation_text("slip", "m/s", own.slip, digits) + deviation_text("spin", "rad/s", own.spin, digits) + "\n";
  const std::string heading = "worst share of the start";
  std::size_t width = heading.size();
  for (const ModelBeside& model : motions.models) width = std::max(width, label(model.name).size());
  const auto add = [&](const std::string& name, const std::string& slip, const std::string& spin) {
    text += fmt::format("{:<{}}{:>{}}{:>{}}\n", name, width, slip, digits.width(), spin, digits.width());
  };
  add(heading, "slip", "spin");
  for (const auto& [name, slip, spin] : motions.models) add(label(name), digits(slip.relative), digits(spin.relative));
  return text + fmt::format("\nnearest: {}\n", label(motions.nearest().name));
}

class CheckCommand final : public Verb {
 public:
  void add_options(CLI::App& app) override {
    start_.add(app);
    law_.add(app);
    app.option_defaults()->group("Against a table");
    against_.add(
        app, "--against", "FILE",
        "with --ball: the motion in this CSV, of an engine or a camera, against that of the law; columns "
        "t,slip,spin (or wz) in SI units; it starts as its first row, but for --slip and --spin; - is standard "
        "input");
    tolerance_.add(
        app, "--tolerance", "SHARE",
        fmt::format("of slip and spin at the start, by which they may be off (default {})", standard_tolerance),
        [](const std::string& typed) {
          const double share = parse_number(typed);
          if (!(share > 0)) throw NotAllowed("a share above 0 is needed");
          return share;
        });
    output_.add(app);
  }

  ExitStatus run() override {
    const Output output = output_.read();
    if (against_.given()) return compare(output);
    if (tolerance_.given()) throw BadInput("--tolerance is for a table: add --against FILE");
    const bool of_one_start = start_.given() || start_.body_argument().given();
    const bool one_law = law_.given() || start_.brings_law();
    std::vector<Row> rows;
    for (const Law& law : one_law ? std::vector{law_.read(start_.standard_law())} : reduction::paper_laws()) {
      for (Check& check : of_one_start ? checks_of_start(law) : built_in_checks(law)) {
        rows.push_back({law.name(), std::move(check)});
      }
    }
    Answer answer = answer_of(rows);
    answer.text = [&](const Digits& digits) { return (start_.given() ? "" : heading()) + as_text(rows, digits); };
    output.write(answer);
    return status_of(rows);
  }

 private:
  static constexpr double standard_tolerance = 0.01;

  static ExitStatus status_of(const std::vector<Row>& rows) {
    const bool passed = std::ranges::all_of(rows, [](const Row& row) { return row.check.passed(); });
    return passed ? ExitStatus::done : ExitStatus::check_failed;
  }

  /// A motion in a table against that of the law.
  ExitStatus compare(const Output& output) const {
    const Law law = law_.read(start_.standard_law());
    if (!start_.ball_given()) {
      against_.reject("slip and spin are those of a ball in SI units: add --ball NAME|FILE.toml");
    }
    const si::Experiment ball = start_.read_ball(law, at_rest(against_.name()));
    const MotionsBeside motions = compare_with_motions(against_.text(), ball, start_.given_values(), law,
                                                       tolerance_.value_or(standard_tolerance));
    const auto row = [&](const std::string& name, const Deviation& off) {
      return Row{law.name(),
                 {name, off.relative, tolerance_.value_or(standard_tolerance)},
                 {{"error", off.error}, {"t", off.t}, {"leaves", off.leaves}}};
    };
    const auto& [own, slip, spin] = motions.models.front();
    const std::vector<Row> rows{
        row(motions.start.slip > 0 ? "slip error / slip at start" : "slip error / R spin at start", slip),
        row(motions.start.spin != 0 ? "spin error / spin at start" : "R spin error / slip at start", spin)};
    Answer answer = answer_of(rows);
    for (Json& line : answer.rows) line["nearest"] = motions.nearest().name;
    answer.members["start"] = {{"slip", motions.start.slip}, {"spin", motions.start.spin}};
    answer.members["models"] = Json::array();
    for (const ModelBeside& model : motions.models) {
      answer.members["models"].push_back(
          {{"model", model.name}, {"slip", model.slip.relative}, {"spin", model.spin.relative}});
    }
    answer.members["nearest"] = motions.nearest().name;
    answer.text = [&](const Digits& digits) { return as_text(rows, digits) + text_beside(motions, digits); };
    output.write(answer);
    return status_of(rows);
  }

  std::vector<Check> checks_of_start(const Law& law) const {
    const GivenStart start = start_.read(law);
    if (!start.at_rest()) return verify(start.system, start.state);
    throw BadInput("u0 = v0 = 0 is rest, there is no motion to check: make one of them positive");
  }

  StartOptions start_;
  LawOption law_;
  Argument against_;
  ArgumentOf<double> tolerance_;
  OutputOptions output_{{{"a table of checks", answer_formats("text")}}};
};

const RegisteredVerb<CheckCommand> check_verb("check", "Every statement of the theory as a number that must be small",
                                              "contensou check --mu 0.1 --u0 1 --v0 1");

}  // namespace

}  // namespace contensou::program
