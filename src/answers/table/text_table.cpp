#include "answers/table/text_table.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace contensou::answers {

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
