#include "csv_table.hpp"

#include <algorithm>
#include <cstdio>
#include <memory>

#include <csv.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "contensou/si/text_file.hpp"

namespace contensou::program {

namespace {

/// A column's name without the spaces around it.
std::string_view trimmed(std::string_view name) {
  const auto first = name.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return name.substr(first, name.find_last_not_of(" \t") - first + 1);
}

/// The records of a text, one line after the other, so that the line of each is known.
class CsvReader {
 public:
  explicit CsvReader(std::vector<CsvRecord>& records) : records_(records) {
    csv_init(&parser_, CSV_STRICT | CSV_STRICT_FINI);
    csv_set_space_func(&parser_, [](unsigned char) { return 0; });  // spaces belong to the field
  }
  ~CsvReader() { csv_free(&parser_); }
  CsvReader(const CsvReader&) = delete;
  CsvReader& operator=(const CsvReader&) = delete;

  /// False if the line is not CSV.
  bool add_line(std::string_view line) {
    ++line_;
    const bool blank = line.find_first_not_of("\r\n") == std::string_view::npos;
    if (!open_ && (blank || line.starts_with('#'))) return true;
    if (!open_) record_ = {line_, {}};
    open_ = true;
    return csv_parse(&parser_, line.data(), line.size(), take_field, take_record, this) == line.size();
  }

  /// False if the text ends inside quotes.
  bool finish() { return csv_fini(&parser_, take_field, take_record, this) == 0; }

  long line() const { return line_; }
  long record_line() const { return record_.line; }

 private:
  static void take_field(void* field, std::size_t size, void* reader) {
    static_cast<CsvReader*>(reader)->record_.fields.emplace_back(static_cast<const char*>(field), size);
  }

  static void take_record(int /*terminator*/, void* reader) {
    auto& self = *static_cast<CsvReader*>(reader);
    self.records_.push_back(std::move(self.record_));
    self.open_ = false;
  }

  csv_parser parser_{};
  std::vector<CsvRecord>& records_;
  CsvRecord record_{0, {}};
  bool open_ = false;  ///< inside a record
  long line_ = 0;
};

}  // namespace

CsvTable::CsvTable(std::string_view text, std::string source) : source_(std::move(source)) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  CsvReader reader(rows_);
  while (!text.empty()) {
    const std::size_t size = std::min(text.find('\n'), text.size() - 1) + 1;
    if (!reader.add_line(text.substr(0, size))) {
      throw complaint(reader.line(), "a quote inside a field: put the field in quotes and double those inside");
    }
    text.remove_prefix(size);
  }
  if (!reader.finish()) throw complaint(reader.record_line(), "the quotes that open here are never closed");
  if (rows_.empty()) throw complaint(1, "empty input: a header line with the names of the columns is needed");
  header_ = std::move(rows_.front());
  rows_.erase(rows_.begin());
}

CsvTable CsvTable::read(const std::string& path) {
  if (path == "-") return {si::read_text(stdin, "<stdin>"), "<stdin>"};
  return {si::read_text_file(path), path};
}

bool CsvTable::has_column(std::string_view name) const {
  return std::ranges::find(header_.fields, name, trimmed) != header_.fields.end();
}

std::size_t CsvTable::column(std::string_view name) const {
  const auto count = std::ranges::count(header_.fields, name, trimmed);
  if (count == 1) {
    return static_cast<std::size_t>(std::ranges::find(header_.fields, name, trimmed) - header_.fields.begin());
  }
  if (count > 1) throw complaint(header_.line, fmt::format("{} columns are called '{}'; one is allowed", count, name));
  throw complaint(header_.line,
                  fmt::format("no column is called '{}'; the columns are {}", name, fmt::join(header_.fields, ", ")));
}

void CsvTable::require_complete(const CsvRecord& row) const {
  if (row.fields.size() == header_.fields.size()) return;
  throw complaint(row.line, fmt::format("{} fields where the header has {}", row.fields.size(), header_.fields.size()));
}

BadLine CsvTable::complaint(long line, std::string_view message) const {
  return BadLine(fmt::format("{}:{}: {}", source_, line, message));
}

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

}  // namespace contensou::program
