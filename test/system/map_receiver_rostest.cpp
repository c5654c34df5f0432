/// Whole maps and parts of them through topics.
#include "ros_test.hpp"

#include "aeolian_core/surface/error.hpp"
#include "aeolian_twin/nodes/conversions.hpp"
#include "aeolian_twin/nodes/map_receiver.hpp"

namespace aeolian {
namespace {

const GridGeometry grid(0, 0, 0.01, 100, 70);  // 4 x 3 tiles

HeightMap flat(float height) {
  HeightMap map(grid);
  map.add(layer::elevation, height);
  return map;
}

class MapReceiverTest : public ::testing::Test {
 protected:
  struct Told {
    HeightMap map;
    std_msgs::Header header;
    TileMask changed;
  };

  void SetUp() override {
    ASSERT_TRUE(
        wait_until([&] { return whole_.getNumSubscribers() > 0 && updates_.getNumSubscribers() > 0; }));
  }

  static grid_map_msgs::GridMap message(const HeightMap& map, double stamp,
                                        const std::string& frame = "map") {
    std_msgs::Header header;
    header.frame_id = frame;
    header.stamp = ros::Time(stamp);
    return to_message(map, header);
  }
  bool tells(std::size_t times) {
    return wait_until([&] { return told_.size() >= times; });
  }
  bool refuses(const std::string& text) {
    return wait_until([&] { return refused_.find(text) != std::string::npos; });
  }

  std::vector<Told> told_;
  std::string refused_;
  ros::NodeHandle nh_;
  ros::Publisher whole_ = nh_.advertise<grid_map_msgs::GridMap>("map", 10);
  ros::Publisher updates_ = nh_.advertise<grid_map_msgs::GridMap>("map_updates", 100);
  MapReceiver receiver_{
      nh_, "map",
      [this](const HeightMap& map, const std_msgs::Header& header, const TileMask& changed) {
        told_.push_back({map, header, changed});
      },
      [this](const std::string& reason) { refused_ = reason; },
      [](const std::string& topic, const std_msgs::Header& header) {
        if (header.frame_id == "odom") throw Error(topic + ": not in odom");
      }};
};

TEST_F(MapReceiverTest, PartsOfOneStampAreOneChange) {
  whole_.publish(message(flat(0), 1));
  ASSERT_TRUE(tells(1));
  EXPECT_EQ(told_[0].changed.count(), 12);
  for (const CellRange& range : {CellRange{0, 32, 0, 32}, CellRange{64, 100, 32, 64}})
    updates_.publish(message(submap(flat(1), range), 2));
  updates_.publish(message(submap(flat(2), {32, 64, 0, 32}), 3.25));
  ASSERT_TRUE(tells(3));
  EXPECT_EQ(told_[1].header.stamp, ros::Time(2));
  EXPECT_EQ(told_[1].header.frame_id, "map");
  EXPECT_EQ(told_[1].changed.count(), 3);
  EXPECT_EQ(told_[1].map.layer(layer::elevation)[grid.index(99, 63)], 1);
  EXPECT_EQ(told_[1].map.layer(layer::elevation)[grid.index(40, 0)], 0);
  EXPECT_EQ(told_[2].header.stamp, ros::Time(3.25));
  EXPECT_EQ(told_[2].changed.count(), 1);
  EXPECT_TRUE(told_[2].changed.tile(1, 0));
  EXPECT_TRUE(refused_.empty()) << refused_;
}

TEST_F(MapReceiverTest, AWholeMapTellsWhatDiffersOrNothing) {
  whole_.publish(message(flat(0), 1));
  ASSERT_TRUE(tells(1));
  whole_.publish(message(flat(0), 2));
  ASSERT_TRUE(tells(2));
  EXPECT_TRUE(told_[1].changed.empty());
  EXPECT_EQ(told_[1].header.stamp, ros::Time(2));
  HeightMap raised = flat(0);
  raised.layer(layer::elevation)[grid.index(50, 50)] = 1;
  whole_.publish(message(raised, 3));
  ASSERT_TRUE(tells(3));
  EXPECT_EQ(told_[2].changed.count(), 1);
}

TEST_F(MapReceiverTest, APartBeforeTheWholeMapIsQuietlyKept) {
  updates_.publish(message(flat(7), 5));
  EXPECT_FALSE(wait_until([&] { return !told_.empty() || !refused_.empty(); }, 0.3)) << refused_;
  whole_.publish(message(flat(0), 4));
  ASSERT_TRUE(tells(1));
  EXPECT_EQ(told_[0].map.layer(layer::elevation), flat(7).layer(layer::elevation));
  EXPECT_EQ(told_[0].header.stamp, ros::Time(5));
}

TEST_F(MapReceiverTest, WhatIsNoMapOrNotAcceptedLeavesTheLast) {
  whole_.publish(message(flat(1), 1));
  ASSERT_TRUE(tells(1));
  whole_.publish(message(flat(2), 2, "odom"));
  EXPECT_TRUE(refuses("/map: not in odom"));
  grid_map_msgs::GridMap bad = message(flat(2), 3);
  bad.info.resolution = -1;
  updates_.publish(bad);
  EXPECT_TRUE(refuses("/map_updates: grid map: info.resolution is -1"));
  updates_.publish(message(submap(flat(2), {0, 32, 0, 32}), 4, "earth"));
  EXPECT_TRUE(refuses("/map_updates: frame is 'earth', must be 'map' as that of /map"));
  EXPECT_EQ(told_.size(), 1U);
  updates_.publish(message(submap(flat(1), {0, 32, 0, 32}), 5));
  ASSERT_TRUE(tells(2));
  EXPECT_EQ(told_[1].map.layer(layer::elevation), flat(1).layer(layer::elevation));
  EXPECT_TRUE(told_[1].changed.empty());
}

}  // namespace
}  // namespace aeolian

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "map_receiver_rostest");
  const ros::NodeHandle keeps_ros_alive;
  return RUN_ALL_TESTS();
}
