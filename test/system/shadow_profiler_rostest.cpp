/// shadow_profiler as a program under a master: rendered photographs in, profiles with known truth out.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <memory>
#include <numeric>

#include "../rendering/shadow_scene.hpp"
#include "../temporary_folder.hpp"
#include "program_outcome.hpp"
#include "ros_test.hpp"
#include "running_program.hpp"
#include <aeolian_msgs/Profile.h>
#include <grid_map_msgs/GridMap.h>
#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_msgs/TFMessage.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <yaml-cpp/yaml.h>

#include "aeolian_core/surface/degree.hpp"
#include "aeolian_core/surface/geotiff.hpp"
#include "aeolian_core/surface/resample.hpp"
#include "aeolian_twin/nodes/conversions.hpp"

namespace aeolian {
namespace {

using ShadowSetUp = SetUp;  // gtest has a SetUp of its own

sensor_msgs::Image message_of(const Photo& photo, const ros::Time& stamp) {
  sensor_msgs::Image image;
  image.header.stamp = stamp;
  image.header.frame_id = "camera";
  image.width = static_cast<std::uint32_t>(photo.width_px);
  image.height = static_cast<std::uint32_t>(photo.height_px);
  image.encoding = "mono8";
  image.step = image.width;
  image.data = photo.values8;
  return image;
}

sensor_msgs::CameraInfo message_of(const CameraModel& camera) {
  sensor_msgs::CameraInfo info;
  info.header.frame_id = "camera";
  info.width = static_cast<std::uint32_t>(camera.width_px);
  info.height = static_cast<std::uint32_t>(camera.height_px);
  info.distortion_model = "rational_polynomial";
  info.D.assign(camera.distortion.begin(), camera.distortion.end());
  info.K = {camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1};
  return info;
}

/// Where the scenes stand in the map: the level frame's place, turned in plan.
Eigen::Isometry3d level_to_map() {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::AngleAxisd(140 * degree, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  pose.translation() = Eigen::Vector3d(1.3, -0.7, 0.6);
  return pose;
}

/// The acceptance bar of a profile.
double bar(const ShadowScene& scene) { return std::max(scene.grain_diameter / 4, 1e-4); }

/// Heights against those that are true.
struct Errors {
  double mean = 0;
  double rms = 0;  ///< about the mean
  explicit Errors(const std::vector<double>& errors) {
    const auto n = static_cast<double>(errors.size());
    mean = std::accumulate(errors.begin(), errors.end(), 0.0) / n;
    double squares = 0;
    for (const double error : errors) squares += std::pow(error - mean, 2) / n;
    rms = std::sqrt(squares);
  }
};

Errors errors_of(const aeolian_msgs::Profile& profile, const ShadowScene& scene) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < profile.x.size(); ++i)
    errors.push_back(profile.z[i] - true_bed_point(scene, profile.x[i]).z());
  return Errors(errors);
}

Errors errors_of(const grid_map_msgs::GridMap& message, const ShadowScene& scene) {
  const HeightMap map = to_height_map(message);
  const HeightMap::Layer& elevation = map.layer(layer::elevation);
  std::vector<double> errors;
  for (std::size_t i = 0; i < elevation.size(); ++i) {
    if (!std::isfinite(elevation[i])) continue;
    const CellIndex at = map.geometry().cell_at(i);
    const Eigen::Vector3d place =
        level_to_map().inverse() * Eigen::Vector3d(map.geometry().x(at.x), map.geometry().y(at.y), 0);
    errors.push_back(static_cast<double>(elevation[i]) - level_to_map().translation().z() -
                     scene.bed(place.x(), place.y()));
  }
  return Errors(errors);
}

/// The set-ups whose camera is calibrated, under a sun of 1970 or later.
const ShadowSetUp& set_up(std::uint64_t number) {
  static std::map<std::uint64_t, ShadowSetUp> known;
  static std::uint64_t seed = 0;
  while (known.size() <= number) {
    ShadowSetUp next = random_set_up(++seed, 1.5);
    const auto* sun = std::get_if<PhotoSetup::Sun>(&next.setup.light);
    const bool in_ros_time = sun == nullptr || sun->unix_time > 0;
    if (next.setup.camera && in_ros_time) known.emplace(known.size(), std::move(next));
  }
  return known.at(number);
}

class ShadowProfilerTest : public ::testing::Test {
 protected:
  /// Starts the node with a setup file, and waits for its topics.
  void start(const std::string& setup, bool pose_from_tf) {
    node_ = std::make_unique<RunningProgram>(
        "shadow_profiler",
        std::vector<std::string>{"_setup:=" + folder_.write("setup.yaml", setup),
                                 std::string("_pose_from_tf:=") + (pose_from_tf ? "true" : "false"),
                                 "_diagnostic_period:=0.1", "_tf_timeout:=0.5"});
    ASSERT_TRUE(
        wait_until([&] { return images_.getNumSubscribers() > 0 && cameras_.getNumSubscribers() > 0; }));
  }
  void listen() {
    profiles_ = std::make_unique<Listener<aeolian_msgs::Profile>>(nh_, "profile");
    strips_ = std::make_unique<Listener<grid_map_msgs::GridMap>>(nh_, "strip");
    clouds_ = std::make_unique<Listener<sensor_msgs::PointCloud2>>(nh_, "profile_points");
    overlays_ = std::make_unique<Listener<sensor_msgs::Image>>(nh_, "overlay");
    ASSERT_TRUE(wait_until([&] {
      return profiles_->connected() && strips_->connected() && clouds_->connected() && overlays_->connected();
    }));
  }
  void TearDown() override {
    node_.reset();
    // The next node must not be taken for this one.
    wait_until([&] { return images_.getNumSubscribers() == 0 && cameras_.getNumSubscribers() == 0; });
  }

  void send(const std::string& frame, const Eigen::Isometry3d& pose) {
    geometry_msgs::TransformStamped message = tf2::eigenToTransform(pose);
    message.header.frame_id = "map";
    message.header.stamp = ros::Time::now();
    message.child_frame_id = frame;
    tf_.sendTransform(message);
  }
  /// The straightedge, whose top face may lean, and the camera of a scene in the map.
  void send_frames(const ShadowScene& scene, double lean) {
    Eigen::Isometry3d straightedge = level_to_map();
    straightedge.linear() = straightedge.linear() *
                            Eigen::AngleAxisd(-scene.inclination, Eigen::Vector3d::UnitY()) *
                            Eigen::AngleAxisd(lean, Eigen::Vector3d::UnitX());
    send("straightedge", straightedge);
    send("camera", level_to_map() * scene.level_to_camera.inverse());
  }

  /// A time at which the setup's sun, if it is one, stands where the scene's light comes from.
  static ros::Time stamp_of(const ShadowSetUp& set_up) {
    const auto* sun = std::get_if<PhotoSetup::Sun>(&set_up.setup.light);
    return sun != nullptr ? ros::Time(sun->unix_time) : ros::Time(1700000000);
  }

  /// What is measured on a photo; an empty profile when nothing is.
  aeolian_msgs::Profile profile_of(const sensor_msgs::Image& image, double patience = 10) {
    const std::size_t before = profiles_->messages.size();
    images_.publish(image);
    if (!wait_until([&] { return profiles_->messages.size() > before; }, patience)) return {};
    return *profiles_->messages.back();
  }

  TemporaryFolder folder_;
  ros::NodeHandle nh_;
  tf2_ros::StaticTransformBroadcaster tf_;
  ros::Publisher images_ = nh_.advertise<sensor_msgs::Image>("image", 10);
  ros::Publisher cameras_ = nh_.advertise<sensor_msgs::CameraInfo>("camera_info", 10);
  std::unique_ptr<Listener<aeolian_msgs::Profile>> profiles_;
  std::unique_ptr<Listener<grid_map_msgs::GridMap>> strips_;
  std::unique_ptr<Listener<sensor_msgs::PointCloud2>> clouds_;
  std::unique_ptr<Listener<sensor_msgs::Image>> overlays_;
  Diagnostics diagnostics_{nh_};
  std::unique_ptr<RunningProgram> node_;
};

// The first of all: tf knows no straightedge yet.
TEST_F(ShadowProfilerTest, MarksGiveTheProfileWithoutTf) {
  const ShadowSetUp& s = set_up(0);
  start(s.yaml, false);
  listen();
  cameras_.publish(message_of(*s.setup.camera));
  const aeolian_msgs::Profile profile = profile_of(message_of(photograph(s.scene), stamp_of(s)));
  ASSERT_GT(profile.x.size(), 50U);
  EXPECT_LT(errors_of(profile, s.scene).rms, bar(s.scene));
  EXPECT_NEAR(profile.wavelength, s.wavelength, 0.02 * s.wavelength);
  EXPECT_EQ(profile.header.frame_id, "straightedge");
  EXPECT_EQ(profile.header.stamp, stamp_of(s));
  EXPECT_TRUE(profile.points.empty());
  ASSERT_TRUE(wait_until([&] { return !clouds_->messages.empty() && !overlays_->messages.empty(); }));
  EXPECT_EQ(clouds_->messages.back()->header.frame_id, "straightedge");
  EXPECT_EQ(overlays_->messages.back()->encoding, "bgr8");
  EXPECT_EQ(overlays_->messages.back()->header.frame_id, "camera");
  EXPECT_TRUE(strips_->messages.empty());
  EXPECT_TRUE(diagnostics_.is_well("shadow_profiler"));
}

TEST_F(ShadowProfilerTest, NothingIsMeasuredWhileNobodyListens) {
  const ShadowSetUp& s = set_up(0);
  start(s.yaml, false);
  cameras_.publish(message_of(*s.setup.camera));
  images_.publish(message_of(photograph(s.scene), stamp_of(s)));
  EXPECT_TRUE(diagnostics_.is_well("shadow_profiler"));
  listen();
  EXPECT_FALSE(wait_until([&] { return !profiles_->messages.empty(); }, 1)) << "a latched profile";
}

TEST_F(ShadowProfilerTest, WithThePoseFromTfItIsASectionOfTheMap) {
  for (const std::uint64_t number : {1, 2, 3}) {
    const ShadowSetUp& s = set_up(number);
    SCOPED_TRACE(s.yaml);
    send_frames(s.scene, 6 * degree);
    start(s.yaml, true);
    listen();
    const RunningProgram mapper("height_mapper",
                                {"points:=profile_points", "_cell_size:=0.002", "_diagnostic_period:=0.1"});
    Listener<grid_map_msgs::GridMap> maps(nh_, "height_map");
    ASSERT_TRUE(wait_until([&] { return maps.connected(); }));
    ASSERT_TRUE(diagnostics_.is_up("height_mapper"));
    cameras_.publish(message_of(*s.setup.camera));
    const aeolian_msgs::Profile profile = profile_of(message_of(photograph(s.scene), stamp_of(s)));
    ASSERT_GT(profile.x.size(), 50U);
    EXPECT_EQ(profile.header.frame_id, "map");
    const Errors errors = errors_of(profile, s.scene);
    EXPECT_LT(errors.rms, bar(s.scene));
    // z is the elevation, with a standard error that holds for all of it.
    const double sigma = profile.sigma_z[profile.sigma_z.size() / 2];
    EXPECT_NEAR(errors.mean, level_to_map().translation().z(), 4 * sigma);
    ASSERT_EQ(profile.points.size(), profile.x.size());
    for (std::size_t i = 0; i < profile.x.size(); i += 10) {
      const Eigen::Vector3d truth = level_to_map() * true_bed_point(s.scene, profile.x[i]);
      const geometry_msgs::Point& point = profile.points[i];
      EXPECT_NEAR(point.z, profile.z[i], 1e-12);
      EXPECT_LT(std::hypot(point.x - truth.x(), point.y - truth.y()), 3e-3);
    }

    ASSERT_TRUE(wait_until([&] { return !strips_->messages.empty(); }));
    EXPECT_EQ(strips_->messages.back()->info.header.frame_id, "map");
    const Errors of_strip = errors_of(*strips_->messages.back(), s.scene);
    EXPECT_LT(of_strip.rms, 1.5 * bar(s.scene));
    EXPECT_LT(std::abs(of_strip.mean), 5 * sigma);
    // The points reach the same map by way of height_mapper.
    ASSERT_TRUE(wait_until([&] { return !maps.messages.empty(); }));
    const Errors of_map = errors_of(*maps.messages.back(), s.scene);
    EXPECT_LT(of_map.rms, 5 * bar(s.scene)) << "means of points, at the cells' centres";
    EXPECT_LT(std::abs(of_map.mean), 5 * sigma + bar(s.scene));
    TearDown();
  }
}

TEST_F(ShadowProfilerTest, AnImageWaitsForItsCamera) {
  ShadowSetUp s = set_up(1);
  send_frames(s.scene, 0);
  YAML::Node setup = YAML::Load(s.yaml);
  setup.remove("camera");
  start(YAML::Dump(setup), true);
  listen();
  const sensor_msgs::Image image = message_of(photograph(s.scene), stamp_of(s));
  images_.publish(image);  // as from a bag, in which the camera_info comes after the image
  EXPECT_FALSE(wait_until([&] { return !profiles_->messages.empty(); }, 0.2));
  cameras_.publish(message_of(*s.setup.camera));
  EXPECT_TRUE(wait_until([&] { return !profiles_->messages.empty(); }));
}

TEST_F(ShadowProfilerTest, WhatCannotBeMeasuredIsSaidAndTheNextPhotoIsMeasured) {
  const ShadowSetUp& s = set_up(1);
  send_frames(s.scene, 0);
  start(s.yaml, true);
  listen();
  cameras_.publish(message_of(*s.setup.camera));
  const sensor_msgs::Image good = message_of(photograph(s.scene), stamp_of(s));
  ASSERT_FALSE(profile_of(good).x.empty());
  const auto refused = [&](const std::function<void(sensor_msgs::Image&)>& spoil, const std::string& reason) {
    sensor_msgs::Image image = good;
    spoil(image);
    images_.publish(image);
    EXPECT_TRUE(diagnostics_.warns("shadow_profiler", reason));
    EXPECT_EQ(profiles_->messages.size(), 1U);
  };
  refused([](auto& image) { image.encoding = "bayer_rggb8"; },
          "/image: image: encoding is 'bayer_rggb8', must be");
  refused([](auto& image) { image.step = 3; }, "step is 3");
  refused([](auto& image) { image.data.resize(100); }, "data has 100 bytes");
  refused([](auto& image) { image.data.assign(image.data.size(), 0); }, "under-exposed");
  refused([](auto& image) { image.data.assign(image.data.size(), 255); }, "over-exposed");
  refused([](auto& image) { image.header.frame_id = "elsewhere"; },
          "no transform from 'straightedge' to 'elsewhere'");
  refused([](auto& image) { image.header.frame_id.clear(); }, "frame_id is empty");
  sensor_msgs::CameraInfo info = message_of(*s.setup.camera);
  info.K.fill(0);
  cameras_.publish(info);
  EXPECT_TRUE(
      diagnostics_.warns("shadow_profiler", "/camera_info: camera info: K has focal lengths 0 and 0"));
  info = message_of(*s.setup.camera);
  info.width = 320;
  cameras_.publish(info);
  wait_until([] { return false; }, 0.3);  // nothing tells that it has arrived
  refused([](auto&) {}, "the camera of /camera_info 320 x ");
  EXPECT_EQ(strips_->messages.size(), 1U);
  EXPECT_EQ(overlays_->messages.size(), 1U);

  cameras_.publish(message_of(*s.setup.camera));
  EXPECT_TRUE(wait_until([&] { return !profile_of(good, 1).x.empty(); }));
  EXPECT_TRUE(diagnostics_.is_well("shadow_profiler"));
}

TEST_F(ShadowProfilerTest, MarksOnAFaceThatLeansAreRefused) {
  const ShadowSetUp& s = set_up(0);
  send_frames(s.scene, 3 * degree);
  start(s.yaml, false);
  listen();
  cameras_.publish(message_of(*s.setup.camera));
  images_.publish(message_of(photograph(s.scene), stamp_of(s)));
  EXPECT_TRUE(diagnostics_.warns("shadow_profiler", "leans by 3.0 degrees"));
  send_frames(s.scene, 0);
  const aeolian_msgs::Profile profile = profile_of(message_of(photograph(s.scene), stamp_of(s)));
  ASSERT_FALSE(profile.x.empty());
  EXPECT_EQ(profile.header.frame_id, "map");
  EXPECT_LT(errors_of(profile, s.scene).rms, bar(s.scene));
}

TEST_F(ShadowProfilerTest, StopsAtOnceForABadSetup) {
  const auto expect = [&](const std::string& arguments, const std::string& reason) {
    const Outcome outcome = run_program("shadow_profiler __name:=refused " + arguments);
    EXPECT_EQ(outcome.code, 1);
    EXPECT_NE(outcome.err.find(reason), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  };
  expect("", "/refused/setup: '' is not allowed");
  expect("_setup:=/no/such.yaml", "/no/such.yaml");
  const std::string dark =
      folder_.write("dark.yaml", "straightedge: {scale_px_mm: [[1, 1, 0], [9, 1, 10]]}\n");
  expect("_setup:=" + dark, "there is no light");
  const std::string light = folder_.write("light.yaml", "light: {elevation_deg: 30}\n");
  expect("_setup:=" + light, "there is no scale");
  expect("_pose_from_tf:=true _cell_size:=-1 _setup:=" + light, "cell_size");
}

/// The shipped day made short and small, with the same light and grain.
TEST_F(ShadowProfilerTest, MeasuresTheVirtualFieldDay) {
  YAML::Node day = YAML::LoadFile(AEOLIAN_REPOSITORY "/config/field_day.yaml");
  day["minutes"] = 0.02;
  day["bed"]["length_m"] = 0.4;
  day["bed"]["width_m"] = 0.3;
  day["bed"]["spin_up_minutes"] = 3;
  day["scanners"]["columns"] = 2;
  day["scanners"]["rows"] = 2;
  day["camera"]["width_px"] = 1200;
  day["camera"]["height_px"] = 600;
  day["camera"]["position_m"] = std::vector<double>{0.2, 0.15, 0.65};
  day["camera"]["looks_at_m"] = std::vector<double>{0.2, 0.15, 0.0};
  day["shadow"]["edge_start_m"] = std::vector<double>{0.07, 0.20, 0.08};
  day["shadow"]["edge_end_m"] = std::vector<double>{0.33, 0.20, 0.08};
  std::ofstream(folder_.file("day.yaml")) << day;
  ASSERT_EQ(std::system((AEOLIAN_BIN "/simulate_field --config " + folder_.file("day.yaml") + " --out " +
                         folder_.file("day"))
                            .c_str()),
            0);
  start(content_of(folder_.file("day/shadow_setup.yaml")), true);
  listen();
  rosbag::Bag bag(folder_.file("day/field_day.bag"));
  for (const rosbag::MessageInstance& message : rosbag::View(bag)) {
    if (const auto frames = message.instantiate<tf2_msgs::TFMessage>()) tf_.sendTransform(frames->transforms);
    if (const auto image = message.instantiate<sensor_msgs::Image>()) images_.publish(image);
    if (const auto info = message.instantiate<sensor_msgs::CameraInfo>()) cameras_.publish(info);
  }
  ASSERT_TRUE(wait_until([&] { return !profiles_->messages.empty(); }));
  const aeolian_msgs::Profile& profile = *profiles_->messages.back();
  const HeightMap truth = read_geotiff(folder_.file("day/truth/elevation_0000.tif"));
  std::vector<double> errors;
  for (const geometry_msgs::Point& point : profile.points)
    errors.push_back(point.z - sample(truth.geometry(), truth.layer(layer::elevation), point.x, point.y));
  ASSERT_GT(errors.size(), 300U);
  const Errors found(errors);
  RecordProperty("rmse_mm", std::to_string(1e3 * found.rms));
  RecordProperty("bias_mm", std::to_string(1e3 * found.mean));
  // Half a grain: the bed of grains is itself rough by as much from cell to cell, and the penumbra spans two.
  EXPECT_LT(found.rms, 2e-4);
  EXPECT_LT(std::abs(found.mean), 1e-4);
}

}  // namespace
}  // namespace aeolian

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "shadow_profiler_rostest");
  const ros::NodeHandle keeps_ros_alive;
  return RUN_ALL_TESTS();
}
