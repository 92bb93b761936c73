#pragma once

#include <string>

namespace contensou::platform {

/// Creates and opens the unfinished file, which no other user can read. At most one such file exists at a time.
///
/// @param folder  folder of the file
/// @param target  path of the finished file, as the user wrote it
/// @param path    receives the path of the unfinished file
/// @return  descriptor of the unfinished file, or -1 with errno
int open_unfinished(const std::string& folder, const std::string& target, std::string& path);

/// Must be called when the unfinished file is renamed or removed.
void forget_unfinished();

/// Removes the unfinished file. Async-signal-safe.
/// @return  message about the file; null if there is none
const char* remove_unfinished();

}  // namespace contensou::platform
