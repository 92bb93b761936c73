#pragma once

#include <cstdio>
#include <string>

namespace contensou::si {

/// The content of a file.
/// @param limit  bytes after which reading ends
/// @throws std::system_error  naming the file and the reason, if it cannot be read
std::string read_text_file(const std::string& path, std::size_t limit = std::string::npos);

/// What is left to read of an open file.
/// @param name  for messages
/// @throws std::system_error  as above
std::string read_text(std::FILE* file, const std::string& name, std::size_t limit = std::string::npos);

}  // namespace contensou::si
