#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "commands.hpp"
#include "contensou/portraits/law_figure.hpp"
#include "contensou/reduction/hertz_law.hpp"
#include "contensou/reduction/pade_law.hpp"
#include "input/csv_table.hpp"
#include "options/law_option.hpp"
#include "options/output_options.hpp"
#include "output/columns.hpp"
#include "output/json.hpp"
#include "output/picture.hpp"

namespace contensou::program {

namespace {

class LawCommand final : public Command {
 public:
  std::string name() const override { return "law"; }
  std::string summary() const override {
    return "Friction force and moment against k: k,phi,psi, or the paper's Fig. 2";
  }
  std::string example() const override { return "contensou law --law exact --k 0,0.5,1,2,inf"; }

  void add_options(CLI::App& app) override {
    law_.add(app);
    k_.add(app, "--k", "K1,K2,...", "ratios k = v/(mu |u|), 0 to inf");
    batch_.add(app, "--batch", "FILE", "instead: a CSV with a column k; - is standard input");
    output_.add(app);
  }

  ExitStatus run() override {
    const reduction::Law law = law_.read();
    if (k_.given() && batch_.given()) throw BadInput("--k and --batch exclude each other: give one of them");
    if (const auto picture = portraits::find_picture_format(ending(output_.path()))) {
      if (k_.given() || batch_.given()) throw BadInput("a picture needs no --k or --batch: leave them out");
      output_.write(drawn(portraits::law_figure(shown(law)), *picture));
      return ExitStatus::done;
    }
    if (!k_.given() && !batch_.given()) {
      throw BadInput(
          "--k missing: give --k K1,K2,... or --batch FILE; or -o FILE with a picture's ending svg, pdf, png, eps, gp, "
          "tex");
    }

    const std::vector<Column> columns = evaluate(law, k_.given() ? listed() : from_table());
    output_.write_as(
        data_format(), [&](int digits) { return columns_as_text(columns, digits); },
        [&] { return columns_as_csv(columns); }, [&] { return document(law, columns); });
    return ExitStatus::done;
  }

 private:
  /// --format, or else what the ending of -o says.
  Format data_format() const {
    return !output_.format_given() && output_.path().ends_with(".json") ? Format::json : output_.format();
  }

  /// Both laws of the paper, and the one asked for if it is neither.
  static std::vector<reduction::Law> shown(const reduction::Law& law) {
    std::vector<reduction::Law> laws{reduction::HertzLaw{}, reduction::PadeLaw{}};
    if (std::ranges::find(laws, law.name(), &reduction::Law::name) == laws.end()) laws.push_back(law);
    return laws;
  }

  std::vector<double> listed() const {
    const std::vector<double> ratios = k_.numbers(Infinity::allowed);
    for (double k : ratios) {
      if (!(k >= 0)) k_.reject(fmt::format("{} is not a ratio: k >= 0 or inf is required", k));
    }
    return ratios;
  }

  std::vector<double> from_table() const {
    const CsvTable table = CsvTable::read(batch_.text());
    const std::size_t column = table.column("k");
    std::vector<double> ratios;
    for (const CsvRecord& row : table.rows()) {
      table.require_complete(row);
      try {
        ratios.push_back(parse_number(row.fields[column], Infinity::allowed));
      } catch (const BadInput& error) {
        throw table.complaint(row.line, fmt::format("k: {}", error.what()));
      }
      if (!(ratios.back() >= 0)) {
        throw table.complaint(row.line, fmt::format("k: k >= 0 or inf is required, got {}", ratios.back()));
      }
    }
    return ratios;
  }

  static std::vector<Column> evaluate(const reduction::Law& law, const std::vector<double>& ratios) {
    const auto rows = static_cast<Eigen::Index>(ratios.size());
    const Eigen::ArrayXd k = Eigen::Map<const Eigen::ArrayXd>(ratios.data(), rows);
    Eigen::ArrayXd phi(rows), psi(rows);
    for (Eigen::Index i = 0; i < rows; ++i) {
      const reduction::Resistance resistance = law(reduction::slip_of_ratio(k[i]));
      phi[i] = resistance.force;
      psi[i] = resistance.moment;
    }
    return {{"k", k}, {"phi", phi}, {"psi", psi}};
  }

  static std::string document(const reduction::Law& law, const std::vector<Column>& columns) {
    JsonObject document = JsonObject::document();
    document.add("law", json(law.name()));
    for (const auto& [name, values] : columns) document.add(name, json(values));
    return document.text();
  }

  LawOption law_;
  Argument k_, batch_;
  OutputOptions output_{Format::csv};
};

}  // namespace

std::unique_ptr<Command> make_law_command() { return std::make_unique<LawCommand>(); }

}  // namespace contensou::program
