#pragma once

#include <string>

#include "contensou/portraits/figure.hpp"
#include "options/argument.hpp"
#include "options/output_options.hpp"

namespace contensou::program {

/// Throws BadInput unless a picture is written, or no options are named.
void require_picture(const std::string& names, const Output& output);

/// Name of the group of these options in the help.
std::string figure_group();

/// How a figure looks on a journal's page: --size, --font, --title and --dpi.
class FigureOptions {
 public:
  /// @param several  figures, each with a title of its own and without dots: --size and --font alone
  void add(CLI::App& app, bool several = false);

  /// The options that were given, for a message.
  std::string names() const { return names_given({&size_, &font_, &title_, &dpi_}); }

  /// Throws BadInput if one of them was given and no picture is written.
  void require_picture(const Output& output) const { program::require_picture(names(), output); }

  /// --size; nothing of it without the option.
  portraits::AskedSize size() const { return size_.value_or(portraits::AskedSize{}); }

  /// The figure with the title, the font and the dots that are asked for, as high as it needs unless a height is.
  /// @param format  that it is written in
  /// @throws BadInput  for --dpi with other than png, for --font with tex
  portraits::Figure apply(portraits::Figure figure, const std::string& format) const;

 private:
  ArgumentOf<portraits::AskedSize> size_;
  Argument title_;
  ArgumentOf<std::string> font_;
  ArgumentOf<long> dpi_;
};

}  // namespace contensou::program
