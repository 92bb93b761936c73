#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "answers/input/csv.hpp"
#include "contensou/fit/track.hpp"

namespace contensou::answers {

/// Standard deviations in SI units, by the name of the observable, or by "stop" for a stop time.
using NoiseByName = std::map<std::string, double>;

/// Options for reading a track.
struct TrackRequest {
  NoiseByName noise = {};            ///< noise of columns that have no column NAME_sd
  std::optional<double> from = {};   ///< begin of the motion, s; by default the time of the first row
  std::optional<double> until = {};  ///< end of the rows that are read, s
  std::optional<double> fps = {};    ///< pictures per second, for a column frame in place of t
  std::optional<double> pixel = {};  ///< size of a pixel, m, for columns in px and px/s
};

/// Given options that no track has used.
struct Unused {
  NoiseByName noise = {};
  bool fps = false, pixel = false;
};

/// Returns false for an empty field, a dash, and the words that numpy and R write for a missing value.
bool is_measured(std::string_view field);

/// Returns the names of all observables of a ball.
std::vector<std::string> observable_names();

/// Returns the name of the observable in a column: "spin" for the column wz, else the usual_name of the column.
std::string observable_name(std::string_view column);

/// Returns a track from a table with a column t or frame and columns of observables. Columns are found by their
/// usual_name; they are in SI units or in the units behind their names, such as "spin [rpm]". NAME_sd is the standard
/// deviation of NAME, in the unit of NAME unless it has its own. An empty field, nan and NA are missing values. Other
/// columns are not read.
///
/// @param name  name of the track
/// @param note    called with a sentence about each column that is not read, or whose unit seems to be wrong
/// @param unused  options; the function removes those that it uses
/// @throws BadLine            with the line: for a header without t or an observable, with all its names; for a field
///                            that is not a number, a time that does not increase, a standard deviation that is not > 0
/// @throws std::system_error  if the table cannot be read
fit::Track read_track(CsvReader& table, const std::string& name, const TrackRequest& request,
                      const std::function<void(const std::string&)>& note, Unused* unused = nullptr);

}  // namespace contensou::answers
