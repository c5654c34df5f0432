#include <atomic>
#include <chrono>
#include <cmath>

#include <fmt/format.h>

#include "aeolian_twin/slide/slide_files.hpp"
#include "aeolian_twin/slide/slide_studies.hpp"
#include "aeolian_twin/tools/progress_bar.hpp"

namespace aeolian {
namespace {

constexpr double usual_duration = 1.2;  ///< of an event [s], for the progress bar

template <int Dim>
std::optional<KeptEvent<Dim>> run_event(SlideSeries<Dim>& series, int all, const std::atomic<bool>& stop) {
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
int run_series(const SlideConfig& config, const std::string& command, const std::string& out,
               const std::atomic<bool>& stop) {
  SlideSeries<Dim> series(config.scene);
  std::vector<KeptEvent<Dim>> events;
  while (static_cast<int>(events.size()) < config.events) {
    auto kept = run_event<Dim>(series, config.events, stop);
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

}  // namespace

int run_slides(const SlideConfig& config, int dimensions, const std::string& command, const std::string& out,
               const std::atomic<bool>& stop) {
  return dimensions == 2 ? run_series<2>(config, command, out, stop)
                         : run_series<3>(config, command, out, stop);
}

}  // namespace aeolian
