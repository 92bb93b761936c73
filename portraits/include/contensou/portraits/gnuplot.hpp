#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "contensou/portraits/figure.hpp"

namespace contensou::portraits {

/// What a figure can be written as. gp is a gnuplot script with its data, tex is LaTeX (pgfplots.hpp); the others are
/// drawn by gnuplot.
enum class PictureFormat { svg, pdf, png, eps, gp, tex };

/// The file endings of all formats, without a dot.
std::vector<std::string_view> picture_formats();

/// The format of that file ending, without its dot.
std::optional<PictureFormat> find_picture_format(std::string_view ending);

/// gnuplot is missing or failed; what() says which and what gnuplot said.
class GnuplotError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The figure as a gnuplot script with its data inside: `gnuplot FILE.gp > FILE.svg` draws it.
std::string gnuplot_script(const Figure& figure);

/// The bytes of the figure in a format; the same for the same figure. gnuplot is looked up on PATH, run once, and its
/// status checked.
///
/// @throws GnuplotError  if gnuplot is not found or fails; nothing is left behind
std::string render(const Figure& figure, PictureFormat format);

}  // namespace contensou::portraits
