#include "verbs/stop_batch.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <stdexcept>

#include <fmt/format.h>

#include "input/number.hpp"
#include "output/ordered_work.hpp"
#include "verbs/stop_times.hpp"

namespace contensou::program {

namespace {

constexpr const char* result = "tau_stop";

/// The fields of a row as text of the same width as the header's, and one more.
std::string line_of(const CsvHeader& header, const std::vector<std::string_view>& fields, std::string last) {
  std::vector<std::string> all(fields.begin(), fields.end());
  all.resize(header.names().size());
  all.push_back(std::move(last));
  return csv_line(all);
}

/// What all workers share.
struct Batch {
  CsvStream& table;
  OutputFile& output;
  const BatchRequest& request;
  std::size_t mu, u0, v0;  ///< columns
  StopTimes stop_times;
  ExitStatus status = ExitStatus::done;
};

/// Adds the stop times to one block of rows after the other.
class BatchWorker final : public PieceWorker {
 public:
  explicit BatchWorker(Batch& batch) : batch_(batch) {}

  bool take() override { return batch_.table.next(block_); }

  void work() override {
    lines_.clear();
    complaints_.clear();
    status_ = ExitStatus::done;
    for_each_row(block_, header(), [this](const CsvRow& row) { add(row); });
  }

  void hand_on() override {
    std::fputs(complaints_.c_str(), stderr);
    batch_.output.write(lines_);
    batch_.status = std::max(batch_.status, status_);
  }

 private:
  const CsvHeader& header() const { return batch_.table.header(); }

  void add(const CsvRow& row) {
    try {
      append(row, stop_time(row));
    } catch (const BadLine& error) {
      keep_without_result(row, error, ExitStatus::bad_input);
    } catch (const std::runtime_error& error) {
      keep_without_result(row, error, ExitStatus::numerical_failure);
    }
  }

  void append(const CsvRow& row, double tau) {
    std::array<char, 32> text;
    const auto size = fmt::format_to_n(text.data(), text.size(), "{}", tau).size;
    const std::string_view digits(text.data(), size);
    if (row.plain.empty()) {
      lines_ += line_of(header(), row.fields, std::string(digits));
      return;
    }
    lines_.append(row.plain) += ',';
    lines_.append(digits) += '\n';
  }

  void keep_without_result(const CsvRow& row, const std::exception& error, ExitStatus status) {
    if (!batch_.request.keep_going) throw;
    complaints_.append(error.what()) += '\n';
    lines_ += line_of(header(), row.fields, "");
    status_ = std::max(status_, status);
  }

  /// @throws BadLine, std::runtime_error  beginning with the row's place
  double stop_time(const CsvRow& row) {
    header().require_complete(row.line, row.fields.size());
    const double mu = number(row, "mu", batch_.mu);
    const reduction::State start{.u = number(row, "u0", batch_.u0), .v = number(row, "v0", batch_.v0)};
    if (const std::string wrong = batch_.request.body.complaint(mu); !wrong.empty()) {
      throw complaint(row, fmt::format("mu: {}, got {}", wrong, mu));
    }
    if (start.v < 0) throw complaint(row, fmt::format("v0: v0 >= 0 is required, got {}", start.v));
    try {
      if (!patch_ || patch_->mu() != mu) patch_ = batch_.stop_times.of_patch(mu);
      return (*patch_)(start);
    } catch (const std::domain_error& error) {
      throw complaint(row, error.what());
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(complaint(row, error.what()).what());
    }
  }

  double number(const CsvRow& row, std::string_view name, std::size_t column) const {
    try {
      return parse_number(row.fields[column]);
    } catch (const BadInput& error) {
      throw complaint(row, fmt::format("{}: {}", name, error.what()));
    }
  }

  BadLine complaint(const CsvRow& row, std::string_view message) const { return header().complaint(row.line, message); }

  Batch& batch_;
  std::shared_ptr<const PatchStopTimes> patch_;  ///< of the row before
  CsvBlock block_;
  std::string lines_;
  std::string complaints_;
  ExitStatus status_ = ExitStatus::done;
};

}  // namespace

ExitStatus stop_batch(CsvStream& table, OutputFile& output, const BatchRequest& request) {
  const CsvHeader& header = table.header();
  Batch batch{.table = table,
              .output = output,
              .request = request,
              .mu = header.column("mu"),
              .u0 = header.column("u0"),
              .v0 = header.column("v0"),
              .stop_times = {request.law, request.body.inertia, request.route}};
  if (header.has_column(result)) {
    throw header.complaint(header.line(),
                           fmt::format("the input already has a column '{}': rename or remove it", result));
  }
  output.write(line_of(header, {header.names().begin(), header.names().end()}, result));
  std::vector<std::unique_ptr<PieceWorker>> workers;
  for (int i = 0; i < request.threads; ++i) workers.push_back(std::make_unique<BatchWorker>(batch));
  work_in_order(workers);
  return batch.status;
}

}  // namespace contensou::program
