#include "verbs/sweep.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <vector>

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

void append_number(std::string& text, double value, char separator) {
  std::array<char, 32> digits;
  text.append(digits.data(), fmt::format_to_n(digits.data(), digits.size(), "{}", value).size) += separator;
}

std::vector<double> values_of(const Range& range, long begin, long count) {
  std::vector<double> values(static_cast<std::size_t>(count));
  for (double& value : values) value = range[begin++];
  return values;
}

/// What all workers share.
struct Sweep {
  const SweepRequest& request;
  OutputFile& output;
  long map;     ///< points of one mu
  long points;  ///< of all
  StopTimes stop_times;
  Progress progress;
  std::vector<double> u0;  ///< all values; empty if they are too many to be kept
  long next = 0;           ///< point that is not taken yet
};

/// Computes one stretch of points after the other, all of one mu.
class SweepWorker final : public PieceWorker {
 public:
  explicit SweepWorker(Sweep& sweep) : sweep_(sweep) {}

  bool take() override {
    begin_ = sweep_.next;
    const long end_of_map = begin_ - begin_ % sweep_.map + sweep_.map;
    end_ = std::min({begin_ + points_at_once, end_of_map, sweep_.points});
    sweep_.next = end_;
    return begin_ < end_;
  }

  void work() override {
    const long mu_place = begin_ / sweep_.map;
    if (mu_place != mu_place_) {
      mu_place_ = mu_place;
      mu_ = grid().mu[mu_place];
      patch_ = sweep_.stop_times.of_patch(mu_);
    }
    taus_.resize(static_cast<std::size_t>(end_ - begin_));
    text_.clear();
    const long columns = grid().u0.count();
    for (long point = begin_; point < end_;) {
      const long column = point % columns;
      const long count = std::min(columns - column, end_ - point);
      const double v0 = grid().v0[point / columns % grid().v0.count()];
      row(v0, column,
          std::span(taus_).subspan(static_cast<std::size_t>(point - begin_), static_cast<std::size_t>(count)));
      point += count;
    }
  }

  void hand_on() override {
    sweep_.output.write(sweep_.request.format == SweepFormat::npy ? as_bytes(taus_) : text_);
    sweep_.progress.show(static_cast<double>(end_));
  }

 private:
  const SweepGrid& grid() const { return sweep_.request.grid; }

  /// A part of a row, from a column on.
  void row(double v0, long column, std::span<double> taus) {
    std::vector<double> computed;
    std::span<const double> u0;
    if (sweep_.u0.empty()) {
      computed = values_of(grid().u0, column, static_cast<long>(taus.size()));
      u0 = computed;
    } else {
      u0 = std::span(sweep_.u0).subspan(static_cast<std::size_t>(column), taus.size());
    }
    patch_->row(u0, v0, taus);
    if (sweep_.request.format == SweepFormat::csv) append_lines(u0, v0, taus);
  }

  void append_lines(std::span<const double> u0, double v0, std::span<const double> taus) {
    const std::string mu_text = fmt::format("{},", mu_);
    const std::string v0_text = fmt::format("{},", v0);
    for (std::size_t i = 0; i < taus.size(); ++i) {
      text_ += mu_text;
      append_number(text_, u0[i], ',');
      text_ += v0_text;
      append_number(text_, taus[i], '\n');
    }
  }

  Sweep& sweep_;
  long begin_ = 0;
  long end_ = 0;
  long mu_place_ = -1;
  double mu_ = 0;
  std::shared_ptr<const PatchStopTimes> patch_;  ///< of mu_
  std::vector<double> taus_;
  std::string text_;
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
  const long map = grid.v0.count() * grid.u0.count();
  Sweep sweep{.request = request,
              .output = output,
              .map = map,
              .points = map * grid.mu.count(),
              .stop_times = {request.law, request.body, map},
              .progress = {grid.points(), "stop times", request.progress},
              .u0 = {}};
  if (grid.u0.count() <= longest_kept_axis) sweep.u0 = values_of(grid.u0, 0, grid.u0.count());
  const std::string begins = heading(request);
  if (request.format == SweepFormat::npy) {
    output.reserve(begins.size() + sizeof(double) * static_cast<std::size_t>(sweep.points));
  }
  output.write(begins);
  std::vector<std::unique_ptr<PieceWorker>> workers;
  for (int i = 0; i < request.threads; ++i) workers.push_back(std::make_unique<SweepWorker>(sweep));
  work_in_order(workers);
  sweep.progress.finish();
}

}  // namespace contensou::program
