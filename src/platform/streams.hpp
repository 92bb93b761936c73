#pragma once

namespace contensou::platform {

enum class Stream { output, error };

/// Returns true if a stream is a terminal.
bool is_terminal(Stream stream);

/// Prepares the standard streams. This must be called before any file is opened. A closed standard stream is replaced
/// by a descriptor that can be neither read nor written. Otherwise a file could get the number of standard error and
/// receive its messages. In Windows streams become binary and the console UTF-8.
void prepare_standard_streams();

}  // namespace contensou::platform
