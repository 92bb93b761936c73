// Values of the library as values of JavaScript.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <emscripten/val.h>

#include "contensou/portraits/figure.hpp"
#include "contensou/portraits/phase_portrait.hpp"

namespace contensou::page {

/// Float64Array.
emscripten::val column(const double* data, std::size_t size);
emscripten::val column(const Eigen::ArrayXd& values);
emscripten::val column(const std::vector<double>& values);

/// {u, v, lnV, lnK, left}: columns.
emscripten::val orbit_value(const portraits::PortraitOrbit& orbit);

/// The fields of figure.hpp by their names; points and arrows are flat columns, colours as in a style sheet.
emscripten::val figure_value(const portraits::Figure& figure);

}  // namespace contensou::page
