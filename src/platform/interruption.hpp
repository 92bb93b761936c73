#pragma once

#include <memory>

namespace contensou::platform {

/// Handles the signals that end the program, and in Windows Ctrl-C and the end of the console. The handler removes the
/// unfinished file, prints a message, and ends the program in the usual way: with status 130 in a shell after Ctrl-C,
/// also as process 1 of a container. Ignored signals, such as SIGHUP under nohup, stay ignored. Exceeding a limit on
/// file sizes becomes an error of write().
void handle_ending_signals();

/// Delays the signals that end the program as long as an object of this class exists.
class BlockedSignals {
 public:
  BlockedSignals();
  ~BlockedSignals();
  BlockedSignals(const BlockedSignals&) = delete;
  BlockedSignals& operator=(const BlockedSignals&) = delete;

 private:
  struct Signals;
  std::unique_ptr<Signals> before_;
};

}  // namespace contensou::platform
