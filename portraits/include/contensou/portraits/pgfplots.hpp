#pragma once

#include <string>

#include "contensou/portraits/figure.hpp"

namespace contensou::portraits {

/// The figure as a LaTeX document that pdflatex compiles, with its data inside. It needs the packages pgfplots and
/// amsmath (Debian: texlive-pictures); the tikzpicture in it can be moved into a paper that loads both. What is in a panel is in units of
/// its axes, as a remark beside it says: of a logarithmic one powers of ten, of one whose sides TeX's fixed point does not
/// hold (0.2 to 500) powers of ten of its unit.
/// @throws std::domain_error  for a panel with a ColourMap, which is too much for TeX's memory; as tex_text
std::string pgfplots(const Figure& figure);

/// A text as TeX: italics and indices become mathematics.
/// @throws std::domain_error  for a character that is neither a Latin nor a Greek letter nor a known sign
std::string tex_text(const Text& text);

}  // namespace contensou::portraits
