#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "exit_status.hpp"

namespace contensou::program {

/// One record of a CSV file.
struct CsvRecord {
  long line;  ///< on which it begins, counted from 1
  std::vector<std::string> fields;
};

/// A CSV file (RFC 4180) with a header; lines that begin with # are comments, empty lines count as none.
class CsvTable {
 public:
  /// @param source  what messages call the text
  /// @throws BadLine  for text that is not CSV, or that has no header
  CsvTable(std::string_view text, std::string source);

  /// @param path  a file, or "-" for standard input
  /// @throws std::system_error  if it cannot be read, and as the constructor
  static CsvTable read(const std::string& path);

  const CsvRecord& header() const { return header_; }
  const std::vector<CsvRecord>& rows() const { return rows_; }

  bool has_column(std::string_view name) const;

  /// The place of a column.
  /// @throws BadLine  unless exactly one column has that name
  std::size_t column(std::string_view name) const;

  /// @throws BadLine  if a record does not have as many fields as the header
  void require_complete(const CsvRecord& row) const;

  /// A complaint about a line.
  BadLine complaint(long line, std::string_view message) const;

 private:
  std::string source_;
  CsvRecord header_;
  std::vector<CsvRecord> rows_;
};

/// The fields as a line of CSV, in quotes where they need them.
std::string csv_line(const std::vector<std::string>& fields);

}  // namespace contensou::program
