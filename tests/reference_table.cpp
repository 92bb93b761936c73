#include "reference_table.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace contensou::tests {

namespace {

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells(1);
  for (char c : line) {
    if (c == ',') {
      cells.emplace_back();
    } else if (c != '\r') {
      cells.back() += c;
    }
  }
  return cells;
}

}  // namespace

ReferenceRow::ReferenceRow(std::shared_ptr<const std::vector<std::string>> columns, std::vector<std::string> cells)
    : columns_(std::move(columns)), cells_(std::move(cells)) {}

bool ReferenceRow::has(std::string_view column) const {
  return std::ranges::find(*columns_, column) != columns_->end();
}

const std::string& ReferenceRow::text(std::string_view column) const {
  const auto found = std::ranges::find(*columns_, column);
  if (found == columns_->end()) throw std::out_of_range("reference table: no column " + std::string(column));
  return cells_[static_cast<std::size_t>(found - columns_->begin())];
}

double ReferenceRow::input(std::string_view column) const {
  const std::string hex = std::string(column) + "_hex";
  return std::strtod(text(has(hex) ? std::string_view(hex) : column).c_str(), nullptr);
}

long double ReferenceRow::result(std::string_view column) const { return std::strtold(text(column).c_str(), nullptr); }

std::string ReferenceRow::where() const {
  std::string sentence;
  for (std::string_view column : {"law", "k", "chi", "gamma", "mu", "u0", "v0", "fraction"}) {
    if (!has(column) || (column == "k" && has("mu"))) continue;  // if the table has mu, k is no input
    sentence += (sentence.empty() ? "" : ", ") + std::string(column) + " = " + text(column);
  }
  return sentence;
}

std::vector<ReferenceRow> reference_table(const std::string& name) {
  const std::string path = fmt::format("{}/{}.csv", CONTENSOU_REFERENCE_FOLDER, name);
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line)) throw std::runtime_error("reference table: cannot read " + path);
  const auto columns = std::make_shared<const std::vector<std::string>>(split(line));
  std::vector<ReferenceRow> rows;
  while (std::getline(file, line)) {
    std::vector<std::string> cells = split(line);
    if (cells.size() != columns->size()) throw std::runtime_error("reference table: bad row in " + path + ": " + line);
    rows.emplace_back(columns, std::move(cells));
  }
  if (rows.empty()) throw std::runtime_error("reference table: no rows in " + path);
  return rows;
}

}  // namespace contensou::tests
