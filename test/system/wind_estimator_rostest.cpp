/// wind_estimator as a program: two anemometers over ridges whose wind theory knows, probes, refusals,
/// arrows.
#include <array>
#include <cmath>

#include "ros_test.hpp"
#include <aeolian_msgs/ProbeWind.h>
#include <aeolian_msgs/WindAtPoints.h>
#include <aeolian_msgs/WindStatistics.h>
#include <geometry_msgs/PoseArray.h>
#include <geometry_msgs/TransformStamped.h>
#include <geometry_msgs/TwistStamped.h>
#include <grid_map_msgs/GridMap.h>
#include <gtest/gtest.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <visualization_msgs/MarkerArray.h>

#include "aeolian_core/wind/log_law.hpp"
#include "aeolian_twin/nodes/conversions.hpp"

namespace aeolian {
namespace {

// Ridges of 20 m across the wind with k z0 = 1e-4, for which theory has numbers (Weng et al. 1991).
constexpr double wavelength = 20;
constexpr double k = 2 * M_PI / wavelength;
constexpr double roughness = 1e-4 / k;
constexpr double steepness = 0.05;  // a k
const GridGeometry grid(-100, -20, 0.5, 400, 80);

HeightMap ridges() {
  HeightMap map(grid);
  HeightMap::Layer& elevation = map.add(layer::elevation);
  for (std::size_t i = 0; i < elevation.size(); ++i)
    elevation[i] = static_cast<float>(steepness / k * std::cos(k * grid.x(grid.cell_at(i).x)));
  return map;
}

/// A slip face of 32 degrees, 3 m high, at x = 0.
HeightMap slip_face() {
  HeightMap map(grid);
  HeightMap::Layer& elevation = map.add(layer::elevation);
  for (std::size_t i = 0; i < elevation.size(); ++i) {
    const double x = grid.x(grid.cell_at(i).x);
    elevation[i] = static_cast<float>(x < -40 ? 0
                                      : x < 0 ? 1.5 * (1 - std::cos(M_PI * (x + 40) / 40))
                                              : std::max(0.0, 3 - x * std::tan(0.5585)));
  }
  return map;
}

class WindEstimatorTest : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(diagnostics_.is_up("wind_estimator"));
    ASSERT_TRUE(wait_until([&] {
      return wind_.getNumSubscribers() > 0 && maps_.getNumSubscribers() == 2 && fields_.connected() &&
             statistics_.connected() && at_probes_.connected() && probes_.getNumSubscribers() > 0;
    }));
  }

  void send_map(const HeightMap& map, double stamp) {
    std_msgs::Header header;
    header.frame_id = "map";
    header.stamp = ros::Time(stamp);
    maps_.publish(to_message(map, header));
    wait_until([] { return false; }, 0.5);  // it is on its way
  }
  void stand(const std::string& frame, double x, double z) {
    geometry_msgs::TransformStamped mast;
    mast.header.frame_id = "map";
    mast.header.stamp = ros::Time::now();
    mast.child_frame_id = frame;
    mast.transform.translation.x = x;
    mast.transform.translation.z = z;
    mast.transform.rotation.w = 1;
    tf_.sendTransform(mast);
    wait_until([] { return false; }, 0.5);
  }
  bool blow(double time, double east, const std::string& frame, double north = 0) {
    geometry_msgs::TwistStamped message;
    message.header.frame_id = frame;
    message.header.stamp = ros::Time(time);
    message.twist.linear.x = east;
    message.twist.linear.y = north;
    const std::size_t before = fields_.messages.size();
    wind_.publish(message);
    return wait_until([&] { return fields_.messages.size() > before; }, east > 5 ? 20 : 1);
  }
  aeolian_msgs::ProbeWind probe(const std::vector<std::array<double, 3>>& points, std::uint32_t samples = 0) {
    aeolian_msgs::ProbeWind service;
    for (const auto& [x, y, z] : points) {
      geometry_msgs::Point& point = service.request.points.emplace_back();
      point.x = x;
      point.y = y;
      point.z = z;
    }
    service.request.gust_samples = samples;
    service.request.gust_step = 0.1;
    service.request.seed = 7;
    EXPECT_TRUE(prober_.call(service));
    return service;
  }

  ros::NodeHandle nh_;
  tf2_ros::StaticTransformBroadcaster tf_;
  ros::Publisher wind_ = nh_.advertise<geometry_msgs::TwistStamped>("wind", 100);
  ros::Publisher maps_ = nh_.advertise<grid_map_msgs::GridMap>("height_map", 10);
  ros::Publisher probes_ = nh_.advertise<geometry_msgs::PoseArray>("probes", 10);
  Listener<grid_map_msgs::GridMap> fields_{nh_, "wind_field"};
  Listener<aeolian_msgs::WindStatistics> statistics_{nh_, "wind_statistics"};
  Listener<aeolian_msgs::WindAtPoints> at_probes_{nh_, "probe_wind"};
  ros::ServiceClient prober_ = nh_.serviceClient<aeolian_msgs::ProbeWind>("probe_wind");
  Diagnostics diagnostics_{nh_};
};

TEST_F(WindEstimatorTest, OverRidgesTheStressIsThatOfTheoryAndProbesTellTheAir) {
  EXPECT_EQ(probe({{0, 0, 5}}).response.message, "probes: there is no wind yet");
  send_map(ridges(), 10);
  stand("afar", 500, 10);  // beside the map: in the surroundings, whose ground is at zero
  ASSERT_TRUE(blow(10, 8, "afar"));
  const double level = friction_velocity(8, 10, roughness);
  const HeightMap cells = to_height_map(*fields_.messages.back());

  // tau'/tau0 = a k (A cos k x - B sin k x), A = 3.31, B = 1.60 at k z0 = 1e-4; the wind is in the middle of
  // its sector, the ridge in the middle of the map.
  double in_phase = 0;
  double ahead = 0;
  for (int x = 180; x < 220; ++x) {
    const double ratio = static_cast<double>(cells.layer("friction_velocity")[grid.index(x, 40)]) / level;
    in_phase += (ratio * ratio - 1) * std::cos(k * grid.x(x)) / 20;
    ahead -= (ratio * ratio - 1) * std::sin(k * grid.x(x)) / 20;
  }
  EXPECT_NEAR(in_phase / steepness, 3.31, 0.1 * 3.31);
  EXPECT_NEAR(ahead / steepness, 1.60, 0.1 * 1.60);
  ASSERT_TRUE(wait_until([&] { return !statistics_.messages.empty(); }));
  EXPECT_EQ(statistics_.messages.back()->model, "spectral");
  EXPECT_NEAR(statistics_.messages.back()->friction_velocity, level, 1e-6);
  EXPECT_EQ(statistics_.messages.back()->header.stamp, fields_.messages.back()->info.header.stamp);

  // The air follows the slope of the ground, less so with height as exp(-k z).
  const double crest = steepness / k;
  const auto at = probe({{-5, 0, 0.3}, {5, 0, 0.3}, {0, 0, crest + 2}, {0, 0, -3}}, 256).response;
  ASSERT_TRUE(at.success) << at.message;
  EXPECT_EQ(at.wind.model, "spectral");
  const double slope = steepness * std::exp(-k * 0.3);
  EXPECT_NEAR(at.wind.velocity[0].z / at.wind.velocity[0].x, slope, 0.1 * slope);
  EXPECT_NEAR(at.wind.velocity[1].z / at.wind.velocity[1].x, -slope, 0.1 * slope);
  EXPECT_TRUE(std::isnan(at.wind.velocity[3].x)) << "in the ground";
  ASSERT_EQ(at.gusts.size(), 4U);
  EXPECT_EQ(at.gusts[2].along.size(), 256U);
  EXPECT_TRUE(at.gusts[3].along.empty());
  EXPECT_FALSE(probe({{0, 0, 5}}, 3).response.success) << "too few samples for a spectrum";
  EXPECT_FALSE(probe({{0, 0, 5}, {0, 0, 6}}, 900000).response.success);

  // An anemometer on the crest that reads what the probe tells says the same as the one afar.
  stand("crest", 0, crest + 2);
  ASSERT_TRUE(blow(11, at.wind.velocity[2].x, "crest", at.wind.velocity[2].y));
  ASSERT_TRUE(wait_until([&] { return statistics_.messages.size() == 2; }));
  EXPECT_EQ(statistics_.messages.back()->anemometers.size(), 2U);
  EXPECT_NEAR(statistics_.messages.back()->friction_velocity, level, 0.01 * level);
  EXPECT_NEAR(statistics_.messages.back()->direction, 0, 0.01);

  // On the topic, again with each new wind.
  geometry_msgs::PoseArray points;
  points.header.frame_id = "crest";
  points.poses.resize(1);
  probes_.publish(points);
  ASSERT_TRUE(wait_until([&] { return at_probes_.messages.size() == 1; }));
  EXPECT_NEAR(at_probes_.messages[0]->points[0].z, crest + 2, 1e-9);
  EXPECT_NEAR(at_probes_.messages[0]->velocity[0].x, at.wind.velocity[2].x, 0.02 * at.wind.velocity[2].x);
  ASSERT_TRUE(blow(12, 8, "afar"));
  ASSERT_TRUE(wait_until([&] { return at_probes_.messages.size() == 2; }));
  points.header.frame_id = "nowhere";
  probes_.publish(points);
  EXPECT_TRUE(diagnostics_.warns("wind_estimator", "nowhere"));
}

TEST_F(WindEstimatorTest, InTheLeeItIsRefusedAndTheLastFieldStays) {
  send_map(slip_face(), 100);
  ASSERT_TRUE(blow(100, 8, "afar"));
  stand("lee", 7, 1);
  const std::size_t before = fields_.messages.size();
  EXPECT_FALSE(blow(110, 2, "lee"));
  EXPECT_TRUE(
      diagnostics_.warns("wind_estimator", "(lee): anemometer at (7, 0) m: it stands in the air that"));
  EXPECT_EQ(fields_.messages.size(), before);
  const auto at = probe({{7, 0, 0.5}, {-20, 0, 4}}).response;
  ASSERT_TRUE(at.success) << "the last good wind is still told of: " << at.message;
  EXPECT_TRUE(at.wind.separated[0]);
  EXPECT_FALSE(at.wind.separated[1]);
  EXPECT_EQ(at.wind.header.stamp, ros::Time(100));
  ASSERT_TRUE(blow(110.5, 8, "afar"));
  EXPECT_TRUE(diagnostics_.warns("wind_estimator", "; lee: anemometer at (7, 0) m"));
}

TEST_F(WindEstimatorTest, ArrowsAreDrawnOverTheMapWhileSomebodyLooks) {
  send_map(slip_face(), 200);
  Listener<visualization_msgs::MarkerArray> arrows(nh_, "wind_arrows");
  ASSERT_TRUE(wait_until([&] { return arrows.connected(); }));
  double time = 200;
  ASSERT_TRUE(wait_until([&] {
    blow(++time, 8, "afar");  // until the display listens
    return !arrows.messages.empty();
  }));
  const auto& markers = arrows.messages.back()->markers;
  ASSERT_EQ(markers.size(), 2U);
  for (const auto& marker : markers) EXPECT_GT(marker.points.size(), 200U) << marker.ns;
}

}  // namespace
}  // namespace aeolian

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "wind_estimator_rostest");
  const ros::NodeHandle keeps_ros_alive;
  return RUN_ALL_TESTS();
}
