#include <algorithm>
#include <vector>

#include "answers/input/csv.hpp"
#include "contensou/portraits/theory_figures.hpp"
#include "contensou/reduction/laws.hpp"
#include "contensou/si/body.hpp"
#include "options/figure_options.hpp"
#include "options/law_option.hpp"
#include "verb.hpp"

namespace contensou::program {

namespace {

/// A law with its values at some ratios k.
struct LawReport {
  reduction::Law law;
  Eigen::ArrayXd k, phi, psi;
};

constexpr Field<LawReport> law_fields[]{
    {"law", "", "name of the law of friction", [](const LawReport& r) -> Json { return r.law.name(); }},
};
constexpr ColumnField<LawReport> law_columns[]{
    {"k", "", "ratio k", [](const LawReport& r) { return &r.k; }},
    {"phi", "", "force of friction divided by f N", [](const LawReport& r) { return &r.phi; }},
    {"psi", "", "moment of friction divided by f N and by the patch radius", [](const LawReport& r) { return &r.psi; }},
};

std::vector<FieldText> law_texts() { return joined({texts_of(law_fields), texts_of(law_columns)}); }

class LawCommand final : public Verb {
 public:
  void add_options(CLI::App& app) override {
    law_.add(app);
    app.option_defaults()->group("Ratios");
    k_.add(app, "--k", "K1,K2,...", "list of ratios k, each from 0 to inf", parse_ratios);
    batch_.add(app, "--batch", "FILE", "table with a column k, instead of --k; - is standard input");
    k_.excludes({&batch_});
    surface_.add(app, "--surface",
                 "draw the limit surface, force against moment, of --law beside exact, pade, uniform and ring");
    output_.add(app);
  }

  ExitStatus run() override {
    const Output output = output_.read();
    if (surface_) require_picture("--surface", output);
    const reduction::Law law = law_.read(std::string(si::Body{}.law));
    if (output.picture) {
      if (k_.given() || batch_.given()) throw BadInput("a picture needs no --k or --batch: leave them out");
      std::vector<reduction::Law> laws = reduction::paper_laws();
      if (surface_) laws.insert(laws.end(), {*reduction::find_law("uniform"), *reduction::find_law("ring")});
      if (std::ranges::find(laws, law.name(), &reduction::Law::name) == laws.end()) {
        if (!surface_) laws.clear();  // Fig. 2 of the paper compares only the two laws of the paper
        laws.push_back(law);
      }
      const auto draw = surface_ ? portraits::limit_surface_figure : portraits::law_figure;
      return output_.write({draw(laws, output_.size())}, output);
    }
    if (!k_.given() && !batch_.given()) {
      throw BadInput(
          "--k missing: give --k K1,K2,... or --batch FILE; "
          "or a picture, -o FILE ending in svg, pdf, png, eps, gp or tex");
    }
    const LawReport report = evaluate(law, k_.given() ? *k_ : read_column(batch_.text(), "k", Infinity::allowed));
    return output.write(Answer{.members = members_of(law_fields, report), .columns = columns_of(law_columns, report)});
  }

 private:
  static std::vector<double> parse_ratios(const std::string& typed) {
    std::vector<double> ratios = parse_numbers(typed, Infinity::allowed);
    for (double k : ratios) {
      if (!(k >= 0)) throw NotAllowed("{} is not a ratio: k >= 0 or inf is required", k);
    }
    return ratios;
  }

  static LawReport evaluate(const reduction::Law& law, const std::vector<double>& ratios) {
    const auto rows = static_cast<Eigen::Index>(ratios.size());
    const Eigen::ArrayXd k = Eigen::Map<const Eigen::ArrayXd>(ratios.data(), rows);
    Eigen::ArrayXd phi(rows), psi(rows);
    for (Eigen::Index i = 0; i < rows; ++i) {
      const reduction::Resistance resistance = law(reduction::slip_of_ratio(k[i]));
      phi[i] = resistance.force;
      psi[i] = resistance.moment;
    }
    return {law, k, phi, psi};
  }

  LawOption law_;
  ArgumentOf<std::vector<double>> k_;
  Argument batch_;
  Flag surface_;
  PictureOptions output_{{{"a law", with_pictures(answer_formats("csv"))}}};
};

const RegisteredVerb<LawCommand> law_verb(Purpose::draw, "law", "Compute or draw the force and moment of friction",
                                          "contensou law --law exact --k 0,0.5,1,2,inf", {{"", law_texts}},
                                          {"u", "v", "mu", "k", "f, N"});

}  // namespace

}  // namespace contensou::program
