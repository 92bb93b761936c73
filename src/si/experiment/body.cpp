#include "contensou/si/body.hpp"

#include <stdexcept>

#include <fmt/format.h>

namespace contensou::si {

Body Body::with_factor(double of_m_R2) const {
  const bool flat = lies_flat();
  const double most = flat ? 1 : 2.0 / 3;
  constexpr double rounding = 1e-3;  // 0.667 is 2/3, which has no decimals that end
  if (of_m_R2 > most && of_m_R2 <= most * (1 + rounding)) of_m_R2 = most;
  if (!(of_m_R2 > 0 && of_m_R2 <= most)) {
    throw std::domain_error(fmt::format(
        "the inertia of a {}, over m R^2, must be above 0 and at most {}, as of a {} with R the radius; got {}", name,
        flat ? "1" : "2/3", flat ? "ring" : "hollow-ball", of_m_R2));
  }
  Body changed = *this;
  changed.factor = of_m_R2;
  changed.inertia = {.chi = flat ? 1 : 1 + 1 / of_m_R2, .gamma = 1 / of_m_R2};
  return changed;
}

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
