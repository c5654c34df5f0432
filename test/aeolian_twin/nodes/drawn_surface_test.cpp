#include "aeolian_twin/nodes/drawn_surface.hpp"

#include <cmath>

#include <gtest/gtest.h>
#include <ros/serialization.h>
#include <sensor_msgs/point_cloud2_iterator.h>

#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

constexpr float nan = HeightMap::unknown;
constexpr double any_number_of_cells = 1e9;

/// Two by two cells of 1 m from (10, 20), the last one unknown.
struct FewCells {
  GridGeometry grid{10, 20, 1, 2, 2};
  HeightMap::Layer heights{1, 2, 3, nan};
  HeightMap::Layer values{0, 0.5, 1, 0};
  SurfaceLook look;
  FewCells() {
    look.range = {0, 1};
    look.shaded = false;
  }
  DrawnLayers layers() const { return {grid, heights, values}; }
  TileMask all() const { return TileMask(grid, true); }
};

TEST(DrawnCloud, HasAColouredPointForEachKnownCell) {
  FewCells few;
  few.look.offset = {0, -100, 5};
  few.look.exaggeration = 10;
  DrawnCloud drawn;
  const sensor_msgs::PointCloud2& cloud = drawn.draw(few.layers(), few.look, few.all(), std_msgs::Header());
  ASSERT_EQ(cloud.width * cloud.height, 3U);
  sensor_msgs::PointCloud2ConstIterator<float> xyz(cloud, "x");
  xyz += 1;
  EXPECT_EQ(xyz[0], 11.5F);
  EXPECT_EQ(xyz[1], -79.5F);
  EXPECT_EQ(xyz[2], 1 + 10 + 5) << "heights grow from the lowest, which stays";
  const Rgb middle = colour(Palette::sand, 0.5);
  const std::array<const char*, 3> channels{"r", "g", "b"};
  for (std::size_t c = 0; c < 3; ++c) {
    sensor_msgs::PointCloud2ConstIterator<std::uint8_t> channel(cloud, channels[c]);
    channel += 1;
    EXPECT_EQ(*channel, middle[c]);
  }
}

TEST(DrawnMesh, LeavesOutSquaresWithUnknownCorners) {
  FewCells few;
  DrawnMesh drawn(any_number_of_cells);
  EXPECT_TRUE(drawn.draw(few.layers(), few.look, few.all(), std_msgs::Header()).markers[0].points.empty());
  few.heights[3] = 4;
  const visualization_msgs::Marker& mesh =
      drawn.draw(few.layers(), few.look, few.all(), std_msgs::Header()).markers[0];
  ASSERT_EQ(mesh.points.size(), 6U);
  ASSERT_EQ(mesh.colors.size(), 6U);
  EXPECT_EQ(mesh.pose.position.x + mesh.points[1].x, 11.5);
  EXPECT_EQ(mesh.pose.position.y + mesh.points[1].y, 20.5);
  EXPECT_EQ(mesh.pose.position.z + mesh.points[1].z, 2);
  EXPECT_EQ(mesh.colors[1].g, static_cast<float>(colour(Palette::sand, 0.5)[1]) / 255);
  for (std::size_t t = 0; t < 6; t += 3) {  // faces look up: counter-clockwise from above
    const auto& a = mesh.points[t];
    const auto& b = mesh.points[t + 1];
    const auto& c = mesh.points[t + 2];
    EXPECT_GT((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x), 0);
  }
}

TEST(DrawnMesh, DrawsBlocksOfALargeMap) {
  const GridGeometry grid(0, 0, 1, 99, 51);
  const HeightMap::Layer flat(grid.size(), 2);
  DrawnMesh drawn(600);  // every third cell
  const visualization_msgs::Marker& mesh =
      drawn.draw({grid, flat, flat}, {}, TileMask(grid, true), std_msgs::Header()).markers[0];
  EXPECT_EQ(mesh.points.size(), 6U * 32 * 16);
  EXPECT_EQ(mesh.points[0].x, 1.5);
  EXPECT_EQ(mesh.points[1].x - mesh.points[0].x, 3);
}

template <class Message>
std::vector<std::uint8_t> bytes(const Message& message) {
  std::vector<std::uint8_t> result(ros::serialization::serializationLength(message));
  ros::serialization::OStream stream(result.data(), static_cast<std::uint32_t>(result.size()));
  ros::serialization::serialize(stream, message);
  return result;
}

/// Some rectangles of a map change: heights, values, what is known; sometimes the lowest cell, the look or
/// the grid. The picture that is kept must be the one that is drawn anew, to the byte.
class DrawnSurfaceChanges : public ::testing::TestWithParam<int> {
 protected:
  int below(int bound) { return static_cast<int>(bound * random_.uniform()); }

  void begin(const GridGeometry& grid) {
    grid_ = grid;
    heights_.assign(grid.size(), 0.5F);
    values_.assign(grid.size(), 0);
    changed_ = TileMask(grid, true);
  }

  void change() {
    const int x0 = below(grid_.nx());
    const int y0 = below(grid_.ny());
    const bool unknown = random_.uniform() < 0.3;
    for (int y = y0; y < std::min(grid_.ny(), y0 + 1 + below(40)); ++y) {
      for (int x = x0; x < std::min(grid_.nx(), x0 + 1 + below(40)); ++x) {
        const std::size_t i = grid_.index(x, y);
        heights_[i] = unknown && random_.uniform() < 0.5 ? nan : static_cast<float>(1 + random_.uniform());
        if (random_.uniform() < 0.001) heights_[i] = static_cast<float>(-random_.uniform());
        values_[i] = random_.uniform() < 0.01 ? nan : static_cast<float>(random_.uniform());
        changed_.activate(x, y);
      }
    }
  }

  RandomStream random_{17, static_cast<std::uint64_t>(GetParam())};
  GridGeometry grid_;
  HeightMap::Layer heights_;
  HeightMap::Layer values_;
  TileMask changed_;
};

TEST_P(DrawnSurfaceChanges, GiveTheSamePictureAsDrawingAnew) {
  const std::array<double, 3> cells_of_mesh{any_number_of_cells, 3000, 200};
  const double max_cells = cells_of_mesh[static_cast<std::size_t>(GetParam()) % 3];
  DrawnCloud cloud;
  DrawnMesh mesh(max_cells);
  SurfaceLook look;
  look.range = {0, 1};
  look.shaded = GetParam() % 2 == 0;
  look.exaggeration = 3;
  begin(GridGeometry(512345, 5401234, 0.002, 150, 110));
  for (int round = 0; round < 60; ++round) {
    if (round % 20 == 10) look.range.high += 0.1;
    if (round % 20 == 15) look.offset[1] -= 0.3;
    if (round == 30) begin(GridGeometry(512345, 5401234, 0.002, 110, 150));
    for (int n = below(4); n > 0; --n) change();
    std_msgs::Header header;
    header.frame_id = "map";
    header.stamp = ros::Time(100 + round);
    const DrawnLayers layers{grid_, heights_, values_};
    const TileMask all(grid_, true);
    ASSERT_EQ(bytes(cloud.draw(layers, look, changed_, header)),
              bytes(DrawnCloud().draw(layers, look, all, header)))
        << round;
    ASSERT_EQ(bytes(mesh.draw(layers, look, changed_, header)),
              bytes(DrawnMesh(max_cells).draw(layers, look, all, header)))
        << round;
    changed_.clear();
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, DrawnSurfaceChanges, ::testing::Range(0, 6));

}  // namespace
}  // namespace aeolian
