#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

namespace contensou::program {

/// The fields as a line of CSV, in quotes where they need them.
std::string csv_line(const std::vector<std::string>& fields);

/// A column of numbers.
struct Column {
  std::string name;
  Eigen::ArrayXd values;
};

/// A header line and a line a row, with the shortest digits that read back to the same double.
std::string columns_as_csv(const std::vector<Column>& columns);

/// The same for people: aligned, rounded to a number of digits.
std::string columns_as_text(const std::vector<Column>& columns, int digits);

}  // namespace contensou::program
