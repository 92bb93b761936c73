#pragma once

#include <memory>

namespace contensou::platform {

/// From now on what ends the program from outside (a signal, or Ctrl-C and the console's end in Windows) first removes
/// the unfinished file and says so, and then ends the program as it does by itself (130 to a shell after Ctrl-C), also
/// where the program is process 1 of a container. What is ignored, as SIGHUP under nohup, stays ignored. A limit on file
/// sizes becomes an error of write().
void handle_ending_signals();

/// Makes what ends the program wait while it lives.
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
