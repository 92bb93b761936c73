#include "answers/input/message.hpp"

#include <new>
#include <stdexcept>

#include <fmt/format.h>

namespace contensou::answers {

namespace {

template <class... Kinds>
bool is_one_of(const std::exception& error) {
  return (... || (dynamic_cast<const Kinds*>(&error) != nullptr));
}

}  // namespace

bool is_fault(const std::exception& error) {
  if (is_one_of<std::domain_error, std::bad_alloc>(error)) return false;
  // Three of the standard library are std::runtime_error, too.
  return !is_one_of<std::runtime_error>(error) ||
         is_one_of<std::overflow_error, std::range_error, std::underflow_error>(error);
}

std::string message_of(const std::exception& error, const std::string& asked) {
  if (is_one_of<std::bad_alloc>(error)) return "out of memory: ask for less at once";
  if (!is_fault(error)) return error.what();
  return fmt::format("a fault of contensou, not of the input; please report it with what was asked: {}", asked);
}

}  // namespace contensou::answers
