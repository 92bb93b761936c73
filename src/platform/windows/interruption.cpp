#include "platform/interruption.hpp"

#include <cstring>
#include <mutex>

#include <windows.h>

#include "platform/output_file.hpp"

namespace contensou::platform {

namespace {

/// A lock that delays the end of the program. The verb `paper` locks it for all its files and again for each file.
std::recursive_mutex wait;

/// Removes the unfinished file. The system calls this function in a separate thread and ends the program afterwards.
BOOL WINAPI end_program(DWORD) {
  const std::lock_guard lock(wait);
  if (const char* message = remove_unfinished()) {
    DWORD written = 0;
    ::WriteFile(::GetStdHandle(STD_ERROR_HANDLE), message, static_cast<DWORD>(std::strlen(message)), &written, nullptr);
  }
  return FALSE;
}

}  // namespace

void handle_ending_signals() { ::SetConsoleCtrlHandler(end_program, TRUE); }

struct BlockedSignals::Signals {
  std::lock_guard<std::recursive_mutex> lock{wait};
};

BlockedSignals::BlockedSignals() : before_(std::make_unique<Signals>()) {}

BlockedSignals::~BlockedSignals() = default;

}  // namespace contensou::platform
