#include "output/interruption.hpp"

#include <array>
#include <atomic>

#include <unistd.h>

namespace contensou::program {

namespace {

constexpr std::array ending_signals{SIGINT, SIGTERM, SIGHUP};

/// What the handler acts on; whoever takes it owns the end.
std::atomic<const Interruption*> current = nullptr;
static_assert(decltype(current)::is_always_lock_free);

sigset_t ending_set() {
  sigset_t set;
  sigemptyset(&set);
  for (int signal : ending_signals) sigaddset(&set, signal);
  return set;
}

}  // namespace

SignalsWait::SignalsWait() {
  const sigset_t ending = ending_set();
  pthread_sigmask(SIG_BLOCK, &ending, &before_);
}

SignalsWait::~SignalsWait() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

Interruption::Interruption(std::string file, const std::string& sentence)
    : file_(std::move(file)),
      // A terminal shows ^C, or a progress bar, in the line.
      message_((::isatty(STDERR_FILENO) != 0 ? "\ncontensou: interrupted: " : "contensou: interrupted: ") + sentence +
               "\n") {
  current = this;
  for (int signal : ending_signals) {
    struct sigaction action {};
    if (::sigaction(signal, nullptr, &action) != 0 || action.sa_handler == SIG_IGN) continue;  // as under nohup
    action.sa_handler = &Interruption::end;
    action.sa_flags = static_cast<int>(SA_RESETHAND | SA_NODEFER);
    ::sigaction(signal, &action, nullptr);
  }
}

Interruption::~Interruption() {
  while (current.exchange(nullptr) == nullptr) ::pause();  // another thread is ending the program
  for (int signal : ending_signals) {
    struct sigaction action {};
    if (::sigaction(signal, nullptr, &action) != 0 || action.sa_handler != &Interruption::end) continue;
    std::signal(signal, SIG_DFL);
  }
}

// Async-signal-safe: unlink, write and raise are.
void Interruption::end(int signal) {
  if (const Interruption* interruption = current.exchange(nullptr)) {
    if (!interruption->file_.empty()) ::unlink(interruption->file_.c_str());
    [[maybe_unused]] const ssize_t written =
        ::write(STDERR_FILENO, interruption->message_.data(), interruption->message_.size());
  }
  ::raise(signal);
}

}  // namespace contensou::program
