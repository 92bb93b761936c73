#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace contensou::tests {

/// One row of a table in tests/reference.
class ReferenceRow {
 public:
  ReferenceRow(std::shared_ptr<const std::vector<std::string>> columns, std::vector<std::string> cells);

  bool has(std::string_view column) const;

  /// @throws std::out_of_range  if the table has no such column
  const std::string& text(std::string_view column) const;

  /// Returns an input: the double in COLUMN_hex, or without this column the double nearest to the decimal number.
  double input(std::string_view column) const;

  /// Returns a result of many digits, rounded to long double; infinity if it is too large.
  long double result(std::string_view column) const;

  /// Returns the inputs as text for a message.
  std::string where() const;

 private:
  std::shared_ptr<const std::vector<std::string>> columns_;
  std::vector<std::string> cells_;
};

/// Returns the rows of tests/reference/NAME.csv; tests/reference/README.md describes the columns.
/// @throws std::runtime_error  if the file is missing, has no rows, or a row has the wrong number of cells
std::vector<ReferenceRow> reference_table(const std::string& name);

}  // namespace contensou::tests
