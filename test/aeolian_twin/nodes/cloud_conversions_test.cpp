#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include <gtest/gtest.h>
#include <sensor_msgs/point_cloud2_iterator.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_twin/nodes/conversions.hpp"

namespace aeolian {
namespace {

using sensor_msgs::PointCloud2;
using sensor_msgs::PointField;

struct Format {
  std::vector<std::string> fields{"x", "y", "z"};
  bool is_double = false;
  bool big_endian = false;
  std::uint32_t first_offset = 0;
  std::uint32_t point_padding = 0;
  std::uint32_t row_padding = 0;
};

/// A cloud of `height` rows with points (i, 10 i, 100 i) + shift, written byte by byte.
PointCloud2 make_cloud(const Format& format, std::uint32_t width = 3, std::uint32_t height = 2,
                       double shift = 0) {
  PointCloud2 cloud;
  cloud.width = width;
  cloud.height = height;
  cloud.is_bigendian = format.big_endian ? 1 : 0;
  const std::uint32_t size = format.is_double ? 8 : 4;
  std::uint32_t offset = format.first_offset;
  for (const std::string& name : format.fields) {
    PointField field;
    field.name = name;
    field.offset = offset;
    field.datatype = format.is_double ? PointField::FLOAT64 : PointField::FLOAT32;
    field.count = 1;
    cloud.fields.push_back(field);
    offset += size;
  }
  cloud.point_step = offset + format.point_padding;
  cloud.row_step = width * cloud.point_step + format.row_padding;
  cloud.data.assign(std::size_t{cloud.row_step} * height, 0xAB);
  int i = 0;
  for (std::uint32_t row = 0; row < height; ++row) {
    for (std::uint32_t column = 0; column < width; ++column, ++i) {
      for (const PointField& field : cloud.fields) {
        const double factor = field.name == "x" ? 1 : field.name == "y" ? 10 : field.name == "z" ? 100 : 7;
        const double value = factor * i + shift;
        const auto single = static_cast<float>(value);
        std::array<std::uint8_t, 8> bytes{};
        std::memcpy(bytes.data(), format.is_double ? static_cast<const void*>(&value) : &single, size);
        if (format.big_endian) std::reverse(bytes.begin(), bytes.begin() + size);
        std::copy_n(bytes.begin(), size,
                    cloud.data.begin() + row * cloud.row_step + column * cloud.point_step + field.offset);
      }
    }
  }
  return cloud;
}

void expect_points(const PointCloud& cloud, double shift = 0) {
  ASSERT_EQ(cloud.size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) {
    const auto n = static_cast<double>(i);
    EXPECT_EQ(cloud.origin_x + static_cast<double>(cloud.x[i]), n + shift);
    EXPECT_EQ(cloud.origin_y + static_cast<double>(cloud.y[i]), 10 * n + shift);
    EXPECT_EQ(cloud.origin_z + static_cast<double>(cloud.z[i]), 100 * n + shift);
  }
}

std::string error_of(const PointCloud2& message) {
  try {
    to_point_cloud(message);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(CloudConversion, ReadsEveryFormat) {
  const std::vector<std::vector<std::string>> orders{{"x", "y", "z"}, {"intensity", "z", "ring", "y", "x"}};
  for (const auto& fields : orders)
    for (const bool is_double : {false, true})
      for (const bool big_endian : {false, true})
        for (const std::uint32_t padding : {0U, 5U})
          expect_points(
              to_point_cloud(make_cloud({fields, is_double, big_endian, padding, padding, 3 * padding})));
}

TEST(CloudConversion, ReadsLongRowsOfEveryStep) {
  for (const std::uint32_t padding : {0U, 4U, 20U}) {
    Format format;
    format.point_padding = padding;
    format.row_padding = 8;
    const PointCloud cloud = to_point_cloud(make_cloud(format, 1300, 3));
    ASSERT_EQ(cloud.size(), 3900U);
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const auto number = static_cast<double>(i);
      EXPECT_EQ(cloud.x[i], static_cast<float>(number));
      EXPECT_EQ(cloud.y[i], static_cast<float>(10 * number));
      EXPECT_EQ(cloud.z[i], static_cast<float>(100 * number));
    }
  }
}

TEST(CloudConversion, DoublesKeepMillimetresInUtm) {
  Format format;
  format.is_double = true;
  const double shift = 5403210.126;
  const PointCloud cloud = to_point_cloud(make_cloud(format, 3, 2, shift));
  EXPECT_GT(cloud.origin_y, 5e6);
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_NEAR(cloud.origin_x + static_cast<double>(cloud.x[i]), static_cast<double>(i) + shift, 1e-6);
}

TEST(CloudConversion, KeepsPointsThatAreNotFiniteInTheirPlace) {
  PointCloud2 message = make_cloud({});
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(&message.data[message.point_step], &nan, 4);
  const PointCloud cloud = to_point_cloud(message);
  ASSERT_EQ(cloud.size(), 6U);
  EXPECT_TRUE(std::isnan(cloud.x[1]));
  EXPECT_EQ(cloud.x[2], 2);
}

TEST(CloudConversion, AnEmptyCloudHasNoPoints) {
  EXPECT_EQ(to_point_cloud(make_cloud({}, 0, 0)).size(), 0U);
  EXPECT_EQ(to_point_cloud(make_cloud({}, 0, 1)).size(), 0U);
}

TEST(CloudConversion, NothingOfTheCloudWhoseMemoryIsReusedRemains) {
  Format far;
  far.is_double = true;
  PointCloud cloud = to_point_cloud(make_cloud(far, 1300, 3, 5403210.126));
  const float* const memory = cloud.x.data();
  cloud = to_point_cloud(make_cloud({}), std::move(cloud));
  expect_points(cloud);
  EXPECT_EQ(cloud.origin_x, 0);
  EXPECT_EQ(cloud.x.data(), memory);
}

TEST(CloudConversion, OneRowNeedsNoRowStep) {
  PointCloud2 message = make_cloud({}, 6, 1);
  message.row_step = 0;
  expect_points(to_point_cloud(message));
}

TEST(CloudConversion, NamesTheMissingField) {
  EXPECT_EQ(error_of(make_cloud({{"x", "y", "intensity"}})), "point cloud: there is no field 'z'");
  EXPECT_EQ(error_of(PointCloud2()), "point cloud: there is no field 'x'");
}

TEST(CloudConversion, RefusesWhatDoesNotFit) {
  PointCloud2 message = make_cloud({});
  message.fields[1].datatype = PointField::INT16;
  EXPECT_EQ(error_of(message), "point cloud: field 'y' has datatype 3, must be FLOAT32 (7) or FLOAT64 (8)");
  message = make_cloud({});
  message.fields[2].offset = 0xFFFFFFFF;
  EXPECT_NE(error_of(message).find("field 'z' at offset 4294967295"), std::string::npos) << error_of(message);
  message = make_cloud({});
  message.data.pop_back();
  EXPECT_EQ(error_of(message), "point cloud: data has 71 bytes, must have 72 (3 x 2 points of 12 bytes)");
  message = make_cloud({});
  message.row_step = 4;
  EXPECT_NE(error_of(message).find("row_step is 4, must be at least 36"), std::string::npos)
      << error_of(message);
  message = make_cloud({});
  message.width = message.height = 0xFFFFFFFF;
  message.row_step = 0xFFFFFFFF;
  EXPECT_NE(error_of(message), "");
}

}  // namespace
}  // namespace aeolian
