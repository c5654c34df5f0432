// write_report as people run it, on bags made here.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>

#include "../temporary_folder.hpp"
#include "program_outcome.hpp"
#include <aeolian_msgs/Comparison.h>
#include <grid_map_msgs/GridMap.h>
#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <std_msgs/String.h>
#include <sys/wait.h>

#include "aeolian_core/surface/csv.hpp"
#include "aeolian_core/surface/geotiff.hpp"

namespace aeolian {
namespace {

constexpr int nx = 100;
constexpr int ny = 40;
constexpr double cell = 0.004;
constexpr double wave = 0.08;
constexpr double start = 1700000000;

/// Height of ripples that move eastwards at 0.1 mm/s [m].
double height_at(double x, double time) { return 0.002 * std::sin(2 * M_PI * (x - 1e-4 * time) / wave); }

void add_layer(grid_map_msgs::GridMap& message, const std::string& name,
               const std::function<double(double x)>& value) {
  message.layers.push_back(name);
  std_msgs::Float32MultiArray& array = message.data.emplace_back();
  array.layout.dim.resize(2);
  array.layout.dim[0].label = "column_index";
  array.layout.dim[0].size = ny;
  array.layout.dim[0].stride = nx * ny;
  array.layout.dim[1].label = "row_index";
  array.layout.dim[1].size = nx;
  array.layout.dim[1].stride = nx;
  for (int column = 0; column < ny; ++column)
    for (int row = 0; row < nx; ++row)
      array.data.push_back(static_cast<float>(value((nx - row - 0.5) * cell)));  // rows run towards smaller x
}

grid_map_msgs::GridMap empty_map(double time) {
  grid_map_msgs::GridMap message;
  message.info.header.stamp = ros::Time(start + time);
  message.info.header.frame_id = "map";
  message.info.resolution = cell;
  message.info.length_x = nx * cell;
  message.info.length_y = ny * cell;
  message.info.pose.position.x = nx * cell / 2;
  message.info.pose.position.y = ny * cell / 2;
  message.info.pose.orientation.w = 1;
  return message;
}

grid_map_msgs::GridMap measured(double time) {
  auto message = empty_map(time);
  add_layer(message, "elevation", [&](double x) { return height_at(x, time); });
  return message;
}

/// A forecast that is 0.4 mm too high.
grid_map_msgs::GridMap forecast(double issued, double lead) {
  auto message = empty_map(issued + lead);
  add_layer(message, "elevation", [&](double x) { return height_at(x, issued + lead) + 0.0004; });
  add_layer(message, "initial", [&](double x) { return height_at(x, issued); });
  add_layer(message, "lead_time", [&](double) { return lead; });
  return message;
}

grid_map_msgs::GridMap wind(double time, double friction_velocity) {
  auto message = empty_map(time);
  add_layer(message, "friction_velocity", [&](double) { return friction_velocity; });
  add_layer(message, "direction", [&](double) { return 0; });
  return message;
}

aeolian_msgs::Comparison comparison(double issued, double lead) {
  aeolian_msgs::Comparison message;
  message.header.stamp = ros::Time(start + issued + lead);
  message.issued = ros::Time(start + issued);
  message.lead_time = lead;
  message.rmse = 0.0004;
  message.rmse_persistence = 0.0008;
  message.rmse_translation = 0.0001;
  message.skill_persistence = 0.75;
  message.wavelength_measured = message.wavelength_predicted = wave;
  message.displacement_measured = 1e-4 * lead;
  message.displacement_predicted = NAN;
  return message;
}

class WriteReport : public testing::Test {
 protected:
  static Outcome run(const std::string& arguments) { return run_program("write_report " + arguments); }
  /// Expects exit code 1 and one line that holds `part`, and no page.
  void expect_refusal(const std::string& bag, const std::string& part) const {
    const Outcome outcome = run(bag + " --out " + folder_.file("report"));
    EXPECT_EQ(outcome.code, 1);
    EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(folder_.file("report")));
  }
  std::string make_bag(const std::function<void(rosbag::Bag&)>& fill) const {
    const std::string path = folder_.file("twin.bag");
    rosbag::Bag bag(path, rosbag::bagmode::Write);
    fill(bag);
    bag.close();
    return path;
  }
  template <class Message>
  static void record(rosbag::Bag& bag, const std::string& topic, const Message& message,
                     const ros::Time& stamp) {
    bag.write(topic, stamp, message);
  }
  static void record(rosbag::Bag& bag, const std::string& topic, const grid_map_msgs::GridMap& map) {
    bag.write(topic, map.info.header.stamp, map);
  }
  /// Five minutes: a map every 10 s, a forecast every minute for one and two minutes ahead.
  std::string make_field_day(bool scored) const {
    return make_bag([&](rosbag::Bag& bag) {
      for (int t = 0; t <= 300; t += 5) record(bag, "/wind_field", wind(t, t <= 150 ? 0.2 : 0.4));
      for (int t = 0; t <= 300; t += 10) record(bag, "/height_map", measured(t));
      record(bag, "/height_map", measured(300));  // a latched map comes again
      for (int t = 0; t <= 240; t += 60)
        for (const int lead : {60, 120}) {
          record(bag, "/forecast", forecast(t, lead));
          if (scored && t + lead <= 300)
            record(bag, "/comparison", comparison(t, lead), ros::Time(start + t + lead));
        }
    });
  }

  const TemporaryFolder folder_;
};

TEST_F(WriteReport, OfARecordedRun) {
  const std::string bag = make_field_day(true);
  const Outcome outcome = run(bag + " --out " + folder_.file("a/report"));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("a/report/index.html"), std::string::npos);
  const std::string page = content_of(folder_.file("a/report/index.html"));
  EXPECT_NE(page.find("twin.bag"), std::string::npos);
  EXPECT_NE(page.find("Looking 2 min ahead"), std::string::npos);
  EXPECT_NE(page.find("0.400 mm against 0.800 mm"), std::string::npos);
  EXPECT_NE(page.find("<td>10 / 9</td>"), std::string::npos);  // forecasts made and scored

  const Table ripples = read_csv(folder_.file("a/report/ripples.csv"));
  ASSERT_EQ(ripples.rows(), 31U);
  EXPECT_EQ(ripples.column("time_s").back(), 300);
  EXPECT_NEAR(ripples.column("wavelength_m").back(), wave, 0.02 * wave);
  EXPECT_NEAR(ripples.column("height_m").back(), 0.004, 0.0002);
  EXPECT_NEAR(ripples.column("friction_velocity_m_s").front(), 0.2, 1e-6);
  EXPECT_NEAR(ripples.column("friction_velocity_m_s").back(), 0.4, 1e-6);
  const Table scores = read_csv(folder_.file("a/report/scores.csv"));
  ASSERT_EQ(scores.rows(), 9U);
  EXPECT_EQ(scores.column("time_s")[0], 60);
}

TEST_F(WriteReport, WithTheTruthOfASimulation) {
  const std::string bag = make_field_day(true);
  std::filesystem::create_directories(folder_.file("day/truth"));
  HeightMap truth(GridGeometry(0, 0, cell, nx, ny));
  HeightMap::Layer& z = truth.add("elevation", 0);
  for (std::size_t i = 0; i < z.size(); ++i)
    z[i] = static_cast<float>(height_at(truth.geometry().x(truth.geometry().cell_at(i).x), 240) - 0.0003);
  write_geotiff(truth, folder_.file("day/truth/elevation_0240.tif"));
  folder_.write("day/truth/truth.csv", "t_s,wavelength_m,height_m,friction_velocity_m_s\n0,0.08,0.004,0.2\n");
  const Outcome outcome = run(bag + " --truth " + folder_.file("day") + " --out " + folder_.file("report"));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  // The map of 240 s was taken, as its truth is known: 0.3 mm above it; the forecast 0.4 mm more.
  const std::string page = content_of(folder_.file("report/index.html"));
  EXPECT_NE(page.find("<td>0.300</td><td>0.700</td>"), std::string::npos);

  const Outcome none = run(bag + " --truth " + folder_.file("nowhere") + " --out " + folder_.file("report"));
  EXPECT_EQ(none.code, 1);
  EXPECT_NE(none.err.find("nowhere"), std::string::npos) << none.err;
}

TEST_F(WriteReport, WithoutAnyScoreSaysWhy) {
  const Outcome outcome = run(make_field_day(false) + " --out " + folder_.file("report"));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(content_of(folder_.file("report/index.html"))
                .find("No forecast could be scored: 10 forecasts were made"),
            std::string::npos);
}

TEST_F(WriteReport, RefusesABagWithoutTheTopics) {
  const std::string other = make_bag([](rosbag::Bag& bag) {
    bag.write("/chatter", ros::Time(1), std_msgs::String());
    record(bag, "/height_map", measured(0));
  });
  expect_refusal(other,
                 "nothing was recorded on /forecast, /wind_field; its topics are: /chatter, /height_map");
  expect_refusal(make_bag([](rosbag::Bag&) {}), "its topics are: none");
}

TEST_F(WriteReport, RefusesATopicOfAnotherType) {
  expect_refusal(make_bag([](rosbag::Bag& bag) {
                   for (const char* topic : {"/height_map", "/forecast", "/wind_field"})
                     bag.write(topic, ros::Time(1), std_msgs::String());
                 }),
                 "holds std_msgs/String, must be grid_map_msgs/GridMap");
}

TEST_F(WriteReport, RefusesWhatIsNotABag) {
  expect_refusal(folder_.write("text.bag", "this is not a bag\n"), "text.bag: cannot be read");
  expect_refusal(folder_.write("empty.bag", ""), "empty.bag: cannot be read");
  expect_refusal(folder_.file("absent.bag"), "absent.bag: cannot be read");
  expect_refusal(folder_.path(), "cannot be read");
}

TEST_F(WriteReport, RefusesADirectoryThatCannotBeWritten) {
  const Outcome outcome = run(make_field_day(true) + " --out /proc/report");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.err.find("/proc/report"), std::string::npos) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
}

TEST_F(WriteReport, ExplainsItsFlags) {
  EXPECT_EQ(run("--help").code, 0);
  EXPECT_EQ(run("").code, 1);
  EXPECT_EQ(run(folder_.file("x.bag")).code, 1);
}

}  // namespace
}  // namespace aeolian
