#include "input/csv_table.hpp"

#include <cstdio>

#include "contensou/si/text_file.hpp"

namespace contensou::program {

CsvTable::CsvTable(std::string_view text, const std::string& source) {
  text.remove_prefix(byte_order_mark_size(text));
  CsvParser parser(1, [this](CsvRecord record) { rows_.push_back(std::move(record)); });
  while (!text.empty()) {
    const std::string_view line = first_line(text);
    if (!parser.add_line(line)) throw CsvHeader::complaint(source, parser.line(), csv_fault::stray_quote);
    text.remove_prefix(line.size());
  }
  if (!parser.finish()) throw CsvHeader::complaint(source, parser.record_line(), csv_fault::open_quotes);
  if (rows_.empty()) throw CsvHeader::complaint(source, 1, csv_fault::empty);
  header_ = {std::move(rows_.front()), source};
  rows_.erase(rows_.begin());
}

CsvTable CsvTable::read(const std::string& path) {
  if (path == "-") return {si::read_text(stdin, "<stdin>"), "<stdin>"};
  return {si::read_text_file(path), path};
}

}  // namespace contensou::program
