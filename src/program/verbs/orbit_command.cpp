#include "contensou/si/bridge.hpp"
#include "options/instants_option.hpp"
#include "options/law_option.hpp"
#include "options/output_options.hpp"
#include "options/route_option.hpp"
#include "options/start_options.hpp"
#include "verb.hpp"

namespace contensou::program {

namespace {

class OrbitCommand final : public Verb {
 public:
  void add_options(CLI::App& app) override {
    start_.add(app);
    law_.add(app);
    route_.add(app);
    instants_.add(app, "tau", "", " from the start to the stop");
    output_.add(app);
  }

  ExitStatus run() override {
    const Output output = output_.read();
    const GivenStart start = start_.read(law_.read(start_.body()));
    const reduction::ReducedSystem& system = start.system;
    const reduction::Route route = route_.read(system);
    const auto* at = instants_.at();
    const reduction::OrbitColumns motion = at != nullptr
                                               ? motion_at(system, start.state, route, *at)
                                               : motion_samples(system, start.state, route, instants_.samples());
    Answer answer{.members = {{"law", system.law().name()},
                              {"route", name(route)},
                              {"mu", system.mu()},
                              {"u0", start.state.u},
                              {"v0", start.state.v}},
                  .columns = {{"tau", motion.tau},
                              {"u", motion.u},
                              {"v", motion.v},
                              {"ln_v", motion.ln_v},
                              {"k", motion.k},
                              {"beta", motion.beta}}};
    if (start.shot) {
      answer.columns.push_back({"t", motion.tau.unaryExpr([&](double tau) { return si::seconds(*start.shot, tau); })});
    }
    output.write(answer);
    return ExitStatus::done;
  }

 private:
  StartOptions start_;
  LawOption law_;
  RouteOption route_;
  InstantsOption instants_;
  OutputOptions output_{{{"an orbit", answer_formats("csv")}}};
};

const RegisteredVerb<OrbitCommand> orbit_verb("orbit",
                                              "The state along the motion: tau,u,v,ln_v,k,beta (and t for a ball)",
                                              "contensou orbit --mu 0.1 --u0 1 --v0 1 --samples 50");

}  // namespace

}  // namespace contensou::program
