// How fast rviz draws maps that change ten times a second, on a screen that nobody sees and without a
// graphics card, with rviz' anti-aliasing and without (rviz --disable-anti-aliasing). Prints a table; the
// numbers are wall time on the machine as it is, but for the processor time of a frame, which holds all that
// rviz does. Starts a master and a publisher of its own.
#include <QApplication>
#include <QElapsedTimer>
#include <algorithm>
#include <csignal>
#include <string>
#include <vector>

#include "../own_master.hpp"
#include "aeolian_rviz/height_map_display.hpp"
#include "child_process.hpp"
#include "own_screen.hpp"
#include <fmt/format.h>
#include <ros/ros.h>
#include <rviz/display_group.h>
#include <rviz/ogre_helpers/render_system.h>
#include <rviz/properties/property.h>
#include <rviz/view_controller.h>
#include <rviz/view_manager.h>
#include <rviz/visualization_frame.h>
#include <rviz/visualization_manager.h>
#include <sys/resource.h>

#include "aeolian_core/surface/submap.hpp"
#include "aeolian_twin/nodes/conversions.hpp"

namespace aeolian {
namespace {

constexpr double map_rate = 10;       // Hz
constexpr double cell_size = 0.002;   // m
constexpr double settling_time = 6;   // s
constexpr double measured_time = 10;  // s

struct Case {
  std::string name;
  int cells;      ///< of one side
  bool changes;   ///< everywhere, with each map; otherwise one tile does
  bool as_parts;  ///< what changes is sent, not the whole map
};

const std::vector<Case> cases = {
    {"whole map changes", 512, true, false},
    {"whole map changes", 1000, true, false},
    {"one tile changes, sent whole", 1000, false, false},
    {"one tile changes, sent as a part", 1000, false, true},
};

/// Ripples of 10 cm, 10 mm high, that migrate.
HeightMap ripples(int cells, double phase) {
  HeightMap map(GridGeometry(0, 0, cell_size, cells, cells));
  HeightMap::Layer& z = map.add(layer::elevation);
  std::vector<float> row(static_cast<std::size_t>(cells));
  for (int x = 0; x < cells; ++x)
    row[static_cast<std::size_t>(x)] =
        static_cast<float>(0.005 * std::sin(2 * M_PI * x * cell_size / 0.1 - phase));
  for (int y = 0; y < cells; ++y) std::copy(row.begin(), row.end(), z.begin() + map.geometry().index(0, y));
  return map;
}

/// Publishes maps until it is killed.
[[noreturn]] void publish(const Case& c) {
  ros::init(ros::M_string(), "bench_maps", ros::init_options::NoSigintHandler);
  ros::NodeHandle node;
  ros::Publisher whole = node.advertise<grid_map_msgs::GridMap>("height_map", 1, true);
  ros::Publisher parts = node.advertise<grid_map_msgs::GridMap>("height_map_updates", 10);
  std::vector<HeightMap> maps;
  for (int i = 0; i < 8; ++i) maps.push_back(ripples(c.cells, c.changes ? i * M_PI / 4 : 0));
  std_msgs::Header header;
  header.frame_id = "map";
  ros::WallRate rate(map_rate);
  for (std::size_t i = 0;; ++i, rate.sleep()) {
    HeightMap& map = maps[i % maps.size()];
    const CellRange tile{64, 96, 64, 96};
    if (!c.changes)
      map.layer(layer::elevation)[map.geometry().index(70, 70)] = static_cast<float>(i % 10) * 1e-3F;
    header.stamp = ros::Time::now();
    if (c.as_parts && i > 0)
      parts.publish(to_message(submap(map, tile), header));
    else
      whole.publish(to_message(map, header));
  }
}

double processor_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

class Bench {
 public:
  /// The picture alone, as large as the screen, with the view of rviz/height_map.rviz.
  explicit Bench(bool smooth) : smooth_(smooth) {
    frame_.setSplashPath("");
    frame_.initialize(AEOLIAN_REPOSITORY "/rviz/height_map.rviz");
    frame_.setFullScreen(true);
    frame_.show();
  }

  void run(const Case& c) {
    const ChildProcess publisher({"/proc/self/exe", "--publish", std::to_string(&c - cases.data())}, SIGKILL);
    rviz::DisplayGroup& displays = *frame_.getManager()->getRootDisplayGroup();
    auto* display = dynamic_cast<HeightMapDisplay*>(displays.getDisplayAt(0));
    display->reset();
    // As large in the picture as the view of a map of 2 m shows it.
    frame_.getManager()
        ->getViewManager()
        ->getCurrent()
        ->subProp("Distance")
        ->setValue(1.1 * c.cells * cell_size);
    spin(settling_time, *display);
    FrameClock frames;
    frames.start();
    const std::size_t taken = display->seen()->taken();
    const double processor = processor_seconds();
    QElapsedTimer timer;
    timer.start();
    std::vector<double> ages = spin(measured_time, *display);
    const double seconds = 1e-3 * static_cast<double>(timer.elapsed());
    std::sort(ages.begin(), ages.end());
    const auto drawn = static_cast<double>(frames.frames());
    fmt::print("| {} x {} | {} | {} | {:.1f} | {:.1f} | {:.0f} ms | {:.0f} ms | {:.0f} ms | {:.0f} | {} |\n",
               c.cells, c.cells, c.name, smooth_ ? "yes" : "no", drawn / seconds,
               static_cast<double>(display->seen()->taken() - taken) / seconds, 1e3 * ages[ages.size() / 2],
               1e3 * ages.back(), 1e3 * (processor_seconds() - processor) / drawn, display->quad_pixels(),
               display->seen()->mesh().drawn_triangles());
    std::fflush(stdout);
    frames.stop();
  }

 private:
  /// How old the visible map was, each time that events had been handled [s].
  static std::vector<double> spin(double seconds, const HeightMapDisplay& display) {
    std::vector<double> ages;
    QElapsedTimer timer;
    timer.start();
    while (1e-3 * static_cast<double>(timer.elapsed()) < seconds) {
      QApplication::processEvents(QEventLoop::WaitForMoreEvents, 50);
      if (display.seen() && display.seen()->known())
        ages.push_back((ros::Time::now() - display.seen()->header().stamp).toSec());
    }
    return ages;
  }

  bool smooth_;
  rviz::VisualizationFrame frame_;
};

/// All cases in one rviz.
int draw_all(bool smooth) {
  if (!smooth) rviz::RenderSystem::disableAntiAliasing();
  int none = 0;
  QApplication application(none, nullptr);
  ros::init(ros::M_string(), "height_map_display_bench", ros::init_options::AnonymousName);
  while (!ros::master::check()) ros::WallDuration(0.1).sleep();
  ros::NodeHandle keeps_ros_alive;
  Bench bench(smooth);
  for (const Case& c : cases) bench.run(c);
  return 0;
}

}  // namespace
}  // namespace aeolian

int main(int argc, char** argv) {
  using namespace aeolian;
  const std::string task = argc == 3 ? argv[1] : "";
  if (task == "--publish") publish(cases.at(std::stoul(argv[2])));
  if (task == "--draw") return draw_all(std::string(argv[2]) == "smooth");
  if (!bench::has_screen(argv)) return 1;
  const bench::OwnMaster master;
  fmt::print(
      "| cells | at 10 Hz | anti-aliasing | frames/s | maps/s | age of the map seen, median | worst | "
      "processor time of "
      "a frame | largest quad, pixels | triangles |\n|---|---|---|---|---|---|---|---|---|---|\n");
  std::fflush(stdout);
  const int failed = bench::run_self({"--draw", "smooth"}) | bench::run_self({"--draw", "plain"});
  return failed == 0 ? 0 : 1;
}
