#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "answers/input/errors.hpp"
#include "answers/input/parse.hpp"
#include "platform/input_file.hpp"

namespace contensou::answers {

/// Returns a field without the spaces and tabs around it.
std::string_view without_spaces(std::string_view text);

class CsvRow;

/// Consecutive records of a table. They are stored together in a few arrays.
class CsvBlock {
 public:
  std::size_t size() const { return records_.size(); }
  CsvRow operator[](std::size_t place) const;

 private:
  friend CsvRow;
  friend class CsvParser;
  friend class CsvReader;

  struct Record {
    long line;
    std::size_t text_begin, text_size;
    std::size_t field_begin, fields;
  };

  std::vector<Record> records_;
  std::string text_;                  ///< text of all records, as in the file
  std::string values_;                ///< values of all fields, one after the other
  std::vector<std::size_t> ends_{0};  ///< field i consists of the characters of values_ from ends_[i] to ends_[i + 1]
};

/// One record of a table: a view into its block.
class CsvRow {
 public:
  CsvRow(const CsvBlock& block, const CsvBlock::Record& record) : block_(block), record_(record) {}

  /// Returns the line on which the record begins, counted from 1. Lines end in LF, CR LF or CR, also inside quotes.
  long line() const { return record_.line; }

  /// Returns the record as it stands in the file, without the end of its line.
  std::string_view text() const { return std::string_view(block_.text_).substr(record_.text_begin, record_.text_size); }

  /// Returns the number of fields.
  std::size_t size() const { return record_.fields; }

  /// Returns a field without its quotes.
  std::string_view operator[](std::size_t field) const {
    const std::size_t* ends = &block_.ends_[record_.field_begin + field];
    return std::string_view(block_.values_).substr(ends[0], ends[1] - ends[0]);
  }

 private:
  const CsvBlock& block_;
  const CsvBlock::Record& record_;
};

inline CsvRow CsvBlock::operator[](std::size_t place) const { return {*this, records_[place]}; }

/// Finds the records in CSV text (RFC 4180). The text comes in pieces that may be cut anywhere. Outside quotes, lines
/// that begin with # are comments, and empty lines are ignored.
class CsvParser {
 public:
  /// @param source  name of the text in messages
  explicit CsvParser(std::string source) : source_(std::move(source)) {}

  /// Appends to a block the records that end in the next piece of text.
  /// @throws BadLine  for a quote inside a field, or a record longer than 64 MiB; earlier records are appended first
  void add(std::string_view piece, CsvBlock& block);

  /// Appends the last record if it has no line end.
  /// @throws BadLine  if the text ends inside quotes
  void finish(CsvBlock& block);

  /// Sets the letter that separates fields; to be called before add.
  void separate_by(char letter) { separator_ = letter; }

  const std::string& source() const { return source_; }
  BadLine complaint(long line, std::string_view message) const;

 private:
  enum class Place { between_records, comment, field_start, field, quoted, after_quote };

  void add(char letter, CsvBlock& block);
  void end_record(CsvBlock& block);

  std::string source_;
  char separator_ = ',';
  Place place_ = Place::between_records;
  long line_ = 0;
  bool at_line_start_ = true;
  bool after_return_ = false;  ///< true: the last letter was CR; an LF that follows belongs to the same line end
  long record_line_ = 0;
  long quote_line_ = 0;  ///< line of the opening quote of the field
  std::string text_;     ///< text of the record so far
  std::string values_;   ///< values of the fields of the record
  std::vector<std::size_t> ends_;
};

/// A column of a table.
struct CsvColumn {
  std::string name;
  std::size_t place;
};

/// Reads a CSV file with a header. The file may have any length, because only one block is in memory.
class CsvReader {
 public:
  /// The letters that may separate fields.
  enum class Separator { comma, any };

  /// Reads the file up to the end of the header.
  /// @param path       a file, or "-" for standard input
  /// @param separator  any: tabs or semicolons separate if the header contains them and no comma. A title may precede
  ///                   the header, and a row of units may follow it. With semicolons a decimal may take a comma
  /// @throws std::system_error  if the file cannot be read
  /// @throws BadLine            if the header is missing or is not CSV; for a file in UTF-16, with advice
  explicit CsvReader(const std::string& path, Separator separator = Separator::comma);

  /// Reads text from memory.
  /// @param source  name of the text in messages
  /// @throws BadLine  as the constructor above
  CsvReader(std::string text, const std::string& source);
  CsvReader(const CsvReader&) = delete;
  CsvReader& operator=(const CsvReader&) = delete;

  const std::vector<std::string>& names() const { return names_; }
  long header_line() const { return header_line_; }

  /// Returns the column with a name. Spaces around names are ignored.
  /// @throws BadLine  unless there is exactly one such column; with advice if semicolons or tabs separate columns
  CsvColumn column(std::string_view name) const;
  bool has_column(std::string_view name) const;

  /// Returns true if `next` can return without waiting for input.
  bool ready() const;

  /// Reads the next records: those that the input supplies before it pauses, about 32 kB at most.
  /// @return  false at the end of the file
  /// @throws BadLine            as CsvParser, after all records before the mistake have been returned
  /// @throws std::system_error  if the file cannot be read
  bool next(CsvBlock& block);

  /// Calls a function with each remaining record.
  /// @throws BadLine  as next and require_complete
  void for_each_row(const std::function<void(const CsvRow&)>& take);

  /// @throws BadLine  unless the record has as many fields as the header
  void require_complete(const CsvRow& row) const;

  /// Returns the number in a field of a complete record.
  /// @throws BadLine  with the name of the column, if the field is not a number
  double number(const CsvRow& row, const CsvColumn& column, Infinity infinity = Infinity::forbidden) const;

  BadLine complaint(long line, std::string_view message) const { return parser_.complaint(line, message); }

  /// Returns the share of the file that was read, 0 to 1; NaN for a file of unknown length.
  double fraction_read() const { return bytes_read_ / bytes_; }

 private:
  void read_header(Separator separator);

  /// Sets tabs or semicolons as separators if the first line with a separator contains no comma. Text above it is a
  /// comment.
  void find_separator();

  /// Moves the units in a row below the header into the names, as in "x [mm]". No field of such a row is a number.
  void take_units(CsvBlock& block);

  /// Returns a number with a point in place of its decimal comma.
  std::string decimal(std::string_view field) const;

  /// Reads once from the file and appends the result to the buffer.
  void read_some();

  std::optional<platform::InputFile> file_;  ///< empty: the buffer contains the whole text
  CsvParser parser_;
  std::string buffer_;
  double bytes_ = std::numeric_limits<double>::quiet_NaN();  ///< size of the file, if known
  double bytes_read_ = 0;
  bool at_end_ = false;
  bool decimal_commas_ = false;
  std::optional<BadLine> fault_;  ///< error of a later record, thrown when all records before that record were returned
  CsvBlock first_;                ///< records read together with the header
  std::vector<std::string> names_;
  long header_line_ = 1;
};

/// Returns the numbers >= 0 in one column of a table, or in a file of one number per line without a header.
/// @param path  a file, or "-" for standard input
/// @throws  as CsvReader; BadLine for any other number, with the line of that number
std::vector<double> read_column(const std::string& path, std::string_view name, Infinity infinity);

}  // namespace contensou::answers
