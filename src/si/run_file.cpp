#include "contensou/si/run_file.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <memory>
#include <optional>
#include <sstream>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include "contensou/reduction/laws.hpp"
#include "contensou/si/quantity.hpp"
#include "text/nearest_name.hpp"

namespace contensou::si {

namespace {

/// A table of the file with what messages need to know about it.
struct Section {
  std::string path;          ///< as in its header; empty for the file itself
  const toml::table* table;  ///< empty if the file does not have it
  toml::source_position position;
};

/// The shortest digits that read back to the same double; with an exponent from 1e6 on, because TOML takes digits alone
/// for a 64-bit integer.
std::string shortest(double value) {
  std::array<char, 32> digits{};
  char* const first = digits.data();
  char* const last = first + digits.size();
  const bool large = std::abs(value) >= 1e6;
  return {first, large ? std::to_chars(first, last, value, std::chars_format::scientific).ptr
                       : std::to_chars(first, last, value).ptr};
}

/// What the user calls a key: `key` in [section].
std::string place(const Section& section, std::string_view key) {
  return section.path.empty() ? fmt::format("'{:.80}'", key) : fmt::format("'{:.80}' in [{}]", key, section.path);
}

bool is_control(char c) { return static_cast<unsigned char>(c) < ' ' || c == 0x7f; }

constexpr std::size_t max_size = 1 << 16;
constexpr std::size_t max_depth = 16;

/// Text that is not for the parser, and why.
struct Misfit {
  toml::source_position where;
  std::string reason;
};

/// The first place of a text that toml++ 3.3 answers with a failed assertion, undefined behaviour or a stack overflow
/// instead of a parse_error: a character that TOML has only in strings and comments, a string of several lines, quotes,
/// brackets or '=' where TOML has none, or deep nesting.
class Screen {
 public:
  explicit Screen(std::string_view text) : rest_(text) {}

  std::optional<Misfit> misfit() {
    constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
    if (rest_.starts_with(byte_order_mark)) rest_.remove_prefix(byte_order_mark.size());
    for (char before = '\n', c; !rest_.empty(); before = contains(blanks, c) ? before : c) {
      c = rest_.front();
      if (c == '#') {
        skip(std::min(rest_.find('\n'), rest_.size()));
      } else if (contains("\"'[{", c) && !contains("=,[{\n", before)) {
        return Misfit{here_, fmt::format("{} has no place here: it begins a key or a value", c)};
      } else if (c == '"' || c == '\'') {
        if (rest_.starts_with(std::string(3, c))) return Misfit{here_, "text of several lines has no place here"};
        skip_string(c);
      } else if (!is_key_letter(c) && !contains(marks, c)) {
        return Misfit{here_,
                      fmt::format("not TOML: only letters, digits and _-{} stand outside quotes", visible_marks)};
      } else if (before == '\n' && open_.empty() && c == '[' && !header_begins_with_key()) {
        return Misfit{here_, "not TOML: a header is a name in brackets, such as [ball]"};
      } else {
        if (c == '[' || c == '{') open_ += c;
        if (c == ']' || c == '}') {
          if (!open_.ends_with(c == ']' ? '[' : '{')) return Misfit{here_, "not TOML: a bracket that closes none"};
          open_.pop_back();
        }
        if (c == '=' && (assigned_ || open_.ends_with('['))) return Misfit{here_, "not TOML: '=' follows no key"};
        assigned_ = c == '=' || (assigned_ && !contains("{,\n", c));
        if (c == '.') ++dots_;
        if (contains("[]{},=\n", c)) dots_ = 0;
        if (std::max(open_.size(), dots_) > max_depth) {
          return Misfit{here_, fmt::format("nested more than {} deep: no table of a run file is", max_depth)};
        }
        skip(1);
      }
    }
    return std::nullopt;
  }

 private:
  static constexpr std::string_view visible_marks = "+.:,=[]{}";
  static constexpr std::string_view marks = "+.:,=[]{} \t\r\n";
  static constexpr std::string_view blanks = " \t";

  static bool contains(std::string_view letters, char c) { return letters.find(c) != std::string_view::npos; }
  static bool is_key_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  }

  bool header_begins_with_key() const {
    std::string_view header = rest_.substr(rest_.starts_with("[[") ? 2 : 1);
    header.remove_prefix(std::min(header.find_first_not_of(blanks), header.size()));
    return header.empty() || is_key_letter(header.front()) || contains("\"']", header.front());
  }

  void skip(std::size_t bytes) {
    for (char c : rest_.substr(0, bytes)) {
      const bool within_letter = (static_cast<unsigned char>(c) & 0xC0) == 0x80;
      if (!within_letter) ++here_.column;
      if (c == '\n') here_ = {here_.line + 1, 1};
    }
    rest_.remove_prefix(bytes);
  }

  /// To the closing quote, or to the end of the line.
  void skip_string(char quote) {
    std::size_t end = 1;
    while (end < rest_.size() && rest_[end] != quote && rest_[end] != '\n') {
      end += quote == '"' && rest_[end] == '\\' ? 2 : 1;
    }
    const bool closed = end < rest_.size() && rest_[end] == quote;
    skip(std::min(closed ? end + 1 : end, rest_.size()));
  }

  std::string_view rest_;
  toml::source_position here_{1, 1};
  std::string open_;       ///< brackets
  bool assigned_ = false;  ///< the key that was read last has its '='
  std::size_t dots_ = 0;   ///< of the key that is being read
};

class Reader {
 public:
  Reader(std::string_view source, const Overrides& overrides, const StartOverride& start)
      : source_(source), overrides_(overrides), start_(start) {}

  Experiment read(std::string_view text) const {
    const toml::table document = parse(text);
    const Section file{"", &document, {1, 1}};
    const Section ball = section(file, "ball");
    const Section contact = section(file, "contact");
    const Section start = section(file, "start");
    const Section environment = section(file, "environment");
    allow(file, {"ball", "contact", "start", "environment"});
    allow(ball, {"name", "body", mass.name, radius.name});
    allow(contact, {friction.name, patch_radius.name, spin_deceleration.name, "hertz", "law"});
    allow(start, {slip.name, spin.name, velocity.name, angular_velocity.name});
    allow(environment, {gravity.name, load.name});

    const Experiment experiment{
        .ball = {.name = line_of(ball, "name", "ball"),
                 .mass = number(ball, mass),
                 .radius = number(ball, radius),
                 .body = body(ball)},
        .contact = {.friction = number(contact, friction), .patch = patch(contact, body(ball)), .law = law(contact)},
        .start = start_of(start),
        .environment = {.gravity = gravity_of(environment, ball)},
    };
    // Of values that the file does not have it is not the place.
    if (overrides_.empty()) {
      at(contact.position, [&] { require_experiment(experiment); });
    } else {
      require_experiment(experiment);
    }
    return experiment;
  }

 private:
  [[noreturn]] void fail(toml::source_position where, std::string_view message) const {
    std::string shown(message);  // it may quote the file
    std::ranges::replace_if(shown, is_control, '?');
    throw RunFileError(fmt::format("{}:{}:{}: {}", source_, where.line, where.column, shown));
  }

  /// Gives the complaint of a check a place in the file.
  template <class Check>
  void at(toml::source_position where, Check check) const {
    try {
      check();
    } catch (const std::domain_error& error) {
      fail(where, error.what());
    }
  }

  toml::table parse(std::string_view text) const {
    if (text.size() > max_size) {
      throw RunFileError(fmt::format("{}: too long for a run file, which has at most {} bytes", source_, max_size));
    }
    if (const auto misfit = Screen(text).misfit()) fail(misfit->where, misfit->reason);
    try {
      return toml::parse(text);
    } catch (const toml::parse_error& error) {
      fail(error.source().begin, fmt::format("not TOML: {}", error.description()));
    }
  }

  Section section(const Section& parent, std::string_view key) const {
    const std::string path = parent.path.empty() ? std::string(key) : fmt::format("{}.{}", parent.path, key);
    static const toml::table none;
    const toml::node* node = parent.table->get(key);
    if (node == nullptr) return {path, &none, parent.position};
    if (!node->is_table()) fail(node->source().begin, fmt::format("'{}' must be a table: write [{}]", key, path));
    return {path, node->as_table(), node->source().begin};
  }

  void allow(const Section& section, std::initializer_list<std::string_view> keys) const {
    const std::vector<std::string> names(keys.begin(), keys.end());
    for (const auto& [key, node] : *section.table) {
      if (std::ranges::find(names, key.str()) != names.end()) continue;
      fail(key.source().begin,
           fmt::format("unknown {} {}{}; allowed: {}", node.is_table() ? "table" : "key", place(section, key.str()),
                       suggestion(key.str(), names), fmt::join(names, ", ")));
    }
  }

  std::string line_of(const Section& section, std::string_view key, std::string_view standard) const {
    const toml::node* node = section.table->get(key);
    if (node == nullptr) return std::string(standard);
    if (!node->is_string()) {
      fail(node->source().begin, fmt::format("{} must be a string in quotes", place(section, key)));
    }
    const std::string& text = node->as_string()->get();
    if (std::ranges::any_of(text, is_control)) {
      fail(node->source().begin,
           fmt::format("{} must be one line of text without control characters", place(section, key)));
    }
    return text;
  }

  Body body(const Section& ball) const {
    const std::string typed = line_of(ball, "body", "ball");
    std::vector<std::string> names;
    for (const Body& body : bodies()) {
      if (!body.lies_flat() && body.name != "ball") continue;  // the strokes and the textbook are of a solid ball
      if (body.name == typed) return body;
      names.emplace_back(body.name);
    }
    fail(ball.table->get("body")->source().begin,
         fmt::format("no such body '{:.80}'{}; bodies: {}", typed, suggestion(typed, names), fmt::join(names, ", ")));
  }

  std::string law(const Section& contact) const {
    const std::string name = line_of(contact, "law", "");
    if (name.empty()) return name;
    try {
      if (reduction::find_law(name)) return name;
    } catch (const std::domain_error& error) {
      fail(contact.table->get("law")->source().begin, error.what());
    }
    std::vector<std::string> names;
    for (const reduction::Law& known : reduction::named_laws()) names.push_back(known.name());
    fail(contact.table->get("law")->source().begin,
         fmt::format("no such law '{:.80}'{}; laws: {}", name, suggestion(name, names), fmt::join(names, ", ")));
  }

  double number(const toml::node& node, const Section& section, const Quantity& quantity) const {
    const Dimension* dimension = find_dimension(quantity.unit);
    const auto* text = node.as_string();
    double value = 0;
    if (const auto with_unit = text && dimension ? parse_quantity(text->get(), *dimension) : std::nullopt) {
      value = *with_unit;
    } else if (const auto* integer = node.as_integer()) {
      value = static_cast<double>(integer->get());
    } else if (const auto* real = node.as_floating_point()) {
      value = real->get();
    } else {
      fail(node.source().begin, fmt::format("{} must be a number{}", place(section, quantity.name),
                                            dimension ? fmt::format(", in {0}, or one in quotes with {1} behind it",
                                                                    quantity.unit, units_of(*dimension))
                                                      : ""));
    }
    at(node.source().begin, [&] { require(quantity, value); });
    return value;
  }

  double number(const Section& section, const Quantity& quantity, std::optional<double> standard = {}) const {
    if (const auto found = overrides_.find(quantity.name); found != overrides_.end()) return found->second;
    const toml::node* node = section.table->get(quantity.name);
    if (node != nullptr) return number(*node, section, quantity);
    if (standard) return *standard;
    fail(section.position, fmt::format("{} is missing: {}{}{}", place(section, quantity.name), quantity.meaning,
                                       quantity.unit.empty() ? "" : ", in ", quantity.unit));
  }

  template <std::size_t Count>
  std::array<double, Count> numbers(const Section& section, const Quantity& quantity) const {
    static_assert(Count == 2 || Count == 3);
    const toml::node* node = section.table->get(quantity.name);
    if (node == nullptr) {
      fail(section.position, fmt::format("{} is missing: {}", place(section, quantity.name), quantity.meaning));
    }
    const toml::array* array = node->as_array();
    if (array == nullptr || array->size() != Count) {
      fail(node->source().begin, fmt::format("{} must be {} numbers in brackets: {}", place(section, quantity.name),
                                             Count == 2 ? "two" : "three", quantity.meaning));
    }
    std::array<double, Count> values{};
    for (std::size_t i = 0; i < Count; ++i) values[i] = number((*array)[i], section, quantity);
    return values;
  }

  /// By gravity, or by the load over the mass.
  double gravity_of(const Section& environment, const Section& ball) const {
    const bool load_given = overrides_.contains(load.name);
    const bool gravity_given = overrides_.contains(gravity.name);
    if (load_given && gravity_given) {
      throw std::domain_error("a load and a gravity exclude each other: give one of them");
    }
    const bool load_in_file = environment.table->contains(load.name);
    if (load_in_file && environment.table->contains(gravity.name)) {
      fail(environment.position, "'load' and 'gravity' in [environment] exclude each other: give one of them");
    }
    return load_given || (load_in_file && !gravity_given) ? number(environment, load) / number(ball, mass)
                                                          : number(environment, gravity, Environment{}.gravity);
  }

  Start start_of(const Section& start) const {
    if (start_.velocity && start_.angular_velocity) return Velocities{*start_.velocity, *start_.angular_velocity};
    Start given = given_start(start);
    if (!start_.velocity && !start_.angular_velocity) return given;
    auto [centre, body] = velocities_of(given);
    return Velocities{start_.velocity.value_or(centre), start_.angular_velocity.value_or(body)};
  }

  /// slip and spin, or velocity and angular_velocity; never both.
  Start given_start(const Section& start) const {
    const auto key_of = [&](const Quantity& quantity) -> const toml::key* {
      const auto found = start.table->find(quantity.name);
      return found == start.table->end() ? nullptr : &found->first;
    };
    const toml::key* general = key_of(velocity) != nullptr ? key_of(velocity) : key_of(angular_velocity);
    if (general == nullptr) return SlipAndSpin{.slip = number(start, slip), .spin = number(start, spin)};
    for (const Quantity* quantity : {&slip, &spin}) {
      const toml::key* key = key_of(*quantity);
      if (key == nullptr && !overrides_.contains(quantity->name)) continue;
      fail((key == nullptr ? general : key)->source().begin,
           fmt::format("'{}' and '{}' in [start] exclude each other: give slip and spin, or velocity and "
                       "angular_velocity",
                       quantity->name, general->str()));
    }
    const auto [x, y] = numbers<2>(start, velocity);
    const auto [wx, wy, wz] = numbers<3>(start, angular_velocity);
    return Velocities{{x, y}, {wx, wy, wz}};
  }

  PatchSource patch(const Section& contact, const Body& body) const {
    const bool radius_given = overrides_.contains(patch_radius.name);
    const bool deceleration_given = overrides_.contains(spin_deceleration.name);
    if (radius_given && deceleration_given) {
      throw std::domain_error("a patch radius and a spin deceleration exclude each other: give one of them");
    }

    std::vector<std::string_view> given;
    for (std::string_view key : {patch_radius.name, spin_deceleration.name, std::string_view("hertz")}) {
      if (contact.table->contains(key)) given.push_back(key);
    }
    const bool overridden = radius_given || deceleration_given;
    if (body.lies_flat() && given.empty() && !overridden) return WholeFace{};
    if (given.size() > 1 || (given.empty() && !overridden)) {
      fail(contact.position, fmt::format("[contact] must have exactly one of patch_radius, spin_deceleration and the "
                                         "table [contact.hertz]; it has {}",
                                         given.empty() ? "none" : fmt::format("{}", fmt::join(given, " and "))));
    }
    if (radius_given) return PatchRadius{number(contact, patch_radius)};
    if (deceleration_given) return SpinDeceleration{number(contact, spin_deceleration)};
    if (given.front() == patch_radius.name) return PatchRadius{number(contact, patch_radius)};
    if (given.front() == spin_deceleration.name) return SpinDeceleration{number(contact, spin_deceleration)};
    const Section hertz = section(contact, "hertz");
    allow(hertz, {youngs_modulus.name, poisson_ratio.name});
    return HertzModuli{.youngs_modulus = numbers<2>(hertz, youngs_modulus),
                       .poisson_ratio = numbers<2>(hertz, poisson_ratio)};
  }

  std::string_view source_;
  const Overrides& overrides_;
  const StartOverride& start_;
};

std::string line(const Quantity& quantity, const std::vector<double>& values) {
  std::vector<std::string> texts;
  for (double value : values) texts.push_back(shortest(value));
  const bool one = values.size() == 1;
  return fmt::format("{} = {}{}{}  # {}{}{}\n", quantity.name, one ? "" : "[", fmt::join(texts, ", "), one ? "" : "]",
                     quantity.unit, quantity.unit.empty() ? "" : ", ", quantity.meaning);
}

}  // namespace

Experiment parse_run_file(std::string_view text, std::string_view source, const Overrides& overrides,
                          const StartOverride& start) {
  for (const auto& [name, value] : overrides) {
    const Quantity* known = nullptr;
    for (const Quantity* quantity :
         {&mass, &radius, &friction, &patch_radius, &spin_deceleration, &slip, &spin, &gravity, &load}) {
      if (quantity->name == name) known = quantity;
    }
    if (known == nullptr) throw std::domain_error(fmt::format("parse_run_file: no value is called '{}'", name));
    require(*known, value);
  }
  return Reader(source, overrides, start).read(text);
}

std::string read_run_text(const std::string& path) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  std::string text(max_size + 1, '\0');
  if (file) text.resize(std::fread(text.data(), 1, text.size(), file.get()));
  if (!file || std::ferror(file.get()) != 0) {
    throw std::system_error(errno, std::generic_category(), "cannot read " + path);
  }
  return text;
}

Experiment read_run_file(const std::string& path, const Overrides& overrides, const StartOverride& start) {
  return parse_run_file(read_run_text(path), path, overrides, start);
}

std::string run_file(const Experiment& experiment, std::string_view remark) {
  std::string text;
  std::istringstream lines{std::string(remark)};
  for (std::string comment; std::getline(lines, comment);) text += fmt::format("# {}\n", comment);
  std::ostringstream name;
  name << toml::value<std::string>(experiment.ball.name);
  const std::string_view body = experiment.ball.body.name;

  const auto add = [&](const std::vector<GivenQuantity>& given) {
    for (const auto& [quantity, values] : given) text += line(*quantity, values);
  };
  const auto& [ball, contact, start, environment] = experiment;
  text += fmt::format("[ball]\nname = {}\n", name.str());
  if (body != "ball") text += fmt::format("body = \"{}\"\n", body);
  add({{&mass, {ball.mass}}, {&radius, {ball.radius}}});
  text += "\n[contact]\n" + line(friction, {contact.friction});
  if (!contact.law.empty()) text += fmt::format("law = \"{}\"\n", contact.law);
  if (std::holds_alternative<HertzModuli>(contact.patch)) text += "\n[contact.hertz]\n";
  add(given_by(contact.patch));
  text += "\n[start]\n";
  add(given_by(start));
  text += "\n[environment]\n" + line(gravity, {environment.gravity});
  return text;
}

}  // namespace contensou::si
