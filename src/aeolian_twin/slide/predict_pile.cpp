#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <ros/package.h>

#include "aeolian_core/slide/piles/slide_series.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_twin/slide/slide_studies.hpp"
#include "aeolian_twin/tools/progress_bar.hpp"

namespace aeolian {
namespace {

std::string surrogate_beside(const std::string& config) {
  const std::filesystem::path path(config);
  return (path.parent_path() / (path.stem().string() + "_surrogate.yaml")).string();
}

void print(const PilePrediction& pile) {
  const auto line = [](const char* name, const Estimate& e, const char* unit) {
    fmt::print("{:7}{:.4f}{} ({:.4f} to {:.4f})\n", name, e.value, unit, e.low, e.high);
  };
  line("height", pile.height, " m");
  line("length", pile.length, " m");
  line("H/L", pile.shape, "");
}

/// Nothing when it was stopped.
std::optional<PileSize> simulated(const SlideScene& scene, int events, const std::atomic<bool>& stop) {
  SlideSeries<2> series(scene);
  ProgressBar bar;
  PileSize pile;
  for (int k = 0; k < events; ++k) {
    const auto event = series.next([&](const SlideMoment<2>& moment) {
      bar.at((k + std::min(1., moment.time / scene.longest)) / events, fmt::format("event {}", k + 1));
      return !stop;
    });
    if (!event) return std::nullopt;
    pile = event->pile;
  }
  return pile;
}

}  // namespace

std::string shipped_slide_folder() {
  const std::string package = ros::package::getPath("aeolian_twin");
  if (package.empty())
    throw Error("the package aeolian_twin is not found, so neither is its surrogate; give --table FILE");
  return package + "/config/slide";
}

int predict_pile(const std::string& file, const PileQuery& query, int threads,
                 const std::atomic<bool>& stop) {
  const PileTableConfig config = read_pile_table_config(file);
  SlideScene scene = scene_for(query, config.base.scene, config.cells_per_thickness);
  scene.threads = threads;
  check(scene, 2);
  const SlideSurrogate surrogate = SlideSurrogate::read(surrogate_beside(file));
  if (const auto pile = surrogate.predict(query)) {
    print(*pile);
    fmt::print("by support vectors ({} kernel) learnt from {}; in brackets the interval of {:g} %\n",
               surrogate.kernel() == SvrKernel::rbf ? "RBF" : "linear",
               std::filesystem::path(file).stem().string() + ".csv", 100 * surrogate.coverage());
    return 0;
  }
  fmt::print(
      "outside the surrogate: {}; simulated instead (MPM, two dimensions, {:g} cells in the thickness)\n",
      surrogate.why_outside(query), config.cells_per_thickness);
  std::fflush(stdout);
  const auto pile = simulated(scene, query.event, stop);
  if (!pile) {
    fmt::print(stderr, "slide_snow: stopped\n");
    return stopped_code;
  }
  fmt::print("height {:.4f} m\nlength {:.4f} m\nH/L    {:.4f}\n", pile->height, pile->length, pile->shape());
  return 0;
}

}  // namespace aeolian
