#include "answers/asked/formula_law.hpp"

#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "answers/input/errors.hpp"
#include "answers/input/formulas.hpp"
#include "answers/input/parse.hpp"
#include "contensou/reduction/laws.hpp"

namespace contensou::answers {

namespace {

constexpr const char* no_speed = "dry friction depends on the ratio k = v/(mu |u|) alone, not on the size of speeds";

class FormulaLaw {
 public:
  FormulaLaw(const std::string& text, const std::map<std::string, double>& parameters)
      : name_(text),
        formulas_({{"phi", "psi"},
                   {"k"},
                   "a law is \"phi = F; psi = G\", formulas in k = v/(mu |u|)",
                   {{"u", no_speed}, {"v", no_speed}}},
                  text, parameters) {
    for (const auto& [name, value] : parameters) name_ += fmt::format("; {} = {}", name, value);
  }

  const std::string& name() const { return name_; }

  reduction::Resistance operator()(reduction::Slip slip) const {
    if (slip.pivoting == 0) return {formulas_({most})[0], 0};
    const double k = slip.sliding / slip.pivoting;
    if (k < least) {
      const auto [phi, psi] = formulas_({least});
      return {phi * (k / least), psi};
    }
    if (k > most) {
      const auto [phi, psi] = formulas_({most});
      return {1 - (1 - phi) * (most / k), psi * (most / k)};
    }
    const auto [phi, psi] = formulas_({k});
    return {phi, psi};
  }

  /// Throws BadInput unless Phi and Psi are positive and finite at 3601 values of k from 1e-9 to 1e9. These values lie
  /// so close together that a pole or a gap of a formula shows.
  void require_resistance() const {
    constexpr double from = 1e-9, to = 1e9;
    constexpr int steps = 3600;
    for (int i = 0; i <= steps; ++i) {
      const double k = from * std::pow(to / from, static_cast<double>(i) / steps);
      const auto [phi, psi] = formulas_({k});
      if (phi > 0 && psi > 0 && std::isfinite(phi) && std::isfinite(psi)) continue;
      throw BadInput(
          "friction resists: phi and psi must be positive and finite for every k > 0, but phi = {} and psi "
          "= {} at k = {:.6g}",
          phi, psi, k);
    }
  }

 private:
  /// Least and largest k at which the formulas are evaluated. Beyond these two values the formulas may overflow.
  static constexpr double least = 0x1p-90, most = 0x1p90;

  std::string name_;
  Formulas formulas_;
};

}  // namespace

bool is_formula_law(const std::string& text) { return text.find('=') != std::string::npos && !text.ends_with(".csv"); }

reduction::Law parse_formula_law(const std::string& text, const std::map<std::string, double>& parameters) {
  const FormulaLaw law(text, parameters);
  law.require_resistance();
  try {
    return law;
  } catch (const std::domain_error& error) {
    // Leave out the name of the law, because the caller puts this name into a message of its own.
    std::string message = error.what();
    const std::string before = fmt::format("Law {}: ", law.name());
    if (message.starts_with(before)) message.erase(0, before.size());
    if (message.find("2^-60") != std::string::npos) {
      message += "; where a formula loses its digits there, as 1 - 1/(1 + k) does, write it without the difference";
    }
    throw BadInput(message);
  }
}

std::optional<reduction::Law> find_law_or_formulas(const std::string& text) {
  if (is_formula_law(text)) return parse_formula_law(text);
  try {
    return reduction::find_law(text);
  } catch (const std::domain_error& error) {
    throw BadInput(escaped(error.what()));  // the message may contain unprintable letters
  }
}

std::vector<std::pair<std::string, std::string>> law_forms() {
  // Remarks on laws for users of the program. One example: the law is the default of a kind of body.
  const std::map<std::string_view, std::string_view> notes{
      {"exact", "default of a ball; also called hertz"},
      {"pade",
       "which makes the sliding distance that spin adds 5 (ball pool), 129 (steel) or 470 (bowling) times too long"},
      {"uniform", "default of --body disc"},
      {"ring", "default of --body ring"},
  };
  std::vector<std::pair<std::string, std::string>> forms;
  for (const std::string_view name : reduction::names_of_laws()) {
    std::string meaning(reduction::meaning_of_law(name));
    if (const auto note = notes.find(name); note != notes.end()) meaning += fmt::format(", {}", note->second);
    forms.emplace_back(name, meaning);
  }
  for (const auto& family : reduction::law_families()) {
    forms.emplace_back(family.form(), fmt::format("{}, {}", family.meaning, family.allowed));
  }
  forms.emplace_back("\"phi = F; psi = G\"",
                     "your own Phi and Psi as formulas in k. Parameters are given by --param NAME=VALUE, or at the end "
                     "as \"; NAME = VALUE\"");
  forms.emplace_back("FILE.csv", "your own pressure as a table with columns rho,pressure; rho from 0 to 1");
  return forms;
}

}  // namespace contensou::answers
