#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "aeolian_core/slide/calibration/snow_calibration.hpp"
#include "aeolian_core/surface/atomic_file.hpp"
#include "aeolian_core/surface/csv.hpp"
#include "aeolian_core/surface/degree.hpp"
#include "aeolian_core/surface/text.hpp"
#include "aeolian_core/surface/yaml_section.hpp"
#include "aeolian_twin/slide/slide_jobs.hpp"
#include "aeolian_twin/slide/slide_studies.hpp"
#include "aeolian_twin/tools/progress_bar.hpp"

namespace aeolian {
namespace {

struct CalibrationConfig {
  SlideConfig base;
  SnowGrid grid;
  int refinements = 0;
  int dimensions = 2;
};

std::vector<double> values_of(YamlSection& root, const std::string& key, double unit, double least,
                              double most) {
  std::vector<double> values = root.numbers(key);
  if (values.empty()) root.refuse(key, "must be a list of at least one");
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (!(values[k] >= least && values[k] <= most))
      root.refuse_element(key, k, fmt::format("must be from {:g} to {:g}", least, most));
    values[k] *= unit;
  }
  return values;
}

CalibrationConfig read_calibration(const std::string& file) {
  YamlSection root = YamlSection::load(file);
  CalibrationConfig config;
  config.base = read_slide_config((std::filesystem::path(file).parent_path() / root.text("scene")).string());
  config.base.scene.cell = config.base.scene.slab_thickness / root.number("cells_per_thickness", 1, 100);
  config.dimensions = root.integer("dimensions", 2, 3);
  config.grid.friction = values_of(root, "m", 1, 1e-3, 10);
  config.grid.consolidation = values_of(root, "p0_kpa", 1e3, 1e-3, 1e6);
  config.grid.cohesion = values_of(root, "beta", 1, 0, 10);
  config.grid.panel_friction = values_of(root, "panel_friction", 1, 0, 10);
  config.refinements = root.integer("refinements", 0, 100000);
  root.finish();
  return config;
}

/// A job for each set and tilt, with as many events as the laboratory had.
std::vector<SlideJob> jobs_of(const CalibrationConfig& config, const std::vector<LabPile>& lab,
                              const std::vector<SnowSet>& sets, std::uint64_t seed) {
  std::map<double, int> events;
  for (const LabPile& pile : lab) events[pile.tilt] = std::max(events[pile.tilt], pile.event);
  std::vector<SlideJob> jobs;
  for (const SnowSet& set : sets)
    for (const auto& [tilt, count] : events) {
      SlideJob job{with_snow(config.base.scene, set), count, config.dimensions};
      job.scene.tilt = tilt;
      job.scene.seed = seed;
      jobs.push_back(job);
    }
  return jobs;
}

/// Nothing when a job was stopped.
std::optional<std::vector<PileErrors>> errors_of(const std::vector<LabPile>& lab, std::size_t sets,
                                                 const std::vector<SlideJob>& jobs,
                                                 const std::vector<std::optional<SlideOutcome>>& outcomes) {
  std::vector<PileErrors> errors;
  const std::size_t tilts = jobs.size() / sets;
  for (std::size_t s = 0; s < sets; ++s) {
    std::vector<std::optional<PileSize>> piles;
    for (const LabPile& pile : lab)
      for (std::size_t k = s * tilts; k < (s + 1) * tilts; ++k) {
        if (!outcomes[k]) return std::nullopt;
        if (jobs[k].scene.tilt != pile.tilt) continue;
        const auto event = static_cast<std::size_t>(pile.event);
        const auto& there = outcomes[k]->piles;
        piles.push_back(event <= there.size() ? std::make_optional(there[event - 1]) : std::nullopt);
      }
    errors.push_back(errors_against(lab, piles));
  }
  return errors;
}

void write_sets(const SnowCalibration& result, const std::string& file, const std::string& comment) {
  Table table;
  table.names = {"m",     "p0_kpa", "beta", "panel_friction", "rmse_height_m", "rmse_length_m",
                 "score", "refined"};
  table.columns.resize(table.names.size());
  const auto put = [&](const ScoredSet& s, double refined) {
    const double row[] = {s.set.friction,  s.set.consolidation / 1e3, s.set.cohesion, s.set.panel_friction,
                          s.errors.height, s.errors.length,           s.score,        refined};
    for (std::size_t k = 0; k < table.columns.size(); ++k) table.columns[k].push_back(row[k]);
  };
  for (const ScoredSet& set : result.grid) put(set, 0);
  for (const ScoredSet& set : result.refined) put(set, 1);
  write_csv(table, file, comment);
}

/// The place of a set among those of the grid, by one error.
std::size_t rank_of(const std::vector<ScoredSet>& sets, const ScoredSet& set, double PileErrors::*error) {
  return 1 + static_cast<std::size_t>(std::count_if(sets.begin(), sets.end(), [&](const ScoredSet& other) {
           return other.errors.*error < set.errors.*error;
         }));
}

/// The scene of the config with the numbers of the best set.
void write_scene(const std::string& scene_file, const SnowSet& set, const std::string& file,
                 const std::string& comment) {
  YAML::Node scene = YAML::LoadFile(scene_file);
  scene["snow"]["m"] = set.friction;
  scene["snow"]["p0_kpa"] = set.consolidation / 1e3;
  scene["snow"]["beta"] = set.cohesion;
  scene["panel"]["friction"] = set.panel_friction;
  write_text_atomically(file, "# " + comment + "\n" + YAML::Dump(scene) + "\n");
}

}  // namespace

int calibrate_snow(const std::string& file, const std::string& lab_file, const StudyOptions& options) {
  const CalibrationConfig config = read_calibration(file);
  const std::vector<LabPile> lab = read_lab_piles(lab_file);
  const Ranks ranks;
  make_directory(options.out);
  SlideJournal journal(options.out,
                       fmt::format("calibration of {}, {} dimensions, seed {}", config.base.name,
                                   config.dimensions, options.seed),
                       options.fresh, ranks);
  ProgressBar bar;
  std::size_t tried = 0;
  const std::size_t all = sets_of(config.grid).size();
  const auto result = calibrate(config.grid, config.refinements, [&](const std::vector<SnowSet>& sets) {
    const auto jobs = jobs_of(config, lab, sets, options.seed);
    const auto outcomes = run_jobs(
        jobs, {journal, ranks, options.threads, options.stop, [&](std::size_t done, std::size_t of) {
                 const double share = static_cast<double>(done) / static_cast<double>(of);
                 const auto left = static_cast<double>(all) + config.refinements;
                 bar.at((static_cast<double>(tried) + share * static_cast<double>(sets.size())) / left,
                        "sets of snow");
               }});
    tried += sets.size();
    return errors_of(lab, sets.size(), jobs, outcomes);
  });
  bar.clear();
  if (!result) {
    if (ranks.rank() == 0)
      fmt::print(stderr, "slide_snow: stopped; {} slides are done; the same command goes on\n",
                 journal.count());
    return stopped_code;
  }
  if (ranks.rank() > 0) return 0;
  const std::string comment = "slide_snow of aeolian_twin " AEOLIAN_VERSION ": " + options.command +
                              fmt::format("; seed {}", options.seed);
  write_sets(*result, options.out + "/calibration.csv", comment);
  const std::filesystem::path folder = std::filesystem::path(file).parent_path();
  write_scene((folder / YAML::LoadFile(file)["scene"].as<std::string>()).string(), result->best.set,
              options.out + "/calibrated.yaml", comment);
  journal.finish();
  const ScoredSet& best = result->best;
  fmt::print("M {:.3g}, p0 {:.3g} kPa, beta {:.3g}, panel friction {:.3g}: score {:.3f}\n", best.set.friction,
             best.set.consolidation / 1e3, best.set.cohesion, best.set.panel_friction, best.score);
  fmt::print("height off by {:.4f} m, better: {} of {} sets; length off by {:.4f} m, better: {}\n",
             best.errors.height, rank_of(result->grid, best, &PileErrors::height) - 1, result->grid.size(),
             best.errors.length, rank_of(result->grid, best, &PileErrors::length) - 1);
  fmt::print("{} sets -> {}\n", result->grid.size() + result->refined.size(), options.out);
  return 0;
}

}  // namespace aeolian
