#include <algorithm>
#include <cmath>
#include <deque>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <Eigen/Core>

#include "answers/asked/portrait_spec.hpp"
#include "answers/verbs/plane_answers.hpp"
#include "contensou/portraits/planar_portrait.hpp"
#include "options/law_option.hpp"
#include "options/output_options.hpp"
#include "options/route_option.hpp"
#include "options/start_options.hpp"
#include "options/system_option.hpp"
#include "verb.hpp"

namespace contensou::program {

namespace {

using Eigen::Vector2d;
using portraits::View;
using reduction::State;

/// Reads a window: "U,V" or "U1:U2,V1:V2".
void read_window(const std::string& typed, portraits::PortraitRequest& request) {
  if (typed.find(':') == std::string::npos) {
    const std::vector<double> sides = numbers(typed, 2, "U,V, or U1:U2,V1:V2");
    if (!(sides[0] > 0 && sides[1] > 0)) throw NotAllowed("both sides of the window must be positive");
    request.sides = Vector2d(sides[0], sides[1]);
    return;
  }
  portraits::Window& window = request.window.emplace();
  const std::vector<std::string> ranges = split(typed, ',');
  if (ranges.size() != 2) throw NotAllowed("a window is U,V or U1:U2,V1:V2");
  for (int i : {0, 1}) {
    const std::vector<std::string> ends = split(ranges[static_cast<std::size_t>(i)], ':');
    if (ends.size() != 2) throw NotAllowed("a window is U,V or U1:U2,V1:V2");
    window.low[i] = number(ends[0]);
    window.high[i] = number(ends[1]);
    if (!(window.low[i] < window.high[i])) throw NotAllowed("a side of the window begins below its end");
  }
}

/// Reads times: "T1,T2,..." or, for a single time, "T,".
std::vector<double> parse_times(const std::string& typed) {
  std::vector<std::string> parts = split(typed, ',');
  if (parts.size() > 1 && parts.back().empty()) parts.pop_back();
  constexpr std::size_t most = 100;
  if (parts.size() > most) throw NotAllowed("at most {} times are allowed", most);
  std::vector<double> times;
  for (const std::string& part : parts) {
    times.push_back(number(part));
    if (!(times.back() > 0)) throw NotAllowed("the time of an isochrone is above 0");
  }
  return times;
}

State parse_point(const std::string& typed) {
  const std::vector<double> pair = numbers(typed, 2, "U,V");
  return {pair[0], pair[1]};
}

/// Stores the value of an option in a variable.
template <class Target, class Read>
Argument::Take into(Target& target, Read read) {
  return [&target, read = std::move(read)](const std::string& typed) { target = read(typed); };
}

/// Reads a number of curves, from 0 to a limit.
auto at_most(int highest) {
  return [=](const std::string& typed) { return static_cast<int>(parse_integer(typed, 0, highest)); };
}

constexpr std::string_view uncoupled = "uncoupled";  // the value of --against for the textbook's model

/// Returns the fields of the data of a portrait. The library portraits writes these data.
std::vector<FieldText> portrait_fields() {
  return {
      {"CSV `kind`, `index`", "",
       "type of the line: orbit, highlight, through, isochrone; with --against also against_orbit, against_isochrone or "
       "uncoupled; with --system also separatrix and invariant. Number of the line within its type"},
      {"CSV `u`, `v`, `tau`", "speed",
       "states on the line; tau: time that is left until the stop. With --system it is the time until the centre, or inf "
       "if the motion does not reach the centre"},
      {"CSV `ln_v`, `k`", "", "natural logarithm of v, and ratio k = v/(mu |u|); not with --system"},
      {"CSV `beta`", "1/speed", "time beta since the first state of an orbit, with --view regularised"},
      {"CSV `t`", "s", "time that is left until the stop, with --ball"},
      {"JSON `portraits` [{`version`, ...}]", "",
       "list of portraits with the members below, if --mu or --law has several values"},
      {"JSON `window` [...]", "speed", "part of the plane of u and v that is drawn: [U, V] or [[U1, U2], [V1, V2]]"},
      {"JSON `orbits` [{`u`, `v`, `ln_v`, `k`, `beta`, `tau_left`}]", "as in CSV",
       "list of orbits, each with lists of its states and of the times left; ln_v, k and beta as in CSV"},
      {"JSON `isochrones` [{`tau_stop`, `u`, `v`}]", "speed", "lines on which the time left is tau_stop"},
      {"JSON `highlight`, `through`, `uncoupled` [...]", "",
       "orbit of the start, with --system a list of its parts in the window; orbits through the points of --through; "
       "motions of the uncoupled model, with --against uncoupled. Their form is that of an entry of orbits"},
      {"`law`, `mu`", "", "law of friction and ratio mu; columns of CSV only if --mu or --law has several values"},
      {"JSON `body` {`chi`, `gamma`}, `view`, `drive`", "",
       "inertia of the body; name of the view; constant force along the slip divided by f N, from --drive, rolling "
       "friction or a slope"},
      {"JSON `ball`, `seconds_per_tau`", "s/speed", "name of the ball; number of seconds in one unit of tau"},
      {"JSON `against` {...}", "", "law, orbits and isochrones under the law of --against"},
      {"JSON `system`, `variables` [...]", "",
       "equations of --system as typed, and their two letters. u and v stand for the letters in the other fields. The "
       "fields below are for --system"},
      {"JSON `kind`, `form`, `centre` [...]", "",
       "type of the centre; type of the solution as in reduce, absent for a scaling, and null if the orbits are computed "
       "in time steps; centre of the scaling symmetry, or null"},
      {"JSON `rays`, `switching` [...]", "",
       "as in reduce --system: rays with angle, attracts and to_centre; curves that motions do not cross, with the kind "
       "of their motion"},
      {"JSON `equilibria` [...], `equilibria_within`, `equilibria_complete`, `equilibria_curve`", "",
       "points of the window at which u and v do not change, with kind, eigenvalues and index as in reduce --system"},
      {"JSON `degree`, `radius`, `at_infinity` [...]", "",
       "with --view disc: degree of the polynomials, radius of the dotted circle, and equilibria at infinity, each with "
       "angle, kind, eigenvalues and index"},
      {"JSON `cycles` [...]", "",
       "limit cycles that were found: a point of each, its period, stable, and multiplier. The multiplier is the factor "
       "of a small distance from the cycle in a turn, or null if it is not certain"},
      {"JSON `separatrices` [...]", "",
       "orbits that begin or end in saddles, like an entry of orbits. manifold unstable: the orbit begins in a saddle; "
       "stable: it ends there; connection: it does both"},
      {"JSON `invariant`, `equilibria_lines`, `u_nullclines`, `v_nullclines` [...]", "",
       "curves on which the inverse integrating factor is 0; curves of equilibria; with --nullclines the curves on which "
       "u, or v, does not change"},
  };
}

class PortraitCommand final : public Verb {
 public:
  void add_options(CLI::App& app) override {
    system_.add(app);
    start_.take_several_mu();
    start_.add(app);
    start_.add_drive(app);
    law_.add(app, ". Several names, between commas, give as many portraits");
    route_.add(app, {reduction::Route::closed, reduction::Route::quadrature, reduction::Route::regularised});
    add_looks(app);
    output_.add(app);
    app.option_defaults()->group("Output");
    facts_.add(app, "--facts",
               "print a table instead of a picture: the limit of k at the stop, the singular points, and the "
               "directions in which orbits enter the origin");
    system_.argument().excludes(
        {&law_.argument(), &against_.argument(), &route_.argument(), scale_, &facts_},
        "only (2.6) has these. The plane of u and v is drawn; 'contensou reduce --system' says which rays, kind and "
        "times there are");
    system_.argument().excludes(start_.of_body(), "its numbers are in the formulas, or --param");
    facts_.excludes(united({looks_from(0), {&against_.argument()}}),
                    "facts describe the whole plane, without a picture");
    facts_.excludes({&route_.argument()}, "facts follow no orbit");
    estimate_.excludes({&against_.argument()}, "both would be dashed");
  }

  ExitStatus run() override {
    style_.estimate = estimate_;
    if (style_.estimate && request_.view != View::time) {
      throw BadInput("--estimate is drawn against time: add --view time, or leave it out");
    }
    return system_.given() ? run_system() : run_starts();
  }

 private:
  using Style = portraits::PortraitStyle;

  ExitStatus run_starts() {
    std::vector<GivenStart> starts;
    for (const reduction::Law& law : law_.read_several(start_.standard_law())) {
      std::ranges::move(start_.read_several(law), std::back_inserter(starts));
    }
    if (facts_) {
      if (starts.size() > 1) throw BadInput("--facts describe one plane: give one --mu and one --law");
      return print_facts(starts.front().system);
    }
    const Output output = read_output();
    require_half_plane();
    std::vector<PortraitSpec> questions;
    for (const GivenStart& start : starts) {
      const reduction::Route route = route_.read(start.system);
      if (route == reduction::Route::direct) {
        throw BadInput("--route direct: a portrait is drawn by closed, quadrature or regularised");
      }
      PortraitSpec& question = questions.emplace_back(
          PortraitSpec{.flow = start.flow(route == reduction::Route::quadrature),
                       .start = start_.without_motion() ? std::nullopt : std::optional(start.state),
                       .experiment = start.experiment,
                       .request = request_,
                       .style = style_});
      question.request.stepped = route == reduction::Route::regularised;
      if (against_.given() && against_.argument().text() == uncoupled) {
        question.request.uncoupled = true;
        if (start_.without_motion() && request_.through.empty()) {
          throw BadInput(
              "--against uncoupled is drawn beside a motion: give a start, such as --slip and --spin, or --through");
        }
      } else if (against_.given()) {
        question.request.comparison = against_.read(std::string(si::Body{}.law));
      }
    }
    const std::vector<portraits::PhasePortrait> portraits = portraits_of(questions);
    return write(output, portraits, questions.front().source(), [&] { return figure_of(questions, portraits); });
  }

  ExitStatus run_system() {
    const TypedSystem typed = system_.read(law_.parameters());
    if (style_.field == Style::Field::regularised) {
      throw BadInput("--field regularised shows (2.7); with --system give motion or none");
    }
    if (request_.view == View::uv) request_.view.reset();  // the plane itself
    const bool on_disc = request_.view == View::disc;
    if (request_.view && !on_disc) {
      throw BadInput(
          "--view {}: only (2.6) has this view. With --system the plane of u and v is drawn, or give --view disc",
          name(*request_.view));
    }
    reduction::SmoothField field = typed.field;
    if (on_disc) field.polynomials = typed.formulas.polynomials();
    if (on_disc && field.polynomials.empty()) {
      throw BadInput(
          "--view disc: the right sides are no polynomials of degree 24 or less, so that nothing is known at infinity. "
          "Leave --view out, and choose a large --window");
    }
    // Sample the field about a point of the window, or, without a window, at the distance of the start from 0.
    Vector2d around = request_.window
                          ? Vector2d(request_.window->low.cwiseAbs().cwiseMax(request_.window->high.cwiseAbs()))
                          : request_.sides.value_or(Vector2d(1, 1));
    around = reduction::valued_near(field, around);
    if (const auto start = system_.read_start(typed, start_)) {
      request_.highlight = {(*start)[0], (*start)[1]};
      if (!start->isZero(0)) around = *start;
    }
    request_.nullclines = nullclines_;
    const Output output = read_output();
    const auto compute = on_disc ? portraits::portrait_on_disc : portraits::planar_portrait;
    portraits::PlanarPortrait portrait = compute(reduction::reduce(field, around), system_.text(), request_);
    portrait.variables = typed.variables();
    portrait.parameters = law_.parameters();
    return write(output, portrait, {.version = CONTENSOU_VERSION}, [&] { return draw(portrait, style_); });
  }

  /// Reads destination and format of the result. Throws for options that have no effect on this result.
  Output read_output() {
    Output output = output_.read();
    require_picture(names_given(united({looks_from(first_of_drawing_), {&estimate_}})), output);
    style_.size = output_.size();
    return output;
  }

  /// @param draw  returns the figure of the portraits
  template <class Portraits, class Draw>
  ExitStatus write(const Output& output, const Portraits& all, const portraits::PortraitSource& source, Draw draw) {
    if (output.picture) return output_.write({draw()}, output);
    return output.write(output.format == "csv" ? to_csv(all, source) : to_json(all, source));
  }

  /// Throws for a window or a point that lies outside the half-plane.
  void require_half_plane() const {
    const auto& window = request_.window;
    if (window && window->low[1] < 0) window_->reject("here v is 0 or more: the plane is a half-plane");
    if (window && !shows_window(request_.view.value_or(View::uv)))
      window_->reject("this view takes U,V; only uv, patch and pair take U1:U2,V1:V2");
    for (const State& point : request_.through) {
      const std::string typed = fmt::format("--through {},{}", point.u, point.v);
      if (point.u == 0 || !(point.v > 0)) {
        throw BadInput(typed + ": U must not be 0 and V > 0; for a motion from an axis give --u0 and --v0");
      }
      const auto& sides = request_.sides;
      if ((sides && !(std::abs(point.u) <= (*sides)[0] && point.v <= (*sides)[1])) ||
          (window && !window->contains(point))) {
        throw BadInput("{}: outside the window {}; leave it out, or make it larger", typed, window_->typed());
      }
    }
  }

  /// Adds the options for the contents and the look of the portrait.
  void add_looks(CLI::App& app) {
    constexpr int max_orbits = 200;
    constexpr int max_isochrones = 100;
    const auto add = [&, this](const char* name, const char* value_name, const std::string& help, Argument::Take take,
                               bool repeatable = false) {
      return looks_.emplace_back().add(app, name, value_name, help, std::move(take), repeatable);
    };
    Choices<View> views;
    std::vector<std::string_view> names;
    for (View view : portraits::views()) {
      names.push_back(name(view));
      views.emplace_back(name(view), view);
    }
    app.option_defaults()->group("Picture");
    add("--view", "VIEW",
        fmt::format("{} (default uv); 'contensou help views' explains them. With --system, only disc",
                    fmt::join(names, ", ")),
        into(request_.view, one_of(views, "view")));
    view_ = &looks_.back();
    add("--scale", "SCALE",
        "axis of v in the views uv, patch and pair: linear, or bent (default for a ball with mu < 0.48), by a power of v",
        into(request_.linear, one_of<bool>({{"bent", false}, {"linear", true}})));
    scale_ = &looks_.back();
    add("--window", "U,V",
        "part of the plane to draw: |u| <= U and 0 <= v <= V (with --system |v| <= V). The form U1:U2,V1:V2 is for the "
        "views uv, patch, pair and for --system",
        [this](const std::string& typed) { read_window(typed, request_); });
    window_ = &looks_.back();
    add("--orbits", "N",
        fmt::format("number of orbits on each side of u = 0, 0 to {} (default 12); with --system, number of all orbits",
                    max_orbits),
        into(request_.orbits, at_most(max_orbits)));
    add(
        "--through", "U,V", "point of one more orbit to draw; may be repeated",
        [this](const std::string& typed) { request_.through.push_back(parse_point(typed)); }, true);
    add("--isochrones", "N|T1,T2,...",
        fmt::format("lines of equal stop time: about how many, 0 to {} (default 7), or a list of stop times, with "
                    "--ball in seconds. A list of one time is 'T,'",
                    max_isochrones),
        [this, read = at_most(max_isochrones)](const std::string& typed) {
          if (typed.find(',') != std::string::npos) {
            request_.isochrone_times = parse_times(typed);
          } else if (!typed.empty()) {
            request_.isochrones = read(typed);
          }
        })
        ->expected(0, 1);
    first_of_drawing_ = looks_.size();
    add("--arrows", "WHERE",
        "arrows on orbits: time (default; at equal steps of time), one (one arrow on each orbit), none",
        into(style_.arrows,
             one_of<Style::Arrows>(
                 {{"time", Style::Arrows::time}, {"one", Style::Arrows::one}, {"none", Style::Arrows::none}})));
    add("--field", "FIELD",
        "arrows of the direction of motion on a grid: motion, by (2.6); regularised, by (2.7); none (default). Their "
        "length grows with the logarithm of the speed",
        into(style_.field, one_of<Style::Field>({{"none", Style::Field::none},
                                                 {"motion", Style::Field::motion},
                                                 {"regularised", Style::Field::regularised},
                                                 {"", Style::Field::motion}})))
        ->expected(0, 1);
    add("--axes", "on|off", "straight orbits: the axes, and rays (default on)",
        into(style_.invariant, one_of<bool>({{"on", true}, {"off", false}})));
    add("--colour,--color", "BY",
        "colour of orbits: time (default; shows the time left until the stop) or none (one colour)",
        into(style_.colour_by_time, one_of<bool>({{"time", true}, {"none", false}})));
    nullclines_.add(app, "--nullclines", "with --system: add the curves u' = 0 and v' = 0");
    nullclines_.needs(system_.argument(), "is for typed equations");
    estimate_.add(app, "--estimate", "dashed: approximate solution for small mu, in --view time");
    against_.add_second(
        app, "--against", "LAW",
        "second law of friction, whose orbits are dashed; or uncoupled, the textbook's motion beside each requested one");
    add("--style", "STYLE", "colours: print (default), or screen (light on dark)",
        into(style_.screen, one_of<bool>({{"print", false}, {"screen", true}})));
  }

  /// Returns the options in looks_ from place `first` on.
  Arguments looks_from(std::size_t first) const {
    Arguments arguments;
    for (; first < looks_.size(); ++first) arguments.push_back(&looks_[first]);
    return arguments;
  }

  ExitStatus print_facts(const reduction::ReducedSystem& system) const {
    return output_.read(1).write(phase_plane_answer(system, answers::PlaneRows::points));
  }

  SystemOption system_;
  StartOptions start_;
  LawOption law_, against_;
  RouteOption route_;
  std::deque<Argument> looks_;
  std::size_t first_of_drawing_ = 0;  ///< options in looks_ from this place on change only the drawing, not the data
  /// Options in looks_ that are used by name.
  const Argument *window_ = nullptr, *view_ = nullptr, *scale_ = nullptr;
  portraits::PortraitRequest request_;
  Style style_;
  Flag facts_, estimate_, nullclines_;
  PictureOptions output_{{{"a portrait", with_pictures({}, {"csv", "json"}), "portrait.svg"},
                          {"a table of facts", answer_formats("text")}}};
};

const RegisteredVerb<PortraitCommand> portrait_verb(Purpose::draw, "portrait", "Draw a phase portrait",
                                                    "contensou portrait --mu 0.3 -o portrait.svg",
                                                    {{"", portrait_fields}, {"--facts", phase_plane_fields}},
                                                    {"u", "v", "mu", "k", "f, N", "tau", "stop", "(2.6), (2.7)",
                                                     "orbit", "ray"});

}  // namespace

}  // namespace contensou::program
