#include "verbs/sweep.hpp"

#include <algorithm>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/compile.h>
#include <fmt/format.h>

#include "exit_status.hpp"
#include "output/npy.hpp"
#include "output/ordered_work.hpp"
#include "verbs/stop_times.hpp"

namespace contensou::program {

namespace {

constexpr long points_at_once = 1 << 15;
constexpr long longest_kept_axis = 1 << 20;
constexpr double most_points = 1e18;  // times 8 bytes, below the largest file size

std::string_view as_bytes(const std::vector<double>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double)};
}

std::vector<double> values_of(const Range& range, long begin, long count) {
  std::vector<double> values(static_cast<std::size_t>(count));
  for (double& value : values) value = range[begin++];
  return values;
}

/// A stretch of starts, all of one mu.
struct Piece {
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
        grid_(request.grid),
        output_(output),
        stop_times_(request.law, request.body, starts_of_mu_),
        progress_("stop times", request.progress) {
    if (grid_.u0.count() <= longest_kept_axis) u0_ = values_of(grid_.u0, 0, grid_.u0.count());
  }

  void run() {
    work_in_order<Piece>(
        request_.threads, [this](Piece& piece, const auto&) { return take(piece); },
        [this](Piece& piece) { work(piece); }, [this](const Piece& piece) { hand_on(piece); });
    progress_.finish(grid_.points());
  }

 private:
  bool take(Piece& piece) {
    if (next_ == starts_of_mu_ * grid_.mu.count()) return false;
    const long count = std::min(points_at_once, starts_of_mu_ - next_ % starts_of_mu_);
    piece.begin = next_;
    piece.mu = grid_.mu[next_ / starts_of_mu_];
    piece.taus.resize(static_cast<std::size_t>(count));
    next_ += count;
    return true;
  }

  void work(Piece& piece) {
    const auto stop_times = stop_times_.of_patch(piece.mu);
    const long columns = grid_.u0.count();
    for (std::size_t done = 0; done < piece.taus.size();) {
      const long start = piece.begin + static_cast<long>(done);
      const std::size_t left = piece.taus.size() - done;
      const std::size_t count = std::min(static_cast<std::size_t>(columns - start % columns), left);
      const auto taus = std::span(piece.taus).subspan(done, count);
      row(*stop_times, start % columns, grid_.v0[start / columns % grid_.v0.count()], taus, piece);
      done += count;
    }
  }

  void hand_on(const Piece& piece) {
    output_.write(std::exchange(heading_, {}));
    output_.write(request_.format == SweepFormat::npy ? as_bytes(piece.taus)
                                                      : std::string_view(piece.text.data(), piece.text.size()));
    done_ += static_cast<double>(piece.taus.size());
    progress_.show(done_, grid_.points());
  }

  /// A part of a row, from a column on.
  void row(const PatchStopTimes& stop_times, long column, double v0, std::span<double> taus, Piece& piece) const {
    std::vector<double> computed;
    if (u0_.empty()) computed = values_of(grid_.u0, column, static_cast<long>(taus.size()));
    const std::span<const double> u0 =
        u0_.empty() ? std::span(computed) : std::span(u0_).subspan(static_cast<std::size_t>(column), taus.size());
    stop_times.row(u0, v0, taus);
    if (request_.format == SweepFormat::csv) append_lines(piece.text, piece.mu, u0, v0, taus);
  }

  static void append_lines(fmt::memory_buffer& text, double mu, std::span<const double> u0, double v0,
                           std::span<const double> taus) {
    const std::string mu_text = fmt::format("{},", mu);
    const std::string v0_text = fmt::format(",{},", v0);
    for (std::size_t i = 0; i < taus.size(); ++i) {
      text.append(mu_text);
      fmt::format_to(fmt::appender(text), FMT_COMPILE("{}"), u0[i]);
      text.append(v0_text);
      fmt::format_to(fmt::appender(text), FMT_COMPILE("{}\n"), taus[i]);
    }
  }

  const SweepRequest& request_;
  std::string heading_;  ///< is written with the first stop times
  const SweepGrid& grid_;
  OutputFile& output_;
  const long starts_of_mu_ = grid_.v0.count() * grid_.u0.count();
  StopTimes stop_times_;
  Progress progress_;
  std::vector<double> u0_;  ///< all values; empty if they are too many to be kept
  long next_ = 0;           ///< start that is not taken yet
  double done_ = 0;
};

std::string heading(const SweepRequest& request) {
  if (request.format == SweepFormat::csv) return "mu,u0,v0,tau_stop\n";
  const SweepGrid& grid = request.grid;
  std::vector<long> shape{grid.v0.count(), grid.u0.count()};
  if (grid.mu_is_range) shape.insert(shape.begin(), grid.mu.count());
  return npy_header(shape);
}

}  // namespace

double SweepGrid::points() const {
  return static_cast<double>(mu.count()) * static_cast<double>(v0.count()) * static_cast<double>(u0.count());
}

void sweep(const SweepRequest& request, OutputFile& output) {
  const SweepGrid& grid = request.grid;
  if (grid.points() > most_points) {
    throw BadInput(
        fmt::format("{:.3g} starts are more than any file can hold: reduce N of --mu, --u0 or --v0", grid.points()));
  }
  std::string begins = heading(request);
  if (request.format == SweepFormat::npy) {
    const long points = grid.mu.count() * grid.v0.count() * grid.u0.count();
    output.reserve(begins.size() + sizeof(double) * static_cast<std::size_t>(points));
  }
  Sweep(request, std::move(begins), output).run();
}

}  // namespace contensou::program
