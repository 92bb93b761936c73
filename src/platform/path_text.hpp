#pragma once

#include <filesystem>
#include <string>

namespace contensou::platform {

/// Convert a path from UTF-8 and to UTF-8. In Windows, std::filesystem expects another encoding in a plain string.
inline std::filesystem::path path_of(const std::string& text) { return std::u8string(text.begin(), text.end()); }

inline std::string text_of(const std::filesystem::path& path) {
  const std::u8string text = path.u8string();
  return {text.begin(), text.end()};
}

}  // namespace contensou::platform
