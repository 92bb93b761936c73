#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace contensou::answers {

/// A table for people: lines of cells, each padded to the width of its column. A line does not end in spaces: words at
/// its end are not padded, and may be longer than their column.
class TextTable {
 public:
  struct Column {
    std::size_t
        width;   ///< least width; a column is as wide as its widest cell, numbers behind another column two wider
    char align;  ///< < or >
  };

  /// Columns of words, at the left; and of numbers, at the right.
  static Column left(int width = 0) { return {static_cast<std::size_t>(width), '<'}; }
  static Column right(int width) { return {static_cast<std::size_t>(width), '>'}; }

  explicit TextTable(std::vector<Column> columns) : columns_(std::move(columns)) {}

  /// A line. Cells beyond the last column stand as they are.
  void add(std::vector<std::string> cells) { lines_.push_back(std::move(cells)); }

  std::string text() const;

 private:
  std::vector<Column> columns_;
  std::vector<std::vector<std::string>> lines_;
};

}  // namespace contensou::answers
