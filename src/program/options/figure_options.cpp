#include "options/figure_options.hpp"

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "contensou/portraits/layout.hpp"
#include "output/help.hpp"

namespace contensou::program {

namespace {

constexpr double min_side = 40, max_side = 2000;
constexpr double single_column = 85, double_column = 170;

portraits::AskedSize parse_size(const std::string& typed) {
  if (typed == "single") return {single_column, {}};
  if (typed == "double") return {double_column, {}};
  constexpr const char* wanted = "single, double, or width and height in mm are needed, as in 180x120";
  const std::size_t cross = typed.find('x');
  if (cross == std::string::npos) throw NotAllowed(wanted);
  std::vector<double> sides;
  try {
    sides = {parse_number(typed.substr(0, cross)), parse_number(typed.substr(cross + 1))};
  } catch (const BadInput& error) {
    throw NotAllowed("{}; {}", error.what(), wanted);
  }
  for (double side : sides) {
    if (side >= min_side && side <= max_side) continue;
    throw NotAllowed("width and height must be {} to {} mm", min_side, max_side);
  }
  return {sides[0], sides[1]};
}

std::string parse_font(const std::string& typed) {
  // Picture formats would take other characters for the end of the name of the font.
  const auto forbidden = [](char c) {
    return static_cast<unsigned char>(c) < ' ' || std::string_view("'\",;:<>&\\").find(c) != std::string_view::npos;
  };
  if (typed.empty() || std::ranges::any_of(typed, forbidden))
    throw NotAllowed("the name of a font is needed, as in 'DejaVu Serif'");
  return typed;
}

}  // namespace

std::string figure_group() { return shared_group("Size and font of the picture", "picture"); }

void FigureOptions::add(CLI::App& app, bool several) {
  app.option_defaults()->group(figure_group());
  size_.add(app, "--size", "WxH",
            fmt::format("width and height in millimetres, each {} to {}; or the word single or double, the width of a "
                        "column ({} mm) or a page ({} mm) of a journal",
                        min_side, max_side, single_column, double_column),
            parse_size);
  font_.add(app, "--font", "NAME", "font of svg, pdf, png, eps and gif (default sans-serif)", parse_font);
  if (several) return;
  title_.add(app, "--title", "TEXT", "title of the figure; the word none removes title and subtitle");
  dpi_.add(app, "--dpi", "N", "resolution of a png in dots per inch, 50 to 1200 (default 300)", whole_number(50, 1200));
}

void require_picture(const std::string& names, const Output& output) {
  if (names.empty() || output.picture) return;
  throw BadInput("{}: {} is no picture; leave that out, or write one, as in -o figure.svg", names, output.format);
}

portraits::Figure FigureOptions::apply(portraits::Figure figure, const std::string& format) const {
  if (title_.given()) {
    figure.title = title_.text() == "none" ? "" : portraits::shortened(title_.text(), 200);
    figure.subtitle = "";
  }
  if (font_.given() && format == "tex")
    font_.reject("a tex has the font of the document that it stands in: leave it out");
  figure.font = font_.value_or("");
  if (dpi_.given() && format != "png") dpi_.reject(fmt::format("a {} has no dots: leave it out", format));
  figure.dpi = static_cast<double>(dpi_.value_or(static_cast<long>(figure.dpi)));
  return size().height_mm ? figure : portraits::trimmed(std::move(figure));
}

}  // namespace contensou::program
