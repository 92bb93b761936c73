#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "run_program.hpp"

using Catch::Matchers::Contains;
using Catch::Matchers::EndsWith;
using Catch::Matchers::StartsWith;

#ifdef CONTENSOU_HAS_PAGE

TEST_CASE("explore writes one whole page", "[cli]") {
  const TemporaryDirectory scratch;
  const Run run = run_program("explore -o " + scratch.file("page.html"));
  CHECK(run.status == 0);
  CHECK(run.out.empty());
  const std::string page = read_file(scratch.file("page.html"));
  CHECK_THAT(page, StartsWith("<!doctype html>") && EndsWith("</html>\n"));
  CHECK(run_program("explore -o -").out == page);
  // The page must contain every part in place of its placeholder, and must refer to no other file.
  for (const std::string absent :
       {"/*STYLE*/", "/*LIBRARY*/", "/*BUNDLE*/", "@VERSION@", "href=\"http", "src=\"http", "<script src"}) {
    INFO(absent);
    CHECK(page.find(absent) == std::string::npos);
  }
  CHECK(scratch.names() == std::vector<std::string>{"page.html"});
}

TEST_CASE("a page that cannot be written is status 4", "[cli]") {
  const Run run = run_program("explore -o /no/such/folder/page.html");
  CHECK(run.status == 4);
  CHECK(run.out.empty());
  CHECK_THAT(run.err, Contains("cannot write /no/such/folder/page.html"));
}

#else

TEST_CASE("a program that was built without its page says how to get it", "[cli]") {
  const TemporaryDirectory scratch;
  const Run run = run_program("explore -o " + scratch.file("page.html"));
  CHECK(run.status == 4);
  CHECK(run.out.empty());
  CHECK_THAT(run.err, Contains("built without its page") && Contains("emscripten") && Contains("-DCONTENSOU_PAGE=ON"));
  CHECK(scratch.names().empty());
}

#endif
