#include "aeolian_twin/replay/replay_bag.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "aeolian_core/surface/atomic_file.hpp"
#include "aeolian_core/surface/csv.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/twin/report.hpp"
#include "aeolian_core/twin/score_summary.hpp"
#include "aeolian_twin/replay/bag_source.hpp"
#include "aeolian_twin/replay/twin_bag.hpp"
#include "aeolian_twin/replay/twin_replay.hpp"
#include "aeolian_twin/report/recorded_run.hpp"
#include "aeolian_twin/tools/output_bag.hpp"

namespace aeolian {
namespace {

namespace fs = std::filesystem;

const char* const figures_file = "replay.csv";
const char* const made_from_file = "made_from.txt";

/// What decides a replay, as a text: the parameters, the bag and the files that they name; name, size and
/// time stand for the content of these.
std::string origin_of(const std::string& bag, const ReplayConfig& config) {
  std::string origin;
  std::vector<std::string> files = config.files;
  files.insert(files.begin(), bag);
  for (const std::string& file : files)
    if (fs::is_regular_file(file))
      origin += fmt::format("{}: {} bytes, written at {}\n", fs::path(file).filename().string(),
                            fs::file_size(file), fs::last_write_time(file).time_since_epoch().count());
  return origin + "\n" + config.text;
}

std::string content_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

ReplayFigures figures_of(const Run& run) {
  ReplayFigures figures;
  figures.duration = run.states.back().time - run.states.front().time;
  figures.maps = static_cast<double>(run.states.size());
  figures.forecasts = static_cast<double>(run.forecasts);
  figures.scored = static_cast<double>(run.scores.size());
  figures.lead_time = figures.rmse = figures.skill_persistence = figures.skill_translation = NAN;
  if (run.scores.empty()) return figures;
  const LeadSummary longest = summarise_by_lead(run.scores).back();
  figures.lead_time = longest.lead_time;
  figures.rmse = longest.spread(&Comparison::rmse).median;
  figures.skill_persistence = longest.spread(&Comparison::skill_persistence).median;
  figures.skill_translation = longest.spread(&Comparison::skill_translation).median;
  return figures;
}

void write_figures(const ReplayFigures& figures, const fs::path& path) {
  Table table;
  for (const ReplayFigure& figure : replay_figures) {
    table.names.emplace_back(figure.name);
    table.columns.push_back({figures.*figure.value});
  }
  write_csv(table, path.string());
}

ReplayFigures read_figures(const fs::path& path) {
  const Table table = read_csv(path.string());
  ReplayFigures figures;
  for (const ReplayFigure& figure : replay_figures) figures.*figure.value = table.column(figure.name).at(0);
  return figures;
}

void write_twin_bag(const std::string& bag, const ReplayConfig& config, const fs::path& path,
                    const ReplayWatch& watch) {
  write_bag_atomically(path.string(), [&](rosbag::Bag& file) {
    TwinBag out(file);
    BagSource source(bag, config);
    TwinReplay twin(config, out, watch.complain);
    while (const auto message = source.next()) {
      if (watch.stopped()) throw ReplayStopped();
      twin.take(*message);
      watch.progress(message->share);
    }
    twin.finish();
    out.finish();
    twin.save_learned(path.parent_path() / "learned.yaml");
  });
}

}  // namespace

ReplayFigures replay_bag(const std::string& bag, const ReplayConfig& config, const std::string& directory,
                         const ReplayWatch& watch) {
  const fs::path folder(directory);
  const fs::path made_from = folder / made_from_file;
  if (!fs::is_regular_file(bag)) throw Error("bag " + bag + ": there is no such file");
  const std::string origin = origin_of(bag, config);
  if (content_of(made_from) == origin && fs::exists(folder / "twin.bag")) {
    watch.progress(1);
    return read_figures(folder / figures_file);
  }
  { const BagSource checked(bag, config); }  // before anything is written
  make_directory(directory);
  fs::remove(made_from);
  try {
    write_twin_bag(bag, config, folder / "twin.bag", watch);
  } catch (const Error& error) {
    const std::string line = error.what();
    throw line.rfind("bag ", 0) == 0 ? error : Error("bag " + bag + ": " + line);
  }
  Run run = read_recorded_run((folder / "twin.bag").string());
  run.source = fs::path(bag).filename().string();
  write_report(run, (folder / "report").string());
  const ReplayFigures figures = figures_of(run);
  write_figures(figures, folder / figures_file);
  write_text_atomically(made_from.string(), origin);
  return figures;
}

}  // namespace aeolian
