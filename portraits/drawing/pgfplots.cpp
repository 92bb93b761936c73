#include "contensou/portraits/render.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "contensou/portraits/layout.hpp"
#include "drawing/characters.hpp"

namespace contensou::portraits {

namespace {

constexpr double points_per_mm = 72.27 / 25.4;

/// Characters that are not Latin letters, each followed by its TeX.
constexpr std::string_view signs =
    " α\\alpha β\\beta γ\\gamma δ\\delta ε\\varepsilon ζ\\zeta η\\eta θ\\theta ι\\iota κ\\kappa"
    " λ\\lambda μ\\mu ν\\nu ξ\\xi π\\pi ρ\\rho σ\\sigma ς\\varsigma τ\\tau υ\\upsilon φ\\varphi"
    " χ\\chi ψ\\psi ω\\omega Γ\\Gamma Δ\\Delta Θ\\Theta Λ\\Lambda Ξ\\Xi Π\\Pi Σ\\Sigma Φ\\Phi Ψ\\Psi"
    " Ω\\Omega ·\\cdot{} ×\\times ∝\\propto ∞\\infty ≤\\le ≥\\ge →\\to −- ±\\pm °{}^\\circ …\\ldots"
    " ′' || << >> ";

/// Returns a character as TeX, inside mathematics or outside.
std::string tex_character(std::string_view one, bool mathematics) {
  const auto first = static_cast<unsigned char>(one.front());
  if (one == no_break_space) return "~";
  if (const std::size_t sign = signs.find(fmt::format(" {}", one)); first > ' ' && sign != std::string::npos) {
    const std::size_t tex = sign + 1 + one.size();
    const std::string_view math = signs.substr(tex, signs.find(' ', tex) - tex);
    return mathematics ? fmt::format("{}{}", math, math[0] == '\\' ? " " : "")
                       : fmt::format("\\ensuremath{{{}}}", math);
  }
  if (first >= 0xC3 && first <= 0xC5 && one.size() == 2) return std::string(one);  // Latin letters with accents
  if (first >= 0x80) {
    throw std::domain_error(fmt::format(
        "pgfplots: LaTeX has no letter for '{}': leave it out of the title, or write svg or pdf, which have all", one));
  }
  if (first < ' ') return " ";
  if (one == "*" && mathematics) return "{*}";
  if (one == "\\") return mathematics ? "\\backslash " : "\\textbackslash{}";
  if (one == "~") return "\\textasciitilde{}";
  if (one == "^") return "\\textasciicircum{}";
  if (std::string_view("#$%&_{}").find(one) != std::string_view::npos) return fmt::format("\\{}", one);
  return std::string(one);
}

class Writer {
 public:
  explicit Writer(const Figure& figure) : figure_(figure), layout_(lay_out(figure)) {}

  std::string document() {
    put("\\tikzset{{text={}}}\n", name(figure_.theme.ink));
    put("\\fill[{}] (0,0) rectangle ({:.6g},{:.6g});\n", name(figure_.theme.ground), figure_.size.width_mm,
        figure_.size.height_mm);
    for (const PlacedText& text : layout_.texts) {
      put("\\node[inner sep=0pt,scale={:.3g},text={}{}{}] at ({:.6g},{:.6g}) {{{}}};\n", text.size,
          name(text.faint ? figure_.theme.faint : figure_.theme.ink), text.turned ? ",rotate=90" : "",
          text.align == Label::Align::left ? ",anchor=west" : "", text.at.x, text.at.y, tex_text(text.text));
    }
    for (std::size_t i = 0; i < figure_.panels.size(); ++i) panel(i);
    for (std::size_t i = 0; i < layout_.colours.size(); ++i) {
      const auto& [left, bottom, width, height] = layout_.colours[i];
      put("\\fill[{}] ({:.6g},{:.6g}) rectangle ({:.6g},{:.6g});\n", name(figure_.colour_bar->colours[i]), left, bottom,
          left + width, bottom + height);
    }
    for (const auto& [entry, from, width] : layout_.legend) {
      if (entry.lines) {
        put("\\draw[{}] ({:.6g},{:.6g})--({:.6g},{:.6g});\n", line_style(entry.lines->stroke), from.x, from.y,
            from.x + width, from.y);
      }
      if (entry.marks) {
        put("\\draw plot[only marks,{}] coordinates {{({:.6g},{:.6g})}};\n", mark_style(*entry.marks),
            from.x + width / 2, from.y);
      }
    }
    put("\\end{{tikzpicture}}%\n\\end{{document}}\n");

    const std::string body = std::exchange(tex_, "");
    const double letter = layout_.letter * points_per_mm;
    put("% Drawn by contensou; pdflatex compiles it. The tikzpicture can be moved into a paper that loads amsmath and\n"
        "% pgfplots: whatever else it needs is inside it.\n"
        "\\documentclass{{article}}\n\\usepackage[utf8]{{inputenc}}\n\\usepackage{{amsmath}}\n"
        "\\usepackage{{pgfplots}}\n"
        "\\IfFileExists{{lmodern.sty}}{{\\usepackage{{lmodern}}}}{{}}\n"
        "\\usepackage[paperwidth={:.6g}mm,paperheight={:.6g}mm,margin=0mm]{{geometry}}\n"
        "\\pagestyle{{empty}}\n\\setlength{{\\parindent}}{{0pt}}\\setlength{{\\topskip}}{{0pt}}\n"
        "\\pdfinfoomitdate=1 \\pdftrailerid{{}}\n",
        figure_.size.width_mm, figure_.size.height_mm + 0.1);
    put("\\begin{{document}}%\n"
        "\\begin{{tikzpicture}}[x=1mm,y=1mm,font=\\fontsize{{{:.3g}}}{{{:.3g}}}\\selectfont]\n"
        "\\pgfplotsset{{compat=1.16}}\n",
        letter, 1.2 * letter);
    for (unsigned rgb : used_) put("\\definecolor{{c{0:06X}}}{{HTML}}{{{0:06X}}}\n", rgb);
    return tex_ + body;
  }

 private:
  template <class... Values>
  void put(fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(tex_), format, std::forward<Values>(values)...);
  }

  /// Returns the name of a colour; the picture defines all colours first.
  std::string name(Colour colour) {
    used_.insert(colour.rgb);
    return fmt::format("c{:06X}", colour.rgb);
  }

  std::string line_style(const Stroke& stroke) {
    return fmt::format("draw={},line width={:.3g}pt,line cap=round,line join=round{}", name(stroke.colour),
                       stroke.width * line_width * layout_.letter * points_per_mm * figure_.theme.line,
                       stroke.dashed && stroke.dotted ? ",dash pattern=on 4pt off 2pt on 0.6pt off 2pt"
                       : stroke.dashed                ? ",dash pattern=on 2.2pt off 2.4pt"
                       : stroke.dotted                ? ",dash pattern=on 0.6pt off 1.8pt"
                                                      : "");
  }

  std::string mark_style(const Marks& marks) {
    const double size = marks.size * mark_size / 2 * layout_.letter * points_per_mm;
    const bool open = marks.shape != Marks::Shape::dot;
    constexpr const char* names[]{"*", "*", "square*", "diamond*"};
    return fmt::format("mark={},mark size={:.3g}pt,mark options={{draw={},fill={},line width=0.7pt}}",
                       names[static_cast<std::size_t>(marks.shape)], size, name(marks.colour),
                       name(open ? figure_.theme.ground : marks.colour));
  }

  void axis_options(const char* which, const Axis& axis, const std::vector<Axis::Tick>& ticks) {
    std::vector<std::string> places, texts;
    for (const Axis::Tick& tick : ticks) {
      places.push_back(fmt::format("{:.8g}", tick.at));
      texts.push_back("{" + tex_text(tick.text) + "}");
    }
    put("  {0}min={1:.8g},{0}max={2:.8g},{3}{0}tick={{{4}}},{0}ticklabels={{{5}}},\n", which, axis.low, axis.high,
        axis.logarithmic ? fmt::format("{}mode=log,", which) : "", fmt::join(places, ","), fmt::join(texts, ","));
  }

  /// The coordinates of an axis, in a unit that TeX's fixed point can represent; on logarithmic axes, exponents.
  struct Coordinates {
    Axis axis;
    double origin = 0, unit = 1;  ///< origin and unit of the coordinates, in data
    double mm, start;             ///< length of a unit on the page, mm; place of the coordinate 0, mm
    int digits;                   ///< digits behind the point, for hundredths of mm

    Coordinates(const Axis& of, double from_mm, double side_mm) : axis(of) {
      constexpr double least = 0.2, most = 500, farthest = 20;  // bounds of a side; largest distance, in sides
      const auto [low, high] = std::pair(data(axis.low), data(axis.high));
      const double side = high - low;
      if (side < least || side > most) unit = std::pow(10, std::floor(std::log10(side)));
      if (std::max(std::abs(low), std::abs(high)) > farthest * side) origin = low;
      mm = side_mm * unit / side;
      start = from_mm - (low - origin) / unit * mm;
      digits = std::max(0, static_cast<int>(std::ceil(std::log10(mm))) + 2);
    }

    double data(double value) const { return axis.logarithmic ? std::log10(value) : value; }
    std::string operator()(double value) const { return fmt::format("{:.{}f}", (data(value) - origin) / unit, digits); }

    /// Returns a comment about the unit, if it is not the unit of the data.
    std::string remark(char name) const {
      std::string words;
      if (axis.logarithmic) words += fmt::format(", log10 {}", name);
      if (origin != 0) words += fmt::format(", {} from {:.17g}", name, origin);
      if (unit != 1) words += fmt::format(", {} in {:g}", name, unit);
      return words;
    }
  };

  /// Draws a panel. pgfplots draws the axes. TikZ draws the contents in units of the axes, which is much faster.
  void panel(std::size_t i) {
    const Panel& panel = figure_.panels[i];
    const Box& box = layout_.panels[i].box;
    const Coordinates x(panel.x, box.left, box.width), y(panel.y, box.bottom, box.height);
    const auto at = [&](Point point) { return fmt::format("({},{})", x(point.x), y(point.y)); };
    const auto path = [&](const Polyline& line) {
      std::vector<std::string> places;
      for (const Point& point : line) places.push_back(at(point));
      return fmt::format("{}", fmt::join(places, "--"));
    };
    const std::string scope = fmt::format(
        "% in units of the axes{}{}\n\\begin{{scope}}[shift={{({:.4f}mm,{:.4f}mm)}},x={{({:.6g}mm,0mm)}},"
        "y={{(0mm,{:.6g}mm)}}]\n",
        x.remark('x'), y.remark('y'), x.start, y.start, x.mm, y.mm);
    if (!panel.regions.empty()) {
      put("{}", scope);
      for (const Region& region : panel.regions) put("\\fill[{}] {};\n", name(region.colour), path(region.border));
      put("\\end{{scope}}\n");
    }
    if (!panel.bare) {
      put("\\begin{{axis}}[at={{({:.6g}mm,{:.6g}mm)}},anchor=south west,scale only "
          "axis,width={:.6g}mm,height={:.6g}mm,\n",
          box.left, box.bottom, box.width, box.height);
      axis_options("x", panel.x, layout_.panels[i].x);
      axis_options("y", panel.y, layout_.panels[i].y);
      put("  axis lines=left,axis line style={{-}},tick align=outside,scaled ticks=false,tick label "
          "style={{scale=0.9}}]\n\\end{{axis}}\n");
    }
    put("{}", scope);
    for (const Lines& layer : panel.lines) {
      std::string paths;
      for (const Polyline& line : visible(panel, layer.lines)) paths += "\n  " + path(line);
      if (!paths.empty()) put("\\draw[{}]{};\n", line_style(layer.stroke), paths);
    }
    for (const Arrows& layer : panel.arrows) {
      for (const Arrow& arrow : layer.arrows) {
        const std::optional<Arrow> head = short_arrow(panel, box, arrow);
        if (!head) continue;
        const Point tail = on_paper(panel, head->at), tip = on_paper(panel, arrow.at);
        const double back_x = (tail.x - tip.x) * box.width, back_y = (tail.y - tip.y) * box.height;
        // Returns the point at a distance behind the tip and a distance to its left, in units of the head's length.
        const double length = layer.size * head_length * layout_.letter / std::hypot(back_x, back_y);
        const auto corner = [&](double back, double left) {
          return fmt::format("({:.4f}mm,{:.4f}mm)", length * (back * back_x + left * back_y),
                             length * (back * back_y - left * back_x));
        };
        // This arrow head needs no TikZ library.
        const double half = 0.325, notch = 0.7;
        put("\\fill[{}] {}--+{}--+{}--+{}--cycle;\n", name(layer.colour), at(arrow.at), corner(1, half),
            corner(notch, 0), corner(1, -half));
      }
    }
    for (const Marks& layer : panel.marks) {
      put("\\draw plot[only marks,{}] coordinates {{", mark_style(layer));
      for (const Point& point : layer.points) tex_ += at(point);
      put("}};\n");
    }
    for (const Label& label : panel.labels) {
      const char* anchor = label.align == Label::Align::left    ? ",anchor=west"
                           : label.align == Label::Align::right ? ",anchor=east"
                                                                : "";
      put("\\node[text={},fill={},inner sep=0.8pt,scale=0.85{}] at {} {{{}}};\n", name(label.colour),
          name(figure_.theme.ground), anchor, at(label.at), tex_text(label.text));
    }
    put("\\end{{scope}}\n");
  }

  const Figure& figure_;
  Layout layout_;
  std::set<unsigned> used_;  ///< rgb values of the colours in use
  std::string tex_;
};

}  // namespace

std::string tex_text(const Text& text) {
  std::string tex;
  bool mathematics = false;
  const auto turn = [&](bool to_mathematics) {
    if (mathematics != to_mathematics) tex += to_mathematics ? "\\ensuremath{" : "}";
    mathematics = to_mathematics;
  };
  for (const Run& run : text.runs()) {
    turn(run.italic || run.level != 0);
    if (run.level != 0) tex += run.level > 0 ? "^{" : "_{";
    const std::string words = with_minus_signs(run.words);
    for (const std::string_view character : characters(words)) tex += tex_character(character, mathematics);
    if (run.level != 0) tex += '}';
  }
  turn(false);
  return tex;
}

std::string pgfplots(const Figure& figure) {
  if (std::ranges::any_of(figure.panels, [](const Panel& panel) { return panel.colours.has_value(); })) {
    throw std::domain_error("pgfplots: a field of colours is more than TeX can draw: choose another format");
  }
  return Writer(figure).document();
}

}  // namespace contensou::portraits
