#pragma once

#include <string>
#include <string_view>

namespace contensou::program {

/// Writes a file whole or not at all: beside it first, then renamed. Devices and pipes are written directly.
///
/// @param path  "-" is standard output
/// @throws FileFailure  naming the file and the reason; nothing is left behind
void write_output(const std::string& path, std::string_view content);

}  // namespace contensou::program
