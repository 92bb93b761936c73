#include "output/progress.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

#include <unistd.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "contensou/si/nearest_name.hpp"

namespace contensou::program {

namespace {

const std::array<std::string, 3> modes{"auto", "always", "never"};

/// Hours, minutes and seconds as a clock shows them.
std::string clock(double seconds) {
  constexpr double longest = 100 * 3600.0;
  if (!(seconds < longest)) return "more than 100 h";
  const long whole = std::lround(seconds);
  if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

void rewrite(const std::string& line, const char* end) {
  constexpr const char* clear_rest = "\x1b[K";
  std::fputs(fmt::format("\r{}{}{}", line, clear_rest, end).c_str(), stderr);
}

}  // namespace

std::string progress_line(double done, double total, const std::string& what, double seconds) {
  constexpr int width = 24;
  const double share = total > 0 ? std::clamp(done / total, 0.0, 1.0) : 1;
  const int filled = static_cast<int>(share * width);
  const double rate = done / seconds;
  std::string line =
      fmt::format("{:3} % [{:=<{}}{:{}}]", static_cast<int>(100 * share), "", filled, "", width - filled);
  if (done > 0 && seconds > 0) {
    line += fmt::format("  {:.3g} {}/s, {} left", rate, what, clock((total - done) / rate));
  }
  return line;
}

Progress::Progress(double total, std::string what, bool shown) : total_(total), what_(std::move(what)), shown_(shown) {}

void Progress::show(double done) {
  constexpr auto pause = std::chrono::milliseconds(200);
  const auto now = Clock::now();
  if (!shown_ || now - last_ < pause) return;
  last_ = now;
  begun_ = true;
  rewrite(progress_line(done, total_, what_, std::chrono::duration<double>(now - start_).count()), "");
}

void Progress::finish() {
  if (!begun_) return;
  const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
  rewrite(fmt::format("{:.6g} {} in {:.3g} s, {:.3g} {}/s", total_, what_, seconds, total_ / seconds, what_), "\n");
}

void ProgressOption::add(CLI::App& app) {
  progress_.add(app, "--progress", "WHEN",
                "auto (default: if standard error is a terminal), always or never show progress on standard error");
}

bool ProgressOption::read() const {
  if (!progress_.given() || progress_.text() == "auto") return ::isatty(STDERR_FILENO) != 0;
  if (std::ranges::find(modes, progress_.text()) == modes.end()) {
    progress_.reject(fmt::format("is not a time for it{}; one of {}", si::suggestion(progress_.text(), modes),
                                 fmt::join(modes, ", ")));
  }
  return progress_.text() == "always";
}

}  // namespace contensou::program
