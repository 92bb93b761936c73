#include "input/csv_parser.hpp"

#include <algorithm>

namespace contensou::program {

namespace {

/// A field's buffer grows by so much at a time: by libcsv's 128 bytes, a long field costs the square of its length.
constexpr std::size_t buffer_growth = std::size_t{1} << 20;

}  // namespace

CsvParser::CsvParser(long first_line, TakeRecord take) : take_(std::move(take)), line_(first_line - 1) {
  csv_init(&parser_, CSV_STRICT | CSV_STRICT_FINI);
  csv_set_blk_size(&parser_, buffer_growth);
  csv_set_space_func(&parser_, [](unsigned char) { return 0; });  // spaces belong to the field
}

bool CsvParser::add_line(std::string_view line) {
  ++line_;
  const bool blank = line.find_first_not_of("\r\n") == std::string_view::npos;
  if (!open_ && (blank || line.starts_with('#'))) return true;
  if (!open_) record_ = {line_, {}};
  open_ = true;
  return csv_parse(&parser_, line.data(), line.size(), take_field, take_record, this) == line.size();
}

bool CsvParser::finish() { return csv_fini(&parser_, take_field, take_record, this) == 0; }

void CsvParser::take_field(void* field, std::size_t size, void* parser) {
  static_cast<CsvParser*>(parser)->record_.fields.emplace_back(static_cast<const char*>(field), size);
}

void CsvParser::take_record(int /*terminator*/, void* parser) {
  auto& self = *static_cast<CsvParser*>(parser);
  self.open_ = false;
  self.take_(std::move(self.record_));
  self.record_ = {self.line_, {}};
}

std::string_view first_line(std::string_view text) {
  return text.substr(0, std::min(text.find('\n'), text.size() - 1) + 1);
}

std::size_t byte_order_mark_size(std::string_view text) {
  constexpr std::string_view mark = "\xEF\xBB\xBF";
  return text.starts_with(mark) ? mark.size() : 0;
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
