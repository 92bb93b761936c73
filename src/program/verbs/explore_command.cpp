#include "commands.hpp"
#include "embedded_page.hpp"
#include "exit_status.hpp"
#include "options/argument.hpp"
#include "output/output.hpp"

namespace contensou::program {

namespace {

class ExploreCommand final : public Command {
 public:
  std::string name() const override { return "explore"; }
  std::string summary() const override { return "A page to explore the phase plane: one HTML file, for any browser"; }
  std::string example() const override { return "contensou explore -o page.html"; }

  void add_options(CLI::App& app) override {
    file_.add(app, "-o,--output", "FILE", "where to write the page; - is standard output (default page.html)");
  }

  ExitStatus run() override {
    const std::string path = file_.given() ? file_.text() : "page.html";
    if (page::embedded_page().empty()) {
      throw FileFailure(
          "this program was built without its page: install em++, esbuild and range-v3 (Debian: apt-get install "
          "emscripten esbuild librange-v3-dev) and build it again with cmake -DCONTENSOU_PAGE=ON");
    }
    write_output(path, page::embedded_page());
    return ExitStatus::done;
  }

 private:
  Argument file_;
};

}  // namespace

std::unique_ptr<Command> make_explore_command() { return std::make_unique<ExploreCommand>(); }

}  // namespace contensou::program
