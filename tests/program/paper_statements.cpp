#include "contensou/reduction/detail/infinity.hpp"
#include "paper/statements.hpp"

#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <catch2/catch.hpp>

#include "contensou/reduction/laws.hpp"
#include "contensou/reduction/reduced_system.hpp"
#include "paper/zh98.hpp"

using namespace contensou::program;
using contensou::reduction::HertzLaw;
using contensou::reduction::PadeLaw;
using contensou::reduction::ReducedSystem;
using contensou::reduction::slip_of_ratio;
using contensou::reduction::State;

namespace {

using contensou::infinity;
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

template <int tenths>
double number(double) {
  return tenths / 10.0;
}

Verdict verdict_of(Statement::Number printed, Statement::Number computed, double allowed,
                   Statement::Number corrected = nullptr) {
  Statement statement{"", "", printed, computed, allowed};
  statement.corrected = corrected;
  return statement.examine().verdict;
}

/// Returns the statement that begins with the given words.
Statement statement_of(const std::vector<Statement>& statements, std::string_view equation, std::string_view says) {
  for (const Statement& statement : statements) {
    if (statement.equation == equation && statement.says.starts_with(says)) return statement;
  }
  throw std::out_of_range(fmt::format("no statement {}: {}", equation, says));
}

Statement of_patch(std::string_view equation, std::string_view says) {
  return statement_of(patch_statements(), equation, says);
}

std::vector<Statement> all_statements() {
  std::vector<Statement> all = patch_statements();
  for (const auto& section : {ball_statements(), plane_statements(0.3)}) {
    all.insert(all.end(), section.begin(), section.end());
  }
  return all;
}

}  // namespace

TEST_CASE("a printed number holds, is an erratum, or is false") {
  CHECK(verdict_of(number<10>, number<10>, 0) == Verdict::holds);
  CHECK(verdict_of(
            number<10>, [](double) { return 1 + 1e-12; }, 1e-10) == Verdict::holds);
  CHECK(verdict_of(number<10>, number<11>, 1e-10) == Verdict::not_true);
  CHECK(verdict_of(number<10>, number<11>, 1e-10, number<11>) == Verdict::erratum);
  CHECK(verdict_of(number<10>, number<11>, 1e-10, number<12>) == Verdict::not_true);
  // the tolerance is relative if the numbers are large
  CHECK(verdict_of([](double) { return 1e6; }, [](double) { return 1e6 + 1e-5; }, 1e-10) == Verdict::holds);

  CHECK(verdict_of(number<20>, number<30>, lower_bound) == Verdict::holds);
  CHECK(verdict_of(number<20>, number<19>, lower_bound) == Verdict::not_true);

  const auto none = [](double) { return not_a_number; };
  CHECK(verdict_of([](double) { return infinity; }, number<10>, 1e-10, number<10>) == Verdict::erratum);
  CHECK(verdict_of(none, number<10>, 1e-10) == Verdict::not_true);
  CHECK(verdict_of(number<10>, none, 1e-10) == Verdict::not_true);
  CHECK(verdict_of(number<10>, none, lower_bound) == Verdict::not_true);
}

TEST_CASE("every statement of the paper is as recorded", "[route]") {
  std::map<Verdict, int> count;
  for (const Statement& statement : all_statements()) {
    const Finding found = statement.examine();
    CAPTURE(statement.equation, statement.says, found.printed, found.computed);
    CHECK(found.verdict == statement.recorded);
    CHECK(statement.correction.empty() == (statement.recorded == Verdict::holds));
    ++count[found.verdict];
  }
  CHECK(count[Verdict::holds] == 71);
  CHECK(count[Verdict::erratum] == 6);
  CHECK(count[Verdict::not_true] == 3);
}

TEST_CASE("the statements on the plane are as recorded at other mu", "[route]") {
  for (double mu : {0.05, 0.9}) {
    for (const Statement& statement : plane_statements(mu)) {
      CAPTURE(mu, statement.says);
      CHECK(statement.examine().verdict == statement.recorded);
    }
  }
}

TEST_CASE("the printed formulas of the patch hold at every ratio", "[route]") {
  const std::vector<Statement> statements = patch_statements();
  for (const char* equation : {"(1.3)", "(1.5)"}) {
    const char* of = equation == std::string("(1.3)") ? "F for " : "M for ";
    const Statement inner = statement_of(statements, equation, of + std::string("k <= 1"));
    const Statement outer = statement_of(statements, equation, of + std::string("k > 1"));
    for (double k : {0.02, 0.1, 0.9, 0.999, 1.001, 1.1, 10.0, 100.0}) {
      Statement statement = k <= 1 ? inner : outer;
      statement.at = k;
      CAPTURE(statement.says, k);
      CHECK(statement.examine().verdict == Verdict::holds);
    }
  }
}

TEST_CASE("the printed equations of the plane are the reduced system of the Pade ball", "[route]") {
  constexpr double eps = std::numeric_limits<double>::epsilon();
  for (double mu : {1e-6, 1e-3, 0.1, 0.7, 1.0, 3.0}) {
    const ReducedSystem system(PadeLaw{}, mu, contensou::reduction::homogeneous_ball);
    for (double u : {-1e8, -2.0, -1e-6, 1e-6, 0.3, 5.0}) {
      for (double v : {1e-12, 1e-3, 0.5, 7.0, 1e9}) {
        const State state{u, v};
        CAPTURE(mu, u, v);
        CHECK(zh98::field(mu, state).u == Approx(system.field(state).u).epsilon(8 * eps));
        CHECK(zh98::field(mu, state).v == Approx(system.field(state).v).epsilon(8 * eps));
        CHECK(zh98::regularised_field(mu, state).u == Approx(system.regularised_field(state).u).epsilon(8 * eps));
        CHECK(zh98::regularised_field(mu, state).v == Approx(system.regularised_field(state).v).epsilon(8 * eps));
        CHECK(zh98::weight(mu, state) == Approx(system.regularising_weight(state)).epsilon(8 * eps));
        CHECK(zh98::slope(mu, state) == Approx(system.slope(state)).epsilon(8 * eps));
      }
    }
    for (const State axis : {State{2, 0}, State{-2, 0}, State{0, 2}}) {
      CHECK(zh98::field(mu, axis).u == Approx(system.field(axis).u).epsilon(8 * eps));
      CHECK(zh98::field(mu, axis).v == Approx(system.field(axis).v).epsilon(8 * eps));
    }
  }
}

// A statement would test nothing if no change of its numbers changed the verdict.
TEST_CASE("another number, printed or found, changes the verdict of every statement") {
  static Statement::Number right;
  const Statement::Number off = [](double at) { return 1.002 * right(at) + 1e-3; };
  const Statement::Number far_below = [](double at) { return 0.01 * right(at) - 0.01; };
  const auto changed = [&](Statement statement, Statement::Number Statement::*member, Statement::Number wrong) {
    right = statement.*member;
    statement.*member = wrong;
    return statement.examine().verdict != statement.recorded;
  };
  for (const Statement& statement : all_statements()) {
    CAPTURE(statement.equation, statement.says);
    if (statement.allowed == lower_bound) {
      CHECK(changed(statement, &Statement::computed, far_below));
    } else if (statement.recorded == Verdict::not_true) {
      CHECK(changed(statement, &Statement::computed, statement.printed));
    } else {
      CHECK(changed(statement, &Statement::computed, off));
      const bool erratum = statement.recorded == Verdict::erratum;
      CHECK(changed(statement, erratum ? &Statement::corrected : &Statement::printed, off));
    }
  }
}

TEST_CASE("a formula that is right but for its ninth digit is found") {
  const auto verdict = [](Statement statement, Statement::Number printed) {
    statement.printed = printed;
    return statement.examine().verdict;
  };
  CHECK(verdict(of_patch("(1.3)", "F for k <= 1"), [](double k) { return (1 + 1e-8) * zh98::inner_force(k); }) ==
        Verdict::not_true);
  CHECK(verdict(of_patch("(1.5)", "M for k > 1"), [](double k) { return (1 + 1e-8) * zh98::outer_moment(k); }) ==
        Verdict::not_true);
}

TEST_CASE("the numbers of the errata", "[table]") {
  const Finding outside = of_patch("(1.2)", "k > 1").examine();
  CHECK(outside.printed == Approx(1).epsilon(1e-12));
  CHECK(outside.computed == Approx(HertzLaw{}({2, 1}).force).epsilon(1e-12));
  CHECK(std::abs(of_patch("(1.2)", "k <= 1").examine().printed) < 1e-12);
  const Finding moment = of_patch("M^h", "k <= 1").examine();
  CHECK(moment.printed == Approx(3 * zh98::pi / 8).epsilon(1e-10));
  CHECK(moment.computed == Approx(3 * zh98::pi / 16).epsilon(1e-10));
  const Statement approximation = of_patch("(1.4)", "approximates");
  CHECK(approximation.examine().computed == Approx(0.3914).margin(5e-5));
  CHECK(approximation.at == Approx(0.9059).margin(5e-5));

  const Finding power = statement_of(ball_statements(), "(2.4)", "M_z").examine();
  CHECK(power.printed == Approx(-power.computed).epsilon(1e-12));
  CHECK(power.computed < 0);
  CHECK(statement_of(plane_statements(0.3), "(2.7)", "every solution has v").examine().computed ==
        Approx(-14 / (5 * 0.09)).epsilon(1e-6));
}
