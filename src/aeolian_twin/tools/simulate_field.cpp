// simulate_field: a virtual field day, written to a bag, with the truth beside it.
//
// The bed is a lattice of grains under a gusty wind, another model than the one that forecasts. Scanners, a
// camera over a straightedge's shadow and an anemometer see it; everything they see goes into
// DIR/field_day.bag.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include "aeolian_core/surface/surface.hpp"
#include "aeolian_twin/tools/field_bag.hpp"
#include "aeolian_twin/tools/field_day.hpp"
#include "aeolian_twin/tools/output_bag.hpp"
#include "aeolian_twin/tools/program.hpp"

namespace aeolian {
namespace {

constexpr double bed_step = 1;       // the bed advances under the mean wind of so long [s]
constexpr double truth_period = 60;  // between stored truths [s]

/// Seeds of the things that are random, none like another.
enum class Source : std::uint64_t { bed, wind, camera, scanner };

std::uint64_t derived_seed(std::uint64_t seed, Source source, std::uint64_t number = 0) {
  const auto bits = Philox(seed)(number, static_cast<std::uint64_t>(source));
  return std::uint64_t{bits[1]} << 32 | bits[0];
}

/// The wind of the day and what it does to the bed.
class Wind {
 public:
  explicit Wind(const FieldDay& day)
      : day_(day),
        samples_(day.anemometer.record(day.duration, day.wind_rate, derived_seed(day.seed, Source::wind))) {}

  const std::vector<VirtualAnemometer::Sample>& samples() const { return samples_; }

  Forcing mean() const { return forcing(day_.anemometer.mean_speed, day_.anemometer.direction); }
  /// Mean over the samples of a time from `from` to `to` [s].
  Forcing mean(double from, double to) const {
    std::vector<Forcing> forcings;
    for (const auto* sample : between(from, to))
      forcings.push_back(forcing(sample->speed, sample->direction));
    return mean_forcing(forcings, std::vector<double>(forcings.size(), 1));
  }
  double mean_friction_velocity(double from, double to) const {
    const auto some = between(from, to);
    double sum = 0;
    for (const auto* sample : some) sum += friction(sample->speed);
    return sum / static_cast<double>(some.size());
  }

 private:
  double friction(double speed) const {
    return friction_velocity(speed, day_.anemometer.height, grain_roughness(day_.grain.diameter));
  }
  Forcing forcing(double speed, double direction) const {
    return make_forcing(steady_saltation(friction(speed), day_.grain), direction, day_.grain, MeanSplash{});
  }
  /// The samples in [from, to), at least the last one before `to`.
  std::vector<const VirtualAnemometer::Sample*> between(double from, double to) const {
    std::vector<const VirtualAnemometer::Sample*> result;
    const auto index = [&](double time) {
      const double at = std::ceil(time * day_.wind_rate - 1e-6);
      return static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(samples_.size())));
    };
    const std::size_t end = std::max<std::size_t>(1, index(to));
    for (std::size_t i = std::min(index(from), end - 1); i < end; ++i) result.push_back(&samples_[i]);
    return result;
  }

  const FieldDay& day_;
  std::vector<VirtualAnemometer::Sample> samples_;
};

/// How far the day is, on a terminal.
class Progress {
 public:
  explicit Progress(double duration) : duration_(duration), shown_(isatty(STDERR_FILENO) != 0) {}
  ~Progress() {
    if (shown_) std::fputs("\r\033[K", stderr);
  }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void spin_up() const {
    if (shown_) std::fputs("\rthe bed is spun up ...\033[K", stderr);
  }
  void at(double time) const {
    if (shown_) std::fprintf(stderr, "\r%.1f of %.1f min\033[K", time / 60, duration_ / 60);
  }

 private:
  double duration_;
  bool shown_;
};

class Simulation {
 public:
  Simulation(const FieldDay& day, const std::string& directory, FieldBag& bag)
      : day_(day),
        truth_directory_(directory + "/truth"),
        bag_(bag),
        progress_(day.duration),
        wind_(day),
        bed_(even_columns(day.plot.length_x()), even_columns(day.plot.length_y()), day.lattice_spacing,
             day.grain.angle_of_repose, derived_seed(day.seed, Source::bed)),
        surface_(day.plot) {
    truth_.names = {"t_s", "wavelength_m", "height_m", "friction_velocity_m_s"};
    truth_.columns.resize(truth_.names.size());
  }

  void run() {
    bag_.write_frames(day_);
    progress_.spin_up();
    bed_.advance(wind_.mean(), day_.spin_up);

    // What is to come, each at a multiple of its period; what is late ends the day.
    double next_truth = 0;
    std::uint64_t scans = 0;
    std::uint64_t photos = 0;
    while (true) {
      const double next_scan = static_cast<double>(scans) * day_.scan_period;
      const double next_photo = static_cast<double>(photos) * day_.photo_period;
      const double next = std::min({next_scan, next_photo, next_truth, day_.duration});
      advance(next);
      if (next == next_scan) scan(scans++);
      if (next == next_photo) photograph(photos++);
      if (next == next_truth || next == day_.duration) {
        store_truth();
        next_truth += truth_period;
      }
      if (next == day_.duration) break;
    }
    write_csv(truth_, truth_directory_ + "/truth.csv");
  }

 private:
  int even_columns(double length) const {
    return 2 * std::max(2, static_cast<int>(std::ceil(length / day_.lattice_spacing / 2 - 1e-6)));
  }

  /// Brings the bed to a time and writes the wind up to it.
  void advance(double time) {
    while (time_ < time) {
      const double to = std::min(time_ + bed_step, time);
      bed_.advance(wind_.mean(time_, to), to - time_);
      time_ = to;
      progress_.at(time_);
    }
    surface_.add(layer::elevation, bed_.elevation(day_.plot));
    const auto& samples = wind_.samples();
    for (; winds_ < samples.size() && samples[winds_].time <= time; ++winds_) {
      bag_.write(samples[winds_]);
    }
  }

  void scan(std::uint64_t number) {
    for (std::size_t i = 0; i < day_.scanners.size(); ++i) {
      const VirtualScanner& scanner = day_.scanners[i];
      const auto cloud = scanner.scan(surface_, derived_seed(day_.seed, Source::scanner, i), number);
      bag_.write(cloud, scanner, i, time_);
    }
  }

  void photograph(std::uint64_t number) {
    bag_.write(day_.camera.photograph(surface_, day_.straightedge, day_.light, day_.grain.diameter,
                                      derived_seed(day_.seed, Source::camera, number)),
               day_.camera, time_);
  }

  void store_truth() {
    write_geotiff(surface_, fmt::format("{}/elevation_{:04.0f}.tif", truth_directory_, time_));
    const auto ripples =
        ripple_statistics(day_.plot, surface_.layer(layer::elevation), day_.anemometer.direction);
    const double before = truth_.rows() == 0 ? 0 : truth_.columns[0].back();
    const double friction = wind_.mean_friction_velocity(before, time_);
    const std::array<double, 4> row{time_, ripples.wavelength, ripples.height, friction};
    for (std::size_t i = 0; i < row.size(); ++i) truth_.columns[i].push_back(row[i]);
  }

  const FieldDay& day_;
  std::string truth_directory_;
  FieldBag& bag_;
  Progress progress_;
  Wind wind_;
  LatticeBed bed_;
  HeightMap surface_;
  Table truth_;
  double time_ = 0;
  std::size_t winds_ = 0;
};

/// An earlier day's truth must not stand among this one's.
void clear_truth(const std::string& directory) {
  make_directory(directory);
  for (const auto& entry : std::filesystem::directory_iterator(directory)) {
    const std::string name = entry.path().filename().string();
    if (name.rfind("elevation_", 0) == 0 && entry.path().extension() == ".tif")
      std::filesystem::remove(entry.path());
  }
}

void simulate(const FieldDay& day, const std::string& directory) {
  make_directory(directory);
  clear_truth(directory + "/truth");
  write_text_atomically(directory + "/shadow_setup.yaml", shadow_setup(day));
  write_bag_atomically(directory + "/field_day.bag", [&](rosbag::Bag& file) {
    FieldBag bag(file, day.start);
    Simulation(day, directory, bag).run();
  });
}

int run(int argc, char** argv) {
  CLI::App app(
      "A virtual field day: DIR/field_day.bag with /points, /wind, /image, /camera_info and /tf_static; the "
      "true elevation "
      "of every minute and its ripples in DIR/truth; DIR/shadow_setup.yaml for measuring the photographs.");
  std::string config;
  std::string directory;
  std::uint64_t seed = 0;
  double minutes = 0;
  app.add_option("--config", config, "YAML file of the day, see config/field_day.yaml")->required();
  app.add_option("--out", directory, "directory for the results, created when it does not exist")->required();
  const auto* seed_option = app.add_option("--seed", seed, "decides everything random; overrides the file's");
  const auto* minutes_option = app.add_option("--minutes", minutes, "length of the day; overrides the file's")
                                   ->check(CLI::Range(0.001, 1e4));
  if (const auto code = parse(app, argc, argv)) return *code;
  FieldDay day = read_field_day(config);
  if (seed_option->count() > 0) day.seed = seed;
  if (minutes_option->count() > 0) day.duration = 60 * minutes;
  simulate(day, directory);
  return 0;
}

}  // namespace
}  // namespace aeolian

int main(int argc, char** argv) {
  return aeolian::run_program("simulate_field", [&] { return aeolian::run(argc, argv); });
}
