#include "embedded_page.hpp"
#include "options/output_options.hpp"
#include "verb.hpp"

namespace contensou::program {

namespace {

class ExploreCommand final : public Verb {
 public:
  void add_options(CLI::App& app) override { output_.add(app); }

  ExitStatus run() override {
    const Output output = output_.read();
    if (page::embedded_page().empty()) {
      throw FileFailure(
          "this program was built without its page: install em++, esbuild and range-v3 (Debian: apt-get install "
          "emscripten esbuild librange-v3-dev) and build it again with cmake -DCONTENSOU_PAGE=ON");
    }
    return output.write(page::embedded_page());
  }

 private:
  OutputOptions output_{{{"a page", {"html"}, "page.html"}}};
};

const RegisteredVerb<ExploreCommand> explore_verb(Purpose::draw, "explore",
                                                  "Write an HTML page to explore motions in the plane of spin and slip",
                                                  "contensou explore -o page.html", {}, {"u", "v"});

}  // namespace

}  // namespace contensou::program
