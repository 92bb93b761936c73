#pragma once

#include <functional>
#include <optional>
#include <string_view>
#include <vector>

namespace contensou::program {

/// Verdict on a printed statement after its recomputation.
enum class Verdict {
  holds,     ///< the printed number equals the computed one
  erratum,   ///< only the corrected number equals the computed one
  not_true,  ///< neither number equals the computed one, and no correction of a detail helps
};

/// Returns the word for a verdict in the verb `paper`: holds, erratum or false.
std::string_view word(Verdict verdict);

/// The numbers that result from the examination of a statement.
struct Finding {
  double printed, computed;
  std::optional<double> corrected;
  Verdict verdict;
};

/// Value of Statement::allowed that marks a printed number as a lower bound.
constexpr double lower_bound = -1;

/// Differences allowed between two computations: `arithmetic` for formulas, `stepping` for an integration in steps.
constexpr double arithmetic = 1e-13, stepping = 1e-9;

/// A statement of V. F. Zhuravlev, 1998 (Zh98), as two numbers, or two functions of k, that must agree.
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
  double at = 0;                      ///< k or mu at which the numbers are compared
  std::string_view where = {};        ///< text that shows `at`: a format of fmt with the argument `at`
  Verdict recorded = Verdict::holds;  ///< verdict in reduction/README.md, section errata
  std::string_view correction = {};   ///< a format of fmt with the arguments `computed` and `percent`
  Number corrected = nullptr;         ///< number from the corrected statement

  /// Compares the numbers. NaN never agrees.
  Finding examine() const;
};

/// Returns the statements of section 1, compared with Coulomb friction under Hertz pressure, integrated over the patch.
std::vector<Statement> patch_statements();

/// Returns the statements of section 2 up to (2.6), the equations of motion, and about the motion after the stop. They
/// are compared with mechanics in vector form and with integrated equations of motion. The example is a pool ball in SI
/// units with an oblique slip and a spin about all three axes.
std::vector<Statement> ball_statements();

/// Returns the statements of section 2 after (2.6), compared with the library's solution from u = 1, v = 0.5.
std::vector<Statement> plane_statements(double mu);

}  // namespace contensou::program
