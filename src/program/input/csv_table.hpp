#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "input/csv_header.hpp"
#include "input/csv_parser.hpp"

namespace contensou::program {

/// A CSV file with a header, whole; for one of any length, CsvStream.
class CsvTable {
 public:
  /// @param source  what messages call the text
  /// @throws BadLine  for text that is not CSV, or that has no header
  CsvTable(std::string_view text, const std::string& source);

  /// @param path  a file, or "-" for standard input
  /// @throws std::system_error  if it cannot be read, and as the constructor
  static CsvTable read(const std::string& path);

  const CsvHeader& header() const { return header_; }
  const std::vector<CsvRecord>& rows() const { return rows_; }

  /// As those of CsvHeader.
  std::size_t column(std::string_view name) const { return header_.column(name); }
  void require_complete(const CsvRecord& row) const { header_.require_complete(row.line, row.fields.size()); }
  BadLine complaint(long line, std::string_view message) const { return header_.complaint(line, message); }

 private:
  CsvHeader header_;
  std::vector<CsvRecord> rows_;
};

}  // namespace contensou::program
