#include "platform/unfinished_file.hpp"

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdio>

#include "platform/descriptor.hpp"
#include "platform/streams.hpp"

namespace contensou::platform {

namespace {

/// The data that the signal handler reads. They are valid if there is an unfinished file.
std::atomic<bool> is_unfinished = false;
static_assert(decltype(is_unfinished)::is_always_lock_free);
std::array<char, PATH_MAX> unfinished{};
std::array<char, PATH_MAX + 100> message{};

}  // namespace

int open_unfinished(const std::string& folder, const std::string& target, std::string& path) {
  // A terminal may already show ^C or a progress bar on this line.
  const char* new_line = is_terminal(Stream::error) ? "\n" : "";
  std::snprintf(message.data(), message.size(), "%scontensou: interrupted: %s was not written, nothing is left of it\n",
                new_line, target.c_str());
  // The handler must have the name before the file exists. A signal right after the creation then removes the file.
  path = folder + "/.contensou-XXXXXX";
  if (path.size() >= unfinished.size()) return errno = ENAMETOOLONG, -1;
  unfinished[path.copy(unfinished.data(), path.size())] = '\0';
  is_unfinished = true;
  const int file = create_unfinished(unfinished.data());
  path = unfinished.data();
  if (file < 0) forget_unfinished();
  return file;
}

void forget_unfinished() { is_unfinished = false; }

const char* remove_unfinished() {
  if (!is_unfinished) return nullptr;
  remove_file(unfinished.data());
  return message.data();
}

}  // namespace contensou::platform
