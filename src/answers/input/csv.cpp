#include "answers/input/csv.hpp"

#include <algorithm>
#include <iterator>
#include <span>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace contensou::answers {

namespace {

constexpr std::size_t block_size = 1 << 15;
constexpr std::size_t max_record = std::size_t{1} << 26;

/// Returns the name by which iconv knows the encoding of a text in UTF-16; empty for other texts.
std::string_view utf16(std::string_view text) {
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) return "UTF-16";
  if (text.size() < 4) return {};
  if (text[1] == '\0' && text[3] == '\0') return "UTF-16LE";
  return text[0] == '\0' && text[2] == '\0' ? "UTF-16BE" : "";
}

/// Returns advice if the first name of a header contains a semicolon or a tab, separators of other tables; else "".
std::string separator_hint(std::string_view name) {
  const std::size_t separator = name.find_first_of(";\t");
  if (separator == std::string_view::npos) return {};
  return fmt::format("; {} separate the columns here, commas are needed: sed 's/,/./g; s/{}/,/g' converts them",
                     name[separator] == ';' ? "semicolons" : "tabs", name[separator] == ';' ? ";" : "\\t");
}

}  // namespace

std::string_view without_spaces(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

void CsvParser::add(std::string_view piece, CsvBlock& block) {
  const auto is_plain = [this](char letter) {
    return letter != separator_ && letter != '"' && letter != '\n' && letter != '\r';
  };
  for (std::size_t i = 0; i < piece.size(); ++i) {
    if (place_ == Place::field) {
      const std::size_t begin = i;
      while (i < piece.size() && is_plain(piece[i])) ++i;
      text_.append(piece, begin, i - begin);
      values_.append(piece, begin, i - begin);
    }
    if (i < piece.size()) add(piece[i], block);
    if (text_.size() > max_record) {
      throw complaint(record_line_,
                      fmt::format("a record longer than {} MiB begins here: is a quote missing?", max_record >> 20));
    }
  }
}

void CsvParser::add(char letter, CsvBlock& block) {
  const bool ends_line = letter == '\n' || letter == '\r';
  const bool line_goes_on = !at_line_start_ || (letter == '\n' && after_return_);
  if (!line_goes_on) ++line_;
  at_line_start_ = ends_line;
  after_return_ = letter == '\r';
  if (place_ == Place::between_records && !ends_line) {
    place_ = letter == '#' ? Place::comment : Place::field_start;
    record_line_ = line_;
  }
  if (place_ == Place::comment && ends_line) place_ = Place::between_records;
  if (place_ == Place::between_records || place_ == Place::comment) return;
  if (place_ != Place::quoted && ends_line) return end_record(block);

  text_ += letter;
  if (letter == separator_ && place_ != Place::quoted) {
    ends_.push_back(values_.size());
    place_ = Place::field_start;
  } else if (letter == '"' && place_ != Place::field) {
    if (place_ == Place::after_quote) values_ += letter;
    if (place_ == Place::field_start) quote_line_ = line_;
    place_ = place_ == Place::quoted ? Place::after_quote : Place::quoted;
  } else if (letter == '"' || place_ == Place::after_quote) {
    // The message names the line of the opening quote, even if the quoted field continues over many lines.
    const long begin = place_ == Place::after_quote ? quote_line_ : line_;
    throw complaint(begin,
                    fmt::format("a quote inside a field{}: put the field in quotes and double those inside",
                                begin < line_ ? fmt::format(", or one that closes on line {} only", line_) : ""));
  } else {
    if (place_ == Place::field_start) place_ = Place::field;
    values_ += letter;
  }
}

void CsvParser::end_record(CsvBlock& block) {
  ends_.push_back(values_.size());
  block.records_.push_back({record_line_, block.text_.size(), text_.size(), block.ends_.size() - 1, ends_.size()});
  for (const std::size_t end : ends_) block.ends_.push_back(block.values_.size() + end);
  block.text_ += text_;
  block.values_ += values_;
  text_.clear();
  values_.clear();
  ends_.clear();
  place_ = Place::between_records;
}

void CsvParser::finish(CsvBlock& block) {
  if (place_ == Place::quoted) throw complaint(quote_line_, "the quotes that open here are never closed");
  if (place_ != Place::between_records && place_ != Place::comment) end_record(block);
}

BadLine CsvParser::complaint(long line, std::string_view message) const {
  return BadLine(fmt::format("{}:{}: {}", source_, line, message));
}

CsvReader::CsvReader(const std::string& path, Separator separator) : parser_(path == "-" ? "<stdin>" : escaped(path)) {
  file_.emplace(path, parser_.source());
  bytes_ = file_->size();
  read_header(separator);
}

CsvReader::CsvReader(std::string text, const std::string& source) : parser_(escaped(source)) {
  buffer_ = std::move(text);
  at_end_ = true;
  read_header(Separator::comma);
}

void CsvReader::read_header(Separator separator) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  constexpr std::size_t telling = 4;
  while (!at_end_ && buffer_.size() < telling) read_some();
  if (const std::string_view encoding = utf16(buffer_); !encoding.empty()) {
    throw complaint(1,
                    fmt::format("the text is in UTF-16, UTF-8 is needed: iconv -f {} -t UTF-8 converts it", encoding));
  }
  if (buffer_.starts_with(byte_order_mark)) buffer_.erase(0, byte_order_mark.size());
  if (separator == Separator::any) find_separator();
  CsvBlock first;
  if (!next(first)) throw complaint(1, "empty input: a header line with the names of the columns is needed");
  for (std::size_t i = 0; i < first[0].size(); ++i) names_.emplace_back(first[0][i]);
  header_line_ = first[0].line();
  first.records_.erase(first.records_.begin());
  if (separator == Separator::any) take_units(first);
  first_ = std::move(first);
}

/// Tracker programs write the name of the body in a separate line above the names of the columns.
void CsvReader::find_separator() {
  constexpr std::size_t most = 4;  // number of lines searched
  std::size_t begin = 0;
  for (std::size_t line = 0; line < most; ++line) {
    while (buffer_.find_first_of("\r\n", begin) == std::string::npos && !at_end_) read_some();
    const std::size_t end = buffer_.find_first_of("\r\n", begin);
    const std::string_view text = std::string_view(buffer_).substr(begin, end - begin);
    if (text.find(',') != std::string_view::npos) return;
    const std::size_t found = text.starts_with('#') ? std::string::npos : without_spaces(text).find_first_of("\t;");
    if (found != std::string_view::npos) {
      parser_.separate_by(without_spaces(text)[found]);
      decimal_commas_ = without_spaces(text)[found] == ';';
      if (begin > 0) buffer_.insert(0, "#");
      return;
    }
    if (end == std::string::npos) return;
    begin = end + 1;
  }
}

void CsvReader::take_units(CsvBlock& block) {
  if (block.size() == 0 || block[0].size() != names_.size() || names_.size() < 2) return;
  std::vector<std::string> units;
  bool any = false;
  for (std::size_t i = 0; i < names_.size(); ++i) {
    std::string_view unit = without_spaces(block[0][i]);
    if (is_number(decimal(unit)) || unit == "nan" || unit == "NaN" || unit == "NA") return;
    if (unit.size() > 2 && (unit.front() == '[' || unit.front() == '(')) unit = unit.substr(1, unit.size() - 2);
    units.emplace_back(unit == "-" ? "" : unit);
    any = any || !units.back().empty();
  }
  if (!any) return;
  for (std::size_t i = 0; i < names_.size(); ++i) {
    if (!units[i].empty()) names_[i] += fmt::format(" [{}]", units[i]);
  }
  block.records_.erase(block.records_.begin());
}

std::string CsvReader::decimal(std::string_view field) const {
  std::string number(field);
  if (decimal_commas_) std::ranges::replace(number, ',', '.');
  return number;
}

void CsvReader::read_some() {
  const std::size_t before = buffer_.size();
  at_end_ = !file_->read(buffer_, block_size);
  bytes_read_ += static_cast<double>(buffer_.size() - before);
}

bool CsvReader::ready() const { return first_.size() > 0 || fault_ || at_end_ || file_->ready(); }

bool CsvReader::next(CsvBlock& block) {
  block = std::exchange(first_, {});
  while (block.size() == 0) {
    if (fault_) throw BadLine(*fault_);
    if (at_end_ && buffer_.empty()) return false;
    if (buffer_.empty()) read_some();
    while (!at_end_ && buffer_.size() < block_size && file_->ready()) read_some();
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
    return parse_number(decimal(row[column.place]), infinity);
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

}  // namespace contensou::answers
