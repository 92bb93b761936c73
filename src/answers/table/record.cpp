#include "answers/table/record.hpp"

#include <iterator>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "answers/input/parse.hpp"

namespace contensou::answers {

void append_columns(Json& row, const std::string& name, const char* columns, const Json& value) {
  if (columns == nullptr) {
    row[name] = value;
    return;
  }
  const std::vector<std::string> names = split(columns, ',');
  const auto append = [&](const Json& of, const std::string& star) {
    std::size_t column = 0;
    for (const auto& [member, entry] : of.items()) {
      if (!star.empty() && member == "name") continue;
      std::string heading = names.at(column++);
      if (heading.empty()) continue;
      if (!star.empty()) heading.replace(heading.find('*'), 1, star);
      row[heading] = entry;
    }
  };
  if (!value.is_structured()) {
    row[names.front()] = value;
  } else if (value.is_array() && value.front().is_object()) {
    for (const Json& entry : value) append(entry, entry.at("name"));
  } else {
    append(value, "");
  }
}

FieldText text_of(const std::string& name, const char* columns, const char* unit, const char* meaning,
                  const char* shape) {
  std::string names = name.empty() ? "" : fmt::format("`{}`{}", name, shape);
  if (columns != nullptr && *columns == '\0') {
    names = "JSON " + names;
  } else if (columns != nullptr) {
    std::vector<std::string> headings = split(columns, ',');
    std::erase(headings, "");
    names += fmt::format("{}CSV `{}`", name.empty() ? "" : "; ", fmt::join(headings, "`, `"));
  }
  return {names, unit, meaning};
}

std::vector<std::string> names_of(std::initializer_list<ColumnText> columns) {
  std::vector<std::string> names;
  for (const ColumnText& column : columns) std::ranges::move(split(column.names, ','), std::back_inserter(names));
  return names;
}

std::vector<FieldText> texts_of(std::initializer_list<ColumnText> columns, const std::string& before) {
  std::vector<FieldText> texts;
  for (const auto& [names, unit, meaning] : columns)
    texts.push_back({fmt::format("{}`{}`", before, fmt::join(split(names, ','), "`, `")), unit, meaning});
  return texts;
}

std::vector<FieldText> joined(const std::vector<std::vector<FieldText>>& lists) {
  std::vector<FieldText> all;
  std::string before;
  for (const auto& list : lists) {
    for (const auto& [names, unit, meaning] : list) {
      before += names;
      if (meaning.empty()) {
        before += ", ";
      } else {
        all.push_back({std::exchange(before, ""), unit, meaning});
      }
    }
  }
  return all;
}

}  // namespace contensou::answers
