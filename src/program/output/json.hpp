#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace contensou::program {

/// JSON texts. Numbers have the shortest digits that read back to the same double; infinities are strings.
/// @throws std::runtime_error  for NaN, which JSON cannot say
std::string json(double value);
std::string json(std::string_view value);
std::string json(const Eigen::ArrayXd& values);

/// [a, b, ...] of texts that are JSON already.
std::string json_array(const std::vector<std::string>& values);

/// An object that keeps its members in the order in which they were added.
class JsonObject {
 public:
  /// The object of a whole document, which begins with the schema's number.
  static JsonObject document();

  /// @param value  JSON already
  JsonObject& add(std::string_view name, const std::string& value);

  /// On one line.
  std::string inline_text() const;

  /// One member a line, for a whole document.
  std::string text() const;

 private:
  std::vector<std::string> members_;
};

}  // namespace contensou::program
