#include <cmath>
#include <filesystem>
#include <sstream>

#include <fmt/format.h>

#include "aeolian_core/slide/calibration/snow_calibration.hpp"
#include "aeolian_core/surface/atomic_file.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/yaml_section.hpp"
#include "aeolian_core/twin/gnuplot.hpp"
#include "aeolian_core/twin/plot_data.hpp"
#include "aeolian_twin/slide/slide_jobs.hpp"
#include "aeolian_twin/slide/slide_studies.hpp"
#include "aeolian_twin/tools/progress_bar.hpp"

namespace aeolian {
namespace {

/// A number of the snow, and the two values it takes.
struct Pair {
  const char* name;
  double SnowLaw::*number;
  double nominal, altered;
};

struct SensitivityConfig {
  SlideConfig base;
  int events = 3;
  int seeds = 1;
  int dimensions = 2;
  std::vector<Pair> pairs;
};

/// Mean over seeds, and its standard error.
struct Index {
  double mean = 0;
  double error = 0;
};

struct IndexRow {
  const char* name;
  int event;
  Index height, length;
};

SensitivityConfig read_sensitivity(const std::string& file) {
  YamlSection root = YamlSection::load(file);
  SensitivityConfig config;
  config.base = read_slide_config((std::filesystem::path(file).parent_path() / root.text("scene")).string());
  SlideScene& scene = config.base.scene;
  scene.panel_height = root.positive("panel_height_m", 1e4);
  config.dimensions = root.integer("dimensions", 2, 3);
  scene.cell = scene.slab_thickness / root.number("cells_per_thickness", 1, 100);
  config.events = root.integer("events", 1, 1000);
  config.seeds = root.integer("seeds", 1, 10000);
  const auto take = [&](const char* key, const char* name, double SnowLaw::*number, double unit) {
    const std::vector<double> ends = root.numbers(key, 2);
    if (!(ends[0] > 0 && ends[1] > 0 && ends[0] != ends[1]))
      root.refuse(key, "must be [nominal, altered], both positive and not the same");
    config.pairs.push_back({name, number, unit * ends[0], unit * ends[1]});
    scene.snow.*number = unit * ends[0];
  };
  take("m", "M", &SnowLaw::friction, 1);
  take("p0_kpa", "p0", &SnowLaw::consolidation, 1e3);
  take("beta", "beta", &SnowLaw::cohesion, 1);
  take("xi", "xi", &SnowLaw::hardening, 1);
  take("youngs_modulus_mpa", "E", &SnowLaw::youngs_modulus, 1e6);
  root.finish();
  return config;
}

/// The nominal scene of every seed, then those of each pair.
std::vector<SlideJob> jobs_of(const SensitivityConfig& config, std::uint64_t seed) {
  std::vector<SlideJob> jobs;
  const auto put = [&](SlideScene scene) {
    for (int k = 0; k < config.seeds; ++k) {
      scene.seed = seed * 1000003 + static_cast<std::uint64_t>(k);
      jobs.push_back({scene, config.events, config.dimensions});
    }
  };
  put(config.base.scene);
  for (const Pair& pair : config.pairs) {
    SlideScene scene = config.base.scene;
    scene.snow.*pair.number = pair.altered;
    put(scene);
  }
  return jobs;
}

/// Of piles after an event, by the means over seeds; its error by those of both means.
Index index_of(const Pair& pair, const std::vector<double>& nominal, const std::vector<double>& altered) {
  const auto mean_of = [](const std::vector<double>& values) {
    Index m;
    const auto n = static_cast<double>(values.size());
    for (const double v : values) m.mean += v / n;
    double square = 0;
    for (const double v : values) square += (v - m.mean) * (v - m.mean);
    m.error = n > 1 ? std::sqrt(square / (n - 1) / n) : 0;
    return m;
  };
  const Index n = mean_of(nominal), a = mean_of(altered);
  const double by_number = std::abs((pair.altered - pair.nominal) / pair.nominal);
  return {sensitivity_index(n.mean, a.mean, pair.nominal, pair.altered),
          a.mean / n.mean * std::hypot(a.error / a.mean, n.error / n.mean) / by_number};
}

std::vector<IndexRow> indices_of(const SensitivityConfig& config,
                                 const std::vector<std::optional<SlideOutcome>>& outcomes) {
  const auto seeds = static_cast<std::size_t>(config.seeds);
  const auto values = [&](std::size_t group, int event, double PileSize::*number) {
    std::vector<double> result;
    for (std::size_t k = group * seeds; k < (group + 1) * seeds; ++k) {
      if (outcomes[k]->piles.size() < static_cast<std::size_t>(event)) throw Error(outcomes[k]->ended);
      result.push_back(outcomes[k]->piles[static_cast<std::size_t>(event) - 1].*number);
    }
    return result;
  };
  std::vector<IndexRow> rows;
  for (std::size_t p = 0; p < config.pairs.size(); ++p)
    for (int event = 1; event <= config.events; ++event) {
      const auto index = [&](double PileSize::*number) {
        return index_of(config.pairs[p], values(0, event, number), values(p + 1, event, number));
      };
      rows.push_back({config.pairs[p].name, event, index(&PileSize::height), index(&PileSize::length)});
    }
  return rows;
}

void plot(const SensitivityConfig& config, const std::vector<IndexRow>& rows, const std::string& file) {
  std::ostringstream script;
  script << plot_style << "set style data histograms\nset style histogram errorbars gap 2 lw 1\n"
         << "set style fill solid\nset xzeroaxis lt -1\nset yrange [*:*]\nset key above\nset multiplot "
            "layout 1,2\n";
  for (const bool height : {true, false}) {
    const char* what = height ? "height" : "length";
    script << "$" << what << " << EOD\n";
    for (std::size_t p = 0; p < config.pairs.size(); ++p) {
      script << config.pairs[p].name;
      for (int e = 0; e < config.events; ++e) {
        const IndexRow& row = rows[p * static_cast<std::size_t>(config.events) + static_cast<std::size_t>(e)];
        const Index& s = height ? row.height : row.length;
        script << fmt::format(" {:.4f} {:.4f}", s.mean, s.error);
      }
      script << "\n";
    }
    script << "EOD\nset ylabel 'S of the " << what << ", relative change per relative change'\nplot ";
    for (int e = 1; e <= config.events; ++e)
      script << fmt::format("${} using {}:{}{} title 'event {}' lc rgb '#{:02x}{:02x}{:02x}'{}", what, 2 * e,
                            2 * e + 1, e == 1 ? ":xtic(1)" : "", e, 168 - 150 * e / config.events,
                            200 - 148 * e / config.events, 226 - 130 * e / config.events,
                            e < config.events ? ", " : "\n");
  }
  script << "unset multiplot\n";
  plot_svg(script.str(), 1000, 420, file);
}

}  // namespace

int study_sensitivity(const std::string& file, const StudyOptions& options) {
  const SensitivityConfig config = read_sensitivity(file);
  const std::vector<SlideJob> jobs = jobs_of(config, options.seed);
  const Ranks ranks;
  make_directory(options.out);
  SlideJournal journal(options.out, fmt::format("sensitivity of {}, seed {}", config.base.name, options.seed),
                       options.fresh, ranks);
  ProgressBar bar;
  const auto outcomes =
      run_jobs(jobs, {journal, ranks, options.threads, options.stop, [&](std::size_t done, std::size_t all) {
                        bar.at(static_cast<double>(done) / static_cast<double>(all), "slides");
                      }});
  bar.clear();
  for (const auto& outcome : outcomes)
    if (!outcome) {
      if (ranks.rank() == 0)
        fmt::print(stderr, "slide_snow: stopped; {} of {} slides are done; the same command goes on\n",
                   journal.count(), jobs.size());
      return stopped_code;
    }
  if (ranks.rank() > 0) return 0;
  const std::vector<IndexRow> rows = indices_of(config, outcomes);
  std::string text =
      "# slide_snow of aeolian_twin " AEOLIAN_VERSION ": " + options.command +
      fmt::format("; seed {}\nparameter,event,s_height,s_height_error,s_length,s_length_error\n",
                  options.seed);
  for (const IndexRow& row : rows) {
    text += fmt::format("{},{},{},{},{},{}\n", row.name, row.event, row.height.mean, row.height.error,
                        row.length.mean, row.length.error);
    fmt::print("{:4} event {}: height {:+.2f} ± {:.2f}, length {:+.2f} ± {:.2f}\n", row.name, row.event,
               row.height.mean, row.height.error, row.length.mean, row.length.error);
  }
  write_text_atomically(options.out + "/sensitivity.csv", text);
  plot(config, rows, options.out + "/sensitivity.svg");
  journal.finish();
  return 0;
}

}  // namespace aeolian
