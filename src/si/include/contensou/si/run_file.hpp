#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "contensou/reduction/laws.hpp"
#include "contensou/si/description.hpp"

namespace contensou::si {

/// Returns the law with the name in a text; empty if there is none. Throws std::domain_error for a malformed text.
using FindLaw = std::function<std::optional<reduction::Law>(const std::string& text)>;

/// Reads the text of a run file (TOML) as a description; experiment_of() makes the experiment.
///
/// @param source    name of the text, for messages
/// @param find_law  finds the file's `law`; the numbers of [contact.param] are appended to its text as "; NAME = VALUE"
/// @throws RunFileError  if the text is no run file, or contains an unknown key
Description parse_run_file(std::string_view text, std::string_view source,
                           const FindLaw& find_law = reduction::find_law);

/// Returns the text of a run file.
/// @throws std::system_error  if the file cannot be read
std::string read_run_text(const std::string& path);

/// Reads a file as a description. Throws as read_run_text and parse_run_file.
Description read_run_file(const std::string& path, const FindLaw& find_law = reduction::find_law);

/// Returns an experiment as a run file that reads back to the same doubles.
///
/// @param remark  lines of a comment at the beginning
std::string run_file(const Experiment& experiment, std::string_view remark = {});

}  // namespace contensou::si
