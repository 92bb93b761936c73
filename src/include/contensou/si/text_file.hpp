#pragma once

#include <cstdio>
#include <string>

namespace contensou::si {

/// The whole content of a file.
/// @throws std::system_error  naming the file and the reason, if it cannot be read
std::string read_text_file(const std::string& path);

/// What is left to read of an open file.
/// @param name  for messages
/// @throws std::system_error  as above
std::string read_text(std::FILE* file, const std::string& name);

}  // namespace contensou::si
