#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include <CLI/CLI.hpp>

#include "verb.hpp"

namespace contensou::program {

inline constexpr std::size_t help_width = 80;

/// Text in lines of at most 80 columns.
std::string help_paragraph(std::string_view text, std::size_t indent = 0);

/// A name and, beside or below it, what it means, in lines of at most 80 columns.
std::string help_entry(std::string_view name, std::string_view meaning);

/// The columns and fields of a verb; empty if it has none.
std::string help_on_fields(const VerbEntry& verb);

/// How CLI11 writes the help of a verb.
class HelpFormatter final : public CLI::Formatter {
 public:
  HelpFormatter();
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
  std::string make_option(const CLI::Option* option, bool is_positional) const override;
  std::string make_subcommand(const CLI::App* verb) const override;
};

}  // namespace contensou::program
