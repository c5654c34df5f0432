#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "aeolian_core/surface/atomic_file.hpp"
#include "aeolian_core/surface/degree.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/yaml_section.hpp"
#include "aeolian_twin/slide/slide_jobs.hpp"
#include "aeolian_twin/slide/slide_studies.hpp"
#include "aeolian_twin/tools/progress_bar.hpp"

namespace aeolian {
namespace {

Range range_of(YamlSection& root, const std::string& key, double least, double most) {
  const std::vector<double> ends = root.numbers(key);
  if (ends.size() != 2 || !(ends[0] >= least && ends[1] >= ends[0] && ends[1] <= most))
    root.refuse(key, fmt::format("must be [low, high], rising within {:g} to {:g}", least, most));
  return {ends[0], ends[1]};
}

std::string settings_of(const PileTableConfig& config, const std::string& file, std::uint64_t seed) {
  return fmt::format("{}\nsnow: {}\nseed: {}\n", YAML::Dump(YAML::LoadFile(file)), config.base.name, seed);
}

constexpr std::size_t least_runs = 10;  ///< as many as folds

}  // namespace

SlideSurrogate best_surrogate(const PileTable& table, std::uint64_t seed) {
  const TrainingRows rows = rows_of(table, [](const PileRecord& r) { return r.shape(); });
  SlideSurrogate::Settings settings;
  settings.seed = seed;
  const auto folds = grouped_folds(rows.runs, settings.folds, seed);
  double least = std::numeric_limits<double>::infinity();
  for (const SvrKernel kernel : {SvrKernel::linear, SvrKernel::rbf}) {
    const auto predicted = out_of_fold(rows, folds, best_settings(rows, folds, kernel, settings.grid));
    double error = 0;
    for (std::size_t k = 0; k < predicted.size(); ++k)
      error += std::abs(std::exp(predicted[k]) - std::exp(rows.targets[k]));
    if (error < least) settings.kernel = kernel;
    least = std::min(least, error);
  }
  return SlideSurrogate::train(table, settings);
}

PileTableConfig read_pile_table_config(const std::string& file) {
  YamlSection root = YamlSection::load(file);
  PileTableConfig config;
  config.base = read_slide_config((std::filesystem::path(file).parent_path() / root.text("scene")).string());
  config.design.panel_length = range_of(root, "panel_length_m", 1e-3, 1e4);
  config.design.panel_height = range_of(root, "panel_height_m", 1e-3, 1e4);
  const Range tilt = range_of(root, "tilt_deg", 1, 89);
  config.design.tilt = {tilt.low * degree, tilt.high * degree};
  config.design.thickness = range_of(root, "thickness_m", 1e-3, 1e3);
  config.design.runs = root.integer("runs", 1, 100000);
  config.cells_per_thickness = root.number("cells_per_thickness", 1, 100);
  config.events = root.integer("events", 1, 1000);
  root.finish();
  return config;
}

int make_pile_table(const std::string& file, const StudyOptions& options) {
  PileTableConfig config = read_pile_table_config(file);
  config.design.seed = options.seed;
  const std::vector<PileQuery> panels = panels_of(config.design);
  std::vector<SlideJob> jobs;
  for (std::size_t run = 0; run < panels.size(); ++run) {
    SlideJob job{scene_for(panels[run], config.base.scene, config.cells_per_thickness), config.events};
    job.scene.seed = options.seed * 1000003 + run;
    jobs.push_back(job);
  }
  const Ranks ranks;
  make_directory(options.out);
  SlideJournal journal(options.out, settings_of(config, file, options.seed), options.fresh, ranks);
  ProgressBar bar;
  const auto outcomes =
      run_jobs(jobs, {journal, ranks, options.threads, options.stop, [&](std::size_t done, std::size_t all) {
                        bar.at(static_cast<double>(done) / static_cast<double>(all), "panels");
                      }});
  bar.clear();
  if (ranks.rank() > 0) return options.stop ? stopped_code : 0;
  PileTable table;
  std::size_t done = 0, slid = 0;
  for (std::size_t run = 0; run < jobs.size(); ++run) {
    if (!outcomes[run]) continue;
    ++done;
    slid += outcomes[run]->piles.empty() ? 0 : 1;
    if (!outcomes[run]->ended.empty()) fmt::print("panel {}: {}\n", run, outcomes[run]->ended);
    for (std::size_t k = 0; k < outcomes[run]->piles.size(); ++k) {
      const PileSize& pile = outcomes[run]->piles[k];
      PileRecord record{static_cast<int>(run),
                        panels[run],
                        jobs[run].scene.cell,
                        pile.height,
                        pile.length,
                        pile.head,
                        pile.tail};
      record.query.event = static_cast<int>(k) + 1;
      table.push_back(record);
    }
  }
  if (done < jobs.size()) {
    fmt::print(stderr, "slide_snow: stopped; {} of {} panels are done; the same command goes on\n", done,
               jobs.size());
    return stopped_code;
  }
  if (table.empty()) throw Error(file + ": no slab has left its panel, there is nothing to tabulate");
  const std::string name = options.out + "/" + std::filesystem::path(file).stem().string();
  const std::string comment = fmt::format(
      "slide_snow of aeolian_twin " AEOLIAN_VERSION
      ": {}; seed {}; two dimensions, {:g} cells in the thickness, panel friction {:g}",
      options.command, options.seed, config.cells_per_thickness, config.base.scene.panel_friction);
  write_pile_table(table, name + ".csv", comment);
  fmt::print("{} piles of {} panels -> {}.csv\n", table.size(), jobs.size(), name);
  if (slid < least_runs)
    fmt::print("{} panels from which slabs have slid are too few to learn from, {} are the least\n", slid,
               least_runs);
  else {
    const SlideSurrogate surrogate = best_surrogate(table, options.seed);
    surrogate.write(name + "_surrogate.yaml", comment);
    plot_predicted(table, surrogate, options.seed, name + "_predicted.svg");
  }
  journal.finish();
  return 0;
}

}  // namespace aeolian
