#pragma once

#include <string>
#include <vector>

#include "answers/table/record.hpp"

namespace contensou::answers {

/// The columns and fields that a verb reads and writes.
struct VerbFields {
  std::string verb;  ///< with options, such as "stop --batch"; or "all"
  std::vector<FieldText> fields;
};

/// All columns and fields there are: the help of the verbs has them, and src/README.md as a table.
std::vector<VerbFields> field_table();

}  // namespace contensou::answers
