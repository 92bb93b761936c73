#include "output/picture.hpp"

#include <filesystem>

#include "exit_status.hpp"

namespace contensou::program {

std::string ending(const std::string& path) {
  const std::string extension = std::filesystem::path(path).extension().string();
  return extension.empty() ? extension : extension.substr(1);
}

std::string drawn(const portraits::Figure& figure, portraits::PictureFormat format) {
  try {
    return portraits::render(figure, format);
  } catch (const portraits::GnuplotError& error) {
    throw FileFailure(error.what());
  }
}

}  // namespace contensou::program
