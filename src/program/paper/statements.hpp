#pragma once

#include <functional>
#include <optional>
#include <string_view>
#include <vector>

namespace contensou::program {

/// Verdict of a recomputation on a printed statement.
enum class Verdict {
  holds,     ///< the printed number equals the computed one
  erratum,   ///< only the corrected number equals the computed one
  not_true,  ///< neither does, and no correction of a detail helps
};

/// Returns the word for a verdict in the verb `paper`: holds, erratum or false.
std::string_view word(Verdict verdict);

/// Numbers of an examined statement.
struct Finding {
  double printed, computed;
  std::optional<double> corrected;
  Verdict verdict;
};

/// Value of Statement::allowed for a printed number that is a lower bound.
constexpr double lower_bound = -1;

/// Differences allowed between two computations: by plain arithmetic, and by steps through a differential equation.
constexpr double arithmetic = 1e-13, stepping = 1e-9;

/// A statement of Zh98 as two numbers, or two functions of k, that must agree.
struct Statement {
  struct Number : std::function<double(double)> {
    using function::function;
    Number() = default;
    Number(double value) : function([value](double) { return value; }) {}  // NOLINT(google-explicit-constructor)
  };

  std::string_view equation, says;
  Number printed;                     ///< number from the statement
  Number computed;                    ///< number computed without the statement
  double allowed;                     ///< largest difference, relative to max(1, |computed|)
  double at = 0;                      ///< k, or mu, at which they are compared
  std::string_view where = {};        ///< text for `at`: fmt's format, with `at` as its argument
  Verdict recorded = Verdict::holds;  ///< verdict in README.md
  std::string_view correction = {};   ///< fmt's format, with the arguments `computed` and `percent`
  Number corrected = nullptr;         ///< number from the corrected statement

  /// Compares the numbers. NaN agrees with nothing.
  Finding examine() const;
};

/// Returns the statements of section 1, compared with Coulomb friction under Hertz pressure, integrated over the patch.
std::vector<Statement> patch_statements();

/// Returns the statements of section 2 up to (2.6) and on the motion after the stop, compared with mechanics in vectors
/// and integrated equations of motion. A pool ball has an oblique slip and spins about all three axes, in SI units.
std::vector<Statement> ball_statements();

/// Returns the statements of section 2 from (2.6) on, compared with the library's solution from u = 1, v = 0.5.
std::vector<Statement> plane_statements(double mu);

}  // namespace contensou::program
