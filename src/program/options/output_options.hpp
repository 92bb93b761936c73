#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "options/argument.hpp"

namespace contensou::program {

enum class Format { text, csv, json };

/// -o, --format and --digits: where results go and how they look.
class OutputOptions {
 public:
  explicit OutputOptions(Format standard) : standard_(standard) {}

  void add(CLI::App& app);

  /// With words of its own for a verb that also writes pictures.
  void add(CLI::App& app, const std::string& file_help, const std::string& format_help);

  /// As typed, for such a verb.
  const Argument& file_argument() const { return file_; }
  const Argument& format_argument() const { return format_; }
  const Argument& digits_argument() const { return digits_; }

  /// @throws BadInput  for an unknown format
  Format format() const;
  bool format_given() const { return format_.given(); }

  /// Significant digits of the text format.
  /// @throws BadInput  unless it is 1 to 17 and the format is text
  int digits() const;

  /// The file of -o; "-" without it.
  std::string path() const;

  /// @throws FileFailure  as write_output
  void write(std::string_view content) const;

  /// Writes what the maker of a format makes; that of text takes the number of digits.
  /// @throws FileFailure  as write_output
  void write_as(Format format, const std::function<std::string(int)>& text, const std::function<std::string()>& csv,
                const std::function<std::string()>& json) const;

 private:
  Format standard_;
  Argument file_, format_, digits_;
};

}  // namespace contensou::program
