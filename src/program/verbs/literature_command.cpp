#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "answers/table/answer.hpp"
#include "options/output_options.hpp"
#include "paper/statements.hpp"
#include "verb.hpp"

namespace contensou::program {

namespace {

using answers::TextTable;

const char* word_of(Verdict verdict) { return verdict == Verdict::holds ? "agrees" : "differs"; }

constexpr Field<Examined> number_fields[]{
    {"name", "", "name of the number", [](const Examined& n) -> Json { return n.statement.says; }},
    {"source", "", "source of the number: authors, journal and year",
     [](const Examined& n) -> Json { return n.statement.source.name; }},
    {"link", "", "DOI or repository of the source", [](const Examined& n) -> Json { return n.statement.source.link; }},
    {"read", "", "material that was read for this number: abstract, code, textbooks, or only a citation",
     [](const Examined& n) -> Json { return n.statement.source.read; }},
    {"published", "", "value that the source prints", [](const Examined& n) -> Json { return n.found.printed; }},
    {"computed", "", "value that this program computes", [](const Examined& n) -> Json { return n.found.computed; }},
    {"verdict", "", "result of the comparison: agrees or differs",
     [](const Examined& n) -> Json { return word_of(n.found.verdict); }},
    {"recorded", "", "verdict that the program expects; any other verdict gives exit status 1",
     [](const Examined& n) -> Json { return word_of(n.statement.recorded); }},
};

std::string numbers_as_text(const std::vector<Examined>& numbers, const Digits& digits) {
  const auto column = TextTable::right(digits.width());
  TextTable table({TextTable::left(), column, column, column});
  table.add({"number", "published", "computed", "difference", "  verdict"});
  std::vector<std::string> sources;  // list below the table
  for (const Examined& number : numbers) {
    const auto& [name, link, read] = number.statement.source;
    const std::string source = fmt::format("{}{}{} ({})", name, link.empty() ? "" : ", ", link, read);
    const auto place = std::ranges::find(sources, source) - sources.begin();
    if (place == std::ssize(sources)) sources.push_back(source);
    const auto& [published, computed, corrected, verdict] = number.found;
    table.add({std::string(number.statement.says), digits(published), digits(computed), digits(computed - published),
               fmt::format("  {} [{}]{}", word_of(verdict), place + 1,
                           number.as_recorded() ? "" : "  FAIL: not as recorded")});
  }
  std::string text = table.text() + "\n";
  for (std::size_t i = 0; i < sources.size(); ++i) text += fmt::format("[{}] {}\n", i + 1, sources[i]);
  const auto agreeing =
      std::ranges::count(numbers, Verdict::holds, [](const Examined& number) { return number.found.verdict; });
  return text + fmt::format("\n{} numbers: {} agree, {} differ. In brackets: what of a source was read.\n",
                            numbers.size(), agreeing, std::ssize(numbers) - agreeing);
}

std::vector<FieldText> literature_texts() { return texts_of_rows("rows", number_fields); }

class LiteratureCommand final : public Verb {
 public:
  void add_options(CLI::App& app) override { output_.add(app); }

  ExitStatus run() override {
    const Output output = output_.read();
    std::vector<Examined> numbers;
    for (const Statement& number : published_numbers()) numbers.push_back({number});
    Answer answer = answer_of_rows("rows", number_fields, numbers);
    answer.beside = {"link", "read", "recorded"};
    answer.text = [&](const Digits& digits) { return numbers_as_text(numbers, digits); };
    answer.passed = std::ranges::all_of(numbers, &Examined::as_recorded);
    return output.write(answer);
  }

 private:
  OutputOptions output_{{{"a table of published numbers", answer_formats("text")}}};
};

const RegisteredVerb<LiteratureCommand> literature_verb(Purpose::check, "literature",
                                                        "Compare published numbers with computed ones",
                                                        "contensou literature", {{"", literature_texts}});

}  // namespace

}  // namespace contensou::program
