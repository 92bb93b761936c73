#include <string>

#include <fmt/format.h>
#include <catch2/catch.hpp>

#include "contensou/si/catalogue.hpp"
#include "run_program.hpp"

using Catch::Matchers::StartsWith;

TEST_CASE("a spinning ball never rolls before the textbook's, whatever counts as rolling", "[invariant]") {
  for (const std::string law : {"exact", "pade"}) {
    for (const auto& entry : contensou::si::catalogue()) {
      if (entry.experiment.ball.body.lies_flat()) continue;
      for (const char* below : {"1e-6", "1e-3", "0.1", "100"}) {
        const auto roll = json_of(fmt::format("roll --samples 2 --format json --ball {} --law {} --rolling-below {}",
                                              entry.name, law, below));
        CAPTURE(entry.name, law, below);
        CHECK(roll.at("rolls_after").at("t").get<double>() >=
              roll.at("textbook").at("rolls_after").at("t").get<double>());
        if (std::string(below) == "100") CHECK(roll.at("rolls_after").at("t") == 0);
      }
    }
  }
}

TEST_CASE("a moving picture, in real time or a stated pace", "[cli][gnuplot]") {
  const TemporaryDirectory scratch;
  const Run run = run_program("roll --ball pool --until 0.01 --samples 30 --size 120x90 --font Serif -o " +
                              scratch.file("shot.gif"));
  INFO(run.err);
  CHECK(run.status == 0);
  CHECK(run.out.empty());
  const std::string film = read_file(scratch.file("shot.gif"));
  CHECK_THAT(film, StartsWith("GIF89a"));
  CHECK(film.size() < 500'000);
  // A frame has a graphic control extension, and its delay is 2/25 s.
  int frames = 0;
  for (auto at = film.find("\x21\xf9\x04"); at != std::string::npos; at = film.find("\x21\xf9\x04", at + 1)) {
    CHECK(film.substr(at + 4, 2) == std::string("\x08\0", 2));
    ++frames;
  }
  CHECK(frames == 30);
}
