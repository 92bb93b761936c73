#pragma once

#include <string>

#include "contensou/portraits/figure.hpp"
#include "contensou/portraits/gnuplot.hpp"

namespace contensou::program {

/// What follows the last dot of a path's file name; empty if nothing does.
std::string ending(const std::string& path);

/// The bytes of a figure.
/// @throws FileFailure  if gnuplot is missing or fails
std::string drawn(const portraits::Figure& figure, portraits::PictureFormat format);

}  // namespace contensou::program
