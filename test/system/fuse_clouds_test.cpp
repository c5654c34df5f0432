/// fuse_clouds as a program, on clouds of our own and on real scans that are not ours.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "../shared_data.hpp"
#include "../temporary_folder.hpp"
#include "program_outcome.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/surface/cloud_file.hpp"
#include "aeolian_core/surface/geotiff.hpp"
#include "aeolian_core/surface/median.hpp"

namespace aeolian {
namespace {

const std::string sensors = AEOLIAN_REPOSITORY "/config/sensors/";

class FuseClouds : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_.file(name); }

  /// Exit code; what it printed is in `text`.
  static int run(const std::string& arguments, std::string& text) {
    const Outcome outcome = run_program("fuse_clouds " + arguments);
    text = outcome.out + outcome.err;
    return outcome.code;
  }
  HeightMap fuse(const std::string& arguments) const {
    std::string text;
    EXPECT_EQ(run(arguments + " --out " + path("map.tif"), text), 0) << text;
    return read_geotiff(path("map.tif"));
  }
  void expect_refused(const std::string& arguments, const std::string& reason) const {
    std::string text;
    EXPECT_EQ(run(arguments, text), 1) << text;
    EXPECT_NE(text.find(reason), std::string::npos) << text;
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
  }
  std::string write(const std::string& name, const std::string& content) const {
    return folder_.write(name, content);
  }

  TemporaryFolder folder_;
};

TEST_F(FuseClouds, WritesHeightVarianceAndCount) {
  // Beyond 1000 m the cloud is georeferenced: every height has the standard deviation of 0.15 m.
  const std::string a =
      write("a.xyz", "500000.5 5000000.5 10.0\n500000.6 5000000.4 10.2\n500001.5 5000000.5 11.0\n");
  const std::string b = write("b.xyz", "500000.4 5000000.5 10.4\n500001.5 5000001.5 12.0\n");
  const std::string airborne = " --cell 1 --sensor " + sensors + "airborne_lidar.yaml";
  const HeightMap map = fuse(a + " " + b + airborne);
  EXPECT_EQ(map.names(), (std::vector<std::string>{"elevation", "variance", "count"}));
  EXPECT_EQ(map.geometry(), GridGeometry(500000, 5000000, 1, 2, 2));
  EXPECT_NEAR(map.layer("elevation")[0], 10.2, 2e-5);
  EXPECT_NEAR(map.layer("variance")[0], 0.15 * 0.15 / 3, 1e-6);
  EXPECT_EQ(map.layer("count")[0], 3);
  EXPECT_EQ(map.layer("count")[1], 1);
  EXPECT_TRUE(std::isnan(map.layer("count")[2]));
  EXPECT_EQ(map.layer("elevation")[3], 12);

  const HeightMap turned = fuse(b + " " + a + airborne);
  EXPECT_EQ(turned.layer("elevation")[0], map.layer("elevation")[0]);

  const HeightMap part = fuse(a + " --bounds 500001,5000000,500002,5000001" + airborne);
  EXPECT_EQ(part.geometry(), GridGeometry(500001, 5000000, 1, 1, 1));
  EXPECT_EQ(part.layer("elevation")[0], 11);
}

/// Ripples that wind, as a cloud with an offset; with another offset of the places where they are seen.
std::string rippled_bed(double shift_x, double shift_z, double phase) {
  std::string points;
  for (int iy = 0; iy < 100; ++iy)
    for (int ix = 0; ix < 100; ++ix) {
      const double x = 0.005 * (ix + phase);
      const double y = 0.005 * (iy + phase);
      const double z = 0.006 * std::sin(62.8 * x + 2 * std::sin(25 * y));
      points +=
          std::to_string(x + shift_x) + ' ' + std::to_string(y) + ' ' + std::to_string(z + shift_z) + '\n';
    }
  return points;
}

TEST_F(FuseClouds, RegistersEachCloudOntoTheMapOfThoseBefore) {
  const std::string a = write("a.xyz", rippled_bed(0, 0, 0.5));
  const std::string b = write("b.xyz", rippled_bed(0.006, 0.004, 0.7));
  const std::string far = write("far.xyz", rippled_bed(0, 0.3, 0.5));
  std::string text;
  const std::string common = " --cell 0.005 --out " + path("map.tif") + " --bounds 0,0,0.5,0.5";
  const auto error = [&] {
    const HeightMap map = read_geotiff(path("map.tif"));
    std::vector<double> errors;
    for (std::size_t i = 0; i < map.geometry().size(); ++i) {
      const CellIndex c = map.geometry().cell_at(i);
      const double truth =
          0.006 * std::sin(62.8 * map.geometry().x(c.x) + 2 * std::sin(25 * map.geometry().y(c.y)));
      const double height = static_cast<double>(map.layer("elevation")[i]);
      if (std::isfinite(height)) errors.push_back(std::abs(height - truth));
    }
    return median(errors);
  };
  ASSERT_EQ(run(a + " " + b + common, text), 0) << text;
  EXPECT_GT(error(), 0.0015);
  for (const std::string method : {"icp", "ndt"}) {
    ASSERT_EQ(run(a + " " + b + common + " --register " + method, text), 0) << text;
    EXPECT_NE(text.find("b.xyz: moved by up to 0.007"), std::string::npos) << text;
    EXPECT_NE(text.find("6 of 6 directions held"), std::string::npos) << text;
    EXPECT_LT(error(), 0.0006) << method;
  }
  ASSERT_EQ(run(a + " " + b + common + " --register icp --max-shift 0.005", text), 0) << text;
  EXPECT_NE(text.find("b.xyz: fused as it is: would move a point of the cloud by 0.007"), std::string::npos)
      << text;
  EXPECT_GT(error(), 0.0015);
  ASSERT_EQ(run(a + " " + far + common + " --register icp", text), 0) << text;
  EXPECT_NE(text.find("far.xyz: fused as it is: 0 points of the cloud lie within"), std::string::npos)
      << text;
}

TEST_F(FuseClouds, RobustTakesTheLowerSurface) {
  std::string points;
  for (int i = 0; i < 10; ++i) points += "5000.5 0.5 " + std::to_string(0.001 * i) + "\n";
  points += "5000.5 0.5 2.5\n5000.5 0.5 2.6\n5000.5 0.5 4\n";
  const std::string cloud = write("a.xyz", points);
  EXPECT_NEAR(fuse(cloud + " --cell 1 --robust").layer("elevation")[0], 0.0045, 2e-5);
  EXPECT_NEAR(fuse(cloud + " --cell 1").layer("elevation")[0], (0.045 + 9.1) / 13, 2e-5);
}

TEST_F(FuseClouds, RefusesBadInputInOneLine) {
  const std::string cloud = write("a.xyz", "0 0 1\n1 1 1\n");
  const std::string out = " --out " + path("map.tif");
  expect_refused(path("missing.pcd") + out, "missing.pcd");
  expect_refused(cloud + out + " --bounds 1,1,0,0", "--bounds");
  expect_refused(cloud + out + " --bounds 10,10,11,11", "none of 2 points can be used");
  expect_refused(cloud + out + " --cell 1e-6", "cells");
  const std::string sensor = write("sensor.yaml", "name: x\nrange_sigma_m: -1\n");
  expect_refused(cloud + out + " --sensor " + sensor, "range_sigma_m is '-1', must be positive");
  EXPECT_FALSE(std::filesystem::exists(path("map.tif")));
}

TEST_F(FuseClouds, EverySensorOfTheConfigurationIsRead) {
  const std::string cloud = write("a.xyz", "0.1 0.1 -2\n0.2 0.2 -2\n");
  std::size_t count = 0;
  for (const auto& file : std::filesystem::directory_iterator(sensors)) {
    const HeightMap map = fuse(cloud + " --cell 1 --sensor " + file.path().string());
    EXPECT_NEAR(map.layer("elevation")[0], -2, 1e-5) << file.path();
    ++count;
  }
  EXPECT_GE(count, 6U);
}

class AirborneScan : public FuseClouds, public testing::WithParamInterface<const char*> {};
INSTANTIATE_TEST_SUITE_P(Scenes, AirborneScan, testing::Values("samp11", "samp22", "samp31", "samp53"));

// The lower surface of all returns against the map of the points labelled ground by hand.
TEST_P(AirborneScan, RobustModeFindsTheGround) {
  if (!std::filesystem::exists(shared_data())) GTEST_SKIP() << "no " << shared_data();
  const std::string base = std::filesystem::absolute(shared_data() / "lidar-terrain" / GetParam()).string();
  const std::string options = " --cell 1 --robust --sensor " + sensors + "airborne_lidar.yaml";
  const HeightMap all = fuse(base + "-utm.pcd" + options);
  const GridGeometry& g = all.geometry();
  const HeightMap ground =
      fuse(base + "-utm-ground.pcd" + options + " --bounds " + std::to_string(g.origin_x()) + "," +
           std::to_string(g.origin_y()) + "," + std::to_string(g.origin_x() + g.length_x()) + "," +
           std::to_string(g.origin_y() + g.length_y()));
  ASSERT_EQ(ground.geometry(), g);
  std::vector<double> differences;
  double near = 0;
  for (std::size_t i = 0; i < g.size(); ++i) {
    if (!std::isfinite(ground.layer("elevation")[i])) continue;
    const double d =
        static_cast<double>(all.layer("elevation")[i]) - static_cast<double>(ground.layer("elevation")[i]);
    differences.push_back(d);
    near += std::abs(d) <= 0.5 ? 1 : 0;
  }
  ASSERT_GT(differences.size(), 5000U);
  const double middle = median(differences);
  for (double& d : differences) d = std::abs(d - middle);
  const double nmad = sigma_per_median * median(differences);
  const double share = near / static_cast<double>(differences.size());
  RecordProperty("nmad_m", std::to_string(nmad));
  RecordProperty("share_within_half_a_metre", std::to_string(share));
  EXPECT_LT(nmad, 0.15);
  EXPECT_GT(share, 0.9);
}

}  // namespace
}  // namespace aeolian
