#pragma once

#include <string>

#include "answers/input/csv.hpp"
#include "contensou/reduction/friction_law.hpp"

namespace contensou::answers {

/// The law of the pressure in a CSV file with columns rho, pressure; its name is the path.
/// @throws BadLine             naming file and line, if the table breaks a rule of TabulatedPressureLaw
/// @throws std::runtime_error  naming the file, as TabulatedPressureLaw
/// @throws std::system_error   if the file cannot be read
reduction::Law read_pressure_profile(const std::string& path);

/// The same of a table that is read already as far as its header.
reduction::Law read_pressure_profile(CsvReader& table, const std::string& name);

}  // namespace contensou::answers
