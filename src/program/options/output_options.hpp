#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "answers/table/answer.hpp"
#include "contensou/portraits/render.hpp"
#include "options/argument.hpp"

namespace contensou::program {

/// A kind of output of a verb, such as a table.
struct OutputKind {
  std::string noun;                  ///< noun with its article, for messages
  std::vector<std::string> formats;  ///< names for --format, which are also file endings; for text the ending is txt
  std::string path = "-";            ///< default of -o
  std::string standard = formats.front();
};

/// Returns the formats `first`, the picture formats, and the formats `last`, in one list. Here tex is a picture format.
std::vector<std::string> with_pictures(std::vector<std::string> first, const std::vector<std::string>& last = {});

/// Destination and format of a result.
struct Output {
  std::string path;
  std::string format;
  std::optional<portraits::PictureFormat> picture;  ///< format of a picture; empty for numbers, also for a table of tex
  Digits digits;                                    ///< number of digits in text

  /// Return the exit status of a verb that writes this: check_failed for an answer that has not passed, else done.
  /// @throws FileFailure  as write_output
  ExitStatus write(std::string_view content) const;
  ExitStatus write(const Answer& answer) const;

  /// Writes a picture in its format; several figures are the frames of a gif.
  /// @throws FileFailure  as write_output, and if gnuplot is missing or fails
  ExitStatus write(const std::vector<portraits::Figure>& figures) const;
};

/// Returns the bytes of a figure, or of a gif with these frames.
/// @throws FileFailure  if gnuplot is missing or fails
std::string drawn(const std::vector<portraits::Figure>& figures, portraits::PictureFormat format);

/// Returns the name of the group of options that many verbs share.
std::string usual_group();

/// The options -o, --format and --digits.
class OutputOptions {
 public:
  /// @param kinds  kinds of output of the verb, the default first
  explicit OutputOptions(std::vector<OutputKind> kinds) : kinds_(std::move(kinds)) {}

  void add(CLI::App& app);

  /// Reads the three options. The ending of the file sets the format; without an ending, --format sets the format;
  /// without both, the kind of output has a default. Without a file, --format also sets the ending of a picture's
  /// default name, and numbers go to standard output.
  /// @throws BadInput  if the kind does not have the format, if ending and --format disagree, if a file needs an
  ///                   ending, or if --digits is given with a format other than text
  Output read(std::size_t place = 0) const;

  const Argument& format_argument() const { return format_; }

 private:
  std::string default_path(const OutputKind& kind) const;
  std::string read_format(const OutputKind& kind, const std::string& path) const;

  std::vector<OutputKind> kinds_;
  Argument file_, format_;
  ArgumentOf<long> digits_;
};

}  // namespace contensou::program
