// The one file that knows gnuplot. gnuplot-iostream writes the data of the script; it would start gnuplot, too, but not
// say when that is missing, fails or hangs.
#include "contensou/portraits/gnuplot.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <iomanip>
#include <iostream>
#include <locale>
#include <sstream>
#include <tuple>
#include <utility>
#include <vector>

#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>
#include <gnuplot-iostream.h>
#include <nlohmann/json.hpp>

#include "contensou/portraits/layout.hpp"
#include "contensou/portraits/pgfplots.hpp"

namespace contensou::portraits {

namespace {

/// How a whole file of a format begins and ends.
struct Format {
  std::string_view ending;
  PictureFormat format;
  std::string_view begin, end;
};

using namespace std::string_view_literals;
constexpr std::array formats{
    Format{"svg", PictureFormat::svg, "<?xml", "</svg>"},
    Format{"pdf", PictureFormat::pdf, "%PDF", "%%EOF"},
    Format{"png", PictureFormat::png, "\x89PNG", "\0\0\0\0IEND\xAE\x42\x60\x82"sv},
    Format{"eps", PictureFormat::eps, "%!PS-Adobe", "%%EOF"},
    Format{"gp", PictureFormat::gp, "", ""},
    Format{"tex", PictureFormat::tex, "", ""},
};

/// The size of letters on paper, and the width of a line of width 1, mm.
constexpr double letter_mm = 2.7;
constexpr double line_mm = 0.2;
/// The length of an arrow's head, mm.
constexpr double head_mm = 2.0;

/// Seconds that gnuplot may take.
constexpr unsigned time_limit = 60;
/// Its status where it cannot be run, as a shell's.
constexpr int not_run = 127;

std::string terminal(const Figure& figure, PictureFormat format) {
  const double width = figure.width_mm;
  const double height = figure.height_mm;
  const double letter = letter_mm * figure.theme.letters;
  const double line = line_mm * figure.theme.line;
  // gnuplot's cairo terminals count a point as 1/96 inch in letters and as half a point in lines.
  constexpr double letters_per_mm = 72 / 25.4 * 0.75;
  constexpr double lines_per_mm = 72 / 25.4 / 0.5;
  const std::string common = fmt::format("enhanced rounded background '#{:06x}'", figure.theme.ground.rgb);
  switch (format) {
    case PictureFormat::pdf:
    case PictureFormat::eps:
      return fmt::format("set terminal {}cairo size {}cm,{}cm {} font 'sans,{:.4g}' fontscale 1 linewidth {:.4g}",
                         format == PictureFormat::pdf ? "pdf" : "eps", width / 10, height / 10, common,
                         letter * letters_per_mm, line * lines_per_mm);
    case PictureFormat::png: {
      constexpr double pixels_per_mm = 200 / 25.4;
      return fmt::format("set terminal pngcairo size {:.0f},{:.0f} {} font 'sans,{:.4g}' fontscale 1 linewidth {:.4g}",
                         width * pixels_per_mm, height * pixels_per_mm, common, letter * pixels_per_mm * 0.75,
                         line * pixels_per_mm);
    }
    case PictureFormat::svg:
    case PictureFormat::gp:
    case PictureFormat::tex:
      break;
  }
  constexpr double pixels_per_mm = 5;
  return fmt::format("set terminal svg size {:.0f},{:.0f} dynamic {} font 'sans-serif,{:.4g}' linewidth {:.4g}",
                     width * pixels_per_mm, height * pixels_per_mm, common, letter * pixels_per_mm,
                     line * pixels_per_mm);
}

/// Text as a gnuplot string: between single quotes nothing is run and only the quote itself is special. Control
/// characters would end the line. Bytes that are not UTF-8 become U+FFFD, as nlohmann's writer does it.
std::string quoted(const std::string& text) {
  using nlohmann::json;
  const std::string valid = json::parse(json(text).dump(-1, ' ', false, json::error_handler_t::replace));
  std::string result = "'";
  for (char c : valid) {
    if (c == '\'') result += '\'';
    result += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  }
  return result + '\'';
}

/// Between two plots of one command.
constexpr const char* next_plot = ", \\\n     ";

std::ostringstream text_stream() {
  std::ostringstream stream;
  stream.imbue(std::locale::classic());
  stream << std::setprecision(8);
  return stream;
}

std::string colour(Colour colour) { return fmt::format("rgb '#{:06x}'", colour.rgb); }

std::string line_style(const Stroke& stroke) {
  return fmt::format("lc {} lw {}{}", colour(stroke.colour), stroke.width, stroke.dashed ? " dt (4,8)" : " dt 1");
}

using Row = std::pair<double, double>;
using Vector = std::tuple<double, double, double, double>;

/// Rows of numbers as gnuplot reads them after a command that plots '-'.
template <class Rows, class Mode>
void send(std::ostream& data, const Rows& rows, Mode mode) {
  gnuplotio::top_level_array_sender(data, rows, mode, gnuplotio::ModeText());
  data << "e\n";
}

std::vector<Row> rows(const Polyline& line) {
  std::vector<Row> result;
  for (const Point& point : line) result.emplace_back(point.x, point.y);
  return result;
}

/// What of the lines is to be seen.
std::vector<std::vector<Row>> rows(const Panel& panel, const std::vector<Polyline>& lines) {
  std::vector<std::vector<Row>> result;
  for (const Polyline& line : lines) {
    for (const Polyline& part : clipped(panel, line)) result.push_back(rows(thinned(panel, part)));
  }
  return result;
}

std::vector<Vector> heads(const Panel& panel, const Box& box, const std::vector<Arrow>& arrows) {
  std::vector<Vector> result;
  for (const Arrow& arrow : arrows) {
    const std::optional<Arrow> head = short_arrow(panel, box, arrow);
    if (head) result.emplace_back(head->at.x, head->at.y, arrow.at.x - head->at.x, arrow.at.y - head->at.y);
  }
  return result;
}

void write_axis(std::ostream& gp, const char* which, const Axis& axis, bool shown) {
  gp << "set " << which << "label " << quoted(shown ? axis.name : "") << "\n";
  gp << "set " << which << "range [" << axis.low << ":" << axis.high << "]\n";
  gp << (axis.logarithmic ? "set logscale " : "unset logscale ") << which << "\n";
  if (!shown) {
    gp << "unset " << which << "tics\n";
    return;
  }
  gp << "set " << which << "tics autofreq nomirror out scale 0.6\n";
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
std::string write_colours(std::ostream& gp, const Figure& figure, const ColourMap& colours, const Box& box) {
  const auto across = [&](double mm) { return mm / figure.width_mm; };
  const auto up = [&](double mm) { return mm / figure.height_mm; };
  constexpr double gap_mm = 3, bar_mm = 4;
  const double low = colours.scale.low;
  const double high = colours.scale.high > low ? colours.scale.high : low + 1;
  gp << palette;
  write_axis(gp, "cb", {"", low, high, colours.scale.logarithmic, colours.scale.ticks}, true);
  const double left = box.left + box.width + gap_mm;
  gp << "set colorbox vertical user origin screen " << across(left) << "," << up(box.bottom) << " size screen "
     << across(bar_mm) << "," << up(box.height) << " noborder\n";
  gp << "set label " << quoted(colours.scale.name) << " at screen " << across(left + bar_mm / 2) << ","
     << up(box.bottom + box.height + gap_mm) << " center\n";
  gp << "set x2range [0:" << colours.columns << "]\nset y2range [0:" << colours.values.size() / colours.columns
     << "]\n";
  return "matrix using ($1+0.5):($2+0.5):3 axes x2y2 with image";
}

void send_colours(std::ostream& gp, const ColourMap& colours) {
  for (std::size_t i = 0; i < colours.values.size(); ++i) {
    gp << colours.values[i] << ((i + 1) % colours.columns == 0 ? "\n" : " ");
  }
  gp << "e\n";
}

/// A number for each shape, and whether it is first painted out with the ground.
struct PointType {
  int type;
  int ground;  ///< 0: none
};

PointType point_type(Marks::Shape shape) {
  switch (shape) {
    case Marks::Shape::circle:
      return {6, 7};
    case Marks::Shape::square:
      return {4, 5};
    case Marks::Shape::dot:
      break;
  }
  return {7, 0};
}

std::string mark_style(const Marks& marks) {
  return fmt::format("with points pt {} ps {} lw 1.6 lc {}", point_type(marks.shape).type, marks.size,
                     colour(marks.colour));
}

void write_panel(std::ostream& gp, const Figure& figure, const Panel& panel, const Box& box, double name) {
  const auto across = [&](double mm) { return mm / figure.width_mm; };
  const auto up = [&](double mm) { return mm / figure.height_mm; };
  gp << "set lmargin at screen " << across(box.left) << "\nset rmargin at screen " << across(box.left + box.width)
     << "\nset bmargin at screen " << up(box.bottom) << "\nset tmargin at screen " << up(box.bottom + box.height)
     << "\n";
  gp << (!panel.bare ? "set border 3" : "set border 0") << " lw 0.8 lc " << colour(figure.theme.ink) << "\n";
  write_axis(gp, "x", panel.x, !panel.bare);
  write_axis(gp, "y", panel.y, !panel.bare);
  gp << "unset label\n";
  gp << "set label " << quoted(panel.title) << " at screen " << across(box.left + box.width / 2) << "," << up(name)
     << " center tc " << colour(figure.theme.ink) << "\n";
  for (const Label& label : panel.labels) {
    gp << "set label " << quoted("{/*0.85 " + label.text + "}") << " at " << label.at.x << "," << label.at.y << " "
       << alignment(label.align) << " front boxed tc " << colour(label.colour) << "\n";
  }

  // Each layer with data is a plot of '-' and, after the whole command, that data.
  std::string separator = "plot ";
  std::ostringstream data = text_stream();
  const auto entry = [&](const std::string& style) {
    gp << std::exchange(separator, next_plot) << "'-' " << style << " notitle";
  };
  if (panel.colours) {
    entry(write_colours(gp, figure, *panel.colours, box));
    send_colours(data, *panel.colours);
  }
  for (const Region& region : panel.regions) {
    entry(fmt::format("with filledcurves closed lc {}", colour(region.colour)));
    send(data, rows(region.border), gnuplotio::Mode1D());
  }
  for (const Lines& layer : panel.lines) {
    const auto blocks = rows(panel, layer.lines);
    if (blocks.empty()) continue;
    entry("with lines " + line_style(layer.stroke));
    send(data, blocks, gnuplotio::Mode2D());
  }
  for (const Arrows& layer : panel.arrows) {
    const auto vectors = heads(panel, box, layer.arrows);
    if (vectors.empty()) continue;
    entry(fmt::format("with vectors head filled size screen {:.4g},18,75 fixed lc {} lw 0.5",
                      across(head_mm * figure.theme.letters), colour(layer.colour)));
    send(data, vectors, gnuplotio::Mode1D());
  }
  for (const Marks& layer : panel.marks) {
    if (layer.points.empty()) continue;
    if (const int ground = point_type(layer.shape).ground) {
      entry(fmt::format("with points pt {} ps {} lc {}", ground, layer.size, colour(figure.theme.ground)));
      send(data, rows(layer.points), gnuplotio::Mode1D());
    }
    entry(mark_style(layer));
    send(data, rows(layer.points), gnuplotio::Mode1D());
  }
  if (separator != next_plot) gp << separator << "NaN notitle";
  gp << "\n" << data.view();
}

void write_colour_bar(std::ostream& gp, const Figure& figure, const Layout& layout) {
  const ColourBar& bar = *figure.colour_bar;
  const Box& box = layout.colour_bar;
  const auto across = [&](double mm) { return mm / figure.width_mm; };
  const auto up = [&](double mm) { return mm / figure.height_mm; };
  const double step = box.height / static_cast<double>(bar.colours.size());
  constexpr double overlap = 0.1;  // so that there is no seam between them
  for (std::size_t i = 0; i < bar.colours.size(); ++i) {
    const double bottom = box.bottom + step * static_cast<double>(i);
    gp << "set object rectangle from screen " << across(box.left) << "," << up(bottom) << " to screen "
       << across(box.left + box.width) << "," << up(std::min(bottom + step + overlap, box.bottom + box.height))
       << " fc " << colour(bar.colours[i]) << " fs solid noborder\n";
  }
  for (const Axis::Tick& tick : bar.ticks) {
    gp << "set label " << quoted("{/*0.85 " + tick.text + "}") << " at screen "
       << across(box.left + box.width + 0.5 * layout.letter) << "," << up(box.bottom + tick.at * box.height)
       << " left tc " << colour(figure.theme.ink) << "\n";
  }
  gp << "set label " << quoted(bar.name) << " at screen " << across(box.left) << ","
     << up(box.bottom + box.height + 1.3 * layout.letter) << " left tc " << colour(figure.theme.ink) << "\n";
}

/// Title, subtitle, colour bar and legend, in a plot of its own that covers the page and shows nothing else.
void write_heading(std::ostream& gp, const Figure& figure, const Layout& layout) {
  const auto up = [&](double mm) { return mm / figure.height_mm; };
  gp << "set lmargin at screen 0.02\nset rmargin at screen 0.98\nset tmargin at screen 0.98\nset bmargin at screen "
        "0.02\nunset border\nunset tics\n";
  gp << "set key at screen 0.5," << up(layout.legend)
     << " center center horizontal Left reverse samplen 2.2 width 1 tc " << colour(figure.theme.ink) << "\n";
  gp << "set label " << quoted("{/*1.2 " + figure.title + "}") << " at screen 0.5," << up(layout.title) << " center tc "
     << colour(figure.theme.ink) << "\n";
  gp << "set label " << quoted(figure.subtitle) << " at screen 0.5," << up(layout.subtitle) << " center tc "
     << colour(figure.theme.faint) << "\n";
  if (figure.colour_bar) write_colour_bar(gp, figure, layout);
  std::string separator = "plot [0:1] [0:1] ";
  std::vector<std::string> listed;  // panels share entries
  const auto entry = [&](const std::string& legend, const std::string& style) {
    if (legend.empty() || std::ranges::find(listed, legend) != listed.end()) return;
    listed.push_back(legend);
    gp << std::exchange(separator, next_plot) << "NaN " << style << " title " << quoted(legend);
  };
  for (const Panel& panel : figure.panels) {
    for (const Lines& layer : panel.lines) entry(layer.legend, "with lines " + line_style(layer.stroke));
    for (const Marks& layer : panel.marks) entry(layer.legend, mark_style(layer));
  }
  if (listed.empty()) gp << separator << "NaN notitle";
  gp << "\nunset key\nunset object\n";
}

std::string script(const Figure& figure, PictureFormat format) {
  std::ostringstream gp = text_stream();
  gp << "# Drawn by contensou; gnuplot 5. `gnuplot FILE.gp > FILE.svg` draws it again.\n";
  gp << "set encoding utf8\n" << terminal(figure, format) << "\n";
  gp << "set style textbox opaque noborder fillcolor " << colour(figure.theme.ground) << " margins 0.2,0.1\n";
  const std::string ink = colour(figure.theme.ink);
  gp << "set xtics textcolor " << ink << "\nset ytics textcolor " << ink << "\n";
  gp << "set xlabel textcolor " << ink << "\nset ylabel textcolor " << ink << "\n";
  gp << "set multiplot\n";
  const Layout layout = lay_out(figure);
  write_heading(gp, figure, layout);
  for (std::size_t i = 0; i < figure.panels.size(); ++i) {
    write_panel(gp, figure, figure.panels[i], layout.panels[i], layout.names[i]);
  }
  gp << "unset multiplot\n";
  return std::move(gp).str();
}

/// A file in memory, for a program to read or to write.
class MemoryFile {
 public:
  MemoryFile() {
    if (file_ < 0) fail();
  }
  explicit MemoryFile(std::string_view content) : MemoryFile() {
    if (::pwrite(file_, content.data(), content.size(), 0) != std::ssize(content)) fail();
  }
  ~MemoryFile() { ::close(file_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  int get() const { return file_; }

  std::string content() const {
    std::string text(static_cast<std::size_t>(::lseek(file_, 0, SEEK_END)), '\0');
    if (::pread(file_, text.data(), text.size(), 0) != std::ssize(text)) fail();
    return text;
  }

 private:
  [[noreturn]] static void fail() {
    throw GnuplotError(fmt::format("no room in memory for what gnuplot reads and writes: {}", std::strerror(errno)));
  }

  int file_ = ::memfd_create("contensou", MFD_CLOEXEC);
};

/// Runs gnuplot with no settings but the script's: without ~/.gnuplot, in no language. It ends with
/// this program.
/// @return  its status as of waitpid()
int run(const MemoryFile& script, const MemoryFile& picture, const MemoryFile& messages) {
  std::vector<const char*> environment{"LC_ALL=C.UTF-8"};
  for (char** variable = environ; *variable != nullptr; ++variable) {
    if (!std::string_view(*variable).starts_with("LC_ALL=")) environment.push_back(*variable);
  }
  environment.push_back(nullptr);
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child == 0) {  // only what is async-signal-safe: other threads may hold locks
    sigset_t none;
    ::sigemptyset(&none);
    ::sigprocmask(SIG_SETMASK, &none, nullptr);
    std::signal(SIGALRM, SIG_DFL);
    ::alarm(time_limit);
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    char name[] = "gnuplot", without_settings[] = "-d";
    char* const words[]{name, without_settings, nullptr};
    if (::getppid() == parent && ::dup2(script.get(), STDIN_FILENO) >= 0 && ::dup2(picture.get(), STDOUT_FILENO) >= 0 &&
        ::dup2(messages.get(), STDERR_FILENO) >= 0) {
      ::execvpe(name, words, const_cast<char**>(environment.data()));
    }
    ::_exit(not_run);
  }
  int status = child < 0 ? W_EXITCODE(not_run, 0) : 0;  // where nobody is told a status, the picture decides
  while (child > 0 && ::waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  return status;
}

/// What a status means; empty: success.
std::string complaint(int status) {
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM) {
    return fmt::format("drew for more than {} s and was stopped; ask for less, or write .gp and draw it yourself",
                       time_limit);
  }
  if (WIFSIGNALED(status)) return fmt::format("was ended by signal {}", WTERMSIG(status));
  if (WEXITSTATUS(status) == not_run) {
    return "was not found on PATH or cannot be run; install it (Debian: gnuplot-nox), or write .gp, .tex, .csv or "
           ".json, which need none";
  }
  return status == 0 ? "" : fmt::format("ended with status {}", WEXITSTATUS(status));
}

std::string first_lines(const std::string& text, int count) {
  std::istringstream stream(text);
  std::string result;
  for (std::string line; count > 0 && std::getline(stream, line);) {
    const std::size_t begin = line.find_first_not_of(" \t^");
    if (begin == std::string::npos) continue;
    result += "\n  " + line.substr(begin);
    --count;
  }
  return result;
}

std::ptrdiff_t count(std::string_view text, std::string_view part) {
  std::ptrdiff_t found = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string_view::npos; at += part.size()) ++found;
  return found;
}

void replace_all(std::string& text, std::string_view old, std::string_view with) {
  for (std::size_t at = 0; (at = text.find(old, at)) != std::string::npos; at += with.size()) {
    text.replace(at, old.size(), with);
  }
}

/// The size of the page in millimetres; and italics cut a text into pieces, at whose ends some SVG viewers drop spaces
/// unless told to keep them.
std::string finished_svg(std::string svg, const Figure& figure) {
  replace_all(svg, "<text>", "<text xml:space=\"preserve\">");
  // What XML has no place for and gnuplot leaves in texts: an end of CDATA, U+FFFE and U+FFFF.
  replace_all(svg, "]]>", "]]&gt;");
  replace_all(svg, "\xEF\xBF\xBE", "\xEF\xBF\xBD");
  replace_all(svg, "\xEF\xBF\xBF", "\xEF\xBF\xBD");
  const std::string_view view_box = "viewBox=";
  if (const std::size_t at = svg.find(view_box); at != std::string::npos) {
    svg.insert(at, fmt::format("width=\"{:g}mm\" height=\"{:g}mm\" ", figure.width_mm, figure.height_mm));
  }
  return svg;
}

/// Cairo writes the time of day into a picture; the same figure is the same bytes. No offset in the file changes.
std::string without_date(std::string bytes, std::string_view before, std::string_view date) {
  const std::size_t at = bytes.find(before);
  if (at != std::string::npos && at + before.size() + date.size() <= bytes.size()) {
    bytes.replace(at + before.size(), date.size(), date);
  }
  return bytes;
}

std::string finished(std::string picture, const Figure& figure, PictureFormat format) {
  if (format == PictureFormat::svg) return finished_svg(std::move(picture), figure);
  if (format == PictureFormat::pdf) return without_date(std::move(picture), "/CreationDate (D:", "19700101000000");
  if (format == PictureFormat::eps) {
    return without_date(std::move(picture), "%%CreationDate: ", "Thu Jan  1 00:00:00 1970");
  }
  return picture;
}

}  // namespace

std::vector<std::string_view> picture_formats() {
  std::vector<std::string_view> endings;
  for (const Format& format : formats) endings.push_back(format.ending);
  return endings;
}

std::optional<PictureFormat> find_picture_format(std::string_view ending) {
  const auto found = std::ranges::find(formats, ending, &Format::ending);
  if (found == formats.end()) return std::nullopt;
  return found->format;
}

std::string gnuplot_script(const Figure& figure) { return script(figure, PictureFormat::gp); }

std::string render(const Figure& figure, PictureFormat format) {
  if (format == PictureFormat::gp) return gnuplot_script(figure);
  if (format == PictureFormat::tex) return pgfplots(figure);

  const std::string commands = script(figure, format);
  const MemoryFile input(commands), output, errors;
  std::string wrong = complaint(run(input, output, errors));
  const std::string messages = first_lines(errors.content(), 4);
  std::string picture = output.content();
  const auto& [ending, same, begin, end] = *std::ranges::find(formats, format, &Format::format);
  const std::string_view drawn = std::string_view(picture).substr(0, picture.find_last_not_of('\n') + 1);
  const bool whole = drawn.starts_with(begin) && drawn.ends_with(end);
  const bool has_plots = format != PictureFormat::svg || count(picture, "<g id=\"gnuplot_plot_") ==
                                                             count(commands, "\nplot ") + count(commands, next_plot);
  if (wrong.empty() && !(whole && has_plots)) wrong = fmt::format("drew nothing that is a whole {}", ending);
  if (!wrong.empty()) throw GnuplotError(fmt::format("gnuplot {}{}", wrong, messages));
  if (!messages.empty()) std::cerr << fmt::format("contensou: gnuplot drew the picture and said{}\n", messages);
  return finished(std::move(picture), figure, format);
}

}  // namespace contensou::portraits
