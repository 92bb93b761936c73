#pragma once

#include <functional>
#include <optional>
#include <string_view>
#include <vector>

namespace contensou::program {

/// What a recomputation says of a printed statement.
enum class Verdict {
  holds,     ///< the number it gives is the computed one
  erratum,   ///< it is not, but with the correction it is
  not_true,  ///< it is not, and no correction of a detail makes it so
};

/// holds, slip or false: the words of the verb `paper`.
std::string_view word(Verdict verdict);

/// A statement's numbers where it is examined.
struct Finding {
  double printed, computed;
  std::optional<double> corrected;
  Verdict verdict;
};

/// In place of what is allowed: the printed number is a lower bound.
constexpr double lower_bound = -1;

/// What is allowed between two ways of plain arithmetic, and where one of them steps through an equation.
constexpr double arithmetic = 1e-13, stepping = 1e-9;

/// A statement of Zh98 as two numbers that have to agree, or two functions of k.
struct Statement {
  struct Number : std::function<double(double)> {
    using function::function;
    Number() = default;
    Number(double value) : function([value](double) { return value; }) {}  // NOLINT(google-explicit-constructor)
  };

  std::string_view equation, says;
  Number printed;                     ///< what the statement gives
  Number computed;                    ///< what is found without it
  double allowed;                     ///< how far apart they may be, relative to max(1, |computed|)
  double at = 0;                      ///< the k at which they are compared, or the mu
  std::string_view where = {};        ///< that for people: fmt's format, with `at` as its argument
  Verdict recorded = Verdict::holds;  ///< what README.md says of it
  std::string_view correction = {};   ///< fmt's format, with the arguments `computed` and `percent`
  Number corrected = nullptr;         ///< what the statement gives with the correction

  /// Not a number agrees with nothing.
  Finding examine() const;
};

/// Section 1, against Coulomb friction under Hertz pressure, integrated over the patch.
std::vector<Statement> patch_statements();

/// Section 2 up to (2.6) and the motion after the stop, against mechanics in vectors and the integrated equations of
/// motion: a pool ball with an oblique slip that spins about all three axes, in SI units.
std::vector<Statement> ball_statements();

/// Section 2 from (2.6) on, against the library's solution: from u = 1, v = 0.5.
std::vector<Statement> plane_statements(double mu);

}  // namespace contensou::program
