#include "aeolian_twin/nodes/live_map.hpp"

#include "../../error_of.hpp"
#include <gtest/gtest.h>

namespace aeolian {
namespace {

constexpr double sigma = 0.001;
const ros::Time noon(1700000000);

/// A scanner 1 m over the map's frame that looks down: x as in the map, y and z turned over.
Eigen::Isometry3d looking_down() {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation().z() = 1;
  pose.linear() = Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()).toRotationMatrix();
  return pose;
}

/// One point in the middle of each of 4 x 3 cells of 10 cm at a height.
PointCloud level_cloud(double height) {
  PointCloud cloud;
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 4; ++x)
      cloud.push_back(static_cast<float>(0.1 * x + 0.05), static_cast<float>(-0.1 * y - 0.05),
                      static_cast<float>(1 - height));
  return cloud;
}

class LiveMapTest : public testing::Test {
 protected:
  static LiveMap::Settings settings() {
    LiveMap::Settings result;
    result.fusion.sensor.range_sigma = sigma;
    result.fusion.change.rate_sigma = 0;
    result.geometry = GridGeometry(0, 0, 0.1, 4, 3);
    return result;
  }
  FusionResult scan(double height, const ros::Time& stamp) {
    return live_.fuse(level_cloud(height), looking_down(), stamp, settings().fusion.sensor);
  }
  float at(std::size_t cell, const std::string& name = layer::elevation) const {
    return live_.map().layer(name)[cell];
  }
  LiveMap live_{settings()};
};

TEST_F(LiveMapTest, ALoadedMapIsContinuedNotReset) {
  for (int i = 0; i < 3; ++i) scan(0.010, noon + ros::Duration(i));
  const StoredMap stored = live_.stored();
  LiveMap other(settings());
  other.load(stored);
  EXPECT_EQ(other.stamp(), noon + ros::Duration(2));
  EXPECT_EQ(other.map().layer(layer::elevation), live_.map().layer(layer::elevation));
  other.fuse(level_cloud(0.014), looking_down(), noon + ros::Duration(3), settings().fusion.sensor);
  scan(0.014, noon + ros::Duration(3));
  EXPECT_NEAR(other.map().layer(layer::elevation)[5], 0.011, 2e-5) << "the mean of four readings";
  for (const std::string& name : {layer::elevation, layer::variance})
    EXPECT_NEAR(other.map().layer(name)[5], at(5, name), 1e-5 * std::abs(at(5, name)))
        << "as if it had never been interrupted";
}

TEST_F(LiveMapTest, AMapWithoutAStampHoldsFromNowOn) {
  scan(0.010, noon);
  StoredMap foreign{HeightMap(GridGeometry(1, 1, 0.05, 7, 9)), "", {}};
  foreign.map.add(layer::elevation, 0.5F);
  live_.load(foreign);
  EXPECT_EQ(live_.stamp(), noon);
  EXPECT_EQ(live_.map().geometry(), foreign.map.geometry()) << "the grid is the file's";
  EXPECT_NEAR(at(0, layer::variance), sigma * sigma, 1e-9) << "as good as one point";
}

TEST_F(LiveMapTest, AMapThatDoesNotFitIsRefusedAndTheOldOneStays) {
  scan(0.010, noon);
  StoredMap other = live_.stored();
  other.frame = "odom";
  EXPECT_NE(error_of([&] { live_.load(other); }).find("frame is 'odom', must be 'map'"), std::string::npos);
  LiveMap::Settings small = settings();
  small.max_cells = 11;
  EXPECT_NE(error_of([&] { LiveMap map(small); }).find("more than ~max_cells = 11"), std::string::npos);
  small.geometry.reset();
  LiveMap map(small);
  EXPECT_NE(error_of([&] { map.load(live_.stored()); }).find("more than ~max_cells"), std::string::npos);
  EXPECT_FALSE(map.begun());
  EXPECT_NE(error_of([&] { map.stored(); }).find("no map yet"), std::string::npos);
  EXPECT_NEAR(at(0), 0.010, 1e-5);
}

TEST_F(LiveMapTest, ReplacesMaskedCellsFromAnotherGrid) {
  for (int i = 0; i < 10; ++i) scan(0.010, noon + ros::Duration(i));
  HeightMap patch(GridGeometry(0.1, 0.1, 0.05, 4, 2));  // over the cells (1, 1) and (2, 1)
  patch.add(layer::elevation, 0.030F);
  patch.add(layer::variance, 1e-8F);
  HeightMap::Layer& mask = patch.add("mask");
  for (int y = 0; y < 2; ++y)
    for (int x = 2; x < 4; ++x) mask[patch.geometry().index(x, y)] = 1;  // the second only
  EXPECT_EQ(live_.replace(patch, "map").count(), 1);
  EXPECT_NEAR(at(5), 0.010, 1e-5);
  EXPECT_NEAR(at(6), 0.030, 1e-5);
  EXPECT_NEAR(at(7), 0.010, 1e-5);

  // The replaced cell goes on from its new height and variance, the others from theirs.
  scan(0.0305, noon + ros::Duration(10));
  EXPECT_NEAR(at(6), 0.030005, 1e-5);

  patch.add(layer::elevation);
  live_.replace(patch, "map");
  EXPECT_TRUE(std::isnan(at(6))) << "an unknown cell of the patch makes the map's unknown";
  scan(0.020, noon + ros::Duration(11));
  EXPECT_NEAR(at(6), 0.020, 1e-5) << "and it begins anew";
  EXPECT_NE(error_of([&] { live_.replace(patch, "odom"); }).find("odom"), std::string::npos);
  patch.remove(layer::elevation);
  EXPECT_NE(error_of([&] { live_.replace(patch, "map"); }).find("no layer 'elevation'"), std::string::npos);
}

TEST_F(LiveMapTest, TimesThatAreOddKeepTheMap) {
  EXPECT_NE(error_of([&] { scan(0, ros::Time()); }).find("stamp is zero"), std::string::npos);
  EXPECT_TRUE(live_.stamp().isZero());
  scan(0.010, noon);
  scan(0.010, noon);
  scan(0.010, noon - ros::Duration(3));
  EXPECT_EQ(live_.stamp(), noon) << "a late cloud does not turn the map's time back";
  scan(0.010, noon + ros::Duration(1e6));
  EXPECT_EQ(live_.stamp(), noon + ros::Duration(1e6));
  scan(0.010, noon);
  EXPECT_EQ(live_.stamp(), noon) << "a bag that loops does";
  EXPECT_NEAR(at(0), 0.010, 1e-5);
  EXPECT_EQ(count_known(live_.map().layer(layer::elevation)), 12U);
}

TEST_F(LiveMapTest, CoversTheFirstCloudWhenNoGridIsGiven) {
  LiveMap::Settings open = settings();
  open.geometry.reset();
  open.cell_size = 0.1;
  LiveMap map(open);
  PointCloud nothing;
  nothing.push_back(NAN, 0, 0);
  EXPECT_NE(
      error_of([&] { map.fuse(nothing, looking_down(), noon, open.fusion.sensor); }).find("none of 1 points"),
      std::string::npos);
  EXPECT_FALSE(map.begun());
  map.fuse(level_cloud(0), looking_down(), noon, open.fusion.sensor);
  EXPECT_EQ(map.map().geometry(), GridGeometry(0, 0, 0.1, 4, 3));
}

}  // namespace
}  // namespace aeolian
