/// Nodes and replay give the same on the same bag, to the bit.
#include <map>

#include "../temporary_folder.hpp"
#include "field_bag.hpp"
#include "program_outcome.hpp"
#include "ros_test.hpp"
#include <aeolian_msgs/Comparison.h>
#include <grid_map_msgs/GridMap.h>
#include <gtest/gtest.h>
#include <rosbag/view.h>
#include <tf2_ros/static_transform_broadcaster.h>

namespace aeolian {
namespace {

/// A message as it goes over the wire.
template <class Message>
std::string bits(const Message& message) {
  std::string text(ros::serialization::serializationLength(message), '\0');
  ros::serialization::OStream stream(reinterpret_cast<std::uint8_t*>(text.data()),
                                     static_cast<std::uint32_t>(text.size()));
  ros::serialization::serialize(stream, message);
  return text;
}

std::string told(grid_map_msgs::GridMap message) {
  message.info.header.seq = 0;
  return bits(message);
}

std::string told(aeolian_msgs::Comparison message) {
  message.header.seq = 0;
  return bits(message);
}

template <class Message>
std::vector<std::string> told(const rosbag::Bag& bag, const std::string& topic) {
  std::vector<std::string> result;
  for (const rosbag::MessageInstance& m : rosbag::View(bag, rosbag::TopicQuery(topic)))
    result.push_back(told(*m.instantiate<Message>()));
  return result;
}

template <class Message>
std::vector<std::string> told(const Listener<Message>& listener) {
  std::vector<std::string> result;
  for (const auto& message : listener.messages) result.push_back(told(*message));
  return result;
}

TEST(ReplayAndNodes, GiveTheSame) {
  ros::NodeHandle nh;
  tf2_ros::StaticTransformBroadcaster tf;
  ros::Publisher winds = nh.advertise<geometry_msgs::TwistStamped>("wind", 10);
  ros::Publisher clouds = nh.advertise<sensor_msgs::PointCloud2>("points", 10);
  const Listener<grid_map_msgs::GridMap> maps(nh, "height_map");
  const Listener<grid_map_msgs::GridMap> fields(nh, "wind_field");
  const Listener<grid_map_msgs::GridMap> forecasts(nh, "forecast");
  const Listener<grid_map_msgs::GridMap> differences(nh, "difference");
  const Listener<aeolian_msgs::Comparison> comparisons(nh, "comparison");
  ASSERT_TRUE(wait_until(
      [&] {
        return winds.getNumSubscribers() > 0 && clouds.getNumSubscribers() > 0 && maps.connected() &&
               fields.connected() && forecasts.connected() && differences.connected() &&
               comparisons.connected();
      },
      30));
  tf.sendTransform(small_frames().transforms);
  ros::WallDuration(1).sleep();  // the nodes hear one another, too

  const TemporaryFolder folder;
  const SmallDay day;
  const std::string bag = folder.file("day.bag");
  write_small_day(bag, day);
  const Outcome outcome =
      run_program("replay " + bag + " --config " AEOLIAN_REPOSITORY "/test/system/replay.yaml --out " +
                  folder.file("out"));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const rosbag::Bag replayed(folder.file("out/twin.bag"));

  // As the bag is played, but each message waits for what the one before leads to.
  for (int second = 0; second <= day.seconds; ++second) {
    const auto count = static_cast<std::size_t>(second) + 1;
    winds.publish(small_wind(second));
    ASSERT_TRUE(wait_until([&] { return fields.messages.size() == count; })) << second;
    clouds.publish(small_cloud(second));
    const std::size_t made = 2 * (static_cast<std::size_t>(second) / 2 + 1);
    ASSERT_TRUE(wait_until([&] {
      return maps.messages.size() == count && forecasts.messages.size() == made;
    })) << second
        << " s: " << maps.messages.size() << " maps, " << forecasts.messages.size() << " forecasts";
    wait_until([] { return false; }, 0.3);  // they are on their way to the nodes
  }
  const std::vector<std::string> scores = told<aeolian_msgs::Comparison>(replayed, "/comparison");
  ASSERT_GE(scores.size(), 7U);
  wait_until([&] {
    return comparisons.messages.size() == scores.size() && differences.messages.size() == scores.size();
  });

  EXPECT_TRUE(told(fields) == told<grid_map_msgs::GridMap>(replayed, "/wind_field"));
  EXPECT_TRUE(told(maps) == told<grid_map_msgs::GridMap>(replayed, "/height_map"));
  EXPECT_TRUE(told(forecasts) == told<grid_map_msgs::GridMap>(replayed, "/forecast"));
  EXPECT_TRUE(told(comparisons) == scores);
  EXPECT_TRUE(told(differences) == told<grid_map_msgs::GridMap>(replayed, "/difference"));
}

}  // namespace
}  // namespace aeolian

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "replay_rostest");
  const ros::NodeHandle keeps_ros_alive;
  return RUN_ALL_TESTS();
}
