// simulate_field as people run it: a short day on a small plot, made from the shipped configuration.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "program_outcome.hpp"
#include <geometry_msgs/TwistStamped.h>
#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/point_cloud2_iterator.h>
#include <sys/wait.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_msgs/TFMessage.h>
#include <unistd.h>
#include <yaml-cpp/yaml.h>

#include "aeolian_core/surface/csv.hpp"
#include "aeolian_core/surface/geotiff.hpp"
#include "aeolian_core/surface/resample.hpp"

namespace aeolian {
namespace {

namespace fs = std::filesystem;

const std::string topics[] = {"/tf_static", "/points", "/wind", "/image", "/camera_info"};

/// The shipped day, made short and small.
YAML::Node small_day() {
  YAML::Node day = YAML::LoadFile(AEOLIAN_REPOSITORY "/config/field_day.yaml");
  day["minutes"] = 20.0 / 60;
  day["bed"]["length_m"] = 0.2;
  day["bed"]["width_m"] = 0.1;
  day["bed"]["spin_up_minutes"] = 1;
  day["scanners"]["columns"] = 80;
  day["scanners"]["rows"] = 40;
  day["scanners"]["field_of_view_across_deg"] = 8;
  day["scanners"]["field_of_view_along_deg"] = 4;
  for (YAML::Node tripod : day["scanners"]["tripods"]) {
    tripod["position_m"][0] = 0.1;
    tripod["looks_at_m"] = std::vector<double>{0.1, 0.05, 0};
  }
  day["camera"]["period_s"] = 10;
  day["camera"]["width_px"] = 160;
  day["camera"]["height_px"] = 120;
  return day;
}

class SimulateField : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = fs::temp_directory_path() / ("simulate_field_test_" + std::to_string(getpid()));
    fs::create_directories(folder_);
    ASSERT_EQ(simulate(small_day(), "day").code, 0);
  }
  static void TearDownTestSuite() { fs::remove_all(folder_); }

  static Outcome simulate(const YAML::Node& day, const std::string& out, const std::string& flags = "") {
    const fs::path config = folder_ / "config.yaml";
    std::ofstream(config) << day;
    return run("--config " + config.string() + " --out " + (folder_ / out).string() + " " + flags);
  }
  static Outcome run(const std::string& arguments) { return run_program("simulate_field " + arguments); }
  static std::string bag_path(const std::string& day) { return (folder_ / day / "field_day.bag").string(); }

  /// The bytes of all messages of a topic, in the bag's order.
  static std::string bytes(const std::string& day, const std::string& topic) {
    rosbag::Bag bag(bag_path(day));
    std::string result;
    for (const rosbag::MessageInstance& message : rosbag::View(bag, rosbag::TopicQuery(topic))) {
      std::string buffer(message.size(), '\0');
      ros::serialization::OStream stream(reinterpret_cast<std::uint8_t*>(buffer.data()),
                                         static_cast<std::uint32_t>(buffer.size()));
      message.write(stream);
      result += buffer;
    }
    return result;
  }
  template <class Message>
  static std::vector<boost::shared_ptr<Message>> messages(const std::string& topic) {
    rosbag::Bag bag(bag_path("day"));
    std::vector<boost::shared_ptr<Message>> result;
    for (const rosbag::MessageInstance& message : rosbag::View(bag, rosbag::TopicQuery(topic)))
      result.push_back(message.instantiate<Message>());
    return result;
  }

  /// A configuration that must be refused in one line that holds `expected`.
  static void expect_refused(const YAML::Node& day, const std::string& expected,
                             const std::string& out = "refused") {
    const Outcome outcome = simulate(day, out);
    EXPECT_EQ(outcome.code, 1);
    EXPECT_NE(outcome.err.find(expected), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_FALSE(fs::exists(folder_ / out / "field_day.bag"));
  }

  static fs::path folder_;
};
fs::path SimulateField::folder_;

TEST_F(SimulateField, WritesEveryTopicAtItsRate) {
  rosbag::Bag bag(bag_path("day"));
  std::map<std::string, std::size_t> count;
  ros::Time last;
  for (const rosbag::MessageInstance& message : rosbag::View(bag)) {
    ++count[message.getTopic()];
    EXPECT_GE(message.getTime(), last);
    last = message.getTime();
  }
  EXPECT_EQ(count.size(), std::size(topics));
  EXPECT_EQ(count["/tf_static"], 1U);
  EXPECT_EQ(count["/points"], 6U);
  EXPECT_EQ(count["/wind"], 200U);
  EXPECT_EQ(count["/image"], 3U);
  EXPECT_EQ(count["/camera_info"], 3U);
}

TEST_F(SimulateField, StampsAreTheTimesOfTheBag) {
  rosbag::Bag bag(bag_path("day"));
  for (const rosbag::MessageInstance& message : rosbag::View(bag, rosbag::TopicQuery("/points")))
    EXPECT_EQ(message.instantiate<sensor_msgs::PointCloud2>()->header.stamp, message.getTime());
  const auto wind = messages<geometry_msgs::TwistStamped>("/wind");
  for (std::size_t i = 0; i < wind.size(); ++i) {
    EXPECT_NEAR((wind[i]->header.stamp - ros::Time(1700000000)).toSec(), 0.1 * static_cast<double>(i), 1e-8);
    EXPECT_EQ(wind[i]->header.frame_id, "anemometer");
    const double speed = std::hypot(wind[i]->twist.linear.x, wind[i]->twist.linear.y);
    EXPECT_GT(speed, 4);
    EXPECT_LT(speed, 22);
  }
  const auto photographs = messages<sensor_msgs::Image>("/image");
  EXPECT_EQ(photographs[2]->header.stamp, ros::Time(1700000020));
  EXPECT_EQ(photographs[2]->data.size(), 160U * 120U);
  EXPECT_EQ(messages<sensor_msgs::CameraInfo>("/camera_info")[2]->header.stamp, ros::Time(1700000020));
}

TEST_F(SimulateField, PointsLandOnTheTruthThroughTf) {
  std::map<std::string, Eigen::Isometry3d> frames;
  for (const auto& frame : messages<tf2_msgs::TFMessage>("/tf_static").at(0)->transforms) {
    EXPECT_EQ(frame.header.frame_id, "map");
    frames[frame.child_frame_id] = tf2::transformToEigen(frame);
  }
  EXPECT_NEAR(frames.at("anemometer").translation().z(), 1, 1e-12);
  EXPECT_EQ(frames.count("camera"), 1U);

  const HeightMap truth = read_geotiff((folder_ / "day/truth/elevation_0000.tif").string());
  EXPECT_EQ(truth.geometry(), GridGeometry(0, 0, 0.002, 100, 50));
  double sum = 0;
  double squares = 0;
  double n = 0;
  std::size_t rays = 0;
  const auto clouds = messages<sensor_msgs::PointCloud2>("/points");
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(clouds[i]->header.frame_id, "scanner_" + std::to_string(i + 1));
    const Eigen::Isometry3d& pose = frames.at(clouds[i]->header.frame_id);
    sensor_msgs::PointCloud2ConstIterator<float> x(*clouds[i], "x");
    for (; x != x.end(); ++x, ++rays) {
      const Eigen::Vector3d p = pose * Eigen::Vector3d(x[0], x[1], x[2]);
      const double error = p.z() - sample(truth.geometry(), truth.layer(layer::elevation), p.x(), p.y());
      if (!std::isfinite(error)) continue;
      sum += error;
      squares += error * error;
      ++n;
    }
  }
  EXPECT_EQ(rays, 2U * 80U * 40U);
  ASSERT_GT(n, 500);
  const double sigma = 0.0006;
  EXPECT_LT(std::abs(sum / n), 4 * sigma / std::sqrt(n));
  EXPECT_LT(std::sqrt(squares / n), sigma);
  EXPECT_GT(std::sqrt(squares / n), 0.6 * sigma);
}

TEST_F(SimulateField, StoresTheTruth) {
  EXPECT_TRUE(fs::exists(folder_ / "day/truth/elevation_0020.tif"));
  const Table truth = read_csv((folder_ / "day/truth/truth.csv").string());
  EXPECT_EQ(truth.names,
            (std::vector<std::string>{"t_s", "wavelength_m", "height_m", "friction_velocity_m_s"}));
  EXPECT_EQ(truth.column("t_s"), (std::vector<double>{0, 20}));
  EXPECT_NEAR(truth.column("friction_velocity_m_s")[1], 0.45, 0.12);
  // Sand is neither made nor lost beyond what the periodic bed has beside the plot.
  const HeightMap first = read_geotiff((folder_ / "day/truth/elevation_0000.tif").string());
  const HeightMap last = read_geotiff((folder_ / "day/truth/elevation_0020.tif").string());
  double change = 0;
  bool moved = false;
  for (std::size_t i = 0; i < first.geometry().size(); ++i) {
    const double d = static_cast<double>(last.layer(layer::elevation)[i] - first.layer(layer::elevation)[i]);
    change += d / static_cast<double>(first.geometry().size());
    moved = moved || std::abs(d) > 2e-4;
  }
  EXPECT_LT(std::abs(change), 5e-5);
  EXPECT_TRUE(moved);
}

TEST_F(SimulateField, IsDecidedByItsSeed) {
  ASSERT_EQ(simulate(small_day(), "again").code, 0);
  ASSERT_EQ(simulate(small_day(), "other", "--seed 2").code, 0);
  for (const std::string& topic : topics) {
    EXPECT_EQ(bytes("day", topic), bytes("again", topic)) << topic;
    const bool random = topic != "/tf_static" && topic != "/camera_info";
    EXPECT_EQ(bytes("day", topic) != bytes("other", topic), random) << topic;
  }
}

TEST_F(SimulateField, MinutesOverrideTheFile) {
  ASSERT_EQ(simulate(small_day(), "short", "--minutes 0.1").code, 0);
  EXPECT_TRUE(fs::exists(folder_ / "short/truth/elevation_0006.tif"));
  // A second day in the same place leaves nothing of the first.
  ASSERT_EQ(simulate(small_day(), "short", "--minutes 0.05").code, 0);
  EXPECT_FALSE(fs::exists(folder_ / "short/truth/elevation_0006.tif"));
}

TEST_F(SimulateField, RefusesABadConfiguration) {
  YAML::Node day = small_day();
  day["wind"]["gusts"] = 1;
  expect_refused(day, "unknown key 'wind.gusts'");
  day = small_day();
  day["wind"].remove("rate_hz");
  expect_refused(day, "no key 'wind.rate_hz'");
  day = small_day();
  day["wind"]["mean_speed_m_s"] = "brisk";
  expect_refused(day, "wind.mean_speed_m_s is 'brisk', must be a number");
  day = small_day();
  day["wind"]["mean_speed_m_s"] = -3;
  expect_refused(day, "wind.mean_speed_m_s is '-3'");
  day = small_day();
  day["bed"]["grain_diameter_m"] = ".nan";
  expect_refused(day, "bed.grain_diameter_m");
  day = small_day();
  day["scanners"]["columns"] = 2.5;
  expect_refused(day, "scanners.columns is '2.5', must be a whole number");
  day = small_day();
  day["camera"]["position_m"] = std::vector<double>{1, 2};
  expect_refused(day, "camera.position_m");
  day = small_day();
  day["scanners"]["tripods"] = YAML::Node(YAML::NodeType::Sequence);
  expect_refused(day, "scanners.tripods");
  day = small_day();
  day["wind"] = 3;
  expect_refused(day, "wind must be a section");
}

TEST_F(SimulateField, RefusesFilesThatCannotBe) {
  Outcome outcome =
      run("--config " + (folder_ / "absent.yaml").string() + " --out " + (folder_ / "x").string());
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.err.find("absent.yaml"), std::string::npos);

  std::ofstream(folder_ / "broken.yaml") << "wind: [1, 2";
  outcome = run("--config " + (folder_ / "broken.yaml").string() + " --out " + (folder_ / "x").string());
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.err.find("broken.yaml"), std::string::npos);

  std::ofstream(folder_ / "file") << "not a directory";
  expect_refused(small_day(), "file", "file/out");
  EXPECT_EQ(run("--out somewhere").code, 1);
  EXPECT_EQ(run("--help > /dev/null").code, 0);
}

}  // namespace
}  // namespace aeolian
