#include "aeolian_twin/nodes/map_file.hpp"

#include "../../small_disk.hpp"
#include "../../temporary_folder.hpp"
#include <grid_map_msgs/GridMap.h>
#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <std_msgs/String.h>

#include "aeolian_core/surface/geotiff.hpp"
#include "aeolian_core/surface/random.hpp"
#include "aeolian_twin/nodes/conversions.hpp"

namespace aeolian {
namespace {

StoredMap rough_map(int nx = 40, int ny = 30) {
  StoredMap stored{HeightMap(GridGeometry(512345.678, 5401234.5, 0.002, nx, ny)), "bed", {1700000000, 7}};
  RandomStream random(3, 0);
  for (const std::string& name : {layer::elevation, layer::variance})
    for (float& value : stored.map.add(name)) value = static_cast<float>(random.normal());
  stored.map.layer(layer::elevation)[5] = HeightMap::unknown;
  return stored;
}

class MapFile : public testing::TestWithParam<std::string> {
 protected:
  TemporaryFolder folder_;
  std::string file_ = folder_.file("map" + GetParam());
};

TEST_P(MapFile, GivesBackWhatWasSaved) {
  const StoredMap stored = rough_map();
  save_map(stored, file_, "height_map");
  const StoredMap back = load_map(file_, "height_map");
  EXPECT_EQ(back.frame, "bed");
  EXPECT_EQ(back.stamp, stored.stamp) << "to the nanosecond";
  EXPECT_EQ(back.map.names(), stored.map.names());
  EXPECT_NEAR(back.map.geometry().origin_x(), stored.map.geometry().origin_x(), 1e-9);
  EXPECT_TRUE(std::isnan(back.map.layer(layer::elevation)[5]));
  EXPECT_EQ(back.map.layer(layer::elevation)[6], stored.map.layer(layer::elevation)[6]);
  EXPECT_EQ(back.map.layer(layer::variance), stored.map.layer(layer::variance));
  EXPECT_EQ(folder_.count_files(), 1U) << "something was left beside the file";
}

TEST_P(MapFile, AFullDiskLeavesTheOldFile) {
  const TemporaryFolder small;
  const SmallDisk disk(small.path(), 100000);
  if (!disk.mounted()) GTEST_SKIP() << "only the superuser can make a small disk";
  const std::string file = small.file("map" + GetParam());
  save_map(rough_map(), file, "height_map");
  const std::string message = error_of([&] { save_map(rough_map(400, 300), file, "height_map"); });
  EXPECT_NE(message.find(file), std::string::npos) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  EXPECT_EQ(load_map(file, "height_map").map.geometry().nx(), 40);
  EXPECT_EQ(small.count_files(), 1U);
}

TEST(MapFileGeoTiff, OfMoreThanAFileCanHoldLeavesTheOldFile) {
  const TemporaryFolder folder;
  const std::string file = folder.file("map.tif");
  save_map(rough_map(), file, "");
  {
    const SmallFiles limit(40000);
    EXPECT_NE(error_of([&] { save_map(rough_map(400, 300), file, ""); }).find(file), std::string::npos);
  }
  EXPECT_EQ(load_map(file, "").map.geometry().nx(), 40);
  EXPECT_EQ(folder.count_files(), 1U);
}

TEST_P(MapFile, RefusesWhatIsNoMapOfHeights) {
  StoredMap stored = rough_map();
  stored.map.add(layer::elevation);
  save_map(stored, file_, "height_map");
  EXPECT_NE(error_of([&] { load_map(file_, "height_map"); }).find("no cell of 'elevation' is known"),
            std::string::npos);
  stored.map.remove(layer::elevation);
  save_map(stored, file_, "height_map");
  EXPECT_NE(error_of([&] { load_map(file_, "height_map"); }).find("has the layers variance"),
            std::string::npos);
  folder_.write("map" + GetParam(), "this is not a map");
  EXPECT_NE(error_of([&] { load_map(file_, "height_map"); }).find(file_), std::string::npos);
  EXPECT_NE(error_of([&] { load_map("/nowhere" + GetParam(), "x"); }).find("/nowhere"), std::string::npos);
  EXPECT_NE(error_of([&] { save_map(rough_map(), "/nowhere/map" + GetParam(), "x"); }).find("/nowhere"),
            std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Formats, MapFile, testing::Values(".tif", ".bag"));

TEST(MapFileBag, TakesTheLastMapOfTheTopicAndNamesWhatIsThereInstead) {
  const TemporaryFolder folder;
  const std::string file = folder.file("day.bag");
  rosbag::Bag bag(file, rosbag::bagmode::Write);
  bag.write("chatter", ros::Time(1), std_msgs::String());
  for (unsigned second : {2U, 3U}) {
    std_msgs::Header header;
    header.stamp = ros::Time(second);
    bag.write("map", ros::Time(second), to_message(rough_map().map, header));
  }
  bag.close();
  EXPECT_EQ(load_map(file, "map").stamp, ros::Time(3));
  const std::string message = error_of([&] { load_map(file, "height_map"); });
  EXPECT_NE(message.find("no grid map on topic height_map; it holds chatter, map"), std::string::npos)
      << message;
  EXPECT_NE(error_of([&] { load_map(file, "chatter"); }).find("no grid map on topic chatter"),
            std::string::npos);
}

TEST(MapFileGeoTiff, OfAnotherProgramHasNeitherFrameNorStamp) {
  const TemporaryFolder folder;
  write_geotiff(rough_map().map, folder.file("dem.tiff"));
  const StoredMap stored = load_map(folder.file("dem.tiff"), "");
  EXPECT_EQ(stored.frame, "");
  EXPECT_TRUE(stored.stamp.isZero());
  EXPECT_NE(error_of([&] { save_map(stored, folder.file("map.png"), ""); }).find("must end in .tif"),
            std::string::npos);
}

}  // namespace
}  // namespace aeolian
