#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "answers/table/text_table.hpp"
#include "options/output_options.hpp"
#include "paper/literature.hpp"
#include "verb.hpp"

namespace contensou::program {

namespace {

using answers::TextTable;

std::string verdict(const Published& number) { return number.agrees() ? "agrees" : "differs"; }

constexpr Field<Published> number_fields[]{
    {"name", "", "name of the number", [](const Published& n) -> Json { return n.name; }},
    {"source", "", "source of the number: authors, journal and year",
     [](const Published& n) -> Json { return n.source; }},
    {"link", "", "DOI or repository of the source", [](const Published& n) -> Json { return n.link; }},
    {"read", "", "material that was read for this number: abstract, code, textbooks, or only a citation",
     [](const Published& n) -> Json { return n.read; }},
    {"published", "", "value that the source prints", [](const Published& n) -> Json { return n.published; }},
    {"computed", "", "value that this program computes", [](const Published& n) -> Json { return n.computed; }},
    {"verdict", "", "result of the comparison: agrees or differs",
     [](const Published& n) -> Json { return verdict(n); }},
    {"recorded", "", "verdict that the program expects; any other verdict gives exit status 1",
     [](const Published& n) -> Json { return n.confirmed ? "agrees" : "differs"; }},
};

/// The list of sources below the table, and the number of each source in this list.
struct Sources {
  std::vector<std::string> list{};

  std::ptrdiff_t operator()(const Published& number) {
    const std::string source =
        fmt::format("{}{}{} ({})", number.source, number.link.empty() ? "" : ", ", number.link, number.read);
    const auto known = std::ranges::find(list, source);
    const auto place = known - list.begin();
    if (known == list.end()) list.push_back(source);
    return place + 1;
  }
};

std::string as_text(const std::vector<Published>& numbers, const Digits& digits) {
  const auto column = TextTable::right(digits.width());
  TextTable table({TextTable::left(), column, column, column});
  table.add({"number", "published", "computed", "difference", "  verdict"});
  Sources sources;
  for (const Published& number : numbers) {
    table.add({std::string(number.name), digits(number.published), digits(number.computed),
               digits(number.computed - number.published),
               fmt::format("  {} [{}]{}", verdict(number), sources(number),
                           number.agrees() == number.confirmed ? "" : "  FAIL: not as recorded")});
  }
  std::string text = table.text() + "\n";
  for (std::size_t i = 0; i < sources.list.size(); ++i) text += fmt::format("[{}] {}\n", i + 1, sources.list[i]);
  const auto agreeing = std::ranges::count_if(numbers, &Published::agrees);
  return text + fmt::format("\n{} numbers: {} agree, {} differ. In brackets: what of a source was read.\n",
                            numbers.size(), agreeing, std::ssize(numbers) - agreeing);
}

std::vector<FieldText> literature_texts() { return texts_of_rows("rows", number_fields); }

class LiteratureCommand final : public Verb {
 public:
  void add_options(CLI::App& app) override { output_.add(app); }

  ExitStatus run() override {
    const Output output = output_.read();
    const std::vector<Published> numbers = published_numbers();
    Answer answer = answer_of_rows("rows", number_fields, numbers);
    answer.beside = {"link", "read", "recorded"};
    answer.text = [&](const Digits& digits) { return as_text(numbers, digits); };
    answer.passed = std::ranges::all_of(numbers, [](const Published& n) { return n.agrees() == n.confirmed; });
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
