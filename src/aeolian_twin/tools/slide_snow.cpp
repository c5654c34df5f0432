// slide_snow: snow slides off a tilted panel, falls, and piles up.

#include <atomic>
#include <chrono>
#include <csignal>
#include <filesystem>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "aeolian_core/surface/atomic_file.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_twin/slide/slide_files.hpp"
#include "aeolian_twin/tools/program.hpp"
#include "aeolian_twin/tools/progress_bar.hpp"

namespace aeolian {
namespace {

constexpr const char* description =
    R"(Lets slabs of snow slide off a tilted panel, one after another, and tells what pile they build (Frischholz).

    slide_snow --config config/slide/lab_40deg.yaml [--events 5] [--dim 2|3] --out DIR

Written to DIR: events.csv and events.yaml (height, length, head, tail of the pile after each event), particles_NN.csv and
pile_NN.tif (.csv in two dimensions), event_NN.png (in motion by speed, at rest by p0), profiles.svg, growth.svg.
Ctrl-C keeps the events that are over. docs/slide_snow.md explains configs and results.)";

constexpr int stopped_code = 130;       // as a shell has it for a program that Ctrl-C has ended
constexpr double usual_duration = 1.2;  ///< of an event [s], for the progress bar

std::atomic<bool> stop{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal's handler sets it");

template <int Dim>
std::optional<KeptEvent<Dim>> run_event(SlideSeries<Dim>& series, int all) {
  KeptEvent<Dim> kept;
  double fastest = 0;
  ProgressBar bar;
  const auto begin = std::chrono::steady_clock::now();
  auto event = series.next([&](const SlideMoment<Dim>& moment) {
    if (moment.snow.fastest() > fastest) {
      fastest = moment.snow.fastest();
      kept.in_motion = moment.snow.points();
      kept.motion_time = moment.time;
    }
    const double share = 1 - std::exp(-moment.time / usual_duration);
    bar.at((moment.event - 1 + share) / all,
           fmt::format("event {}, {:.2f} s of slide", moment.event, moment.time));
    return !stop;
  });
  if (!event) return std::nullopt;
  kept.event = std::move(*event);
  kept.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return kept;
}

template <int Dim>
int run_series(const SlideConfig& config, const std::string& command, const std::string& out) {
  SlideSeries<Dim> series(config.scene);
  std::vector<KeptEvent<Dim>> events;
  while (static_cast<int>(events.size()) < config.events) {
    auto kept = run_event<Dim>(series, config.events);
    if (!kept) break;
    events.push_back(std::move(*kept));
    const SlideEvent<Dim>& e = events.back().event;
    write_snow<Dim>(config, e, out);
    write_events<Dim>(config, events, command, out);
    draw_event<Dim>(config, events.back(), out);
    fmt::print("event {}: pile {:.3f} m high, {:.3f} m long, from {:.3f} to {:.3f} m; {:.0f} kg/m3{}\n",
               e.number, e.pile.height, e.pile.length, e.pile.head, e.pile.tail, e.density,
               e.still ? "" : "; not yet at rest when its time was over");
  }
  if (!events.empty()) plot_piles<Dim>(config, events, out);
  if (stop) {
    fmt::print(stderr, "slide_snow: stopped; {} of {} events are over and written to {}\n", events.size(),
               config.events, out);
    return stopped_code;
  }
  return 0;
}

int run(int argc, char** argv) {
  CLI::App app(description);
  std::string file, out;
  int events = 0, dim = 2, threads = 0;
  std::uint64_t seed = 1;
  app.add_option("--config", file, "YAML file of the scene, see config/slide")->required();
  const auto* events_option = app.add_option("--events", events, "slabs that slide, instead of the config's")
                                  ->check(CLI::Range(1, 1000));
  app.add_option("--dim", dim, "2: a slice of an infinitely wide panel; 3")
      ->check(CLI::IsMember({2, 3}))
      ->capture_default_str();
  app.add_option("--seed", seed, "decides everything random")->capture_default_str();
  app.add_option("--threads", threads, "0: all; the result does not depend on it")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  app.add_option("--out", out, "folder for the results, created when it does not exist")->required();
  if (const auto code = parse(app, argc, argv)) return *code;
  SlideConfig config = read_slide_config(file);
  if (events_option->count() > 0) config.events = events;
  config.scene.seed = seed;
  config.scene.threads = threads;
  check(config.scene, dim);
  std::signal(SIGINT, [](int) { stop = true; });
  std::signal(SIGTERM, [](int) { stop = true; });
  make_directory(out);
  const std::string command = typed_command("slide_snow", argc, argv);
  return dim == 2 ? run_series<2>(config, command, out) : run_series<3>(config, command, out);
}

}  // namespace
}  // namespace aeolian

int main(int argc, char** argv) {
  return aeolian::run_program("slide_snow", [&] { return aeolian::run(argc, argv); });
}
