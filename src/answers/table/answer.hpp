#pragma once

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

/// How text rounds numbers.
struct Digits {
  int count;  ///< significant ones

  /// Of a column: with sign, point, exponent and two spaces.
  int width() const { return count + 8; }
  std::string operator()(double value) const;

  /// (a, b, ...)
  template <class Values>
  std::string list(const Values& values) const {
    std::string text;
    for (double value : values) text += (text.empty() ? "(" : ", ") + (*this)(value);
    return text + ")";
  }
};

/// What a verb answers, for every format.
struct Answer {
  Json members = Json::object();         ///< of the JSON document, after the number of its schema and the version
  std::vector<Column> columns = {};      ///< of CSV and text; the last members of JSON
  Json remarks = Json::object();         ///< of CSV with columns: a line of comment each, before the header
  std::vector<Json> rows = {};           ///< of CSV where there are no columns: objects with the same names
  std::vector<std::string> beside = {};  ///< names in rows that a table in a paper has no room for
  std::function<std::string(const Digits&)> text = {};  ///< empty: the columns, or the rows as in CSV
  std::function<Answer()> numbers = {};  ///< makes the answer for every format except text; empty: this answer
};

/// The formats of an answer, the standard one first.
std::vector<std::string> answer_formats(const std::string& standard);

/// The text of an answer. CSV and JSON have the shortest digits that read back to the same double; CSV has the members
/// of an object in a row as columns of their own. TeX is a tabular for \input, with the same columns and text's digits; of
/// fewer rows than columns it is turned.
/// @param format  one of answer_formats
/// @throws std::runtime_error  for NaN, which JSON cannot say
/// @throws std::domain_error   for a letter that LaTeX has not
std::string render(const Answer& answer, const std::string& format, Digits digits);

/// The fields as a line of CSV, in quotes where they need them.
std::string csv_line(const std::vector<std::string>& fields);

/// The entries of a vector, as a list.
template <class Values>
Json list_of(const Values& values) {
  return std::vector(values.begin(), values.end());
}

/// The number, or infinity for what is none: no format says NaN.
double or_infinity(double value);

}  // namespace contensou::answers
