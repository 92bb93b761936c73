#include "process/run_program.hpp"

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <iterator>
#include <system_error>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#ifdef __linux__
#include <sys/prctl.h>
#endif

extern char** environ;  // NOLINT(readability-redundant-declaration): POSIX has it in no header

namespace contensou::portraits {

namespace {

/// The exit status for a program that cannot be run, as in a shell.
constexpr int not_run = 127;

/// A file in memory that a program reads or writes.
class MemoryFile {
 public:
  MemoryFile() {
    if (file_ < 0) fail();
  }
  explicit MemoryFile(std::string_view content) : MemoryFile() {
    while (!content.empty()) {  // a write at a limit is cut short, and only the next write fails
      const ssize_t written = ::write(file_, content.data(), content.size());
      if (written < 0) fail();
      content.remove_prefix(static_cast<std::size_t>(written));
    }
    ::lseek(file_, 0, SEEK_SET);
  }
  ~MemoryFile() { ::close(file_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  int get() const { return file_; }

  std::string content() const {
    std::string text(static_cast<std::size_t>(::lseek(file_, 0, SEEK_END)), '\0');
    if (::pread(file_, text.data(), text.size(), 0) != std::ssize(text)) fail();
    return text;
  }

 private:
  static int open();
  [[noreturn]] static void fail() { throw std::system_error(errno, std::generic_category()); }

  int file_ = open();
};

// Functions that exist only on Linux, and substitutes for other systems such as macOS.
#ifdef __linux__
int MemoryFile::open() { return ::memfd_create("contensou", MFD_CLOEXEC); }

void end_with_parent() { ::prctl(PR_SET_PDEATHSIG, SIGKILL); }
#else
int MemoryFile::open() {
  char name[] = "/tmp/contensou-XXXXXX";
  const int file = ::mkostemp(name, O_CLOEXEC);
  ::unlink(name);
  return file;
}

void end_with_parent() {}
#endif

/// Runs the program. @return  status as of waitpid()
int run(std::vector<const char*> command, const MemoryFile& input, const MemoryFile& output, const MemoryFile& messages,
        unsigned seconds) {
  command.push_back(nullptr);
  std::vector<const char*> environment{"LC_ALL=C.UTF-8"};
  for (char** variable = environ; *variable != nullptr; ++variable) {
    if (!std::string_view(*variable).starts_with("LC_ALL=")) environment.push_back(*variable);
  }
  environment.push_back(nullptr);
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child == 0) {  // only async-signal-safe calls, because other threads may hold locks
    sigset_t none;
    ::sigemptyset(&none);
    ::sigprocmask(SIG_SETMASK, &none, nullptr);
    std::signal(SIGALRM, SIG_DFL);
    ::alarm(seconds);
    end_with_parent();
    environ = const_cast<char**>(environment.data());
    if (::getppid() == parent && ::dup2(input.get(), STDIN_FILENO) >= 0 && ::dup2(output.get(), STDOUT_FILENO) >= 0 &&
        ::dup2(messages.get(), STDERR_FILENO) >= 0) {
      ::execvp(command.front(), const_cast<char**>(command.data()));
    }
    ::_exit(not_run);
  }
  int status = child < 0 ? W_EXITCODE(not_run, 0) : 0;  // if there is no status, the picture decides about success
  while (child > 0 && ::waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  return status;
}

}  // namespace

const char* const standard_input = "/dev/stdin";

ProgramRun run_program(std::vector<const char*> command, std::string_view input, unsigned seconds) {
  const MemoryFile in(input), out, messages;
  const int status = run(std::move(command), in, out, messages, seconds);
  ProgramRun result{ProgramRun::End::exited, WEXITSTATUS(status), out.content(), messages.content()};
  if (WIFSIGNALED(status)) {
    result.number = WTERMSIG(status);
    result.end = result.number == SIGALRM ? ProgramRun::End::out_of_time : ProgramRun::End::ended_by_signal;
  } else if (result.number == not_run) {
    result.end = ProgramRun::End::not_run;
  }
  return result;
}

}  // namespace contensou::portraits
