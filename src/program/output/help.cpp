#include "output/help.hpp"

#include <algorithm>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace contensou::program {

namespace {

constexpr std::size_t margin = 22;  ///< column in which meanings begin
constexpr const char* shared = " ('contensou help ";
constexpr long most_lines = 110;  ///< largest number of lines in the help of a verb

/// Symbols and terms that the help of several verbs uses.
constexpr std::pair<std::string_view, std::string_view> glossary[]{
    {"u", "spin omega_z about the vertical times body radius R"},
    {"v", "slip: sliding speed of the contact point, 0 or more"},
    {"mu", "radius of the contact patch divided by R. It is not the coefficient of friction, which is f"},
    {"k", "slip divided by the rim speed of the patch: v/(mu |u|)"},
    {"f, N", "coefficient of friction, and load (normal force)"},
    {"Phi, Psi",
     "force of friction divided by f N, and moment of friction divided by f N and patch radius: functions of k"},
    {"tau", "reduced time (3 pi/2) f g t, in the unit of u and v, with time t and acceleration of gravity g"},
    {"beta",
     "regularised time, which grows from 0 at the start to infinity at the stop: (2.8) in 'contensou help theory'"},
    {"chi, gamma",
     "1 + m R^2/J and m R^2/J_z, with mass m and moments of inertia J about a horizontal axis, J_z about the vertical"},
    {"(2.6), (2.7)", "equations for u and v, printed by 'contensou help theory'"},
    {"orbit", "curve that a motion draws in the plane of u and v"},
    {"symmetry", "change of time, u and v that turns motions into motions"},
    {"centre", "point that the symmetry leaves fixed; u = v = 0 for (2.6)"},
    {"ray", "half-line from the centre u = v = 0 that is an orbit"},
    {"slip", "sliding speed of the contact point"},
    {"spin", "angular velocity about the vertical"},
    {"patch", "small circle in which body and plane touch"},
    {"law", "law of friction: force and moment of friction in the patch"},
    {"stop", "instant when slip and spin have ended"},
    {"event", "begin of rolling, end of the spin, or rest"},
    {"uncoupled model", "model in which friction brakes slip and spin separately"},
    {"run file", "file with the values of a body ('contensou help files')"},
    {"the paper",
     "V. F. Zhuravlev, On a model of dry friction in the problem of rolling of rigid bodies, Prikl. Mat. Mekh. 62 "
     "(1998)"},
    {"(speed)", "unit of a field: the unit in which --u0 and --v0 are given"},
};

/// @param column  column in which the first line begins
/// @param indent  column in which the other lines begin
std::string wrapped(std::string_view text, std::size_t column, std::size_t indent) {
  std::string lines;
  std::istringstream words{std::string(text)};
  for (std::string word; words >> word;) {
    const auto bytes_more = std::ranges::count_if(word, [](char c) { return (c & 0xC0) == 0x80; });  // UTF-8
    const std::size_t size = word.size() - static_cast<std::size_t>(bytes_more);
    if (!lines.empty()) {
      const bool fits = column + 1 + size <= help_width;
      lines += fits ? " " : fmt::format("\n{:{}}", "", indent);
      column = fits ? column + 1 : indent;
    }
    lines += word;
    column += size;
  }
  return lines + "\n";
}

}  // namespace

std::string help_paragraph(std::string_view text, std::size_t indent) {
  return std::string(indent, ' ') + wrapped(text, indent, indent);
}

std::string help_entry(std::string_view name, std::string_view meaning) {
  std::string names = wrapped(name, 2, 4);
  names.pop_back();  // removes the line end
  const std::string separator = name.size() + 4 > margin ? fmt::format("\n{:{}}", "", margin) : "";
  return fmt::format("  {:<{}}{}{}", names, separator.empty() ? margin - 2 : 0, separator,
                     wrapped(meaning, margin, margin));
}

std::string shared_group(std::string_view title, std::string_view topic) {
  return fmt::format("{}{}{}')", title, shared, topic);
}

std::string help_on_group(const CLI::App& app, const std::string& group) {
  std::string text;
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_group() == group) text += HelpFormatter().make_option(option, false);
  }
  return text;
}

std::string help_on_words(const std::vector<std::string_view>& names) {
  for (std::string_view name : names) {
    if (std::ranges::find(glossary, name, &std::pair<std::string_view, std::string_view>::first) == std::end(glossary))
      throw std::logic_error(fmt::format("the glossary of help has no entry '{}'", name));
  }
  std::string text = "\nSymbols and words:\n";
  for (const auto& [name, meaning] : glossary) {
    if (names.empty() || std::ranges::find(names, name) != names.end()) text += help_entry(name, meaning);
  }
  return text;
}

std::string help_on_fields(const VerbEntry& verb, bool all) {
  std::string text;
  std::vector<std::string_view> others;
  for (const auto& [option, fields] : verb.fields) {
    if (!all && !option.empty()) {
      others.push_back(option);
      continue;
    }
    text += fmt::format("\nColumns and fields of {}{}{}:\n", verb.name, option.empty() ? "" : " ", option);
    for (auto [names, unit, meaning] : fields()) {
      std::erase(names, '`');
      text += help_entry(names, unit.empty() ? meaning : fmt::format("{} ({})", meaning, unit));
    }
  }
  if (!others.empty()) {
    text += "\n" + help_paragraph(fmt::format("'contensou help fields' also lists the columns and fields with {}.",
                                              fmt::join(others, ", ")));
  }
  return text;
}

namespace {

/// Returns the names of the fields of a verb, for a help that would be too long with the meanings of the fields.
std::string names_of_fields(const VerbEntry& verb) {
  std::vector<std::string> all;
  for (auto [names, unit, meaning] : verb.fields.front().fields()) {
    std::erase(names, '`');
    all.push_back(names);
  }
  return fmt::format("\nColumns and fields of {}{}fields'):\n{}", verb.name, shared,
                     help_paragraph(fmt::format("{}", fmt::join(all, "; ")), 2));
}

}  // namespace

HelpFormatter::HelpFormatter() {
  label("SUBCOMMAND", "VERB");
  label("Positionals", "Arguments");
}

std::string HelpFormatter::make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const {
  std::string text = CLI::Formatter::make_help(app, std::move(name), mode);
  text = CLI::detail::rtrim(text = CLI::detail::find_and_replace(text, "\n\n\n", "\n\n")) + "\n";
  const auto verb = std::ranges::find(verbs(), app->get_name(), &VerbEntry::name);
  if (verb == verbs().end()) return text;
  const std::string fields = help_on_fields(*verb, false);
  const auto lines = std::ranges::count(text, '\n') + std::ranges::count(fields, '\n');
  return text + (lines <= most_lines ? fields : names_of_fields(*verb));
}

std::string HelpFormatter::make_usage(const CLI::App* app, std::string name) const {
  const std::string usage = CLI::Formatter::make_usage(app, std::move(name));
  const auto verb = std::ranges::find(verbs(), app->get_name(), &VerbEntry::name);
  return verb == verbs().end() || verb->words.empty() ? usage : usage + help_on_words(verb->words);
}

std::string HelpFormatter::make_group(std::string group, bool is_positional,
                                      std::vector<const CLI::Option*> options) const {
  if (group.find(shared) == std::string::npos) return CLI::Formatter::make_group(group, is_positional, options);
  std::vector<std::string> names;
  for (const CLI::Option* option : options) names.push_back(make_option_name(option, is_positional));
  return fmt::format("\n{}:\n{}", group, help_paragraph(fmt::format("{}", fmt::join(names, ", ")), 2));
}

std::string HelpFormatter::make_option(const CLI::Option* option, bool is_positional) const {
  std::string name = make_option_name(option, is_positional);
  if (const auto comma = name.find(','); comma != std::string::npos) name.insert(comma + 1, " ");
  if (!is_positional && option->get_type_size() != 0) name += " " + option->get_type_name();
  return help_entry(name, option->get_description());
}

std::string HelpFormatter::make_subcommand(const CLI::App* verb) const {
  return help_entry(verb->get_name(), verb->get_description());
}

}  // namespace contensou::program
