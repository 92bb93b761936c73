#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "answers/input/csv.hpp"
#include "contensou/fit/track.hpp"

namespace contensou::answers {

/// Standard deviations by the name of an observable, or "stop" of a stop time; SI.
using NoiseByName = std::map<std::string, double>;

/// Options of reading a track.
struct TrackRequest {
  NoiseByName noise = {};            ///< noise of columns without NAME_sd
  std::optional<double> from = {};   ///< s, begin of the motion; else the first row's time
  std::optional<double> until = {};  ///< s
  std::optional<double> fps = {};    ///< pictures a second, for a column frame in place of t
  std::optional<double> pixel = {};  ///< m, of columns in px and px/s
};

/// Options that no track had a use for.
struct Unused {
  NoiseByName noise = {};
  bool fps = false, pixel = false;
};

/// The names of what a table may say of a ball.
std::vector<std::string> observable_names();

/// The name of an observable that a column of that name has: "spin" of wz, else its usual_name.
std::string observable_name(std::string_view column);

/// A track from a table with a column t, or frame, and others of observables, by their usual_name, in SI units or in
/// those behind their names, as in "spin [rpm]"; NAME_sd is the standard deviation of NAME, in the unit of NAME unless
/// it has its own. An empty field, nan and NA were not measured. Other columns are not read.
///
/// @param name  name of the track
/// @param note    called with a sentence for each column that is not read, or that seems to be in another unit
/// @param unused  options: those that this track has a use for are taken out
/// @throws BadLine            naming the line: of a header without t or an observable, with what there is; of a number
///                            that is none, a time that does not increase, a standard deviation that is not positive
/// @throws std::system_error  if the table cannot be read
fit::Track read_track(CsvReader& table, const std::string& name, const TrackRequest& request,
                      const std::function<void(const std::string&)>& note, Unused* unused = nullptr);

}  // namespace contensou::answers
