#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

#include "verb.hpp"

namespace contensou::program {

inline constexpr std::size_t help_width = 80;

inline constexpr std::string_view exit_statuses =
    "Exit status: 0 done, 1 a check failed, 2 bad input, 3 numerical failure, 4 a file or gnuplot failed.";

/// Returns a text in lines of at most 80 columns.
std::string help_paragraph(std::string_view text, std::size_t indent = 0);

/// Returns a name and, beside or below it, its meaning, in lines of at most 80 columns.
std::string help_entry(std::string_view name, std::string_view meaning);

/// Returns the name of a group of options that several verbs share. The help of a verb lists only the names of these
/// options; 'contensou help TOPIC' explains them.
std::string shared_group(std::string_view title, std::string_view topic);

/// Returns the entries of those options of a command line that belong to the group of this name.
std::string help_on_group(const CLI::App& app, const std::string& group);

/// Returns the columns and fields of a verb; empty if it has none.
/// @param all  true: also the fields of an option such as --batch; false: only the names of such options
std::string help_on_fields(const VerbEntry& verb, bool all);

/// Returns the entries of the glossary with these names, under a heading. Without names it returns all entries.
std::string help_on_words(const std::vector<std::string_view>& names = {});

/// The format in which CLI11 writes help.
class HelpFormatter final : public CLI::Formatter {
 public:
  HelpFormatter();
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
  std::string make_usage(const CLI::App* app, std::string name) const override;
  std::string make_group(std::string group, bool is_positional, std::vector<const CLI::Option*> options) const override;
  std::string make_option(const CLI::Option* option, bool is_positional) const override;
  std::string make_subcommand(const CLI::App* verb) const override;
};

}  // namespace contensou::program
