#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "answers/input/csv.hpp"
#include "contensou/portraits/theory_figures.hpp"
#include "contensou/reduction/laws.hpp"
#include "contensou/si/experiment.hpp"
#include "options/law_option.hpp"
#include "options/output_options.hpp"
#include "options/start_options.hpp"
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

/// The friction of a ball at one slip and spin.
struct ContactReport {
  std::string law;
  double slip, spin, load, patch_radius, k, force, moment;
};

constexpr Field<ContactReport> contact_fields[]{
    {"law", "", "name of the law of friction", [](const ContactReport& r) -> Json { return r.law; }},
    {"slip", "m/s", "sliding speed of the point of contact", [](const ContactReport& r) -> Json { return r.slip; }},
    {"spin", "rad/s", "angular velocity about the vertical", [](const ContactReport& r) -> Json { return r.spin; }},
    {"load", "N", "load", [](const ContactReport& r) -> Json { return r.load; }},
    {"patch_radius", "m", "radius of the contact patch", [](const ContactReport& r) -> Json { return r.patch_radius; }},
    {"k", "", "slip divided by the speed of the rim of the patch", [](const ContactReport& r) { return Json(r.k); }},
    {"force", "N", "force of friction, against the slip", [](const ContactReport& r) -> Json { return r.force; }},
    {"moment", "N m", "moment of friction about the vertical, against the spin",
     [](const ContactReport& r) -> Json { return r.moment; }},
};

std::vector<FieldText> law_texts() { return joined({texts_of(law_fields), texts_of(law_columns)}); }
std::vector<FieldText> contact_texts() { return texts_of(contact_fields); }

class LawCommand final : public Verb {
 public:
  void add_options(CLI::App& app) override {
    law_.add(app, ". Several names, between commas, give one picture");
    app.option_defaults()->group("Ratios");
    k_.add(app, "--k", "K1,K2,...", "list of ratios k, each from 0 to inf", parse_ratios);
    batch_.add(app, "--batch", "FILE", "table with a column k, instead of --k; - is standard input");
    k_.excludes({&batch_});
    surface_.add(app, "--surface",
                 "draw the limit surface, force against moment, of --law beside exact, pade, uniform and ring");
    start_.add_ball(app, "real body in SI units, instead of --k: prints force and moment at its slip and spin");
    start_.ball().excludes({&k_, &batch_, &surface_}, "slip and spin of the ball determine k");
    output_.add(app);
  }

  ExitStatus run() override {
    const Output output = output_.read();
    if (surface_) require_picture("--surface", output);
    const std::vector<reduction::Law> asked = law_.read_several(start_.standard_law());
    const reduction::Law& law = asked.front();
    if (asked.size() > 1 && !output.picture)
      law_.argument().reject("several laws give a picture: add -o FILE, such as law.svg, or give one law");
    if (start_.ball_given()) {
      if (output.picture) throw BadInput("a picture needs no --ball: leave it out");
      return output.write(contact_answer(law));
    }
    if (output.picture) {
      if (k_.given() || batch_.given()) throw BadInput("a picture needs no --k or --batch: leave them out");
      std::vector<reduction::Law> laws = reduction::paper_laws();
      if (surface_) laws.insert(laws.end(), {*reduction::find_law("uniform"), *reduction::find_law("ring")});
      const auto is_drawn = [&](const reduction::Law& of) {
        return std::ranges::find(laws, of.name(), &reduction::Law::name) != laws.end();
      };
      // Fig. 2 of the paper compares only the two laws of the paper.
      if (!surface_ && !std::ranges::all_of(asked, is_drawn)) laws.clear();
      for (const reduction::Law& of : asked) {
        if (!is_drawn(of)) laws.push_back(of);
      }
      const auto draw = surface_ ? portraits::limit_surface_figure : portraits::law_figure;
      return output_.write({draw(laws, output_.size())}, output);
    }
    if (!k_.given() && !batch_.given()) {
      throw BadInput(
          "--k missing: give --k K1,K2,..., --batch FILE, or --ball NAME --slip V --spin W; "
          "or a picture, -o FILE ending in svg, pdf, png, eps, gp or tex");
    }
    const LawReport report = evaluate(law, k_.given() ? *k_ : read_column(batch_.text(), "k", Infinity::allowed));
    return output.write(Answer{.members = members_of(law_fields, report), .columns = columns_of(law_columns, report)});
  }

 private:
  Answer contact_answer(const reduction::Law& law) const {
    const si::Experiment ball = start_.read_ball(law);
    const double slip = si::slip_at_start(ball), spin = si::spin_at_start(ball), a = si::patch_radius_of(ball, law);
    const double load = ball.ball.mass * si::pressing(ball.environment), limit = ball.contact.friction * load;
    if (slip == 0 && spin == 0) {
      start_.reject_ball(
          fmt::format("slip and spin are 0: at rest the force is anything up to {} N, and the moment up "
                      "to {} N m; give --slip V or --spin W",
                      limit, limit * a * law.pivoting_moment()));
    }
    const auto [force, moment] = law({slip, a * std::abs(spin)});
    const ContactReport report{law.name(),        slip, spin, load, a, slip / (a * std::abs(spin)), limit * force,
                               limit * a * moment};
    const Json members = members_of(contact_fields, report);
    return {.members = members, .rows = {members}};
  }

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

  StartOptions start_;
  LawOption law_;
  ArgumentOf<std::vector<double>> k_;
  Argument batch_;
  Flag surface_;
  PictureOptions output_{{{"a law", with_pictures(answer_formats("csv"))}}};
};

const RegisteredVerb<LawCommand> law_verb(Purpose::draw, "law", "Compute or draw the force and moment of friction",
                                          "contensou law --law exact --k 0,0.5,1,2,inf",
                                          {{"", law_texts}, {"--ball", contact_texts}}, {"u", "v", "mu", "k", "f, N"});

}  // namespace

}  // namespace contensou::program
