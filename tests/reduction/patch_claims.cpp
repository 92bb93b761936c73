#include "contensou/reduction/patch_claims.hpp"

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <set>
#include <string>

#include <catch2/catch.hpp>

#include "contensou/reduction/hertz_law.hpp"

using namespace contensou::reduction;
using std::numbers::pi;

namespace {

using Names = std::set<std::string>;

/// The statements of a paper with other formulas whose verdicts are not those recorded.
Names changed(const std::function<void(PrintedPatch&)>& lie, const PatchTruth& truth = integrated_patch()) {
  PrintedPatch printed = printed_patch();
  lie(printed);
  Names names;
  for (const PaperClaim& claim : patch_claims(printed, truth)) {
    if (!claim.as_recorded()) names.insert(claim.equation + " " + claim.statement);
  }
  return names;
}

template <class Function>
Function scaled(const Function& function, double factor) {
  return [=](double k) { return factor * function(k); };
}

void nothing(PrintedPatch&) {}

}  // namespace

TEST_CASE("section 1 of the paper is as recorded", "[patch_claims][route]") {
  const auto claims = patch_claims();
  Names slips, untrue;
  for (const PaperClaim& claim : claims) {
    CAPTURE(claim.equation, claim.statement, claim.evidence.printed, claim.evidence.computed, claim.evidence.at);
    CHECK(claim.as_recorded());
    CHECK(claim.correction.empty() == (claim.recorded == Verdict::holds));
    if (claim.found() == Verdict::slip) slips.insert(claim.equation);
    if (claim.found() == Verdict::not_true) untrue.insert(claim.equation);
  }
  CHECK(slips == Names{"(1.2)", "M^h"});
  CHECK(untrue == Names{"(1.4)"});
}

TEST_CASE("the numbers of the slips of section 1", "[patch_claims][table]") {
  for (const PaperClaim& claim : patch_claims()) {
    const Evidence& at = claim.evidence;
    if (claim.equation == "(1.2)" && at.at == "k = 2") {
      CHECK(at.printed == Approx(1).epsilon(1e-12));
      CHECK(at.computed == Approx(HertzLaw{}({2, 1}).force).epsilon(1e-12));
    }
    if (claim.equation == "(1.2)" && at.at == "k = 0.5") CHECK(std::abs(at.printed) < 1e-12);
    if (claim.equation == "M^h" && claim.recorded == Verdict::slip) {
      CHECK(at.printed == Approx(3 * pi / 8).epsilon(1e-10));
      CHECK(at.computed == Approx(3 * pi / 16).epsilon(1e-10));
    }
    if (claim.recorded == Verdict::not_true) {
      CHECK(at.computed == Approx(0.3914).margin(5e-5));
      CHECK(at.at == "k = 0.9059");
    }
  }
}

TEST_CASE("each statement of section 1 can fail", "[patch_claims]") {
  CHECK(changed(nothing).empty());
  Names caught;
  const auto lie = [&](const std::string& about, const std::function<void(PrintedPatch&)>& how) {
    CAPTURE(about);
    const Names names = changed(how);
    CHECK_FALSE(names.empty());
    caught.insert(names.begin(), names.end());
  };
  constexpr double little = 1 + 1e-8;
  lie("another load", [](PrintedPatch& p) { p.pressure = scaled(p.pressure, 1.001); });
  lie("a pressure that is none",
      [](PrintedPatch& p) { p.pressure = [](double) { return std::numeric_limits<double>::quiet_NaN(); }; });
  lie("(1.3) inside", [=](PrintedPatch& p) { p.inner_force = scaled(p.inner_force, little); });
  lie("(1.3) outside", [=](PrintedPatch& p) { p.outer_force = scaled(p.outer_force, little); });
  lie("a kink of F",
      [](PrintedPatch& p) { p.outer_force = [outer = p.outer_force](double k) { return outer(k) + 1e-4 * (k - 1); }; });
  lie("(1.5) inside", [=](PrintedPatch& p) { p.inner_moment = scaled(p.inner_moment, little); });
  lie("(1.5) outside", [=](PrintedPatch& p) { p.outer_moment = scaled(p.outer_moment, little); });
  lie("a kink of M", [](PrintedPatch& p) {
    p.outer_moment = [outer = p.outer_moment](double k) { return outer(k) + 1e-4 * (k - 1); };
  });
  lie("the chord's ends", [](PrintedPatch& p) {
    p.chord_end = [](double k, double theta, double sign) {
      return k * std::cos(theta) + sign * std::sqrt(1 - k * std::sin(theta) * std::sin(theta));
    };
  });
  lie("(1.2) as it should be", [](PrintedPatch& p) { p.force_cosines = 1; });
  lie("M^h as it should be", [](PrintedPatch& p) { p.inner_moment_angle = pi; });
  lie("M^h outside", [](PrintedPatch& p) { p.outer_moment_factor = 1; });
  lie("the slope at 0", [](PrintedPatch& p) { p.slope_at_zero = 1.2; });
  lie("the coefficient at infinity", [](PrintedPatch& p) { p.deficit_at_infinity = 0.11; });
  lie("a Pade force of another slope and limit", [](PrintedPatch& p) { p.pade_force = scaled(p.pade_force, 1.001); });
  lie("a Pade moment of another value and decline",
      [](PrintedPatch& p) { p.pade_moment = scaled(p.pade_moment, 1.01); });
  lie("an approximation that is good",
      [](PrintedPatch& p) { p.pade_force = [](double k) { return HertzLaw{}(slip_of_ratio(k)).force; }; });

  // Friction that is none of a patch: sliding and pivoting do not know of each other.
  const Names uncoupled = changed(nothing, [](double) { return Resistance{1, 0.6}; });
  caught.insert(uncoupled.begin(), uncoupled.end());

  for (const PaperClaim& claim : patch_claims()) {
    CAPTURE(claim.equation, claim.statement);
    CHECK(caught.contains(claim.equation + " " + claim.statement));
  }
}
