#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "answers/input/csv.hpp"
#include "contensou/reduction/friction_law.hpp"
#include "contensou/si/experiment.hpp"
#include "contensou/si/load_history.hpp"

namespace contensou::answers {

/// A name in the header of a table, with a unit in brackets behind it, such as "spin [rpm]".
struct Heading {
  std::string name, unit;
};

Heading heading_of(std::string_view text);

/// Returns the usual name of a column: in small letters, "t" for time, "angle" for theta, "vx" for v_x, "wx" for
/// omega_x, "x" for pos_x, "load" for Fz. An ending _sd is kept, and the name before it is converted likewise.
std::string usual_name(std::string_view name);

/// Returns the size of a unit in SI units (in radians for an angle); 1 for an empty unit.
/// @throws BadInput  for a unit of another kind
double factor_of(const std::string& unit, std::string_view si_unit);

/// A column of numbers, and the factor that converts it to SI units.
struct SiColumn {
  CsvColumn column;
  std::string unit = {};  ///< unit as written in the header
  double factor = 1;
};

/// Finds the column with this name, else the one with this usual_name, and reads its unit; empty without a column.
/// @param pixel  size of a pixel, m, > 0, for a length in px or a speed in px/s
/// @throws BadLine  for two such columns, for a unit of another kind, and for pixels without a size
std::optional<SiColumn> find_column(const CsvReader& table, std::string_view name, std::string_view si_unit,
                                    std::optional<double> pixel = std::nullopt);

/// Returns the result of find_column.
/// @throws BadLine  as find_column, and if there is no such column
SiColumn require_column(const CsvReader& table, std::string_view name, std::string_view si_unit);

/// Returns true if the unit of a column is px or px/s.
bool is_in_pixels(const SiColumn& column);

/// Reads a changing load from a CSV file with columns t (s) and load (N). Headings may name other units.
/// @throws BadLine      if the table does not describe a load
/// @throws FileFailure  if the file cannot be read
si::LoadHistory read_load_history(const std::string& path);

/// Throws if a changing load changes more than the time scale of a motion. This is so if the load changes the patch, or
/// if a force is not proportional to the load.
/// @param others  names of given options that need a constant load, between commas; empty if there are none
/// @return  a remark on the patch, for people; empty for a body that lies flat
/// @throws BadInput  with the reason, and the option that the user must leave out
std::string require_load_alone(const si::Experiment& experiment, const reduction::Law& law, std::string others = "");

/// Reads the law of a pressure from a CSV file with columns rho, pressure. The name of the law is the path.
/// @throws BadLine             with file and line, if the table breaks a rule of TabulatedPressureLaw
/// @throws std::runtime_error  with the file, as TabulatedPressureLaw
/// @throws std::system_error   if the file cannot be read
reduction::Law read_pressure_profile(const std::string& path);

/// Reads the law from a table whose header is already read.
/// @param name  name of the law
reduction::Law read_pressure_profile(CsvReader& table, const std::string& name);

}  // namespace contensou::answers
