/// surface_display as a program: what it draws of whole maps and parts, and when it draws nothing.
#include <cmath>

#include "ros_test.hpp"
#include <grid_map_msgs/GridMap.h>
#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/point_cloud2_iterator.h>
#include <visualization_msgs/Marker.h>
#include <visualization_msgs/MarkerArray.h>

#include "aeolian_core/surface/submap.hpp"
#include "aeolian_twin/nodes/conversions.hpp"

namespace aeolian {
namespace {

using sensor_msgs::PointCloud2;

const GridGeometry grid(0, 0, 0.01, 100, 70);

HeightMap slope(float raised = 0) {
  HeightMap map(grid);
  HeightMap::Layer& elevation = map.add(layer::elevation);
  for (std::size_t i = 0; i < elevation.size(); ++i)
    elevation[i] = raised + 0.001F * static_cast<float>(grid.cell_at(i).x);
  return map;
}

class SurfaceDisplayTest : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(wait_until([&] {
      return whole_.getNumSubscribers() == 2 && updates_.getNumSubscribers() == 2;
    })) << "both displays listen";
  }

  void send(const ros::Publisher& publisher, const HeightMap& map, double stamp) {
    std_msgs::Header header;
    header.frame_id = "map";
    header.stamp = ros::Time(stamp);
    publisher.publish(to_message(map, header));
  }
  static float z_of(const PointCloud2& cloud, int x, int y) {
    sensor_msgs::PointCloud2ConstIterator<float> z(cloud, "z");
    z += static_cast<int>(grid.index(x, y));
    return *z;
  }

  ros::NodeHandle nh_;
  ros::Publisher whole_ = nh_.advertise<grid_map_msgs::GridMap>("map", 10);
  ros::Publisher wind_ = nh_.advertise<grid_map_msgs::GridMap>("wind_field", 10);
  ros::Publisher updates_ = nh_.advertise<grid_map_msgs::GridMap>("map_updates", 100);
};

TEST_F(SurfaceDisplayTest, OneWhoStartsToLookGetsTheLastPictureAndThenWhatChanges) {
  send(whole_, slope(), 1);
  send(updates_, submap(slope(0.5F), {0, 32, 0, 32}), 2);
  wait_until([] { return false; }, 0.5);

  Listener<PointCloud2> clouds(nh_, "cloud");
  Listener<visualization_msgs::MarkerArray> meshes(nh_, "mesh");
  ASSERT_TRUE(wait_until([&] { return clouds.messages.size() == 1 && meshes.messages.size() == 1; }))
      << clouds.messages.size() << " clouds, " << meshes.messages.size() << " meshes";
  EXPECT_EQ(clouds.messages[0]->header.stamp, ros::Time(2));
  EXPECT_EQ(clouds.messages[0]->width, grid.size());
  EXPECT_GT(z_of(*clouds.messages[0], 31, 31), 0.5F);
  EXPECT_LT(z_of(*clouds.messages[0], 32, 31), 0.5F);
  ASSERT_EQ(meshes.messages[0]->markers.size(), 6U) << "surface, title, bar, three values";
  EXPECT_EQ(meshes.messages[0]->markers[1].text, "Measured");

  send(whole_, slope(0.5F), 3);
  ASSERT_TRUE(wait_until([&] { return clouds.messages.size() == 2 && meshes.messages.size() == 2; }));
  EXPECT_GT(z_of(*clouds.messages[1], 99, 69), 0.5F);
  for (double stamp = 4; stamp < 7; ++stamp) {
    send(whole_, slope(0.5F), stamp);
    send(updates_, submap(slope(0.5F), {0, 32, 0, 32}), stamp);
  }
  EXPECT_FALSE(wait_until([&] { return clouds.messages.size() > 2 || meshes.messages.size() > 2; }, 0.5))
      << "nothing has changed";
  for (const CellRange& range : {CellRange{0, 32, 0, 32}, CellRange{64, 96, 0, 32}, CellRange{0, 32, 32, 64}})
    send(updates_, submap(slope(0.25F), range), 8);
  ASSERT_TRUE(wait_until([&] { return clouds.messages.size() == 3 && meshes.messages.size() == 3; }));
  EXPECT_EQ(clouds.messages[2]->header.stamp, ros::Time(8));
  EXPECT_FALSE(wait_until([&] { return clouds.messages.size() > 3; }, 0.3)) << "one change, one picture";
  EXPECT_LT(z_of(*clouds.messages[2], 31, 63), 0.5F);
}

/// Ripples 10 cm long of some height, crests from south to north.
HeightMap ripples(double height) {
  HeightMap map(GridGeometry(0, 0, 0.005, 200, 100));
  HeightMap::Layer& elevation = map.add(layer::elevation);
  for (std::size_t i = 0; i < elevation.size(); ++i)
    elevation[i] = static_cast<float>(height / 2 * std::sin(2 * M_PI * map.geometry().cell_at(i).x / 20));
  return map;
}

TEST_F(SurfaceDisplayTest, FindsCrestsWhileSomebodyLooksAndTheMapChanges) {
  EXPECT_EQ(wind_.getNumSubscribers(), 0U) << "nobody looks at crests";
  Listener<visualization_msgs::MarkerArray> meshes(nh_, "mesh");
  ASSERT_TRUE(wait_until([&] { return meshes.connected(); }));
  send(whole_, ripples(0.01), 200);
  ASSERT_TRUE(wait_until([&] {
    return !meshes.messages.empty() && meshes.messages.back()->markers[0].points.size() == 6U * 199 * 99;
  }));
  {
    Listener<visualization_msgs::Marker> crests(nh_, "crests");
    ASSERT_TRUE(wait_until([&] { return crests.messages.size() == 1; }));
    EXPECT_EQ(crests.messages[0]->type, visualization_msgs::Marker::LINE_LIST);
    EXPECT_GT(crests.messages[0]->points.size(), 100U);
    EXPECT_TRUE(wait_until([&] { return wind_.getNumSubscribers() == 1; }));
    send(whole_, ripples(0.01), 201);
    EXPECT_FALSE(wait_until([&] { return crests.messages.size() > 1; }, 0.3)) << "nothing has changed";
    // Many changes, few drawings: the period is 0.2 s in this test.
    for (int i = 0; i < 20; ++i) send(whole_, ripples(0.011 + 1e-4 * i), 202 + i);
    ASSERT_TRUE(wait_until([&] { return crests.messages.size() > 1; }));
    wait_until([] { return false; }, 0.6);
    EXPECT_LE(crests.messages.size(), 6U);
    const double highest = crests.messages.back()->points[0].z;
    EXPECT_NEAR(highest, 3 * 0.0129, 3 * 0.0005) << "the last change is drawn";
    // Lines go to the left of the wind: northwards in a west wind, southwards in an east wind.
    const auto northwards = [&] {
      const auto& points = crests.messages.back()->points;
      return points[1].y - points[0].y;
    };
    EXPECT_GT(northwards(), 0);
    WindField wind;
    wind.friction_velocity = 0.4;
    wind.direction = M_PI;
    std_msgs::Header header;
    header.frame_id = "map";
    const std::size_t before = crests.messages.size();
    wind_.publish(to_message(wind, grid, header));
    ASSERT_TRUE(wait_until([&] { return crests.messages.size() > before; }));
    EXPECT_LT(northwards(), 0);
  }
  EXPECT_TRUE(wait_until([&] { return wind_.getNumSubscribers() == 0; }));
}

TEST_F(SurfaceDisplayTest, SaysWhichLayerIsMissing) {
  Diagnostics diagnostics(nh_);
  Listener<PointCloud2> clouds(nh_, "cloud");
  ASSERT_TRUE(wait_until([&] { return clouds.connected(); }));
  HeightMap map(grid);
  map.add("depth", 1);
  send(whole_, map, 100);
  EXPECT_TRUE(diagnostics.warns("surface_display", "'elevation'"));
  send(whole_, slope(), 101);
  EXPECT_TRUE(diagnostics.is_well("surface_display"));
}

TEST_F(SurfaceDisplayTest, TheTitleSaysThatNoValuesAreGiven) {
  Listener<visualization_msgs::MarkerArray> meshes(nh_, "spread/mesh");
  ASSERT_TRUE(wait_until([&] { return meshes.connected(); }));
  send(whole_, slope(), 300);
  ASSERT_TRUE(wait_until([&] { return !meshes.messages.empty(); }));
  const auto& markers = meshes.messages.back()->markers;
  EXPECT_EQ(markers[0].ns, "surface");
  EXPECT_EQ(markers[0].action, visualization_msgs::Marker::DELETE);
  EXPECT_EQ(markers[1].text, "Uncertainty: no layer 'spread'");
  EXPECT_TRUE(std::isfinite(markers[1].pose.position.z));

  HeightMap map = slope();
  HeightMap::Layer& spread = map.add("spread", 0.001F);
  spread.back() = 0.002F;
  send(whole_, map, 301);
  ASSERT_TRUE(wait_until([&] { return meshes.messages.back()->markers[1].text == "Uncertainty"; }));
  EXPECT_EQ(meshes.messages.back()->markers[0].action, visualization_msgs::Marker::ADD);
  EXPECT_FALSE(meshes.messages.back()->markers[0].points.empty());
}

TEST_F(SurfaceDisplayTest, ColoursAreThoseOfAnotherDisplayWhereWanted) {
  const ros::Publisher other = nh_.advertise<grid_map_msgs::GridMap>("follower/map", 10);
  Listener<visualization_msgs::MarkerArray> leaders(nh_, "mesh");
  Listener<visualization_msgs::MarkerArray> followers(nh_, "follower/mesh");
  ASSERT_TRUE(wait_until(
      [&] { return leaders.connected() && followers.connected() && other.getNumSubscribers() == 1; }));
  const auto values = [](const Listener<visualization_msgs::MarkerArray>& meshes) {
    std::vector<std::string> words;
    if (!meshes.messages.empty() && meshes.messages.back()->markers.size() == 6)
      for (std::size_t i = 3; i < 6; ++i) words.push_back(meshes.messages.back()->markers[i].text);
    return words;
  };
  send(other, ripples(0.02), 400);
  ASSERT_TRUE(wait_until([&] { return !values(followers).empty(); }));
  for (const double height : {0.01, 0.014}) {
    const auto before = values(leaders);
    send(whole_, ripples(height), 401 + height);
    ASSERT_TRUE(wait_until([&] { return !values(leaders).empty() && values(leaders) != before; }));
    EXPECT_TRUE(wait_until([&] { return values(followers) == values(leaders); }))
        << values(followers).back() << " is not " << values(leaders).back();
  }
}

}  // namespace
}  // namespace aeolian

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "surface_display_rostest");
  const ros::NodeHandle keeps_ros_alive;
  return RUN_ALL_TESTS();
}
