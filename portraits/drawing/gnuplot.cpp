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
#include <iterator>
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
#include <fmt/ranges.h>
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

std::string colour(Colour colour) { return fmt::format("rgb '#{:06x}'", colour.rgb); }

std::string line_style(const Stroke& stroke) {
  return fmt::format("lc {} lw {}{}", colour(stroke.colour), stroke.width, stroke.dashed ? " dt (4,8)" : " dt 1");
}

/// gnuplot's numbers of a shape, and of the shape that is first painted out with the ground; 0: none.
struct PointType {
  int outline, ground;
};

PointType point_type(Marks::Shape shape) {
  if (shape == Marks::Shape::circle) return {6, 7};
  return shape == Marks::Shape::square ? PointType{4, 5} : PointType{7, 0};
}

std::string mark_style(const Marks& marks) {
  return fmt::format("with points pt {} ps {} lw 1.6 lc {}", point_type(marks.shape).outline, marks.size,
                     colour(marks.colour));
}

const char* alignment(Label::Align align) {
  if (align == Label::Align::left) return "left";
  return align == Label::Align::right ? "right" : "center";
}

/// From light to dark and from yellow to blue: in order also in grey, and for eyes that see red and green alike.
constexpr const char* palette_script =
    "set palette defined (0 '#fffbe0', 0.18 '#f3e6a1', 0.36 '#b9d8a6', 0.54 '#76bcb4', 0.72 '#4495b8', 0.87 '#3468a4', "
    "1 '#2f4788')\n";

using Row = std::pair<double, double>;

std::vector<Row> rows(const Polyline& line) {
  std::vector<Row> result;
  for (const Point& point : line) result.emplace_back(point.x, point.y);
  return result;
}

/// Numbers as the plots '-' of a command read them after it.
class Data {
 public:
  Data() {
    text_.imbue(std::locale::classic());
    text_ << std::setprecision(8);
  }

  template <class Rows>
  void add(const Rows& rows) {
    gnuplotio::top_level_array_sender(text_, rows, gnuplotio::Mode1D(), gnuplotio::ModeText());
    text_ << "e\n";
  }
  /// Blocks of rows, with an empty line between them.
  template <class Blocks>
  void add_blocks(const Blocks& blocks) {
    gnuplotio::top_level_array_sender(text_, blocks, gnuplotio::Mode2D(), gnuplotio::ModeText());
    text_ << "e\n";
  }
  void add(const ColourMap& colours) {
    for (std::size_t i = 0; i < colours.values.size(); ++i) {
      text_ << colours.values[i] << ((i + 1) % colours.columns == 0 ? "\n" : " ");
    }
    text_ << "e\n";
  }
  std::string_view text() const { return text_.view(); }

 private:
  std::ostringstream text_;
};

/// Writes the script of a figure.
class Script {
 public:
  Script(const Figure& figure, PictureFormat format) : figure_(figure), layout_(lay_out(figure)) {
    put("# Drawn by contensou; gnuplot 5. `gnuplot FILE.gp > FILE.svg` draws it again.\n");
    put("set encoding utf8\n{}\n", terminal(figure, format));
    put("set style textbox opaque noborder fillcolor {} margins 0.2,0.1\n", colour(figure.theme.ground));
    put("set xtics textcolor {0}\nset ytics textcolor {0}\nset xlabel textcolor {0}\nset ylabel textcolor {0}\n", ink_);
    put("set multiplot\n");
    heading();
    for (std::size_t i = 0; i < figure.panels.size(); ++i) panel(figure.panels[i], layout_.panels[i], layout_.names[i]);
    put("unset multiplot\n");
  }

  std::string text() && { return std::move(text_); }

 private:
  template <class... Values>
  void put(fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Values>(values)...);
  }

  /// A place on the page, from millimetres.
  std::string at(double x, double y) const {
    return fmt::format("screen {:.8g},{:.8g}", x / figure_.width_mm, y / figure_.height_mm);
  }

  void label(const std::string& text, const std::string& at, const char* align, const std::string& style) {
    put("set label {} at {} {}{}\n", quoted(text), at, align, style);
  }

  void axis(const char* which, const Axis& axis, bool shown) {
    put("set {0}label {1}\nset {0}range [{2:.8g}:{3:.8g}]\n{4} logscale {0}\n", which, quoted(shown ? axis.name : ""),
        axis.low, axis.high, axis.logarithmic ? "set" : "unset");
    if (!shown) {
      put("unset {}tics\n", which);
      return;
    }
    put("set {0}tics autofreq nomirror out scale 0.6\nset format {0} '{1}'\n", which,
        axis.logarithmic ? "10^{%T}" : "%g");
    if (axis.ticks.empty()) return;
    std::vector<std::string> ticks;
    for (const auto& [at, text] : axis.ticks) ticks.push_back(fmt::format("{} {:.8g}", quoted(text), at));
    put("set {}tics ({})\n", which, fmt::join(ticks, ", "));
  }

  /// The next plot of a command, of data that follow it.
  void plot(const std::string& style) { put("{}'-' {} notitle", std::exchange(separator_, next_plot), style); }

  /// A colour map, on linear axes of its own, and its scale.
  void colour_map(const ColourMap& colours, const Box& box) {
    constexpr double gap_mm = 3, bar_mm = 4;
    const auto& [name, low, high, logarithmic, ticks] = colours.scale;
    const double left = box.left + box.width + gap_mm;
    put("{}", palette_script);
    axis("cb", {"", low, high > low ? high : low + 1, logarithmic, ticks}, true);
    put("set colorbox vertical user origin {} size {} noborder\n", at(left, box.bottom), at(bar_mm, box.height));
    label(name, at(left + bar_mm / 2, box.bottom + box.height + gap_mm), "center", "");
    put("set x2range [0:{}]\nset y2range [0:{}]\n", colours.columns, colours.values.size() / colours.columns);
    plot("matrix using ($1+0.5):($2+0.5):3 axes x2y2 with image");
  }

  void panel(const Panel& panel, const Box& box, double name) {
    put("set lmargin at screen {:.8g}\nset rmargin at screen {:.8g}\n", box.left / figure_.width_mm,
        (box.left + box.width) / figure_.width_mm);
    put("set bmargin at screen {:.8g}\nset tmargin at screen {:.8g}\n", box.bottom / figure_.height_mm,
        (box.bottom + box.height) / figure_.height_mm);
    put("set border {} lw 0.8 lc {}\n", panel.bare ? 0 : 3, ink_);
    axis("x", panel.x, !panel.bare);
    axis("y", panel.y, !panel.bare);
    put("unset label\n");
    label(panel.title, at(box.left + box.width / 2, name), "center", " tc " + ink_);
    for (const auto& [point, text, label_colour, align] : panel.labels) {
      label("{/*0.85 " + text + "}", fmt::format("{:.8g},{:.8g}", point.x, point.y), alignment(align),
            " front boxed tc " + colour(label_colour));
    }

    separator_ = "plot ";
    Data data;
    if (panel.colours) {
      colour_map(*panel.colours, box);
      data.add(*panel.colours);
    }
    for (const Region& region : panel.regions) {
      plot("with filledcurves closed lc " + colour(region.colour));
      data.add(rows(region.border));
    }
    for (const Lines& layer : panel.lines) {
      std::vector<std::vector<Row>> blocks;
      for (const Polyline& line : visible(panel, layer.lines)) blocks.push_back(rows(line));
      if (blocks.empty()) continue;
      plot("with lines " + line_style(layer.stroke));
      data.add_blocks(blocks);
    }
    for (const Arrows& layer : panel.arrows) {
      std::vector<std::tuple<double, double, double, double>> vectors;
      for (const Arrow& arrow : layer.arrows) {
        const std::optional<Arrow> head = short_arrow(panel, box, arrow);
        if (head) vectors.emplace_back(head->at.x, head->at.y, arrow.at.x - head->at.x, arrow.at.y - head->at.y);
      }
      if (vectors.empty()) continue;
      plot(fmt::format("with vectors head filled size screen {:.4g},18,75 fixed lc {} lw 0.5",
                       head_mm * figure_.theme.letters / figure_.width_mm, colour(layer.colour)));
      data.add(vectors);
    }
    for (const Marks& layer : panel.marks) {
      if (layer.points.empty()) continue;
      if (const int ground = point_type(layer.shape).ground) {
        plot(fmt::format("with points pt {} ps {} lc {}", ground, layer.size, colour(figure_.theme.ground)));
        data.add(rows(layer.points));
      }
      plot(mark_style(layer));
      data.add(rows(layer.points));
    }
    if (separator_ != next_plot) put("{}NaN notitle", separator_);
    put("\n{}", data.text());
  }

  void colour_bar(const ColourBar& bar, const Box& box) {
    for (std::size_t i = 0; i < bar.colours.size(); ++i) {
      const auto& [left, bottom, width, height] = layout_.colours[i];
      put("set object rectangle from {} to {} fc {} fs solid noborder\n", at(left, bottom),
          at(left + width, bottom + height), colour(bar.colours[i]));
    }
    for (const auto& [share, text] : bar.ticks) {
      label("{/*0.85 " + text + "}", at(box.left + box.width + 0.5 * layout_.letter, box.bottom + share * box.height),
            "left", " tc " + ink_);
    }
    label(bar.name, at(box.left, box.bottom + box.height + 1.3 * layout_.letter), "left", " tc " + ink_);
  }

  /// Title, subtitle, colour bar and legend, in a plot of its own that covers the page and shows nothing else.
  void heading() {
    put("set lmargin at screen 0.02\nset rmargin at screen 0.98\nset tmargin at screen 0.98\nset bmargin at screen "
        "0.02\nunset border\nunset tics\n");
    const double middle = figure_.width_mm / 2;
    put("set key at {} center center horizontal Left reverse samplen 2.2 width 1 tc {}\n", at(middle, layout_.legend),
        ink_);
    label("{/*1.2 " + figure_.title + "}", at(middle, layout_.title), "center", " tc " + ink_);
    label(figure_.subtitle, at(middle, layout_.subtitle), "center", " tc " + colour(figure_.theme.faint));
    if (figure_.colour_bar) colour_bar(*figure_.colour_bar, layout_.colour_bar);
    separator_ = "plot [0:1] [0:1] ";
    for (const auto& [text, lines, marks] : legend_entries(figure_)) {
      put("{}NaN {} title {}", std::exchange(separator_, next_plot),
          lines ? "with lines " + line_style(lines->stroke) : mark_style(*marks), quoted(text));
    }
    if (separator_ != next_plot) put("{}NaN notitle", separator_);
    put("\nunset key\nunset object\n");
  }

  const Figure& figure_;
  Layout layout_;
  std::string ink_ = colour(figure_.theme.ink);
  std::string separator_;  ///< before the next plot of the command
  std::string text_;
};

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

std::string gnuplot_script(const Figure& figure) { return Script(figure, PictureFormat::gp).text(); }

std::string render(const Figure& figure, PictureFormat format) {
  if (format == PictureFormat::gp) return gnuplot_script(figure);
  if (format == PictureFormat::tex) return pgfplots(figure);

  const std::string commands = Script(figure, format).text();
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
