#include "contensou/portraits/render.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>
#include <regex>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

#include <catch2/catch.hpp>

#include "contensou/portraits/layout.hpp"
#include "contensou/portraits/phase_portrait.hpp"
#include "contensou/reduction/laws.hpp"
#include "figures.hpp"

using namespace contensou;
using portraits::Figure;
using portraits::PictureFormat;
namespace fs = std::filesystem;

namespace {

portraits::Figure sample() { return portraits::draw(portraits::phase_portrait({{reduction::PadeLaw{}, 0.05}}, {})); }

/// Sets a variable of the environment and restores its value afterwards.
class Variable {
 public:
  Variable(const char* name, const std::string& value) : name_(name) {
    if (const char* before = std::getenv(name)) before_ = before;
    setenv(name, value.c_str(), 1);
  }
  ~Variable() {
    if (before_)
      setenv(name_, before_->c_str(), 1);
    else
      unsetenv(name_);
  }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

  const std::optional<std::string>& before() const { return before_; }

 private:
  const char* name_;
  std::optional<std::string> before_;
};

/// A folder for one test. PATH, TMPDIR and HOME point into it as long as the object exists.
class Sandbox {
 public:
  Sandbox() {
    fs::create_directory(folder() / "bin");
    fs::create_directory(folder() / "tmp");
  }

  void install_gnuplot(const std::string& content) const {
    const fs::path file = folder() / "bin" / "gnuplot";
    std::ofstream(file, std::ios::binary) << content << "\n";
    fs::permissions(file, fs::perms::owner_all);
  }
  void fake_gnuplot(const std::string& body) const { install_gnuplot("#!/bin/sh\n" + body); }
  /// Installs the real gnuplot, with commands of the test before and after it.
  void real_gnuplot(const std::string& before, const std::string& after) const {
    fake_gnuplot("PATH='" + path_.before().value() + "'\n" + before + " gnuplot \"$@\" " + after);
  }
  const fs::path& folder() const { return folder_.path(); }
  bool left_nothing() const { return fs::is_empty(folder() / "tmp"); }

 private:
  portraits::TemporaryFolder folder_;
  Variable path_{"PATH", folder() / "bin"}, tmpdir_{"TMPDIR", folder() / "tmp"}, home_{"HOME", folder()};
};

}  // namespace

TEST_CASE("Endings name formats", "[table]") {
  const std::vector<std::string_view> endings{"svg", "pdf", "png", "eps", "gp", "tex"};
  CHECK(portraits::picture_formats() == endings);
  for (std::size_t i = 0; i < endings.size(); ++i) {
    CHECK(portraits::find_picture_format(endings[i]) == static_cast<PictureFormat>(i));
  }
  CHECK(portraits::find_picture_format("gif") == PictureFormat::gif);
  for (const char* unknown : {"jpg", ""}) CHECK_FALSE(portraits::find_picture_format(unknown));
}

TEST_CASE("A script is whole: it needs no file, has no gaps, and is the same each time", "[table]") {
  const std::string script = portraits::gnuplot_script(sample());
  CHECK(script == portraits::gnuplot_script(sample()));
  CHECK(script.find("set terminal svg") != std::string::npos);
  CHECK(script.find("nan") == std::string::npos);
  CHECK(script.find("inf") == std::string::npos);
  // The script must contain one block of data for each plot that reads a block.
  const auto count = [&](const std::string& text) {
    int found = 0;
    for (std::size_t at = 0; (at = script.find(text, at)) != std::string::npos; at += text.size()) ++found;
    return found;
  };
  CHECK(count("'-' with") == count("\ne\n"));
  CHECK(count("'-' with") >= 8);
}

TEST_CASE("Scripts and the picture formats that need none are written without gnuplot", "[limit]") {
  const Sandbox sandbox;
  CHECK(portraits::render(sample(), PictureFormat::gp) == portraits::gnuplot_script(sample()));
  CHECK(portraits::render(sample(), PictureFormat::tex).find("\\documentclass") != std::string::npos);
  CHECK(sandbox.left_nothing());
}

TEST_CASE("A film has all its frames, and a mark is as wide on paper in every format", "[gnuplot]") {
  Figure figure;
  figure.size = {40, 40};
  figure.panels = {{}};
  figure.panels[0].x = figure.panels[0].y = {"", 0, 1, false, {}};
  figure.panels[0].marks = {{{{0.2, 0.2}}, {0x112233}, 2}};
  std::vector<Figure> frames(3, figure);
  for (const int i : {1, 2}) frames[i].panels[0].marks[0].points = {{0.3 * i, 0.8}};
  const std::string film = portraits::render_film(frames);
  CHECK_THAT(film, Catch::StartsWith("GIF89a"));
  // Each frame begins with its delay of 8 hundredths of a second.
  int delays = 0;
  for (std::size_t at = 0; (at = film.find("\x21\xF9\x04", at)) != std::string::npos; ++at) delays += film[at + 4] == 8;
  CHECK(delays == 3);

  // Read the radius of the circle from the SVG. The picture has 5 units for each millimetre.
  const std::string svg = portraits::render(figure, PictureFormat::svg);
  const std::size_t scale = svg.find("scale(");
  REQUIRE(scale != std::string::npos);
  const double wanted = 2 * portraits::mark_size * portraits::letter_mm(40);
  CHECK(2 * std::stod(svg.substr(scale + 6)) / 5 == Approx(wanted).epsilon(0.01));
}

TEST_CASE("The numbers of an x axis stand between the axis and its name in SVG, too", "[layout]") {
  const std::regex written("translate\\(([-0-9.]+),([-0-9.]+)\\)\"[^>]*>\\s*<text[^>]*>(.*)</text>");
  const std::regex tags("<[^>]*>");
  for (portraits::View view : portraits::views()) {
    for (double mu : {0.7, 0.02}) {
      CAPTURE(portraits::name(view), mu);
      const Figure figure = portraits::draw(portraits::phase_portrait({{reduction::PadeLaw{}, mu}}, {.view = view}));
      const portraits::Layout layout = portraits::lay_out(figure);
      const std::string svg = portraits::render(figure, PictureFormat::svg);
      constexpr double per_mm = 5;  // units of the SVG
      std::vector<std::tuple<std::string, double, double>> texts;
      for (std::sregex_iterator at(svg.begin(), svg.end(), written), end; at != end; ++at) {
        texts.emplace_back(std::regex_replace(at->str(3), tags, ""), std::stod(at->str(1)) / per_mm,
                           figure.size.height_mm - std::stod(at->str(2)) / per_mm);
      }
      for (std::size_t i = 0; i < figure.panels.size(); ++i) {
        if (figure.panels[i].bare) continue;
        const auto& [box, ticks, y, scale, colours] = layout.panels[i];
        REQUIRE_FALSE(ticks.empty());
        const double height = box.bottom - 1.5 * layout.letter, near = 0.1 * layout.letter;
        for (const auto& tick : ticks) {
          const double x = box.left + box.width * portraits::on_paper(figure.panels[i], {tick.at, 1}).x;
          const std::string words = portraits::with_minus_signs(tick.text.words());
          // The place of a text is the left end of its baseline, or the middle of it, 0.3 letters below its middle.
          CAPTURE(words, x);
          CHECK(std::ranges::any_of(texts, [&](const auto& text) {
            return std::get<0>(text) == words && std::abs(std::get<1>(text) - x) < near &&
                   std::abs(std::get<2>(text) + 0.3 * layout.letter - height) < near;
          }));
        }
      }
    }
  }
}

TEST_CASE("A missing gnuplot is named, with a way out", "[domain]") {
  const Sandbox sandbox;
  CHECK_THROWS_WITH(portraits::render(sample(), PictureFormat::svg),
                    Catch::Contains("gnuplot was not found on PATH") && Catch::Contains("gnuplot-nox"));
  CHECK(sandbox.left_nothing());
}

TEST_CASE("A failing gnuplot is an error with its words", "[domain]") {
  const Sandbox sandbox;
  const auto failure = [&](const std::string& gnuplot, PictureFormat format) {
    sandbox.fake_gnuplot(gnuplot);
    try {
      portraits::render(sample(), format);
    } catch (const portraits::GnuplotError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(failure("echo 'line 3: no such terminal' >&2; exit 7", PictureFormat::png) ==
        "gnuplot ended with status 7\n  line 3: no such terminal");
  CHECK(failure("kill -9 $$", PictureFormat::png) == "gnuplot was ended by signal 9");
  CHECK_THAT(failure("kill -ALRM $$", PictureFormat::png), Catch::Contains("more than 300 s"));
  sandbox.install_gnuplot("\x7f no program");
  CHECK_THROWS_WITH(portraits::render(sample(), PictureFormat::png), Catch::Contains("cannot be run"));
  CHECK(sandbox.left_nothing());
}

TEST_CASE("gnuplot is stopped when it takes too long: it begins with an alarm set", "[domain]") {
  const Sandbox sandbox;
  sandbox.fake_gnuplot("exec /usr/bin/perl -e 'print STDERR \"an alarm in \", alarm(0), \" s\"'");
  CHECK_THROWS_WITH(portraits::render(sample(), PictureFormat::svg),
                    Catch::Matches("[^]*an alarm in (300|2[0-9][0-9]) s"));
}

TEST_CASE("A picture that is not whole is refused", "[domain]") {
  const Sandbox sandbox;
  struct Lie {
    PictureFormat format;
    std::string gnuplot;
  };
  for (const auto& [format, gnuplot] : {
           Lie{PictureFormat::svg, "exit 0"},
           {PictureFormat::svg, "echo picture"},
           {PictureFormat::svg, R"(printf '<?xml version="1.0"?><svg></svg>\n\n')"},
           {PictureFormat::pdf, "printf '%%PDF-1.5 junk'"},
           {PictureFormat::png, "printf '\\211PNG junk'"},
           {PictureFormat::eps, "printf '%%!PS-Adobe junk'"},
       }) {
    CAPTURE(gnuplot);
    sandbox.fake_gnuplot(gnuplot);
    CHECK_THROWS_WITH(portraits::render(sample(), format), Catch::Contains("drew nothing that is a whole"));
  }
  for (const PictureFormat format : {PictureFormat::svg, PictureFormat::pdf, PictureFormat::png, PictureFormat::eps}) {
    for (const char* cut : {"| head -c 5000", "| head -c -10"}) {
      sandbox.real_gnuplot("", cut);
      CHECK_THROWS_WITH(portraits::render(sample(), format), Catch::Contains("drew nothing that is a whole"));
    }
  }
  sandbox.real_gnuplot("", "| sed /gnuplot_plot_2/d");
  CHECK_THROWS_WITH(portraits::render(sample(), PictureFormat::svg), Catch::Contains("drew nothing that is a whole"));
}

TEST_CASE("The environment changes no picture: no settings, no locale, no temporary folder", "[invariant]") {
  const std::string expected = portraits::render(sample(), PictureFormat::svg);
  const Sandbox sandbox;
  sandbox.real_gnuplot("", "");
  std::ofstream(sandbox.folder() / ".gnuplot") << "set title 'mine'\nprint 'mine'\n";
  const Variable tmpdir("TMPDIR", "/no/such/folder");
  for (const char* locale : {"xx_XX.UTF-8", "C"}) {
    const Variable all("LC_ALL", locale);
    CHECK(portraits::render(sample(), PictureFormat::svg) == expected);
  }
}

TEST_CASE("What gnuplot warns of is shown", "[domain]") {
  const Sandbox sandbox;
  sandbox.real_gnuplot("echo '    line 3: warning: no such font' >&2;", "");
  std::ostringstream shown;
  std::streambuf* const before = std::cerr.rdbuf(shown.rdbuf());
  portraits::render(sample(), PictureFormat::svg);
  std::cerr.rdbuf(before);
  CHECK(shown.str() == "contensou: gnuplot drew the picture and said\n  line 3: warning: no such font\n");
}

TEST_CASE("two quotes in a row are drawn", "[domain]") {
  portraits::Figure figure = sample();
  figure.title = "x'' = y''' + 'z'";
  CHECK(portraits::gnuplot_script(figure).find("x''' . \"'\" . ' = y") != std::string::npos);
  CHECK(portraits::render(figure, PictureFormat::svg).find("<svg") != std::string::npos);
}

TEST_CASE("Text is data: nothing in it is run, and it cannot end its line", "[domain]") {
  portraits::Figure figure = sample();
  figure.title = "a`touch pwned`b\n!touch pwned\nquote ' and \" $(touch pwned)";
  const std::string script = portraits::gnuplot_script(figure);
  CHECK(script.find("\n!") == std::string::npos);
  CHECK(script.find("a`touch pwned`b !touch pwned quote '' and \" $(touch pwned)") != std::string::npos);

  const portraits::TemporaryFolder folder;
  const fs::path here = fs::current_path();
  fs::current_path(folder.path());
  const std::string svg = portraits::render(figure, PictureFormat::svg);
  fs::current_path(here);
  CHECK(fs::is_empty(folder.path()));
  CHECK(svg.find("a`touch pwned`b !touch pwned quote ' and") != std::string::npos);
}

TEST_CASE("Any text is XML in SVG", "[domain]") {
  portraits::Figure figure = sample();
  figure.title = std::string("]]> <b>&amp; \xff \xc3( \xed\xa0\x80 \xef\xbf\xbe \x01");
  const std::string svg = portraits::render(figure, PictureFormat::svg);
  CHECK(svg.find("]]&gt; &lt;b>&amp;amp; \xef\xbf\xbd \xef\xbf\xbd(") != std::string::npos);
  for (const char* bad : {"]]>", "\xff", "\xc3(", "\xed\xa0", "\xef\xbf\xbe", "\x01"}) {
    CHECK(svg.find(bad) == std::string::npos);
  }
}

TEST_CASE("A picture has the size of its figure and no date: the same bytes at any time", "[invariant]") {
  CHECK(portraits::render(sample(), PictureFormat::svg).find("width=\"190mm\" height=\"125mm\"") != std::string::npos);
  // The date in the picture is fixed: the date that Cairo writes is replaced.
  CHECK(portraits::render(sample(), PictureFormat::pdf).find("/CreationDate (D:19700101000000") != std::string::npos);
  CHECK(portraits::render(sample(), PictureFormat::eps).find("%%CreationDate: Thu Jan  1 00:00:00 1970") !=
        std::string::npos);
  for (PictureFormat format : {PictureFormat::svg, PictureFormat::pdf, PictureFormat::png, PictureFormat::eps}) {
    CHECK(portraits::render(sample(), format) == portraits::render(sample(), format));
  }
}

TEST_CASE("gnuplot has nothing to say about any view, drawn as its script says on a machine without a locale",
          "[route]") {
  for (portraits::View view : portraits::views()) {
    for (double mu : {0.5, 0.001}) {
      const auto figure = portraits::draw(portraits::phase_portrait({{reduction::PadeLaw{}, mu}}, {.view = view}));
      const portraits::TemporaryFolder folder;
      const std::string script = portraits::gnuplot_script(figure);
      std::ofstream(folder.path() / "FILE.gp") << script;
      const std::size_t begin = script.find('`') + 1;
      const std::string command = script.substr(begin, script.find('`', begin) - begin);
      const std::string bare = "unset LANG LC_ALL LC_CTYPE; cd '" + folder.path().string() + "' && ";
      CHECK(std::system((bare + command + " 2> messages").c_str()) == 0);
      CHECK(fs::file_size(folder.path() / "FILE.svg") > 10000);
      std::ifstream messages(folder.path() / "messages");
      std::string words;
      std::getline(messages, words);
      CAPTURE(portraits::name(view), mu);
      CHECK(words == "");
    }
  }
}
