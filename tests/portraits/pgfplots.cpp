#include "contensou/portraits/pgfplots.hpp"

#include <stdlib.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <catch2/catch.hpp>

#include "contensou/portraits/phase_portrait_figure.hpp"
#include "contensou/reduction/pade_law.hpp"

using namespace contensou;
using portraits::tex_text;
namespace fs = std::filesystem;

namespace {

std::string document(portraits::View view) {
  portraits::PortraitRequest request;
  request.view = view;
  return portraits::pgfplots(portraits::draw(portraits::phase_portrait({{reduction::PadeLaw{}, 0.3}}, request)));
}

}  // namespace

TEST_CASE("A figure's text is TeX's text", "[table]") {
  CHECK(tex_text("plain") == "plain");
  CHECK(tex_text("{/:Italic u} = {/:Italic R ω_z}") == "\\ensuremath{u} = \\ensuremath{R \\omega _{z}}");
  CHECK(tex_text("10^{-3}") == "10\\ensuremath{^{-3}}");
  CHECK(tex_text("{/*0.85 x}") == "x");
  CHECK(tex_text("{/:Italic τ}*") == "\\ensuremath{\\tau }*");
  CHECK(tex_text("{/:Italic τ*}") == "\\ensuremath{\\tau {*}}");
  CHECK(tex_text("50 % & #1 $ a\\_b \\{c\\}") == "50 \\% \\& \\#1 \\$ a\\_b \\{c\\}");
  CHECK(tex_text("\\\\input~") == "\\textbackslash{}input\\textasciitilde{}");
  CHECK(tex_text("Poincaré → ∞") == "Poincaré \\ensuremath{\\to} \\ensuremath{\\infty}");
  CHECK(tex_text("球") == "?");
  CHECK(tex_text("{/:Italic") == "\\ensuremath{}");
  CHECK(tex_text("") == "");
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

TEST_CASE("pdflatex compiles every view", "[route]") {
  if (std::system("command -v pdflatex >/dev/null && kpsewhich pgfplots.sty >/dev/null") != 0) {
    WARN("skipped: pdflatex with pgfplots is not installed (Debian: texlive-pictures, texlive-latex-recommended)");
    return;
  }
  std::string folder = (fs::temp_directory_path() / "contensou-test-XXXXXX").string();
  REQUIRE(mkdtemp(folder.data()) != nullptr);
  for (portraits::View view : portraits::views()) {
    CAPTURE(portraits::name(view));
    std::ofstream(fs::path(folder) / "figure.tex") << document(view);
    const std::string run =
        "cd " + folder + " && pdflatex -interaction=nonstopmode -halt-on-error figure.tex >out 2>&1";
    CHECK(std::system(run.c_str()) == 0);
    std::ifstream log(fs::path(folder) / "out");
    const std::string words{std::istreambuf_iterator<char>(log), {}};
    CHECK(words.find("(1 page") != std::string::npos);
  }
  fs::remove_all(folder);
}
