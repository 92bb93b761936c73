#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace contensou::answers {

/// A table for people. It consists of lines of cells, each padded to the width of its column. Words at the end of a
/// line are not padded and may be longer than their column, so that no line ends in spaces.
class TextTable {
 public:
  struct Column {
    std::size_t
        width;   ///< smallest width; a wider cell widens the column; numbers after another column get two more spaces
    char align;  ///< < for left, > for right
  };

  /// Return a column of words, aligned left, and a column of numbers, aligned right.
  static Column left(int width = 0) { return {static_cast<std::size_t>(width), '<'}; }
  static Column right(int width) { return {static_cast<std::size_t>(width), '>'}; }

  explicit TextTable(std::vector<Column> columns) : columns_(std::move(columns)) {}

  /// Adds a line. Cells beyond the last column are neither padded nor aligned.
  void add(std::vector<std::string> cells) { lines_.push_back(std::move(cells)); }

  std::string text() const;

 private:
  std::vector<Column> columns_;
  std::vector<std::vector<std::string>> lines_;
};

}  // namespace contensou::answers
