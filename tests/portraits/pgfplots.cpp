#include "contensou/portraits/render.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>

#include <catch2/catch.hpp>

#include "contensou/portraits/layout.hpp"
#include "contensou/portraits/phase_portrait.hpp"
#include "contensou/reduction/laws.hpp"
#include "figures.hpp"

using namespace contensou;
using portraits::math, portraits::sub, portraits::sup, portraits::tex_text, portraits::Text;

namespace {

std::string document(portraits::View view) {
  return portraits::pgfplots(portraits::draw(portraits::phase_portrait({{reduction::PadeLaw{}, 0.3}}, {.view = view})));
}

std::string picture_of(const std::string& tex) {
  const std::string end = "\\end{tikzpicture}";
  const std::size_t from = tex.find("\\begin{tikzpicture}"), to = tex.find(end);
  REQUIRE(to != tex.npos);
  return tex.substr(from, to + end.size() - from) + "\n";
}

}  // namespace

TEST_CASE("A figure's text is TeX's text", "[table]") {
  const std::pair<Text, const char*> cases[]{
      {"plain", "plain"},
      {math("u = R ω") + sub(math("z")), "\\ensuremath{u}~=~\\ensuremath{R~\\omega _{z}}"},
      {"10" + sup("-3"), "10\\ensuremath{^{-3}}"},
      {math("u") + sub("0"), "\\ensuremath{u_{0}}"},
      {math("τ*"), "\\ensuremath{\\tau }*"},
      {"50 % & #1 $ a_b {c}", "50 \\% \\& \\#1 \\$ a\\_b \\{c\\}"},
      {"\\input~", "\\textbackslash{}input\\textasciitilde{}"},
      {"Poincaré → ∞", "Poincaré \\ensuremath{\\to} \\ensuremath{\\infty}"},
      {"ε = -2", "\\ensuremath{\\varepsilon} = \\ensuremath{-}2"},
      {"", ""},
  };
  for (const auto& [text, tex] : cases) CHECK(tex_text(text) == tex);
  for (const char* letter : {"球", "шар"}) CHECK_THROWS_WITH(tex_text(letter), Catch::Contains("no letter for"));
}

TEST_CASE("A document has as many closing braces as opening ones, and only finite numbers", "[invariant]") {
  for (portraits::View view : portraits::views()) {
    const std::string tex = document(view);
    CAPTURE(portraits::name(view));
    CHECK(std::ranges::count(tex, '{') == std::ranges::count(tex, '}'));
    CHECK(tex.find("nan") == std::string::npos);
    CHECK(tex.find("inf)") == std::string::npos);
    CHECK(tex.find("\\begin{tikzpicture}") != std::string::npos);
    CHECK(tex == document(view));
  }
}

TEST_CASE("What TeX draws in a panel is in units of its axes, and lies where they say", "[route]") {
  portraits::Figure figure;
  const auto panel = [&](portraits::Axis x, portraits::Axis y) {
    portraits::Panel& added = figure.panels.emplace_back();
    added.x = std::move(x);
    added.y = std::move(y);
    const auto line = [&](double part) {
      return portraits::Polyline{portraits::from_paper(added, {0, part}), portraits::from_paper(added, {1, 1 - part})};
    };
    added.lines.push_back({{line(0.3)}, {}, ""});
  };
  panel({"", -1, 1, false, {}}, {"", 0, 5, false, {}});
  panel({"", 0, 3e-7, false, {}}, {"", 0, 8e5, false, {}});
  panel({"", 1000, 1000.15, false, {}}, {"", 1e-3, 1e4, true, {}});
  figure.max_columns = 1;
  figure.size = {150, 250};
  const std::string tex = portraits::pgfplots(figure);
  const portraits::Layout layout = portraits::lay_out(figure);
  std::size_t from = 0;
  const auto number_after = [&](const std::string& words) {
    from = tex.find(words, from);
    REQUIRE(from != tex.npos);
    from += words.size();
    return std::stod(tex.substr(from));
  };
  std::vector<portraits::Point> first;
  for (const auto& [box, x_ticks, y_ticks, scale, place] : layout.panels) {
    const double left = number_after("shift={("), bottom = number_after(","), x = number_after("x={(");
    const double y = number_after("y={(0mm,");
    first.push_back({number_after("\n  ("), number_after(",")});
    const portraits::Point last{number_after("--("), number_after(",")};
    CHECK(left + x * first.back().x == Approx(box.left).margin(0.01));
    CHECK(bottom + y * first.back().y == Approx(box.bottom + 0.3 * box.height).margin(0.01));
    CHECK(left + x * last.x == Approx(box.left + box.width).margin(0.01));
    CHECK(bottom + y * last.y == Approx(box.bottom + 0.7 * box.height).margin(0.01));
  }
  CHECK((first[0].x == -1 && first[0].y == 1.5));
  CHECK((first[1].x == 0 && first[1].y == 2.4));
  CHECK((first[2].x == 0 && first[2].y == Approx(-0.9)));
  for (const char* remark :
       {"% in units of the axes\n", "axes, x in 1e-07, y in 100000\n", "axes, x from 1000, x in 0.1, log10 y\n"})
    CHECK_THAT(tex, Catch::Contains(remark));
}

TEST_CASE("TeX draws no field of colours", "[domain]") {
  portraits::Figure map;
  map.panels.resize(1);
  map.panels[0].colours = portraits::ColourMap{.values = {1, 2}, .columns = 2, .palette = {}};
  CHECK_THROWS_AS(portraits::pgfplots(map), std::domain_error);
}

TEST_CASE("The tikzpicture defines its colours and needs no library of TikZ", "[table]") {
  const std::string tex = picture_of(document(portraits::View::uv));
  const std::regex colour("c[0-9A-F]{6}"), definition(R"(\\definecolor\{(c[0-9A-F]{6})\})");
  std::set<std::string> defined;
  std::istringstream lines(tex);
  for (std::string line; std::getline(lines, line);) {
    if (std::smatch made; std::regex_search(line, made, definition)) {
      defined.insert(made[1]);
      continue;
    }
    for (std::sregex_iterator used(line.begin(), line.end(), colour), end; used != end; ++used) {
      CHECK(defined.contains(used->str()));
    }
  }
  CHECK(defined.size() > 3);
  CHECK(tex.find("Stealth") == tex.npos);
}

TEST_CASE("pdflatex compiles every view, and its picture in another paper", "[route]") {
  if (std::system("command -v pdflatex >/dev/null && kpsewhich pgfplots.sty >/dev/null") != 0) {
    WARN("skipped: pdflatex with pgfplots is not installed (Debian: texlive-pictures, texlive-latex-recommended)");
    return;
  }
  const portraits::TemporaryFolder folder;
  for (portraits::View view : portraits::views()) {
    CAPTURE(portraits::name(view));
    const std::string whole = document(view);
    const std::string paper = "\\documentclass{article}\n\\usepackage{amsmath,pgfplots}\n\\begin{document}\n" +
                              picture_of(whole) + "\\end{document}\n";
    for (const std::string& tex : {whole, paper}) {
      std::ofstream(folder.path() / "figure.tex") << tex;
      const std::string run =
          "cd " + folder.path().string() + " && pdflatex -interaction=nonstopmode -halt-on-error figure.tex >out 2>&1";
      CHECK(std::system(run.c_str()) == 0);
      std::ifstream log(folder.path() / "out");
      const std::string words{std::istreambuf_iterator<char>(log), {}};
      CHECK(words.find("(1 page") != std::string::npos);
    }
  }
}
