#pragma once

#include <stdexcept>

namespace contensou::answers {

/// The user's mistake; the message says what is wrong, what is allowed and a way out.
struct BadInput : std::domain_error {
  using std::domain_error::domain_error;
};

/// The user's mistake in a file; the message begins with FILE:LINE.
struct BadLine : BadInput {
  using BadInput::BadInput;
};

}  // namespace contensou::answers
