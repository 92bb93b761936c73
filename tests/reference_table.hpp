#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace contensou::tests {

/// One row of a table of tests/reference.
class ReferenceRow {
 public:
  ReferenceRow(std::shared_ptr<const std::vector<std::string>> columns, std::vector<std::string> cells);

  bool has(std::string_view column) const;

  /// @throws std::out_of_range  if the table has no such column
  const std::string& text(std::string_view column) const;

  /// An input: the double that COLUMN_hex spells, or else the double nearest to the decimal.
  double input(std::string_view column) const;

  /// A result of many digits, rounded to long double; infinity where it exceeds that.
  long double result(std::string_view column) const;

  /// The inputs as they stand in the table, for a message.
  std::string where() const;

 private:
  std::shared_ptr<const std::vector<std::string>> columns_;
  std::vector<std::string> cells_;
};

/// The rows of tests/reference/NAME.csv; tests/reference/README.md says what the columns are.
/// @throws std::runtime_error  if the file is missing, has no rows, or a row has the wrong number of cells
std::vector<ReferenceRow> reference_table(const std::string& name);

}  // namespace contensou::tests
