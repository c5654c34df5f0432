// How many times faster than it was recorded `replay` goes through a bag, and what its parts take: a minute
// of a field day (10 Hz, 640 x 480 points on 1 m x 0.5 m at 2 mm, ripples that migrate, wind at 10 Hz), with
// the parameters of config/twin.yaml. The bag, 2.2 GB, and what comes out are written to the temporary folder
// and deleted at the end.
//
//     ./twin bench replay

#include <chrono>
#include <cmath>
#include <filesystem>
#include <string>

#include "scanned_ripples.hpp"
#include "temporary_folder.hpp"
#include <benchmark/benchmark.h>
#include <geometry_msgs/TwistStamped.h>
#include <rosbag/bag.h>
#include <sys/resource.h>
#include <tf2_msgs/TFMessage.h>

#include "aeolian_core/twin/report.hpp"
#include "aeolian_twin/nodes/conversions.hpp"
#include "aeolian_twin/replay/bag_source.hpp"
#include "aeolian_twin/replay/replay_bag.hpp"
#include "aeolian_twin/replay/twin_bag.hpp"
#include "aeolian_twin/replay/twin_replay.hpp"
#include "aeolian_twin/report/recorded_run.hpp"
#include "aeolian_twin/tools/static_frames.hpp"

namespace {

using namespace aeolian;

constexpr double seconds = 60;
constexpr double rate = 10;  // of clouds and wind [Hz]

void write_frames(rosbag::Bag& bag, const ros::Time& stamp) {
  tf2_msgs::TFMessage frames;
  frames.transforms.push_back(bench::camera_pose(stamp, 0.5, 0.25));
  write_static_frames(bag, frames, stamp, "replay_bench");
}

/// The bag, made once, and the parameters.
struct Day {
  TemporaryFolder folder;
  std::string bag = folder.file("day.bag");
  ReplayConfig config = ReplayConfig::read(AEOLIAN_REPOSITORY "/config/twin.yaml");

  Day() {
    const ros::Time start(1700000000);
    rosbag::Bag file(bag, rosbag::bagmode::Write);
    write_frames(file, start);
    for (int i = 0; i < seconds * rate; ++i) {
      const double time = i / rate;
      sensor_msgs::PointCloud2 points =
          to_message(bench::ScannedRipples().at(time, static_cast<std::uint64_t>(i)), 640);
      geometry_msgs::TwistStamped wind;
      points.header.stamp = wind.header.stamp = start + ros::Duration(time);
      points.header.frame_id = "camera";
      wind.header.frame_id = "map";
      wind.twist.linear.x = 12.6 + std::sin(time);
      file.write("/wind", wind.header.stamp, wind);
      file.write("/points", points.header.stamp, points);
    }
    file.close();
  }
};

Day& day() {
  static Day made;
  return made;
}

double processor_seconds() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  const auto of = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return of(used.ru_utime) + of(used.ru_stime);
}

/// Runs some work once and says how many times faster than the recording it is, and what of two cores it
/// takes.
template <class Work>
void measure(benchmark::State& state, Work&& work) {
  for (auto _ : state) {
    const double processor = processor_seconds();
    const auto begin = std::chrono::steady_clock::now();
    work();
    const double spent = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    const double used = processor_seconds() - processor;
    state.counters["x_real_time"] = seconds / spent;
    state.counters["processor_s"] = used;
    state.counters["x_real_time_of_2_cores"] = 2 * seconds / used;
  }
}

const ReplayWatch quiet{[](double) {}, [](const std::string&) {}, [] { return false; }};

/// The clouds as they are fused, read from the bag and no more.
void ReadTheBag(benchmark::State& state) {
  const Day& made = day();
  measure(state, [&] {
    BagSource source(made.bag, made.config);
    while (source.next()) {
    }
  });
}

/// All but what needs wind: no forecasts, no scores.
void MapsOnly(benchmark::State& state) {
  const Day& made = day();
  measure(state, [&] {
    rosbag::Bag file(made.folder.file("maps.bag"), rosbag::bagmode::Write);
    file.setCompression(rosbag::compression::LZ4);
    {
      TwinBag out(file);
      BagSource source(made.bag, made.config);
      TwinReplay twin(made.config, out, quiet.complain);
      while (const auto message = source.next())
        if (!std::holds_alternative<geometry_msgs::TwistStampedConstPtr>(message->content))
          twin.take(*message);
      out.finish();
    }
    file.close();
  });
}

/// The program but for its start: bag and report.
void Whole(benchmark::State& state) {
  const Day& made = day();
  measure(state, [&] { replay_bag(made.bag, made.config, made.folder.file("whole"), quiet); });
}

/// The page alone, from the bag that Whole has written.
void Report(benchmark::State& state) {
  const Day& made = day();
  replay_bag(made.bag, made.config, made.folder.file("whole"), quiet);
  measure(state, [&] {
    write_report(read_recorded_run(made.folder.file("whole/twin.bag")), made.folder.file("page"));
  });
}

BENCHMARK(ReadTheBag)->Iterations(1)->Unit(benchmark::kSecond)->UseRealTime();
BENCHMARK(MapsOnly)->Iterations(1)->Unit(benchmark::kSecond)->UseRealTime();
BENCHMARK(Whole)->Iterations(1)->Unit(benchmark::kSecond)->UseRealTime();
BENCHMARK(Report)->Iterations(1)->Unit(benchmark::kSecond)->UseRealTime();

}  // namespace
