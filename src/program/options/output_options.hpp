#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "answers/table/answer.hpp"
#include "contensou/portraits/figure.hpp"
#include "contensou/portraits/render.hpp"
#include "options/argument.hpp"
#include "output/progress.hpp"

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

/// Throws BadInput if `names` is not empty and no picture is written.
void require_picture(const std::string& names, const Output& output);

/// Returns the name of the group of figure options in the help.
std::string figure_group();

/// The options for the look of a figure on a page: --size, --font, --title and --dpi.
class FigureOptions {
 public:
  /// @param several  true: only --size and --font, for a verb that draws several figures with titles of their own
  void add(CLI::App& app, bool several = false);

  /// Returns the names of the options that were given, for a message.
  std::string names() const { return names_given({&size_, &font_, &title_, &dpi_}); }

  /// Throws BadInput if one of these options was given and no picture is written.
  void require_picture(const Output& output) const { program::require_picture(names(), output); }

  /// Returns the value of --size; empty without the option.
  portraits::AskedSize size() const { return size_.value_or(portraits::AskedSize{}); }

  /// Returns the figure with the title, font and resolution that the options set. The default height fits the contents.
  /// @param format  format in which the figure is written
  /// @throws BadInput  for --dpi with a format other than png; for --font with tex
  portraits::Figure apply(portraits::Figure figure, const std::string& format) const;

  /// Writes a figure, or the frames of a gif, as `apply` returns them.
  ExitStatus write(std::vector<portraits::Figure> figures, const Output& output) const {
    for (portraits::Figure& figure : figures) figure = apply(std::move(figure), output.format);
    return output.write(figures);
  }

 private:
  ArgumentOf<portraits::AskedSize> size_;
  Argument title_;
  ArgumentOf<std::string> font_;
  ArgumentOf<long> dpi_;
};

/// The options of a verb that writes an answer or a picture: those of FigureOptions and of OutputOptions.
class PictureOptions : public FigureOptions {
 public:
  explicit PictureOptions(std::vector<OutputKind> kinds) : output_(std::move(kinds)) {}

  void add(CLI::App& app) {
    FigureOptions::add(app);
    output_.add(app);
  }

  /// Reads the options of the output.
  /// @throws BadInput  as OutputOptions::read and require_picture
  Output read(std::size_t place = 0) const {
    Output output = output_.read(place);
    require_picture(output);
    return output;
  }

 private:
  OutputOptions output_;
};

/// Returns the default rule for progress. Progress of long work is shown if standard error is a terminal and the output
/// does not go to a terminal. Otherwise progress is never shown.
/// @param output  the file of -o; "-" is standard output
ShowProgress progress_if_watched(const std::string& output);

/// --threads and --progress, for a verb that computes much.
class BulkOptions {
 public:
  void add(CLI::App& app);

  Arguments all() const { return {&threads_, &progress_}; }
  void need(const Argument& other, const std::string& reason) {
    threads_.needs(other, reason);
    progress_.needs(other, reason);
  }

  /// Returns the number of threads: by default as many as the machine runs at once.
  int threads() const;

  /// Returns the rule for progress that --progress sets; by default progress_if_watched.
  /// @param output  the file of -o; "-" is standard output
  ShowProgress progress(const std::string& output) const;

 private:
  ArgumentOf<long> threads_;
  ArgumentOf<std::optional<ShowProgress>> progress_;
};

}  // namespace contensou::program
