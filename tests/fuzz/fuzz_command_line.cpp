// A command line, one word a line, must give an answer or a readable error message, and no other exception. Commands
// that take long or call gnuplot are parsed but not run.
#define main program_main
#include "main.cpp"
#undef main

#include <fcntl.h>
#include <cctype>
#include <filesystem>
#include <list>
#include <span>
#include <sstream>
#include <typeinfo>

#include "finding.hpp"

namespace {

namespace fs = std::filesystem;
using namespace contensou;
using program::Verb;

/// True if verbs are run after they have been parsed.
bool running = false;

template <std::size_t place>
class Guarded final : public Verb {
 public:
  static inline std::unique_ptr<Verb> (*make)() = nullptr;
  void add_options(CLI::App& app) override { verb_->add_options(app); }
  program::ExitStatus run() override { return running ? verb_->run() : program::ExitStatus::done; }

 private:
  std::unique_ptr<Verb> verb_ = make();
};

template <std::size_t place = 0>
void guard() {
  if constexpr (place < 32) {
    if (place == program::verbs().size()) return;
    Guarded<place>::make = std::exchange(program::verbs()[place].make,
                                         []() -> std::unique_ptr<Verb> { return std::make_unique<Guarded<place>>(); });
    guard<place + 1>();
  }
}

/// Returns true if a word has no number of more than two digits and no exponent.
bool is_tiny(const std::string& word) {
  int digits = 0;
  for (const char letter : word) {
    const bool exponent = digits > 0 && std::tolower(static_cast<unsigned char>(letter)) == 'e';
    digits = std::isdigit(static_cast<unsigned char>(letter)) != 0 ? digits + 1 : 0;
    if (exponent || digits > 2) return false;
  }
  return true;
}

bool is_cheap(const std::vector<std::string>& words) {
  if (words.empty()) return false;
  const auto has = [&](std::string_view word) { return std::ranges::find(words, word) != words.end(); };
  if (has("check") || has("paper") || (has("portrait") && !has("--facts"))) return false;
  const auto other_verbs = {"balls", "law", "terminal", "explore"};
  return std::ranges::find(other_verbs, words.front()) != other_verbs.end() || std::ranges::all_of(words, is_tiny);
}

void write_files() {
  const auto write = [](const char* name, std::string_view text) {
    std::FILE* const file = std::fopen(name, "w");
    fuzz::require(file != nullptr && std::fwrite(text.data(), 1, text.size(), file) == text.size(), name);
    std::fclose(file);
  };
  write("p.csv", "rho,pressure\n0,1\n0.5,0.75\n1,0\n");
  write("s.csv", "mu,u0,v0\n0.1,1,1\n0.2,1,bad\n");
  write("k.csv", "k\n0\n1\ninf\n");
  write("f.csv", "t,slip,spin,spin_sd\n0,1,100,1\n0.05,0.7,99,1\n0.1,0.4,99,1\n0.2,,98,1\n0.4,0.01,97,1\n");
  write("b.toml",
        "[ball]\nmass = 0.17\nradius = 0.0286\n[contact]\nfriction = 0.2\nspin_deceleration = 10\n[start]\nslip = 1\n"
        "spin = 100\n");
}

/// Changes to a new empty folder. Before that, relative paths in the fuzzer's own arguments are made absolute.
void move_to_own_folder(int count, char** arguments) {
  static std::list<std::string> absolute;
  constexpr std::string_view prefix = "-artifact_prefix=";
  for (char*& argument : std::span(arguments, static_cast<std::size_t>(count)).subspan(1)) {
    const std::string_view given = argument;
    const bool is_prefix = given.starts_with(prefix);
    if (given.starts_with('-') && !is_prefix) continue;
    absolute.push_back(is_prefix ? std::string(prefix) + fs::absolute(given.substr(prefix.size())).string()
                                 : fs::absolute(given).string());
    argument = absolute.back().data();
  }
  std::string folder = (fs::temp_directory_path() / "contensou-fuzz-XXXXXX").string();
  fuzz::require(::mkdtemp(folder.data()) != nullptr, "mkdtemp");
  fs::current_path(folder);
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* count, char*** arguments) {
  move_to_own_folder(*count, *arguments);
  guard();
  ::setenv("PATH", "", 1);  // so that gnuplot is not found
  const int nothing = ::open("/dev/null", O_RDWR | O_CLOEXEC);
  ::dup2(nothing, STDIN_FILENO);
  ::dup2(nothing, STDOUT_FILENO);
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::istringstream lines{std::string(fuzz::text_of(data, size))};
  std::vector<std::string> words;
  for (std::string word; std::getline(lines, word);) {
    // Reject files in other folders, and null characters, which no command line contains.
    if (word.find('/') != std::string::npos || word.find('\0') != std::string::npos) return 0;
    words.push_back(word);
  }
  running = is_cheap(words);
  for (const auto& entry : fs::directory_iterator(".")) fs::remove_all(entry);
  write_files();
  std::string verb;
  try {
    program::run(words, verb);
  } catch (const std::domain_error& error) {
    fuzz::require_readable(error.what());
  } catch (const program::FileFailure& error) {
    fuzz::require_readable(error.what());
  } catch (const std::system_error& error) {
    fuzz::require_readable(error.what());
  } catch (const std::runtime_error& error) {
    fuzz::require(typeid(error) == typeid(std::runtime_error), typeid(error).name());
    fuzz::require_readable(error.what());
  }
  return 0;
}
