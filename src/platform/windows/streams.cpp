#include "platform/streams.hpp"

#include <cstdio>
#include <initializer_list>

#include <fcntl.h>
#include <io.h>
#include <windows.h>

namespace contensou::platform {

bool is_terminal(Stream stream) { return ::_isatty(::_fileno(stream == Stream::error ? stderr : stdout)) != 0; }

void prepare_standard_streams() {
  for (std::FILE* stream : {stdin, stdout, stderr}) ::_setmode(::_fileno(stream), _O_BINARY);
  ::SetConsoleOutputCP(CP_UTF8);
}

}  // namespace contensou::platform
