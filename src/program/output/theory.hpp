#pragma once

#include <string>

namespace contensou::program {

/// The chapter "Theory" of reduction/README.md, which is compiled in: as plain text in lines of at most 80 columns, its
/// formulas turned into words; and as a document for LaTeX.
std::string theory_as_text();
std::string theory_as_tex();

}  // namespace contensou::program
