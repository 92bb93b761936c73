#include "contensou/si/scaling.hpp"
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
    CLI::Option* at = instants_.add(app, "tau", "", " from the start to the stop");
    time_left_
        .add(app, "--time-left", "T1,T2,...|FILE",
             "instead: so much tau before the stop, and a column tau_left; FILE has that column",
             [](const std::string& typed) { return InstantsOption::read_times(typed, "tau_left"); })
        ->excludes(at);
    output_.add(app);
  }

  ExitStatus run() override {
    const Output output = output_.read();
    const GivenStart start = start_.read(law_.read(start_.body()));
    const reduction::ReducedSystem& system = start.system;
    const reduction::Route route = route_.read(system);
    if (time_left_.given() && instants_.given()) {
      throw BadInput("--time-left and --samples, --equidistant exclude each other: give one of them");
    }
    const auto* at = instants_.at();
    const reduction::OrbitColumns motion =
        time_left_.given() ? motion_at_time_left(system, start.state, route, *time_left_)
        : at != nullptr    ? motion_at(system, start.state, route, *at)
                           : motion_samples(system, start.state, route, instants_.samples(), instants_.equidistant());
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
    if (time_left_.given()) answer.columns.push_back({"tau_left", *time_left_});
    if (start.experiment) {
      answer.columns.push_back(
          {"t", motion.tau.unaryExpr([&](double tau) { return si::seconds(*start.experiment, tau); })});
    }
    output.write(answer);
    return ExitStatus::done;
  }

 private:
  StartOptions start_;
  LawOption law_;
  RouteOption route_;
  InstantsOption instants_;
  ArgumentOf<Eigen::ArrayXd> time_left_;
  OutputOptions output_{{{"an orbit", answer_formats("csv")}}};
};

const RegisteredVerb<OrbitCommand> orbit_verb("orbit",
                                              "The state along the motion: tau,u,v,ln_v,k,beta (and t for a ball)",
                                              "contensou orbit --mu 0.1 --u0 1 --v0 1 --samples 50");

}  // namespace

}  // namespace contensou::program
