#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "answers/asked/formula_law.hpp"
#include "answers/table/answer.hpp"
#include "contensou/portraits/phase_portrait.hpp"
#include "contensou/si/quantity.hpp"
#include "options/output_options.hpp"
#include "options/start_options.hpp"
#include "output/help.hpp"
#include "platform/output_file.hpp"
#include "verb.hpp"

namespace contensou::program {

namespace {

std::string laws() {
  std::string text = help_paragraph(
      "Laws of friction, for --law. A law consists of two functions of k = v/(mu |u|), the slip divided by the rim "
      "speed of the patch. Phi is the force of friction divided by f N, with coefficient of friction f and load N. Psi "
      "is the moment of friction divided by f N and by the patch radius. Most laws follow from a pressure in the "
      "patch. It depends on rho, the distance from the centre divided by the patch radius. Other laws follow from a "
      "limit surface, the curve of Psi against Phi.");
  for (const auto& [name, meaning] : law_forms()) text += help_entry(name, meaning);
  return text + "\n" +
         help_paragraph(
             "The pressure of FILE.csv is linear in rho^2 between two rows. Two rows with one value of rho make a "
             "step. The laws annulus and soft are such tables. 'contensou stop' also prints the result without every "
             "second row, which shows the error of interpolation.");
}

std::string typed_formulas() {
  std::string text = help_paragraph(
      "Equations for --system, in any letters. A system has two equations of first order. One equation may have the "
      "first or the second order. It may be linear in its highest derivative, as in the examples:");
  constexpr std::pair<std::string_view, std::string_view> examples[]{
      {"x' = y; y' = -x", "system; also dx/dt = y; dy/dt = -x, and x'(t) = y(t); y'(t) = -x(t)"},
      {"y' = x - y", "first order; also dy/dx = x - y, y' + y = x and (x - y) dx - dy = 0"},
      {"x'' + 0.1x' + x = 0", "second order; also d^2x/dt^2 = -x - 0.1 dx/dt"},
      {"x' = a*x*y; y' = -y; a = 2", "parameter with its value; also --param a=2"}};
  for (const auto& [equation, meaning] : examples) text += help_entry(equation, meaning);
  text += "\n" + help_paragraph(
                     "The independent letter is the one of dy/dx or y'(x). Otherwise it is t. In one equation of first "
                     "order it is the other letter. The right sides of a system and of an equation of second order "
                     "must not contain it. --start gives the start in the typed letters, as in \"x=1, x'=0\".");
  text += "\n" + help_paragraph("Formulas, for --system, --law and --basis, contain numbers, pi and:");
  constexpr std::pair<std::string_view, std::string_view> parts[]{
      {"+ - * / ^", "operators; ** means ^. The sign * may be left out before a name or a bracket: 2x, x y, x(1 - y)"},
      {"sin cos tan asin acos atan",
       "functions; also sinh cosh tanh asinh acosh atanh exp sqrt, ln and log (both "
       "natural), log2 log10, atan2(y, x), hypot(x, y)"},
      {"abs(x) or |x|, sign rint min max", "functions with kinks or jumps; rint is the nearest whole number"},
      {"x < y ? a : b", "choice; < > <= >= == != && || ! are 1 if true, else 0"}};
  for (const auto& [sign, meaning] : parts) text += help_entry(sign, meaning);
  return text + "\n" +
         help_paragraph(
             "Equations that jump, as x'' = -x - 0.2*sign(x'), are solved by Filippov's definition. A motion that is "
             "led to the jump from both sides slides along it. It rests there if the sliding speed is 0. If the "
             "motions on both sides point away from the jump, the motion is not unique, and none is chosen.");
}

std::string views() {
  std::string text = help_paragraph(
      "Views of a portrait, for --view. u is the spin omega_z times the radius R of the body, v the sliding speed, mu "
      "the patch radius divided by R, and k = v/(mu |u|). 'contensou help theory' prints the equations (2.7).");
  for (portraits::View view : portraits::views()) text += help_entry(name(view), axes(view));
  text += help_paragraph(
      "--system has the plane of u and v and, for polynomials, the view disc: the whole plane in a disc with infinity as "
      "its circle. Equilibria at infinity are marked with their kinds, and the dotted circle has a known radius.");
  return text;
}

std::string units() {
  std::string text = help_paragraph(
      "An option in SI units takes a unit after its number, as in --slip \"2 m/s\", --spin 300rpm or --radius \"2.25 "
      "in\". A number without a unit has the first unit of its line in this list. A unit after a list of numbers "
      "applies to all of them. In a range the unit stands before the count, as in --spin \"0:60 rpm:3\". In run files "
      "a value with a unit stands in quotes. A number without a unit may be a formula of numbers, as 2/3 or 2*pi; an "
      "angle may not.");
  for (const si::Dimension& dimension : si::dimensions()) text += help_entry(dimension.name, units_of(dimension));
  return text + "\n" +
         help_paragraph(
             "mu, u0 and v0 take no unit. mu is the patch radius divided by the radius of the body. u0 (spin times "
             "radius) and v0 (slip) are in any common unit of speed. Times are then tau = (3 pi/2) f g t in that unit, "
             "with coefficient of friction f, gravity g and time t.");
}

std::string files() {
  std::string text = help_paragraph(
      "A run file, for --ball FILE.toml, contains the values of a body, its contact and its start. 'contensou balls "
      "pool' prints one. Sections and keys:");
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
        text += help_entry("law", "text in quotes: name or formulas of the law, used without --law") +
                help_entry("param", "parameters of the formulas, used without --param, as in param = {a = 2}");
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
    text += help_paragraph(fmt::format(
        "Give {}{}.", fmt::join(names, ", or "),
        ways.front().front() == &si::patch_radius ? "; a disc or ring touches with its whole face by default" : ""));
  }
  text += help_paragraph("mass is optional. It is needed for energies, a load, moduli, --strike and the verb engine.");
  return text + "\n" +
         help_paragraph(
             "Tables (--batch, --at, --against, --law FILE.csv) are CSV with one header line. # begins a comment; - is "
             "standard input. 'contensou help VERB' names the columns.");
}

std::string all_fields() {
  std::string text = help_paragraph(
      "Names of columns in CSV and of members in JSON. An entry without CSV or JSON belongs to both. JSON also has "
      "schema, which is 1, and version. Lines of CSV that begin with # are comments. In CSV the members of an object "
      "are columns of their own. in: marks a column of the input, out: a column of the output. The unit stands in "
      "brackets at the end. u, v and tau are in one unit of speed, which is m/s for a ball.");
  text += help_on_words();
  for (const VerbEntry& entry : verbs()) text += help_on_fields(entry, true);
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

Theorem for any law of friction and any body: theory.md. Proofs and numerics:
numerics.md. Any two equations: planar.md. These files are in the folder
reduction of the sources, and in share/doc/contensou/reduction if installed.
)";

/// Words in the headings of `help theory`, which are topics, too.
constexpr std::string_view theory_words[]{"equations", "symmetry", "generator", "reduction",
                                          "canonical", "integral", "theorem"};

std::string theory() { return theory_text; }

/// @param add  adds the options of a group to a command line
template <class Add>
std::string options(const std::string& words, const std::string& group, Add add) {
  CLI::App app;
  add(app);
  return help_paragraph(words) + help_on_group(app, group);
}

std::string ball() {
  StartOptions start;
  start.take_load_history();
  return options(
      "--body CHI,GAMMA gives the inertia of a body of mass m and radius R. chi is 1 + m R^2/J, with the moment of "
      "inertia J about a horizontal axis; chi is 1 for a body that cannot roll. gamma is m R^2/J_z, with the moment of "
      "inertia J_z about the vertical. --drive RHO is a constant force along the slip, divided by the coefficient of "
      "friction f and the load. Rolling resistance with the coefficient u_r has RHO = u_r/f. A body that slides "
      "straight down a slope has RHO = tan(angle)/(chi f). Each of the following options replaces a value of the body "
      "that --ball names. In stop, roll, aim, engine, bounce and check, --radius, --mass, --friction and, for a ball, "
      "--patch-radius also describe a body without --ball; --body is its kind. A verb offers the options that it uses. 'contensou balls' lists the built-in bodies, "
      "'contensou help files' describes run files, 'contensou help units' lists the units.",
      ball_group(), [&](CLI::App& app) { start.add_ball(app); });
}

std::string picture() {
  FigureOptions figure;
  return options(
      "Pictures are written as svg, pdf, png, eps, tex (pgfplots) and gp (a gnuplot script with its data); those "
      "of roll also as gif. All but tex and gp are drawn by gnuplot. These options set size and font:",
      figure_group(), [&](CLI::App& app) { figure.add(app); });
}

std::string output() {
  OutputOptions output{{{"an answer", answer_formats("text")}}};
  BulkOptions bulk;
  std::string text = options(
      "-o FILE names the output file, which is written whole or not at all; - is standard output. The ending of FILE "
      "decides the format; without an ending --format decides. csv and json contain all digits. npy is an array of "
      "NumPy. Messages and progress go to standard error.",
      usual_group(), [&](CLI::App& app) {
        output.add(app);
        bulk.add(app);
      });
  return text + help_entry("-h, --help", "print the help of the verb") + "\n" + help_paragraph(exit_statuses);
}

const Choices<std::string (*)()> topics{{"ball", ball},       {"laws", laws},     {"formulas", typed_formulas},
                                        {"picture", picture}, {"output", output}, {"views", views},
                                        {"units", units},     {"files", files},   {"fields", all_fields},
                                        {"theory", theory}};

std::vector<std::string> names_of_topics() {
  std::vector<std::string> names;
  for (const auto& [name, text] : topics) names.push_back(name);
  return names;
}

class HelpCommand final : public Verb {
 public:
  void add_options(CLI::App& app) override {
    root_ = app.get_parent();
    topic_.add(app, "TOPIC", "", fmt::format("{}, or a verb (default: all verbs)", fmt::join(names_of_topics(), ", ")),
               [this](const std::string& typed) { return text_on(typed); });
  }

  ExitStatus run() override {
    write_output("-", topic_.given() ? *topic_ : root_->get_formatter()->make_help(root_, "contensou", {}));
    return ExitStatus::done;
  }

 private:
  std::string text_on(const std::string& topic) const {
    for (const auto& [name, text] : topics) {
      if (name == topic) return text();
    }
    std::vector<std::string> names = names_of_topics();
    for (const CLI::App* verb : root_->get_subcommands([](const CLI::App*) { return true; })) {
      if (verb->get_name() == topic) return verb->help("contensou");
      names.push_back(verb->get_name());
    }
    if (std::ranges::find(theory_words, topic) != std::end(theory_words)) return theory();
    throw NotAllowed(no_such("topic", topic, names, false));
  }

  const CLI::App* root_ = nullptr;
  ArgumentOf<std::string> topic_;
};

const RegisteredVerb<HelpCommand> help_verb(Purpose::help, "help", "Explain a topic, or the options of a verb",
                                            "contensou help units");

}  // namespace

}  // namespace contensou::program
