#include <algorithm>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "run_program.hpp"

using Catch::Matchers::Contains;

TEST_CASE("bad input is status 2, says what was typed and a way out", "[cli]") {
  struct Mistake {
    std::vector<std::string> arguments;
    std::vector<std::string> words;
  };
  const auto start = [](const std::string& mu, const std::string& u0, const std::string& v0) {
    return std::vector<std::string>{"stop", "--mu", mu, "--u0", u0, "--v0", v0};
  };
  const std::vector<Mistake> mistakes{
      {{}, {"a verb is missing", "stop", "contensou --help"}},
      {{"stpo"}, {"unknown verb 'stpo'", "did you mean 'stop'"}},
      {{"--vresion"}, {"unknown option '--vresion'"}},
      {{"stop"}, {"--mu, --u0, --v0 missing", "--ball"}},
      {{"stop", "--mu", "0.1", "--v0", "1"}, {"--u0 missing"}},
      {{"stop", "--mu", "0.1", "--u0", "1", "--v0"}, {"--v0 needs a value"}},
      {{"stop", "--mu", "--u0", "1", "--v0", "1"}, {"--mu needs a value before '--u0'"}},
      {{"stop", "--mw", "0.1"}, {"unknown option '--mw'", "did you mean '--mu'"}},
      {{"stop", "--ball", "pool", "--sip=2"}, {"unknown option '--sip'", "did you mean '--slip'"}},
      {{"stop", "--ball", "pool", "pool"}, {"unexpected argument 'pool'"}},
      {{"stop", "--mu", "0.1", "--mu", "0.2", "--u0", "1", "--v0", "1"}, {"--mu is given 2 times"}},
      {start("nan", "1", "1"), {"--mu: 'nan' is not a finite number"}},
      {start("inf", "1", "1"), {"--mu: 'inf' is not a finite number"}},
      {start("0.1", "-inf", "1"), {"--u0: '-inf' is not a finite number"}},
      {start("1e999", "1", "1"), {"--mu: '1e999' does not fit a double"}},
      {start("1e-999", "1", "1"), {"--mu: '1e-999' does not fit a double"}},
      {start("", "1", "1"), {"--mu: '' is not a number"}},
      {start("1,5", "1", "1"), {"--mu: '1,5' is not a number"}},
      {start("0.1", "1x", "1"), {"--u0: '1x' is not a number"}},
      {start("0.1", "+-1", "1"), {"--u0: '+-1' is not a number"}},
      {start("0.1", "0x10", "1"), {"--u0: '0x10' is not a number"}},
      {start("0", "1", "1"), {"--mu 0: ", "0 < mu <= 1"}},
      {start("-0.1", "1", "1"), {"--mu -0.1: ", "0 < mu <= 1"}},
      {start("1.01", "1", "1"), {"--mu 1.01: ", "0 < mu <= 1"}},
      {start("0.1", "1", "-1"), {"--v0 -1: ", ">= 0"}},
      {{"stop", "--ball", "pol"}, {"--ball pol: no such ball", "did you mean 'pool'", "steel"}},
      {{"stop", "--ball", "pool", "--mu", "0.1"}, {"--ball pool and --mu exclude each other"}},
      {{"stop", "--ball", "pool", "--u0", "1", "--v0", "1"}, {"--ball pool and --u0, --v0 exclude each other"}},
      {{"stop", "--mu", "0.1", "--u0", "1", "--v0", "1", "--spin", "3"},
       {"--spin changes a ball, or a puck: add --ball"}},
      {{"stop", "--ball", "pool", "--radius", "-1"}, {"--radius -1: radius must be finite and > 0"}},
      {{"stop", "--ball", "pool", "--slip", "-1"}, {"--slip -1: slip must be finite and >= 0"}},
      {{"stop", "--ball", "pool", "--mass", "nan"}, {"--mass: 'nan' is not a finite number"}},
      {{"stop", "--ball", "pool", "--patch-radius", "1"}, {"at most the ball's radius 0.028575 m, got 1 m"}},
      {{"stop", "--ball", "pool", "--patch-radius", "1e-3", "--spin-deceleration", "3"}, {"exclude each other"}},
      {{"stop", "--ball", "pool", "--gravity", "9.8", "--load", "3"}, {"--gravity and --load exclude each other"}},
      {{"stop", "--ball", "pool", "--load", "3kg"}, {"--load: '3kg' has the unit 'kg'", "N, kN or lbf"}},
      {{"stop", "--ball", "pool", "--load", "1e-400 N"}, {"--load: '1e-400' does not fit a double"}},
      {{"stop", "--ball", "pool", "--load", "0"}, {"--load 0: load must be finite and > 0, in N"}},
      {{"stop", "--ball", "pool", "--law", "pad"}, {"--law pad: no such law", "did you mean 'pade'", "exact"}},
      {{"stop", "--ball", "pool", "--law", "exact", "--route", "closed"},
       {"--route closed: law exact", "it has quadrature, regularised, direct"}},
      {{"stop", "--ball", "pool", "--route", "dirct"}, {"--route dirct: no such route", "did you mean 'direct'"}},
      {{"stop", "--ball", "pool", "--digits", "0"}, {"--digits: '0' is not a whole number from 1 to 17"}},
      {{"stop", "--ball", "pool", "--digits", "18"}, {"'18'"}},
      {{"stop", "--ball", "pool", "--digits", "3", "--format", "csv"}, {"--digits 3: ", "--format text"}},
      {{"stop", "--ball", "pool", "--format", "jsn"}, {"--format jsn: unknown format", "did you mean 'json'"}},
      {{"stop", "--ball", "pool", "-o", ""}, {"-o '': a file name is needed"}},
      {{"orbit", "--ball", "pool", "--at", "1,-1"}, {"--at 1,-1: ", "tau >= 0"}},
      {{"orbit", "--ball", "pool", "--at", "1,,2"}, {"--at: '' is not a number"}},
      {{"orbit", "--ball", "pool", "--at", "inf"}, {"--at: 'inf' is not a finite number"}},
      {{"orbit", "--ball", "pool", "--samples", "1"}, {"--samples: '1' is not a whole number from 2"}},
      {{"orbit", "--ball", "pool", "--samples", "2.5"}, {"--samples: '2.5'"}},
      {{"orbit", "--ball", "pool", "--samples", "3", "--at", "1"}, {"--at and --samples exclude each other"}},
      {{"orbit", "--mu", "0.1"}, {"--u0, --v0 missing"}},
      {{"law"}, {"--k missing", "--batch"}},
      {{"law", "--k", "-1"}, {"--k -1: ", "k >= 0"}},
      {{"law", "--k", "nan"}, {"--k: 'nan'"}},
      {{"law", "--k", "1", "--batch", "-"}, {"--k and --batch exclude each other"}},
      {{"check", "--mu", "0.1", "--u0", "0", "--v0", "0"}, {"u0 = v0 = 0"}},
      {{"check", "--mu", "0.1"}, {"--u0, --v0 missing"}},
      {{"balls", "pol"}, {"no such ball", "did you mean 'pool'"}},
      {{"balls", "pool", "--format", "json"}, {"a run file is text"}},
      {{"balls", "./b.toml"}, {"./b.toml: balls takes no file, only a name", "stop --ball FILE"}},
      // A flag means the same whatever follows it.
      {{"sweep", "--mu", "0.1", "--u0", "1", "--v0", "1", "--log=false"}, {"'--log=false': --log takes no value"}},
      {{"sweep", "--mu", "0.1", "--u0", "1", "--v0", "1", "--log=true"}, {"'--log=true': --log takes no value"}},
      {{"portrait", "--mu", "0.1", "--facts=no"}, {"'--facts=no': --facts takes no value"}},
      {{"stop", "--ball", "pool", "--estimate=banana"}, {"--estimate takes no value"}},
      {{"stop", "--batch", "-", "--keep-going=false"}, {"--keep-going takes no value"}},
      {{"stop", "--help=no"}, {"--help takes no value"}},
      {{"--version=3"}, {"--version takes no value"}},
      // No mistake in an option that would not count.
      {{"stop", "--batch", "-", "--digits", "banana"}, {"--digits: 'banana' is not a whole number"}},
      {{"stop", "--batch", "-", "--digits", "3"},
       {"--digits 3: a table of stop times always has all digits: leave it out"}},
      {{"portrait", "--mu", "0.1", "-o", "-", "--format", "json", "--digits", "3"},
       {"--digits 3: a portrait always has all digits: leave"}},
      {{"orbit", "--ball", "pool", "--digits", "3"}, {"--digits 3: csv always has all digits; choose text"}},
      {{"balls", "pool", "--digits", "3"}, {"--digits 3: a run file always has all digits"}},
      {{"balls", "pool", "--format", "text", "--digits", "3"}, {"--digits 3: a run file always has all digits"}},
      {{"balls", "--digits", "banana"}, {"--digits: 'banana'"}},
      {{"balls", "pool", "--digits", "banana"}, {"--digits: 'banana'"}},
      {{"check", "--format", "jsn"}, {"unknown format", "did you mean 'json'"}},
      {{"explore", "-o", ""}, {"-o '': a file name is needed"}},
      {{"explore", "-o", "-o"}, {"-o needs a value before '-o'"}},
      {{"stop", "--ball", "pool", "-o", "--format", "json"}, {"-o needs a value before '--format'"}},
      {{"--version", "junk"}, {"unknown verb 'junk'"}},
      {{"stpo", "--help"}, {"unknown verb 'stpo'", "did you mean 'stop'"}},
      {{"stop", "--ball", "pool", "--"}, {"unexpected argument '--'"}},
      {{"balls", "--"}, {"unexpected argument '--'"}},
      {{"stop", "sweep"}, {"unexpected argument 'sweep'"}},
      {{"--mu", "0.1", "stop"}, {"unknown option '--mu'"}},
  };
  for (const auto& [arguments, words] : mistakes) {
    const Run run = run_program(arguments);
    INFO(Catch::Detail::stringify(arguments) << "\n" << run.err);
    CHECK(run.status == 2);
    CHECK(run.out.empty());
    for (const std::string& word : words) CHECK_THAT(run.err, Contains(word));
  }
}

TEST_CASE("messages quote what they can show", "[cli]") {
  const std::string long_text(20000, 'x');
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{long_text},
                                             {"stop", "--" + long_text},
                                             {"stop", long_text},
                                             {"stop", "--mu", long_text},
                                             {"stop", "--ball", "pool", "--law", long_text},
                                             {"stop", "--ball", long_text},
                                             {"stop", "--ball", "pool", "--format", long_text},
                                             {"stop", "--ball", "pool", "--body", long_text},
                                             {"stop", "--ball", "pool", "-o", "a." + long_text},
                                             {"sweep", "--u0", "0:" + long_text + ":3"},
                                             {"portrait", "--mu", "0.1", "--size", "1x" + long_text},
                                             {"portrait", "--mu", "0.1", "--view", "a\nb\x1b[2Jc\x7f"},
                                             {"stop", "--mu", "\n\a"}}) {
    const Run run = run_program(arguments);
    INFO(run.err.substr(0, 1000));
    CHECK(run.status == 2);
    CHECK(run.err.size() < 600);
    CHECK(std::ranges::count(run.err, '\n') == 2);
    CHECK(std::ranges::none_of(run.err, [](char c) { return c != '\n' && static_cast<unsigned char>(c) < ' '; }));
  }
}

TEST_CASE("what cannot be computed is status 3", "[cli]") {
  const Run run = run_program("orbit --mu 1e-100 --u0 1e300 --v0 1");
  CHECK(run.status == 3);
  CHECK(run.out.empty());
  CHECK_THAT(run.err, Contains("exceeds the largest double"));
}
