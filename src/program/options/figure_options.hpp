#pragma once

#include <string>

#include "contensou/portraits/figure.hpp"
#include "options/argument.hpp"

namespace contensou::program {

/// How a figure looks on a journal's page: --size, --title and --dpi.
class FigureOptions {
 public:
  void add(CLI::App& app);

  /// --size; nothing of it without the option.
  portraits::AskedSize size() const { return size_.value_or(portraits::AskedSize{}); }

  /// The figure with the title and the dots that are asked for.
  /// @param format  that it is written in
  /// @throws BadInput  for --dpi with other than png
  portraits::Figure apply(portraits::Figure figure, const std::string& format) const;

 private:
  ArgumentOf<portraits::AskedSize> size_;
  Argument title_;
  ArgumentOf<long> dpi_;
};

}  // namespace contensou::program
