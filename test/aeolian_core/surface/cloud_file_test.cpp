#include "aeolian_core/surface/cloud_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "../../shared_data.hpp"
#include "../../temporary_folder.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/surface/geotiff.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

constexpr float nan = HeightMap::unknown;

double true_x(const PointCloud& c, std::size_t i) { return c.origin_x + static_cast<double>(c.x[i]); }
double true_y(const PointCloud& c, std::size_t i) { return c.origin_y + static_cast<double>(c.y[i]); }
double true_z(const PointCloud& c, std::size_t i) { return c.origin_z + static_cast<double>(c.z[i]); }

/// A plot of 10 m at UTM coordinates.
PointCloud utm_cloud() {
  PointCloud cloud;
  cloud.origin_x = 512345;
  cloud.origin_y = 5401234;
  cloud.origin_z = 312;
  RandomStream random(3, 0);
  const auto coordinate = [&] { return static_cast<float>(10 * random.uniform()); };
  for (int i = 0; i < 500; ++i) cloud.push_back(coordinate(), coordinate(), coordinate());
  return cloud;
}

/// A binary PCD of floats, as PCL's own programs write it.
std::string float_pcd(int width, int height, const std::vector<float>& numbers) {
  const std::string w = std::to_string(width);
  const std::string h = std::to_string(height);
  std::string text =
      "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\n";
  text += "COUNT 1 1 1\nWIDTH " + w + "\nHEIGHT " + h + "\nVIEWPOINT 0 0 0 1 0 0 0\n";
  text += "POINTS " + std::to_string(width * height) + "\nDATA binary\n";
  text.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(float));
  return text;
}

class CloudFile : public testing::Test {
 protected:
  PointCloud read(const std::string& name, const std::string& content) const {
    return read_cloud(folder_.write(name, content));
  }
  /// The error of reading a file; checks that nothing else was printed.
  std::string error(const std::string& name, const std::string& content) const {
    const std::string path = folder_.write(name, content);
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
    const std::string message = error_of([&] { read_cloud(path); });
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_NE(message.find("cloud '" + path + "'"), std::string::npos) << message;
    return message;
  }
  TemporaryFolder folder_;
};

TEST_F(CloudFile, EveryFormatGivesBackUtmCoordinatesToAMicrometre) {
  const PointCloud cloud = utm_cloud();
  for (const char* name : {"a.pcd", "a.ply", "a.xyz", "a.csv", "a.txt", "a.PCD", "a.Csv"}) {
    SCOPED_TRACE(name);
    write_cloud(cloud, folder_.file(name));
    const PointCloud back = read_cloud(folder_.file(name));
    ASSERT_EQ(back.size(), cloud.size());
    // The float about the new origin, at most 20 m away, adds half a unit in its last place: 1e-6 m.
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      EXPECT_NEAR(true_x(back, i), true_x(cloud, i), 1e-6);
      EXPECT_NEAR(true_y(back, i), true_y(cloud, i), 1e-6);
      EXPECT_NEAR(true_z(back, i), true_z(cloud, i), 1e-6);
    }
  }
}

TEST_F(CloudFile, SmallCoordinatesKeepAZeroOrigin) {
  const PointCloud cloud = read("a.xyz", "1 2 3\n999 -999 0\n");
  EXPECT_EQ(cloud.origin_x, 0);
  EXPECT_EQ(cloud.origin_y, 0);
  EXPECT_EQ(cloud.origin_z, 0);
  EXPECT_EQ(cloud.y[1], -999);
}

TEST_F(CloudFile, LargeCoordinatesAreTakenAboutTheFirstPointInWholeMetres) {
  const PointCloud cloud = read("a.xyz", "nan 1 1\n10.6 5.2 -3.4\n1000.25 0 0\n");
  EXPECT_EQ(cloud.origin_x, 11);
  EXPECT_EQ(cloud.origin_y, 5);
  EXPECT_EQ(cloud.origin_z, -3);
  EXPECT_FLOAT_EQ(cloud.x[2], 989.25F);
}

TEST_F(CloudFile, AFloatFileAtUtmCoordinatesLosesNoMoreThanItAlreadyHas) {
  const float x = 512345.678F;   // kept as 512345.6875
  const float y = 5401234.567F;  // kept as 5401234.5
  const PointCloud cloud = read("a.pcd", float_pcd(2, 1, {x, y, 312.5F, x + 1, y + 1, 313.25F}));
  EXPECT_EQ(true_x(cloud, 0), static_cast<double>(x));
  EXPECT_EQ(true_y(cloud, 0), static_cast<double>(y));
  EXPECT_EQ(true_x(cloud, 1), static_cast<double>(x + 1));
  EXPECT_EQ(true_z(cloud, 1), 313.25);
}

TEST_F(CloudFile, AnOrganisedCloudKeepsItsOrderAndItsHoles) {
  const PointCloud cloud = read("a.pcd", float_pcd(2, 2, {1, 2, 3, nan, nan, nan, 4, 5, INFINITY, 7, 8, 9}));
  ASSERT_EQ(cloud.size(), 4U);
  EXPECT_EQ(cloud.x[0], 1);
  EXPECT_TRUE(std::isnan(cloud.x[1]) && std::isnan(cloud.y[1]) && std::isnan(cloud.z[1]));
  EXPECT_TRUE(std::isnan(cloud.x[2]) && std::isnan(cloud.z[2])) << "infinite is unknown too";
  EXPECT_EQ(cloud.z[3], 9);
}

TEST_F(CloudFile, ReadsAsciiPcdWithMoreFields) {
  const PointCloud cloud = read("a.pcd",
                                "VERSION .7\nFIELDS rgb hist z x y\nSIZE 4 4 8 8 8\nTYPE F F F F F\n"
                                "COUNT 1 2 1 1 1\nWIDTH 2\nHEIGHT 1\nPOINTS 2\nDATA ascii\n"
                                "0 7 7 300.5 512345.125 5401234.0625\n0 7 7 nan nan nan\n");
  ASSERT_EQ(cloud.size(), 2U);
  EXPECT_EQ(true_x(cloud, 0), 512345.125);
  EXPECT_EQ(true_y(cloud, 0), 5401234.0625);
  EXPECT_EQ(true_z(cloud, 0), 300.5);
  EXPECT_TRUE(std::isnan(cloud.z[1]));
}

TEST_F(CloudFile, ReadsPlyWithDoublesColoursAndFaces) {
  const PointCloud cloud =
      read("a.ply",
           "ply\nformat ascii 1.0\nelement vertex 2\nproperty double x\nproperty double y\n"
           "property float z\nproperty uchar red\nelement face 1\n"
           "property list uchar int vertex_indices\nend_header\n"
           "512345.125 5401234.375 3 7\n512346 5401234.5 6 8\n3 0 1 0\n");
  ASSERT_EQ(cloud.size(), 2U);
  EXPECT_EQ(true_x(cloud, 0), 512345.125);
  EXPECT_EQ(true_y(cloud, 0), 5401234.375);
  EXPECT_EQ(true_z(cloud, 1), 6);
}

TEST_F(CloudFile, ReadsTextWithAnyUsualSeparator) {
  for (const char* text : {"1 2 3\n", "1,2,3\n", "1;2;3\r\n", "\t1\t2\t3\n", "  1 , 2 ;  3  \n",
                           "1 2 3 255 0 0 note", "# scan\n\n// more\n+1 2.0 3e0\n"}) {
    const PointCloud cloud = read("a.txt", text);
    ASSERT_EQ(cloud.size(), 1U) << text;
    EXPECT_EQ(cloud.x[0], 1) << text;
    EXPECT_EQ(cloud.y[0], 2) << text;
    EXPECT_EQ(cloud.z[0], 3) << text;
  }
}

TEST_F(CloudFile, AHeaderLinePicksTheColumns) {
  for (const char* header : {"id,z,Y,X", "# id z y x", "//ID Z Y X", "id;\"z\";\"y\";\"x\"",
                             "id,elevation,y_m,x_m", "id height northing easting"}) {
    const PointCloud cloud = read("a.csv", std::string(header) + "\n77,3,2,1\n");
    ASSERT_EQ(cloud.size(), 1U) << header;
    EXPECT_EQ(cloud.x[0], 1) << header;
    EXPECT_EQ(cloud.y[0], 2) << header;
    EXPECT_EQ(cloud.z[0], 3) << header;
  }
}

TEST_F(CloudFile, AnEmptyFieldIsUnknown) {
  const PointCloud cloud = read("a.csv", "x,y,z\n1,,3\n,,\n1,2,3\n");
  ASSERT_EQ(cloud.size(), 3U);
  EXPECT_TRUE(std::isnan(cloud.y[0]));
  EXPECT_TRUE(std::isnan(cloud.z[1]));
}

TEST_F(CloudFile, ReadsBackTheTableOfAMap) {
  const PointCloud cloud = read("a.csv", "x_m,y_m,elevation,age\n0.5,1.5,2.5,60\n");
  EXPECT_EQ(cloud.z[0], 2.5F);
}

TEST_F(CloudFile, AMalformedLineIsNamed) {
  EXPECT_NE(error("a.xyz", "1 2 3\n\n1 two 3\n").find(", line 3: 'two' is not a number"), std::string::npos);
  EXPECT_NE(error("a.xyz", "1 2 3\n1 2\n").find(", line 2: has 2 fields, must have at least 3"),
            std::string::npos);
  EXPECT_NE(error("a.csv", "x,y,z\n1,2,3m\n").find(", line 2: '3m' is not a number"), std::string::npos);
  EXPECT_NE(error("a.csv", "a,b,c\n1,2,3\n").find(", line 1: 'a' is not a number"), std::string::npos);
  const std::string header =
      "VERSION .7\nFIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\nHEIGHT 1\n";
  EXPECT_NE(error("a.pcd", header + "POINTS 2\nDATA ascii\n1 2 3\n1 2 x\n").find(", line 11: 'x'"),
            std::string::npos);
}

TEST_F(CloudFile, TheFieldsXyzAreNeeded) {
  EXPECT_NE(error("a.pcd",
                  "VERSION .7\nFIELDS x y\nSIZE 4 4\nTYPE F F\nCOUNT 1 1\nWIDTH 1\nHEIGHT 1\nPOINTS 1\n"
                  "DATA ascii\n1 2\n")
                .find("no field z"),
            std::string::npos);
  EXPECT_NE(error("a.ply",
                  "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float z\n"
                  "end_header\n1 2\n")
                .find("no field y"),
            std::string::npos);
}

TEST_F(CloudFile, ACloudWithoutAFinitePointIsRefused) {
  EXPECT_NE(error("a.pcd", float_pcd(2, 1, {nan, nan, nan, nan, nan, nan})).find("no finite point among 2"),
            std::string::npos);
  EXPECT_NE(error("a.xyz", "nan nan nan\n").find("no finite point among 1"), std::string::npos);
  EXPECT_NE(error("a.csv", "").find("no finite point among 0"), std::string::npos);
}

TEST_F(CloudFile, DamagedFilesAreRefusedInOneLine) {
  write_cloud(utm_cloud(), folder_.file("whole.pcd"));
  write_cloud(utm_cloud(), folder_.file("whole.ply"));
  const std::string pcd = content_of(folder_.file("whole.pcd"));
  const std::string ply = content_of(folder_.file("whole.ply"));
  std::string noise(5000, ' ');
  RandomStream random(1, 1);
  for (char& c : noise) c = static_cast<char>(random.bits());
  error("half.pcd", pcd.substr(0, pcd.size() / 2));
  error("half.ply", ply.substr(0, ply.size() / 2));
  error("header.pcd", pcd.substr(0, 60));
  error("noise.pcd", noise);
  error("noise.ply", noise);
  error("empty.pcd", "");
  error("empty.ply", "");
  error("fewer.pcd",
        "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\nHEIGHT 1\nPOINTS 2\n"
        "DATA ascii\n1 2 3\n");
}

TEST_F(CloudFile, OtherFormatsAreNamed) {
  EXPECT_NE(error("a.las", "LASF").find("convert it to XYZ"), std::string::npos);
  EXPECT_NE(error("a.LAZ", "LASF").find("convert it to XYZ"), std::string::npos);
  EXPECT_NE(error("a.obj", "").find("format is 'obj', must be pcd"), std::string::npos);
  EXPECT_NE(error("cloud", "").find("format is ''"), std::string::npos);
  EXPECT_NE(error_of([&] { read_cloud(folder_.file("none.pcd")); }).find("there is no such file"),
            std::string::npos);
}

TEST_F(CloudFile, AGeoTiffGivesAPointForEachKnownCell) {
  HeightMap map(GridGeometry(512345, 5401234, 0.5, 3, 2));
  map.add(layer::elevation, HeightMap::Layer{1, 2, nan, 4, 5, 6});
  write_geotiff(map, folder_.file("map.tif"), "EPSG:32632");
  const PointCloud cloud = read_cloud(folder_.file("map.tif"));
  ASSERT_EQ(cloud.size(), 5U);
  EXPECT_EQ(true_x(cloud, 0), 512345.25);
  EXPECT_EQ(true_y(cloud, 4), 5401234.75);
  EXPECT_EQ(true_z(cloud, 4), 6);
}

TEST_F(CloudFile, WritesFinitePointsOnlyAndAllOrNothing) {
  PointCloud cloud = utm_cloud();
  cloud.y[3] = nan;
  cloud.z[9] = INFINITY;
  for (const char* name : {"a.pcd", "a.ply", "a.xyz"}) {
    const std::string path = folder_.write(name, "old");
    write_cloud(cloud, path);
    EXPECT_EQ(read_cloud(path).size(), cloud.size() - 2) << name;
    const std::string message = error_of([&] { write_cloud(cloud, path + "/" + name); });
    EXPECT_NE(message.find("Not a directory"), std::string::npos) << message;
  }
  EXPECT_EQ(folder_.count_files(), 3U);
  EXPECT_NE(error_of([&] { write_cloud(cloud, folder_.file("a.tif")); }).find("must be pcd"),
            std::string::npos);
  const std::string old = folder_.write("old.pcd", "old");
  EXPECT_NE(error_of([&] { write_cloud({}, old); }).find("no finite point"), std::string::npos);
  EXPECT_EQ(content_of(old), "old");
}

TEST(RealScans, AirborneLidarInUtmCoordinates) {
  const std::filesystem::path scan = shared_data() / "lidar-terrain/samp53-utm.pcd";
  if (!std::filesystem::exists(scan)) GTEST_SKIP() << "there is no " << scan;
  const PointCloud cloud = read_cloud(scan.string());
  const auto wide = [](const std::vector<float>& v) {
    const auto [low, high] = std::minmax_element(v.begin(), v.end());
    return *high - *low;
  };
  EXPECT_EQ(cloud.size(), 34378U);  // POINTS in the file's header, as published
  EXPECT_GT(cloud.origin_y, 5.3e6);
  EXPECT_LT(cloud.origin_y, 5.5e6);
  EXPECT_LT(std::max(wide(cloud.x), wide(cloud.y)), 1000);
  for (std::size_t i = 0; i < cloud.size(); ++i)
    ASSERT_EQ(true_y(cloud, i), std::round(true_y(cloud, i) * 2) / 2) << "floats at this northing are halves";
}

}  // namespace
}  // namespace aeolian
