#pragma once

#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "contensou/si/experiment.hpp"

namespace contensou::si {

/// What is wrong with a run file; the message begins with FILE:LINE:COLUMN.
struct RunFileError : std::domain_error {
  using std::domain_error::domain_error;
};

/// Values that take the place of what a run file says, by the name of their Quantity. A patch radius or a spin
/// deceleration replaces whatever the file gives the patch by.
using Overrides = std::map<std::string_view, double>;

/// Velocities that take the place of those of [start], however it is given there; the other one stays.
struct StartOverride {
  std::optional<Eigen::Vector2d> velocity{};
  std::optional<Eigen::Vector3d> angular_velocity{};
};

/// An experiment from the text of a run file (TOML).
///
/// @param source  what messages call the text
/// @throws RunFileError  for anything but a complete, valid run file; unknown keys are errors
Experiment parse_run_file(std::string_view text, std::string_view source, const Overrides& overrides = {},
                          const StartOverride& start = {});

/// The text of a run file.
/// @throws std::system_error  if it cannot be read
std::string read_run_text(const std::string& path);

/// An experiment from a run file.
/// @throws RunFileError       as parse_run_file
/// @throws std::system_error  if the file cannot be read
Experiment read_run_file(const std::string& path, const Overrides& overrides = {}, const StartOverride& start = {});

/// An experiment as a run file that reads back to the same doubles.
///
/// @param remark  lines of comment to put first
std::string run_file(const Experiment& experiment, std::string_view remark = {});

}  // namespace contensou::si
