#include "output/formula.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace contensou::program {

namespace {

/// What is written for a command that takes no argument. All other words are written as they are called.
constexpr std::array<std::pair<std::string_view, std::string_view>, 23> symbols{{
    {"varepsilon", "eps"}, {"infty", "inf"},   {"ast", "*"},   {"to", "->"},   {"le", "<="},
    {"ge", ">="},          {"sim", "~"},       {"cdot", "."},  {"quad", "  "}, {"qquad", "\n"},
    {"\\", "\n"},          {"thinspace", " "}, {",", " "},     {";", " "},     {"left", ""},
    {"right", ""},         {"lvert", "|"},     {"rvert", "|"}, {"begin", ""},  {"end", ""},
    {"dots", "..."},       {"int", "Int"},     {"!", ""},
}};

constexpr std::array<std::string_view, 24> words{"Phi", "Psi", "Delta", "alpha", "beta", "gamma", "chi", "mu",
                                                 "pi",  "tau", "omega", "xi",    "eta",  "rho",   "ln",  "exp",
                                                 "max", "min", "cos",   "sin",   "sim",  "theta", "nu",  "lim"};

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }
bool is_alnum(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

/// Whether a denominator or an exponent needs no parentheses: a name, a number, or a function's value such as Psi(0).
bool is_one_word(std::string_view text) {
  if (text.ends_with(')') && !text.starts_with('(')) text = text.substr(0, text.find('('));
  return std::ranges::all_of(text, [](char c) { return is_alnum(c) || c == '_' || c == '\'' || c == '*'; });
}

bool is_sum(std::string_view text) {
  int depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    depth += text[i] == '(' || text[i] == '[' ? 1 : text[i] == ')' || text[i] == ']' ? -1 : 0;
    if (depth == 0 && i > 0 && text[i - 1] == ' ' && (text[i] == '+' || text[i] == '-')) return true;
  }
  return false;
}

class Formula {
 public:
  explicit Formula(std::string_view tex) : tex_(tex) {}

  std::string all() {
    std::string text = sequence();
    if (at_ < tex_.size()) fail();
    return text;
  }

  std::string tag;

 private:
  [[noreturn]] void fail() const {
    throw std::logic_error(fmt::format("plain_formula: '{}' in {}", tex_.substr(at_, 12), tex_));
  }

  char next() const { return at_ < tex_.size() ? tex_[at_] : '\0'; }

  std::string sequence() {
    std::string text;
    bool after_word = false;  // whose end a letter must not touch
    while (at_ < tex_.size() && next() != '}') {
      const char c = next();
      if (c == '\\') {
        const std::string piece = command();
        const bool differential = text.ends_with('d') && (text.size() < 2 || !is_alnum(text[text.size() - 2]));
        const bool touches = !text.empty() && (is_alnum(text.back()) || text.back() == '\'' || text.back() == '*');
        if (!piece.empty() && is_letter(piece.front()) && (touches || text.ends_with(')')) && !differential)
          text += ' ';
        text += piece;
        after_word = !piece.empty() && is_alnum(piece.back()) && piece != "d";
        continue;
      }
      if (std::isspace(static_cast<unsigned char>(c)) != 0) {
        ++at_;
        if (!text.empty() && text.back() != ' ' && text.back() != '\n') text += ' ';
      } else if (c == '&') {
        ++at_;
      } else if (c == '_' || c == '^') {
        ++at_;
        text += script(c);
      } else {
        if (after_word && is_alnum(c)) text += ' ';
        text += argument();
      }
      after_word = false;
    }
    return text;
  }

  /// A group in braces, a command, or one character.
  std::string argument() {
    while (next() == ' ') ++at_;
    if (next() == '\\') return command();
    if (next() != '{') return std::string(1, at_ < tex_.size() ? tex_[at_++] : (fail(), '\0'));
    ++at_;
    std::string text = sequence();
    if (next() != '}') fail();
    ++at_;
    return text;
  }

  std::string script(char mark) {
    const std::string text = argument();
    if (text == "*") return text;
    if (mark == '_')
      return text.size() == 1 && std::isdigit(static_cast<unsigned char>(text[0])) != 0 ? text : "_" + text;
    return is_one_word(text) ? "^" + text : "^(" + text + ")";
  }

  /// The characters of a group, as they are.
  std::string verbatim() {
    const std::size_t end = tex_.find('}', at_);
    if (next() != '{' || end == std::string_view::npos) fail();
    const std::string text(tex_.substr(at_ + 1, end - at_ - 1));
    at_ = end + 1;
    return text;
  }

  std::string command() {
    std::size_t end = at_ + 1;
    while (end < tex_.size() && is_letter(tex_[end])) ++end;
    const std::string_view name = tex_.substr(at_ + 1, std::max(end, at_ + 2) - at_ - 1);
    const std::size_t begin = std::exchange(at_, at_ + 1 + name.size());
    if (name == "frac" || name == "tfrac") return fraction();
    if (name == "sqrt") return "sqrt(" + argument() + ")";
    if (name == "dot" || name == "ddot") {
      const std::string order = name == "dot" ? "" : "2";
      std::string of = argument();
      if (next() == '_') {
        ++at_;
        of += script('_');
      }
      return fmt::format("d{}{}/dt{}", order, of, order);
    }
    if (name == "partial") {
      while (next() == ' ') ++at_;
      return "d";
    }
    if (name == "text" || name == "mathrm") return verbatim();
    if (name == "tag") return tag = verbatim(), "";
    if (name == "begin" || name == "end") return verbatim(), "";
    if (name == "int") return integral();
    if (const auto* symbol = std::ranges::find(symbols, name, &std::pair<std::string_view, std::string_view>::first);
        symbol != symbols.end()) {
      return std::string(symbol->second);
    }
    if (std::ranges::find(words, name) != words.end()) return std::string(name);
    at_ = begin;
    fail();
  }

  std::string fraction() {
    std::string above = argument(), below = argument();
    const bool derivative = above.starts_with('d') && below.starts_with('d') && !is_sum(below);
    if (is_sum(above)) above = "(" + above + ")";
    if (!is_one_word(below) && !derivative) below = "(" + below + ")";
    return above + "/" + below;
  }

  std::string integral() {
    std::string from, to;
    while (next() == '_' || next() == '^') {
      const bool low = tex_[at_++] == '_';
      (low ? from : to) = argument();
    }
    return from.empty() ? "Int" : fmt::format("Int({}, {})", from, to);
  }

  std::string_view tex_;
  std::size_t at_ = 0;
};

}  // namespace

std::string plain_formula(std::string_view tex, std::string* tag) {
  Formula formula(tex);
  std::string text = formula.all();
  if (tag != nullptr) *tag = formula.tag;
  return text;
}

}  // namespace contensou::program
