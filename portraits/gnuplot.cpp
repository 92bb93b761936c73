// The one file that knows gnuplot. A 2014 gnuplot-iostream reports neither a missing nor a failing gnuplot, so it
// writes the script, and the script is run here, once, with its status checked.
#include "contensou/portraits/gnuplot.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <iomanip>
#include <memory>
#include <sstream>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gnuplot-iostream.h>
#include <boost/process.hpp>

namespace contensou::portraits {

namespace process = boost::process;

namespace {

constexpr std::array formats{
    std::pair{std::string_view("svg"), PictureFormat::svg},
    std::pair{std::string_view("pdf"), PictureFormat::pdf},
    std::pair{std::string_view("png"), PictureFormat::png},
    std::pair{std::string_view("gp"), PictureFormat::gp},
};

constexpr double points_per_mm = 72 / 25.4;

std::string terminal(const Figure& figure, PictureFormat format) {
  const double width = figure.width_mm;
  const double height = figure.height_mm;
  switch (format) {
    case PictureFormat::pdf:
      return fmt::format(
          "set terminal pdfcairo size {}cm,{}cm enhanced font 'sans,9' linewidth 0.75 background '#ffffff'", width / 10,
          height / 10);
    case PictureFormat::png: {
      constexpr double pixels_per_mm = 200 / 25.4;
      return fmt::format(
          "set terminal pngcairo size {:.0f},{:.0f} enhanced font 'sans,9' fontscale 2.1 linewidth 2 background "
          "'#ffffff'",
          width * pixels_per_mm, height * pixels_per_mm);
    }
    case PictureFormat::svg:
    case PictureFormat::gp:
      break;
  }
  constexpr double pixels_per_mm = 5;
  return fmt::format("set terminal svg size {:.0f},{:.0f} dynamic enhanced font 'sans-serif,13' background '#ffffff'",
                     width * pixels_per_mm, height * pixels_per_mm);
}

/// Text as a gnuplot string: between single quotes nothing is run and only the quote itself is special. Control
/// characters would end the line.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (char c : text) {
    if (c == '\'') result += '\'';
    result += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  }
  return result + '\'';
}

std::string colour(Colour colour) { return fmt::format("rgb '#{:06x}'", colour.rgb); }

std::string line_style(const Stroke& stroke) {
  return fmt::format("lc {} lw {}{}", colour(stroke.colour), stroke.width, stroke.dashed ? " dt (9,5)" : " dt 1");
}

using Row = std::pair<double, double>;
using Vector = std::tuple<double, double, double, double>;

std::vector<std::vector<Row>> rows(const std::vector<Polyline>& lines) {
  std::vector<std::vector<Row>> result;
  for (const Polyline& line : lines) {
    auto& block = result.emplace_back();
    for (const Point& point : line) block.emplace_back(point.x, point.y);
  }
  return result;
}

/// Vectors so short that only their heads show; of one length on paper whatever the axes.
std::vector<Vector> heads(const Panel& panel, const std::vector<Arrow>& arrows) {
  constexpr double length = 0.004;
  const double x_range = panel.x.high - panel.x.low;
  const double y_range = panel.y.high - panel.y.low;
  std::vector<Vector> result;
  for (const Arrow& arrow : arrows) {
    const double size = std::hypot(arrow.direction.x / x_range, arrow.direction.y / y_range);
    const double dx = arrow.direction.x / size * length;
    const double dy = arrow.direction.y / size * length;
    result.emplace_back(arrow.at.x - dx, arrow.at.y - dy, dx, dy);
  }
  return result;
}

void write_axis(Gnuplot& gp, const char* which, const Axis& axis) {
  gp << "set " << which << "label " << quoted(axis.name) << "\n";
  gp << "set " << which << "range [" << axis.low << ":" << axis.high << "]\n";
  gp << (axis.logarithmic ? "set logscale " : "unset logscale ") << which << "\n";
  gp << "set " << which << "tics nomirror out scale 0.6\n";
  gp << "set format " << which << (axis.logarithmic ? " '10^{%T}'" : " '%g'") << "\n";
  if (axis.ticks.empty()) return;
  gp << "set " << which << "tics (";
  for (const auto& tick : axis.ticks) {
    gp << (&tick == &axis.ticks.front() ? "" : ", ") << quoted(tick.text) << " " << tick.at;
  }
  gp << ")\n";
}

const char* alignment(Label::Align align) {
  switch (align) {
    case Label::Align::left:
      return "left";
    case Label::Align::right:
      return "right";
    case Label::Align::centre:
      break;
  }
  return "center";
}

/// From light to dark and from yellow to blue: in order also in grey, and for eyes that see red and green alike.
constexpr const char* palette =
    "set palette defined (0 '#fffbe0', 0.18 '#f3e6a1', 0.36 '#b9d8a6', 0.54 '#76bcb4', 0.72 '#4495b8', 0.87 '#3468a4', "
    "1 '#2f4788')\n";

/// The plot of a colour map: on axes of its own, which are linear. Its data follow by send_colours.
std::string write_colours(Gnuplot& gp, const ColourMap& colours, double right, double bar_left) {
  const double low = colours.scale.low;
  const double high = colours.scale.high > low ? colours.scale.high : low + 1;
  gp << palette;
  write_axis(gp, "cb", {"", low, high, colours.scale.logarithmic, colours.scale.ticks});
  gp << "set colorbox vertical user origin screen " << bar_left << ",0.19 size screen " << (right - bar_left) * 0.25
     << ",0.65 noborder\n";
  gp << "set label " << quoted(colours.scale.name) << " at screen " << bar_left + (right - bar_left) * 0.125
     << ",0.87 center\n";
  gp << "set x2range [0:" << colours.columns << "]\nset y2range [0:" << colours.values.size() / colours.columns
     << "]\n";
  return "'-' matrix using ($1+0.5):($2+0.5):3 axes x2y2 with image notitle";
}

void send_colours(Gnuplot& gp, const ColourMap& colours) {
  for (std::size_t i = 0; i < colours.values.size(); ++i) {
    gp << colours.values[i] << ((i + 1) % colours.columns == 0 ? "\n" : " ");
  }
  gp << "e\n";
}

/// Writes one panel into the strip [left, right] of the width.
void write_panel(Gnuplot& gp, const Panel& panel, double left, double right, double bar_room) {
  const double bar_left = right - bar_room;
  gp << "set lmargin at screen " << left << "\nset rmargin at screen "
     << (panel.colours ? bar_left - 0.15 * bar_room : right) << "\n";
  gp << "set title " << quoted(panel.title) << " offset 0,-0.4\n";
  write_axis(gp, "x", panel.x);
  write_axis(gp, "y", panel.y);
  if (panel.bare) gp << "unset border\nunset xtics\nunset ytics\nunset xlabel\nunset ylabel\n";
  gp << "unset label\n";
  for (const Label& label : panel.labels) {
    gp << "set label " << quoted("{/*0.85 " + label.text + "}") << " at " << label.at.x << "," << label.at.y << " "
       << alignment(label.align) << " front boxed tc " << colour(label.colour) << "\n";
  }

  std::string separator = "plot ";
  const auto entry = [&](const std::string& text) { gp << std::exchange(separator, ", \\\n     ") << text; };
  if (panel.colours) entry(write_colours(gp, *panel.colours, right, bar_left));
  for (const Lines& layer : panel.lines) {
    entry(fmt::format("'-' with lines {} notitle", line_style(layer.stroke)));
  }
  for (const Arrows& layer : panel.arrows) {
    entry(fmt::format("'-' with vectors head filled size screen 0.011,18,75 fixed lc {} lw 0.5 notitle",
                      colour(layer.colour)));
  }
  for (const Marks& layer : panel.marks) {
    entry(fmt::format("'-' with points pt 7 ps {} lc {} notitle", layer.size, colour(layer.colour)));
  }
  gp << "\n";
  if (panel.colours) send_colours(gp, *panel.colours);
  for (const Lines& layer : panel.lines) gp.send2d(rows(layer.lines));
  for (const Arrows& layer : panel.arrows) gp.send1d(heads(panel, layer.arrows));
  for (const Marks& layer : panel.marks) gp.send1d(rows({layer.points}).front());
}

/// Title, subtitle and legend, in a plot of its own that covers the page and shows nothing else.
void write_heading(Gnuplot& gp, const Figure& figure) {
  gp << "set lmargin at screen 0.02\nset rmargin at screen 0.98\nunset border\nunset tics\n";
  gp << "set key at screen 0.5,0.02 center bottom horizontal maxrows 1 samplen 2.6 width 2\n";
  gp << "set label " << quoted(figure.title) << " at screen 0.5,0.962 center font ',15'\n";
  gp << "set label " << quoted(figure.subtitle) << " at screen 0.5,0.916 center tc rgb '#555555'\n";
  std::string separator = "plot [0:1] [0:1] ";
  std::vector<std::string> listed;  // panels share entries
  for (const Panel& panel : figure.panels) {
    for (const Lines& layer : panel.lines) {
      if (layer.legend.empty() || std::ranges::find(listed, layer.legend) != listed.end()) continue;
      listed.push_back(layer.legend);
      gp << std::exchange(separator, ", \\\n     ");
      gp << "NaN with lines " << line_style(layer.stroke) << " title " << quoted(layer.legend);
    }
  }
  if (listed.empty()) gp << separator << "NaN notitle";
  gp << "\nunset key\nset border 3 lw 0.8 lc rgb '#444444'\n";
}

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

std::string read_all(std::FILE* file) {
  std::rewind(file);
  std::string text;
  std::array<char, 1 << 16> buffer;
  while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), file)) text.append(buffer.data(), count);
  return text;
}

std::string script(const Figure& figure, PictureFormat format) {
  const std::unique_ptr<std::FILE, CloseFile> file(std::tmpfile());
  if (!file)
    throw GnuplotError(fmt::format("cannot make a temporary file for the gnuplot script: {}", std::strerror(errno)));
  {
    const int copy = dup(fileno(file.get()));
    Gnuplot gp(fdopen(copy, "w"));
    gp << std::defaultfloat << std::setprecision(8);
    gp << "# Drawn by contensou; gnuplot 5. `gnuplot FILE.gp > FILE.svg` draws it again.\n";
    gp << "set encoding utf8\n" << terminal(figure, format) << "\n";
    gp << "set style textbox opaque noborder fillcolor rgb '#ffffff' margins 0.2,0.1\n";
    gp << "set multiplot\n";
    const bool bare = std::ranges::all_of(figure.panels, &Panel::bare);  // no axis, no legend below
    gp << "set tmargin at screen 0.84\nset bmargin at screen " << (bare ? 0.04 : 0.19) << "\n";
    write_heading(gp, figure);
    const double count = static_cast<double>(figure.panels.size());
    const double label_room = 20 / figure.width_mm;
    for (std::size_t i = 0; i < figure.panels.size(); ++i) {
      const double left = static_cast<double>(i) / count;
      write_panel(gp, figure.panels[i], left + label_room, left + 1 / count - 0.25 * label_room, 22 / figure.width_mm);
    }
    gp << "unset multiplot\n";
  }
  return read_all(file.get());
}

/// A file without a name in the temporary folder: whatever ends the program, nothing is left of it.
class ScratchFile {
 public:
  ScratchFile() {
    std::error_code error;
    const auto parent = std::filesystem::temp_directory_path(error);
    if (error) {
      throw GnuplotError(fmt::format("no temporary folder for gnuplot: {}; set TMPDIR to one", error.message()));
    }
    std::string pattern = (parent / "contensou-XXXXXX").string();
    const int descriptor = mkstemp(pattern.data());
    if (descriptor >= 0) unlink(pattern.c_str());
    file_.reset(descriptor >= 0 ? fdopen(descriptor, "w+b") : nullptr);
    if (!file_) throw GnuplotError(fmt::format("cannot make a temporary file {}: {}", pattern, std::strerror(errno)));
  }
  std::FILE* get() const { return file_.get(); }

 private:
  std::unique_ptr<std::FILE, CloseFile> file_;
};

std::string first_lines(const std::string& text, int count) {
  std::istringstream stream(text);
  std::string result;
  for (std::string line; count > 0 && std::getline(stream, line);) {
    if (line.find_first_not_of(" \t^") == std::string::npos) continue;
    result += "\n  " + line;
    --count;
  }
  return result;
}

std::string_view name(PictureFormat format) {
  return std::ranges::find(formats, format, &std::pair<std::string_view, PictureFormat>::second)->first;
}

/// Whether the bytes begin as a file of the format does.
bool is_picture(std::string_view bytes, PictureFormat format) {
  switch (format) {
    case PictureFormat::svg:
      return bytes.starts_with("<?xml") && bytes.find("</svg>") != std::string_view::npos;
    case PictureFormat::pdf:
      return bytes.starts_with("%PDF");
    case PictureFormat::png:
      return bytes.starts_with("\x89PNG");
    case PictureFormat::gp:
      break;
  }
  return true;
}

int run(const boost::filesystem::path& gnuplot, const ScratchFile& script, const ScratchFile& picture,
        const ScratchFile& messages) {
  try {
    return process::system(gnuplot, process::std_in<script.get(), process::std_out> picture.get(),
                           process::std_err > messages.get());
  } catch (const process::process_error& error) {
    throw GnuplotError(fmt::format("gnuplot ({}) cannot be started: {}", gnuplot.string(), error.what()));
  }
}

/// Italics cut a text into pieces, at whose ends some SVG viewers drop spaces unless told to keep them.
std::string with_spaces(std::string svg) {
  constexpr std::string_view plain = "<text>";
  constexpr std::string_view preserving = "<text xml:space=\"preserve\">";
  for (std::size_t at = 0; (at = svg.find(plain, at)) != std::string::npos; at += preserving.size()) {
    svg.replace(at, plain.size(), preserving);
  }
  return svg;
}

}  // namespace

std::optional<PictureFormat> find_picture_format(std::string_view ending) {
  const auto found = std::ranges::find(formats, ending, &std::pair<std::string_view, PictureFormat>::first);
  if (found == formats.end()) return std::nullopt;
  return found->second;
}

std::string gnuplot_script(const Figure& figure) { return script(figure, PictureFormat::gp); }

std::string render(const Figure& figure, PictureFormat format) {
  if (format == PictureFormat::gp) return gnuplot_script(figure);

  const auto gnuplot = process::search_path("gnuplot");
  if (gnuplot.empty()) {
    throw GnuplotError(
        "gnuplot was not found on PATH; install it (Debian: gnuplot-nox), or write .gp, .csv or .json, which need "
        "none");
  }
  const ScratchFile commands, drawing, messages_file;
  const std::string text = script(figure, format);
  const bool written = std::fwrite(text.data(), 1, text.size(), commands.get()) == text.size();
  if (!written || std::fflush(commands.get()) != 0) {
    throw GnuplotError(fmt::format("cannot write the gnuplot script: {}", std::strerror(errno)));
  }
  std::rewind(commands.get());

  const int status = run(gnuplot, commands, drawing, messages_file);
  const std::string messages = first_lines(read_all(messages_file.get()), 4);
  if (status != 0) {
    throw GnuplotError(fmt::format("gnuplot ({}) ended with status {}{}", gnuplot.string(), status, messages));
  }
  std::string picture = read_all(drawing.get());
  if (!is_picture(picture, format)) {
    throw GnuplotError(fmt::format("gnuplot ({}) drew nothing that is {}{}", gnuplot.string(), name(format), messages));
  }
  return format == PictureFormat::svg ? with_spaces(std::move(picture)) : picture;
}

}  // namespace contensou::portraits
