#include "contensou/si/ball_claims.hpp"

#include <cmath>
#include <functional>
#include <set>
#include <stdexcept>
#include <string>

#include <catch2/catch.hpp>

#include "contensou/si/catalogue.hpp"

using namespace contensou::si;
using contensou::reduction::PaperClaim;
using contensou::reduction::Verdict;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

using Names = std::set<std::string>;

Shot shot() {
  Shot shot = find_ball("pool")->shot;
  shot.start = Velocities{.velocity = {1, 0.3}, .angular_velocity = {20, -15, -60}};
  return shot;
}

Names changed(const std::function<void(PrintedBall&)>& lie, const Integration& integration = integrate_motion) {
  PrintedBall printed = printed_ball();
  lie(printed);
  Names names;
  for (const PaperClaim& claim : ball_claims(shot(), printed, integration)) {
    if (!claim.as_recorded()) names.insert(claim.equation + " " + claim.statement);
  }
  return names;
}

}  // namespace

TEST_CASE("(2.1) to (2.6) are as recorded", "[ball_claims][route]") {
  int slips = 0;
  for (const PaperClaim& claim : ball_claims(shot())) {
    CAPTURE(claim.equation, claim.statement, claim.evidence.printed, claim.evidence.computed);
    CHECK(claim.as_recorded());
    if (claim.found() != Verdict::slip) continue;
    ++slips;
    CHECK(claim.equation == "(2.4)");
    CHECK(claim.evidence.printed == Approx(-claim.evidence.computed).epsilon(1e-12));
    CHECK(claim.evidence.computed < 0);
  }
  CHECK(slips == 1);
}

TEST_CASE("each statement on the ball can fail", "[ball_claims]") {
  CHECK(changed([](PrintedBall&) {}).empty());
  Names caught;
  const auto gather = [&](const std::string& about, const Names& names) {
    CAPTURE(about);
    CHECK_FALSE(names.empty());
    caught.insert(names.begin(), names.end());
  };
  gather("another inertia", changed([](PrintedBall& p) { p.inertia = 0.41; }));
  gather("signs of (2.1)", changed([](PrintedBall& p) {
           p.contact_velocity = [](double R, const Vector2d& V, const Vector3d& omega) {
             return Vector2d(V.x() + R * omega.y(), V.y() - R * omega.x());
           };
         }));
  gather("a force along the slip", changed([](PrintedBall& p) {
           p.force = [truth = p.force](double fN, double eps, double spin, const Vector2d& c) {
             return Vector2d(-1.001 * truth(fN, eps, spin, c));
           };
         }));
  gather("a moment of the other hand", changed([](PrintedBall& p) {
           p.moment = [truth = p.moment](double fN, double eps, double R, double spin, double v, const Vector2d& F) {
             const Vector3d M = truth(fN, eps, R, spin, v, F);
             return Vector3d(-M.x(), -M.y(), 1.001 * M.z());
           };
         }));
  const Names repaired = changed([](PrintedBall& p) {
    p.moment = [truth = p.moment](double fN, double eps, double R, double spin, double v, const Vector2d& F) {
      const Vector3d M = truth(fN, eps, R, spin, v, F);
      return Vector3d(M.x(), M.y(), -M.z());
    };
  });
  gather("(2.4) as it should be", repaired);
  gather("rates that are all a little wrong", changed([](PrintedBall& p) {
           p.rates = [truth = p.rates](double mu, double R, double u, double v, double alpha) {
             Eigen::Matrix<double, 5, 1> rates = 1.0001 * truth(mu, R, u, v, alpha);
             rates[4] += 1e-4;
             return rates;
           };
         }));
  gather("a motion that drifts",
         changed([](PrintedBall&) {},
                 [](const Shot& of, const contensou::reduction::Law& law, const Eigen::ArrayXd& times) {
                   IntegratedMotion motion = integrate_motion(of, law, times);
                   const Eigen::ArrayXd drift = 1e-3 * times.square();
                   for (auto* column : {&motion.points.x, &motion.points.vx, &motion.points.vy, &motion.points.wx,
                                        &motion.points.wy, &motion.points.wz, &motion.points.slip}) {
                     *column += drift;
                   }
                   motion.points.y -= 2 * drift;
                   return motion;
                 }));
  for (const PaperClaim& claim : ball_claims(shot())) {
    CAPTURE(claim.equation, claim.statement);
    if (claim.equation == "(2.2)") continue;  // it defines v and alpha
    CHECK(caught.contains(claim.equation + " " + claim.statement));
  }
}

TEST_CASE("statements need a ball that can be", "[ball_claims][domain]") {
  Shot impossible = shot();
  impossible.ball.mass = -1;
  CHECK_THROWS_AS(ball_claims(impossible), std::domain_error);
}
