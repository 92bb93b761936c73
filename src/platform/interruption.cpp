#include "platform/interruption.hpp"

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include <fcntl.h>
#include <unistd.h>

#include "platform/streams.hpp"

namespace contensou::platform {

namespace {

/// What the signal handler reads, if there is an unfinished file.
std::atomic<bool> is_unfinished = false;
static_assert(decltype(is_unfinished)::is_always_lock_free);
std::array<char, PATH_MAX> unfinished{};
std::array<char, PATH_MAX + 100> message{};

/// Async-signal-safe: unlink, write, signal, raise and _exit are. Other threads may be in here, too: every one of them
/// removes the file before it ends the program.
void end_program(int signal) {
  if (is_unfinished) {
    ::unlink(unfinished.data());
    if (signal != SIGPIPE) {
      std::signal(SIGPIPE, SIG_IGN);  // so that a message nobody reads does not change how the program ends
      [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, message.data(), std::strlen(message.data()));
    }
  }
  std::signal(signal, SIG_DFL);
  std::raise(signal);
  ::_exit(128 + signal);  // process 1 of a container outlives it
}

sigset_t ending_signals() {
  sigset_t set;
  ::sigfillset(&set);
  for (int other : {SIGKILL, SIGSTOP, SIGTSTP, SIGTTIN, SIGTTOU, SIGCONT, SIGCHLD, SIGURG, SIGWINCH}) {
    ::sigdelset(&set, other);
  }
  return set;
}

}  // namespace

void handle_ending_signals() {
  const sigset_t ending = ending_signals();
  for (int signal = 1; signal < NSIG; ++signal) {
    struct sigaction action {};
    if (::sigismember(&ending, signal) != 1 || ::sigaction(signal, nullptr, &action) != 0) continue;
    if (action.sa_handler != SIG_DFL) continue;
    action.sa_handler = signal == SIGXFSZ ? SIG_IGN : &end_program;
    action.sa_flags = static_cast<int>(SA_NODEFER);
    ::sigaction(signal, &action, nullptr);
  }
}

int open_unfinished(const std::string& folder, const std::string& target, std::string& path) {
  // A terminal shows ^C, or a progress bar, in the line.
  const char* new_line = is_terminal(Stream::error) ? "\n" : "";
  std::snprintf(message.data(), message.size(), "%scontensou: interrupted: %s was not written, nothing is left of it\n",
                new_line, target.c_str());
  // The name is in the handler's hands before the file exists: mkostemp fills it in, then creates the file.
  path = folder + "/.contensou-XXXXXX";
  if (path.size() >= unfinished.size()) return errno = ENAMETOOLONG, -1;
  unfinished[path.copy(unfinished.data(), path.size())] = '\0';
  is_unfinished = true;
  const int file = ::mkostemp(unfinished.data(), O_CLOEXEC);
  path = unfinished.data();
  if (file < 0) forget_unfinished();
  return file;
}

void forget_unfinished() { is_unfinished = false; }

struct BlockedSignals::Signals {
  sigset_t set;
};

BlockedSignals::BlockedSignals() : before_(std::make_unique<Signals>()) {
  const sigset_t ending = ending_signals();
  ::pthread_sigmask(SIG_BLOCK, &ending, &before_->set);
}

BlockedSignals::~BlockedSignals() { ::pthread_sigmask(SIG_SETMASK, &before_->set, nullptr); }

}  // namespace contensou::platform
