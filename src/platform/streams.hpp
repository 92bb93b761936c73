#pragma once

namespace contensou::platform {

enum class Stream { output, error };

/// Returns true if a stream is a terminal.
bool is_terminal(Stream stream);

/// Prepares the standard streams; it must be called before any file is opened. A closed standard stream is replaced by
/// a descriptor that can be neither read nor written, so that no file gets its number, to which messages are written.
/// In Windows it sets streams to binary and the console to UTF-8.
void prepare_standard_streams();

}  // namespace contensou::platform
