// slide_snow: snow slides off a tilted panel, falls, and piles up.

#include <atomic>
#include <cmath>
#include <csignal>

#include <CLI/CLI.hpp>

#include "aeolian_core/surface/atomic_file.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_twin/slide/slide_studies.hpp"
#include "aeolian_twin/tools/program.hpp"

namespace aeolian {
namespace {

constexpr const char* description =
    R"(Lets slabs of snow slide off a tilted panel, one after another, and tells what pile they build (Frischholz).

    slide_snow --config config/slide/lab_40deg.yaml [--events 5] [--dim 2|3] --out DIR
    slide_snow --predict --panel-length 2 --panel-height 1 --tilt-deg 40 --thickness-m 0.05 --event 3
    slide_snow --make-table config/slide/piles_2d.yaml --out DIR
    slide_snow --calibrate lab.csv --config config/slide/calibration.yaml --out DIR
    slide_snow --sensitivity --config config/slide/sensitivity.yaml --out DIR

Written to DIR: events.csv and events.yaml (height, length, head, tail of the pile after each event), particles_NN.csv and
pile_NN.tif (.csv in two dimensions), event_NN.png (in motion by speed, at rest by p0), profiles.svg, growth.svg.
Ctrl-C keeps the events that are over. --predict answers at once from what --make-table has taught. Studies of many slides
(--make-table, --calibrate, --sensitivity) go on where they were stopped, and share their slides among processes
under mpirun. docs/slide_snow.md explains configs and results.)";

std::atomic<bool> stop{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal's handler sets it");

struct Flags {
  std::string config, out, table, new_table, lab;
  PileQuery query;
  double tilt_deg = 40;
  int events = 0, dim = 2, threads = 0;
  std::uint64_t seed = 1;
  bool predict = false, sensitivity = false, fresh = false;
};

void require_flag(const std::string& value, const char* flag) {
  if (value.empty()) throw Error(std::string(flag) + " is required");
}

int run_scene(const Flags& flags, const std::string& command) {
  SlideConfig config = read_slide_config(flags.config);
  if (flags.events > 0) config.events = flags.events;
  config.scene.seed = flags.seed;
  config.scene.threads = flags.threads;
  check(config.scene, flags.dim);
  make_directory(flags.out);
  return run_slides(config, flags.dim, command, flags.out, stop);
}

void add_query(CLI::App& app, Flags& flags, CLI::Option* predict) {
  const auto number = [&](const char* name, double& value, const char* what) {
    app.add_option(name, value, what)->check(CLI::PositiveNumber)->capture_default_str()->needs(predict);
  };
  number("--panel-length", flags.query.panel_length, "along the slope, and that of the slab [m]");
  number("--panel-height", flags.query.panel_height, "of the panel's lower edge above the ground [m]");
  number("--tilt-deg", flags.tilt_deg, "of the panel below the horizontal");
  number("--thickness-m", flags.query.thickness, "of the slab, normal to the panel");
  app.add_option("--event", flags.query.event, "slabs that have slid")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str()
      ->needs(predict);
  app.add_option("--table", flags.table, "config whose surrogate answers, default that of the package")
      ->needs(predict);
}

int run(int argc, char** argv) {
  CLI::App app(description);
  Flags flags;
  app.add_option("--config", flags.config, "YAML file of the scene or study, see config/slide");
  app.add_option("--events", flags.events, "slabs that slide, instead of the config's")
      ->check(CLI::Range(1, 1000));
  app.add_option("--dim", flags.dim, "2: a slice of an infinitely wide panel; 3")
      ->check(CLI::IsMember({2, 3}))
      ->capture_default_str();
  auto* predict = app.add_flag("--predict", flags.predict, "the pile below a panel, at once");
  auto* table =
      app.add_option("--make-table", flags.new_table, "YAML file of the panels to simulate, and learn from");
  auto* lab = app.add_option("--calibrate", flags.lab, "piles of the laboratory (CSV) to fit the snow to");
  auto* sensitivity =
      app.add_flag("--sensitivity", flags.sensitivity, "of piles to the numbers of the snow, one at a time");
  predict->excludes(table)->excludes(lab)->excludes(sensitivity);
  table->excludes(lab)->excludes(sensitivity);
  lab->excludes(sensitivity);
  add_query(app, flags, predict);
  app.add_option("--seed", flags.seed, "decides everything random")->capture_default_str();
  app.add_option("--threads", flags.threads, "0: all; the result does not depend on it")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  app.add_flag("--fresh", flags.fresh, "begin anew where --out holds an unfinished study");
  app.add_option("--out", flags.out, "folder for the results, created when it does not exist");
  if (const auto code = parse(app, argc, argv)) return *code;
  std::signal(SIGINT, [](int) { stop = true; });
  std::signal(SIGTERM, [](int) { stop = true; });
  if (flags.predict) {
    flags.query.tilt = flags.tilt_deg * M_PI / 180;
    if (flags.table.empty()) flags.table = shipped_slide_folder() + "/piles_2d.yaml";
    return predict_pile(flags.table, flags.query, flags.threads, stop);
  }
  if (flags.new_table.empty()) require_flag(flags.config, "--config");
  require_flag(flags.out, "--out");
  const StudyOptions options{
      flags.out, flags.seed, flags.threads, flags.fresh, typed_command("slide_snow", argc, argv), stop};
  if (!flags.new_table.empty()) return make_pile_table(flags.new_table, options);
  if (!flags.lab.empty()) return calibrate_snow(flags.config, flags.lab, options);
  if (flags.sensitivity) return study_sensitivity(flags.config, options);
  return run_scene(flags, options.command);
}

}  // namespace
}  // namespace aeolian

int main(int argc, char** argv) {
  return aeolian::run_program("slide_snow", [&] { return aeolian::run(argc, argv); });
}
