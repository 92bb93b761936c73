#pragma once

#include <string>

#include "answers/input/csv.hpp"
#include "contensou/reduction/friction_law.hpp"

namespace contensou::answers {

/// Reads the law of a pressure from a CSV file with columns rho, pressure. The name of the law is the path.
/// @throws BadLine             with file and line, if the table breaks a rule of TabulatedPressureLaw
/// @throws std::runtime_error  with the file, as TabulatedPressureLaw
/// @throws std::system_error   if the file cannot be read
reduction::Law read_pressure_profile(const std::string& path);

/// Reads the law from a table whose header is already read.
/// @param name  name of the law
reduction::Law read_pressure_profile(CsvReader& table, const std::string& name);

}  // namespace contensou::answers
