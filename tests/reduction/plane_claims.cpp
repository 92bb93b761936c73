#include "contensou/reduction/plane_claims.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <string>

#include <catch2/catch.hpp>

#include "contensou/reduction/hertz_law.hpp"
#include "contensou/reduction/pade_law.hpp"
#include "lying_curve.hpp"

using namespace contensou::reduction;
using namespace contensou::tests;

namespace {

using Names = std::set<std::string>;
const State start{1, 0.5};

Names changed(const std::vector<PaperClaim>& claims) {
  Names names;
  for (const PaperClaim& claim : claims) {
    if (!claim.as_recorded()) names.insert(claim.equation + " " + claim.statement);
  }
  return names;
}

Names changed(const ReducedSystem& system, const PrintedPlane& printed) {
  return changed(plane_claims(system, start, printed));
}

Names changed(const std::function<void(PrintedPlane&)>& lie) {
  PrintedPlane printed = printed_plane();
  lie(printed);
  return changed(ReducedSystem(PadeLaw{}, 0.3), printed);
}

struct BoundTooLow : PadeLaw {
  static constexpr SlidingShare sliding_share{1, 1.01};
};

struct WrongDeficit : PadeLaw {
  double moment_deficit(Slip slip) const { return 1.001 * PadeLaw::moment_deficit(slip); }
};

/// A kink that the panels of the expansion do not know.
struct Kinked : PadeLaw {
  Resistance operator()(Slip slip) const {
    auto [force, moment] = PadeLaw::operator()(slip);
    const double distance = std::abs(std::log(2 * slip.sliding / slip.pivoting));
    return {force * (1 + 0.1 * std::max(0.0, 1 - distance)), moment};
  }
};

}  // namespace

TEST_CASE("section 2 of the paper is as recorded, in the plane", "[plane_claims][route]") {
  for (double mu : {0.05, 0.3, 0.9}) {
    int slips = 0, untrue = 0;
    for (const PaperClaim& claim : plane_claims({PadeLaw{}, mu}, start)) {
      CAPTURE(mu, claim.equation, claim.statement, claim.evidence.printed, claim.evidence.computed);
      CHECK(claim.as_recorded());
      CHECK(claim.correction.empty() == (claim.recorded == Verdict::holds));
      slips += claim.found() == Verdict::slip;
      untrue += claim.found() == Verdict::not_true;
    }
    CHECK(slips == 2);
    CHECK(untrue == 2);
  }
}

TEST_CASE("v falls with the exponent that the slip hides", "[plane_claims][table]") {
  for (const PaperClaim& claim : plane_claims({PadeLaw{}, 0.3}, start)) {
    if (claim.statement.find("v ~ 1/beta") == std::string::npos) continue;
    CHECK(claim.evidence.computed == Approx(-14 / (5 * 0.09)).epsilon(1e-6));
  }
}

TEST_CASE("each statement of section 2 can fail", "[plane_claims]") {
  CHECK(changed([](PrintedPlane&) {}).empty());
  Names caught;
  const auto gather = [&](const std::string& about, const Names& names) {
    CAPTURE(about);
    CHECK_FALSE(names.empty());
    caught.insert(names.begin(), names.end());
  };
  const auto lie = [&](const std::string& about, const std::function<void(PrintedPlane&)>& how) {
    gather(about, changed(how));
  };
  const auto lie_of_curve = [&](const std::string& about, double mu, CurveLie told) {
    const ReducedSystem system(PadeLaw{}, mu);
    gather(about, changed(plane_claims(system, start, printed_plane(), lying_solution(system, std::move(told)))));
  };
  lie("(2.6) with u in place of |u|", [](PrintedPlane& p) {
    p.field = [truth = p.field](double mu, State s) { return truth(mu, {std::abs(s.u), s.v}); };
  });
  lie("(2.6) that depends on the speeds", [](PrintedPlane& p) {
    p.field = [truth = p.field](double mu, State s) {
      const Rate rate = truth(mu, s);
      return Rate{rate.u, rate.v * (1 + 1e-6 * s.v)};
    };
  });
  lie("another dv/du",
      [](PrintedPlane& p) { p.slope = [truth = p.slope](double mu, State s) { return 1.0001 * truth(mu, s); }; });
  lie("a field whose solutions are all ~ 1/beta", [](PrintedPlane& p) {
    p.regularised_field = [](double, State s) { return Rate{-s.u * s.u, -s.u * s.v}; };
  });
  lie("another weight",
      [](PrintedPlane& p) { p.weight = [truth = p.weight](double mu, State s) { return 1.0001 * truth(mu, s); }; });
  gather("another law", changed(ReducedSystem(HertzLaw{}, 0.3), printed_plane()));
  gather("a bound that is too low", changed(ReducedSystem(BoundTooLow{}, 0.3), printed_plane()));
  gather("a moment deficit that is wrong", changed(ReducedSystem(WrongDeficit{}, 0.3), printed_plane()));
  gather("an expansion that is wrong", changed(ReducedSystem(Kinked{}, 0.3), printed_plane()));

  CurveLie told;
  told.sliding_share = [](double, double truth) { return 1.000001 * truth; };
  lie_of_curve("a stop time that is wrong", 0.3, told);
  told = {};
  told.log_rim = [](double ln_k, double truth) { return truth + 0.01 * std::sin(ln_k / 50); };
  lie_of_curve("v that falls by fits and starts", 0.3, told);
  told = {};
  told.sliding_share = [](double ln_k, double truth) { return ln_k < -1 ? -ln_k * std::exp(-ln_k) : truth; };
  lie_of_curve("u that falls faster and faster", 1, told);
  told = {};
  told.regularised_age = [](double ln_k, double truth) { return truth * (1 + std::abs(ln_k)); };
  lie_of_curve("beta that grows faster than 1/u", 1, told);
  told.regularised_age = [](double, double) { return 0.0; };
  lie_of_curve("beta that does not grow", 1, told);
  told.regularised_age = [](double ln_k, double truth) { return ln_k < -1 ? truth * std::exp(-ln_k) : truth; };
  lie_of_curve("beta that grows like 1/v", 1, told);

  for (const PaperClaim& claim : plane_claims({PadeLaw{}, 0.3}, start)) {
    CAPTURE(claim.equation, claim.statement);
    CHECK(caught.contains(claim.equation + " " + claim.statement));
  }
}
