#include "answers/verbs/check_answer.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "answers/input/errors.hpp"
#include "answers/input/parse.hpp"

namespace contensou::answers {

using reduction::Check;
using reduction::State;

namespace {

constexpr std::array built_in_patch_ratios{1e-4, 0.0035, 0.099, 0.3, 1.0};

/// Values of mu for starts with a drive. For smaller mu creeping is stiff, and routes that integrate in steps are slow.
constexpr std::array driven_patch_ratios{0.099, 1.0};
constexpr std::array built_in_drives{0.05, 0.5, 0.95};

/// Returns starts whose k0 = v0/(mu u0) runs from almost pure pivoting to almost pure sliding.
std::vector<State> built_in_starts(double mu) {
  std::vector<State> starts;
  for (int decade = -4; decade <= 6; ++decade) starts.push_back({.u = 1, .v = mu * std::pow(10, decade)});
  return starts;
}

const char* verdict(const Check& check) { return check.passed() ? "ok" : "FAIL"; }

/// Returns a number of the deviation; null for a row without a table.
Json of_deviation(const CheckedLaw& row, double Deviation::*number) {
  return row.deviation ? Json((*row.deviation).*number) : Json();
}

using Row = CheckedLaw;
constexpr Field<Row> row_fields[]{
    {"law", "", "name of the law of friction; absent with --system",
     [](const Row& row) { return row.law.empty() ? Json() : Json(row.law); }},
    {"check", "", "statement that is checked, in a few words", [](const Row& row) -> Json { return row.check.name; }},
    {"measured", "", "largest error that was found",
     [](const Row& row) -> Json { return or_infinity(row.check.measured); }},
    {"allowed", "", "largest error that passes", [](const Row& row) -> Json { return row.check.allowed; }},
    {"", "", "ok or FAIL", [](const Row& row) -> Json { return verdict(row.check); }, "verdict"},
    {"passed", "", "true if the check passes", [](const Row& row) -> Json { return row.check.passed(); }, ""},
    {"error", "m/s or rad/s", "largest difference between the table of --against and the law",
     [](const Row& row) { return of_deviation(row, &Deviation::error); }},
    {"t", "s", "time of the largest difference, with --against",
     [](const Row& row) { return of_deviation(row, &Deviation::t); }},
    {"leaves", "s", "first time at which the difference from the law is larger than allowed, or inf if it never is",
     [](const Row& row) { return of_deviation(row, &Deviation::leaves); }},
};
constexpr Field<MotionsBeside> beside_fields[]{
    {"start", "m/s, rad/s", "slip and spin at the start, with --against",
     [](const MotionsBeside& motions) -> Json {
       return {{"slip", motions.start.slip}, {"spin", motions.start.spin}};
     },
     "", 0, " {`slip`, `spin`}"},
    {"models", "",
     "largest differences between the table and each model, divided by slip and spin at the start. The law is the "
     "first model. elliptic: friction of an engine with one limit for force and moment. textbook: friction with two "
     "separate limits",
     [](const MotionsBeside& motions) {
       Json models = Json::array();
       for (const auto& [name, motion, slip, spin] : motions.models) {
         models.push_back({{"model", name}, {"slip", slip.relative}, {"spin", spin.relative}});
       }
       return models;
     },
     "", 0, " [{`model`, `slip`, `spin`}]"},
    {"nearest", "",
     "name of the model with the smallest differences; none if these exceed 30 % of slip or spin at the start",
     [](const MotionsBeside& motions) -> Json { return motions.nearest() ? motions.nearest()->name : "none"; }},
    {"reading", "", "other axes or units with which a model fits the table, if no model fits it without them",
     [](const MotionsBeside& motions) -> Json { return motions.reading.empty() ? Json() : Json(motions.reading); }, ""},
};

/// Returns the name of a law, in which "ok" and "FAIL" are escaped: scripts search rows for these words.
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
  const std::size_t starts = built_in_starts(1).size();
  return fmt::format(
      "The worst of {} starts: mu from {} to {}, v0/(mu u0) from 1e-4 to 1e6.\n"
      "With a drive: the worst of {}, with drives from {} to {} of f N and mu from {}.\n\n",
      built_in_patch_ratios.size() * starts, built_in_patch_ratios.front(), built_in_patch_ratios.back(),
      driven_patch_ratios.size() * built_in_drives.size() * starts, built_in_drives.front(), built_in_drives.back(),
      driven_patch_ratios.front());
}

std::string as_text(const std::vector<CheckedLaw>& rows, const Digits& digits) {
  std::vector<TextTable::Column> columns{TextTable::left(), TextTable::left(), TextTable::right(digits.width()),
                                         TextTable::right(10)};
  std::vector<std::vector<std::string>> lines{{"law  ", "check", "measured", "allowed"}};
  for (const auto& [law, check, deviation] : rows) {
    lines.push_back({label(law) + "  ", check.name, digits(check.measured), fmt::format("{:.2g}", check.allowed),
                     fmt::format("  {}", verdict(check))});
  }
  const bool has_law = !rows.front().law.empty();
  if (!has_law) columns.erase(columns.begin());
  TextTable table(columns);
  for (auto& line : lines) table.add({line.begin() + (has_law ? 0 : 1), line.end()});
  return table.text();
}

std::string deviation_text(const char* speed, const char* unit, const Deviation& off, const Digits& digits) {
  return fmt::format("{} is off by up to {} {}, at t = {} s; {}\n", speed, digits(off.error), unit, digits(off.t),
                     std::isinf(off.leaves) ? "never by more than allowed"
                                            : fmt::format("by more than allowed from t = {} s", digits(off.leaves)));
}

std::string as_text(const MotionsBeside& motions, const Digits& digits) {
  const ModelBeside& own = motions.models.front();
  TextTable table({TextTable::left(), TextTable::right(digits.width()), TextTable::right(digits.width())});
  table.add({"worst share of the start", "slip", "spin"});
  for (const auto& [name, motion, slip, spin] : motions.models) {
    table.add({label(name), digits(slip.relative), digits(spin.relative)});
  }
  const ModelBeside& best = motions.best();
  const std::string nearest = motions.nearest()
                                  ? label(best.name)
                                  : fmt::format("none; the best model, {}, is off by {:.3g} % of the start",
                                                label(best.name), 100 * best.worst());
  return fmt::format("\n{}{}\n{}\nnearest: {}\n{}", deviation_text("slip", "m/s", own.slip, digits),
                     deviation_text("spin", "rad/s", own.spin, digits), table.text(), nearest,
                     motions.reading.empty() ? "" : motions.reading + "\n");
}

Answer answer_of_checks(const std::vector<CheckedLaw>& rows) {
  Answer answer = answer_of_rows("checks", row_fields, rows);
  answer.passed = std::ranges::all_of(rows, [](const CheckedLaw& row) { return row.check.passed(); });
  return answer;
}

}  // namespace

void take_worse(std::vector<Check>& worst, const std::vector<Check>& others) {
  for (const Check& other : others) {
    const auto same = std::ranges::find(worst, other.name, &Check::name);
    if (same == worst.end()) {
      worst.push_back(other);
    } else if (!(other.measured <= same->measured) && !std::isnan(same->measured)) {
      same->measured = other.measured;
    }
  }
}

std::vector<Check> built_in_checks(const reduction::Law& law) {
  std::vector<Check> worst;
  for (double mu : built_in_patch_ratios) take_worse(worst, verify({{law, mu}}, built_in_starts(mu)));
  for (double mu : driven_patch_ratios) {
    for (double drive : built_in_drives) {
      std::vector<Check> driven = verify({{law, mu, reduction::homogeneous_ball, drive}}, built_in_starts(mu));
      std::erase_if(driven, [](const Check& check) { return !check.name.starts_with("stop time"); });
      for (Check& check : driven) check.name += ", with a drive";
      take_worse(worst, driven);
    }
  }
  return worst;
}

Answer check_answer(const std::vector<CheckedLaw>& rows, bool built_in) {
  Answer answer = answer_of_checks(rows);
  answer.text = [=](const Digits& digits) { return (built_in ? heading() : "") + as_text(rows, digits); };
  return answer;
}

Answer check_system_answer(const reduction::SmoothField& field, const Eigen::Vector2d& start) {
  try {
    if (!field(start).isZero(0)) {
      const auto found = reduction::find_symmetries(field, reduction::sampled_about(field, start));
      std::vector<CheckedLaw> rows;
      for (Check& check : verify(reduction::reduce(field, start, found), found, start)) {
        rows.push_back({"", std::move(check)});
      }
      return check_answer(rows, false);
    }
  } catch (const std::domain_error& error) {
    throw BadInput("there is no motion to check at ({}, {}): {}", start[0], start[1], words_of(error.what()));
  }
  throw BadInput("({}, {}) is at rest, there is no motion to check: give another start", start[0], start[1]);
}

Answer check_against_answer(const MotionsBeside& motions, const std::string& law, double tolerance) {
  const auto row = [&](const char* name, const Deviation& off) {
    return CheckedLaw{law, {name, off.relative, tolerance}, off};
  };
  const auto& [own, motion, slip, spin] = motions.models.front();
  const std::vector<CheckedLaw> rows{
      row(motions.start.slip > 0 ? "slip error / slip at start" : "slip error / R spin at start", slip),
      row(motions.start.spin != 0 ? "spin error / spin at start" : "R spin error / slip at start", spin)};
  Answer answer = answer_of_checks(rows);
  answer.members.update(members_of(beside_fields, motions));
  for (Json& line : answer.rows) line.update(row_of(beside_fields, motions));
  answer.text = [=](const Digits& digits) { return as_text(rows, digits) + as_text(motions, digits); };
  return answer;
}

std::vector<FieldText> check_fields() {
  return joined({texts_of_rows("checks", row_fields),
                 {{"in: `t` or `time`; `slip`; `spin` or `wz`", "s; m/s; rad/s",
                   "columns of the table of --against. Times increase, and the first row is the start. A heading may "
                   "name a unit, as in 'wz [rpm]'"},
                  {"in: `vx`, `vy`; `wx`, `wy`, `wz`", "m/s; rad/s",
                   "velocity of the centre and angular velocity (z up), instead of slip and spin. A disc or ring needs "
                   "no wx, wy"}},
                 texts_of(beside_fields)});
}

}  // namespace contensou::answers
