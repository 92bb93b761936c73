#pragma once

#include <string>
#include <utility>
#include <vector>

#include "contensou/portraits/figure.hpp"
#include "options/argument.hpp"
#include "options/output_options.hpp"

namespace contensou::program {

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

}  // namespace contensou::program
