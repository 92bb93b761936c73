#pragma once

#include <stdlib.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>

#include <catch2/catch.hpp>

#include "contensou/portraits/figure.hpp"

namespace contensou::portraits {

/// Returns the lines of a panel whose legend begins with the given text.
inline const Lines& layer(const Panel& panel, std::string_view legend) {
  const auto found =
      std::ranges::find_if(panel.lines, [&](const Lines& lines) { return lines.legend.words().starts_with(legend); });
  REQUIRE(found != panel.lines.end());
  return *found;
}

inline bool inside(const Panel& panel, const Point& point) {
  return point.x >= panel.x.low && point.x <= panel.x.high && point.y >= panel.y.low && point.y <= panel.y.high;
}

/// A new empty folder, which is removed with its contents at the end.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "contensou-test-XXXXXX").string();
    REQUIRE(mkdtemp(pattern.data()) != nullptr);
    path_ = pattern;
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace contensou::portraits
