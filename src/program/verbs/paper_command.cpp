#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <future>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "commands.hpp"
#include "contensou/portraits/law_figure.hpp"
#include "contensou/portraits/paper_drawings.hpp"
#include "contensou/portraits/phase_portrait.hpp"
#include "contensou/portraits/phase_portrait_figure.hpp"
#include "contensou/reduction/laws.hpp"
#include "contensou/reduction/pade_law.hpp"
#include "contensou/reduction/patch_claims.hpp"
#include "contensou/reduction/plane_claims.hpp"
#include "contensou/si/ball_claims.hpp"
#include "contensou/si/catalogue.hpp"
#include "input/csv_table.hpp"
#include "options/output_options.hpp"
#include "output/json.hpp"
#include "output/output.hpp"
#include "output/picture.hpp"

namespace contensou::program {

namespace {

using portraits::Figure;
using portraits::PictureFormat;
using reduction::PaperClaim;

/// mu of the statements on the plane, and of Fig. 4: there the largest of a ball, so that the orbits' way into the
/// origin is seen.
constexpr double stated_patch_ratio = 0.3;
constexpr double drawn_patch_ratio = 1;

/// A pool ball whose slip is oblique and which spins about all three axes.
si::Shot oblique_shot() {
  si::Shot shot = si::find_ball("pool")->shot;
  shot.start = si::Velocities{.velocity = {1, 0.3}, .angular_velocity = {20, -15, -60}};
  return shot;
}

/// Every statement in the order of the paper.
std::vector<PaperClaim> recompute() {
  std::vector<PaperClaim> claims = reduction::patch_claims();
  const reduction::ReducedSystem system(reduction::PadeLaw{}, stated_patch_ratio);
  for (const auto& more : {si::ball_claims(oblique_shot()), reduction::plane_claims(system, {.u = 1, .v = 0.5})}) {
    claims.insert(claims.end(), more.begin(), more.end());
  }
  return claims;
}

struct NamedFigure {
  std::string name;
  Figure figure;
};

std::vector<NamedFigure> figures() {
  const reduction::ReducedSystem system(reduction::PadeLaw{}, drawn_patch_ratio);
  portraits::PortraitCaption caption;
  caption.title =
      fmt::format("Integral curves of d{{/:Italic v}}/d{{/:Italic u}},  {{/:Italic μ}} = {}", drawn_patch_ratio);
  caption.subtitle =
      "Zh98, Fig. 4: all of them run into the origin, tangent to the {/:Italic u}-axis; {/:Italic u} = 0 stands alone";
  return {{"fig1", portraits::patch_drawing()},
          {"fig2", portraits::law_figure(reduction::paper_laws())},
          {"fig3", portraits::ball_drawing()},
          {"fig4", portraits::draw(portraits::phase_portrait(system, {}), caption)}};
}

struct File {
  std::string path;
  std::string content;
};

/// All figures in both formats, drawn side by side.
std::vector<File> draw_figures(const std::filesystem::path& folder) {
  std::vector<std::pair<std::string, std::future<std::string>>> drawings;
  for (const NamedFigure& named : figures()) {
    for (const auto& [ending, format] : {std::pair{".svg", PictureFormat::svg}, {".pdf", PictureFormat::pdf}}) {
      drawings.emplace_back((folder / (named.name + ending)).string(),
                            std::async(std::launch::async, drawn, named.figure, format));
    }
  }
  std::vector<File> files;
  for (auto& [path, content] : drawings) files.push_back({path, content.get()});
  return files;
}

void make_folder(const Argument& out, const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || !std::filesystem::is_directory(folder)) {
    throw FileFailure(fmt::format("{} '{}': cannot make this folder: {}", out.name(), out.text(),
                                  error ? error.message() : "a file of that name is in the way"));
  }
}

class PaperCommand final : public Command {
 public:
  std::string name() const override { return "paper"; }
  std::string summary() const override { return "Every equation and claim of the paper recomputed; its four figures"; }
  std::string example() const override { return "contensou paper --out figures"; }

  void add_options(CLI::App& app) override {
    out_.add(app, "--out", "DIR", "write fig1 to fig4 into DIR as svg and pdf; without it, the table alone");
    output_.add(app);
  }

  ExitStatus run() override {
    output_.digits();  // a mistake there is found before anything is drawn
    if (out_.given() && out_.text().empty()) out_.reject("a folder's name is needed");
    const std::vector<PaperClaim> claims = recompute();
    if (out_.given()) {
      const std::vector<File> files = draw_figures(out_.text());
      make_folder(out_, out_.text());
      for (const auto& [path, content] : files) write_output(path, content);
    }
    output_.write_as(
        output_.format(), [&](int digits) { return as_text(claims, digits); }, [&] { return as_csv(claims); },
        [&] { return as_json(claims); });
    return std::ranges::all_of(claims, &PaperClaim::as_recorded) ? ExitStatus::done : ExitStatus::check_failed;
  }

 private:
  static std::string as_text(const std::vector<PaperClaim>& claims, int digits) {
    const int width = digits + 8;
    std::string text =
        fmt::format("{:<7}{:<67}{:>{}}{:>{}}  verdict\n", "Zh98", "says", "printed", width, "computed", width);
    const std::string* equation = nullptr;
    for (const PaperClaim& claim : claims) {
      const bool repeated = equation != nullptr && *equation == claim.equation;
      const auto& [printed, computed, allowed, at, corrected, at_least] = claim.evidence;
      const std::string bound =
          at_least ? fmt::format(">= {:.{}g}", printed, digits) : fmt::format("{:.{}g}", printed, digits);
      text += fmt::format(
          "{:<7}{:<67}{:>{}}{:>{}.{}g}  {}{}\n", repeated ? "" : claim.equation, claim.statement, bound, width,
          computed, width, digits, reduction::name(claim.found()),
          claim.as_recorded() ? "" : fmt::format("  FAIL: recorded as {}", reduction::name(claim.recorded)));
      equation = &claim.equation;
      if (claim.correction.empty()) continue;
      const std::string arrow = "         -> " + claim.correction;
      text += corrected ? fmt::format("{:<74}{:>{}.{}g}\n", arrow, *corrected, width, digits) : arrow + "\n";
    }
    const auto count = [&](reduction::Verdict verdict) {
      return std::ranges::count_if(claims, [&](const PaperClaim& claim) { return claim.found() == verdict; });
    };
    const auto failed = std::ranges::count_if(claims, [](const PaperClaim& claim) { return !claim.as_recorded(); });
    return text + fmt::format("\n{} statements: {} hold, {} are slips, {} are false; {} not as recorded\n",
                              claims.size(), count(reduction::Verdict::holds), count(reduction::Verdict::slip),
                              count(reduction::Verdict::not_true), failed);
  }

  static std::string as_csv(const std::vector<PaperClaim>& claims) {
    std::string text =
        csv_line({"equation", "statement", "printed", "computed", "verdict", "recorded", "correction", "at"});
    for (const PaperClaim& claim : claims) {
      text += csv_line({claim.equation, claim.statement, fmt::format("{}", claim.evidence.printed),
                        fmt::format("{}", claim.evidence.computed), std::string(reduction::name(claim.found())),
                        std::string(reduction::name(claim.recorded)), claim.correction, claim.evidence.at});
    }
    return text;
  }

  static std::string as_json(const std::vector<PaperClaim>& claims) {
    const auto number = [](double value) {
      return json(std::isnan(value) ? std::numeric_limits<double>::infinity() : value);
    };
    std::vector<std::string> rows;
    for (const PaperClaim& claim : claims) {
      rows.push_back(JsonObject()
                         .add("equation", json(claim.equation))
                         .add("statement", json(claim.statement))
                         .add("printed", number(claim.evidence.printed))
                         .add("computed", number(claim.evidence.computed))
                         .add("verdict", json(reduction::name(claim.found())))
                         .add("recorded", json(reduction::name(claim.recorded)))
                         .add("correction", json(claim.correction))
                         .add("at", json(claim.evidence.at))
                         .inline_text());
    }
    return JsonObject::document().add("claims", json_array(rows)).text();
  }

  Argument out_;
  OutputOptions output_{Format::text};
};

}  // namespace

std::unique_ptr<Command> make_paper_command() { return std::make_unique<PaperCommand>(); }

}  // namespace contensou::program
