#pragma once

#include <string>

namespace contensou::si {

/// The whole content of a file.
/// @throws std::system_error  naming the file and the reason, if it cannot be read
std::string read_text_file(const std::string& path);

}  // namespace contensou::si
