#include "output/progress.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <fmt/format.h>

namespace contensou::program {

namespace {

/// Returns a time as hours, minutes and seconds, like a clock.
std::string clock(double seconds) {
  constexpr double longest = 100 * 3600.0;
  if (!(seconds < longest)) return "more than 100 h";
  const long whole = std::lround(seconds);
  if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

/// Returns the progress bar for a fraction of the work, with the rate and the time left, without a line end. If `total`
/// is NaN, the text contains only the amount and the rate of the work that is done.
std::string progress_line(double done, double total, const std::string& what, double seconds) {
  constexpr int width = 24;
  const double rate = done / seconds;
  if (std::isnan(total)) return fmt::format("{:.6g} {}, {:.3g} {}/s", done, what, rate, what);
  const double fraction = total > 0 ? std::clamp(done / total, 0.0, 1.0) : 1;
  const int filled = static_cast<int>(fraction * width);
  std::string line =
      fmt::format("{:3} % [{:=<{}}{:{}}]", static_cast<int>(100 * fraction), "", filled, "", width - filled);
  if (done > 0 && seconds > 0) {
    line += fmt::format("  {:.3g} {}/s, {} left", rate, what, clock((total - done) / rate));
  }
  return line;
}

}  // namespace

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void Progress::show(double done, double total) {
  constexpr double pause = 0.2;
  const double now = now_();
  if (!shown_ || now - last_ < pause) return;
  last_ = now;
  begun_ = visible_ = true;
  rewrite(progress_line(done, total, what_, now - start_), "");
}

void Progress::erase() {
  if (visible_) rewrite("", "");
  visible_ = false;
}

void Progress::finish(double done) {
  if (!begun_) return;
  visible_ = false;
  const double seconds = now_() - start_;
  rewrite(fmt::format("{:.6g} {} in {:.3g} s, {:.3g} {}/s", done, what_, seconds, done / seconds, what_), "\n");
}

void Progress::rewrite(const std::string& line, const char* end) const {
  constexpr const char* clear_rest = "\x1b[K";
  std::fputs(fmt::format("\r{}{}{}", line, clear_rest, end).c_str(), output_);
}

}  // namespace contensou::program
