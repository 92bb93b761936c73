#pragma once

#include <memory>
#include <mutex>

namespace contensou::reduction {

/// A part of an object that the first thread that needs it computes.
template <class Part>
class Later {
 public:
  template <class Make>
  const Part& made(Make make) const {
    std::call_once(once_, [&] { part_ = std::make_unique<const Part>(make()); });
    return *part_;
  }

 private:
  mutable std::once_flag once_;
  mutable std::unique_ptr<const Part> part_;
};

}  // namespace contensou::reduction
