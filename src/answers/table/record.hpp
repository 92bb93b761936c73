#pragma once

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "answers/table/answer.hpp"

namespace contensou::answers {

/// Names, unit and meaning of a field, as the program's help prints them.
struct FieldText {
  std::string names;  ///< names in backquotes, with the other words: `bounds` [lower, upper]; CSV `lower`, `upper`
  std::string unit;   ///< empty for a pure number or a name
  std::string meaning;
};

/// The columns that a verb (a command of the program) reads, and the fields that it writes.
struct VerbFields {
  std::string_view option;  ///< option that the verb needs for these fields, such as "--batch"; empty: none
  std::vector<FieldText> (*fields)();
};

/// One field of the result of a verb. A table of fields determines JSON, CSV and help for that result.
template <class Result>
struct Field {
  const char* name;              ///< name of the member of JSON; null if the field is only in CSV
  const char* unit;              ///< empty for a pure number or a name
  const char* meaning;           ///< empty: the field shares a line of help with the next field
  Json (*value)(const Result&);  ///< returns null if this result does not have the field

  /// Names of the columns of CSV, between commas: for the value, for the entries of an array, or for the members of an
  /// object. An entry without a name has no column. In an array of objects * stands for the member "name". If the
  /// pointer is null, the names are those of JSON; if the text is empty, there are no columns.
  const char* columns = nullptr;
  int place = 0;           ///< place of the columns, in increasing order
  const char* shape = "";  ///< shape of an array or object, for help
};

/// The value of a field that JSON shows as null.
inline const Json said_null = Json::value_t::discarded;

/// A column of a result with many rows: a column of CSV, and a list in JSON.
template <class Result>
struct ColumnField {
  const char* name;
  const char* unit;
  const char* meaning;                             ///< see Field::meaning
  const Eigen::ArrayXd* (*values)(const Result&);  ///< returns null if this result does not have the column
};

/// Columns of a table whose rows are read or written one at a time.
struct ColumnText {
  const char *names, *unit, *meaning;  ///< names between commas
};

std::vector<std::string> names_of(std::initializer_list<ColumnText> columns);

/// @param before  text before the names: "in: " or "out: "
std::vector<FieldText> texts_of(std::initializer_list<ColumnText> columns, const std::string& before = "");

/// Adds the columns of a value to a row of CSV.
/// @param columns  names of the columns, see Field::columns
void append_columns(Json& row, const std::string& name, const char* columns, const Json& value);

/// Returns a field as the program's help shows it.
FieldText text_of(const std::string& name, const char* columns, const char* unit, const char* meaning,
                  const char* shape);

/// Returns the lists as one list. A field without a meaning is joined with the next field.
std::vector<FieldText> joined(const std::vector<std::vector<FieldText>>& lists);

/// Returns the members of JSON, in the order of the table.
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

/// Returns a row of CSV.
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

/// Returns the columns that this result has.
template <class Result, std::size_t count>
std::vector<Column> columns_of(const ColumnField<Result> (&fields)[count], const Result& result) {
  std::vector<Column> columns;
  for (const ColumnField<Result>& field : fields) {
    if (const Eigen::ArrayXd* values = field.values(result)) columns.push_back({field.name, *values});
  }
  return columns;
}

/// Returns the fields as help shows them.
template <class Result, std::size_t count>
std::vector<FieldText> texts_of(const Field<Result> (&fields)[count]) {
  std::vector<FieldText> texts;
  for (const auto& [name, unit, meaning, value, columns, place, shape] : fields)
    texts.push_back(text_of(name, columns, unit, meaning, shape));
  return joined({texts});
}

template <class Result, std::size_t count>
std::vector<FieldText> texts_of(const ColumnField<Result> (&fields)[count]) {
  std::vector<FieldText> texts;
  for (const auto& [name, unit, meaning, values] : fields) texts.push_back(text_of(name, nullptr, unit, meaning, ""));
  return joined({texts});
}

/// Returns an answer with one row for each result: the rows of CSV, and a list in JSON.
/// @param list  name of the list in JSON
template <class Result, std::size_t count>
Answer answer_of_rows(const char* list, const Field<Result> (&fields)[count], const std::vector<Result>& results) {
  Answer answer;
  Json& members = answer.members[list] = Json::array();
  for (const Result& result : results) {
    members.push_back(members_of(fields, result));
    answer.rows.push_back(row_of(fields, result));
  }
  return answer;
}

/// Returns the fields of an answer of `rows`, as help shows them.
template <class Result, std::size_t count>
std::vector<FieldText> texts_of_rows(const char* list, const Field<Result> (&fields)[count]) {
  return joined({{{std::string("JSON `") + list + "` [...]", "",
                   "list with an object for each row of CSV, whose members are the columns"}},
                 texts_of(fields)});
}

}  // namespace contensou::answers
