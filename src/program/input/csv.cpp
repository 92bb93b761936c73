#include "input/csv.hpp"

#include <algorithm>
#include <cerrno>
#include <iterator>
#include <new>
#include <span>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "input/quotation.hpp"

namespace contensou::program {

namespace {

constexpr std::size_t block_size = 8192;
constexpr std::size_t max_record = std::size_t{1} << 26;

/// libcsv's buffer for a field grows by so much at a time: by its own 128 bytes, a long field costs the square of its
/// length.
constexpr std::size_t field_growth = std::size_t{1} << 20;

std::string_view without_spaces(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// The length of the line that a text begins with, with the first character of its end.
std::size_t line_size(std::string_view text) {
  const std::size_t feed = std::min(text.find('\n'), text.size() - 1);
  return std::min(text.substr(0, feed).find('\r'), feed) + 1;
}

/// The name that iconv has for the encoding of a text in which each letter takes two bytes; empty for other texts.
std::string_view utf16(std::string_view text) {
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) return "UTF-16";
  if (text.size() < 4) return {};
  if (text[1] == '\0' && text[3] == '\0') return "UTF-16LE";
  return text[0] == '\0' && text[2] == '\0' ? "UTF-16BE" : "";
}

/// What to do about a header whose first name holds something else than commas that separates columns.
std::string separator_hint(std::string_view name) {
  const std::size_t separator = name.find_first_of(";\t");
  if (separator == std::string_view::npos) return {};
  return fmt::format("; {} separate the columns here, commas are needed: sed 's/,/./g; s/{}/,/g' converts them",
                     name[separator] == ';' ? "semicolons" : "tabs", name[separator] == ';' ? ";" : "\\t");
}

}  // namespace

CsvParser::CsvParser(std::string source) : source_(std::move(source)) {
  csv_init(&parser_, CSV_STRICT | CSV_STRICT_FINI);
  csv_set_blk_size(&parser_, field_growth);
  csv_set_space_func(&parser_, [](unsigned char) { return 0; });  // spaces belong to the field
}

void CsvParser::add(std::string_view piece, CsvBlock& block) {
  block_ = &block;
  while (!piece.empty()) {
    const std::size_t size = line_size(piece);
    add_to_line(piece.substr(0, size));
    piece.remove_prefix(size);
  }
}

void CsvParser::add_to_line(std::string_view piece) {
  const bool ends_line = piece.ends_with('\n') || piece.ends_with('\r');
  const bool blank = ends_line && piece.size() == 1 && !in_record_;
  if (at_line_start_ && !(after_return_ && piece.front() == '\n')) {
    ++line_;
    in_comment_ = !in_record_ && piece.front() == '#';
  }
  at_line_start_ = ends_line;
  after_return_ = piece.ends_with('\r');
  if (in_comment_ || blank) return;
  const bool plain = !in_record_ && ends_line && piece.find('"') == std::string_view::npos;
  if (!in_record_) record_line_ = line_;
  in_record_ = true;
  text_ += piece;
  if (plain) return split(piece.substr(0, piece.size() - 1));
  if (csv_parse(&parser_, piece.data(), piece.size(), field_ended, record_ended, this) != piece.size()) {
    if (csv_error(&parser_) != CSV_EPARSE) throw std::bad_alloc();
    throw complaint(line_, "a quote inside a field: put the field in quotes and double those inside");
  }
  if (text_.size() > max_record) {
    throw complaint(record_line_,
                    fmt::format("a record longer than {} MiB begins here: is a quote missing?", max_record >> 20));
  }
}

void CsvParser::split(std::string_view line) {
  for (std::size_t begin = 0, end = 0; end < line.size(); begin = end + 1) {
    end = std::min(line.find(',', begin), line.size());
    take_field(line.substr(begin, end - begin));
  }
  take_record();
}

void CsvParser::finish(CsvBlock& block) {
  block_ = &block;
  if (csv_fini(&parser_, field_ended, record_ended, this) == 0) return;
  throw complaint(record_line_, "the quotes that open here are never closed");
}

void CsvParser::take_field(std::string_view field) {
  values_ += field;
  ends_.push_back(values_.size());
}

void CsvParser::take_record() {
  if (at_line_start_) text_.pop_back();
  block_->records_.push_back(
      {record_line_, block_->text_.size(), text_.size(), block_->ends_.size() - 1, ends_.size()});
  for (const std::size_t end : ends_) block_->ends_.push_back(block_->values_.size() + end);
  block_->text_ += text_;
  block_->values_ += values_;
  text_.clear();
  values_.clear();
  ends_.clear();
  in_record_ = false;
}

void CsvParser::field_ended(void* field, std::size_t size, void* parser) {
  static_cast<CsvParser*>(parser)->take_field({static_cast<const char*>(field), size});
}

void CsvParser::record_ended(int /*terminator*/, void* parser) { static_cast<CsvParser*>(parser)->take_record(); }

BadLine CsvParser::complaint(long line, std::string_view message) const {
  return BadLine(fmt::format("{}:{}: {}", source_, line, message));
}

CsvReader::CsvReader(int file, const std::string& path)
    : file_(file), parser_(path == "-" ? "<stdin>" : escaped(path)) {}

CsvReader::CsvReader(const std::string& path)
    : CsvReader(path == "-" ? ::dup(STDIN_FILENO) : ::open(path.c_str(), O_RDONLY | O_CLOEXEC), path) {
  if (file_ < 0) fail();
  struct stat status {};
  if (::fstat(file_, &status) == 0 && S_ISREG(status.st_mode)) bytes_ = static_cast<double>(status.st_size);
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  constexpr std::size_t telling = 4;
  while (!at_end_ && buffer_.size() < telling) read_some();
  if (const std::string_view encoding = utf16(buffer_); !encoding.empty()) {
    throw complaint(1,
                    fmt::format("the text is in UTF-16, UTF-8 is needed: iconv -f {} -t UTF-8 converts it", encoding));
  }
  if (buffer_.starts_with(byte_order_mark)) buffer_.erase(0, byte_order_mark.size());
  CsvBlock first;
  if (!next(first)) throw complaint(1, "empty input: a header line with the names of the columns is needed");
  for (std::size_t i = 0; i < first[0].size(); ++i) names_.emplace_back(first[0][i]);
  header_line_ = first[0].line();
  first.records_.erase(first.records_.begin());
  first_ = std::move(first);
}

CsvReader::~CsvReader() {
  if (file_ >= 0) ::close(file_);
}

void CsvReader::fail() const {
  throw std::system_error(errno, std::generic_category(), "cannot read " + parser_.source());
}

void CsvReader::read_some() {
  const std::size_t before = buffer_.size();
  buffer_.resize(before + block_size);
  ssize_t size = 0;
  do size = ::read(file_, buffer_.data() + before, block_size);
  while (size < 0 && errno == EINTR);
  if (size < 0) fail();
  buffer_.resize(before + static_cast<std::size_t>(size));
  bytes_read_ += static_cast<double>(size);
  at_end_ = size == 0;
}

bool CsvReader::ready_to_read() const {
  pollfd file{.fd = file_, .events = POLLIN, .revents = 0};
  return ::poll(&file, 1, 0) > 0;
}

bool CsvReader::ready() const { return first_.size() > 0 || fault_ || at_end_ || ready_to_read(); }

bool CsvReader::next(CsvBlock& block) {
  block = std::exchange(first_, {});
  while (block.size() == 0) {
    if (fault_) throw BadLine(*fault_);
    if (at_end_) return false;
    if (buffer_.empty()) read_some();
    while (!at_end_ && buffer_.size() < block_size && ready_to_read()) read_some();
    try {
      parser_.add(buffer_, block);
      if (at_end_) parser_.finish(block);
    } catch (const BadLine& fault) {
      fault_ = fault;
    }
    buffer_.clear();
  }
  return true;
}

bool CsvReader::has_column(std::string_view name) const {
  return std::ranges::find(names_, name, without_spaces) != names_.end();
}

CsvColumn CsvReader::column(std::string_view name) const {
  const auto count = std::ranges::count(names_, name, without_spaces);
  const auto place = std::ranges::find(names_, name, without_spaces) - names_.begin();
  if (count == 1) return {std::string(name), static_cast<std::size_t>(place)};
  if (count > 1) throw complaint(header_line_, fmt::format("{} columns are called '{}'; one is allowed", count, name));
  std::vector<std::string> shown;
  std::ranges::transform(std::span(names_).first(std::min<std::size_t>(names_.size(), 20)), std::back_inserter(shown),
                         quotation);
  if (shown.size() < names_.size()) shown.emplace_back("...");
  throw complaint(header_line_, fmt::format("no column is called '{}'; the columns are {}{}", name,
                                            fmt::join(shown, ", "), separator_hint(names_.front())));
}

void CsvReader::for_each_row(const std::function<void(const CsvRow&)>& take) {
  for (CsvBlock block; next(block);) {
    for (std::size_t i = 0; i < block.size(); ++i) {
      require_complete(block[i]);
      take(block[i]);
    }
  }
}

void CsvReader::require_complete(const CsvRow& row) const {
  if (row.size() == names_.size()) return;
  throw complaint(
      row.line(),
      fmt::format("{} fields where the header has {}{}", row.size(), names_.size(),
                  row.size() > names_.size() ? ": decimals take a point, and text with a comma quotes" : ""));
}

double CsvReader::number(const CsvRow& row, const CsvColumn& column, Infinity infinity) const {
  try {
    return parse_number(row[column.place], infinity);
  } catch (const BadInput& error) {
    throw complaint(row.line(), fmt::format("{}: {}", column.name, error.what()));
  }
}

std::vector<double> read_column(const std::string& path, std::string_view name, Infinity infinity) {
  CsvReader table(path);
  std::vector<double> values;
  const auto add = [&](long line, double value) {
    if (!(value >= 0)) {
      throw table.complaint(line, fmt::format("{0}: {0} >= 0{1} is required, got {2}", name,
                                              infinity == Infinity::allowed ? " or inf" : "", value));
    }
    values.push_back(value);
  };
  CsvColumn column{std::string(name), 0};
  const std::string& first = table.names().front();
  if (table.names().size() == 1 && is_number(first)) {
    add(table.header_line(), parse_number(first, infinity));
  } else {
    column = table.column(name);
  }
  table.for_each_row([&](const CsvRow& row) { add(row.line(), table.number(row, column, infinity)); });
  return values;
}

}  // namespace contensou::program
