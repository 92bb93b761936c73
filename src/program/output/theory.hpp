#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace contensou::program {

/// The chapter "Theory" of reduction/README.md, which is compiled in: as plain text in lines of at most 80 columns, its
/// formulas turned into words; and as a document for LaTeX.
std::string theory_as_text();

/// The headings of its sections, as plain text.
std::vector<std::string> theory_sections();

/// Returns the number of the section whose heading has a word; nothing where none has. Letters may be small or large.
std::optional<std::size_t> section_named(const std::string& word);

/// Returns the same, or else the section that says the word most often.
std::optional<std::size_t> section_about(const std::string& word);

/// Returns one section of it as plain text.
/// @param section  its number in theory_sections
std::string theory_as_text(std::size_t section);
std::string theory_as_tex();

}  // namespace contensou::program
