#include "options/body_option.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "contensou/si/nearest_name.hpp"
#include "exit_status.hpp"

namespace contensou::program {

namespace {

const std::vector<std::pair<std::string, Body>>& bodies() {
  static const std::vector<std::pair<std::string, Body>> named{
      {"ball", {reduction::homogeneous_ball, std::nullopt, true}},
      {"hollow-ball", {{.chi = 2.5, .gamma = 1.5}, std::nullopt, true}},
      {"disc", {{.chi = 1, .gamma = 2}, 1.0, false}},
      {"ring", {{.chi = 1, .gamma = 1}, 1.0, false}},
  };
  return named;
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
      "R^2/J about a horizontal axis (1: cannot roll), gamma = m R^2/J_z");
}

double BodyOption::read_patch_ratio(const Argument& mu, const Body& body) {
  if (!mu.given()) {
    if (body.patch_ratio) return *body.patch_ratio;
    throw BadInput("--mu missing: give --mu M, or a --body that lies flat, disc or ring");
  }
  const double value = mu.number();
  if (const std::string complaint = body.complaint(value); !complaint.empty()) mu.reject(complaint);
  return value;
}

Body BodyOption::read() const {
  if (!body_.given()) return bodies().front().second;
  const std::string& text = body_.text();
  const auto named = std::ranges::find(bodies(), text, &std::pair<std::string, Body>::first);
  if (named != bodies().end()) return named->second;
  if (text.find(',') != std::string::npos) {
    const std::vector<double> ratios = body_.numbers();
    if (ratios.size() != 2) body_.reject("two numbers are needed: CHI,GAMMA");
    if (!(ratios[0] > 0 && ratios[1] > 0)) body_.reject("chi and gamma must be positive");
    return {{.chi = ratios[0], .gamma = ratios[1]}, std::nullopt, false};
  }
  std::vector<std::string> names;
  for (const auto& [name, body] : bodies()) names.push_back(name);
  body_.reject(fmt::format("no such body{}; bodies: {}, or two numbers CHI,GAMMA", si::suggestion(text, names),
                           fmt::join(names, ", ")));
}

}  // namespace contensou::program
