#pragma once

#include <stdexcept>

namespace contensou::answers {

/// A mistake of the user. The message says which input is wrong, which input is allowed and how to correct it.
struct BadInput : std::domain_error {
  using std::domain_error::domain_error;
};

/// A mistake of the user in a file. The message begins with FILE:LINE.
struct BadLine : BadInput {
  using BadInput::BadInput;
};

}  // namespace contensou::answers
