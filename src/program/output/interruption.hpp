#pragma once

#include <csignal>
#include <string>

namespace contensou::program {

/// Keeps signals that end a program waiting while it lives.
class SignalsWait {
 public:
  SignalsWait();
  ~SignalsWait();
  SignalsWait(const SignalsWait&) = delete;
  SignalsWait& operator=(const SignalsWait&) = delete;

 private:
  sigset_t before_{};
};

/// While it lives, Ctrl-C (and SIGTERM, SIGHUP) ends the program at once, as that signal does by itself (130 to a
/// shell), but with a file removed and a sentence on standard error. One at a time.
class Interruption {
 public:
  /// @param file      to remove; empty: none
  /// @param sentence  what then did not happen
  Interruption(std::string file, const std::string& sentence);
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

 private:
  static void end(int signal);

  std::string file_;
  std::string message_;
};

}  // namespace contensou::program
