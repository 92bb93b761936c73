#include "fit/student.hpp"

#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <catch2/catch.hpp>

using namespace contensou::fit;

TEST_CASE("quantiles are Boost's to 1e-13 for up to 1000 degrees of freedom, to 1e-12 for six million", "[route]") {
  const auto boosts = [](double n) { return boost::math::quantile(boost::math::students_t(n), 0.975); };
  for (int n = 1; n <= 1000; ++n) CHECK(student_quantile(n) == Approx(boosts(n)).epsilon(1e-13));
  for (double n : {12345.0, 1e5, 1e6, 6e6 + 1}) CHECK(student_quantile(n) == Approx(boosts(n)).epsilon(1e-12));
  CHECK(normal_quantile == Approx(boost::math::quantile(boost::math::normal(), 0.975)).epsilon(1e-15));
}
