// write_report: one page about a run of the twin, from the bag that recorded its topics.

#include <cstdio>
#include <filesystem>
#include <string>

#include <CLI/CLI.hpp>

#include "aeolian_twin/report/recorded_run.hpp"
#include "aeolian_twin/tools/program.hpp"

namespace aeolian {
namespace {

int run(int argc, char** argv) {
  CLI::App app(
      "Writes a page with pictures and tables about a run of the twin: measured map, forecast, difference, "
      "growth of the ripples, skill.");
  std::string bag;
  std::string directory;
  std::string truth;
  app.add_option("BAG", bag,
                 "bag with the recorded topics /height_map, /forecast, /comparison and /wind_field")
      ->required();
  app.add_option("--out", directory, "directory for index.html, created when it does not exist")->required();
  app.add_option("--truth", truth, "directory that simulate_field wrote: compares with the true surface too");
  if (const auto code = parse(app, argc, argv)) return *code;
  write_report(read_recorded_run(bag, truth), directory);
  std::printf("%s\n", (std::filesystem::path(directory) / "index.html").c_str());
  return 0;
}

}  // namespace
}  // namespace aeolian

int main(int argc, char** argv) {
  return aeolian::run_program("write_report", [&] { return aeolian::run(argc, argv); });
}
