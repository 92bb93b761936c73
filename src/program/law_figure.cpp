#include "law_figure.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>

#include <fmt/format.h>

#include "exit_status.hpp"

namespace contensou::program {

bool is_figure(const std::string& path) {
  constexpr std::array<std::string_view, 4> endings{".svg", ".pdf", ".png", ".gp"};
  return std::ranges::find(endings, std::filesystem::path(path).extension().string()) != endings.end();
}

void write_law_figure(const std::string& path, const reduction::Law& /*law*/) {
  throw BadInput(fmt::format("-o {}: pictures of a law are not drawn yet; use the ending csv or json with --k", path));
}

}  // namespace contensou::program
