#pragma once

#include <string>
#include <string_view>

#include "contensou/si/description.hpp"

namespace contensou::si {

/// What the text of a run file (TOML) says of an experiment; experiment_of() makes it.
///
/// @param source  what messages call the text
/// @throws RunFileError  for anything that is no run file, in whole or in part; unknown keys are errors
Description parse_run_file(std::string_view text, std::string_view source);

/// The text of a run file.
/// @throws std::system_error  if it cannot be read
std::string read_run_text(const std::string& path);

/// Reads a file as the text of a run file.
/// @throws RunFileError       as parse_run_file
/// @throws std::system_error  if the file cannot be read
Description read_run_file(const std::string& path);

/// An experiment as a run file that reads back to the same doubles.
///
/// @param remark  lines of comment to put first
std::string run_file(const Experiment& experiment, std::string_view remark = {});

}  // namespace contensou::si
