#pragma once

namespace contensou::platform {

enum class Stream { output, error };

/// Whether a person reads what is written there.
bool is_terminal(Stream stream);

/// To be called before any file is opened. The number of a closed standard stream must not become that of a file, which
/// messages would be written into: what stands in for it cannot be read or written. In Windows bytes go in and out as they
/// are, and the console is told that they are UTF-8.
void prepare_standard_streams();

}  // namespace contensou::platform
