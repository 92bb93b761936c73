#include "verbs/stop_batch.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/compile.h>
#include <fmt/format.h>

#include "contensou/si/bridge.hpp"
#include "output/answer.hpp"
#include "output/ordered_work.hpp"
#include "output/progress.hpp"
#include "verbs/stop_times.hpp"

namespace contensou::program {

namespace {

/// Some rows of the table, and what becomes of them.
struct Piece {
  CsvBlock rows;
  fmt::memory_buffer lines;
  std::string complaints;
  long overflows = 0;
  long first_overflow = 0;  ///< its line
  ExitStatus status = ExitStatus::done;
  std::exception_ptr fault;  ///< of the first row that has no line
  double fraction_read = 0;  ///< of the table, with these rows; NaN if it has no known length
};

/// Of mu, but for a ball, of pivoting and of sliding.
std::vector<CsvColumn> columns_of_starts(const CsvReader& table, bool is_ball) {
  const auto names = is_ball ? std::vector{"spin", "slip"} : std::vector{"mu", "u0", "v0"};
  std::vector<CsvColumn> columns;
  for (const char* name : names) columns.push_back(table.column(name));
  return columns;
}

class Batch {
 public:
  Batch(CsvReader& table, OutputFile& output, const BatchRequest& request)
      : table_(table),
        output_(output),
        request_(request),
        columns_(columns_of_starts(table, request.ball.has_value())),
        ball_mu_(request.ball ? si::patch_ratio(*request.ball, request.law) : 0),
        stop_times_(request.law, request.body.inertia, request.route),
        progress_("rows", request.progress) {
    const std::string result = request.ball ? "t_stop" : "tau_stop";
    if (table.has_column(result)) {
      throw table.complaint(table.header_line(),
                            fmt::format("the input already has a column '{}': rename or remove it", result));
    }
    std::vector<std::string> names = table.names();
    names.push_back(result);
    header_ = csv_line(names);
  }

  ExitStatus run() {
    work_in_order<Piece>(
        request_.threads, [this] { return table_.ready(); }, [this](Piece& piece) { return take(piece); },
        [this](Piece& piece) { work(piece); }, [this](Piece& piece) { hand_on(piece); });
    output_.write(header_);
    progress_.finish(static_cast<double>(rows_));
    if (overflows_ > 0) {
      const auto note = table_.complaint(
          first_overflow_, fmt::format("{} exceeds the largest double and is written as inf ({} rows in all)",
                                       request_.ball ? "t_stop" : "tau_stop", overflows_));
      std::fprintf(stderr, "%s\n", note.what());
    }
    return status_;
  }

 private:
  bool take(Piece& piece) {
    const bool taken = table_.next(piece.rows);
    piece.fraction_read = table_.fraction_read();
    return taken;
  }

  void work(Piece& piece) {
    for (std::size_t i = 0; i < piece.rows.size(); ++i) {
      try {
        add(piece.rows[i], piece);
      } catch (...) {
        piece.fault = std::current_exception();
        return;
      }
    }
  }

  void hand_on(const Piece& piece) {
    if (piece.lines.size() > 0) {
      output_.write(std::exchange(header_, {}));
      output_.write({piece.lines.data(), piece.lines.size()});
    }
    if (!piece.complaints.empty()) {
      progress_.erase();
      std::fputs(piece.complaints.c_str(), stderr);
    }
    if (piece.fault) std::rethrow_exception(piece.fault);
    status_ = std::max(status_, piece.status);
    if (overflows_ == 0) first_overflow_ = piece.first_overflow;
    overflows_ += piece.overflows;
    rows_ += piece.rows.size();
    progress_.show(static_cast<double>(rows_), static_cast<double>(rows_) / piece.fraction_read);
  }

  /// @throws BadLine, std::runtime_error  beginning with the row's place
  void add(const CsvRow& row, Piece& piece) {
    try {
      const double tau = stop_time(row);
      if (std::isinf(tau) && piece.overflows++ == 0) piece.first_overflow = row.line();
      piece.lines.append(row.text());
      fmt::format_to(fmt::appender(piece.lines), FMT_COMPILE(",{}\n"), tau);
    } catch (const BadLine& error) {
      keep_without_result(row, error, ExitStatus::bad_input, piece);
    } catch (const std::runtime_error& error) {
      keep_without_result(row, error, ExitStatus::numerical_failure, piece);
    }
  }

  void keep_without_result(const CsvRow& row, const std::exception& error, ExitStatus status, Piece& piece) const {
    if (!request_.keep_going) throw;
    piece.complaints.append(error.what()) += '\n';
    std::vector<std::string> fields(table_.names().size() + 1);
    for (std::size_t i = 0; i < std::min(row.size(), table_.names().size()); ++i) fields[i] = row[i];
    piece.lines.append(csv_line(fields));
    piece.status = std::max(piece.status, status);
  }

  double stop_time(const CsvRow& row) {
    table_.require_complete(row);
    const bool is_ball = request_.ball.has_value();
    const double mu = is_ball ? ball_mu_ : table_.number(row, columns_.front());
    const double radius = is_ball ? request_.ball->ball.radius : 1;
    const reduction::State start{.u = radius * table_.number(row, columns_.rbegin()[1]),
                                 .v = table_.number(row, columns_.back())};
    if (const std::string wrong = request_.body.complaint(mu); !wrong.empty()) {
      throw table_.complaint(row.line(), fmt::format("mu: {}, got {}", wrong, mu));
    }
    if (start.v < 0)
      throw table_.complaint(row.line(),
                             fmt::format("{0}: {0} >= 0 is required, got {1}", is_ball ? "slip" : "v0", start.v));
    try {
      const double tau = stop_times_(mu, start);
      return is_ball ? si::seconds(*request_.ball, tau) : tau;
    } catch (const std::domain_error& error) {
      throw table_.complaint(row.line(), error.what());
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(table_.complaint(row.line(), error.what()).what());
    }
  }

  CsvReader& table_;
  OutputFile& output_;
  const BatchRequest& request_;
  std::vector<CsvColumn> columns_;
  double ball_mu_;
  StopTimes stop_times_;
  Progress progress_;
  std::string header_;  ///< is written with the first rows
  std::size_t rows_ = 0;
  long overflows_ = 0;
  long first_overflow_ = 0;
  ExitStatus status_ = ExitStatus::done;
};

}  // namespace

ExitStatus stop_batch(CsvReader& table, OutputFile& output, const BatchRequest& request) {
  return Batch(table, output, request).run();
}

}  // namespace contensou::program
