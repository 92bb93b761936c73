#include "options/thread_option.hpp"

#include <algorithm>
#include <thread>

namespace contensou::program {

namespace {

constexpr long most_threads = 1024;

}  // namespace

void ThreadOption::add(CLI::App& app) {
  threads_.add(app, "--threads", "N", "threads to compute with (default: all cores); the result does not depend on it",
               whole_number(1, most_threads));
}

int ThreadOption::read() const {
  const long cores = std::thread::hardware_concurrency();
  return static_cast<int>(threads_.value_or(std::clamp(cores, 1L, most_threads)));
}

}  // namespace contensou::program
