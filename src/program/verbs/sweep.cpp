#include "verbs/sweep.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/compile.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "exit_status.hpp"
#include "output/ordered_work.hpp"
#include "output/progress.hpp"
#include "verbs/stop_times.hpp"

namespace contensou::program {

namespace {

constexpr long points_at_once = 1 << 15;
constexpr long longest_kept_axis = 1 << 20;
constexpr double max_points = 1e18;  // times 8 bytes, below the largest file size

std::vector<double> values_of(const Range& range, long begin, long count) {
  std::vector<double> values(static_cast<std::size_t>(count));
  for (double& value : values) value = range[begin++];
  return values;
}

/// What a file begins with: the names of the columns, or NumPy's description of the array, whose doubles follow as they
/// are in memory.
std::string heading(const SweepRequest& request) {
  if (request.format == SweepFormat::csv) return "mu,u0,v0,tau_stop\n";
  const SweepGrid& grid = request.grid;
  std::vector<long> shape{grid.v0.count, grid.u0.count};
  if (grid.mu_is_range) shape.insert(shape.begin(), grid.mu.count);
  constexpr char byte_order = std::endian::native == std::endian::little ? '<' : '>';
  constexpr std::size_t preamble = 10;   // magic, version, length
  constexpr std::size_t alignment = 64;  // of the doubles
  std::string dictionary =
      fmt::format("{{'descr': '{}f8', 'fortran_order': False, 'shape': ({}), }}", byte_order, fmt::join(shape, ", "));
  const std::size_t used = preamble + dictionary.size() + 1;
  dictionary.append((alignment - used % alignment) % alignment, ' ') += '\n';
  const std::size_t length = dictionary.size();
  const char length_bytes[]{static_cast<char>(length & 0xFF), static_cast<char>(length >> 8)};
  return std::string("\x93NUMPY\x01\x00", 8) + std::string(length_bytes, 2) + dictionary;
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
        output_(output),
        stop_times_(request.law, request.body, starts_of_mu_),
        progress_("stop times", request.progress) {
    if (grid_.u0.count <= longest_kept_axis) u0_ = values_of(grid_.u0, 0, grid_.u0.count);
  }

  void run() {
    work_in_order<Piece>(
        request_.threads, [this](Piece& piece, const auto&) { return take(piece); },
        [this](Piece& piece) { work(piece); }, [this](const Piece& piece) { hand_on(piece); });
    progress_.finish(grid_.points());
  }

 private:
  bool take(Piece& piece) {
    if (next_ == starts_of_mu_ * grid_.mu.count) return false;
    const long count = std::min(points_at_once, starts_of_mu_ - next_ % starts_of_mu_);
    piece.begin = next_;
    piece.mu = grid_.mu[next_ / starts_of_mu_];
    piece.taus.resize(static_cast<std::size_t>(count));
    next_ += count;
    return true;
  }

  void work(Piece& piece) {
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
      stop_times->row(u0, v0, taus);
      if (request_.format == SweepFormat::csv) append_lines(piece.text, piece.mu, u0, v0, taus);
      done += taus.size();
    }
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

  void hand_on(const Piece& piece) {
    output_.write(std::exchange(heading_, {}));
    output_.write(
        request_.format == SweepFormat::csv
            ? std::string_view(piece.text.data(), piece.text.size())
            : std::string_view(reinterpret_cast<const char*>(piece.taus.data()), piece.taus.size() * sizeof(double)));
    done_ += static_cast<double>(piece.taus.size());
    progress_.show(done_, grid_.points());
  }

  const SweepRequest& request_;
  std::string heading_;  ///< is written with the first stop times
  const SweepGrid& grid_ = request_.grid;
  OutputFile& output_;
  const long starts_of_mu_ = grid_.v0.count * grid_.u0.count;
  StopTimes stop_times_;
  Progress progress_;
  std::vector<double> u0_;  ///< all values; empty if they are too many to be kept
  long next_ = 0;           ///< start that is not taken yet
  double done_ = 0;
};

}  // namespace

double Range::operator[](long place) const {
  const long last = count - 1;
  if (place == 0) return least;
  if (place == last) return most;
  const auto mix = [&](long double low, long double high) {
    return (low * static_cast<long double>(last - place) + high * static_cast<long double>(place)) /
           static_cast<long double>(last);
  };
  const auto log = [](double end) { return std::log2(static_cast<long double>(end)); };
  return static_cast<double>(in_ratios ? std::exp2(mix(log(least), log(most))) : mix(least, most));
}

double SweepGrid::points() const {
  return static_cast<double>(mu.count) * static_cast<double>(v0.count) * static_cast<double>(u0.count);
}

void sweep(const SweepRequest& request, OutputFile& output) {
  const SweepGrid& grid = request.grid;
  if (grid.points() > max_points) {
    throw BadInput(
        fmt::format("{:.3g} starts are more than any file can hold: reduce N of --mu, --u0 or --v0", grid.points()));
  }
  std::string begins = heading(request);
  if (request.format == SweepFormat::npy) {
    const long points = grid.mu.count * grid.v0.count * grid.u0.count;
    output.reserve(begins.size() + sizeof(double) * static_cast<std::size_t>(points));
  }
  Sweep(request, std::move(begins), output).run();
}

}  // namespace contensou::program
