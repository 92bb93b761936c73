#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "contensou/reduction/laws.hpp"
#include "contensou/si/description.hpp"

namespace contensou::si {

/// The law that a text names, none for a name that no law has; std::domain_error for a text that is no law otherwise.
using FindLaw = std::function<std::optional<reduction::Law>(const std::string& text)>;

/// What the text of a run file (TOML) says of an experiment; experiment_of() makes it.
///
/// @param source    what messages call the text
/// @param find_law  what its `law` must be found by; the numbers of [contact.param] are added to it as "; NAME = VALUE"
/// @throws RunFileError  for anything that is no run file, in whole or in part; unknown keys are errors
Description parse_run_file(std::string_view text, std::string_view source,
                           const FindLaw& find_law = reduction::find_law);

/// The text of a run file.
/// @throws std::system_error  if it cannot be read
std::string read_run_text(const std::string& path);

/// Reads a file as the text of a run file.
/// @throws RunFileError       as parse_run_file
/// @throws std::system_error  if the file cannot be read
Description read_run_file(const std::string& path, const FindLaw& find_law = reduction::find_law);

/// An experiment as a run file that reads back to the same doubles.
///
/// @param remark  lines of comment to put first
std::string run_file(const Experiment& experiment, std::string_view remark = {});

}  // namespace contensou::si
