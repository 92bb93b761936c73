#pragma once

#include <functional>
#include <string>

#include <Eigen/Core>

namespace contensou::program {

/// Reads the value of --at: numbers >= 0 between commas, or those of a file (- is standard input; else with a / or
/// ending in .csv or .txt).
///
/// @param column  of the file, if that is a table
/// @return  a reader that throws NotAllowed or BadInput for another number, BadLine if it is in the file,
///          std::system_error if the file cannot be read
std::function<Eigen::ArrayXd(const std::string& typed)> read_instants(std::string column);

}  // namespace contensou::program
