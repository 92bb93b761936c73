#pragma once

#include <cstdio>
#include <functional>
#include <string>
#include <utility>

namespace contensou::program {

/// The work whose progress is shown: none, work that takes long, or all work.
enum class ShowProgress { never, of_long_work, always };

/// Returns the time, s, of a clock that is never set back.
double seconds_now();

/// The progress of a computation: one line on standard error that is overwritten a few times a second.
class Progress {
 public:
  /// @param what    noun of the counted things, in the plural
  /// @param now     returns the time of a clock, s
  /// @param output  terminal or file to which the line is written
  Progress(std::string what, ShowProgress when, std::function<double()> now = seconds_now, std::FILE* output = stderr)
      : what_(std::move(what)),
        shown_(when != ShowProgress::never),
        begun_(when == ShowProgress::always),
        now_(std::move(now)),
        output_(output) {}
  ~Progress() { erase(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// @param total  total amount of work; NaN if it is not known
  void show(double done, double total);

  /// Erases the line, to make room for a message. The next call of `show` writes it again.
  void erase();

  /// Writes a last line with the duration, if a line has been shown or progress is always shown.
  void finish(double done);

 private:
  void rewrite(const std::string& line, const char* end) const;

  std::string what_;
  bool shown_;
  bool begun_;
  bool visible_ = false;
  std::function<double()> now_;
  std::FILE* output_;
  double start_ = now_();
  double last_ = start_;
};

}  // namespace contensou::program
