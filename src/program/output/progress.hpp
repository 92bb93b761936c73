#pragma once

#include <cstdio>
#include <functional>
#include <string>
#include <utility>

namespace contensou::program {

/// When progress is shown: of work that takes long, or of any.
enum class ShowProgress { never, of_long_work, always };

/// Of a clock that is never set back.
double seconds_now();

/// How far a computation is, in one line of standard error that is written over a few times a second.
class Progress {
 public:
  /// @param what    is counted, in the plural
  /// @param now     the time, s
  /// @param output  the terminal or file that the line is for
  Progress(std::string what, ShowProgress when, std::function<double()> now = seconds_now, std::FILE* output = stderr)
      : what_(std::move(what)),
        shown_(when != ShowProgress::never),
        begun_(when == ShowProgress::always),
        now_(std::move(now)),
        output_(output) {}
  ~Progress() { erase(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// @param total  NaN if it is not known
  void show(double done, double total);

  /// Makes room for a message, until it is shown again.
  void erase();

  /// Leaves a line that says how long it took, if any was shown before or progress is always shown.
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
