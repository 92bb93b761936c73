#include "options/bulk_options.hpp"

#include <algorithm>
#include <thread>

#include "options/output_options.hpp"
#include "platform/streams.hpp"

namespace contensou::program {

namespace {

constexpr long max_threads = 1024;

}  // namespace

void BulkOptions::add(CLI::App& app) {
  app.option_defaults()->group(usual_group());
  threads_.add(app, "--threads", "N", "number of threads (default: all cores); results do not depend on this number",
               whole_number(1, max_threads));
  progress_.add(app, "--progress", "WHEN",
                "progress on standard error: always, never, or auto (default), which means for long work on a terminal",
                one_of<std::optional<ShowProgress>>(
                    {{"auto", std::nullopt}, {"always", ShowProgress::always}, {"never", ShowProgress::never}}));
}

int BulkOptions::threads() const {
  const long cores = std::thread::hardware_concurrency();
  return static_cast<int>(threads_.value_or(std::clamp(cores, 1L, max_threads)));
}

ShowProgress BulkOptions::progress(const std::string& output) const {
  return progress_.value_or(std::nullopt).value_or(progress_if_watched(output));
}

ShowProgress progress_if_watched(const std::string& output) {
  const bool watched = is_terminal(Stream::error) && (output != "-" || !is_terminal(Stream::output));
  return watched ? ShowProgress::of_long_work : ShowProgress::never;
}

}  // namespace contensou::program
