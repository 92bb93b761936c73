#pragma once

#include <string>

namespace contensou::platform {

/// Creates and opens the unfinished file, which nobody else can read. There is one at a time.
///
/// @param folder  where it is to be
/// @param target  the path that it will have when it is finished, as the user knows it
/// @param path    is set to its path
/// @return  its descriptor, or -1 with errno
int open_unfinished(const std::string& folder, const std::string& target, std::string& path);

/// The unfinished file is renamed or removed.
void forget_unfinished();

/// Removes the unfinished file. Async-signal-safe.
/// @return  what is to be said of it; none: there is none
const char* remove_unfinished();

}  // namespace contensou::platform
