// A run file must give an experiment or a readable error message. An experiment written and read back is the same.
#include "contensou/si/run_file.hpp"
#include "finding.hpp"

using namespace contensou;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string printed;
  try {
    printed = si::run_file(si::experiment_of(si::parse_run_file(fuzz::text_of(data, size), "x.toml")));
  } catch (const si::RunFileError& error) {
    fuzz::require_readable(error.what());
    return 0;
  }
  fuzz::require(si::run_file(si::experiment_of(si::parse_run_file(printed, "printed"))) == printed, printed);
  return 0;
}
