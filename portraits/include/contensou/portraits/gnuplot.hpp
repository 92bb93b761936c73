#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "contensou/portraits/figure.hpp"

namespace contensou::portraits {

/// What a figure can be written as. gp is a gnuplot script with its data, tex is LaTeX (pgfplots.hpp); the others are
/// drawn by gnuplot. gif moves.
enum class PictureFormat { svg, pdf, png, eps, gp, tex, gif };

/// The file endings of all formats but gif, without a dot.
std::vector<std::string_view> picture_formats();

/// The format of that file ending, without its dot.
std::optional<PictureFormat> find_picture_format(std::string_view ending);

/// gnuplot is missing or failed; what() says which and what gnuplot said.
class GnuplotError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The figure as a gnuplot script with its data inside: `gnuplot FILE.gp > FILE.svg` draws it.
/// @throws std::domain_error  as lay_out
std::string gnuplot_script(const Figure& figure);

/// The bytes of the figure in a format other than gif; the same for the same figure. gp and tex need no gnuplot. For
/// the others gnuplot is looked up on PATH and run once, with no settings but the script's (without ~/.gnuplot), for at
/// most 300 s; it ends when this program does. What it reads and writes is in memory. What it says on its standard error
/// although it drew the figure goes to std::cerr.
///
/// @return  a whole file: it has its format's beginning and end, and an SVG all that the figure plots
/// @throws GnuplotError       if gnuplot is not found, fails, takes longer or draws nothing that is whole
/// @throws std::domain_error  as lay_out, and for tex as pgfplots
std::string render(const Figure& figure, PictureFormat format);

/// What gnuplot draws in PDF, EPS, PNG and GIF in place of a font that is not installed, by fontconfig's fc-match. An SVG
/// names its font, which whoever shows it has or has not.
/// @return  the name of a font; empty if the one asked for is installed, or nobody knows
std::string substitute_of(const std::string& font);

/// A moving picture as a GIF that begins again and again, with 4 pixels to the millimetre; as render.
/// @param frames  of one size, 25 for a second
std::string render_film(const std::vector<Figure>& frames);

}  // namespace contensou::portraits
