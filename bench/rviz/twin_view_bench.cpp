// What the view of twin.launch costs rviz, on a screen that nobody sees and without a graphics card: a field
// of ripples of 500 x 250 cells, measured, predicted, difference and uncertainty, of which the measured map
// changes once a second. Prints a table; the numbers are wall time on the machine as it is, but for the
// processor time of a frame, which holds all that rviz does. Starts a master and the nodes of its own.
#include <QApplication>
#include <QElapsedTimer>
#include <cmath>
#include <csignal>
#include <string>
#include <vector>

#include "../own_master.hpp"
#include "aeolian_rviz/frame_clock.hpp"
#include "child_process.hpp"
#include "own_screen.hpp"
#include <fmt/format.h>
#include <grid_map_msgs/GridMap.h>
#include <ros/ros.h>
#include <rviz/display.h>
#include <rviz/display_group.h>
#include <rviz/visualization_frame.h>
#include <rviz/visualization_manager.h>
#include <sys/resource.h>

#include "aeolian_core/twin/difference.hpp"
#include "aeolian_core/twin/forecast.hpp"
#include "aeolian_twin/nodes/conversions.hpp"

namespace aeolian {
namespace {

constexpr double settling_time = 20;  // s
constexpr double measured_time = 15;  // s
const GridGeometry grid(0, 0, 0.002, 500, 250);

struct Case {
  std::string name;
  std::string mesh_cells;
  std::vector<std::string> displays;  ///< of rviz/twin.rviz
};

const std::vector<Case> cases = {
    {"three maps of 31 250 cells", "60000", {"Measured", "Predicted", "Difference"}},
    {"four maps of 31 250 cells", "60000", {"Measured", "Predicted", "Difference", "Uncertainty"}},
    {"four maps of 13 900 cells", "20000", {"Measured", "Predicted", "Difference", "Uncertainty"}},
    {"four maps of 13 900 cells and crests",
     "20000",
     {"Measured", "Predicted", "Difference", "Uncertainty", "Measured crests", "Predicted crests"}},
};

/// Ripples of 10 cm, 8 mm high.
HeightMap ripples(double phase) {
  HeightMap map(grid);
  HeightMap::Layer& z = map.add(layer::elevation);
  for (std::size_t i = 0; i < z.size(); ++i)
    z[i] = static_cast<float>(0.004 * std::sin(2 * M_PI * grid.cell_at(i).x / 50 - phase));
  return map;
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
  explicit Bench(const Case& c) : case_(c) {
    frame_.setSplashPath("");
    frame_.initialize(AEOLIAN_REPOSITORY "/rviz/twin.rviz");
    frame_.show();
    rviz::DisplayGroup& displays = *frame_.getManager()->getRootDisplayGroup();
    for (int i = 0; i < displays.numDisplays(); ++i) {
      rviz::Display* display = displays.getDisplayAt(i);
      bool shown = false;
      for (const std::string& name : c.displays) shown |= display->getName().toStdString() == name;
      display->setEnabled(shown);
    }
  }

  void run() {
    spin(settling_time);
    FrameClock frames;
    frames.start();
    const double processor = processor_seconds();
    QElapsedTimer timer;
    timer.start();
    spin(measured_time);
    const auto drawn = static_cast<double>(frames.frames());
    fmt::print("| {} | {:.1f} | {:.0f} ms |\n", case_.name,
               drawn / (1e-3 * static_cast<double>(timer.elapsed())),
               1e3 * (processor_seconds() - processor) / drawn);
    std::fflush(stdout);
    frames.stop();
  }

 private:
  static void send(const ros::Publisher& to, const HeightMap& map, const ros::Time& stamp) {
    std_msgs::Header header;
    header.frame_id = "map";
    header.stamp = stamp;
    to.publish(to_message(map, header));
  }

  void publish(int turn) {
    const ros::Time start(1000);
    send(map_, ripples(0.3 * turn), start);
    HeightMap ahead = ripples(1);
    ahead.add(layer::lead_time, 120);
    ahead.add("spread", ahead.layer(layer::elevation));
    send(forecast_, ahead, start + ros::Duration(120));
    HeightMap missed = ripples(0);
    missed.add(layer::lead_time, 120);
    missed.add(layer::difference, ahead.layer(layer::elevation));
    send(difference_, missed, start);
  }

  void spin(double seconds) {
    QElapsedTimer timer;
    timer.start();
    for (int turn = 0; 1e-3 * static_cast<double>(timer.elapsed()) < seconds;) {
      QApplication::processEvents(QEventLoop::WaitForMoreEvents, 50);
      if (1e-3 * static_cast<double>(timer.elapsed()) > turn) publish(turn++);
    }
  }

  const Case& case_;
  ros::NodeHandle node_;
  ros::Publisher map_ = node_.advertise<grid_map_msgs::GridMap>("height_map", 1);
  ros::Publisher forecast_ = node_.advertise<grid_map_msgs::GridMap>("forecast", 1);
  ros::Publisher difference_ = node_.advertise<grid_map_msgs::GridMap>("difference", 1);
  rviz::VisualizationFrame frame_;
};

int draw(const Case& c) {
  int none = 0;
  QApplication application(none, nullptr);
  ros::init(ros::M_string(), "twin_view_bench", ros::init_options::AnonymousName);
  while (!ros::master::check()) ros::WallDuration(0.1).sleep();
  const ChildProcess nodes({AEOLIAN_DEVEL "/env.sh", "roslaunch", "aeolian_twin", "twin.launch",
                            "rviz:=false", "nodelets:=true", "mesh_cells:=" + c.mesh_cells},
                           SIGINT, ChildProcess::Output::dropped);
  Bench(c).run();
  return 0;
}

}  // namespace
}  // namespace aeolian

int main(int argc, char** argv) {
  using namespace aeolian;
  if (argc == 2) return draw(cases.at(std::stoul(argv[1])));
  if (!bench::has_screen(argv)) return 1;
  const bench::OwnMaster master;
  fmt::print("| shown | frames/s | processor time of a frame |\n|---|---|---|\n");
  std::fflush(stdout);
  int failed = 0;
  for (std::size_t i = 0; i < cases.size(); ++i) failed |= bench::run_self({std::to_string(i)});
  return failed == 0 ? 0 : 1;
}
