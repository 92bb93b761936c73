#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <csv.h>

namespace contensou::program {

/// One record of a CSV file.
struct CsvRecord {
  long line;  ///< on which it begins, counted from 1
  std::vector<std::string> fields;
};

/// The records of CSV text (RFC 4180), given line after line, so that the line of each is known. Outside quotes, lines
/// that begin with # are comments and empty lines count as none.
class CsvParser {
 public:
  using TakeRecord = std::function<void(CsvRecord)>;

  /// @param first_line  the number of the first line
  /// @param take        is given each record when it ends
  CsvParser(long first_line, TakeRecord take);
  ~CsvParser() { csv_free(&parser_); }
  CsvParser(const CsvParser&) = delete;
  CsvParser& operator=(const CsvParser&) = delete;

  /// @param line  with its line end
  /// @return      false if the line is not CSV: it has a quote inside a field
  bool add_line(std::string_view line);

  /// Ends a record whose last line has no line end.
  /// @return  false if the text ends inside quotes
  bool finish();

  /// The line that was added last.
  long line() const { return line_; }

  /// The line on which the record begins that has not ended yet.
  long record_line() const { return record_.line; }

  /// Whether a record has begun and not ended.
  bool open() const { return open_; }

 private:
  static void take_field(void* field, std::size_t size, void* parser);
  static void take_record(int terminator, void* parser);

  csv_parser parser_{};
  TakeRecord take_;
  CsvRecord record_{0, {}};
  bool open_ = false;
  long line_;
};

/// The first line of a text with its line end; all of it if it has none.
std::string_view first_line(std::string_view text);

/// How many bytes of a text's beginning are the mark that Windows puts there.
std::size_t byte_order_mark_size(std::string_view text);

/// The fields as a line of CSV, in quotes where they need them.
std::string csv_line(const std::vector<std::string>& fields);

}  // namespace contensou::program
