#include "output/json.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "contensou/portraits/json.hpp"

namespace contensou::program {

namespace {

std::string text_of(const nlohmann::ordered_json& value) {
  std::string text;
  portraits::append_json(text, value);
  return text;
}

}  // namespace

std::string json(double value) { return text_of(value); }

std::string json(std::string_view value) { return text_of(value); }

std::string json(const Eigen::ArrayXd& values) {
  std::vector<std::string> texts;
  for (double value : values) texts.push_back(json(value));
  return json_array(texts);
}

std::string json_array(const std::vector<std::string>& values) { return fmt::format("[{}]", fmt::join(values, ", ")); }

JsonObject JsonObject::document() { return std::move(JsonObject().add("schema", "1")); }

JsonObject& JsonObject::add(std::string_view name, const std::string& value) {
  members_.push_back(fmt::format("{}: {}", json(name), value));
  return *this;
}

std::string JsonObject::inline_text() const { return fmt::format("{{{}}}", fmt::join(members_, ", ")); }

std::string JsonObject::text() const { return fmt::format("{{\n  {}\n}}\n", fmt::join(members_, ",\n  ")); }

}  // namespace contensou::program
