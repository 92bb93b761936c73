#include "output/columns.hpp"

#include <fmt/format.h>

namespace contensou::program {

namespace {

/// A line for the names and one for each row, every cell written by the caller.
template <class WriteName, class WriteValue>
std::string lines(const std::vector<Column>& columns, WriteName write_name, WriteValue write_value) {
  std::string text;
  for (const Column& column : columns) write_name(text, column.name, &column == &columns.back());
  for (Eigen::Index row = 0; row < columns.front().values.size(); ++row) {
    for (const Column& column : columns) write_value(text, column.values[row], &column == &columns.back());
  }
  return text;
}

}  // namespace

std::string csv_line(const std::vector<std::string>& fields) {
  std::string line;
  for (const std::string& field : fields) {
    const bool first = &field == &fields.front();
    if (!first) line += ',';
    const bool comment = first && field.starts_with('#');
    const bool blank = fields.size() == 1 && field.empty();
    if (!comment && !blank && field.find_first_of(",\"\r\n") == std::string::npos) {
      line += field;
      continue;
    }
    line += '"';
    for (char letter : field) line += letter == '"' ? "\"\"" : std::string(1, letter);
    line += '"';
  }
  return line + '\n';
}

std::string columns_as_csv(const std::vector<Column>& columns) {
  const auto write = [](std::string& text, const auto& cell, bool last) {
    fmt::format_to(std::back_inserter(text), "{}{}", cell, last ? '\n' : ',');
  };
  return lines(columns, write, write);
}

std::string columns_as_text(const std::vector<Column>& columns, int digits) {
  const int width = digits + 8;  // sign, point, exponent and two spaces
  return lines(
      columns,
      [&](std::string& text, const std::string& name, bool last) {
        fmt::format_to(std::back_inserter(text), "{:>{}}{}", name, width, last ? "\n" : "");
      },
      [&](std::string& text, double value, bool last) {
        fmt::format_to(std::back_inserter(text), "{:>{}.{}g}{}", value, width, digits, last ? "\n" : "");
      });
}

}  // namespace contensou::program
