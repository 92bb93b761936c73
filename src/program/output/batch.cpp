#include "output/batch.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <stdexcept>

#include <fmt/compile.h>
#include <fmt/format.h>

#include "answers/input/errors.hpp"
#include "answers/table/answer.hpp"
#include "contensou/si/quantity.hpp"

namespace contensou::program {

namespace {

/// Some rows of the table with their results.
struct Piece {
  CsvBlock rows;
  std::vector<double> values, results;  ///< values and results of one row
  fmt::memory_buffer lines;
  std::string complaints;
  long overflows = 0;
  std::string first_overflow;  ///< message about the first infinite result
  ExitStatus status = ExitStatus::done;
  std::exception_ptr fault;  ///< exception for the first row without a line of output; null if each row has a line
  double fraction_read = 0;  ///< fraction of the table read up to these rows; NaN if its length is unknown
};

class Batch {
 public:
  Batch(CsvReader& table, OutputFile& output, const BatchRequest& request)
      : table_(table), output_(output), request_(request), progress_("rows", request.progress) {
    std::vector<std::string> names = table.names();
    for (const std::string& name : request.inputs) columns_.push_back(table.column(name));
    for (const std::string& name : request.results) {
      names.push_back(name);
      if (!table.has_column(name)) continue;
      throw table.complaint(table.header_line(),
                            fmt::format("the input already has a column '{}': rename or remove it", name));
    }
    header_ = csv_line(names);
    for (const si::Quantity* quantity : si::quantities()) {
      const std::string name(quantity->name);
      if (table.has_column(name) && !std::ranges::count(request.inputs, name))
        std::fputs(fmt::format("note: the column {0} is handed on and not read: all rows have one {0}\n", name).c_str(),
                   stderr);
    }
  }

  ExitStatus run() {
    work_in_order<Piece>(
        request_.threads, [this] { return table_.ready(); }, [this](Piece& piece) { return take(piece); },
        [this](Piece& piece) { work(piece); }, [this](Piece& piece) { hand_on(piece); });
    output_.write(header_);
    progress_.finish(static_cast<double>(rows_));
    if (overflows_ > 0) {
      std::fputs(fmt::format("{} exceeds the largest double and is written as inf ({} rows in all)\n", first_overflow_,
                             overflows_)
                     .c_str(),
                 stderr);
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

  /// @throws BadLine, std::runtime_error  with the place of the row at the beginning
  void add(const CsvRow& row, Piece& piece) {
    try {
      compute(row, piece);
      const auto infinite = std::ranges::find_if(piece.results, [](double x) { return std::isinf(x); });
      if (infinite != piece.results.end() && piece.overflows++ == 0) {
        const auto& name = request_.results[static_cast<std::size_t>(infinite - piece.results.begin())];
        piece.first_overflow = table_.complaint(row.line(), name).what();
      }
      piece.lines.append(row.text());
      for (double result : piece.results) fmt::format_to(fmt::appender(piece.lines), FMT_COMPILE(",{}"), result);
      piece.lines.push_back('\n');
    } catch (const BadLine& error) {
      keep_without_result(row, error, ExitStatus::bad_input, piece);
    } catch (const std::runtime_error& error) {
      keep_without_result(row, error, ExitStatus::numerical_failure, piece);
    }
  }

  void keep_without_result(const CsvRow& row, const std::exception& error, ExitStatus status, Piece& piece) const {
    if (!request_.keep_going) throw;
    piece.complaints.append(error.what()) += '\n';
    std::vector<std::string> fields(table_.names().size() + request_.results.size());
    for (std::size_t i = 0; i < std::min(row.size(), table_.names().size()); ++i) fields[i] = row[i];
    piece.lines.append(csv_line(fields));
    piece.status = std::max(piece.status, status);
  }

  /// @throws BadLine, std::runtime_error  with the place of the row at the beginning
  void compute(const CsvRow& row, Piece& piece) const {
    table_.require_complete(row);
    piece.values.clear();
    for (const CsvColumn& column : columns_) piece.values.push_back(table_.number(row, column));
    piece.results.resize(request_.results.size());
    try {
      request_.compute(piece.values, piece.results, row.line());
    } catch (const std::domain_error& error) {
      throw table_.complaint(row.line(), words_of(error.what()));
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(table_.complaint(row.line(), words_of(error.what())).what());
    }
  }

  CsvReader& table_;
  OutputFile& output_;
  const BatchRequest& request_;
  std::vector<CsvColumn> columns_;
  Progress progress_;
  std::string header_;  ///< header, written together with the first rows
  std::size_t rows_ = 0;
  long overflows_ = 0;
  std::string first_overflow_;
  ExitStatus status_ = ExitStatus::done;
};

}  // namespace

ExitStatus run_batch(CsvReader& table, OutputFile& output, const BatchRequest& request) {
  return Batch(table, output, request).run();
}

}  // namespace contensou::program
