#include "options/start_options.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "answers/asked/formula_law.hpp"
#include "answers/input/tables.hpp"
#include "contensou/si/scaling.hpp"
#include "output/help.hpp"

namespace contensou::program {

namespace {

/// Reads a body: a name, or its two numbers of inertia.
Body parse_body(const std::string& typed) {
  if (typed.find(',') == std::string::npos) {
    try {
      Choices<Body> named;
      for (const Body& body : si::bodies()) named.emplace_back(body.name, body);
      return one_of(named, "body")(typed);
    } catch (const NotAllowed& error) {
      throw NotAllowed("{}, or two numbers CHI,GAMMA", error.what());
    }
  }
  const std::vector<double> ratios = numbers(typed, 2, "CHI,GAMMA");
  if (!(ratios[0] > 0 && ratios[1] > 0)) throw NotAllowed("chi and gamma must be positive");
  return {"", {.chi = ratios[0], .gamma = ratios[1]}, std::nullopt, false};
}

std::string option_of(const si::Quantity& quantity) {
  std::string name = fmt::format("--{}", quantity.name);
  std::ranges::replace(name, '_', '-');
  return name;
}

}  // namespace

void BodyOptions::add_mu(CLI::App& app) {
  const auto read = [this](const std::string& typed) {
    const std::vector<std::string> parts = takes_several_mu_ ? split(typed, ',') : std::vector{typed};
    for (std::size_t i = 1; i < parts.size(); ++i) more_mu_.push_back(number(parts[i]));
    return number(parts.front());
  };
  mu_.add(app, "--mu", takes_several_mu_ ? "M,..." : "M",
          std::string("value of mu, 0 < M <= 1; a disc or ring has mu = 1") +
              (takes_several_mu_ ? ". Several values give as many portraits, side by side" : ""),
          read);
}

void BodyOptions::add_body(CLI::App& app) {
  body_.add(app, "--body", "BODY",
            "kind of body: ball (default), hollow-ball, disc, puck, ring, or its inertia as CHI,GAMMA ('contensou help "
            "ball')",
            parse_body);
}

void BodyOptions::add_drive(CLI::App& app) {
  app.option_defaults()->group("Start");
  drive_.add(app, "--drive", "RHO", "constant force along the slip divided by f N, 0 <= RHO < 1",
             [](const std::string& typed) {
               const double drive = number(typed);
               if (drive >= 1) throw NotAllowed("a drive of 1 is as strong as friction, so the body never stops");
               if (drive < 0)
                 throw NotAllowed("a drive against the slip turns it round, which is no orbit: 0 or more is needed");
               if (drive > 0 && drive < reduction::ReducedSystem::least_drive)
                 throw NotAllowed("0, or {} or more is needed", reduction::ReducedSystem::least_drive);
               return drive;
             });
}

reduction::ReducedSystem BodyOptions::read_system(const reduction::Law& law, const std::string& ways) const {
  if (!mu_.given() && !body().patch_ratio) {
    throw BadInput("--mu missing: give {}, or a --body that lies flat, disc or ring", ways);
  }
  const double mu = mu_.given() ? *mu_ : *body().patch_ratio;
  if (const std::string complaint = body().complaint(mu); !complaint.empty()) mu_.reject(complaint);
  return {law, mu, body().inertia, drive_.value_or(0)};
}

const si::CatalogueEntry& require_ball(const std::string& name) {
  if (const si::CatalogueEntry* entry = si::find_ball(name)) return *entry;
  std::vector<std::string> names;
  for (const si::CatalogueEntry& entry : si::catalogue()) names.push_back(entry.name);
  throw NotAllowed(no_such("ball", name, names, false));
}

std::string ball_group() { return shared_group("Values that replace those of --ball", "ball"); }

void StartOptions::add(CLI::App& app) {
  app.option_defaults()->group("Start");
  add_mu(app);
  u0_.add(app, "--u0", "U", "u at the start, of either sign, in any unit of speed", number);
  v0_.add(app, "--v0", "V", "v at the start, 0 or more, in the unit of --u0", number);
  add_body(app);
  add_ball(app);
}

void StartOptions::add_ball(CLI::App& app, const std::string& help, Offer offer) {
  app.option_defaults()->group("Start");
  ball_.add(app, "--ball", "NAME|FILE.toml", help);
  ball_.excludes({&mu(), &drive(), &u0_, &v0_},
                 "with --ball, use --patch-radius, --spin and --slip, and for a drive --rolling-friction or --slope");
  ball_.excludes({&body_argument()},
                 takes_own_body_
                     ? "the body is part of --ball; a body of your own has no --ball, but --radius, --mass and "
                       "--friction"
                     : "the body is part of --ball. A disc or ring in SI units is a run file with body = "
                       "\"disc\" in [ball] ('contensou balls puck' prints one); without --ball give --mu, "
                       "--u0 and --v0");
  app.option_defaults()->group(ball_group());
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const si::Quantity& quantity = *si::quantities()[i];
    if (!offer(quantity)) continue;
    const bool may_be_table = takes_load_history_ && &quantity == &si::load;
    const auto read = [&quantity, may_be_table](const std::string& typed) {
      if (&quantity == &si::load && names_a_file(typed, {".csv"})) {
        if (may_be_table) return std::vector<double>{};
        throw NotAllowed("only roll, stop and orbit take a load that changes; give a number, in N");
      }
      const std::string components(quantity.components);
      const std::vector<double> values = quantity.count() == 1
                                             ? std::vector{parse_quantity(typed, quantity.unit)}
                                             : numbers(typed, quantity.count(), components, quantity.unit);
      try {
        for (double value : values) si::require(quantity, value);
      } catch (const std::domain_error& error) {
        throw NotAllowed(error.what());
      }
      return values;
    };
    const si::Dimension* dimension = si::find_dimension(quantity.unit);
    const std::string value_name(quantity.count() > 1 ? quantity.components : dimension ? dimension->name : "X");
    values_[i].add(app, option_of(quantity), may_be_table ? value_name + "|FILE.csv" : value_name,
                   fmt::format("{}{}{}", quantity.meaning, dimension ? fmt::format(", in {}", dimension->words) : "",
                               may_be_table ? ". FILE.csv has columns t and load, for a load that changes" : ""),
                   read);
    of_ball_.push_back(&values_[i]);
    if (quantity.section == si::slip.section) velocities_.push_back(&values_[i]);
    if (radius_is_ball_) continue;
    constexpr const char* reason = "changes a ball or puck ('contensou balls' lists them)";
    if (takes_own_body_) {
      values_[i].needs(ball_, reason, value(si::radius));
    } else {
      values_[i].needs(ball_, reason);
    }
    if (takes_own_body_ && &quantity == &si::radius)
      values_[i].excludes({&mu(), &drive(), &u0_, &v0_}, "a body in SI units has --patch-radius, --spin and --slip");
  }
}

GivenStart StartOptions::read(const reduction::Law& law) const {
  if (ball_given()) {
    const si::Experiment experiment = read_ball(law);
    try {
      (void)si::drive_of(experiment);  // throws with the reason if the motion has no reduced system
      const si::Motion motion = si::Motion::reduced(experiment, law);
      if (!motion.is_reduced()) {
        throw std::domain_error(
            "slope and rolling resistance drive the slip as much as friction holds it, or more, for a while: the whole "
            "motion (roll) is integrated");
      }
      const reduction::State state = si::reduced_start(experiment);
      const bool moves = state.u != 0 || state.v != 0;
      return {moves ? motion.pieces().front().flow.system() : si::undriven_system(experiment, law), state, experiment,
              motion};
    } catch (const std::domain_error& error) {
      reject_ball(error.what());
    }
  }
  std::vector<std::string> missing;
  if (!mu().given() && !body().patch_ratio) missing.push_back(mu().name());
  for (const Argument* argument : {&u0_, &v0_}) {
    if (!argument->given()) missing.push_back(argument->name());
  }
  if (!missing.empty()) {
    throw BadInput("{} missing: a start is --mu M --u0 U --v0 V, or --ball NAME|FILE.toml", fmt::join(missing, ", "));
  }
  if (*v0_ < 0) v0_.reject("a sliding speed is >= 0; turn the axes so that the ball slides along x");
  return {read_system(law), {.u = *u0_, .v = *v0_}, std::nullopt};
}

std::vector<GivenStart> StartOptions::read_several(const reduction::Law& law) const {
  std::vector<GivenStart> starts{without_motion() ? GivenStart{read_body(law), {}, std::nullopt} : read(law)};
  for (double ratio : more_mu()) {
    if (const std::string complaint = body().complaint(ratio); !complaint.empty()) mu().reject(complaint);
    GivenStart other = starts.front();
    other.system = {law, ratio, other.system.inertia(), other.system.drive()};
    starts.push_back(std::move(other));
  }
  return starts;
}

reduction::ReducedSystem StartOptions::read_body(const reduction::Law& law) const {
  if (ball_given()) return read(law).system;
  return read_system(law, "--mu M, --ball NAME|FILE.toml");
}

const si::Description& StartOptions::ball_of_its_own() const {
  if (own_) return *own_;
  if (!ball_.given() && radius_is_ball_) {
    if (const auto& given = value(si::radius); given.given()) {
      // Friction and patch radius are only first guesses of a fit.
      own_ = si::describe(si::Experiment{.ball = {.name = "ball", .radius = given->front()},
                                         .contact = {.friction = 0.2, .patch = si::PatchRadius{0.1 * given->front()}},
                                         .start = si::SlipAndSpin{.slip = 0, .spin = 0}});
      return *own_;
    }
    throw BadInput("--ball missing: give --ball NAME|FILE.toml, or --radius");
  }
  if (!ball_.given() && ball_given()) {
    own_.emplace();
    own_->set_body(body());
    own_->set_name(body_argument().given() ? body_argument().text() : "ball");
    return *own_;
  }
  if (!ball_.given()) {
    throw BadInput("--ball missing: give --ball NAME|FILE.toml{}",
                   body_argument().given() ? ", or --radius, --mass and --friction" : "");
  }
  try {
    own_ = names_a_file(ball_.text(), {".toml"}) ? si::read_run_file(ball_.text(), find_law_or_formulas)
                                                 : si::describe(require_ball(ball_.text()).experiment);
  } catch (const NotAllowed& error) {
    ball_.reject(fmt::format("{}; a file needs a / or the ending .toml", error.what()));
  }
  return *own_;
}

si::Description StartOptions::given_values() const {
  si::Description given;
  for (std::size_t i = 0; i < values_.size(); ++i) {
    if (!values_[i].given()) continue;
    const auto history = si::quantities()[i] == &si::load ? load_history() : std::nullopt;
    given.set(*si::quantities()[i], history ? std::vector{history->nominal()} : *values_[i],
              {"", values_[i].name(), ""});
  }
  return given;
}

const ArgumentOf<std::vector<double>>& StartOptions::value(const si::Quantity& quantity) const {
  return values_[static_cast<std::size_t>(std::ranges::find(si::quantities(), &quantity) - si::quantities().begin())];
}

std::optional<si::LoadHistory> StartOptions::load_history() const {
  const auto& argument = value(si::load);
  if (!argument.given() || !argument->empty()) return std::nullopt;
  if (!load_history_) load_history_ = read_load_history(argument.text());
  return load_history_;
}

si::Experiment StartOptions::read_ball(const reduction::Law& law, const si::Description& between) const {
  const si::Description given = given_values();
  // A slip or a spin replaces all velocities of [start]. Every other option replaces its own number or vector.
  const bool slip_given = given.find(si::slip) != nullptr, spin_given = given.find(si::spin) != nullptr;
  const bool starts_anew = (slip_given || spin_given) && ball_.given() && names_a_file(ball_.text(), {".toml"}) &&
                           ball_of_its_own().find(si::velocity) != nullptr;
  const si::Description own = starts_anew ? ball_of_its_own().under(at_rest("")) : ball_of_its_own();
  try {
    given.require_no_contradiction();
  } catch (const std::domain_error& error) {
    throw BadInput(error.what());
  }
  try {
    const si::Description described = own.under(between).under(given);
    const si::Experiment experiment = si::experiment_of(described);
    tell_new_patch(experiment, law);
    if (starts_anew && slip_given != spin_given) {
      fmt::print(stderr, "note: {} replaces [start] of {}; the rest of the start is 0\n", names_given(velocities_),
                 ball_.text());
    }
    return experiment;
  } catch (const si::RunFileError&) {
    throw;
  } catch (const std::domain_error& error) {  // the error concerns several values and has no line in a file
    reject_ball(error.what());
  }
}

void StartOptions::reject_ball(const std::string& message) const {
  const std::string others = names_given(of_ball_);
  if (!ball_.given()) throw BadInput("{}: {}", others, message);
  ball_.reject((others.empty() ? "" : fmt::format("with {}: ", others)) + message);
}

double StartOptions::drive_along_x(si::Experiment ball) const {
  ball.start = si::SlipAndSpin{1, 0};
  try {
    return si::drive_of(ball);
  } catch (const std::domain_error& error) {
    reject_ball(error.what());
  }
}

void StartOptions::require_undriven(const si::Experiment& experiment, const std::string& what) const {
  try {
    si::require_undriven(experiment, what);
  } catch (const std::domain_error& error) {
    reject_ball(fmt::format("{}; --rolling-friction 0 --slope 0 leaves them out", error.what()));
  }
}

si::Experiment StartOptions::read_rolling_ball(const reduction::Law& law, const std::string& way_out,
                                               const si::Description& between) const {
  const si::Experiment experiment = read_ball(law, between);
  if (!experiment.ball.body.lies_flat()) return experiment;
  reject_ball(fmt::format("a {} lies flat and never rolls; {}", experiment.ball.body.name, way_out));
}

std::string StartOptions::standard_law() const {
  return ball_given() ? si::law_of(ball_of_its_own()) : std::string(body().law);
}

bool StartOptions::brings_law() const {
  return (ball_given() && !ball_of_its_own().law().empty()) || standard_law() != Body{}.law;
}

void StartOptions::tell_new_patch(const si::Experiment& experiment, const reduction::Law& law) const {
  const auto* measured = std::get_if<si::SpinDeceleration>(&experiment.contact.patch);
  if (measured == nullptr) return;  // experiment_of has checked the patch radius
  const double patch = si::patch_radius_of(experiment, law);
  const bool of_start_alone = names_given(of_ball_) == names_given(velocities_) && law.name() == standard_law();
  if (of_start_alone || value(si::spin_deceleration).given()) return;
  double own = 0;
  try {
    const si::Experiment before = si::experiment_of(ball_of_its_own().under(at_rest("")));
    own = si::patch_radius_of(before, *find_law_or_formulas(si::law_of(before)));
  } catch (const std::domain_error&) {
    return;  // the file leaves this value to an option
  }
  if (std::abs(patch - own) <= 1e-12 * own) return;
  fmt::print(stderr,
             "note: the patch radius goes from {:.6g} m to {:.6g} m: what was measured is the spin deceleration,\n"
             "{} rad/s^2, and it is kept; --patch-radius {:.6g} keeps the patch instead\n",
             own, patch, measured->value, own);
}

void StartOptions::tell_spreads_left_out(const si::Experiment& experiment) const {
  std::vector<std::string> left_out;
  for (const auto& [of, standard] : ball_of_its_own().spreads().numbers) {
    if (!experiment.spreads.place(of)) left_out.push_back(of.name());
  }
  if (left_out.empty()) return;
  fmt::print(stderr, "note: fit leaves out {}: the file has its spread, and the command line another value\n",
             fmt::join(left_out, ", "));
}

void StartOptions::tell_left_out() const {
  const si::CatalogueEntry* entry = ball_.given() ? si::find_ball(ball_.text()) : nullptr;
  if (entry && !entry->left_out.empty()) fmt::print(stderr, "note: {}\n", entry->left_out);
}

si::Description at_rest(const std::string& source) {
  si::Description still;
  for (const si::Quantity* quantity : {&si::slip, &si::spin}) still.set(*quantity, {0}, {"", source, ""});
  return still;
}

}  // namespace contensou::program
