#pragma once

#include <cmath>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>

#include <fmt/format.h>

namespace contensou::portraits {

/// Appends a JSON value in the format of this project. Numbers have the shortest digits that read back to the same
/// double. Infinities are the strings "inf" and "-inf". Bytes that are not UTF-8 become U+FFFD. nlohmann's own output
/// differs: sometimes a digit too many, and null for an infinity.
///
/// @tparam Json      nlohmann::ordered_json
/// @param separator  text between the members of an object or the elements of an array
/// @throws std::runtime_error  for NaN, which JSON cannot represent
template <class Json>
void append_json(std::string& text, const Json& value, std::string_view separator = ", ") {
  const auto append_text = [&](const std::string& word) {
    text += Json(word).dump(-1, ' ', false, Json::error_handler_t::replace);
  };
  if (value.is_number_float()) {
    const double number = value.template get<double>();
    if (std::isnan(number)) throw std::runtime_error("a result is not a number");
    const std::string_view quote = std::isinf(number) ? "\"" : "";
    fmt::format_to(std::back_inserter(text), "{0}{1}{0}", quote, number);
  } else if (value.is_string()) {
    append_text(value.template get<std::string>());
  } else if (value.is_object()) {
    text += '{';
    for (auto member = value.begin(); member != value.end(); ++member) {
      if (member != value.begin()) text += separator;
      append_text(member.key());
      text += ": ";
      append_json(text, *member);
    }
    text += '}';
  } else if (value.is_array()) {
    text += '[';
    for (auto element = value.begin(); element != value.end(); ++element) {
      if (element != value.begin()) text += separator;
      append_json(text, *element);
    }
    text += ']';
  } else {
    text += value.dump();
  }
}

/// Returns members as comment lines "# name: value" for the top of a CSV file, one line for each member.
template <class Json>
std::string csv_remarks(const Json& members) {
  std::string text;
  for (const auto& [name, value] : members.items()) {
    text += fmt::format("# {}: ", name);
    append_json(text, value);
    text += '\n';
  }
  return text;
}

/// Returns the text of a JSON document, one line for each member.
template <class Json>
std::string json_document(const Json& members) {
  std::string text;
  append_json(text, members, ",\n  ");
  return "{\n  " + text.substr(1, text.size() - 2) + "\n}\n";
}

}  // namespace contensou::portraits
