// replay: the whole twin on recorded bags, at full speed and without a ROS master.

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <ros/time.h>

#include "aeolian_core/surface/atomic_file.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_twin/ranks/ranks.hpp"
#include "aeolian_twin/replay/replay_bag.hpp"
#include "aeolian_twin/replay/replay_summary.hpp"
#include "aeolian_twin/tools/program.hpp"
#include "aeolian_twin/tools/progress_bar.hpp"

namespace aeolian {
namespace {

namespace fs = std::filesystem;

std::atomic<bool> stopped{false};

/// The bags that the command line names, those of a folder by name.
std::vector<std::string> bags_of(const std::vector<std::string>& arguments) {
  std::vector<std::string> bags;
  for (const std::string& argument : arguments) {
    if (!fs::is_directory(argument)) {
      bags.push_back(argument);
      continue;
    }
    const std::size_t before = bags.size();
    for (const auto& entry : fs::directory_iterator(argument))
      if (entry.path().extension() == ".bag" && entry.path().filename().string().front() != '.')
        bags.push_back(entry.path().string());
    if (bags.size() == before) throw Error("folder " + argument + ": there is no *.bag in it");
    std::sort(bags.begin() + static_cast<std::ptrdiff_t>(before), bags.end());
  }
  return bags;
}

std::string name_of(const std::string& bag) { return fs::path(bag).stem().string(); }

void require_different_names(const std::vector<std::string>& bags) {
  std::set<std::string> names;
  for (const std::string& bag : bags)
    if (!names.insert(name_of(bag)).second)
      throw Error(fmt::format("two bags are called '{}': their results would share a folder", name_of(bag)));
}

/// Replays a bag; what is amiss with it is said in one line.
ReplayedBag replay_one(const std::string& bag, const ReplayConfig& config, const std::string& directory,
                       ProgressBar& bar) {
  ReplayedBag result{name_of(bag), "", {}};
  const auto say = [&](const std::string& line) {
    bar.clear();
    fmt::print(stderr, "replay: {}\n", line);
  };
  try {
    result.figures = replay_bag(
        bag, config, directory,
        {[&](double share) { bar.at(share, result.name); },
         [&](const std::string& line) { say(result.name + ": " + line); }, [] { return stopped.load(); }});
    bar.clear();
    fmt::print("{}\n", (fs::path(directory) / "report/index.html").string());
    std::fflush(stdout);
  } catch (const Error& error) {
    result.refused = error.what();
    say(result.refused);
  }
  return result;
}

/// This process' share of several bags, and the summary of all where it is the first.
bool replay_several(const std::vector<std::string>& bags, const ReplayConfig& config,
                    const std::string& directory, const Ranks& ranks) {
  ProgressBar bar;
  std::string lines;
  for (std::size_t i = ranks.rank(); i < bags.size(); i += ranks.count())
    lines +=
        to_line(replay_one(bags[i], config, (fs::path(directory) / name_of(bags[i])).string(), bar)) + "\n";
  std::vector<ReplayedBag> results;
  for (const std::string& text : ranks.gather(lines)) {
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) results.push_back(from_line(line));
  }
  const auto fine = [](const ReplayedBag& bag) { return bag.refused.empty(); };
  if (ranks.rank() > 0) return true;
  std::sort(results.begin(), results.end(),
            [](const ReplayedBag& a, const ReplayedBag& b) { return a.name < b.name; });
  write_replay_summary(results, directory);
  fmt::print("{}\n", (fs::path(directory) / "index.html").string());
  return std::all_of(results.begin(), results.end(), fine);
}

int run(int argc, char** argv) {
  CLI::App app(
      "The whole twin on recorded bags, at full speed and without a ROS master: DIR/twin.bag with what the "
      "nodes "
      "would have published and DIR/report/index.html; of several bags a folder each, and a summary. What "
      "has "
      "been done already is not done again. `mpirun -n 4 rosrun aeolian_twin replay ...` shares the bags "
      "among "
      "processes.");
  std::vector<std::string> arguments;
  std::string config_file;
  std::string directory;
  app.add_option("BAG", arguments, "bags with clouds, wind and tf, or folders of such")->required();
  app.add_option("--config", config_file, "YAML file with the parameters of the nodes, see config/twin.yaml")
      ->required();
  app.add_option("--out", directory, "directory for the results, created when it does not exist")->required();
  if (const auto code = parse(app, argc, argv)) return *code;
  const ReplayConfig config = ReplayConfig::read(config_file);
  const std::vector<std::string> bags = bags_of(arguments);
  require_different_names(bags);
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, [](int) { stopped = true; });
  make_directory(directory);
  try {
    const Ranks ranks;
    if (bags.size() > 1 || fs::is_directory(arguments.front()))
      return replay_several(bags, config, directory, ranks) ? 0 : 1;
    ProgressBar bar;
    return ranks.rank() > 0 || replay_one(bags.front(), config, directory, bar).refused.empty() ? 0 : 1;
  } catch (const ReplayStopped&) {
    fmt::print(stderr, "replay: stopped; the same command goes on with the bags that are left\n");
    return 130;
  }
}

}  // namespace
}  // namespace aeolian

int main(int argc, char** argv) {
  return aeolian::run_program("replay", [&] { return aeolian::run(argc, argv); });
}
