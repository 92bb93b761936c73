#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

namespace contensou::answers {

using Json = nlohmann::ordered_json;

/// A column of numbers.
struct Column {
  std::string name;
  Eigen::ArrayXd values;
};

/// Number of digits to which text rounds numbers.
struct Digits {
  int count;  ///< significant digits

  /// Returns the width of a column of numbers: digits, sign, point, exponent and two spaces.
  int width() const { return count + 8; }
  std::string operator()(double value) const;

  /// Returns the values as text "(a, b, ...)".
  template <class Values>
  std::string list(const Values& values) const {
    std::string text;
    for (double value : values) text += (text.empty() ? "(" : ", ") + (*this)(value);
    return text + ")";
  }
};

/// The answer of a verb (a command of the program). Every output format is computed from this answer.
struct Answer {
  Json members = Json::object();         ///< members of JSON after the schema number and the version
  std::vector<Column> columns = {};      ///< columns of CSV and text; the last members of JSON
  Json remarks = Json::object();         ///< comment lines before the header, for CSV with columns
  std::vector<Json> rows = {};           ///< rows of CSV without columns: objects, all with the same names
  std::vector<std::string> beside = {};  ///< names in rows that TeX leaves out, because a paper has no room for them
  std::function<std::string(const Digits&)> text = {};  ///< text for people; empty: the columns, or the rows as in CSV
  std::function<Answer()> numbers = {};  ///< returns the answer for every format except text; empty: this answer
  bool passed = true;                    ///< false: a check failed, or nothing was found
};

/// Returns the formats of an answer, the default first.
std::vector<std::string> answer_formats(const std::string& standard);

/// Returns an answer in a format. CSV and JSON contain the shortest digits that read back to the same double. In CSV
/// each member of an object in a row has its own column. TeX is a tabular for \input with the same columns, and with as
/// many digits as text. A table with fewer rows than columns is transposed.
/// @param format  one of answer_formats
/// @throws std::runtime_error  for NaN, which JSON cannot represent
/// @throws std::domain_error   for a letter that LaTeX does not have
std::string render(const Answer& answer, const std::string& format, Digits digits);

/// Returns the fields as a line of CSV, with quotes around fields that need them.
std::string csv_line(const std::vector<std::string>& fields);

/// Returns the entries of a vector as a list.
template <class Values>
Json list_of(const Values& values) {
  return std::vector(values.begin(), values.end());
}

/// Returns the value, or infinity if the value is NaN. No format can write NaN.
double or_infinity(double value);

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
