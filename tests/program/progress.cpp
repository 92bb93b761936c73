#include "output/progress.hpp"

#include <cstdio>
#include <string>

#include <catch2/catch.hpp>

using contensou::program::Progress;
using contensou::program::ShowProgress;

namespace {

/// A clock that stands still until it is set, and the text that progress has written.
struct Watch {
  double time = 1000;  ///< s
  std::FILE* file = std::tmpfile();

  Watch() { REQUIRE(file != nullptr); }
  ~Watch() { std::fclose(file); }
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  Progress progress(ShowProgress when) {
    return Progress(
        "rows", when, [this] { return time; }, file);
  }
  /// Returns the text written since the last call.
  std::string written() {
    std::fflush(file);
    const long end = std::ftell(file);
    std::fseek(file, read_, SEEK_SET);
    std::string text(static_cast<std::size_t>(end - read_), '\0');
    REQUIRE(std::fread(text.data(), 1, text.size(), file) == text.size());
    std::fseek(file, end, SEEK_SET);
    read_ = end;
    return text;
  }

 private:
  long read_ = 0;
};

}  // namespace

TEST_CASE("progress is a bar with rate and time left, a few times a second", "[table]") {
  Watch watch;
  Progress progress = watch.progress(ShowProgress::of_long_work);
  watch.time += 0.19;
  progress.show(1, 8);
  CHECK(watch.written().empty());
  watch.time += 1.81;
  progress.show(2, 8);
  CHECK(watch.written() == "\r 25 % [======                  ]  1 rows/s, 0:06 left\x1b[K");
  watch.time += 0.1;
  progress.show(3, 8);
  CHECK(watch.written().empty());
  watch.time += 7.9;
  progress.show(5, 50000);
  CHECK(watch.written() == "\r  0 % [                        ]  0.5 rows/s, 27:46:30 left\x1b[K");
  watch.time += 90;
  progress.show(6, 1e9);
  CHECK(watch.written() == "\r  0 % [                        ]  0.06 rows/s, more than 100 h left\x1b[K");
  progress.finish(1000);
  CHECK(watch.written() == "\r1000 rows in 100 s, 10 rows/s\x1b[K\n");
}

TEST_CASE("progress of work of unknown length is what was done; a message takes its line", "[table]") {
  Watch watch;
  {
    Progress progress = watch.progress(ShowProgress::of_long_work);
    progress.erase();
    CHECK(watch.written().empty());
    watch.time += 4;
    progress.show(1000, std::nan(""));
    CHECK(watch.written() == "\r1000 rows, 250 rows/s\x1b[K");
    progress.erase();
    CHECK(watch.written() == "\r\x1b[K");
    watch.time += 1;
    progress.show(2000, std::nan(""));
    CHECK(watch.written() == "\r2000 rows, 400 rows/s\x1b[K");
  }
  CHECK(watch.written() == "\r\x1b[K");  // an interrupted work only erases the line
}

TEST_CASE("progress of short work is silent unless it is always shown; never is never", "[table]") {
  const auto written = [](ShowProgress when, double seconds) {
    Watch watch;
    Progress progress = watch.progress(when);
    watch.time += seconds;
    progress.show(3, 4);
    progress.finish(4);
    return watch.written();
  };
  CHECK(written(ShowProgress::never, 1000).empty());
  CHECK(written(ShowProgress::of_long_work, 0.1).empty());
  CHECK(written(ShowProgress::always, 0.125) == "\r4 rows in 0.125 s, 32 rows/s\x1b[K\n");
}
