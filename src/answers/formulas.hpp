#pragma once

#include <array>
#include <initializer_list>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace contensou::answers {

/// What a pair of formulas is to be.
struct FormulaShape {
  std::array<std::string, 2> left;                  ///< before the equals signs
  std::vector<std::string> variables;               ///< of the formulas
  std::string sentence;                             ///< for messages, such as a system is "u' = F; v' = G"
  std::map<std::string, std::string> refused = {};  ///< names that no parameter has, either, and why
};

/// Two formulas, "u' = F; v' = G" in any order, of some variables and parameters: + - * / ^ ( ) < > ? :, |...|, pi, and the
/// functions of muParser and hypot, with sign(0) = 0 and log = ln. Behind them the text may give parameters, "; a = 2".
/// One thread at a time.
class Formulas {
 public:
  /// @param parameters  in place of those of the text
  /// @throws BadInput  quoting what is wrong and saying at which character; for a parameter that is a name of another
  ///                   kind or that no formula has
  Formulas(const FormulaShape& shape, const std::string& text, std::map<std::string, double> parameters);
  ~Formulas();
  Formulas(const Formulas&) = delete;

  /// @param values  of the variables
  std::array<double, 2> operator()(std::initializer_list<double> values);

 private:
  struct Compiled;
  std::unique_ptr<Compiled> compiled_;
};

}  // namespace contensou::answers
