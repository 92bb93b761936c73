#include "platform/interruption.hpp"

#include <csignal>
#include <cstring>

#include <unistd.h>

#include "platform/output_file.hpp"

namespace contensou::platform {

namespace {

/// Ends the program. The function calls only async-signal-safe functions: unlink, write, signal, raise and _exit.
/// Several threads may run the function at once, and each removes the unfinished file before it ends the program.
void end_program(int signal) {
  const char* message = remove_unfinished();
  if (message != nullptr && signal != SIGPIPE) {
    std::signal(SIGPIPE, SIG_IGN);  // a closed standard error must not change the exit status
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, message, std::strlen(message));
  }
  std::signal(signal, SIG_DFL);
  std::raise(signal);
  ::_exit(128 + signal);  // as process 1 of a container the program survives raise()
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

struct BlockedSignals::Signals {
  sigset_t set;
};

BlockedSignals::BlockedSignals() : before_(std::make_unique<Signals>()) {
  const sigset_t ending = ending_signals();
  ::pthread_sigmask(SIG_BLOCK, &ending, &before_->set);
}

BlockedSignals::~BlockedSignals() { ::pthread_sigmask(SIG_SETMASK, &before_->set, nullptr); }

}  // namespace contensou::platform
