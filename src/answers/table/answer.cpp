#include "answers/table/answer.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "contensou/portraits/json.hpp"
#include "contensou/portraits/render.hpp"
#include "contensou/reduction/detail/infinity.hpp"

namespace contensou::answers {

namespace {

std::string as_text(const std::vector<Column>& columns, Digits digits) {
  TextTable table(std::vector(columns.size(), TextTable::right(digits.width())));
  for (Eigen::Index row = -1; row < columns.front().values.size(); ++row) {
    std::vector<std::string> cells;
    for (const Column& column : columns) cells.push_back(row < 0 ? column.name : digits(column.values[row]));
    table.add(std::move(cells));
  }
  return table.text();
}

std::string as_csv(const std::vector<Column>& columns) {
  std::string text;
  for (Eigen::Index row = -1; row < columns.front().values.size(); ++row) {
    for (const Column& column : columns) {
      if (row < 0) {
        text += column.name;
      } else {
        fmt::format_to(std::back_inserter(text), "{}", column.values[row]);
      }
      text += &column == &columns.back() ? '\n' : ',';
    }
  }
  return text;
}

void append_fields(const Json& row, std::vector<std::string>& names, std::vector<std::string>& values) {
  for (const auto& [name, value] : row.items()) {
    if (value.is_object()) {
      append_fields(value, names, values);
      continue;
    }
    names.push_back(name);
    values.push_back(value.is_string()    ? value.get<std::string>()
                     : value.is_boolean() ? (value ? "yes" : "no")
                                          : fmt::format("{}", value.get<double>()));
  }
}

std::string as_csv(const std::vector<Json>& rows) {
  std::string text;
  for (const Json& row : rows) {
    std::vector<std::string> names, values;
    append_fields(row, names, values);
    if (text.empty()) text = csv_line(names);
    text += csv_line(values);
  }
  return text;
}

std::string remarks(Json members) {
  if (!members.empty()) members["version"] = CONTENSOU_VERSION;
  return portraits::csv_remarks(members);
}

std::string as_json(const Answer& answer, Digits /*all*/) {
  Json document{{"schema", 1}, {"version", CONTENSOU_VERSION}};
  document.update(answer.members);
  for (const auto& [name, values] : answer.columns) document[name] = std::vector(values.begin(), values.end());
  return portraits::json_document(document);
}

std::string as_csv(const Answer& answer, Digits /*all*/) {
  return answer.columns.empty() ? as_csv(answer.rows) : remarks(answer.remarks) + as_csv(answer.columns);
}

std::string as_text(const Answer& answer, Digits digits) {
  if (answer.text) return answer.text(digits);
  return answer.columns.empty() ? as_csv(answer.rows) : as_text(answer.columns, digits);
}

std::string tex_number(double value, Digits digits) {
  if (std::isinf(value)) return value < 0 ? "$-\\infty$" : "$\\infty$";
  const std::string plain = digits(value);
  const std::size_t power = plain.find('e');
  if (power == std::string::npos) return fmt::format("${}$", plain);
  const std::string factor = plain.starts_with("1e") ? "" : plain.substr(0, power) + "\\cdot";
  return fmt::format("${}10^{{{}}}$", factor, std::stoi(plain.substr(power + 1)));
}

/// Returns the columns of a table in TeX. Each column begins with its name.
std::vector<std::vector<std::string>> tex_columns(const Answer& answer, Digits digits) {
  std::vector<std::vector<std::string>> columns;
  const auto begin = [&](const std::string& name) -> auto& {
    return columns.emplace_back(std::vector{fmt::format("\\texttt{{{}}}", portraits::tex_text(name))});
  };
  for (const Column& column : answer.columns) {
    auto& cells = begin(column.name);
    for (double value : column.values) cells.push_back(tex_number(value, digits));
  }
  if (!columns.empty()) return columns;
  for (const Json& row : answer.rows) {
    std::vector<std::pair<std::string, std::string>> cells;
    const std::function<void(const Json&)> flatten = [&](const Json& part) {
      for (const auto& [name, value] : part.items()) {
        if (value.is_object()) flatten(value);
        if (value.is_object() || std::ranges::find(answer.beside, name) != answer.beside.end()) continue;
        cells.emplace_back(name, value.is_string()    ? portraits::tex_text(value.get<std::string>())
                                 : value.is_boolean() ? (value ? "yes" : "no")
                                                      : tex_number(value.get<double>(), digits));
      }
    };
    flatten(row);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (i == columns.size()) begin(cells[i].first);
      columns[i].push_back(std::move(cells[i].second));
    }
  }
  return columns;
}

std::string as_tex(const Answer& answer, Digits digits) {
  std::vector<std::vector<std::string>> columns = tex_columns(answer, digits);
  const std::size_t lines = columns.front().size();
  const bool turned = lines - 1 < columns.size();
  if (turned) {
    std::vector<std::vector<std::string>> across(lines);
    for (const auto& column : columns) {
      for (std::size_t i = 0; i < lines; ++i) across[i].push_back(column[i]);
    }
    columns = std::move(across);
  }
  std::string types, body;
  for (const auto& column : columns) {
    constexpr std::size_t wide = 40;
    const auto is_number = [](const std::string& cell) { return cell.starts_with('$'); };
    if (std::all_of(column.begin() + (turned ? 0 : 1), column.end(), is_number)) {
      types += 'r';
    } else {
      types += std::ranges::max(column, {}, &std::string::size).size() > wide ? "p{0.3\\linewidth}" : "l";
    }
  }
  for (std::size_t i = 0; i < columns.front().size(); ++i) {
    for (const auto& column : columns) body += column[i] + (&column == &columns.back() ? " \\\\\n" : " & ");
    if (i == 0 && !turned) body += "\\hline\n";
  }
  return fmt::format(
      "% contensou {}; a table for \\input\n\\begin{{tabular}}{{{}}}\n\\hline\n{}\\hline\n\\end{{tabular}}\n",
      CONTENSOU_VERSION, types, body);
}

struct AnswerFormat {
  std::string_view name;
  std::string (*written)(const Answer&, Digits);
};

constexpr AnswerFormat all_answer_formats[]{{"text", as_text}, {"csv", as_csv}, {"json", as_json}, {"tex", as_tex}};

}  // namespace

std::string Digits::operator()(double value) const { return fmt::format("{:.{}g}", value, count); }

std::vector<std::string> answer_formats(const std::string& standard) {
  std::vector<std::string> formats;
  for (const AnswerFormat& format : all_answer_formats) formats.emplace_back(format.name);
  const auto place = std::ranges::find(formats, standard);
  std::rotate(formats.begin(), place, place + 1);
  return formats;
}

std::string render(const Answer& answer, const std::string& format, Digits digits) {
  if (answer.numbers && format != "text") return render(answer.numbers(), format, digits);
  return std::ranges::find(all_answer_formats, format, &AnswerFormat::name)->written(answer, digits);
}

std::string csv_line(const std::vector<std::string>& fields) {
  std::string line;
  for (const std::string& field : fields) {
    const bool first = &field == &fields.front();
    if (!first) line += ',';
    const bool comment = first && field.starts_with('#');
    const bool blank = fields.size() == 1 && field.empty();
    if (!comment && !blank && field.find_first_of(",\"\r\n") == std::string::npos) {
      line += field;
      continue;
    }
    line += '"';
    for (char letter : field) line += letter == '"' ? "\"\"" : std::string(1, letter);
    line += '"';
  }
  return line + '\n';
}

double or_infinity(double value) { return std::isnan(value) ? infinity : value; }

std::string TextTable::text() const {
  std::vector<Column> columns = columns_;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const std::size_t gap = columns[i].width > 0 && columns[i].align == '>' && i > 0 ? 2 : 0;
    for (const auto& cells : lines_) {
      if (i + 1 < cells.size() || (i < cells.size() && columns[i].align == '>'))
        columns[i].width = std::max(columns[i].width, cells[i].size() + gap);
    }
  }
  std::string text;
  for (const auto& cells : lines_) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const auto [width, align] = i < columns.size() ? columns[i] : Column{0, '<'};
      const bool ends = i + 1 == cells.size();
      text += align == '<' && ends ? cells[i]
              : align == '<'       ? fmt::format("{:<{}}", cells[i], width)
                                   : fmt::format("{:>{}}", cells[i], width);
    }
    text += '\n';
  }
  return text;
}

}  // namespace contensou::answers
