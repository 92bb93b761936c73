#include "process/run_program.hpp"

#include <cstdlib>
#include <filesystem>
#include <system_error>

#include <windows.h>

namespace contensou::portraits {

namespace {

[[noreturn]] void fail() { throw std::system_error(static_cast<int>(::GetLastError()), std::system_category()); }

/// A file that a program reads or writes. It stays in memory if there is room, and is deleted when closed.
class MemoryFile {
 public:
  MemoryFile() {
    const std::filesystem::path folder = std::filesystem::temp_directory_path();
    wchar_t name[MAX_PATH];
    if (::GetTempFileNameW(folder.c_str(), L"ctn", 0, name) == 0) fail();
    SECURITY_ATTRIBUTES inherited{sizeof inherited, nullptr, TRUE};
    file_ = ::CreateFileW(name, GENERIC_READ | GENERIC_WRITE | DELETE,
                          FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, &inherited, CREATE_ALWAYS,
                          FILE_ATTRIBUTE_TEMPORARY | FILE_FLAG_DELETE_ON_CLOSE, nullptr);
    if (file_ == INVALID_HANDLE_VALUE) fail();
  }
  explicit MemoryFile(std::string_view content) : MemoryFile() {
    DWORD written = 0;
    if (::WriteFile(file_, content.data(), static_cast<DWORD>(content.size()), &written, nullptr) == 0) fail();
    ::SetFilePointer(file_, 0, nullptr, FILE_BEGIN);
  }
  ~MemoryFile() { ::CloseHandle(file_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  HANDLE get() const { return file_; }

  std::string content() const {
    std::string text(static_cast<std::size_t>(::GetFileSize(file_, nullptr)), '\0');
    DWORD read = 0;
    ::SetFilePointer(file_, 0, nullptr, FILE_BEGIN);
    if (::ReadFile(file_, text.data(), static_cast<DWORD>(text.size()), &read, nullptr) == 0) fail();
    std::erase(text, '\r');  // some programs end lines with \r\n
    return text;
  }

 private:
  HANDLE file_ = INVALID_HANDLE_VALUE;
};

/// Returns the command line of a program. No argument here contains a quotation mark.
std::wstring command_line(const std::vector<const char*>& command) {
  std::wstring line;
  for (const char* word : command) {
    line += (line.empty() ? L"\"" : L" \"") + std::filesystem::path(word).wstring() + L'"';
  }
  return line;
}

/// Returns the usual place of an installed program that is not on PATH: C:\Program Files\NAME\bin\NAME.exe.
std::filesystem::path where_installed(const std::string& name) {
  const wchar_t* programs = ::_wgetenv(L"ProgramFiles");
  return std::filesystem::path(programs != nullptr ? programs : L"") / name / "bin" / (name + ".exe");
}

}  // namespace

const char* const standard_input = "-";

ProgramRun run_program(std::vector<const char*> command, std::string_view input, unsigned seconds) {
  const MemoryFile in(input), out, messages;
  STARTUPINFOW startup{};
  startup.cb = sizeof startup;
  startup.dwFlags = STARTF_USESTDHANDLES;
  startup.hStdInput = in.get();
  startup.hStdOutput = out.get();
  startup.hStdError = messages.get();
  PROCESS_INFORMATION process{};
  std::wstring line = command_line(command);
  const auto start = [&](const wchar_t* program) {
    return ::CreateProcessW(program, line.data(), nullptr, nullptr, TRUE, CREATE_NO_WINDOW | CREATE_SUSPENDED, nullptr,
                            nullptr, &startup, &process) != 0;
  };
  if (!start(nullptr) && !start(where_installed(command.front()).c_str()))
    return {ProgramRun::End::not_run, 127, "", ""};
  // The started program ends with the job, and the job ends with this program.
  const HANDLE job = ::CreateJobObjectW(nullptr, nullptr);
  JOBOBJECT_EXTENDED_LIMIT_INFORMATION limits{};
  limits.BasicLimitInformation.LimitFlags = JOB_OBJECT_LIMIT_KILL_ON_JOB_CLOSE;
  ::SetInformationJobObject(job, JobObjectExtendedLimitInformation, &limits, sizeof limits);
  ::AssignProcessToJobObject(job, process.hProcess);
  ::ResumeThread(process.hThread);
  const bool in_time = ::WaitForSingleObject(process.hProcess, seconds * 1000) == WAIT_OBJECT_0;
  if (!in_time) ::TerminateProcess(process.hProcess, 1), ::WaitForSingleObject(process.hProcess, INFINITE);
  DWORD status = 0;
  ::GetExitCodeProcess(process.hProcess, &status);
  for (const HANDLE handle : {process.hThread, process.hProcess, job}) ::CloseHandle(handle);
  const auto end = in_time ? ProgramRun::End::exited : ProgramRun::End::out_of_time;
  return {end, static_cast<int>(status), out.content(), messages.content()};
}

}  // namespace contensou::portraits
