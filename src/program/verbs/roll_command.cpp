#include <optional>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "commands.hpp"
#include "contensou/si/bridge.hpp"
#include "contensou/si/nearest_name.hpp"
#include "contensou/si/whole_motion.hpp"
#include "options/law_option.hpp"
#include "options/output_options.hpp"
#include "options/roll_route.hpp"
#include "options/start_options.hpp"
#include "output/columns.hpp"
#include "output/json.hpp"
#include "output/picture.hpp"
#include "verbs/roll_drawing.hpp"
#include "verbs/roll_report.hpp"

namespace contensou::program {

namespace {

constexpr long standard_samples = 200;
constexpr long most_samples = 10'000'000;

class RollCommand final : public Command {
 public:
  std::string name() const override { return "roll"; }
  std::string summary() const override { return "The whole motion of a ball: t,x,y,vx,vy,wx,wy,wz,slip,energy"; }
  std::string example() const override {
    return "contensou roll --ball pool --velocity 1,0 --angular-velocity 40,35,-50 --format text";
  }

  void add_options(CLI::App& app) override {
    start_.add_ball(app);
    velocity_.add(app, "--velocity", "VX,VY", "velocity of the centre in m/s, instead of the start's");
    angular_velocity_.add(app, "--angular-velocity", "WX,WY,WZ",
                          "angular velocity in rad/s, z up, instead of the start's");
    law_.add(app);
    route_.add(app, "--route", "ROUTE",
               "reduced: the similarity solution (default), or integrated: the five equations of motion (2.5)");
    samples_.add(app, "--samples", "N", fmt::format("equidistant instants, 2 or more (default {})", standard_samples));
    until_.add(app, "--until", "T", "the last of them, in s (default: a little past the stop)");
    at_.add(app, "--at", "T1,T2,...", "instead: these t >= 0 in s, in any order");
    output_.add(app);
  }

  ExitStatus run() override {
    const si::Shot shot = read_shot();
    const reduction::Law law = law_.read();
    const RollRoute route = read_route();
    const std::optional<double> until = read_until();
    if (const auto picture = portraits::find_picture_format(ending(output_.path()))) {
      if (output_.format_given() || at_.given() || samples_.given()) {
        throw BadInput("a picture needs no --format, --at or --samples: leave them out");
      }
      output_.write(drawn(portraits::roll_figure(roll_drawing(shot, law, route, until)), *picture));
      return ExitStatus::done;
    }
    const bool summary = data_format() == Format::text && !at_.given() && !samples_.given() && !until;
    const std::vector<Column> columns =
        summary ? std::vector<Column>{} : make_columns(roll_motion(shot, law, route, instants(shot, law, until)));
    output_.write_as(
        data_format(),
        [&](int digits) { return summary ? roll_report(shot, law, route, digits) : columns_as_text(columns, digits); },
        [&] { return columns_as_csv(columns); }, [&] { return document(shot, law, route, columns); });
    return ExitStatus::done;
  }

 private:
  si::Shot read_shot() const {
    si::StartOverride start;
    if (velocity_.given()) start.velocity = Eigen::Vector2d(parts(velocity_, 2, "VX,VY").data());
    if (angular_velocity_.given()) {
      start.angular_velocity = Eigen::Vector3d(parts(angular_velocity_, 3, "WX,WY,WZ").data());
    }
    const bool both_ways = (start.velocity || start.angular_velocity) && start_.overrides_start();
    if (both_ways) {
      throw BadInput("--slip, --spin and --velocity, --angular-velocity exclude each other: give one pair of them");
    }
    return start_.read_ball(start);
  }

  static std::vector<double> parts(const Argument& argument, std::size_t count, const char* names) {
    std::vector<double> values = argument.numbers();
    if (values.size() != count) argument.reject(fmt::format("{} numbers are needed, {}", count, names));
    return values;
  }

  RollRoute read_route() const {
    if (!route_.given()) return RollRoute::reduced;
    if (const auto route = find_roll_route(route_.text())) return *route;
    route_.reject(fmt::format("no such route{}; routes: {}", si::suggestion(route_.text(), roll_route_names),
                              fmt::join(roll_route_names, ", ")));
  }

  std::optional<double> read_until() const {
    if (!until_.given()) return std::nullopt;
    const double end = until_.number();
    if (!(end > 0)) until_.reject("a time after the start is needed, in s");
    if (at_.given()) throw BadInput("--at and --until exclude each other: give one of them");
    return end;
  }

  /// --format, or else what the ending of -o says.
  Format data_format() const {
    return !output_.format_given() && output_.path().ends_with(".json") ? Format::json : output_.format();
  }

  Eigen::ArrayXd instants(const si::Shot& shot, const reduction::Law& law, std::optional<double> until) const {
    if (!at_.given()) {
      const long count = samples_.given() ? samples_.integer(2, most_samples) : standard_samples;
      return Eigen::ArrayXd::LinSpaced(count, 0, until.value_or(standard_end(shot, law)));
    }
    if (samples_.given()) throw BadInput("--at and --samples exclude each other: give one of them");
    const std::vector<double> times = at_.numbers();
    for (double t : times) {
      if (t < 0) at_.reject(fmt::format("{} is before the start: t >= 0 is required, in s", t));
    }
    return Eigen::Map<const Eigen::ArrayXd>(times.data(), static_cast<Eigen::Index>(times.size()));
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
  Argument velocity_, angular_velocity_;
  LawOption law_;
  Argument route_, samples_, until_, at_;
  OutputOptions output_{Format::csv};
};

}  // namespace

std::unique_ptr<Command> make_roll_command() { return std::make_unique<RollCommand>(); }

}  // namespace contensou::program
