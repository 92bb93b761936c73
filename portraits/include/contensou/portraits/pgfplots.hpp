#pragma once

#include <string>

#include "contensou/portraits/figure.hpp"

namespace contensou::portraits {

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
