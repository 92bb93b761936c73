#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

#include "answers/table/record.hpp"
#include "exit_status.hpp"

namespace contensou::program {

/// A verb (a command) of the program. A new verb is a file with a class derived from Verb and its registration.
class Verb {
 public:
  virtual ~Verb() = default;

  virtual void add_options(CLI::App& app) = 0;

  /// Runs the verb with its options. It writes results only after all of them have been computed.
  /// @throws  exceptions that main.cpp converts to an exit status
  virtual ExitStatus run() = 0;
};

/// The purpose of a verb. The help lists the verbs by purpose, in this order.
enum class Purpose : std::uint8_t { compute, draw, check, bodies, help };

struct VerbEntry {
  Purpose purpose;
  std::string name;
  std::string summary;  ///< one line of help
  std::string example;  ///< a command line that works, for the help
  std::vector<VerbFields> fields;
  std::vector<std::string_view> words;  ///< entries of the glossary that the help of this verb shows
  std::unique_ptr<Verb> (*make)();
};

/// Returns every verb that is linked into the program.
std::vector<VerbEntry>& verbs();

/// Registers a verb by the definition of a constant in its file.
template <class AVerb>
struct RegisteredVerb {
  RegisteredVerb(Purpose purpose, std::string name, std::string summary, std::string example,
                 std::vector<VerbFields> fields = {}, std::vector<std::string_view> words = {}) {
    verbs().push_back({purpose, std::move(name), std::move(summary), std::move(example), std::move(fields),
                       std::move(words), []() -> std::unique_ptr<Verb> { return std::make_unique<AVerb>(); }});
  }
};

}  // namespace contensou::program
