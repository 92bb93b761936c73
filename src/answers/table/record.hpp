#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "answers/table/answer.hpp"

namespace contensou::answers {

/// Names, unit and meaning of a field, as help and the table in src/README.md say them.
struct FieldText {
  std::string
      names;         ///< in backquotes, with what is no name around them: `bounds` [lower, upper]; CSV `lower`, `upper`
  std::string unit;  ///< none: a pure number, or a name
  std::string meaning;
};

/// A field of the result of a verb. A table of them is all that JSON, CSV, help and README know of that result.
template <class Result>
struct Field {
  const char* name;              ///< of the member of JSON; none: it is in CSV alone
  const char* unit;              ///< none: a pure number, or a name
  const char* meaning;           ///< null: it is told elsewhere, for all verbs; empty: with the next
  Json (*value)(const Result&);  ///< null where this result has none

  /// Names of the columns of CSV, between commas: of the value, of the entries of an array, or of the members of an object; an entry without
  /// a name has none. In those of an array of objects * stands for the member "name". Without a text, as in JSON; an
  /// empty one: none.
  const char* columns = nullptr;
  int place = 0;           ///< of the columns: they follow those of a lower place
  const char* shape = "";  ///< of an array or object, for README
};

/// The value of a field that JSON has as null.
inline const Json said_null = Json::value_t::discarded;

/// A column of a result that has many rows: of CSV, and a list in JSON.
template <class Result>
struct ColumnField {
  const char* name;
  const char* unit;
  const char* meaning;                             ///< as Field's
  const Eigen::ArrayXd* (*values)(const Result&);  ///< null where this result has none
};

/// A row of CSV gets the columns of a value.
/// @param columns  as Field's
void append_columns(Json& row, const std::string& name, const char* columns, const Json& value);

/// A field as the table of fields shows it.
FieldText text_of(const std::string& name, const char* columns, const char* unit, const char* meaning,
                  const char* shape);

/// One list after the other, and a field without a meaning with the next.
std::vector<FieldText> joined(const std::vector<std::vector<FieldText>>& lists);

/// The members of JSON, in the order of the table.
template <class Result, std::size_t count>
Json members_of(const Field<Result> (&fields)[count], const Result& result) {
  Json members = Json::object();
  for (const Field<Result>& field : fields) {
    if (*field.name == '\0') continue;
    if (Json value = field.value(result); !value.is_null()) {
      members[field.name] = value.is_discarded() ? Json() : std::move(value);
    }
  }
  return members;
}

/// A row of CSV.
template <class Result, std::size_t count>
Json row_of(const Field<Result> (&fields)[count], const Result& result) {
  std::vector<const Field<Result>*> sorted;
  for (const Field<Result>& field : fields) sorted.push_back(&field);
  std::ranges::stable_sort(sorted, {}, &Field<Result>::place);
  Json row = Json::object();
  for (const Field<Result>* field : sorted) {
    if (field->columns != nullptr && *field->columns == '\0') continue;
    if (const Json value = field->value(result); !value.is_null()) {
      append_columns(row, field->name, field->columns, value);
    }
  }
  return row;
}

/// The columns that this result has.
template <class Result, std::size_t count>
std::vector<Column> columns_of(const ColumnField<Result> (&fields)[count], const Result& result) {
  std::vector<Column> columns;
  for (const ColumnField<Result>& field : fields) {
    if (const Eigen::ArrayXd* values = field.values(result)) columns.push_back({field.name, *values});
  }
  return columns;
}

/// The fields that have a meaning, as texts.
template <class Result, std::size_t count>
std::vector<FieldText> texts_of(const Field<Result> (&fields)[count]) {
  std::vector<FieldText> texts;
  for (const auto& [name, unit, meaning, value, columns, place, shape] : fields) {
    if (meaning != nullptr) texts.push_back(text_of(name, columns, unit, meaning, shape));
  }
  return joined({texts});
}

template <class Result, std::size_t count>
std::vector<FieldText> texts_of(const ColumnField<Result> (&fields)[count]) {
  std::vector<FieldText> texts;
  for (const auto& [name, unit, meaning, values] : fields) {
    if (meaning != nullptr) texts.push_back(text_of(name, nullptr, unit, meaning, ""));
  }
  return joined({texts});
}

}  // namespace contensou::answers
