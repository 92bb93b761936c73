#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "answers/input/csv.hpp"

namespace contensou::answers {

/// A name of a table's header, with the unit in brackets behind it, as in "spin [rpm]".
struct Heading {
  std::string name, unit;
};

Heading heading_of(std::string_view text);

/// The name under which a column is read: in small letters, "t" for time, "angle" for theta, "vx" for v_x; NAME_sd likewise.
std::string usual_name(std::string_view name);

/// How many SI units one of that unit is; an angle's is the radian. 1 for none.
/// @throws BadInput  for a unit of something else
double factor_of(const std::string& unit, std::string_view si_unit);

/// A column of numbers, and how many SI units one of it is.
struct SiColumn {
  CsvColumn column;
  std::string unit = {};  ///< as it stands there
  double factor = 1;
};

/// The column of that name, or else of that usual_name, in whatever unit its heading has; nothing if there is none.
/// @param pixel  m, of a length or speed in px or px/s
/// @throws BadLine  for two of that name, a unit of something else, or pixels of no size
std::optional<SiColumn> find_column(const CsvReader& table, std::string_view name, std::string_view si_unit,
                                    std::optional<double> pixel = std::nullopt);

/// Whether its unit is px or px/s.
bool is_in_pixels(const SiColumn& column);

}  // namespace contensou::answers
