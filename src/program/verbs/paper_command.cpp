#include <algorithm>
#include <filesystem>
#include <future>
#include <memory>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "answers/table/answer.hpp"
#include "contensou/portraits/phase_portrait.hpp"
#include "contensou/portraits/theory_figures.hpp"
#include "contensou/reduction/laws.hpp"
#include "options/output_options.hpp"
#include "paper/statements.hpp"
#include "platform/interruption.hpp"
#include "platform/output_file.hpp"
#include "verb.hpp"

namespace contensou::program {

namespace {

namespace fs = std::filesystem;
using portraits::Figure;
using portraits::PictureFormat;

/// mu of the statements about the plane. Fig. 4 is drawn with the largest mu of a ball. Then the direction in which
/// orbits enter the origin is visible.
constexpr double stated_patch_ratio = 0.3;
constexpr double drawn_patch_ratio = 1;

constexpr Field<Examined> statement_fields[]{
    {"equation", "", "number of the equation in the paper",
     [](const Examined& row) -> Json { return row.statement.equation; }},
    {"statement", "", "statement of the paper in words",
     [](const Examined& row) -> Json { return row.statement.says; }},
    {"printed", "", "value by the formula that the paper prints",
     [](const Examined& row) -> Json { return or_infinity(row.found.printed); }},
    {"computed", "", "value that this program computes in another way",
     [](const Examined& row) -> Json { return or_infinity(row.found.computed); }},
    {"verdict", "", "result of the comparison, such as holds or erratum",
     [](const Examined& row) -> Json { return word(row.found.verdict); }},
    {"recorded", "", "verdict that the program expects; any other verdict gives exit status 1",
     [](const Examined& row) -> Json { return word(row.statement.recorded); }},
    {"correction", "", "correct form of a statement that is an erratum",
     [](const Examined& row) -> Json { return row.correction(); }},
    {"at", "", "values at which printed and computed were compared",
     [](const Examined& row) -> Json { return fmt::format(fmt::runtime(row.statement.where), row.statement.at); }},
};

/// Examines all statements, in the order of the paper.
std::vector<Examined> recompute() {
  std::vector<Examined> rows;
  for (const auto& section : {patch_statements(), ball_statements(), plane_statements(stated_patch_ratio)}) {
    for (const Statement& statement : section) rows.push_back({statement});
  }
  return rows;
}

struct NamedFigure {
  std::string name;
  Figure figure;
};

std::vector<NamedFigure> figures(const portraits::AskedSize& size) {
  const reduction::ReducedSystem system(reduction::PadeLaw{}, drawn_patch_ratio);
  portraits::PortraitCaption caption;
  using portraits::math;
  caption.title = portraits::title_of("Integral curves of d" + math("v") + "/d" + math("u"),
                                      fmt::format("{}", drawn_patch_ratio), system.law().name());
  caption.subtitle = "Zhuravlev 1998, Fig. 4: all of them run into the origin, tangent to the " + math("u") +
                     "-axis; " + math("u = 0") + " stands alone";
  return {{"fig1", portraits::patch_drawing(size)},
          {"fig2", portraits::law_figure(reduction::paper_laws(), size)},
          {"fig3", portraits::ball_drawing(size)},
          {"fig4", portraits::draw(portraits::phase_portrait(system, {}), caption, {.size = size})}};
}

struct File {
  std::string path;
  std::string content;
};

/// Draws all figures in both formats, several at a time.
std::vector<File> draw_figures(const fs::path& folder, const FigureOptions& looks) {
  std::vector<std::pair<std::string, std::future<std::string>>> drawings;
  for (const auto& [name, figure] : figures(looks.size())) {
    for (const auto& [ending, format] : {std::pair{".svg", PictureFormat::svg}, {".pdf", PictureFormat::pdf}}) {
      drawings.emplace_back(
          text_of(folder / (name + ending)),
          std::async(std::launch::async, drawn, std::vector{looks.apply(figure, ending + 1)}, format));
    }
  }
  std::vector<File> files;
  for (auto& [path, content] : drawings) files.push_back({path, content.get()});
  return files;
}

/// Writes all files or none, into a folder that is created if it does not exist.
void write_files(const Argument& out, const std::vector<File>& files) {
  const BlockedSignals wait;
  const fs::path folder = fs::absolute(path_of(out.text()));
  std::error_code error;
  std::vector<fs::path> missing;  // folders to create, the deepest first
  for (fs::path path = folder; !fs::exists(path, error); path = path.parent_path()) missing.push_back(path);
  try {
    fs::create_directories(folder, error);
    if (!fs::is_directory(folder)) {
      throw FileFailure(fmt::format("{} '{}': cannot make this folder: {}", out.name(), out.text(),
                                    error ? error.message() : "a file of that name is in the way"));
    }
    std::vector<std::unique_ptr<OutputFile>> outputs;
    for (const auto& [path, content] : files) {
      outputs.push_back(std::make_unique<OutputFile>(path));
      outputs.back()->write(content);
    }
    for (const auto& output : outputs) output->finish();
  } catch (...) {
    for (const fs::path& path : missing) fs::remove(path, error);
    throw;
  }
}

std::string as_text(const std::vector<Examined>& rows, const Digits& digits) {
  const TextTable::Column number = TextTable::right(digits.width());
  TextTable table({TextTable::left(7), TextTable::left(67), number, number});
  table.add({"Zh98", "says", "printed", "computed", "  verdict"});
  std::string_view equation = "none";
  for (const Examined& row : rows) {
    const auto& [printed, computed, corrected, verdict] = row.found;
    table.add(
        {std::string(row.statement.equation == equation ? "" : row.statement.equation), std::string(row.statement.says),
         (row.statement.allowed == lower_bound ? ">= " : "") + digits(printed), digits(computed),
         fmt::format("  {}{}", word(verdict),
                     row.as_recorded() ? "" : fmt::format("  FAIL: recorded as {}", word(row.statement.recorded)))});
    equation = row.statement.equation;
    if (row.statement.correction.empty()) continue;
    std::vector<std::string> correction{"", "  -> " + row.correction()};
    if (corrected) correction.push_back(digits(*corrected));
    table.add(std::move(correction));
  }
  const auto count = [&](Verdict verdict) {
    return std::ranges::count_if(rows, [&](const Examined& row) { return row.found.verdict == verdict; });
  };
  return table.text() + fmt::format(
                            "\nThe plane's statements and Fig. 4 use the Pade law, as the paper does.\n"
                            "{} statements: {} hold, {} are errata, {} are false; {} not as recorded\n",
                            rows.size(), count(Verdict::holds), count(Verdict::erratum), count(Verdict::not_true),
                            std::ranges::count(rows, false, &Examined::as_recorded));
}

std::vector<FieldText> paper_texts() { return texts_of_rows("claims", statement_fields); }

class PaperCommand final : public Verb {
 public:
  void add_options(CLI::App& app) override {
    app.option_defaults()->group("Figures");
    out_.add(app, "--out", "DIR", "folder for the figures fig1 to fig4, as svg and pdf (default: no figures)");
    figure_.add(app, true);
    output_.add(app);
  }

  ExitStatus run() override {
    const Output output = output_.read();
    if (out_.given() && out_.text().empty()) out_.reject("a folder's name is needed");
    if (const std::string names = figure_.names(); !out_.given() && !names.empty()) {
      throw BadInput("{}: without --out DIR nothing is drawn: add it, or leave it out", names);
    }
    const std::vector<Examined> rows = recompute();
    if (out_.given()) write_files(out_, draw_figures(path_of(out_.text()), figure_));
    Answer answer = answer_of_rows("claims", statement_fields, rows);
    answer.beside = {"recorded", "correction"};
    answer.text = [&](const Digits& digits) { return as_text(rows, digits); };
    answer.passed = std::ranges::all_of(rows, &Examined::as_recorded);
    return output.write(answer);
  }

 private:
  Argument out_;
  FigureOptions figure_;
  OutputOptions output_{{{"a table of statements", answer_formats("text")}}};
};

const RegisteredVerb<PaperCommand> paper_verb(Purpose::check, "paper",
                                              "Recompute every equation of Zhuravlev's paper, and draw its figures",
                                              "contensou paper --out figures", {{"", paper_texts}}, {"the paper"});

}  // namespace

}  // namespace contensou::program
