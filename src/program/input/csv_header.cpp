#include "input/csv_header.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "input/quotation.hpp"

namespace contensou::program {

namespace {

/// A column's name without the spaces around it.
std::string_view trimmed(std::string_view name) {
  const auto first = name.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return name.substr(first, name.find_last_not_of(" \t") - first + 1);
}

}  // namespace

bool CsvHeader::has_column(std::string_view name) const {
  return std::ranges::find(names(), name, trimmed) != names().end();
}

std::size_t CsvHeader::column(std::string_view name) const {
  const auto count = std::ranges::count(names(), name, trimmed);
  if (count == 1) return static_cast<std::size_t>(std::ranges::find(names(), name, trimmed) - names().begin());
  if (count > 1) throw complaint(line(), fmt::format("{} columns are called '{}'; one is allowed", count, name));
  std::vector<std::string> quoted;
  std::ranges::transform(names(), std::back_inserter(quoted), quotation);
  throw complaint(line(), fmt::format("no column is called '{}'; the columns are {}", name, fmt::join(quoted, ", ")));
}

void CsvHeader::require_complete(long line, std::size_t fields) const {
  if (fields == names().size()) return;
  throw complaint(line, fmt::format("{} fields where the header has {}", fields, names().size()));
}

BadLine CsvHeader::complaint(std::string_view source, long line, std::string_view message) {
  return BadLine(fmt::format("{}:{}: {}", source, line, message));
}

}  // namespace contensou::program
