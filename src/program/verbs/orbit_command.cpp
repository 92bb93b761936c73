#include <fmt/format.h>

#include "contensou/si/bridge.hpp"
#include "options/instants.hpp"
#include "options/law_option.hpp"
#include "options/output_options.hpp"
#include "options/route_motion.hpp"
#include "options/route_option.hpp"
#include "options/start_options.hpp"
#include "output/columns.hpp"
#include "output/json.hpp"
#include "verb.hpp"

namespace contensou::program {

namespace {

constexpr long standard_samples = 200;
constexpr long most_samples = 10'000'000;

class OrbitCommand final : public Verb {
 public:
  void add_options(CLI::App& app) override {
    start_.add(app);
    law_.add(app);
    route_.add(app);
    CLI::Option* at =
        at_.add(app, "--at", "T1,T2,...|FILE",
                "these tau >= 0, in any order; FILE has a column tau, or one number a line", read_instants("tau"));
    samples_
        .add(app, "--samples", "N",
             fmt::format("instead: equidistant instants from the start to the stop, 2 or more (default {})",
                         standard_samples),
             whole_number(2, most_samples))
        ->excludes(at);
    output_.add(app);
  }

  ExitStatus run() override {
    const Output output = output_.read();
    const GivenStart start = start_.read();
    const reduction::ReducedSystem system = start.body.system(law_.read());
    const reduction::Route route = route_.read(system);
    const std::vector<Column> columns = make_columns(start, motion(system, start.state, route));
    output.write_as([&](int digits) { return columns_as_text(columns, digits); },
                    [&] { return columns_as_csv(columns); }, [&] { return document(start, system, route, columns); });
    return ExitStatus::done;
  }

 private:
  reduction::OrbitColumns motion(const reduction::ReducedSystem& system, reduction::State state,
                                 reduction::Route route) const {
    if (!at_.given()) return motion_samples(system, state, route, samples_.value_or(standard_samples));
    return motion_at(system, state, route, *at_);
  }

  static std::vector<Column> make_columns(const GivenStart& start, const reduction::OrbitColumns& motion) {
    std::vector<Column> columns{{"tau", motion.tau},   {"u", motion.u}, {"v", motion.v},
                                {"ln_v", motion.ln_v}, {"k", motion.k}, {"beta", motion.beta}};
    if (start.shot) {
      columns.push_back({"t", motion.tau.unaryExpr([&](double tau) { return si::seconds(*start.shot, tau); })});
    }
    return columns;
  }

  static std::string document(const GivenStart& start, const reduction::ReducedSystem& system, reduction::Route route,
                              const std::vector<Column>& columns) {
    JsonObject document = JsonObject::document();
    document.add("law", json(system.law().name()))
        .add("route", json(reduction::name(route)))
        .add("mu", json(start.body.mu))
        .add("u0", json(start.state.u))
        .add("v0", json(start.state.v));
    for (const auto& [name, values] : columns) document.add(name, json(values));
    return document.text();
  }

  StartOptions start_;
  LawOption law_;
  RouteOption route_;
  ArgumentOf<long> samples_;
  ArgumentOf<Eigen::ArrayXd> at_;
  OutputOptions output_{{{"an orbit", {"csv", "text", "json"}, "csv"}}};
};

const RegisteredVerb<OrbitCommand> registered("orbit",
                                              "The state along the motion: tau,u,v,ln_v,k,beta (and t for a ball)",
                                              "contensou orbit --mu 0.1 --u0 1 --v0 1 --samples 50");

}  // namespace

}  // namespace contensou::program
