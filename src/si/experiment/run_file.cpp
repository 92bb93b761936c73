#include "contensou/si/run_file.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <sstream>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include "contensou/si/quantity.hpp"
#include "text/nearest_name.hpp"

namespace contensou::si {

namespace {

/// A table of the file, with its name for messages.
struct Section {
  std::string path;          ///< path as in the header; empty for the file itself
  const toml::table* table;  ///< null if the file does not contain the table
  toml::source_position position;
};

/// Returns the shortest digits that read back to the same double. From 1e6 on they have an exponent, because TOML reads
/// digits alone as a 64-bit integer.
std::string shortest(double value) {
  std::array<char, 32> digits{};
  char* const first = digits.data();
  char* const last = first + digits.size();
  const bool large = std::abs(value) >= 1e6;
  return {first, large ? std::to_chars(first, last, value, std::chars_format::scientific).ptr
                       : std::to_chars(first, last, value).ptr};
}

/// Returns the name of a key in messages: `key` in [section].
std::string called(const Section& section, std::string_view key) {
  return section.path.empty() ? fmt::format("'{:.80}'", key) : fmt::format("'{:.80}' in [{}]", key, section.path);
}

bool is_control(char c) { return static_cast<unsigned char>(c) < ' ' || c == 0x7f; }

constexpr std::size_t max_size = 1 << 16;
constexpr std::size_t max_depth = 16;

/// A place in a text that the parser must not read, and the reason.
struct Misfit {
  toml::source_position where;
  std::string reason;
};

/// Finds the first place of a text at which toml++ 3.3 would fail an assertion, have undefined behaviour or overflow
/// the stack instead of throwing parse_error. Such places are: a character that TOML allows only in strings and
/// comments, a string of several lines, quotes, brackets or '=' in wrong places, or deep nesting.
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

  /// Skips to the closing quote, or to the end of the line.
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
  std::string open_;       ///< open brackets
  bool assigned_ = false;  ///< true: the current key already has its '='
  std::size_t dots_ = 0;   ///< number of dots in the key that is being read
};

/// A key whose value is text, not a number.
struct WordKey {
  std::string_view section, key;
};
constexpr WordKey name_key{"ball", "name"}, body_key{"ball", "body"}, law_key{"contact", "law"},
    param_key{"contact", "param"};

/// Paths of the sections of standard deviations and of correlations.
constexpr std::string_view spreads_path = "uncertainty", correlation_key = "correlation",
                           correlation_path = "uncertainty.correlation";

class Reader {
 public:
  Reader(std::string_view source, const FindLaw& find_law) : source_(source), find_law_(find_law) {}

  Description read(std::string_view text) const {
    const toml::table document = parse(text);
    std::vector<Section> sections{{"", &document, {1, 1}}};
    std::map<std::string, std::string, std::less<>> places;
    for (const Quantity* quantity : quantities()) {
      if (places.contains(quantity->section)) continue;
      sections.push_back(section(sections, quantity->section));
      places.emplace(quantity->section, place(sections.back().position));
    }
    for (const std::string_view path : {spreads_path, correlation_path}) sections.push_back(section(sections, path));
    places.emplace(spreads_path, place(sections[sections.size() - 2].position));
    for (const Section& each : sections) require_known_keys(each, sections);

    Description described(std::move(places));
    for (const Quantity* quantity : quantities()) {
      const Section& parent = *std::ranges::find(sections, quantity->section, &Section::path);
      const auto found = parent.table->find(quantity->name);
      if (found == parent.table->end()) continue;
      const Source source{place(found->first.source().begin), fmt::format("'{}'", quantity->name),
                          fmt::format("[{}]", quantity->section)};
      described.set(*quantity, numbers(found->second, parent, *quantity), source);
    }
    const auto word = [&](WordKey of, auto take) {
      const Section& parent = *std::ranges::find(sections, of.section, &Section::path);
      if (const toml::node* node = parent.table->get(of.key))
        take(line_of(*node, parent, of.key), Source{place(node->source().begin), "", ""});
    };
    word(name_key, [&](const std::string& name, const Source&) { described.set_name(name); });
    word(body_key, [&](const std::string& name, const Source& source) { described.set_body(name, source); });
    const Section& contact = *std::ranges::find(sections, law_key.section, &Section::path);
    const std::string parameters = parameters_of(contact);
    word(law_key, [&](const std::string& law, const Source& source) {
      described.set_law(law + parameters);
      require_law(described.law(), source);
    });
    if (!parameters.empty() && described.law().empty()) {
      fail(
          contact.table->get(param_key.key)->source().begin,
          "[contact.param] is for the formulas of a law: add law = \"phi = F; psi = G\" to [contact], or leave it out");
    }
    read_spreads(described, sections);
    described.require_no_contradiction();
    return described;
  }

 private:
  void read_spreads(Description& described, const std::vector<Section>& sections) const {
    const Section& spreads = *std::ranges::find(sections, spreads_path, &Section::path);
    const Section& pairs = *std::ranges::find(sections, correlation_path, &Section::path);
    const auto source = [&](const toml::node& node) { return Source{place(node.source().begin), "", ""}; };
    for (const auto& [key, node] : *spreads.table) {
      if (key.str() == correlation_key) continue;
      const Component of = *find_component(key.str());
      described.require_given(of, source(node));
      const double value = described.find(*of.quantity)->numbers[of.index];
      described.add_spread(of, spread(node, spreads, of, value), source(node));
    }
    for (const auto& [key, node] : *pairs.table) {
      const Section row{fmt::format("{}.{}", correlation_path, key.str()), node.as_table(), node.source().begin};
      if (row.table == nullptr)
        fail(row.position, fmt::format("{0} must be a table of numbers: write {1} = {{NAME = 0.5}}",
                                       called(pairs, key.str()), key.str()));
      require_known_keys(row, {});
      for (const auto& [other, value] : *row.table)
        described.correlate(*find_component(key.str()), *find_component(other.str()),
                            plain_number(value, called(row, other.str()), nullptr), source(value));
    }
  }

  std::string place(toml::source_position where) const {
    return fmt::format("{}:{}:{}", source_, where.line, where.column);
  }

  [[noreturn]] void fail(toml::source_position where, std::string_view message) const {
    std::string shown(message);  // the message may quote control characters of the file
    std::ranges::replace_if(shown, is_control, '?');
    throw RunFileError(fmt::format("{}: {}", place(where), shown));
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

  /// Returns the section with a path; its table is null if missing. The parent is one of the sections `before`.
  Section section(const std::vector<Section>& before, std::string_view path) const {
    const std::size_t dot = path.rfind('.');
    const std::string_view of = dot == std::string_view::npos ? "" : path.substr(0, dot);
    const Section& parent = *std::ranges::find(before, of, &Section::path);
    static const toml::table none;
    const std::string_view key = path.substr(dot + 1);
    const toml::node* node = parent.table->get(key);
    if (node == nullptr) return {std::string(path), &none, parent.position};
    if (!node->is_table()) fail(node->source().begin, fmt::format("'{}' must be a table: write [{}]", key, path));
    return {std::string(path), node->as_table(), node->source().begin};
  }

  /// Throws if a key is no quantity, text or section.
  void require_known_keys(const Section& section, const std::vector<Section>& sections) const {
    std::vector<std::string> names;
    for (const WordKey& word : {name_key, body_key, law_key, param_key}) {
      if (word.section == section.path) names.emplace_back(word.key);
    }
    for (const Quantity* quantity : quantities()) {
      if (quantity->section == section.path) names.emplace_back(quantity->name);
    }
    if (section.path.starts_with(spreads_path)) names = uncertain_names();
    const std::string before = section.path.empty() ? "" : section.path + ".";
    for (const Section& other : sections) {
      if (other.path.size() > before.size() && other.path.starts_with(before) &&
          other.path.find('.', before.size()) == std::string::npos)
        names.push_back(other.path.substr(before.size()));
    }
    for (const auto& [key, node] : *section.table) {
      if (std::ranges::find(names, key.str()) != names.end()) continue;
      fail(key.source().begin,
           fmt::format("unknown {} {}{}; allowed: {}", node.is_table() ? "table" : "key", called(section, key.str()),
                       suggestion(key.str(), names), fmt::join(names, ", ")));
    }
  }

  std::string line_of(const toml::node& node, const Section& section, std::string_view key) const {
    if (!node.is_string())
      fail(node.source().begin, fmt::format("{} must be a string in quotes", called(section, key)));
    const std::string& text = node.as_string()->get();
    if (std::ranges::any_of(text, is_control)) {
      fail(node.source().begin,
           fmt::format("{} must be one line of text without control characters", called(section, key)));
    }
    return text;
  }

  /// Returns the numbers of [contact.param], in the form that a law's text has.
  std::string parameters_of(const Section& contact) const {
    const toml::node* node = contact.table->get(param_key.key);
    if (node == nullptr) return "";
    if (!node->is_table()) {
      fail(node->source().begin, "'param' must be a table of the numbers in law: write param = {a = 2}");
    }
    std::string text;
    for (const auto& [name, each] : *node->as_table()) {
      const auto value = each.value<double>();
      if (!each.is_number() || !std::isfinite(*value)) {
        fail(each.source().begin,
             fmt::format("{} must be a number", called({"contact.param", nullptr, {}}, name.str())));
      }
      text += fmt::format("; {} = {}", name.str(), *value);
    }
    return text;
  }

  void require_law(const std::string& text, const Source& source) const {
    try {
      if (find_law_(text)) return;
    } catch (const std::domain_error& error) {
      source.fail(error.what());
    }
    std::vector<std::string> names;
    for (const reduction::Law& known : reduction::named_laws()) names.push_back(known.name());
    source.fail(no_such("law", text, names));
  }

  double plain_number(const toml::node& node, const std::string& name, const Dimension* dimension,
                      std::string_view other = "") const {
    if (const auto* integer = node.as_integer()) return static_cast<double>(integer->get());
    if (const auto* real = node.as_floating_point()) return real->get();
    std::string ways = dimension ? units_of(*dimension) : "";
    if (!other.empty()) ways += fmt::format("{}{}", ways.empty() ? "" : ", or ", other);
    fail(node.source().begin,
         fmt::format("{} must be a number{}{}", name, dimension ? fmt::format(", in {}", dimension->symbol) : "",
                     ways.empty() ? "" : fmt::format(", or one in quotes with {} behind it", ways)));
  }

  double spread(const toml::node& node, const Section& section, const Component& of, double value) const {
    const std::string name = called(section, of.name());
    try {
      const auto* text = node.as_string();
      if (const auto read = text ? parse_spread(text->get(), of.quantity->unit, value) : std::nullopt) return *read;
    } catch (const std::domain_error& error) {
      fail(node.source().begin, fmt::format("{} {}", name, error.what()));
    }
    return plain_number(node, name, find_dimension(of.quantity->unit), "%");
  }

  double number(const toml::node& node, const Section& section, const Quantity& quantity) const {
    const Dimension* dimension = find_dimension(quantity.unit);
    const auto* text = node.as_string();
    const auto with_unit = text && dimension ? parse_quantity(text->get(), *dimension) : std::nullopt;
    const double value = with_unit ? *with_unit : plain_number(node, called(section, quantity.name), dimension);
    try {
      require(quantity, value);
    } catch (const std::domain_error& error) {
      fail(node.source().begin, error.what());
    }
    return value;
  }

  /// Returns the numbers of a vector. In the file it is an array.
  std::vector<double> numbers(const toml::node& node, const Section& section, const Quantity& quantity) const {
    const std::size_t count = quantity.count();
    if (count == 1) return {number(node, section, quantity)};
    const toml::array* array = node.as_array();
    if (array == nullptr || array->size() != count) {
      fail(node.source().begin, fmt::format("{} must be {} numbers in brackets: {}", called(section, quantity.name),
                                            count == 2 ? "two" : "three", quantity.meaning));
    }
    std::vector<double> values;
    for (const toml::node& each : *array) values.push_back(number(each, section, quantity));
    return values;
  }

  std::string_view source_;
  const FindLaw& find_law_;
};

std::string line(const Quantity& quantity, const std::vector<double>& values) {
  std::vector<std::string> texts;
  for (double value : values) texts.push_back(shortest(value));
  const bool one = values.size() == 1;
  return fmt::format("{} = {}{}{}  # {}{}{}\n", quantity.name, one ? "" : "[", fmt::join(texts, ", "), one ? "" : "]",
                     quantity.unit, quantity.unit.empty() ? "" : ", ", quantity.meaning);
}

std::string spreads_text(const Spreads& spreads) {
  if (spreads.empty()) return "";
  std::string text = fmt::format("\n[{}]  # standard deviations, for --uncertainty fit\n", spreads_path);
  std::string pairs;
  for (std::size_t i = 0; i < spreads.numbers.size(); ++i) {
    const auto& [of, standard] = spreads.numbers[i];
    const std::string_view unit = of.quantity->unit;
    text += fmt::format("{} = {}{}{}\n", of.name(), shortest(standard), unit.empty() ? "" : "  # ", unit);
    std::vector<std::string> row;
    for (std::size_t j = 0; j < i; ++j) {
      if (const double both = spreads.correlation(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
          both != 0)
        row.push_back(fmt::format("{} = {}", spreads.numbers[j].of.name(), shortest(both)));
    }
    if (!row.empty()) pairs += fmt::format("{} = {{{}}}\n", of.name(), fmt::join(row, ", "));
  }
  return pairs.empty() ? text : fmt::format("{}\n[{}]\n{}", text, correlation_path, pairs);
}

}  // namespace

Description parse_run_file(std::string_view text, std::string_view source, const FindLaw& find_law) {
  return Reader(source, find_law).read(text);
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

Description read_run_file(const std::string& path, const FindLaw& find_law) {
  return parse_run_file(read_run_text(path), path, find_law);
}

std::string run_file(const Experiment& experiment, std::string_view remark) {
  std::string text;
  std::istringstream lines{std::string(remark)};
  for (std::string comment; std::getline(lines, comment);) text += fmt::format("# {}\n", comment);
  const auto word = [](const WordKey& of, std::string_view value) {
    std::ostringstream quoted;
    quoted << toml::value<std::string>(std::string(value));
    return fmt::format("{} = {}\n", of.key, quoted.str());
  };
  std::string_view section;
  for (const auto& [quantity, values] : given_by(experiment)) {
    const bool begins = section != quantity->section;
    if (begins) text += fmt::format("{}[{}]\n", section.empty() ? "" : "\n", quantity->section);
    section = quantity->section;
    if (begins && section == name_key.section) {
      text += word(name_key, experiment.ball.name);
      if (experiment.ball.body.name != Body{}.name) text += word(body_key, experiment.ball.body.name);
    }
    text += line(*quantity, values);
    if (quantity == &friction && !experiment.contact.law.empty()) text += word(law_key, experiment.contact.law);
  }
  return text + spreads_text(experiment.spreads);
}

}  // namespace contensou::si
