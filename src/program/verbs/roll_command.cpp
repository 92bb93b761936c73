#include <optional>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "contensou/si/bridge.hpp"
#include "contensou/si/nearest_name.hpp"
#include "contensou/si/whole_motion.hpp"
#include "options/instants.hpp"
#include "options/law_option.hpp"
#include "options/output_options.hpp"
#include "options/roll_route.hpp"
#include "options/start_options.hpp"
#include "output/columns.hpp"
#include "output/json.hpp"
#include "output/picture.hpp"
#include "verb.hpp"
#include "verbs/roll_drawing.hpp"
#include "verbs/roll_report.hpp"

namespace contensou::program {

namespace {

constexpr long standard_samples = 200;
constexpr long most_samples = 10'000'000;

class RollCommand final : public Verb {
 public:
  void add_options(CLI::App& app) override {
    start_.add_ball(app);
    velocity_.add(app, "--velocity", "VX,VY", "velocity of the centre in m/s, instead of the start's",
                  [](const std::string& typed) { return Eigen::Vector2d(parts(typed, 2, "VX,VY").data()); });
    angular_velocity_.add(app, "--angular-velocity", "WX,WY,WZ",
                          "angular velocity in rad/s, z up, instead of the start's",
                          [](const std::string& typed) { return Eigen::Vector3d(parts(typed, 3, "WX,WY,WZ").data()); });
    law_.add(app);
    route_.add(app, "--route", "ROUTE",
               "reduced: the similarity solution (default), or integrated: the five equations of motion (2.5)",
               one_of<RollRoute>({{"reduced", RollRoute::reduced}, {"integrated", RollRoute::integrated}}, "route"));
    CLI::Option* at =
        at_.add(app, "--at", "T1,T2,...|FILE",
                "these t >= 0 in s, in any order; FILE has a column t, or one number a line", read_instants("t"));
    samples_
        .add(app, "--samples", "N",
             fmt::format("instead: equidistant instants, 2 or more (default {})", standard_samples),
             whole_number(2, most_samples))
        ->excludes(at);
    until_.add(app, "--until", "T", "the last of them, in s (default: a little past the stop)", parse_end)
        ->excludes(at);
    output_.add(app);
  }

  ExitStatus run() override {
    const Output output = output_.read();
    const si::Shot shot = read_shot();
    const reduction::Law law = law_.read();
    const RollRoute route = route_.value_or(RollRoute::reduced);
    const std::optional<double> until = until_.given() ? std::optional(*until_) : std::nullopt;
    if (const auto picture = output.picture()) {
      if (at_.given() || samples_.given()) throw BadInput("a picture needs no --at or --samples: leave them out");
      output.write(drawn(portraits::roll_figure(roll_drawing(shot, law, route, until)), *picture));
      return ExitStatus::done;
    }
    const bool summary = output.format == "text" && !at_.given() && !samples_.given() && !until;
    const std::vector<Column> columns =
        summary ? std::vector<Column>{} : make_columns(roll_motion(shot, law, route, instants(shot, law, until)));
    output.write_as(
        [&](int digits) { return summary ? roll_report(shot, law, route, digits) : columns_as_text(columns, digits); },
        [&] { return columns_as_csv(columns); }, [&] { return document(shot, law, route, columns); });
    return ExitStatus::done;
  }

 private:
  si::Shot read_shot() const {
    si::StartOverride start;
    if (velocity_.given()) start.velocity = *velocity_;
    if (angular_velocity_.given()) start.angular_velocity = *angular_velocity_;
    const bool both_ways = (start.velocity || start.angular_velocity) && start_.overrides_start();
    if (both_ways) {
      throw BadInput("--slip, --spin and --velocity, --angular-velocity exclude each other: give one pair of them");
    }
    return start_.read_ball(start);
  }

  static std::vector<double> parts(const std::string& typed, std::size_t count, const char* names) {
    std::vector<double> values = parse_numbers(typed);
    if (values.size() != count) throw NotAllowed(fmt::format("{} numbers are needed, {}", count, names));
    return values;
  }

  static double parse_end(const std::string& typed) {
    const double end = parse_number(typed);
    if (!(end > 0)) throw NotAllowed("a time after the start is needed, in s");
    return end;
  }

  Eigen::ArrayXd instants(const si::Shot& shot, const reduction::Law& law, std::optional<double> until) const {
    if (!at_.given()) {
      return Eigen::ArrayXd::LinSpaced(samples_.value_or(standard_samples), 0, until.value_or(standard_end(shot, law)));
    }
    return *at_;
  }

  static std::vector<Column> make_columns(const si::MotionColumns& motion) {
    return {{"t", motion.t},   {"x", motion.x},   {"y", motion.y},   {"vx", motion.vx},     {"vy", motion.vy},
            {"wx", motion.wx}, {"wy", motion.wy}, {"wz", motion.wz}, {"slip", motion.slip}, {"energy", motion.energy}};
  }

  static std::string document(const si::Shot& shot, const reduction::Law& law, RollRoute route,
                              const std::vector<Column>& columns) {
    const si::Velocities start = si::velocities_of(shot.start);
    JsonObject document = JsonObject::document();
    document.add("law", json(law.name()))
        .add("route", json(name_of(route)))
        .add("mu", json(si::patch_ratio(shot)))
        .add("velocity", json(Eigen::ArrayXd(start.velocity)))
        .add("angular_velocity", json(Eigen::ArrayXd(start.angular_velocity)))
        .add("t_stop", json(si::WholeMotion(shot, law).stop_time()));
    for (const auto& [name, values] : columns) document.add(name, json(values));
    return document.text();
  }

  StartOptions start_;
  ArgumentOf<Eigen::Vector2d> velocity_;
  ArgumentOf<Eigen::Vector3d> angular_velocity_;
  LawOption law_;
  ArgumentOf<RollRoute> route_;
  ArgumentOf<long> samples_;
  ArgumentOf<double> until_;
  ArgumentOf<Eigen::ArrayXd> at_;
  OutputOptions output_{{{"a motion", with_pictures({"csv", "text", "json"}), "csv"}}};
};

const RegisteredVerb<RollCommand> registered(
    "roll", "The whole motion of a ball: t,x,y,vx,vy,wx,wy,wz,slip,energy",
    "contensou roll --ball pool --velocity 1,0 --angular-velocity 40,35,-50 --format text");

}  // namespace

}  // namespace contensou::program
