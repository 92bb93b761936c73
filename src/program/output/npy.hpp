#pragma once

#include <string>
#include <vector>

namespace contensou::program {

/// The beginning of a NumPy file (format 1.0) that holds an array of doubles in C order; the doubles follow as they are
/// in memory.
/// @param shape  of two axes or more
std::string npy_header(const std::vector<long>& shape);

}  // namespace contensou::program
