#include "answers/input/track_file.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "answers/input/tables.hpp"
#include "text/nearest_name.hpp"

namespace contensou::answers {

namespace {

constexpr std::string_view deviation = "_sd";
constexpr const char* frame = "frame";
/// Name of the spin in CSV output of a motion.
constexpr const char* spin_of_motion = "wz";

struct SeriesColumns {
  fit::Observable observable;
  SiColumn value;
  std::optional<SiColumn> sd;
};

/// Returns the units in which numbers up to `largest` are usual for a film; empty if the SI unit is usual.
/// @param jump  largest difference of successive numbers
std::vector<std::string> likelier_units(std::string_view unit, double largest, double jump) {
  if (unit == "rad") {
    // Whole turns are unknown, so two successive angles in rad differ by at most a turn.
    constexpr double many = 100, turn = 2 * std::numbers::pi;
    return largest > many || jump > turn ? std::vector<std::string>{"deg"} : std::vector<std::string>{};
  }
  constexpr double fastest = 500;  // rad/s
  if (unit == "rad/s") return largest > fastest ? std::vector<std::string>{"deg/s", "rpm"} : std::vector<std::string>{};
  // A film shows 5 cm to 20 m, and speeds of 5 cm/s to 20 m/s. A picture has up to 10 000 pixels.
  constexpr double too_much = 30;
  if (largest < too_much) return {};
  std::vector<std::string> units;
  for (const auto& [name, least, most] : {std::tuple{"cm", 5.0, 2e3}, {"mm", 50.0, 2e4}, {"px", 0.0, 1e4}}) {
    if (largest >= least && largest <= most) units.push_back(name + std::string(unit.substr(1)));
  }
  return units.empty() ? std::vector{fmt::format("m{}", unit)} : units;
}

/// Returns a question if the numbers of a column without a unit are unusual in the SI unit; else "".
std::string unit_doubt(const SeriesColumns& of, const fit::Series& series) {
  if (!of.value.unit.empty()) return "";
  double largest = 0, jump = 0, before = NAN;
  for (double value : series.value) {
    if (std::isnan(value)) continue;
    largest = std::max(largest, std::abs(value));
    if (!std::isnan(before)) jump = std::max(jump, std::abs(value - before));
    before = value;
  }
  const std::string_view unit = fit::kind_of(of.observable).unit;
  const std::vector<std::string> units = likelier_units(unit, largest, jump);
  if (units.empty()) return "";
  const std::string& name = of.value.column.name;
  std::string asked, headings;
  for (std::size_t i = 0; i < units.size(); ++i) {
    const char* const between = i == 0 ? "" : i + 1 == units.size() ? " or " : ", ";
    asked += between + units[i];
    headings += fmt::format("{}'{} [{}]'", between, name, units[i]);
  }
  return fmt::format("{} is up to {:.4g} {}; is it in {}? Then call it {}", name, largest, unit, asked, headings);
}

}  // namespace

bool is_measured(std::string_view field) {
  field = without_spaces(field);
  for (std::string_view nothing : {"", "-", "nan", "NaN", "NAN", "NA"}) {
    if (field == nothing) return false;
  }
  return true;
}

std::vector<std::string> observable_names() {
  std::vector<std::string> names;
  for (const fit::ObservableKind& kind : fit::observable_kinds()) names.emplace_back(kind.name);
  return names;
}

std::string observable_name(std::string_view column) {
  const std::string name = usual_name(column);
  return name == spin_of_motion ? std::string(fit::kind_of(fit::Observable::spin).name) : name;
}

fit::Track read_track(CsvReader& table, const std::string& track_name, const TrackRequest& request,
                      const std::function<void(const std::string&)>& note, Unused* unused) {
  const auto fail = [&](const std::string& message) { throw table.complaint(table.header_line(), message); };
  const auto column = [&](const std::string& name, std::string_view si_unit) {
    return find_column(table, name, si_unit, request.pixel);
  };

  auto time = column("t", "s");
  if (const auto frames = column(frame, "s"); frames && !time) {
    if (!frames->unit.empty()) fail("frames are numbers, without a unit");
    if (!request.fps) fail("frames are numbered here: --fps N says how many are in a second");
    time = frames;
    time->factor = 1 / *request.fps;
    if (unused != nullptr) unused->fps = false;
  }
  std::vector<SeriesColumns> columns;
  for (const auto& [observable, name, unit, meaning] : fit::observable_kinds()) {
    std::string called(name);
    auto value = column(called, unit);
    if (observable == fit::Observable::spin) {
      if (const auto other = column(spin_of_motion, unit); other && !value) value = other, called = spin_of_motion;
    }
    auto sd = column(called + std::string(deviation), unit);
    if (value && sd && sd->unit.empty()) sd->factor = value->factor;
    if (value) columns.push_back({observable, *value, sd});
    if (!value && sd)
      fail(fmt::format("column {0}{1} is the standard deviation of {0}, which is not there", called, deviation));
  }
  std::set<std::string> unread;
  for (std::size_t i = 0; i < table.names().size(); ++i) {
    const auto is_it = [&](const std::optional<SiColumn>& each) { return each && each->column.place == i; };
    const bool is_read = is_it(time) || std::ranges::any_of(columns, [&](const SeriesColumns& each) {
                           return is_it(each.value) || is_it(each.sd);
                         });
    if (!is_read) unread.insert(heading_of(table.names()[i]).name);
  }
  if (!time || columns.empty()) {
    std::vector<std::string> known{"t", frame, spin_of_motion};
    for (const std::string& name : observable_names()) known.push_back(name);
    std::string hints;
    for (const std::string& name : unread) {
      if (const std::string nearest = nearest_name(name, known); !nearest.empty())
        hints += fmt::format("; {} is not read: did you mean '{}'?", quotation(name), nearest);
    }
    std::vector<std::string> found;
    for (const std::string& name : table.names()) found.push_back(quotation(name));
    fail(
        fmt::format("a track has a column t and one or more of {}, each with NAME{} where its errors are known; "
                    "no {} here, but {}{}",
                    fmt::join(observable_names(), ", "), deviation, time ? "other column of these is" : "t is",
                    fmt::join(found, ", "), hints));
  }
  const bool in_pixels = std::ranges::any_of(columns, [](const auto& each) { return is_in_pixels(each.value); });
  if (unused != nullptr && in_pixels) unused->pixel = false;
  for (const std::string& name : unread)
    note(fmt::format("{}: column {} is not read", escaped(track_name), quotation(name)));

  fit::Track track{.name = track_name};
  std::vector<double> t;
  std::vector<std::vector<double>> values(columns.size()), deviations(columns.size());
  double last = -INFINITY;
  table.for_each_row([&](const CsvRow& row) {
    const double now = time->factor * table.number(row, time->column);
    if (now <= last) throw table.complaint(row.line(), fmt::format("t must increase: {} follows {}", now, last));
    last = now;
    const bool left_out = now < request.from.value_or(-INFINITY) || now > request.until.value_or(INFINITY);
    if (!left_out) t.push_back(now);
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const auto& [observable, value, sd] = columns[i];
      const bool measured = is_measured(row[value.column.place]);
      const double number = measured ? value.factor * table.number(row, value.column) : NAN;
      double error = 1;
      if (sd && measured) {
        if (!is_measured(row[sd->column.place]))
          throw table.complaint(row.line(),
                                fmt::format("{}: empty beside a {} that was measured: give its error, or leave "
                                            "both empty",
                                            sd->column.name, value.column.name));
        error = sd->factor * table.number(row, sd->column);
      }
      if (!(error > 0)) {
        throw table.complaint(row.line(),
                              fmt::format("{}: a standard deviation > 0 is required, got {}", sd->column.name, error));
      }
      if (left_out) continue;
      values[i].push_back(number);
      if (sd) deviations[i].push_back(error);
    }
  });
  if (t.empty()) throw BadInput("{}: no row has a time between --from and --until", escaped(track_name));
  const auto array = [](const std::vector<double>& numbers) {
    return Eigen::ArrayXd(Eigen::Map<const Eigen::ArrayXd>(numbers.data(), static_cast<Eigen::Index>(numbers.size())));
  };
  track.t = array(t);
  track.start = request.from.value_or(t.front());
  for (std::size_t i = 0; i < columns.size(); ++i) {
    fit::Series series{columns[i].observable, array(values[i]), array(deviations[i])};
    const auto noise = request.noise.find(std::string(fit::kind_of(series.observable).name));
    if (series.sd.size() == 0 && noise != request.noise.end()) {
      series.sd = Eigen::ArrayXd::Constant(track.t.size(), noise->second);
      if (unused != nullptr) unused->noise.erase(noise->first);
    }
    if (const std::string doubt = unit_doubt(columns[i], series); !doubt.empty())
      note(fmt::format("{}: {}", escaped(track_name), doubt));
    track.series.push_back(std::move(series));
  }
  return track;
}

}  // namespace contensou::answers
