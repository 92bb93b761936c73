#pragma once

#include <string>

#include "contensou/reduction/friction_law.hpp"

namespace contensou::program {

/// Whether a file's ending asks for a picture: svg, pdf, png or gp.
bool is_figure(const std::string& path);

/// Writes Fig. 2 of the paper, friction force and moment against k, to a file whose ending is_figure.
/// @throws FileFailure  if the file or gnuplot fails
void write_law_figure(const std::string& path, const reduction::Law& law);

}  // namespace contensou::program
