#include "platform/descriptor.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <initializer_list>
#include <random>
#include <string_view>

#include <fcntl.h>
#include <io.h>
#include <windows.h>

namespace contensou::platform {

namespace {

/// Sets errno to the meaning of the system's last error. @return -1
int failed() {
  switch (::GetLastError()) {
    case ERROR_FILE_EXISTS:
      errno = EEXIST;
      break;
    case ERROR_FILE_NOT_FOUND:
    case ERROR_PATH_NOT_FOUND:
      errno = ENOENT;
      break;
    case ERROR_DISK_FULL:
      errno = ENOSPC;
      break;
    default:
      errno = EACCES;
  }
  return -1;
}

}  // namespace

int open_to_read(const char* path) { return ::_open(path, _O_RDONLY | _O_BINARY | _O_NOINHERIT); }

int open_to_write(const char* path) { return ::_open(path, _O_WRONLY | _O_BINARY | _O_NOINHERIT); }

int duplicate(int file) { return ::_dup(file); }

int create_unfinished(char* name) {
  constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz0123456789";
  std::random_device random;
  for (int attempt = 0; attempt < 100; ++attempt) {
    for (char* letter = name + std::strlen(name) - 6; *letter != '\0'; ++letter)
      *letter = letters[random() % letters.size()];
    // FILE_SHARE_DELETE lets the signal handler remove the file while it is open.
    const HANDLE file = ::CreateFileA(name, GENERIC_WRITE, FILE_SHARE_READ | FILE_SHARE_DELETE, nullptr, CREATE_NEW,
                                      FILE_ATTRIBUTE_NORMAL, nullptr);
    if (file != INVALID_HANDLE_VALUE)
      return ::_open_osfhandle(reinterpret_cast<intptr_t>(file), _O_WRONLY | _O_BINARY | _O_NOINHERIT);
    if (failed(), errno != EEXIST) break;
  }
  return -1;
}

void remove_file(const char* path) { ::DeleteFileA(path); }

int replace_file(const char* path, const char* target) {
  return ::MoveFileExA(path, target, MOVEFILE_REPLACE_EXISTING) != 0 ? 0 : failed();
}

bool is_ready(int file) {
  const auto handle = reinterpret_cast<HANDLE>(::_get_osfhandle(file));
  DWORD bytes = 0;
  if (::GetFileType(handle) != FILE_TYPE_PIPE) return true;
  // PeekNamedPipe returns 0 if the pipe has ended. In this case a read does not wait.
  return ::PeekNamedPipe(handle, nullptr, 0, nullptr, &bytes, nullptr) == 0 || bytes > 0;
}

int reserve(int, std::uintmax_t) { return 0; }

void set_permissions(int, unsigned) {}

bool is_terminal(Stream stream) { return ::_isatty(::_fileno(stream == Stream::error ? stderr : stdout)) != 0; }

void prepare_standard_streams() {
  for (std::FILE* stream : {stdin, stdout, stderr}) ::_setmode(::_fileno(stream), _O_BINARY);
  ::SetConsoleOutputCP(CP_UTF8);
}

}  // namespace contensou::platform
