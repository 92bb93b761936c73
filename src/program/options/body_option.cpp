#include "options/body_option.hpp"

#include <string>
#include <vector>

#include <fmt/format.h>

#include "exit_status.hpp"

namespace contensou::program {

namespace {

const Choices<Body>& bodies() {
  static const Choices<Body> named{
      {"ball", {}},
      {"hollow-ball", {.inertia = {.chi = 2.5, .gamma = 1.5}}},
      {"disc", {{.chi = 1, .gamma = 2}, 1.0, false}},
      {"ring", {{.chi = 1, .gamma = 1}, 1.0, false}},
  };
  return named;
}

/// A name, or two numbers.
Body parse_body(const std::string& typed) {
  if (typed.find(',') == std::string::npos) {
    try {
      return one_of(bodies(), "body")(typed);
    } catch (const NotAllowed& error) {
      throw NotAllowed(fmt::format("{}, or two numbers CHI,GAMMA", error.what()));
    }
  }
  const std::vector<double> ratios = parse_numbers(typed);
  if (ratios.size() != 2) throw NotAllowed("two numbers are needed: CHI,GAMMA");
  if (!(ratios[0] > 0 && ratios[1] > 0)) throw NotAllowed("chi and gamma must be positive");
  return {{.chi = ratios[0], .gamma = ratios[1]}, std::nullopt, false};
}

}  // namespace

std::string Body::complaint(double mu) const {
  if (patch_ratio) return mu == *patch_ratio ? "" : "a puck rests on its whole face, so mu is 1: leave --mu out";
  if (rolls_on_a_small_patch) return mu > 0 && mu <= 1 ? "" : "0 < mu <= 1 is required";
  return mu > 0 ? "" : "mu > 0 is required";
}

void BodyOption::add(CLI::App& app) {
  body_.add(
      app, "--body", "BODY",
      "ball (default), hollow-ball, disc or ring (flat pucks that cannot roll: mu = 1), or CHI,GAMMA: chi = 1 + m "
      "R^2/J about a horizontal axis (1: cannot roll), gamma = m R^2/J_z",
      parse_body);
}

double BodyOption::read_patch_ratio(const ArgumentOf<double>& mu, const Body& body) {
  if (!mu.given()) {
    if (body.patch_ratio) return *body.patch_ratio;
    throw BadInput("--mu missing: give --mu M, or a --body that lies flat, disc or ring");
  }
  if (const std::string complaint = body.complaint(*mu); !complaint.empty()) mu.reject(complaint);
  return *mu;
}

void add_patch_ratio(ArgumentOf<double>& mu, CLI::App& app) {
  mu.add(app, "--mu", "M", "patch ratio, patch radius/R; a ball: 0 < M <= 1, another body: M > 0 (disc, ring: 1)",
         number);
}

}  // namespace contensou::program
