#include "input/csv_stream.hpp"

#include <algorithm>
#include <cerrno>
#include <optional>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

#include <fmt/format.h>

namespace contensou::program {

namespace {

constexpr std::size_t block_size = std::size_t{1} << 18;
constexpr std::size_t longest_record = std::size_t{1} << 26;

long count_lines(std::string_view text) { return std::ranges::count(text, '\n'); }

/// Where the last whole record of a text ends that begins with one; 0 if none ends.
std::size_t end_of_records(std::string_view text) {
  if (text.find('"') == std::string_view::npos) return text.rfind('\n') + 1;  // npos + 1 is 0
  std::size_t end = 0;
  bool inside_quotes = false;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::string_view line = first_line(text.substr(begin));
    begin += line.size();
    if (!line.ends_with('\n')) break;
    const bool comment = !inside_quotes && line.starts_with('#');
    if (!comment && std::ranges::count(line, '"') % 2 != 0) inside_quotes = !inside_quotes;
    if (!inside_quotes) end = begin;
  }
  return end;
}

/// The line without its end, if commas alone part its fields: nothing is quoted and no return stands inside.
std::optional<std::string_view> plain_line(std::string_view line) {
  if (line.ends_with('\n')) line.remove_suffix(1);
  if (line.ends_with('\r')) line.remove_suffix(1);
  if (line.find('\r') != std::string_view::npos) return std::nullopt;
  return line;
}

void split(std::string_view line, std::vector<std::string_view>& fields) {
  fields.clear();
  for (std::size_t comma = 0; (comma = line.find(',')) != std::string_view::npos; line.remove_prefix(comma + 1)) {
    fields.push_back(line.substr(0, comma));
  }
  fields.push_back(line);
}

}  // namespace

CsvStream::CsvStream(const std::string& path)
    : source_(path == "-" ? "<stdin>" : path),
      file_(path == "-" ? ::dup(STDIN_FILENO) : ::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
  if (file_ < 0) throw std::system_error(errno, std::generic_category(), "cannot read " + source_);
  CsvBlock block;
  std::optional<CsvRecord> record;
  while (!record && next(block)) {
    CsvParser parser(block.first_line, [&](CsvRecord first) {
      if (!record) record = std::move(first);
    });
    std::string_view text = block.text;
    while (!record && !text.empty()) {
      const std::string_view line = first_line(text);
      if (!parser.add_line(line)) throw CsvHeader::complaint(source_, parser.line(), csv_fault::stray_quote);
      text.remove_prefix(line.size());
    }
    if (!record && !parser.finish()) {
      throw CsvHeader::complaint(source_, parser.record_line(), csv_fault::open_quotes);
    }
    line_ = parser.line() + 1;
    rest_.insert(0, text);
  }
  if (!record) throw CsvHeader::complaint(source_, 1, csv_fault::empty);
  header_ = {std::move(*record), source_};
}

CsvStream::~CsvStream() { ::close(file_); }

void CsvStream::read_some(std::string& text, std::size_t most) {
  const std::size_t before = text.size();
  text.resize(before + most);
  ssize_t size = 0;
  do size = ::read(file_, text.data() + before, most);
  while (size < 0 && errno == EINTR);
  const int error = errno;
  text.resize(before + static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
  if (size < 0) throw std::system_error(error, std::generic_category(), "cannot read " + source_);
  at_end_ = size == 0;
}

bool CsvStream::next(CsvBlock& block) {
  block.text.assign(rest_);
  rest_.clear();
  block.first_line = line_;
  std::size_t end = 0;
  do {
    if (block.text.size() > longest_record) refuse(block);
    // Twice as much each time, so that a long record is looked through a few times only.
    const std::size_t wanted = std::clamp(2 * block.text.size(), block_size, longest_record + 1);
    while (!at_end_ && block.text.size() < wanted) read_some(block.text, wanted - block.text.size());
    if (at_begin_) block.text.erase(0, byte_order_mark_size(block.text));
    at_begin_ = false;
    end = at_end_ ? block.text.size() : end_of_records(block.text);
  } while (end == 0 && !at_end_);
  rest_.assign(block.text, end);
  block.text.resize(end);
  line_ += count_lines(block.text);
  return !block.text.empty();
}

void CsvStream::refuse(const CsvBlock& block) const {
  CsvParser parser(block.first_line, [](const CsvRecord&) {});
  for (std::string_view text = block.text; !text.empty();) {
    const std::string_view line = first_line(text);
    if (!parser.add_line(line)) throw CsvHeader::complaint(source_, parser.line(), csv_fault::stray_quote);
    text.remove_prefix(line.size());
  }
  throw CsvHeader::complaint(
      source_, parser.record_line(),
      fmt::format("a record longer than {} MiB begins here: is a quote missing?", longest_record >> 20));
}

void for_each_row(const CsvBlock& block, const CsvHeader& header, const std::function<void(const CsvRow&)>& take) {
  CsvRow row{block.first_line - 1, {}, {}};
  std::string_view text = block.text;
  const bool quotes = text.find('"') != std::string_view::npos;
  while (!quotes && !text.empty()) {
    const std::string_view line = first_line(text);
    const std::optional<std::string_view> plain = plain_line(line);
    if (!plain) break;
    text.remove_prefix(line.size());
    ++row.line;
    if (plain->empty() || plain->starts_with('#')) continue;
    row.plain = *plain;
    split(*plain, row.fields);
    take(row);
  }
  if (text.empty()) return;

  CsvParser parser(row.line + 1, [&](const CsvRecord& record) {
    row = {record.line, {record.fields.begin(), record.fields.end()}, {}};
    take(row);
  });
  while (!text.empty()) {
    const std::string_view line = first_line(text);
    if (!parser.add_line(line)) throw header.complaint(parser.line(), csv_fault::stray_quote);
    text.remove_prefix(line.size());
  }
  if (!parser.finish()) throw header.complaint(parser.record_line(), csv_fault::open_quotes);
}

}  // namespace contensou::program
