// All use of gnuplot. gnuplot-iostream writes the data of the script. It is not used to start gnuplot, because it does
// not report that gnuplot is missing, fails or hangs.
#include "contensou/portraits/render.hpp"

#include <algorithm>
#include <array>
#include <iomanip>
#include <iostream>
#include <iterator>
#include <locale>
#include <sstream>
#include <system_error>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gnuplot-iostream.h>
#include <nlohmann/json.hpp>

#include "contensou/portraits/layout.hpp"
#include "drawing/characters.hpp"
#include "process/run_program.hpp"

namespace contensou::portraits {

namespace {

/// The beginning and the end of a whole file of a format.
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
    Format{"gif", PictureFormat::gif, "GIF89a", ";"},
    Format{"gp", PictureFormat::gp, "", ""},
    Format{"tex", PictureFormat::tex, "", ""},
};

/// Seconds that gnuplot may take. A film takes 10 s, and on a busy machine ten times as long.
constexpr unsigned time_limit = 300;

/// A terminal of gnuplot, and lengths in the unit of the terminal: points for PDF and EPS, else pixels.
struct Terminal {
  std::string_view name, font;
  double units_per_mm;
  double letter, line, symbol;  ///< lengths of sizes 1 of letters, lines, marks; symbol 0: proportional to the letters
  double dash;                  ///< length of a dash of size 1; 0: proportional to the width of the line
};

/// Returns the terminal of a format. Cairo's terminals take letter sizes for 96 dpi. Without a fontscale, PDF and EPS
/// halve letters. PDF halves line widths, and EPS halves them twice.
Terminal terminal_of(PictureFormat format, double dpi) {
  constexpr double points = 72 / 25.4;
  switch (format) {
    case PictureFormat::pdf:
      return {"pdfcairo fontscale 1", "sans", points, 4.0 / 3, 0.5, 6, 0.275};
    case PictureFormat::eps:
      return {"epscairo fontscale 1", "sans", points, 4.0 / 3, 0.25, 6, 0.275};
    case PictureFormat::png:
      return {"pngcairo", "sans", dpi / 25.4, 4.0 / 3, 1, 6.5, 0.55};
    case PictureFormat::gif:
      return {"gif animate delay 8 loop 0 optimize", "sans", 4, 4.0 / 3, 1, 6.4, 0};
    default:
      return {"svg dynamic", "sans-serif", 5, 1, 1, 0, 0};
  }
}

/// gnuplot's command for the format, and the size of a mark whose point size is 1.
struct Canvas {
  std::string command;
  double point_mm;
};

/// Returns the canvas of a figure.
/// @param letter  size of letters, mm
Canvas canvas(const Figure& figure, double letter, PictureFormat format) {
  const Terminal terminal = terminal_of(format, figure.dpi);
  const auto [width, height] = figure.size;
  const double per_mm = terminal.units_per_mm, line = line_width * letter * figure.theme.line * per_mm;
  const bool vector = format == PictureFormat::pdf || format == PictureFormat::eps;
  const std::string size = vector ? fmt::format("{}cm,{}cm", width / 10, height / 10)
                                  : fmt::format("{:.0f},{:.0f}", width * per_mm, height * per_mm);
  // In widths of a line, as in SVG, whose dashes are longer for wider lines. Dashes of few pixels would look grey.
  constexpr double dash = 0.6, pixels = 0.7;
  const double dash_unit = format == PictureFormat::png ? std::max(dash * line, pixels) : dash * line;
  return {
      fmt::format("set terminal {} size {} enhanced rounded background '#{:06x}' font '{},{:.4g}' linewidth {:.4g}{}",
                  terminal.name, size, figure.theme.ground.rgb, figure.font.empty() ? terminal.font : figure.font,
                  letter * per_mm / terminal.letter, line / terminal.line,
                  terminal.dash > 0 ? fmt::format(" dashlength {:.4g}", dash_unit / terminal.dash) : ""),
      terminal.symbol > 0 ? terminal.symbol / per_mm : 0.75 * letter};
}

void replace_all(std::string& text, std::string_view old, std::string_view with) {
  for (std::size_t at = 0; (at = text.find(old, at)) != std::string::npos; at += with.size()) {
    text.replace(at, old.size(), with);
  }
}

/// Returns a text in gnuplot's enhanced markup on one line. Its special characters follow a backslash.
std::string enhanced(const Text& text, double size) {
  constexpr std::string_view signs = "\\^_{}@&~";
  std::string result = fmt::format("{{/*{:.3g} ", size);
  bool italic = false;
  const auto turn = [&](bool to_italic) {
    if (italic != to_italic) result += to_italic ? "{/:Italic " : "}";
    italic = to_italic;
  };
  for (const Run& run : text.runs()) {
    turn(run.italic);
    if (run.level != 0) result += run.level > 0 ? "^{" : "_{";
    std::string words = with_minus_signs(run.words);
    replace_all(words, no_break_space, " ");
    for (char c : words) {
      if (signs.find(c) != std::string_view::npos) result += '\\';
      result += c;
    }
    if (run.level != 0) result += '}';
  }
  turn(false);
  return result + '}';
}

/// Returns a gnuplot string in single quotes. In such a string nothing is executed and only the quote is special.
/// Control characters, which would end the line, become spaces. Bytes that are not UTF-8 become U+FFFD.
std::string quoted(const std::string& text) {
  using nlohmann::json;
  const std::string valid = json::parse(json(text).dump(-1, ' ', false, json::error_handler_t::replace));
  std::string result = "'";
  char last = 0;
  for (char c : valid) {
    // Two quotes stand for one. Gnuplot 5.4 does not read two such pairs in a row.
    if (c == '\'' && last == c) {
      result += "' . \"'\" . '";
    } else if (c == '\'') {
      result += "''";
    } else {
      result += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
    }
    last = c;
  }
  return result + '\'';
}

/// Separator of two plots of one command.
constexpr const char* next_plot = ", \\\n     ";

std::string colour(Colour colour) { return fmt::format("rgb '#{:06x}'", colour.rgb); }

std::string line_style(const Stroke& stroke) {
  return fmt::format("lc {} lw {}{}", colour(stroke.colour), stroke.width,
                     stroke.dashed && stroke.dotted ? " dt (12,5,2,5)"
                     : stroke.dashed                ? " dt (6,7)"
                     : stroke.dotted                ? " dt (1,5)"
                                                    : " dt 1");
}

/// gnuplot's numbers of a shape and of its filled form; 0: none. The filled form is drawn first, as background.
struct PointType {
  int outline, ground;
};

PointType point_type(Marks::Shape shape) {
  constexpr PointType types[]{{7, 0}, {6, 7}, {4, 5}, {12, 13}};
  return types[static_cast<std::size_t>(shape)];
}

const char* alignment(Label::Align align) {
  if (align == Label::Align::left) return "left";
  return align == Label::Align::right ? "right" : "center";
}

using Row = std::pair<double, double>;

std::vector<Row> rows(const Polyline& line) {
  std::vector<Row> result;
  for (const Point& point : line) result.emplace_back(point.x, point.y);
  return result;
}

/// The inline data that the plots '-' of one command read.
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
  /// Appends blocks of rows, with an empty line between them.
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
  std::string text() const { return text_.str(); }

 private:
  std::ostringstream text_;
};

/// Writes the script of a figure.
class Script {
 public:
  Script(const Figure& figure, PictureFormat format)
      : figure_(figure), layout_(lay_out(figure)), canvas_(canvas(figure, layout_.letter, format)) {
    put("set style textbox opaque noborder fillcolor {} margins 0.2,0.1\n", colour(figure.theme.ground));
    put("set xtics textcolor {0}\nset ytics textcolor {0}\nset cbtics textcolor {0}\nset multiplot\n", ink_);
    page();
    for (std::size_t i = 0; i < figure.panels.size(); ++i) panel(figure.panels[i], layout_.panels[i]);
    put("unset multiplot\n");
  }

  /// Returns the first lines of the script. `set encoding` warns in a locale without a degree sign.
  std::string heading() const {
    return fmt::format(
        "# Drawn by contensou; gnuplot 5. `LC_ALL=C.UTF-8 gnuplot FILE.gp > FILE.svg` draws it again.\n"
        "set encoding utf8\n{}\n",
        canvas_.command);
  }
  const std::string& text() const { return text_; }

 private:
  template <class... Values>
  void put(fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Values>(values)...);
  }

  /// Returns a place on the page, given in millimetres.
  std::string at(double x, double y) const {
    return fmt::format("screen {:.8g},{:.8g}", x / figure_.size.width_mm, y / figure_.size.height_mm);
  }

  void axis(const char* which, const Axis& axis, const std::vector<Axis::Tick>& ticks) {
    // Reset the range first, because the range of the previous panel may be impossible on this scale.
    put("set {0}range [*:*]\n{3} logscale {0}\nset {0}range [{1:.8g}:{2:.8g}]\n", which, axis.low, axis.high,
        axis.logarithmic ? "set" : "unset");
    std::vector<std::string> places;
    for (const auto& [at, text] : ticks)
      places.push_back(fmt::format("{} {:.8g}", text.empty() ? "''" : quoted(enhanced(text, tick_size)), at));
    if (ticks.empty())
      put("unset {}tics\n", which);
    else
      put("set {0}tics nomirror out scale 0.6 ({1})\n", which, fmt::join(places, ", "));
  }

  /// Adds a plot to the current command. The data of its plots follow the command.
  void plot(const std::string& style) { put("{}'-' {} notitle", std::exchange(separator_, next_plot), style); }

  /// Adds a colour map, on its own linear axes, and its scale.
  void colour_map(const ColourMap& colours, const PanelPlace& place) {
    const auto& [left, bottom, width, height] = place.colour_scale;
    std::vector<std::string> steps;
    for (std::size_t i = 0; i < colours.palette.size(); ++i) {
      steps.push_back(fmt::format("{} '#{:06x}'", i, colours.palette[i].rgb));
    }
    put("set palette defined ({})\n", fmt::join(steps, ", "));
    Axis scale = colours.scale;
    if (!(scale.high > scale.low)) scale.high = scale.low + 1;
    axis("cb", scale, place.scale);
    put("set colorbox vertical user origin {} size {} noborder\n", at(left, bottom), at(width, height));
    put("set x2range [0:{}]\nset y2range [0:{}]\n", colours.columns, colours.values.size() / colours.columns);
    plot("matrix using ($1+0.5):($2+0.5):3 axes x2y2 with image");
  }

  void panel(const Panel& panel, const PanelPlace& place) {
    const Box& box = place.box;
    put("set lmargin at screen {:.8g}\nset rmargin at screen {:.8g}\n", box.left / figure_.size.width_mm,
        (box.left + box.width) / figure_.size.width_mm);
    put("set bmargin at screen {:.8g}\nset tmargin at screen {:.8g}\n", box.bottom / figure_.size.height_mm,
        (box.bottom + box.height) / figure_.size.height_mm);
    put("set border {} lw 0.8 lc {}\n", panel.bare ? 0 : 3, ink_);
    // gnuplot's terminals place the numbers of the x axis at different distances, SVG so far that they touch the name.
    std::vector<Axis::Tick> unnumbered = place.x;
    for (Axis::Tick& tick : unnumbered) tick.text = "";
    axis("x", panel.x, unnumbered);
    axis("y", panel.y, place.y);
    put("unset label\n");
    for (const auto& [at, text] : place.x) {
      put("set label {} at {:.8g}, screen {:.8g} center tc {}\n", quoted(enhanced(text, tick_size)), at,
          (box.bottom - tick_drop * layout_.letter) / figure_.size.height_mm, ink_);
    }
    for (const auto& [point, text, label_colour, align] : panel.labels) {
      put("set label {} at {:.8g},{:.8g} {} front boxed tc {}\n", quoted(enhanced(text, label_size)), point.x, point.y,
          alignment(align), colour(label_colour));
    }

    separator_ = "plot ";
    Data data;
    if (panel.colours) {
      colour_map(*panel.colours, place);
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
                       layer.size * head_length * layout_.letter / figure_.size.width_mm, colour(layer.colour)));
      data.add(vectors);
    }
    for (const Marks& layer : panel.marks) {
      if (!layer.points.empty()) marks(layer, rows(layer.points), data);
    }
    if (separator_ != next_plot) put("{}NaN notitle", separator_);
    put("\n{}", data.text());
  }

  void marks(const Marks& layer, const std::vector<Row>& places, Data& data) {
    const double size = layer.size * mark_size * layout_.letter / canvas_.point_mm;
    if (const int ground = point_type(layer.shape).ground) {
      plot(fmt::format("with points pt {} ps {:.4g} lc {}", ground, size, colour(figure_.theme.ground)));
      data.add(places);
    }
    plot(fmt::format("with points pt {} ps {:.4g} lw 1.6 lc {}", point_type(layer.shape).outline, size,
                     colour(layer.colour)));
    data.add(places);
  }

  /// Draws texts, the colour bar and the samples of the legend as one more plot, which covers the page, in millimetres.
  void page() {
    put("set lmargin at screen 0\nset rmargin at screen 1\nset tmargin at screen 1\nset bmargin at screen 0\n"
        "unset border\nunset tics\nunset key\nset xrange [0:{}]\nset yrange [0:{}]\n",
        figure_.size.width_mm, figure_.size.height_mm);
    for (const PlacedText& text : layout_.texts) {
      put("set label {} at {} {}{} tc {}\n", quoted(enhanced(text.text, text.size)), at(text.at.x, text.at.y),
          alignment(text.align), text.turned ? " rotate by 90" : "", text.faint ? colour(figure_.theme.faint) : ink_);
    }
    for (std::size_t i = 0; i < layout_.colours.size(); ++i) {
      const auto& [left, bottom, width, height] = layout_.colours[i];
      put("set object rectangle from {} to {} fc {} fs solid noborder\n", at(left, bottom),
          at(left + width, bottom + height), colour(figure_.colour_bar->colours[i]));
    }
    separator_ = "plot ";
    Data data;
    for (const auto& [entry, from, width] : layout_.legend) {
      if (entry.lines) {
        plot("with lines " + line_style(entry.lines->stroke));
        data.add(std::vector<Row>{{from.x, from.y}, {from.x + width, from.y}});
      }
      if (entry.marks) marks(*entry.marks, {{from.x + width / 2, from.y}}, data);
    }
    if (separator_ != next_plot) put("{}NaN notitle", separator_);
    put("\n{}unset object\n", data.text());
  }

  const Figure& figure_;
  Layout layout_;
  Canvas canvas_;
  std::string ink_ = colour(figure_.theme.ink);
  std::string separator_;  ///< text before the next plot of the command
  std::string text_;
};

/// Returns the reason of a failure; empty if the program succeeded.
std::string complaint(const ProgramRun& run) {
  switch (run.end) {
    case ProgramRun::End::out_of_time:
      return fmt::format("drew for more than {} s and was stopped; ask for less, or write .gp and draw it yourself",
                         time_limit);
    case ProgramRun::End::ended_by_signal:
      return fmt::format("was ended by signal {}", run.number);
    case ProgramRun::End::not_run:
      return "was not found on PATH or cannot be run; install it (Debian: gnuplot-nox), or write .gp, .tex, .csv or "
             ".json, which need none";
    case ProgramRun::End::exited:
      break;
  }
  return run.succeeded() ? "" : fmt::format("ended with status {}", run.number);
}

std::string first_lines(const std::string& text, int count) {
  std::istringstream stream(text);
  std::string result;
  for (std::string line; count > 0 && std::getline(stream, line);) {
    const std::size_t begin = line.find_first_not_of(" \t^");
    if (begin == std::string::npos || line.ends_with("frames in animation sequence")) continue;
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

/// Adds the size of the page in millimetres, and the attribute that keeps spaces. Italics divide a text into elements,
/// and some SVG viewers drop spaces at the ends of elements.
std::string finished_svg(std::string svg, const Figure& figure) {
  replace_all(svg, "<text></text>", "");  // the numbers of x axes are labels
  replace_all(svg, "<text>", "<text xml:space=\"preserve\">");
  // XML does not allow the end of CDATA, U+FFFE and U+FFFF, but gnuplot leaves them in texts.
  replace_all(svg, "]]>", "]]&gt;");
  replace_all(svg, "\xEF\xBF\xBE", "\xEF\xBF\xBD");
  replace_all(svg, "\xEF\xBF\xBF", "\xEF\xBF\xBD");
  const std::string_view view_box = "viewBox=";
  if (const std::size_t at = svg.find(view_box); at != std::string::npos) {
    svg.insert(at, fmt::format("width=\"{:g}mm\" height=\"{:g}mm\" ", figure.size.width_mm, figure.size.height_mm));
  }
  return svg;
}

/// Replaces the date that Cairo writes, so that the same figure gives the same bytes. Byte offsets do not change.
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
  for (const Format& format : formats) {
    if (format.format != PictureFormat::gif) endings.push_back(format.ending);
  }
  return endings;
}

std::optional<PictureFormat> find_picture_format(std::string_view ending) {
  const auto found = std::ranges::find(formats, ending, &Format::ending);
  if (found == formats.end()) return std::nullopt;
  return found->format;
}

namespace {

std::string script_of(const Figure& figure, PictureFormat format) {
  const Script script(figure, format);
  return script.heading() + script.text();
}

/// Returns the picture that gnuplot draws from a script.
std::string drawn(const std::string& commands, PictureFormat format) {
  ProgramRun run;
  try {
    // -d: gnuplot ignores ~/.gnuplot. It reads standard input in single bytes, unless that is named as a file.
    run = run_program({"gnuplot", "-d", standard_input}, commands, time_limit);
  } catch (const std::system_error& error) {
    throw GnuplotError(fmt::format("what gnuplot reads and writes does not fit: {}", error.code().message()));
  }
  std::string wrong = complaint(run), picture = std::move(run.output);
  const std::string messages = first_lines(run.messages, 4);
  const auto& [ending, same, begin, end] = *std::ranges::find(formats, format, &Format::format);
  const std::string_view drawn = std::string_view(picture).substr(0, picture.find_last_not_of('\n') + 1);
  const bool whole = drawn.starts_with(begin) && drawn.ends_with(end);
  const bool has_plots = format != PictureFormat::svg || count(picture, "<g id=\"gnuplot_plot_") ==
                                                             count(commands, "\nplot ") + count(commands, next_plot);
  if (wrong.empty() && !(whole && has_plots)) wrong = fmt::format("drew nothing that is a whole {}", ending);
  if (!wrong.empty()) throw GnuplotError(fmt::format("gnuplot {}{}", wrong, messages));
  if (!messages.empty()) std::cerr << fmt::format("contensou: gnuplot drew the picture and said{}\n", messages);
  return picture;
}

}  // namespace

std::string gnuplot_script(const Figure& figure) { return script_of(figure, PictureFormat::gp); }

std::string substitute_of(const std::string& font) {
  const auto lower = [](std::string text) {
    std::ranges::transform(text, text.begin(),
                           [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
    return text;
  };
  constexpr std::array any{"sans", "sans-serif", "serif", "mono", "monospace"};
  std::string substitute, name = lower(font);
  if (std::ranges::find(any, name) != any.end()) return "";
  // The last words of a name may be a style, such as bold or italic.
  for (;; name.resize(name.find_last_of(' '))) {
    const ProgramRun run = run_program({"fc-match", "--format=%{family}", name.c_str()}, "", time_limit);
    if (!run.succeeded()) return "";
    const std::string& families = run.output;
    if (("," + lower(families) + ",").find("," + name + ",") != std::string::npos) return "";
    if (substitute.empty()) substitute = families.substr(0, families.find(','));
    if (name.find(' ') == std::string::npos) return substitute;
  }
}

std::string render(const Figure& figure, PictureFormat format) {
  if (format == PictureFormat::gp) return gnuplot_script(figure);
  if (format == PictureFormat::tex) return pgfplots(figure);
  return finished(drawn(script_of(figure, format), format), figure, format);
}

std::string render_film(const std::vector<Figure>& frames) {
  std::string commands;
  for (const Figure& frame : frames) {
    const Script script(frame, PictureFormat::gif);
    commands += (commands.empty() ? script.heading() : "reset\n") + script.text();
  }
  return drawn(commands, PictureFormat::gif);
}

}  // namespace contensou::portraits
