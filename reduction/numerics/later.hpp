#pragma once

#include <atomic>
#include <memory>
#include <mutex>

namespace contensou::reduction {

/// A part of an object that the first thread that needs it computes.
template <class Part>
class Later {
 public:
  /// Does not use std::call_once: if a call throws, a later call in a program of mingw-w64 may wait for ever.
  template <class Make>
  const Part& made(Make make) const {
    if (const Part* part = made_.load(std::memory_order_acquire)) return *part;
    const std::lock_guard lock(guard_);
    if (!part_) {
      part_ = std::make_unique<const Part>(make());
      made_.store(part_.get(), std::memory_order_release);
    }
    return *part_;
  }

 private:
  mutable std::mutex guard_;
  mutable std::unique_ptr<const Part> part_;
  mutable std::atomic<const Part*> made_ = nullptr;
};

}  // namespace contensou::reduction
