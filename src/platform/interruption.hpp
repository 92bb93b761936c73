#pragma once

#include <memory>

namespace contensou::platform {

/// Handles the signals that end the program, and in Windows Ctrl-C and the closing of the console. The handler removes
/// the unfinished file, prints a message, and ends the program as the signal would. After Ctrl-C a shell shows status
/// 130, even for process 1 of a container. Ignored signals, such as SIGHUP under nohup, stay ignored. A file
/// above the limit of size makes write() return an error, and no signal ends the program.
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
