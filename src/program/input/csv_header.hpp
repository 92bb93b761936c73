#pragma once

#include <string>
#include <string_view>

#include "exit_status.hpp"
#include "input/csv_parser.hpp"

namespace contensou::program {

/// The header of a CSV file: where its columns are, and complaints about its lines.
class CsvHeader {
 public:
  CsvHeader() = default;

  /// @param source  what messages call the file
  CsvHeader(CsvRecord record, std::string source) : record_(std::move(record)), source_(std::move(source)) {}

  long line() const { return record_.line; }
  const std::vector<std::string>& names() const { return record_.fields; }

  bool has_column(std::string_view name) const;

  /// The place of a column.
  /// @throws BadLine  unless exactly one column has that name
  std::size_t column(std::string_view name) const;

  /// @throws BadLine  if a record does not have as many fields as the header
  void require_complete(long line, std::size_t fields) const;

  /// A complaint about a line.
  BadLine complaint(long line, std::string_view message) const { return complaint(source_, line, message); }
  static BadLine complaint(std::string_view source, long line, std::string_view message);

 private:
  CsvRecord record_{0, {}};
  std::string source_;
};

/// What is wrong with text that is not CSV, or has no header.
namespace csv_fault {
constexpr std::string_view stray_quote = "a quote inside a field: put the field in quotes and double those inside";
constexpr std::string_view open_quotes = "the quotes that open here are never closed";
constexpr std::string_view empty = "empty input: a header line with the names of the columns is needed";
}  // namespace csv_fault

}  // namespace contensou::program
