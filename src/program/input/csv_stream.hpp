#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "input/csv_header.hpp"

namespace contensou::program {

/// Whole records of a CSV file, as they stand in it.
struct CsvBlock {
  std::string text;
  long first_line = 1;  ///< the number of the text's first line
};

/// One record of a block; views into it.
struct CsvRow {
  long line;  ///< on which it begins
  std::vector<std::string_view> fields;
  std::string_view plain;  ///< the line without its end, where no field needs quotes; empty otherwise
};

/// A CSV file of any length, in blocks of whole records: reading it takes memory for one block.
class CsvStream {
 public:
  /// Reads as far as the header.
  /// @param path  a file, or "-" for standard input
  /// @throws std::system_error  if it cannot be read
  /// @throws BadLine            if there is no header, or before it something that is not CSV
  explicit CsvStream(const std::string& path);
  ~CsvStream();
  CsvStream(const CsvStream&) = delete;
  CsvStream& operator=(const CsvStream&) = delete;

  const CsvHeader& header() const { return header_; }

  /// Fills the block with the next records; false at the end. A record longer than 64 MiB is refused.
  /// @throws  as the constructor
  bool next(CsvBlock& block);

 private:
  /// Appends to a text what one read gives, at most that many bytes.
  void read_some(std::string& text, std::size_t most);
  [[noreturn]] void refuse(const CsvBlock& block) const;

  std::string source_;
  int file_;
  bool at_end_ = false;
  bool at_begin_ = true;
  std::string rest_;  ///< what was read beyond the last block
  long line_ = 1;     ///< of the rest's beginning
  CsvHeader header_;
};

/// Calls take for every record of a block, in order.
/// @throws BadLine  where the text is not CSV
void for_each_row(const CsvBlock& block, const CsvHeader& header, const std::function<void(const CsvRow&)>& take);

}  // namespace contensou::program
