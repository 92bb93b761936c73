#pragma once

namespace contensou::platform {

enum class Stream { output, error };

/// Whether a person reads what is written there.
bool is_terminal(Stream stream);

/// The number of a closed standard stream must not become that of a file, which messages would be written into: to be
/// called before any file is opened. What stands in for it cannot be read or written.
void occupy_closed_streams();

}  // namespace contensou::platform
