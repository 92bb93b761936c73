#include "contensou/reduction/direct_motion.hpp"

#include <catch2/catch.hpp>

#include "stepper_checks.hpp"

using namespace contensou::reduction;
using namespace contensou::tests;

TEST_CASE("(2.6) in tau: states and stop time are those of the orbit", "[direct_motion][route]") {
  check_states(integrate_directly);
}

TEST_CASE("(2.6) in tau: every step is reported when no instants are", "[direct_motion][route]") {
  check_every_step(integrate_directly);
}

TEST_CASE("(2.6) in tau: the axes and rest", "[direct_motion][limit]") { check_axes_and_rest(integrate_directly); }

TEST_CASE("(2.6) in tau: the unit of speed does not matter", "[direct_motion][symmetry]") {
  contensou::tests::check_motion_scaling(integrate_directly);
}

TEST_CASE("(2.6) in tau: a run that does not reach the stop says why", "[direct_motion][domain]") {
  check_outcomes(integrate_directly, "integrate_directly");
}

TEST_CASE("(2.6) in tau: bad arguments are named", "[direct_motion][domain]") {
  check_arguments(integrate_directly, "integrate_directly");
}
