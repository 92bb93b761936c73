#include "contensou/reduction/regularised_motion.hpp"

#include <catch2/catch.hpp>

#include "stepper_checks.hpp"

using namespace contensou::reduction;
using namespace contensou::tests;

TEST_CASE("(2.7) in beta: states and stop time are those of the orbit", "[regularised_motion][route]") {
  check_states(integrate_regularised);
}

TEST_CASE("(2.7) in beta: every step is reported when no instants are", "[regularised_motion][route]") {
  check_every_step(integrate_regularised);
}

TEST_CASE("(2.7) in beta: the axes and rest", "[regularised_motion][limit]") {
  check_axes_and_rest(integrate_regularised);
}

TEST_CASE("(2.7) in beta: the unit of speed does not matter", "[regularised_motion][symmetry]") {
  contensou::tests::check_motion_scaling(integrate_regularised);
}

TEST_CASE("(2.7) in beta: a run that does not reach the stop says why", "[regularised_motion][domain]") {
  check_outcomes(integrate_regularised, "integrate_regularised");
}

TEST_CASE("(2.7) in beta: bad arguments are named", "[regularised_motion][domain]") {
  check_arguments(integrate_regularised, "integrate_regularised");
}
