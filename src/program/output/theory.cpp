#include "output/theory.hpp"

#include <algorithm>
#include <cctype>
#include <functional>
#include <span>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>

#include "output/formula.hpp"
#include "output/help.hpp"
#include "theory_text.hpp"

namespace contensou::program {

namespace {

/// What a text of Markdown is made of, as far as the chapter uses it.
struct Block {
  enum class Kind { heading, paragraph, item, formula, code, table } kind;
  std::string text;  ///< without its marks; of a table its lines
};

std::vector<Block> blocks() {
  std::vector<Block> all;
  std::istringstream lines{std::string(theory_text)};
  bool joins = false;  // the line before is of the same block
  for (std::string line; std::getline(lines, line);) {
    const auto begin = [&](Block::Kind kind, std::size_t marks) {
      const bool same = joins && all.back().kind == kind;
      if (!same) all.push_back({kind, ""});
      all.back().text += (same ? "\n" : "") + line.substr(marks);
      joins = kind == Block::Kind::paragraph || kind == Block::Kind::table;
    };
    if (line == "```math") {
      all.push_back({Block::Kind::formula, ""});
      while (std::getline(lines, line) && line != "```") all.back().text += line + "\n";
      joins = false;
    } else if (line == "```c") {
      all.push_back({Block::Kind::code, ""});
      while (std::getline(lines, line) && line != "```") all.back().text += line + "\n";
      joins = false;
    } else if (line.empty()) {
      joins = false;
    } else if (line.starts_with("#")) {
      begin(Block::Kind::heading, line.find(' ') + 1);
    } else if (line.starts_with("- ")) {
      begin(Block::Kind::item, 2);
    } else {
      begin(line.starts_with("|") ? Block::Kind::table : Block::Kind::paragraph, 0);
    }
  }
  return all;
}

/// How the parts of a line are written: formulas between $, code between `, strong words between **, and all else.
struct Style {
  std::function<std::string(std::string_view)> formula, code, strong, words;
};

std::string styled(std::string_view text, const Style& style) {
  std::string result;
  const auto part = [&](std::string_view mark, const auto& write) {
    if (!text.starts_with(mark)) return false;
    const std::size_t end = text.find(mark, mark.size());
    result += write(text.substr(mark.size(), end - mark.size()));
    text.remove_prefix(end + mark.size());
    return true;
  };
  while (!text.empty()) {
    if (part("$", style.formula) || part("`", style.code) || part("**", style.strong)) continue;
    const std::size_t end = std::min(text.find_first_of("$`*"), text.size());
    result += style.words(text.substr(0, end));
    text.remove_prefix(end);
  }
  return result;
}

std::string as_is(std::string_view text) { return std::string(text); }

std::string plain(std::string_view text) {
  return styled(text, {[](std::string_view tex) { return plain_formula(tex); }, as_is, as_is, as_is});
}

/// A row's cells.
std::vector<std::string> cells_of(const std::string& row) {
  std::vector<std::string> cells = CLI::detail::split(row, '|');
  for (std::string& cell : cells) CLI::detail::trim(cell);
  return {cells.begin() + 1, cells.end()};
}

/// The equations of a block, one below the other or side by side where they fit; the number at the right margin.
std::string equations(const std::string& tex) {
  std::string number;
  std::istringstream parts(plain_formula(tex, &number));
  constexpr std::string_view indent = "    ", apart = "   ";
  const std::string tag = number.empty() ? "" : fmt::format("({})", number);
  std::vector<std::string> lines;
  for (std::string part; std::getline(parts, part);) {
    if (CLI::detail::trim(part).empty()) continue;
    if (!lines.empty() && lines.back().size() + apart.size() + part.size() + tag.size() + 2 <= help_width) {
      lines.back() += fmt::format("{}{}", apart, part);
    } else {
      lines.push_back(fmt::format("{}{}", indent, part));
    }
  }
  // What is longer goes on after the last equals sign that has room.
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].size() + tag.size() + 2 <= help_width) continue;
    const std::size_t sign = lines[i].rfind(" = ", help_width - 8);
    if (sign == std::string::npos || sign < 12) throw std::logic_error("theory: too long a formula: " + lines[i]);
    lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                 fmt::format("{}  {}", indent, lines[i].substr(sign + 1)));
    lines[i].resize(sign);
  }
  lines.back() += fmt::format("{:>{}}", tag, tag.empty() ? 0 : help_width - lines.back().size());
  return fmt::format("{}\n", fmt::join(lines, "\n"));
}

std::string tex_words(std::string_view text) {
  std::string result;
  for (char c : text) {
    if (std::string_view("%&#_{}").find(c) != std::string_view::npos) result += '\\';
    result += c;
  }
  return result;
}

std::string tex(std::string_view text) {
  const auto in = [](const char* command) {
    return [command](std::string_view part) { return fmt::format("\\{}{{{}}}", command, tex_words(part)); };
  };
  return styled(text, {[](std::string_view formula) { return fmt::format("${}$", formula); }, in("texttt"),
                       in("textbf"), tex_words});
}

std::string tex_table(const std::string& text) {
  std::istringstream rows(text);
  std::string result;
  for (std::string row; std::getline(rows, row);) {
    if (row.starts_with("|--")) continue;
    std::vector<std::string> cells = cells_of(row);
    std::ranges::transform(cells, cells.begin(), [](const std::string& cell) { return tex(cell); });
    if (result.empty())
      result = fmt::format("\\begin{{center}}\\begin{{tabular}}{{{}}}\n", std::string(cells.size(), 'l'));
    result += fmt::format("{} \\\\\n", fmt::join(cells, " & "));
  }
  return result + "\\end{tabular}\\end{center}\n";
}

std::string plain_table(const std::string& text) {
  std::istringstream rows(text);
  std::string result, row;
  std::getline(rows, row);
  const std::vector<std::string> heading = cells_of(row);
  std::getline(rows, row);
  while (std::getline(rows, row)) {
    const std::vector<std::string> cells = cells_of(row);
    std::string meaning = plain(cells[1]);
    for (std::size_t i = 2; i < cells.size(); ++i) {
      if (!cells[i].empty()) meaning += fmt::format("; {} {}", heading[i], plain(cells[i]));
    }
    result += help_entry(plain(cells[0]), meaning);
  }
  return result;
}

std::string text_of(std::span<const Block> blocks) {
  std::string text;
  Block::Kind before = Block::Kind::heading;
  for (const auto& [kind, content] : blocks) {
    if (!text.empty() && !(kind == Block::Kind::item && before == kind)) text += "\n";
    before = kind;
    switch (kind) {
      case Block::Kind::heading:
        text += fmt::format("{}:\n", plain(content));
        break;
      case Block::Kind::paragraph:
        text += help_paragraph(plain(content));
        break;
      case Block::Kind::formula:
        text += equations(content);
        break;
      case Block::Kind::code: {
        std::istringstream lines(content);
        for (std::string line; std::getline(lines, line);) text += fmt::format("    {}\n", line);
        break;
      }
      case Block::Kind::table:
        text += plain_table(content);
        break;
      case Block::Kind::item: {
        const std::size_t end = content.find(": ", content.rfind('`'));
        text += help_entry(plain(content.substr(0, end)), plain(content.substr(end + 2)));
      }
    }
  }
  return text;
}

/// Each with its heading.
std::vector<std::vector<Block>> sections() {
  std::vector<std::vector<Block>> all;
  for (Block& block : blocks()) {
    if (block.kind == Block::Kind::heading) all.emplace_back();
    all.back().push_back(std::move(block));
  }
  return all;
}

std::string in_small_letters(std::string_view text) {
  std::string small(text);
  for (char& letter : small) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return small;
}

/// Counts a word in a text, except as a part of another word.
std::ptrdiff_t count_word(const std::string& text, const std::string& word) {
  const auto is_letter = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; };
  std::ptrdiff_t count = 0;
  for (std::size_t at = text.find(word); at != text.npos; at = text.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    count += (at == 0 || !is_letter(text[at - 1])) && (end == text.size() || !is_letter(text[end])) ? 1 : 0;
  }
  return count;
}

/// Index of the text that has a word most often.
std::optional<std::size_t> most_often(const std::string& word, const std::vector<std::string>& texts) {
  std::vector<std::ptrdiff_t> counts;
  for (const std::string& text : texts) counts.push_back(count_word(in_small_letters(text), in_small_letters(word)));
  const auto largest = std::ranges::max_element(counts);
  if (word.empty() || *largest == 0) return std::nullopt;
  return static_cast<std::size_t>(largest - counts.begin());
}

}  // namespace

std::string theory_as_text() { return text_of(blocks()); }

std::vector<std::string> theory_sections() {
  std::vector<std::string> headings;
  for (const auto& section : sections()) headings.push_back(plain(section.front().text));
  return headings;
}

std::optional<std::size_t> section_named(const std::string& word) { return most_often(word, theory_sections()); }

std::optional<std::size_t> section_about(const std::string& word) {
  if (const auto named = section_named(word)) return named;
  std::vector<std::string> texts;
  for (const auto& section : sections()) texts.push_back(text_of(section));
  return most_often(word, texts);
}

std::string theory_as_text(std::size_t section) { return text_of(sections().at(section)); }

std::string theory_as_tex() {
  std::string text = "\\documentclass{article}\n\\usepackage{amsmath}\n\\begin{document}\n";
  for (const auto& [kind, content] : blocks()) {
    switch (kind) {
      case Block::Kind::heading:
        text += fmt::format("\n\\section*{{{}}}\n", tex(content));
        break;
      case Block::Kind::paragraph:
        text += fmt::format("\n{}\n", tex(content));
        break;
      case Block::Kind::formula:
        text += fmt::format("\\begin{{equation*}}\n{}\\end{{equation*}}\n", content);
        break;
      case Block::Kind::code:
        text += fmt::format("\\begin{{verbatim}}\n{}\\end{{verbatim}}\n", content);
        break;
      case Block::Kind::table:
        text += tex_table(content);
        break;
      case Block::Kind::item:
        text += fmt::format("\\par\\noindent {}\n", tex(content));
    }
  }
  return text + "\\end{document}\n";
}

}  // namespace contensou::program
