#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "answers/asked/law_forms.hpp"
#include "answers/table/answer.hpp"
#include "contensou/portraits/phase_portrait.hpp"
#include "contensou/si/quantity.hpp"
#include "options/law_option.hpp"
#include "output/help.hpp"
#include "platform/output_file.hpp"
#include "verb.hpp"

namespace contensou::program {

namespace {

std::string laws() {
  std::string text = help_paragraph(
      "Laws of friction (--law), by their pressure at rho, the distance from the centre "
      "of the patch over its radius:");
  for (const auto& [name, meaning] : law_forms()) text += help_entry(name, meaning);
  return text + "\n" +
         help_paragraph(
             "The pressure of FILE.csv is linear in rho^2 between two rows (uniform up to a step, two rows of one "
             "rho); "
             "annulus and soft are such tables. What that costs where the rows sample a smooth curve, stop says beside "
             "its answer, by the same table with every other row left out.");
}

std::string views() {
  std::string text = help_paragraph(
      "Views of a portrait (--view). u = R omega_z is the pivoting, v the sliding speed, "
      "k = v/(mu |u|):");
  for (portraits::View view : portraits::views()) text += help_entry(name(view), axes(view));
  return text;
}

std::string units() {
  std::string text = help_paragraph(
      "Options in SI units take a unit behind the number, as in --slip \"2 m/s\", --spin 300rpm, --radius \"2.25 in\"; "
      "one behind a list is of all its numbers; in a range it stands before the count, --spin \"0:60 rpm:3\". A plain "
      "number has the first of its kind. In run files such "
      "values stand in quotes. Tables have plain numbers.");
  for (const si::Dimension& dimension : si::dimensions()) text += help_entry(dimension.name, units_of(dimension));
  return text + "\n" +
         help_paragraph(
             "mu, u0 and v0 have no unit here: mu is the radius of the patch over that of the ball, u0 and v0 "
             "are in any one unit of speed, and times are the paper's tau = (3 pi/2) f g t in that unit.");
}

std::string files() {
  std::string text = help_paragraph("Run files (--ball FILE.toml), such as 'contensou balls pool' prints:");
  std::string_view section;
  for (const si::Quantity* quantity : si::quantities()) {
    if (quantity->section != section) {
      section = quantity->section;
      text += fmt::format("[{}]\n", section);
      if (quantity == &si::mass) {
        text += help_entry("name", "text in quotes") +
                help_entry("body", "text in quotes: ball (default), hollow-ball, disc, puck or ring");
      }
      if (quantity == &si::friction) {
        text += help_entry("law", "text in quotes: the default of --law, a name or formulas") +
                help_entry("param", "the numbers in its formulas, as in param = {a = 2}: the default of --param");
      }
    }
    const std::string vector = quantity->components.empty() ? "" : fmt::format(", as [{}]", quantity->components);
    const std::string standard = quantity->standard ? fmt::format(" (default {})", *quantity->standard) : "";
    text +=
        help_entry(quantity->name, fmt::format("{}{}{}{}{}", quantity->meaning, quantity->unit.empty() ? "" : ", in ",
                                               quantity->unit, vector, standard));
  }
  text += "\n";
  for (const si::Ways& ways : si::alternatives()) {
    std::vector<std::string> names;
    for (const auto& way : ways) {
      std::vector<std::string_view> members;
      for (const si::Quantity* quantity : si::needed_of(way)) members.push_back(quantity->name);
      names.push_back(fmt::format("{}", fmt::join(members, " with ")));
    }
    text += help_paragraph(
        fmt::format("Give {}{}.", fmt::join(names, ", or "),
                    ways.front().front() == &si::patch_radius ? "; a disc or ring has its whole face without" : ""));
  }
  text += help_paragraph("mass may be left out. Energies, a load, moduli, a cue's stroke and engine need it.");
  return text + "\n" +
         help_paragraph(
             "Tables (--batch, --at, --against, --law FILE.csv): CSV with one header line; # begins a comment; - is "
             "standard input. 'contensou help VERB' names the columns that it reads and writes.") +
         "\n" +
         help_paragraph(
             "-o FILE is written whole or not at all, and replaces an older one; - is standard output. Its "
             "ending decides the format, which --format names where there is none. csv and json have all "
             "digits; text (ending txt) has --digits. npy is an array of NumPy's (sweep). Pictures are svg, "
             "pdf, png, eps, tex (pgfplots), gp (a gnuplot script with its data) and, of roll, gif (it moves; "
             "--samples N frames).");
}

std::string all_fields() {
  std::string text = help_paragraph(
      "Names of columns in CSV and of members in JSON. JSON also has schema, which is 1, and version. Lines of CSV "
      "that "
      "begin with # are comments. The members of an object are columns of their own. u, v and tau are in one unit of "
      "speed, which is m/s for a ball.");
  for (const VerbEntry& entry : verbs()) text += help_on_fields(entry);
  return text;
}

constexpr const char* theory_text =
    R"(The equations of V. F. Zhuravlev (1998) and their symmetry. A ball of radius R
slides and spins on a plane with coefficient of friction f; g is gravity.

    v >= 0         speed of the contact point; its direction is constant
    u = R omega_z  spin about the vertical times the radius
    mu             patch radius divided by R, at most 1
    k              ratio v/(mu |u|); it falls to 0
    tau            time: tau = (3 pi/2) f g t, with t in seconds

Equations of motion, with friction by the Pade law of the paper:

    du/dtau = -5 mu^2 u/(16 mu |u| + 15 pi v)
    dv/dtau = -7 v/(8 mu |u| + 3 pi v)                                     (2.6)

The time beta removes the denominators. For u > 0,

    du/dbeta = -5 mu^2 u (8 mu u + 3 pi v)
    dv/dbeta = -7 v (16 mu u + 15 pi v)                                    (2.7)
    tau = Int(0, beta) (16 mu u + 15 pi v) (8 mu u + 3 pi v) dbeta         (2.8)

Symmetry and its generator:

(2.6) does not change when u, v and tau are multiplied by one number. The
generator of this group for (2.6), and that for (2.7), are

    X = tau d/dtau + u d/du + v d/dv
    X = -beta d/dbeta + u d/du + v d/dv

Reduction to canonical coordinates q and p:

    q = v/u        does not change
    p = ln v       grows by the logarithm of that number

In q and p the variables of the equation of the orbits separate:

    dp/dq = (16 mu + 15 pi q)/(q (mu A + B q))
    A = 8 (2 - r),  B = 3 pi (5 - r),  r = 5 mu^2/7

First integral, constant along each motion:

    I = ln |u| - a ln k + (a - e) ln(A + B k),  a = r/(2 - r),  e = r/(5 - r)

Stop time, at which u and v vanish together:

    tau* = 16 |u|/(5 mu) + m(k) 3 pi v/7,  1 <= m <= 5/2
    m(k) = (5/k) Int(0, k) W(x)/W(k) (8 + 3 pi x)/(A + B x) dx
    W(x) = x^a (A + B x)^(e - a)

Theorem for any law of friction and any body: chapter "Theory" of theory.md.
Proofs and numerics: numerics.md. Both files are in share/doc/contensou of the
installation; in the sources they are reduction/README.md and numerics.md.
)";

/// The words of its headings, which are topics, too.
constexpr std::string_view theory_words[]{"equations", "symmetry", "generator", "reduction",
                                          "canonical", "integral", "theorem"};

std::string theory() { return theory_text; }

const Choices<std::string (*)()> topics{{"laws", laws},   {"views", views},       {"units", units},
                                        {"files", files}, {"fields", all_fields}, {"theory", theory}};

class HelpCommand final : public Verb {
 public:
  void add_options(CLI::App& app) override {
    root_ = app.get_parent();
    topic_.add(app, "TOPIC", "", "laws, views, units, files, fields, theory, or a verb (default: all verbs)",
               [this](const std::string& typed) { return text_on(typed); });
  }

  ExitStatus run() override {
    write_output("-", topic_.given() ? *topic_ : root_->get_formatter()->make_help(root_, "contensou", {}));
    return ExitStatus::done;
  }

 private:
  std::string text_on(const std::string& topic) const {
    std::vector<std::string> names;
    for (const auto& [name, text] : topics) {
      if (name == topic) return text();
      names.push_back(name);
    }
    for (const CLI::App* verb : root_->get_subcommands([](const CLI::App*) { return true; })) {
      if (verb->get_name() == topic) return verb->help("contensou");
      names.push_back(verb->get_name());
    }
    if (std::ranges::find(theory_words, topic) != std::end(theory_words)) return theory();
    throw no_such("topic", topic, names);
  }

  const CLI::App* root_ = nullptr;
  ArgumentOf<std::string> topic_;
};

const RegisteredVerb<HelpCommand> help_verb(Purpose::help, "help", "What an option takes, or the options of a verb",
                                            "contensou help units");

}  // namespace

}  // namespace contensou::program
