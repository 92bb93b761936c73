#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "answers/table/answer.hpp"
#include "contensou/portraits/gnuplot.hpp"
#include "options/argument.hpp"

namespace contensou::program {

/// What a verb writes.
struct OutputKind {
  std::string noun;                  ///< with its article, for messages
  std::vector<std::string> formats;  ///< names for --format; they are endings of files, but for text, which is txt
  std::string path = "-";            ///< without -o
  std::string standard = formats.front();
};

/// Formats of numbers, those of pictures, and other formats of numbers; tex then is a picture.
std::vector<std::string> with_pictures(std::vector<std::string> first, const std::vector<std::string>& last = {});

/// Where a result goes and how it looks.
struct Output {
  std::string path;
  std::string format;
  Digits digits;  ///< of text

  std::optional<portraits::PictureFormat> picture() const { return portraits::find_picture_format(format); }

  /// @throws FileFailure  as write_output
  void write(std::string_view content) const;
  void write(const Answer& answer) const;

  /// A picture, in its format; the frames of a gif.
  /// @throws FileFailure  as write_output, and if gnuplot is missing or fails
  void write(const std::vector<portraits::Figure>& figures) const;
};

/// The bytes of a figure; of a gif's frames.
/// @throws FileFailure  if gnuplot is missing or fails
std::string drawn(const std::vector<portraits::Figure>& figures, portraits::PictureFormat format);

/// Name of the group of the options that many verbs have, whatever they write.
std::string usual_group();

/// -o, --format and --digits.
class OutputOptions {
 public:
  /// @param kinds  that the verb writes, the usual one first
  explicit OutputOptions(std::vector<OutputKind> kinds) : kinds_(std::move(kinds)) {}

  void add(CLI::App& app);

  /// Reads the three options: the ending of the file decides the format, or else --format, or else the kind.
  /// @param place  of the kind
  /// @throws BadInput  if the format is not one of the kind's, if ending and --format disagree, if a file needs an
  ///                   ending, and for --digits with other than text
  Output read(std::size_t place = 0) const;

  const Argument& format_argument() const { return format_; }

 private:
  std::string read_format(const OutputKind& kind, const std::string& path) const;

  std::vector<OutputKind> kinds_;
  Argument file_, format_;
  ArgumentOf<long> digits_;
};

}  // namespace contensou::program
