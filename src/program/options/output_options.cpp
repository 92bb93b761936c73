#include "options/output_options.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "contensou/si/nearest_name.hpp"
#include "exit_status.hpp"
#include "output/output.hpp"

namespace contensou::program {

namespace {

constexpr long standard_digits = 6;

/// In the order of Format.
const std::array<std::string, 3> format_names{"text", "csv", "json"};

}  // namespace

void OutputOptions::add(CLI::App& app) {
  add(app, "write to FILE, whole or not at all; - is standard output",
      fmt::format("{} (default {})", fmt::join(format_names, ", "), format_names[static_cast<std::size_t>(standard_)]));
}

void OutputOptions::add(CLI::App& app, const std::string& file_help, const std::string& format_help) {
  file_.add(app, "-o,--output", "FILE", file_help);
  format_.add(app, "--format", "FORMAT", format_help);
  digits_.add(app, "--digits", "N",
              fmt::format("significant digits of the text format, 1 to 17 (default {})", standard_digits));
}

Format OutputOptions::format() const {
  if (!format_.given()) return standard_;
  const auto found = std::ranges::find(format_names, format_.text());
  if (found == format_names.end()) {
    format_.reject(fmt::format("unknown format{}; formats: {}", si::suggestion(format_.text(), format_names),
                               fmt::join(format_names, ", ")));
  }
  return static_cast<Format>(found - format_names.begin());
}

int OutputOptions::digits() const {
  if (!digits_.given()) return standard_digits;
  const long digits = digits_.integer(1, 17);
  if (format() != Format::text) digits_.reject("csv and json always have all digits; add --format text");
  return static_cast<int>(digits);
}

std::string OutputOptions::path() const {
  if (!file_.given()) return "-";
  if (file_.text().empty()) throw BadInput("-o '': a file name is needed, or - for standard output");
  return file_.text();
}

void OutputOptions::write(std::string_view content) const { write_output(path(), content); }

void OutputOptions::write_as(Format format, const std::function<std::string(int)>& text,
                             const std::function<std::string()>& csv, const std::function<std::string()>& json) const {
  const int digits = this->digits();
  switch (format) {
    case Format::text:
      return write(text(digits));
    case Format::csv:
      return write(csv());
    case Format::json:
      return write(json());
  }
}

}  // namespace contensou::program
