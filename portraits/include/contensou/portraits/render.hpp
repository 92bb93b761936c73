#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "contensou/portraits/figure.hpp"

namespace contensou::portraits {

/// File formats of a figure. gp is a gnuplot script with its data, tex is LaTeX (function pgfplots), gif is a moving
/// picture. gnuplot draws svg, pdf, png, eps and gif.
enum class PictureFormat { svg, pdf, png, eps, gp, tex, gif };

/// Returns the file endings of all formats except gif, without a dot.
std::vector<std::string_view> picture_formats();

/// Returns the format of a file ending; empty if there is none.
/// @param ending  without its dot
std::optional<PictureFormat> find_picture_format(std::string_view ending);

/// Thrown if gnuplot is missing or failed; what() contains the command and the message of gnuplot.
class GnuplotError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Returns the figure as a gnuplot script that contains its data: `gnuplot FILE.gp > FILE.svg` draws it.
/// @throws std::domain_error  as lay_out
std::string gnuplot_script(const Figure& figure);

/// Returns the figure as the bytes of a file in a format other than gif. The same figure gives the same bytes.
///
/// gp and tex need no gnuplot. For other formats gnuplot is found on PATH and runs once, without ~/.gnuplot, for at
/// most 300 s. gnuplot ends if this program ends. Its input and output stay in memory. If gnuplot draws the figure and
/// also writes a text to its standard error, this text goes to std::cerr.
///
/// @return  a complete file of the format; an SVG contains all plots of the figure
/// @throws GnuplotError       if gnuplot is not found, fails, takes longer, or draws no whole file
/// @throws std::domain_error  as lay_out, and for tex as pgfplots
std::string render(const Figure& figure, PictureFormat format);

/// Returns the font with which gnuplot replaces a font that is not installed, in PDF, EPS, PNG and GIF, according to
/// fontconfig's fc-match. An SVG contains only the name of its font; the viewer looks for the font.
/// @return  font name; empty if the font is installed, or fc-match gives no result
std::string substitute_of(const std::string& font);

/// Returns a moving picture as a GIF that repeats for ever, with 4 pixels per millimetre. Throws as render.
/// @param frames  figures of one size, 25 for each 2 seconds
std::string render_film(const std::vector<Figure>& frames);

/// Returns the figure as a LaTeX document for pdflatex, with its data inside.
///
/// The document needs the packages pgfplots and amsmath (Debian: texlive-pictures). A paper that loads both can take
/// its tikzpicture. Coordinates have the units of the panel's axes; on a logarithmic axis they are powers of ten. If a
/// side is outside the range of TeX's fixed point (0.2 to 500), the unit is multiplied by a power of ten. A comment
/// beside the coordinates states the unit.
/// @throws std::domain_error  for a panel with a ColourMap, which exceeds TeX's memory; as tex_text
std::string pgfplots(const Figure& figure);

/// Returns a text as TeX. Italics and indices become mathematics.
/// @throws std::domain_error  for a character that is neither a Latin nor a Greek letter nor a known sign
std::string tex_text(const Text& text);

}  // namespace contensou::portraits
