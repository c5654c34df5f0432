#include <cmath>

#include "../../error_of.hpp"
#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>
#include <sensor_msgs/point_cloud2_iterator.h>

#include "aeolian_twin/nodes/conversions.hpp"

namespace aeolian {
namespace {

/// An image of 3 x 2 pixels, each of some bytes that count up; rows padded by two bytes.
sensor_msgs::Image image(const std::string& encoding, unsigned bytes) {
  sensor_msgs::Image message;
  message.encoding = encoding;
  message.width = 3;
  message.height = 2;
  message.step = 3 * bytes + 2;
  for (unsigned i = 0; i < message.step * message.height; ++i)
    message.data.push_back(static_cast<std::uint8_t>(i));
  return message;
}

TEST(PhotoConversions, GreyImagesKeepTheirValues) {
  const Photo photo = to_photo(image("mono8", 1));
  EXPECT_EQ(photo.width_px, 3);
  EXPECT_EQ(photo.height_px, 2);
  EXPECT_EQ(photo.white, 255);
  EXPECT_EQ(photo.values8, (std::vector<std::uint8_t>{0, 1, 2, 5, 6, 7}));
}

TEST(PhotoConversions, SixteenBitsInEitherByteOrder) {
  sensor_msgs::Image message = image("mono16", 2);
  message.is_bigendian = 0;
  EXPECT_EQ(to_photo(message).values16, (std::vector<std::uint16_t>{256, 770, 1284, 2312, 2826, 3340}));
  message.is_bigendian = 1;
  const Photo photo = to_photo(message);
  EXPECT_EQ(photo.white, 65535);
  EXPECT_TRUE(photo.values8.empty());
  EXPECT_EQ(photo.values16, (std::vector<std::uint16_t>{1, 515, 1029, 2057, 2571, 3085}));
}

TEST(PhotoConversions, ColoursBecomeLumaWhateverTheirOrder) {
  // A strong red: luma 0.299 R + 0.587 G + 0.114 B (ITU-R BT.601).
  const std::uint8_t red = 200;
  const std::uint8_t green = 40;
  const std::uint8_t blue = 90;
  const int luma = static_cast<int>(std::lround(0.299 * red + 0.587 * green + 0.114 * blue));
  for (const std::string encoding : {"rgb8", "bgr8", "rgba8", "bgra8"}) {
    const unsigned bytes = encoding.size() == 5 ? 4 : 3;
    sensor_msgs::Image message = image(encoding, bytes);
    const bool rgb = encoding[0] == 'r';
    for (unsigned row = 0; row < 2; ++row)
      for (unsigned column = 0; column < 3; ++column) {
        std::uint8_t* pixel = message.data.data() + row * message.step + column * bytes;
        pixel[0] = rgb ? red : blue;
        pixel[1] = green;
        pixel[2] = rgb ? blue : red;
        if (bytes == 4) pixel[3] = 7;  // alpha
      }
    const Photo photo = to_photo(message);
    ASSERT_EQ(photo.values8.size(), 6U) << encoding;
    for (const std::uint8_t value : photo.values8) EXPECT_NEAR(value, luma, 1) << encoding;
    const cv::Mat picture = to_picture(message);
    ASSERT_EQ(picture.type(), CV_8UC3);
    EXPECT_EQ(picture.at<cv::Vec3b>(1, 2), cv::Vec3b(blue, green, red)) << encoding;
  }
}

TEST(PhotoConversions, PicturesAreBgrAndComeBack) {
  const cv::Mat grey = to_picture(image("mono16", 2));
  EXPECT_EQ(grey.at<cv::Vec3b>(1, 0), cv::Vec3b(9, 9, 9));
  const cv::Mat picture = to_picture(image("bgr8", 3));
  std_msgs::Header header;
  header.frame_id = "camera";
  const sensor_msgs::Image message = to_message(picture, header);
  EXPECT_EQ(message.encoding, "bgr8");
  EXPECT_EQ(message.step, 9U);
  EXPECT_EQ(message.header.frame_id, "camera");
  EXPECT_EQ(cv::norm(to_picture(message), picture, cv::NORM_INF), 0);
}

TEST(PhotoConversions, BadImagesAreRefusedInOneLine) {
  const auto refused = [](const sensor_msgs::Image& message, const std::string& text) {
    const std::string line = error_of([&] { to_photo(message); });
    EXPECT_NE(line.find(text), std::string::npos) << line;
    EXPECT_EQ(line.find('\n'), std::string::npos);
    EXPECT_EQ(line, error_of([&] { to_picture(message); }));
  };
  refused(image("bayer_rggb8", 1), "encoding is 'bayer_rggb8', must be mono8");
  refused(image("", 1), "encoding is ''");
  refused(image("32FC1", 4), "encoding is '32FC1'");
  sensor_msgs::Image message = image("bgr8", 3);
  message.step = 8;
  refused(message, "step is 8, must be at least 9");
  message = image("mono8", 1);
  message.data.resize(7);
  refused(message, "data has 7 bytes, must have 8");
  message.width = 0;
  refused(message, "0 x 2 pixels");
  message = image("mono8", 1);
  message.width = message.height = 4000000000;
  message.step = 4000000000;
  refused(message, "data has 10 bytes");
}

sensor_msgs::CameraInfo camera_info() {
  sensor_msgs::CameraInfo info;
  info.width = 640;
  info.height = 480;
  info.distortion_model = "plumb_bob";
  info.D = {-0.2, 0.05, 0.001, -0.002, 0.01};
  info.K = {500, 0, 320, 0, 510, 240, 0, 0, 1};
  return info;
}

TEST(PhotoConversions, CameraInfoIsTheUnrectifiedCamera) {
  CameraModel camera = to_camera_model(camera_info());
  EXPECT_EQ(camera.width_px, 640);
  EXPECT_EQ(camera.height_px, 480);
  EXPECT_EQ(camera.fx, 500);
  EXPECT_EQ(camera.fy, 510);
  EXPECT_EQ(camera.cx, 320);
  EXPECT_EQ(camera.cy, 240);
  EXPECT_EQ(camera.distortion, (std::array<double, 8>{-0.2, 0.05, 0.001, -0.002, 0.01, 0, 0, 0}));
  sensor_msgs::CameraInfo info = camera_info();
  info.distortion_model = "rational_polynomial";
  info.D = {1, 2, 3, 4, 5, 6, 7, 8};
  EXPECT_EQ(to_camera_model(info).distortion, (std::array<double, 8>{1, 2, 3, 4, 5, 6, 7, 8}));
  info.distortion_model.clear();  // a simulated camera without a lens
  info.D.clear();
  EXPECT_EQ(to_camera_model(info).distortion, (std::array<double, 8>{}));
}

TEST(PhotoConversions, CamerasThatCannotBeUsedAreRefused) {
  const auto refused = [](const std::function<void(sensor_msgs::CameraInfo&)>& spoil,
                          const std::string& text) {
    sensor_msgs::CameraInfo info = camera_info();
    spoil(info);
    const std::string line = error_of([&] { to_camera_model(info); });
    EXPECT_NE(line.find(text), std::string::npos) << line;
  };
  refused([](auto& info) { info.K.fill(0); }, "is the camera calibrated?");
  refused([](auto& info) { info.K[0] = std::nan(""); }, "is the camera calibrated?");
  refused([](auto& info) { info.K[2] = INFINITY; }, "not finite");
  refused([](auto& info) { info.K[1] = 3; }, "skew of 3");
  refused([](auto& info) { info.distortion_model = "equidistant"; }, "distortion_model is 'equidistant'");
  refused([](auto& info) { info.D.resize(3); }, "with 3 coefficients");
  refused([](auto& info) { info.D[4] = std::nan(""); }, "not finite");
  refused([](auto& info) { info.binning_x = 2; }, "binning is 2 x 0");
  refused([](auto& info) { info.roi.x_offset = 8; }, "roi");
}

TEST(PhotoConversions, ProfilesAndTheirPoints) {
  ShadowProfile profile;
  profile.x = {0, 1};
  profile.z = {0.1, 0.2};
  profile.sigma_z = {0.01, 0.02};
  ProfileAnalysis analysis;
  analysis.wavelength = {0.08, 0.001};
  analysis.height = {0.005, 0.0001};
  std_msgs::Header header;
  header.frame_id = "map";
  const std::vector<Eigen::Vector3d> points{{1, 2, 3}, {4, 5, 6}};
  const aeolian_msgs::Profile message = to_message(profile, analysis, points, header);
  EXPECT_EQ(message.header.frame_id, "map");
  EXPECT_EQ(message.x, profile.x);
  EXPECT_EQ(message.z, profile.z);
  EXPECT_EQ(message.sigma_z, profile.sigma_z);
  EXPECT_EQ(message.wavelength, 0.08);
  EXPECT_EQ(message.height, 0.005);
  ASSERT_EQ(message.points.size(), 2U);
  EXPECT_EQ(message.points[1].z, 6);
  EXPECT_TRUE(to_message(profile, analysis, {}, header).points.empty());

  const sensor_msgs::PointCloud2 cloud = to_cloud(points, profile.sigma_z, header);
  const PointCloud fused = to_point_cloud(cloud);
  ASSERT_EQ(fused.size(), 2U);
  EXPECT_EQ(fused.y[1], 5);
  sensor_msgs::PointCloud2ConstIterator<float> sigma(cloud, "sigma_z");
  EXPECT_FLOAT_EQ(sigma[4], 0.02F);
}

}  // namespace
}  // namespace aeolian
