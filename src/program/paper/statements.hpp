#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace contensou::program {

/// Verdict on a published statement after its recomputation.
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

/// The source of a statement other than the paper.
struct Source {
  std::string_view name;  ///< authors, journal or title, year
  std::string_view link;  ///< DOI or repository; empty if there is none
  std::string_view read;  ///< part that was read: "abstract", "code", "in textbooks" or "as cited"
};

/// A published statement as two numbers, or two functions of k, that must agree.
struct Statement {
  struct Number : std::function<double(double)> {
    using function::function;
    Number() = default;
    Number(double value) : function([value](double) { return value; }) {}  // NOLINT(google-explicit-constructor)
  };

  std::string_view equation, says;
  Number printed;               ///< number from the statement
  Number computed;              ///< number computed without the statement
  double allowed;               ///< largest difference, relative to max(1, |computed|)
  double at = 0;                ///< k or mu at which the numbers are compared
  std::string_view where = {};  ///< text that shows `at`: a format of fmt with the argument `at`
  Verdict recorded =
      Verdict::holds;                ///< verdict that is expected, for the paper by reduction/theory.md, section errata
  std::string_view correction = {};  ///< a format of fmt with the arguments `computed` and `percent`
  Number corrected = nullptr;        ///< number from the corrected statement
  Source source = {};                ///< empty for a statement of V. F. Zhuravlev, 1998 (Zh98)

  /// Compares the numbers. NaN never agrees.
  Finding examine() const;
};

/// A statement and its verdict.
struct Examined {
  Statement statement;
  Finding found = statement.examine();

  bool as_recorded() const { return found.verdict == statement.recorded; }
  std::string correction() const;
};

/// Returns published numbers of disc, ring and grains, and of a ball, a cue and a stone in textbooks.
std::vector<Statement> published_numbers();

/// Returns the statements of section 1, compared with Coulomb friction under Hertz pressure, integrated over the patch.
std::vector<Statement> patch_statements();

/// Returns the statements of section 2 up to (2.6), the equations of motion, and about the motion after the stop. They
/// are compared with mechanics in vector form and with integrated equations of motion. The example is a pool ball in SI
/// units with an oblique slip and a spin about all three axes.
std::vector<Statement> ball_statements();

/// Returns the statements of section 2 after (2.6), compared with the library's solution from u = 1, v = 0.5.
std::vector<Statement> plane_statements(double mu);

}  // namespace contensou::program
