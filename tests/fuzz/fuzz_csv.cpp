// A table must give the same rows, line numbers and error message however its text arrives: at once, in pieces cut
// anywhere, or from a file. The first byte of the input shifts the text relative to the blocks of the file.
#include <optional>
#include <vector>

#include "answers/input/csv.hpp"
#include "finding.hpp"

using namespace contensou;
using answers::BadLine;

namespace {

constexpr const char* source = "table";

struct Row {
  long line;
  std::string text;
  std::vector<std::string> fields;
  bool operator==(const Row&) const = default;
};

struct Table {
  std::vector<Row> rows;
  std::string complaint;  ///< message without the name of the text
  bool operator==(const Table&) const = default;

  void add(const answers::CsvRow& row, long before = 0) {
    Row& added = rows.emplace_back(Row{row.line() - before, std::string(row.text()), {}});
    for (std::size_t i = 0; i < row.size(); ++i) added.fields.emplace_back(row[i]);
  }
};

std::string message_of(const BadLine& error, std::string_view name, long lines_before = 0) {
  fuzz::require_readable(error.what());
  const std::string message = error.what();
  fuzz::require(message.starts_with(fmt::format("{}:", name)), message);
  std::size_t digits = 0;
  const long line = std::stol(message.substr(name.size() + 1), &digits);
  std::string rest = message.substr(name.size() + 1 + digits);
  // A message about an open quote also names the line that closes the quote.
  constexpr std::string_view open_quote = ": a quote inside a field, or one that closes on line ";
  if (rest.starts_with(open_quote)) {
    const long last = std::stol(rest.substr(open_quote.size()), &digits);
    rest.replace(open_quote.size(), digits, fmt::format("{}", last - lines_before));
  }
  return fmt::format("{}{}", line - lines_before, rest);
}

/// @param cut  returns the size of the next piece, 1 or more
template <class Cut>
Table parsed(std::string_view text, Cut cut) {
  Table table;
  answers::CsvParser parser(source);
  answers::CsvBlock block;
  try {
    while (!text.empty()) {
      const std::size_t size = std::min<std::size_t>(cut(), text.size());
      parser.add(text.substr(0, size), block);
      text.remove_prefix(size);
    }
    parser.finish(block);
  } catch (const BadLine& error) {
    table.complaint = message_of(error, source);
  }
  for (std::size_t i = 0; i < block.size(); ++i) table.add(block[i]);
  return table;
}

/// @param before  bytes of comment before the text; it moves the end of the reader's first block
Table read(std::string_view text, std::size_t before) {
  const fuzz::MemoryFile file(fmt::format("#{:.^{}}\n{}", "", before, text));
  Table table;
  try {
    answers::CsvReader reader(file.path());
    std::optional<answers::CsvBlock> block(std::in_place);
    Row header{reader.header_line() - 1, "", reader.names()};
    table.rows.push_back(std::move(header));
    while (reader.next(*block)) {
      for (std::size_t i = 0; i < block->size(); ++i) {
        table.add((*block)[i], 1);
        try {
          reader.require_complete((*block)[i]);
          for (std::size_t place = 0; place < reader.names().size(); ++place) {
            reader.number((*block)[i], {"column", place});
          }
        } catch (const BadLine& error) {
          fuzz::require_readable(error.what());
        }
      }
    }
    reader.column("mu");
  } catch (const BadLine& error) {
    table.complaint = message_of(error, file.path(), 1);
  }
  return table;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 1) return 0;
  const std::uint8_t first = *data;
  const std::string_view text = fuzz::text_of(data + 1, size - 1);
  const Table whole = parsed(text, [] { return std::string_view::npos; });
  fuzz::require(parsed(text, [] { return std::size_t{1}; }) == whole, "letter by letter");
  std::uint32_t state = first;
  const auto any = [&state] { return ((state = state * 1664525 + 1013904223) >> 24) % 16 + 1; };
  fuzz::require(parsed(text, any) == whole, "in pieces");

  Table from_file = read(text, (1 << 15) - first);
  if (whole.rows.empty()) {
    const std::string expected = whole.complaint.empty() ? "0: empty input" : whole.complaint;
    fuzz::require(from_file.rows.empty() && from_file.complaint.starts_with(expected), from_file.complaint);
    return 0;
  }
  fuzz::require(!from_file.rows.empty(), from_file.complaint);
  from_file.rows.front().text = whole.rows.front().text;  // the reader does not keep the text of the header
  fuzz::require(from_file.rows == whole.rows, "rows from a file");
  fuzz::require(whole.complaint.empty() || from_file.complaint == whole.complaint, from_file.complaint);
  return 0;
}
