#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "../shared_data.hpp"
#include "../small_disk.hpp"
#include "../temporary_folder.hpp"
#include "program_outcome.hpp"
#include <Eigen/Geometry>
#include <fmt/format.h>
#include <geometry_msgs/TwistStamped.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/point_cloud2_iterator.h>
#include <sys/wait.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_msgs/TFMessage.h>

#include "aeolian_core/surface/cloud_file.hpp"

namespace aeolian {
namespace {

namespace fs = std::filesystem;

template <class Message>
std::vector<Message> messages(const rosbag::Bag& bag, const std::string& topic) {
  std::vector<Message> result;
  rosbag::View view(bag, rosbag::TopicQuery(topic));
  for (const rosbag::MessageInstance& instance : view) result.push_back(*instance.instantiate<Message>());
  return result;
}

std::vector<Eigen::Vector3d> points_of(sensor_msgs::PointCloud2 cloud) {
  std::vector<Eigen::Vector3d> points;
  for (sensor_msgs::PointCloud2Iterator<float> p(cloud, "x"); p != p.end(); ++p)
    points.emplace_back(static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2]));
  return points;
}

/// The transform of a child frame that a bag gives, and its parent.
struct Link {
  std::string parent;
  Eigen::Isometry3d pose;
  ros::Time stamp;
};

std::map<std::string, Link> links(const rosbag::Bag& bag, const std::string& topic) {
  std::map<std::string, Link> result;
  for (const auto& message : messages<tf2_msgs::TFMessage>(bag, topic))
    for (const auto& t : message.transforms)
      result[t.child_frame_id] = {t.header.frame_id, tf2::transformToEigen(t), t.header.stamp};
  return result;
}

/// Where a point of a frame lies in the map.
Eigen::Vector3d in_map(const std::map<std::string, Link>& tree, std::string frame, Eigen::Vector3d point) {
  while (frame != "map") {
    const Link& link = tree.at(frame);
    point = link.pose * point;
    frame = link.parent;
  }
  return point;
}

class MakeBag : public testing::Test {
 protected:
  static Outcome run(const std::string& manifest, const std::string& bag) {
    return run_program("make_bag '" + manifest + "' '" + bag + "'");
  }

  /// Makes a bag of a manifest and opens it; expects the warnings.
  void make(const std::string& manifest, const std::string& warnings = "") {
    const Outcome outcome = run(folder_.write("manifest.yaml", manifest), folder_.file("out.bag"));
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, warnings);
    bag_.open(folder_.file("out.bag"));
  }

  /// Expects that a manifest is refused in one line that contains each part, and that an old bag survives.
  void expect_refusal(const std::string& manifest, const std::vector<std::string>& parts) const {
    const std::string bag = folder_.write("out.bag", "old");
    const std::size_t files = folder_.count_files() + (fs::exists(folder_.file("manifest.yaml")) ? 0 : 1);
    const Outcome outcome = run(folder_.write("manifest.yaml", manifest), bag);
    EXPECT_EQ(outcome.code, 1) << manifest;
    EXPECT_EQ(outcome.err.rfind("make_bag: ", 0), 0U) << outcome.err;
    EXPECT_EQ(outcome.err.find('\n'), outcome.err.size() - 1) << outcome.err;
    for (const std::string& part : parts)
      EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err << "must contain " << part;
    EXPECT_EQ(content_of(bag), "old");
    EXPECT_EQ(folder_.count_files(), files) << "something is left behind";
  }

  void write_photo(const std::string& name, int type, int width = 4, int height = 3) const {
    cv::Mat photo(height, width, type);
    for (int i = 0; i < height; ++i) photo.row(i).setTo(cv::Scalar(10 + i, 100 + i, 200 + i));
    cv::imwrite(folder_.file(name), photo);
  }

  void write_camera() const {
    folder_.write(
        "camera.yaml",
        "image_width: 4\nimage_height: 3\ncamera_name: rig\n"
        "camera_matrix: {rows: 3, cols: 3, data: [500, 0, 2, 0, 501, 1.5, 0, 0, 1]}\n"
        "distortion_model: plumb_bob\n"
        "distortion_coefficients: {rows: 1, cols: 5, data: [0.1, -0.2, 0.001, 0.002, 0]}\n"
        "rectification_matrix: {rows: 3, cols: 3, data: [1, 0, 0, 0, 1, 0, 0, 0, 1]}\n"
        "projection_matrix: {rows: 3, cols: 4, data: [490, 0, 2.1, 0, 0, 491, 1.6, 0, 0, 0, 1, 0]}\n");
  }

  TemporaryFolder folder_;
  rosbag::Bag bag_;
};

TEST_F(MakeBag, WritesEveryTopicInOrderOfTime) {
  folder_.write("scan.xyz", "0.1 0.2 -1.9\n0.3 0.4 -2\n0.5 0.6 -2.1\n");
  write_photo("photo.png", CV_8UC3);
  write_camera();
  folder_.write("wind.csv", "t_s,speed_m_s,direction_deg\n0,2,90\n1,3,180\n2,4,0\n");
  make(
      "clouds:\n  - {file: scan.xyz, stamp: 101.5, frame: scanner, pose: [1, 2, 2.5, 0, 0, 0, 1]}\n"
      "photos:\n  - {file: photo.png, stamp: 100.5, camera_info: camera.yaml}\n"
      "wind: {file: wind.csv, height_m: 1.5, start: 100}\n");
  std::map<std::string, int> counts;
  ros::Time last;
  rosbag::View view(bag_);
  for (const rosbag::MessageInstance& message : view) {
    ++counts[message.getTopic()];
    EXPECT_GE(message.getTime(), last);
    last = message.getTime();
  }
  const std::map<std::string, int> expected{{"/camera_info", 1}, {"/image", 1},     {"/points", 1},
                                            {"/tf", 1},          {"/tf_static", 1}, {"/wind", 3}};
  EXPECT_EQ(counts, expected);
}

TEST_F(MakeBag, ACloudWithAPoseComesInItsFrameWithTheTransformAtItsStamp) {
  folder_.write("scan.csv", "x,y,z\n1,2,3\n,,\n4,5,6\n");
  // A quarter turn about z; written to four digits, as people do.
  make(
      "clouds:\n  - {file: scan.csv, stamp: 1700000000.123456789, frame: scanner,"
      " pose: [10, 20, 30, 0, 0, 0.7071, 0.7071]}\n");
  const auto cloud = messages<sensor_msgs::PointCloud2>(bag_, "/points").at(0);
  EXPECT_EQ(cloud.header.frame_id, "scanner");
  EXPECT_EQ(cloud.header.stamp, ros::Time(1700000000, 123456789));
  EXPECT_FALSE(cloud.is_dense);
  const auto points = points_of(cloud);
  ASSERT_EQ(points.size(), 3U);
  EXPECT_EQ(points[0], Eigen::Vector3d(1, 2, 3));
  EXPECT_FALSE(points[1].allFinite());
  const auto tree = links(bag_, "/tf");
  EXPECT_EQ(tree.at("scanner").stamp, cloud.header.stamp);
  EXPECT_LT((in_map(tree, "scanner", points[2]) - Eigen::Vector3d(5, 24, 36)).norm(), 1e-9);
}

TEST_F(MakeBag, ACloudWithoutAPoseIsInItsFrameOrInTheMap) {
  folder_.write("scan.xyz", "1 2 3\n");
  make(
      "frame_id: field\nclouds:\n  - {file: scan.xyz, stamp: 1}\n  - {file: scan.xyz, stamp: 2, frame: "
      "plot}\n");
  const auto clouds = messages<sensor_msgs::PointCloud2>(bag_, "/points");
  EXPECT_EQ(clouds.at(0).header.frame_id, "field");
  EXPECT_EQ(clouds.at(1).header.frame_id, "plot");
  EXPECT_TRUE(messages<tf2_msgs::TFMessage>(bag_, "/tf").empty());
}

TEST_F(MakeBag, LargeCoordinatesReachTheMapThroughTheTransform) {
  folder_.write("utm.xyz", "512345.678 5401234.567 312.345\n512346.789 5401235.891 313.25\n");
  make(
      "clouds:\n  - {file: utm.xyz, stamp: 1}\n"
      "  - {file: utm.xyz, stamp: 2, frame: local, pose: [-512000, -5401000, -300, 0, 0, 0, 1]}\n");
  const auto clouds = messages<sensor_msgs::PointCloud2>(bag_, "/points");
  const auto tree = links(bag_, "/tf");
  for (const auto& cloud : clouds)
    for (const auto& point : points_of(cloud)) EXPECT_LT(point.norm(), 10) << "a large float";
  EXPECT_EQ(clouds.at(0).header.frame_id, "cloud_0");
  EXPECT_EQ(clouds.at(1).header.frame_id, "cloud_1");
  EXPECT_EQ(tree.at("cloud_1").parent, "local");
  const auto first = in_map(tree, "cloud_0", points_of(clouds.at(0)).at(1));
  EXPECT_LT((first - Eigen::Vector3d(512346.789, 5401235.891, 313.25)).norm(), 1e-6);
  const auto second = in_map(tree, "cloud_1", points_of(clouds.at(1)).at(0));
  EXPECT_LT((second - Eigen::Vector3d(345.678, 234.567, 12.345)).norm(), 1e-6);
}

TEST_F(MakeBag, PhotosKeepTheirPixelsAndTheirCalibration) {
  write_camera();
  write_photo("colour.png", CV_8UC3);
  write_photo("grey.png", CV_8UC1);
  write_photo("deep.png", CV_16UC1);
  make(
      "photos:\n  - {file: colour.png, stamp: 1, camera_info: camera.yaml, frame: eye, pose: [0, 0, 1, 1, 0, "
      "0, 0]}\n"
      "  - {file: grey.png, stamp: 2, camera_info: camera.yaml}\n"
      "  - {file: deep.png, stamp: 3, camera_info: camera.yaml}\n");
  const auto images = messages<sensor_msgs::Image>(bag_, "/image");
  ASSERT_EQ(images.size(), 3U);
  EXPECT_EQ(images[0].encoding, "bgr8");
  EXPECT_EQ(images[1].encoding, "mono8");
  EXPECT_EQ(images[2].encoding, "mono16");
  EXPECT_EQ(images[0].width, 4U);
  EXPECT_EQ(images[0].height, 3U);
  const std::vector<std::uint8_t> last_pixel(images[0].data.end() - 3, images[0].data.end());
  EXPECT_EQ(last_pixel, (std::vector<std::uint8_t>{12, 102, 202}));
  EXPECT_EQ(images[1].data.back(), 12);
  EXPECT_EQ(images[0].header.frame_id, "eye");
  EXPECT_EQ(images[1].header.frame_id, "camera");
  EXPECT_EQ(links(bag_, "/tf").at("eye").pose.translation().z(), 1);
  const auto infos = messages<sensor_msgs::CameraInfo>(bag_, "/camera_info");
  ASSERT_EQ(infos.size(), 3U);
  EXPECT_EQ(infos[0].header.stamp, images[0].header.stamp);
  EXPECT_EQ(infos[0].header.frame_id, "eye");
  EXPECT_EQ(infos[0].K[4], 501);
  EXPECT_EQ(infos[0].D, (std::vector<double>{0.1, -0.2, 0.001, 0.002, 0}));
  EXPECT_EQ(infos[0].P[6], 1.6);
}

TEST_F(MakeBag, WindIsAVelocityAtTheAnemometersHeightAboveTheGround) {
  folder_.write("scan.xyz", "0 0 4\n1 0 5\n0 1 5.5\n");
  folder_.write("wind.csv", "t_s,speed_m_s,from_deg\n0,2,270\n0.25,3,180\n");
  make("clouds:\n  - {file: scan.xyz, stamp: 60}\nwind: {file: wind.csv, height_m: 1.5, start: 59.5}\n");
  const auto wind = messages<geometry_msgs::TwistStamped>(bag_, "/wind");
  ASSERT_EQ(wind.size(), 2U);
  EXPECT_NEAR(wind[0].twist.linear.x, 2, 1e-12) << "from the west it blows to the east";
  EXPECT_NEAR(wind[0].twist.linear.y, 0, 1e-12);
  EXPECT_NEAR(wind[1].twist.linear.x, 0, 1e-12);
  EXPECT_NEAR(wind[1].twist.linear.y, 3, 1e-12);
  EXPECT_EQ(wind[0].header.stamp, ros::Time(59, 500000000));
  EXPECT_EQ(wind[1].header.stamp, ros::Time(59, 750000000));
  EXPECT_EQ(wind[0].header.frame_id, "anemometer");
  const auto tree = links(bag_, "/tf_static");
  EXPECT_EQ(tree.at("anemometer").parent, "map");
  EXPECT_NEAR(tree.at("anemometer").pose.translation().z(), 5 + 1.5, 1e-6) << "the median ground is at 5 m";
  rosbag::View statics(bag_, rosbag::TopicQuery("/tf_static"));
  EXPECT_EQ(statics.begin()->getConnectionHeader()->at("latching"), "1");
}

TEST_F(MakeBag, AGapOfTheWindRecordIsToldAndTheRestWritten) {
  const std::string wind = folder_.write(
      "wind.csv", "t_s,speed_m_s,direction_deg\n1,2,0\n2,2,0\n3,,\n4,2,0\n5,2,0\n65.5,2,0\n66.5,2,0\n");
  make("wind: {file: wind.csv, height_m: 1}\n",
       "make_bag: warning: wind record " + wind +
           ": nothing from t_s 5 to 65.5 (1 s between samples is usual)\n");
  EXPECT_EQ(messages<geometry_msgs::TwistStamped>(bag_, "/wind").size(), 6U);
}

TEST_F(MakeBag, TheExampleManifestWorks) {
  for (const char* name : {"scan_0000.xyz", "scan_0060.xyz"}) folder_.write(name, "0.1 0.2 1.9\n0.3 0.4 2\n");
  folder_.write("survey_utm.xyz", "512345.678 5401234.567 312.345\n");
  write_photo("shadow.jpg", CV_8UC3);
  write_camera();
  folder_.write("wind.csv", "t_s,speed_m_s,direction_deg\n0,2,90\n1,3,180\n");
  make(content_of(std::string(AEOLIAN_REPOSITORY) + "/config/manifest.example.yaml"));
  EXPECT_EQ(messages<sensor_msgs::PointCloud2>(bag_, "/points").size(), 3U);
}

TEST_F(MakeBag, RefusesAManifestThatIsNone) {
  const Outcome missing = run(folder_.file("none.yaml"), folder_.file("out.bag"));
  EXPECT_EQ(missing.code, 1);
  EXPECT_EQ(missing.err, "make_bag: " + folder_.file("none.yaml") + ": cannot be read\n");
  EXPECT_EQ(run(folder_.path(), folder_.file("out.bag")).code, 1);
  expect_refusal("clouds: [{file: a.xyz\n", {"manifest.yaml:"});
  expect_refusal("just words\n", {"manifest.yaml:1", "key: value"});
  expect_refusal("frame_id: map\n", {"neither clouds nor photos nor wind"});
  expect_refusal("", {"manifest.yaml"});
}

TEST_F(MakeBag, NamesTheKeyTheIndexAndTheValue) {
  folder_.write("scan.xyz", "1 2 3\n");
  const std::string good = "clouds:\n  - {file: scan.xyz, stamp: 1}\n";
  expect_refusal(good + "  - {file: scan.xyz}\n", {"clouds[1].stamp"});
  expect_refusal(good + "  - {stamp: 1}\n", {"clouds[1].file"});
  expect_refusal(good + "  - scan.xyz\n", {":3", "clouds[1]"});
  expect_refusal("clouds: scan.xyz\n", {"clouds", "must be a list"});
  expect_refusal(good + "  - {file: scan.xyz, stamp: soon}\n",
                 {":3", "clouds[1].stamp is 'soon'", "seconds"});
  expect_refusal(good + "  - {file: scan.xyz, stamp: -1}\n", {"clouds[1].stamp is '-1'"});
  expect_refusal(good + "  - {file: scan.xyz, stamp: 1.7e9}\n", {"clouds[1].stamp is '1.7e9'"});
  expect_refusal(good + "  - {file: scan.xyz, stamp: 5000000000}\n", {"clouds[1].stamp is '5000000000'"});
  expect_refusal(good + "  - {file: scan.xyz, stamp: 0}\n", {"clouds[1].stamp is '0'", "greater than 0"});
  expect_refusal(good + "  - {file: scan.xyz, stamp: 1, colour: red}\n", {"unknown key 'clouds[1].colour'"});
  expect_refusal(good + "  - {file: scan.xyz, stamp: 1, frame: /lidar}\n", {"clouds[1].frame is '/lidar'"});
  expect_refusal(good + "bags: []\n", {"unknown key 'bags'"});
  expect_refusal("photos:\n  - {file: a.png, stamp: 1}\n", {"photos[0].camera_info"});
  expect_refusal("wind: {file: wind.csv}\n", {"wind.height_m"});
  expect_refusal("wind: {file: wind.csv, height_m: -1}\n", {"wind.height_m is '-1', must be positive"});
  expect_refusal("wind: wind.csv\n", {"wind must be a section"});
}

TEST_F(MakeBag, RefusesAPoseWithoutAUnitQuaternion) {
  folder_.write("scan.xyz", "1 2 3\n");
  const auto cloud = [](const std::string& pose) {
    return "clouds:\n  - {file: scan.xyz, stamp: 1, frame: s, pose: " + pose + "}\n";
  };
  expect_refusal(cloud("[0, 0, 0, 0, 0, 0, 0]"), {"clouds[0].pose", "quaternion of length 0, must be 1"});
  expect_refusal(cloud("[0, 0, 0, 1, 1, 0, 0]"), {"clouds[0].pose", "quaternion of length 1.41421"});
  expect_refusal(cloud("[0, 0, 0, .nan, 0, 0, 1]"), {"clouds[0].pose"});
  expect_refusal(cloud("[0, 0, 0]"), {"clouds[0].pose", "7 numbers"});
  expect_refusal(cloud("[a, 0, 0, 0, 0, 0, 1]"), {"clouds[0].pose", "'a', must be a number"});
  expect_refusal("clouds:\n  - {file: scan.xyz, stamp: 1, frame: map, pose: [0, 0, 0, 0, 0, 0, 1]}\n",
                 {"clouds[0].frame is 'map'", "another than frame_id"});
}

TEST_F(MakeBag, RefusesCloudsThatAreNone) {
  expect_refusal("clouds:\n  - {file: none.pcd, stamp: 1}\n", {"none.pcd", "no such file"});
  folder_.write("flat.pcd",
                "VERSION .7\nFIELDS x y\nSIZE 4 4\nTYPE F F\nCOUNT 1 1\nWIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA "
                "ascii\n1 2\n");
  expect_refusal("clouds:\n  - {file: flat.pcd, stamp: 1}\n", {"flat.pcd", "no field z"});
  folder_.write("nothing.xyz", "nan nan nan\nnan nan nan\n");
  expect_refusal("clouds:\n  - {file: nothing.xyz, stamp: 1}\n", {"nothing.xyz", "no finite point"});
  folder_.write("noise.pcd", "no point cloud at all\n");
  expect_refusal("clouds:\n  - {file: noise.pcd, stamp: 1}\n", {"noise.pcd"});
  folder_.write("scan.las", "LASF");
  expect_refusal("clouds:\n  - {file: scan.las, stamp: 1}\n", {"scan.las", "convert it to XYZ"});
  // The second file is found bad after the first was written.
  folder_.write("good.xyz", "1 2 3\n");
  expect_refusal("clouds:\n  - {file: good.xyz, stamp: 1}\n  - {file: nothing.xyz, stamp: 2}\n",
                 {"nothing.xyz"});
}

TEST_F(MakeBag, RefusesPhotosThatAreNone) {
  write_camera();
  write_photo("photo.png", CV_8UC3);
  write_photo("large.png", CV_8UC3, 8, 6);
  folder_.write("words.jpg", "this is not an image\n");
  const std::string camera = ", stamp: 1, camera_info: camera.yaml}\n";
  expect_refusal("photos:\n  - {file: none.jpg" + camera, {"none.jpg", "no such file"});
  expect_refusal("photos:\n  - {file: words.jpg" + camera, {"words.jpg", "is not an image"});
  expect_refusal("photos:\n  - {file: large.png" + camera, {"large.png", "8 x 6 pixels", "for 4 x 3"});
  expect_refusal("photos:\n  - {file: photo.png, stamp: 1, camera_info: none.yaml}\n",
                 {"none.yaml", "cannot be read"});
  folder_.write("bad.yaml",
                "image_width: 4\nimage_height: 3\ndistortion_model: plumb_bob\n"
                "distortion_coefficients: {data: [0]}\ncamera_matrix: {data: [1, 2]}\n");
  expect_refusal("photos:\n  - {file: photo.png, stamp: 1, camera_info: bad.yaml}\n",
                 {"bad.yaml:5", "camera_matrix.data", "9 numbers"});
}

TEST_F(MakeBag, RefusesWindRecordsThatAreNone) {
  const std::string manifest = "wind: {file: wind.csv, height_m: 1}\n";
  expect_refusal(manifest, {"wind.csv", "No such file"});
  folder_.write("wind.csv", "time,speed\n1,2\n");
  expect_refusal(manifest, {"wind.csv", "t_s"});
  folder_.write("wind.csv", "t_s,speed_m_s\n1,2\n");
  expect_refusal(manifest, {"wind.csv", "direction_deg"});
  folder_.write("wind.csv", "t_s,speed_m_s,direction_deg\n1,fast,0\n");
  expect_refusal(manifest, {"wind.csv", "line 2", "'fast'"});
  folder_.write("wind.csv", "t_s,speed_m_s,direction_deg\n");
  expect_refusal(manifest, {"wind.csv", "no samples"});
  folder_.write("wind.csv", "t_s,speed_m_s,direction_deg\n-5,1,0\n");
  expect_refusal(manifest, {"wind.csv", "t_s -5", "wind.start"});
}

TEST_F(MakeBag, NeedsAPlaceForTheBag) {
  folder_.write("scan.xyz", "1 2 3\n");
  const std::string manifest = folder_.write("manifest.yaml", "clouds:\n  - {file: scan.xyz, stamp: 1}\n");
  for (const std::string& bag :
       {manifest + "/out.bag", folder_.file("none/out.bag"), std::string("/proc/out.bag")}) {
    const Outcome outcome = run(manifest, bag);
    EXPECT_EQ(outcome.code, 1);
    EXPECT_EQ(outcome.err.rfind("make_bag: cannot write '" + bag + "': ", 0), 0U) << outcome.err;
    EXPECT_EQ(outcome.err.find('\n'), outcome.err.size() - 1) << outcome.err;
  }
}

TEST_F(MakeBag, AFullDiskIsToldAndLeavesTheOldBag) {
  std::string points;
  for (int i = 0; i < 40000; ++i)
    points += fmt::format("{} {} {}\n", std::sin(i), std::cos(3 * i), std::sin(7 * i));
  folder_.write("scan.xyz", points);
  const std::string manifest = folder_.write("manifest.yaml", "clouds:\n  - {file: scan.xyz, stamp: 1}\n");
  const TemporaryFolder small;
  const SmallDisk disk(small.path(), 100000);
  if (!disk.mounted()) GTEST_SKIP() << "only the superuser can make a small disk";
  const std::string bag = small.write("out.bag", "old");
  const Outcome outcome = run(manifest, bag);
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(outcome.err.rfind("make_bag: bag '" + bag + "': ", 0), 0U) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_EQ(content_of(bag), "old");
  EXPECT_EQ(small.count_files(), 1U);
}

TEST_F(MakeBag, SaysHowItIsCalled) {
  EXPECT_EQ(run_program("make_bag --help").code, 0);
  EXPECT_EQ(run_program("make_bag").code, 1);
}

class MakeBagOfRealScans : public MakeBag {
 protected:
  void SetUp() override {
    if (!fs::exists(data_)) GTEST_SKIP() << "there is no " << data_;
  }
  const fs::path data_ = shared_data();
};

TEST_F(MakeBagOfRealScans, LidarInUtmCoordinates) {
  const std::string file = (data_ / "lidar-terrain/samp53-utm.pcd").string();
  make("clouds:\n  - {file: " + file + ", stamp: 1700000000}\n");
  const auto cloud = messages<sensor_msgs::PointCloud2>(bag_, "/points").at(0);
  const auto tree = links(bag_, "/tf");
  const auto points = points_of(cloud);
  // The file is compressed float32; its own reader gives the coordinates that it holds.
  const PointCloud original = read_cloud(file);
  ASSERT_EQ(points.size(), original.size());
  const Eigen::Vector3d origin(original.origin_x, original.origin_y, original.origin_z);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3f relative(original.x[i], original.y[i], original.z[i]);
    const Eigen::Vector3d expected = origin + relative.cast<double>();
    const Eigen::Vector3d found = in_map(tree, cloud.header.frame_id, points[i]);
    ASSERT_LT((found - expected).norm(), 1e-6);
    ASSERT_EQ(found.y(), static_cast<double>(static_cast<float>(found.y()))) << "the file holds floats";
  }
}

TEST_F(MakeBagOfRealScans, FiveDepthCaptures) {
  std::string manifest = "clouds:\n";
  std::vector<std::string> files;
  for (int i = 1; i <= 5; ++i) {
    files.push_back((data_ / ("depth-camera/capture000" + std::to_string(i) + ".pcd")).string());
    manifest += "  - {file: " + files.back() + ", stamp: 170000000" + std::to_string(i) +
                ", frame: camera, pose: [0, 0, 1, 1, 0, 0, 0]}\n";
  }
  make(manifest);
  const auto clouds = messages<sensor_msgs::PointCloud2>(bag_, "/points");
  ASSERT_EQ(clouds.size(), 5U);
  EXPECT_EQ(messages<tf2_msgs::TFMessage>(bag_, "/tf").size(), 5U);
  for (std::size_t c = 0; c < 5; ++c) {
    EXPECT_EQ(clouds[c].header.frame_id, "camera");
    EXPECT_EQ(clouds[c].width * clouds[c].height, 640U * 480U);
    const PointCloud original = read_cloud(files[c]);
    const auto points = points_of(clouds[c]);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const bool known = std::isfinite(original.x[i]);
      ASSERT_EQ(points[i].allFinite(), known);
      if (known) {
        ASSERT_EQ(points[i].z(), static_cast<double>(original.z[i]));
      }
    }
  }
}

}  // namespace
}  // namespace aeolian
