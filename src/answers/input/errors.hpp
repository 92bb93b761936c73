#pragma once

#include <stdexcept>

namespace contensou::answers {

/// A mistake of the user. The message says what is wrong, what is allowed and what to do.
struct BadInput : std::domain_error {
  using std::domain_error::domain_error;
};

/// A mistake of the user in a file. The message begins with FILE:LINE.
struct BadLine : BadInput {
  using BadInput::BadInput;
};

}  // namespace contensou::answers
