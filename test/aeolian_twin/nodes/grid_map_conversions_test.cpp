#include <cmath>
#include <limits>
#include <map>

#include <grid_map_msgs/GetGridMap.h>
#include <grid_map_msgs/ProcessFile.h>
#include <grid_map_msgs/SetGridMap.h>
#include <gtest/gtest.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_twin/nodes/conversions.hpp"

namespace aeolian {
namespace {

constexpr double cell = 0.5;
const GridGeometry geometry(10, -20, cell, 3, 2);

/// The height of a place: different in each cell, so that a swapped or mirrored axis shows.
float height_at(double x, double y) { return static_cast<float>(100 * x + y); }

HeightMap world() {
  HeightMap map(geometry);
  HeightMap::Layer& elevation = map.add(layer::elevation);
  for (std::size_t i = 0; i < geometry.size(); ++i) {
    const CellIndex at = geometry.cell_at(i);
    elevation[i] = height_at(geometry.x(at.x), geometry.y(at.y));
  }
  return map;
}

/// Where a GridMap says that the cell of a row and column lies, by the documented rule: row 0, column 0 is
/// the cell of largest x and largest y, rows run towards smaller x, columns towards smaller y.
struct Position {
  double x;
  double y;
};
Position position(const grid_map_msgs::GridMapInfo& info, int row, int column) {
  return {info.pose.position.x + info.length_x / 2 - (row + 0.5) * info.resolution,
          info.pose.position.y + info.length_y / 2 - (column + 0.5) * info.resolution};
}

/// A message written cell by cell after the documented rules, not by our code.
grid_map_msgs::GridMap message_by_rule(int first_row, int first_column, bool row_major) {
  const int rows = 3;
  const int columns = 2;
  grid_map_msgs::GridMap m;
  m.info.resolution = cell;
  m.info.length_x = rows * cell;
  m.info.length_y = columns * cell;
  m.info.pose.position.x = 10.75;
  m.info.pose.position.y = -19.5;
  m.info.pose.orientation.w = 1;
  m.outer_start_index = static_cast<std::uint16_t>(first_row);
  m.inner_start_index = static_cast<std::uint16_t>(first_column);
  m.layers = {"elevation"};
  m.data.resize(1);
  auto& array = m.data[0];
  array.layout.dim.resize(2);
  array.layout.dim[0].label = row_major ? "row_index" : "column_index";
  array.layout.dim[0].size = row_major ? rows : columns;
  array.layout.dim[1].label = row_major ? "column_index" : "row_index";
  array.layout.dim[1].size = row_major ? columns : rows;
  array.data.resize(rows * columns);
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const int r = (row + first_row) % rows;
      const int c = (column + first_column) % columns;
      const Position p = position(m.info, row, column);
      array.data[static_cast<std::size_t>(row_major ? r * columns + c : c * rows + r)] = height_at(p.x, p.y);
    }
  }
  return m;
}

void expect_world(const HeightMap& map) {
  ASSERT_EQ(map.geometry(), geometry);
  EXPECT_EQ(map.layer(layer::elevation), world().layer(layer::elevation));
}

std::string error_of(const grid_map_msgs::GridMap& message) {
  try {
    to_height_map(message);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(GridMapMessage, IsTheOneThatEveryToolKnows) {
  EXPECT_STREQ(ros::message_traits::MD5Sum<grid_map_msgs::GridMap>::value(),
               "95681e052b1f73bf87b7eb984382b401");
  EXPECT_STREQ(ros::message_traits::DataType<grid_map_msgs::GridMap>::value(), "grid_map_msgs/GridMap");
}

TEST(GridMapServices, AreThoseThatEveryToolKnows) {
  namespace traits = ros::service_traits;
  EXPECT_STREQ(traits::MD5Sum<grid_map_msgs::GetGridMap>::value(), "802c2cbc7b10fada2d44db75ddb8c738");
  EXPECT_STREQ(traits::MD5Sum<grid_map_msgs::ProcessFile>::value(), "03f389710f49a6dd2a8b447bb2850cd6");
  EXPECT_STREQ(traits::MD5Sum<grid_map_msgs::SetGridMap>::value(), "4f8e24cfd42bc1470fe765b7516ff7e5");
}

TEST(GridMapConversion, PutsEachValueAtItsPlace) {
  const grid_map_msgs::GridMap m = to_message(world(), std_msgs::Header());
  ASSERT_EQ(m.data.size(), 1U);
  const auto& array = m.data[0];
  ASSERT_EQ(array.layout.dim.size(), 2U);
  EXPECT_EQ(array.layout.dim[0].label, "column_index");
  EXPECT_EQ(array.layout.dim[1].label, "row_index");
  EXPECT_EQ(array.layout.dim[0].size, 2U);
  EXPECT_EQ(array.layout.dim[1].size, 3U);
  EXPECT_EQ(array.layout.dim[0].stride, 6U);
  EXPECT_EQ(array.layout.dim[1].stride, 3U);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 2; ++column) {
      const Position p = position(m.info, row, column);
      EXPECT_EQ(array.data[static_cast<std::size_t>(column * 3 + row)], height_at(p.x, p.y))
          << row << " " << column;
    }
  }
  EXPECT_EQ(m.data[0].data, message_by_rule(0, 0, false).data[0].data);
}

TEST(GridMapConversion, ReadsEveryStartIndexInBothOrders) {
  for (const bool row_major : {false, true})
    for (int first_row = 0; first_row < 3; ++first_row)
      for (int first_column = 0; first_column < 2; ++first_column)
        expect_world(to_height_map(message_by_rule(first_row, first_column, row_major)));
}

TEST(GridMapConversion, GoesThereAndBack) {
  HeightMap map = world();
  map.add(layer::variance, 0.25F);
  map.layer(layer::elevation)[2] = HeightMap::unknown;
  std_msgs::Header header;
  header.frame_id = "map";
  header.stamp = ros::Time(1700000000, 123456789);
  const grid_map_msgs::GridMap m = to_message(map, header);
  EXPECT_EQ(m.info.header.stamp, header.stamp);
  EXPECT_EQ(m.basic_layers, std::vector<std::string>{"elevation"});
  const HeightMap back = to_height_map(m);
  EXPECT_EQ(back.names(), map.names());
  EXPECT_EQ(back.layer(layer::variance), map.layer(layer::variance));
  EXPECT_TRUE(std::isnan(back.layer(layer::elevation)[2]));
  EXPECT_EQ(back.layer(layer::elevation)[3], map.layer(layer::elevation)[3]);
}

TEST(GridMapConversion, KeepsUtmCoordinates) {
  HeightMap map(GridGeometry(512345.5, 5403210.25, 0.002, 500, 250));
  map.add(layer::elevation, 1);
  const GridGeometry back = to_height_map(to_message(map, std_msgs::Header())).geometry();
  EXPECT_NEAR(back.origin_x(), 512345.5, 1e-9);
  EXPECT_NEAR(back.origin_y(), 5403210.25, 1e-8);
}

TEST(GridMapConversion, RefusesWhatDoesNotFit) {
  const grid_map_msgs::GridMap good = message_by_rule(0, 0, false);
  auto m = good;
  m.data[0].data.pop_back();
  EXPECT_EQ(error_of(m), "grid map: layer 'elevation' has 3 x 2 cells and 5 values, must have 3 x 2 cells");
  m = good;
  m.data[0].layout.dim[0].size = 4;
  EXPECT_NE(error_of(m).find("layer 'elevation' has 3 x 4 cells"), std::string::npos) << error_of(m);
  m = good;
  m.data[0].layout.dim.clear();
  EXPECT_NE(error_of(m).find("layout of 0 dimensions"), std::string::npos) << error_of(m);
  m = good;
  m.data[0].layout.data_offset = 1000;
  EXPECT_NE(error_of(m), "");
  m = good;
  m.info.resolution = std::nan("");
  EXPECT_EQ(error_of(m), "grid map: info.resolution is nan, must be positive");
  m = good;
  m.info.length_x = std::numeric_limits<double>::infinity();
  EXPECT_EQ(error_of(m), "grid map: info.length_x is inf, must be positive");
  m = good;
  m.info.length_y = 1.2;
  EXPECT_NE(error_of(m).find("info.length_y is 1.2, must be a whole number of cells"), std::string::npos)
      << error_of(m);
  m = good;
  m.info.pose.orientation.z = std::sqrt(0.5);
  m.info.pose.orientation.w = std::sqrt(0.5);
  EXPECT_NE(error_of(m).find("info.pose.orientation"), std::string::npos) << error_of(m);
  m = good;
  m.info.pose.position.x = std::nan("");
  EXPECT_NE(error_of(m), "");
  m = good;
  m.outer_start_index = 3;
  EXPECT_NE(error_of(m).find("start index is (3, 0)"), std::string::npos) << error_of(m);
  m = good;
  m.layers.push_back("variance");
  EXPECT_EQ(error_of(m), "grid map: there are 2 layer names for 1 layers of data");
}

TEST(WindFieldConversion, UniformWindIsOneCellOverTheMap) {
  WindField wind;
  wind.friction_velocity = 0.4;
  wind.direction = -3.0;
  wind.air_density = 1.1;
  const grid_map_msgs::GridMap m = to_message(wind, geometry, std_msgs::Header());
  ASSERT_EQ(m.layers.size(), 3U);
  EXPECT_EQ(m.data[0].data.size(), 1U);
  EXPECT_EQ(m.info.resolution, 1.5);
  EXPECT_EQ(m.info.pose.position.x, 10.75);
  EXPECT_EQ(m.info.pose.position.y, -19.5);
  const WindField back = to_wind_field(m);
  EXPECT_NEAR(back.friction_velocity, 0.4, 1e-7);
  EXPECT_NEAR(back.direction, -3.0, 1e-6);
  EXPECT_NEAR(back.air_density, 1.1, 1e-6);
  EXPECT_TRUE(back.cells.names().empty());
}

TEST(WindFieldConversion, CellsAreAveragedAsVectors) {
  HeightMap map(GridGeometry(0, 0, 1, 3, 1));
  map.add("friction_velocity", {0.2F, 0.4F, HeightMap::unknown});
  map.add("direction", {3.1F, -3.1F, 0.0F});
  const WindField wind = to_wind_field(to_message(map, std_msgs::Header()));
  EXPECT_NEAR(wind.friction_velocity, 0.3, 1e-7);
  EXPECT_GT(std::abs(wind.direction), 3.1);  // near pi, not near 0
  EXPECT_EQ(wind.cells.geometry().nx(), 3);
}

TEST(WindFieldConversion, SeparatedAirIsNoPartOfTheMean) {
  WindField wind;
  wind.friction_velocity = 0.4;
  wind.cells = HeightMap(GridGeometry(0, 0, 1, 3, 1));
  wind.cells.add("friction_velocity", HeightMap::Layer{0.4F, 0.5F, 0.0F});
  wind.cells.add("direction", HeightMap::Layer{0.0F, 0.0F, 3.0F});
  wind.cells.add("separated", HeightMap::Layer{0, 0, 1});
  const grid_map_msgs::GridMap message = to_message(wind, GridGeometry(0, 0, 1, 1, 1), std_msgs::Header());
  const WindField back = to_wind_field(message);
  EXPECT_NEAR(back.friction_velocity, 0.45, 1e-7);
  EXPECT_EQ(back.direction, 0);
  const HeightMap cells = to_height_map(message);
  EXPECT_NEAR(cells.layer("speed_up")[1], 0.25, 1e-6);
  EXPECT_EQ(cells.layer("speed_up")[2], -1);
}

TEST(WindFieldConversion, NamesWhatIsMissing) {
  HeightMap map(GridGeometry(0, 0, 1, 1, 1));
  map.add("friction_velocity", 0.3F);
  EXPECT_THROW(to_wind_field(to_message(map, std_msgs::Header())), Error);
  map.add("direction", HeightMap::unknown);
  EXPECT_THROW(to_wind_field(to_message(map, std_msgs::Header())), Error);
}

TEST(ComparisonConversion, LosesNoNumber) {
  Comparison c;
  double value = 1;
  c.cells = 77;
  for (double* field : {&c.bias, &c.rmse, &c.nmad, &c.volume_change_measured, &c.volume_change_predicted,
                        &c.wavelength_measured, &c.wavelength_predicted, &c.height_measured,
                        &c.height_predicted, &c.displacement_measured, &c.displacement_predicted,
                        &c.rmse_persistence, &c.rmse_translation, &c.skill_persistence, &c.skill_translation})
    *field = value++;
  std_msgs::Header header;
  header.stamp = ros::Time(160, 5);
  const aeolian_msgs::Comparison m = to_message(c, header, ros::Time(100, 5));
  EXPECT_EQ(m.lead_time, 60);
  EXPECT_EQ(m.cells, 77U);
  const std::vector<double> got{m.bias,
                                m.rmse,
                                m.nmad,
                                m.volume_change_measured,
                                m.volume_change_predicted,
                                m.wavelength_measured,
                                m.wavelength_predicted,
                                m.height_measured,
                                m.height_predicted,
                                m.displacement_measured,
                                m.displacement_predicted,
                                m.rmse_persistence,
                                m.rmse_translation,
                                m.skill_persistence,
                                m.skill_translation};
  for (std::size_t i = 0; i < got.size(); ++i) EXPECT_EQ(got[i], static_cast<double>(i + 1));
}

}  // namespace
}  // namespace aeolian
