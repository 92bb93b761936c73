#include "contensou/si/body.hpp"

namespace contensou::si {

std::string Body::complaint(double mu) const {
  if (patch_ratio) return mu == *patch_ratio ? "" : "a puck rests on its whole face, so mu is 1: leave --mu out";
  if (rolls_on_a_small_patch) return mu > 0 && mu <= 1 ? "" : "0 < mu <= 1 is required";
  return mu > 0 ? "" : "mu > 0 is required";
}

const std::vector<Body>& bodies() {
  static const std::vector<Body> named{
      {},
      {.name = "hollow-ball", .inertia = {.chi = 2.5, .gamma = 1.5}},
      {"disc", {.chi = 1, .gamma = 2}, 1.0, false, "uniform"},
      {"puck", {.chi = 1, .gamma = 2}, 1.0, false, "uniform"},
      {"ring", {.chi = 1, .gamma = 1}, 1.0, false, "ring"},
  };
  return named;
}

}  // namespace contensou::si
