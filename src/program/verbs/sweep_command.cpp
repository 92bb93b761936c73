#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/compile.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "contensou/portraits/stop_time_map.hpp"
#include "contensou/si/scaling.hpp"
#include "options/law_option.hpp"
#include "options/output_options.hpp"
#include "options/start_options.hpp"
#include "output/batch.hpp"
#include "output/progress.hpp"
#include "platform/output_file.hpp"
#include "verb.hpp"
#include "verbs/stop_times.hpp"

namespace contensou::program {

namespace {

constexpr long points_at_once = 1 << 15;
constexpr long longest_kept_axis = 1 << 20;
constexpr double max_points = 1e18;  // times 8 bytes, this is below the largest size of a file

/// Numbers from the least to the largest, both included, in equal steps or in equal ratios.
struct Range {
  double min, max;
  long count = 1;
  bool in_ratios = false;

  /// Returns the number at a place from 0 to count - 1. If long double is longer than double, only one rounding occurs.
  double operator[](long place) const {
    const long last = count - 1;
    if (place == 0) return min;
    if (place == last) return max;
    const auto mix = [&](long double low, long double high) {
      return (low * static_cast<long double>(last - place) + high * static_cast<long double>(place)) /
             static_cast<long double>(last);
    };
    const auto log = [](double end) { return std::log2(static_cast<long double>(end)); };
    return static_cast<double>(in_ratios ? std::exp2(mix(log(min), log(max))) : mix(min, max));
  }
};

/// The starts of a sweep: all combinations of mu, v0 and u0, in the order of a C array. u0 changes fastest.
struct SweepGrid {
  Range mu;
  bool mu_is_range;  ///< true if the array has an axis for mu
  Range u0;          ///< values of u0; for a ball, values of its spin
  Range v0;
  std::optional<si::Experiment> ball = {};  ///< if `ball` is set, grid and stop times are in SI units

  /// Returns the number of starts as a double, because it may exceed every integer type.
  double points() const {
    return static_cast<double>(mu.count) * static_cast<double>(v0.count) * static_cast<double>(u0.count);
  }
};

enum class SweepFormat { npy, csv };

/// Columns of a table, without and with --ball; npy contains only the last column.
constexpr ColumnText system_columns{"mu,u0,v0,tau_stop", "1, speed, speed, speed",
                                    "start, and time tau when slip and spin end. A file in npy contains tau_stop "
                                    "alone, in the shape (N_v0, N_u0), or (N_mu, N_v0, N_u0) for several mu"};
constexpr ColumnText ball_columns{
    "spin,slip,t_stop", "1/s, m/s, s",
    "start, and time when slip and spin end, with --ball. The shape in npy is (N_slip, N_spin)"};

std::vector<FieldText> sweep_texts() { return texts_of({system_columns, ball_columns}); }

/// The request for a sweep: its system, grid, format and threads.
struct SweepRequest {
  reduction::Law law;
  reduction::Inertia body;
  double drive;
  SweepGrid grid;
  SweepFormat format;
  int threads = 1;
  ShowProgress progress = ShowProgress::never;
};

std::vector<double> values_of(const Range& range, long begin, long count) {
  std::vector<double> values(static_cast<std::size_t>(count));
  for (double& value : values) value = range[begin++];
  return values;
}

/// Returns the beginning of a file: the names of the columns, or NumPy's description of the array. In an npy file, the
/// doubles of the array follow in the byte order of the machine.
std::string heading(const SweepRequest& request) {
  if (request.format == SweepFormat::csv)
    return csv_line(names_of({request.grid.ball ? ball_columns : system_columns}));
  const SweepGrid& grid = request.grid;
  std::vector<long> shape{grid.v0.count, grid.u0.count};
  if (grid.mu_is_range) shape.insert(shape.begin(), grid.mu.count);
  constexpr char byte_order = std::endian::native == std::endian::little ? '<' : '>';
  constexpr std::size_t preamble = 10;   // magic, version, length
  constexpr std::size_t alignment = 64;  // alignment of the doubles
  std::string dictionary =
      fmt::format("{{'descr': '{}f8', 'fortran_order': False, 'shape': ({}), }}", byte_order, fmt::join(shape, ", "));
  const std::size_t used = preamble + dictionary.size() + 1;
  dictionary.append((alignment - used % alignment) % alignment, ' ') += '\n';
  const std::size_t length = dictionary.size();
  const char length_bytes[]{static_cast<char>(length & 0xFF), static_cast<char>(length >> 8)};
  return std::string("\x93NUMPY\x01\x00", 8) + std::string(length_bytes, 2) + dictionary;
}

/// A range of successive starts with one mu.
struct SweepPiece {
  long begin = 0;  ///< number of the first start
  double mu = 0;
  std::vector<double> taus;
  fmt::memory_buffer text;
};

class Sweep {
 public:
  Sweep(const SweepRequest& request, std::string heading, OutputFile& output)
      : request_(request),
        heading_(std::move(heading)),
        output_(output),
        stop_times_(request.law, request.body, request.drive, starts_of_mu_, request.grid.mu.count),
        progress_("stop times", request.progress) {
    if (grid_.ball && grid_.ball->contact.rolling_friction != 0) stop_times_.resist(*grid_.ball);
    if (grid_.u0.count <= longest_kept_axis) u0_ = values_of(grid_.u0, 0, grid_.u0.count);
  }

  void run() {
    work_in_order<SweepPiece>(
        request_.threads, [] { return true; }, [this](SweepPiece& piece) { return take(piece); },
        [this](SweepPiece& piece) { work(piece); }, [this](const SweepPiece& piece) { hand_on(piece); });
    progress_.finish(grid_.points());
  }

 private:
  bool take(SweepPiece& piece) {
    if (next_ == starts_of_mu_ * grid_.mu.count) return false;
    const long count = std::min(points_at_once, starts_of_mu_ - next_ % starts_of_mu_);
    piece.begin = next_;
    piece.mu = grid_.mu[next_ / starts_of_mu_];
    piece.taus.resize(static_cast<std::size_t>(count));
    next_ += count;
    return true;
  }

  void work(SweepPiece& piece) {
    const auto stop_times = stop_times_.at(piece.mu);
    const long columns = grid_.u0.count;
    for (std::size_t done = 0; done < piece.taus.size();) {
      const long start = piece.begin + static_cast<long>(done);
      const long count = std::min(columns - start % columns, static_cast<long>(piece.taus.size() - done));
      const double v0 = grid_.v0[start / columns % grid_.v0.count];
      const auto taus = std::span(piece.taus).subspan(done, static_cast<std::size_t>(count));
      std::vector<double> computed;
      if (u0_.empty()) computed = values_of(grid_.u0, start % columns, count);
      const std::span<const double> u0 =
          u0_.empty() ? std::span(computed)
                      : std::span(u0_).subspan(static_cast<std::size_t>(start % columns), taus.size());
      if (grid_.ball) {
        std::vector<double> pivoting(u0.begin(), u0.end());
        for (double& u : pivoting) u *= grid_.ball->ball.radius;
        stop_times->row(pivoting, v0, taus);
        for (double& tau : taus) tau = si::seconds(*grid_.ball, tau);
      } else {
        stop_times->row(u0, v0, taus);
      }
      if (request_.format == SweepFormat::csv)
        append_lines(piece.text, grid_.ball ? "" : fmt::format("{},", piece.mu), u0, v0, taus);
      done += taus.size();
    }
  }

  static void append_lines(fmt::memory_buffer& text, const std::string& mu_text, std::span<const double> u0, double v0,
                           std::span<const double> taus) {
    const std::string v0_text = fmt::format(",{},", v0);
    for (std::size_t i = 0; i < taus.size(); ++i) {
      text.append(mu_text);
      fmt::format_to(fmt::appender(text), FMT_COMPILE("{}"), u0[i]);
      text.append(v0_text);
      fmt::format_to(fmt::appender(text), FMT_COMPILE("{}\n"), taus[i]);
    }
  }

  void hand_on(const SweepPiece& piece) {
    output_.write(std::exchange(heading_, {}));
    output_.write(
        request_.format == SweepFormat::csv
            ? std::string_view(piece.text.data(), piece.text.size())
            : std::string_view(reinterpret_cast<const char*>(piece.taus.data()), piece.taus.size() * sizeof(double)));
    done_ += static_cast<double>(piece.taus.size());
    progress_.show(done_, grid_.points());
  }

  const SweepRequest& request_;
  std::string heading_;  ///< heading, written together with the first stop times
  const SweepGrid& grid_ = request_.grid;
  OutputFile& output_;
  const long starts_of_mu_ = grid_.v0.count * grid_.u0.count;
  StopTimes stop_times_;
  Progress progress_;
  std::vector<double> u0_;  ///< all values of u0; empty if there are too many to keep
  long next_ = 0;           ///< number of the first start that is not taken yet
  double done_ = 0;
};

/// Writes the stop times of all starts; only a few blocks of them are in memory. The file does not depend on `threads`.
///   npy  NumPy's format 1.0: float64, shape (v0, u0), or (mu, v0, u0) if mu is a range
///
/// @param output  file for the result; the caller finishes it
/// @throws BadInput     if the array would be larger than any file
/// @throws FileFailure  if the disk has no room for the array
void sweep(const SweepRequest& request, OutputFile& output) {
  const SweepGrid& grid = request.grid;
  if (grid.points() > max_points) {
    throw BadInput("{:.3g} starts are more than any file can hold: reduce N of --mu, --u0 or --v0", grid.points());
  }
  std::string begins = heading(request);
  if (request.format == SweepFormat::npy) {
    const long points = grid.mu.count * grid.v0.count * grid.u0.count;
    output.reserve(begins.size() + sizeof(double) * static_cast<std::size_t>(points));
  }
  Sweep(request, std::move(begins), output).run();
}

/// Reads "MIN:MAX:N", or a single number.
/// @param unit  as for parse_quantity
Range parse_range(const std::string& typed, std::string_view unit) {
  const std::vector<std::string> parts = split(typed, ':');
  if (parts.size() == 1) return {.min = parse_quantity(typed, unit), .max = parse_quantity(typed, unit)};
  if (parts.size() != 3) throw BadInput("{} is not a range; write it MIN:MAX:N, as in 0:2:201", quotation(typed));
  const std::vector<double> ends = parse_quantities({parts[0], parts[1]}, unit);
  const Range range{
      .min = ends[0], .max = ends[1], .count = parse_integer(parts[2], 1, std::numeric_limits<long>::max())};
  const auto& [min, max, count, in_ratios] = range;
  if (min > max) throw BadInput("MIN = {} exceeds MAX = {}: put the smaller one first", min, max);
  if (count == 1 && min != max) {
    throw BadInput("one value cannot be both MIN = {} and MAX = {}: give N = 2 or more", min, max);
  }
  if (count > 1 && min == max) {
    throw BadInput("all {} values would be {}: give different MIN and MAX, or the number alone", count, min);
  }
  return range;
}

class SweepCommand final : public Verb {
 public:
  void add_options(CLI::App& app) override {
    const auto read = [](std::string_view unit) {
      return [=](const std::string& typed) {
        try {
          return parse_range(typed, unit);
        } catch (const BadInput& error) {
          throw NotAllowed(error.what());
        }
      };
    };
    app.option_defaults()->group("Start");
    mu_.add(app, "--mu", "M|MIN:MAX:N", "value of mu, 0 < M <= 1, or N values from MIN to MAX", read(""));
    u0_.add(app, "--u0", "MIN:MAX:N", "N values of u at the start, from MIN to MAX", read(""));
    v0_.add(app, "--v0", "MIN:MAX:N", "N values of v at the start, from MIN >= 0 to MAX", read(""));
    log_.add(app, "--log", "neighbouring values have equal ratios, not equal steps (MIN must be above 0)");
    start_.add_body(app);
    start_.add_drive(app);
    start_.add_ball(
        app, "real body in SI units, instead of the options above. It needs --spin and --slip; times are in seconds",
        StartOptions::no_start);
    spin_.add(app, "--spin", "MIN:MAX:N", "N values of the spin about the vertical, in radians per second",
              read(si::spin.unit));
    slip_.add(app, "--slip", "MIN:MAX:N", "N values of the sliding speed, in metres per second", read(si::slip.unit));
    law_.add(app);
    bulk_.add(app);
    output_.add(app);
    start_.ball().excludes({&mu_, &u0_, &v0_}, "with --ball, use --spin and --slip");
    spin_.needs(start_.ball(), "is for a ball");
    slip_.needs(start_.ball(), "is for a ball");
  }

  ExitStatus run() override {
    const Output out = output_.read();
    const reduction::Law law = law_.read(start_.standard_law());
    const SweepGrid grid = start_.ball_given() ? read_grid_of_ball(law) : read_grid(start_.body());
    const reduction::Inertia inertia = grid.ball ? grid.ball->ball.body.inertia : start_.body().inertia;
    const double drive = grid.ball ? start_.drive_along_x(*grid.ball) : start_.drive().value_or(0);
    if (out.picture) {
      if (const std::string names = names_given(bulk_.all()); !names.empty())
        throw BadInput("{} is for npy and csv: a picture has few starts, leave it out", names);
      return output_.write({make_map(reduction::ReducedSystem(law, grid.mu.min, inertia, drive), grid)}, out);
    }
    OutputFile output(out.path);
    sweep({.law = law,
           .body = inertia,
           .drive = drive,
           .grid = grid,
           .format = out.format == "npy" ? SweepFormat::npy : SweepFormat::csv,
           .threads = bulk_.threads(),
           .progress = bulk_.progress(out.path)},
          output);
    output.finish();
    return ExitStatus::done;
  }

 private:
  Range range_of(const ArgumentOf<Range>& argument) const {
    if (!argument.given()) {
      throw BadInput(
          "{} missing: a sweep is --mu M --u0 MIN:MAX:N --v0 MIN:MAX:N, or --ball NAME --spin "
          "MIN:MAX:N --slip MIN:MAX:N",
          argument.name());
    }
    Range range = *argument;
    range.in_ratios = log_;
    if (log_ && range.count > 1 && !(range.min > 0)) {
      argument.reject(fmt::format("logarithmic steps need MIN > 0, got {}: raise MIN, or leave --log out", range.min));
    }
    return range;
  }

  Range speeds_of(const ArgumentOf<Range>& argument) const {
    const Range range = range_of(argument);
    if (range.min < 0) argument.reject("a sliding speed is >= 0; turn the axes so that the ball slides along x");
    return range;
  }

  SweepGrid read_grid_of_ball(const reduction::Law& law) const {
    const si::Experiment experiment = start_.read_ball(law, at_rest("--slip and --spin"));
    const double mu = si::patch_ratio(experiment, law);
    return {.mu = {mu, mu}, .mu_is_range = false, .u0 = range_of(spin_), .v0 = speeds_of(slip_), .ball = experiment};
  }

  SweepGrid read_grid(const Body& body) const {
    if (!mu_.given() && !body.patch_ratio) {
      throw BadInput("--mu missing: give --mu M or MIN:MAX:N, or a --body that lies flat, disc or ring");
    }
    const SweepGrid grid{.mu = mu_.given() ? range_of(mu_) : Range{*body.patch_ratio, *body.patch_ratio},
                         .mu_is_range = mu_.given() && mu_.text().find(':') != std::string::npos,
                         .u0 = range_of(u0_),
                         .v0 = speeds_of(v0_)};
    for (double mu : {grid.mu.min, grid.mu.max}) {
      if (const std::string wrong = body.complaint(mu); !wrong.empty()) mu_.reject(wrong);
    }
    return grid;
  }

  portraits::Figure make_map(const reduction::ReducedSystem& system, const SweepGrid& grid) const {
    constexpr double max_drawn = 1e6;
    if (grid.ball && grid.ball->contact.rolling_friction != 0) {
      throw BadInput(
          "a picture shows one system, and with rolling friction there are two: write npy or csv, or add "
          "--rolling-friction 0");
    }
    if (grid.mu_is_range) mu_.reject("a picture shows one mu: give --mu M, or write npy or csv");
    for (const auto* axis : grid.ball ? std::array{&spin_, &slip_} : std::array{&u0_, &v0_}) {
      if ((*axis)->count < 2) axis->reject("a picture needs a range, MIN:MAX:N");
    }
    if (grid.points() > max_drawn) {
      throw BadInput("a picture shows at most {:g} starts, not {:g}: reduce N, or write npy or csv", max_drawn,
                     grid.points());
    }
    const auto values = [](const Range& range) -> Eigen::ArrayXd {
      return Eigen::ArrayXd::NullaryExpr(range.count, [&](Eigen::Index i) { return range[static_cast<long>(i)]; });
    };
    const reduction::Flow flow(system);
    tell_if_refused(flow, static_cast<std::size_t>(grid.points()));
    using portraits::math, portraits::sub;
    portraits::MapCaption caption;
    if (grid.ball) {
      caption = {
          .title = portraits::title_of(portraits::shortened(grid.ball->ball.name), fmt::format("{:.4g}", system.mu()),
                                       portraits::shortened(system.law().name())),
          .subtitle = "how long slip and spin last, from every start",
          .u = "spin " + math("ω") + sub(math("z")) + " at the start, rad/s",
          .v = "slip " + math("v") + " at the start, m/s",
          .time = math("t*") + ", s",
          .u_unit = grid.ball->ball.radius,
          .time_unit = 1 / si::seconds(*grid.ball, 1)};
    }
    return portraits::draw(
        portraits::stop_time_map(flow, {caption.u_unit * values(grid.u0), values(grid.v0), log_}, caption.time_unit),
        caption, output_.size());
  }

  ArgumentOf<Range> mu_, u0_, v0_, spin_, slip_;
  StartOptions start_;
  Flag log_;
  LawOption law_;
  BulkOptions bulk_;
  PictureOptions output_{{{"a sweep", {"npy", "csv", "svg", "pdf", "png", "eps", "gp"}, "-", "csv"}}};
};

const RegisteredVerb<SweepCommand> sweep_verb(Purpose::compute, "sweep", "Compute stop times on a grid of starts",
                                              "contensou sweep --mu 0.1 --u0 0:2:201 --v0 0:2:201 -o map.npy",
                                              {{"", sweep_texts}}, {"u", "v", "mu", "f, N", "tau", "(speed)"});

}  // namespace

}  // namespace contensou::program
