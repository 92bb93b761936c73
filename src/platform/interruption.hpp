#pragma once

#include <memory>
#include <string>

namespace contensou::platform {

/// From now on a signal that ends the program first removes the unfinished file and says so, and then ends the program
/// as it does by itself (130 to a shell after Ctrl-C), also where the program is process 1 of a container. What is
/// ignored, as SIGHUP under nohup, stays ignored. A limit on file sizes becomes an error of write().
void handle_ending_signals();

/// Creates and opens the unfinished file, which nobody else can read. There is one at a time.
///
/// @param folder  where it is to be
/// @param target  the path that it will have when it is finished, as the user knows it
/// @param path    is set to its path
/// @return  its descriptor, or -1 with errno
int open_unfinished(const std::string& folder, const std::string& target, std::string& path);

/// The unfinished file is renamed or removed.
void forget_unfinished();

/// Makes signals wait while it lives.
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
