#include "options/start_options.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "contensou/si/bridge.hpp"
#include "exit_status.hpp"

namespace contensou::program {

namespace {

std::string option_name(const si::Quantity& quantity) {
  std::string name = fmt::format("--{}", quantity.name);
  std::ranges::replace(name, '_', '-');
  return name;
}

bool is_file(const std::string& ball) { return ball.find('/') != std::string::npos || ball.ends_with(".toml"); }

}  // namespace

const si::CatalogueEntry& require_ball(const std::string& name) {
  if (const si::CatalogueEntry* entry = si::find_ball(name)) return *entry;
  std::vector<std::string> names;
  for (const si::CatalogueEntry& entry : si::catalogue()) names.push_back(entry.name);
  throw no_such("ball", name, names);
}

void StartOptions::add(CLI::App& app) {
  add_patch_ratio(mu_, app);
  u0_.add(app, "--u0", "U", "pivoting R omega_z at the start, either sign, in any unit of speed", number);
  v0_.add(app, "--v0", "V", "sliding speed at the start, >= 0, in the unit of --u0", [](const std::string& typed) {
    const double v0 = parse_number(typed);
    if (v0 < 0) throw NotAllowed("a sliding speed is >= 0; turn the axes so that the ball slides along x");
    return v0;
  });
  body_.add(app);
  add_ball(app, "instead of these four: a ball in SI units, built in or from a run file");
}

void StartOptions::add_ball(CLI::App& app) { add_ball(app, "a ball in SI units, built in or from a run file"); }

void StartOptions::add_ball(CLI::App& app, const std::string& help) {
  ball_.add(app, "--ball", "NAME|FILE.toml", help);
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    const si::Quantity& quantity = *quantities[i];
    overrides_[i].add(app, option_name(quantity), quantity.unit.empty() ? "X" : std::string(quantity.unit),
                      fmt::format("with --ball: {}", quantity.meaning), [&quantity](const std::string& typed) {
                        const double value = parse_number(typed);
                        try {
                          si::require(quantity, value);
                        } catch (const std::domain_error& error) {
                          throw NotAllowed(error.what());
                        }
                        return value;
                      });
  }
}

std::string StartOptions::override_names() const {
  std::vector<const Argument*> arguments;
  for (const Argument& argument : overrides_) arguments.push_back(&argument);
  return names_given(arguments);
}

std::string StartOptions::given_names() const {
  const std::string first = names_given({&mu_, &u0_, &v0_, &ball_});
  const std::string others = override_names();
  return first + (first.empty() || others.empty() ? "" : ", ") + others;
}

void StartOptions::require_one_kind() const {
  const std::string reduced = names_given({&mu_, &u0_, &v0_});
  if (ball_.given() && !reduced.empty()) {
    throw BadInput(fmt::format("{} and {} exclude each other: with --ball, use --patch-radius, --spin and --slip",
                               ball_.typed(), reduced));
  }
  if (ball_.given() && body_.given()) {
    body_.reject("--ball is a homogeneous ball already: with another body give --mu, --u0 and --v0");
  }
  if (!ball_.given() && !override_names().empty()) {
    throw BadInput(fmt::format("{} changes a ball: add --ball NAME|FILE.toml", override_names()));
  }
}

GivenStart StartOptions::read() const {
  require_one_kind();
  if (ball_.given()) {
    const si::Shot shot = read_ball();
    return {{si::patch_ratio(shot), reduction::homogeneous_ball}, si::reduced_start(shot), shot};
  }
  std::vector<std::string> missing;
  if (!mu_.given() && !body_.read().patch_ratio) missing.push_back(mu_.name());
  for (const Argument* argument : {&u0_, &v0_}) {
    if (!argument->given()) missing.push_back(argument->name());
  }
  if (!missing.empty()) {
    throw BadInput(
        fmt::format("{} missing: a start is --mu M --u0 U --v0 V, or --ball NAME|FILE.toml", fmt::join(missing, ", ")));
  }
  return {read_body(), {.u = *u0_, .v = *v0_}, std::nullopt};
}

GivenBody StartOptions::read_body() const {
  require_one_kind();
  if (ball_.given()) return {si::patch_ratio(read_ball()), reduction::homogeneous_ball};
  const Body body = body_.read();
  if (!mu_.given() && !body.patch_ratio) {
    throw BadInput("--mu missing: give --mu M, --ball NAME|FILE.toml, or a --body that lies flat, disc or ring");
  }
  return {BodyOption::read_patch_ratio(mu_, body), body.inertia};
}

bool StartOptions::overrides_start() const {
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    if ((quantities[i] == &si::slip || quantities[i] == &si::spin) && overrides_[i].given()) return true;
  }
  return false;
}

si::Shot StartOptions::read_ball(const si::StartOverride& start) const {
  if (!ball_.given()) throw BadInput("--ball missing: give --ball NAME|FILE.toml");
  si::Overrides overrides;
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    if (overrides_[i].given()) overrides[quantities[i]->name] = *overrides_[i];
  }
  if (overrides.contains(si::patch_radius.name) && overrides.contains(si::spin_deceleration.name)) {
    throw BadInput("--patch-radius and --spin-deceleration exclude each other: give one of them");
  }
  try {
    return read_shot(overrides, start);
  } catch (const si::RunFileError&) {
    throw;
  } catch (const NotAllowed& error) {
    ball_.reject(fmt::format("{}; a file needs a / or the ending .toml", error.what()));
  } catch (const std::domain_error& error) {  // of the values together, not of a place in a file
    const std::string others = override_names();
    ball_.reject((others.empty() ? "" : fmt::format("with {}: ", others)) + error.what());
  }
}

si::Shot StartOptions::read_shot(const si::Overrides& overrides, const si::StartOverride& start) const {
  if (is_file(ball_.text())) return si::read_run_file(ball_.text(), overrides, start);
  const si::CatalogueEntry& entry = require_ball(ball_.text());
  return si::parse_run_file(si::run_file(entry.shot, entry.sources), "built-in ball " + entry.name, overrides, start);
}

}  // namespace contensou::program
