#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_twin/nodes/conversions.hpp"

namespace aeolian {
namespace {

const std::string friction_velocity_layer = "friction_velocity";
const std::string direction_layer = "direction";
const std::string air_density_layer = "air_density";
const std::string separated_layer = "separated";
const std::string speed_up_layer = "speed_up";

void require_finite_length(const std::string& field, double value) {
  if (!std::isfinite(value) || value <= 0)
    throw Error(fmt::format("grid map: info.{} is {}, must be positive", field, value));
}

int count_cells(const std::string& field, double length, double resolution) {
  require_finite_length(field, length);
  const double count = std::round(length / resolution);
  if (!(count >= 1 && count < 1e9) || std::abs(length / resolution - count) > 0.01)
    throw Error(fmt::format("grid map: info.{} is {}, must be a whole number of cells of {} m", field, length,
                            resolution));
  return static_cast<int>(count);
}

GridGeometry to_geometry(const grid_map_msgs::GridMapInfo& info) {
  require_finite_length("resolution", info.resolution);
  const int nx = count_cells("length_x", info.length_x, info.resolution);
  const int ny = count_cells("length_y", info.length_y, info.resolution);
  const auto& q = info.pose.orientation;
  const bool turned = !(std::abs(q.x) < 1e-6 && std::abs(q.y) < 1e-6 && std::abs(q.z) < 1e-6);
  if (turned)
    throw Error(fmt::format("grid map: info.pose.orientation is ({}, {}, {}, {}), must be without rotation",
                            q.x, q.y, q.z, q.w));
  const auto& centre = info.pose.position;
  return {centre.x - nx * info.resolution / 2, centre.y - ny * info.resolution / 2, info.resolution, nx, ny};
}

/// One layer's values in our order.
HeightMap::Layer to_layer(const std::string& name, const std_msgs::Float32MultiArray& array,
                          const GridGeometry& geometry, int first_row, int first_column) {
  const int rows = geometry.nx();
  const int columns = geometry.ny();
  const auto& dim = array.layout.dim;
  const bool row_major = !dim.empty() && dim[0].label == "row_index";
  if (dim.size() != 2 || (!row_major && dim[0].label != "column_index"))
    throw Error(fmt::format(
        "grid map: layer '{}' has a layout of {} dimensions, the first '{}'; must be column_index and "
        "row_index",
        name, dim.size(), dim.empty() ? "" : dim[0].label));
  const auto& rows_dim = dim[row_major ? 0 : 1];
  const auto& columns_dim = dim[row_major ? 1 : 0];
  const std::size_t offset = array.layout.data_offset;
  if (rows_dim.size != static_cast<std::uint32_t>(rows) ||
      columns_dim.size != static_cast<std::uint32_t>(columns) ||
      array.data.size() != offset + geometry.size())
    throw Error(fmt::format("grid map: layer '{}' has {} x {} cells and {} values, must have {} x {} cells",
                            name, rows_dim.size, columns_dim.size,
                            array.data.size() - std::min(offset, array.data.size()), rows, columns));
  if (!row_major && first_row == 0 && first_column == 0)
    return {array.data.rbegin(), array.data.rend() - static_cast<std::ptrdiff_t>(offset)};
  HeightMap::Layer values(geometry.size());
  for (int column = 0; column < columns; ++column) {
    const int stored_column = (column + first_column) % columns;
    for (int row = 0; row < rows; ++row) {
      const int stored_row = (row + first_row) % rows;
      const auto at = static_cast<std::size_t>(row_major ? stored_row * columns + stored_column
                                                         : stored_column * rows + stored_row);
      values[geometry.index(rows - 1 - row, columns - 1 - column)] = array.data[offset + at];
    }
  }
  return values;
}

/// What each cell has gained; nothing in still air.
HeightMap::Layer speed_up(const WindField& wind) {
  HeightMap::Layer gain = wind.cells.layer(friction_velocity_layer);
  const auto level = static_cast<float>(wind.friction_velocity);
  for (float& value : gain) value = level > 0 ? value / level - 1 : value;
  return gain;
}

double mean_of_known(const HeightMap::Layer& values) {
  double sum = 0;
  for (const float v : values)
    if (std::isfinite(v)) sum += static_cast<double>(v);
  return sum / static_cast<double>(count_known(values));
}

}  // namespace

grid_map_msgs::GridMap to_message(const HeightMap& map, const std_msgs::Header& header) {
  const GridGeometry& geometry = map.geometry();
  grid_map_msgs::GridMap message;
  message.info.header = header;
  message.info.resolution = geometry.cell();
  message.info.length_x = geometry.length_x();
  message.info.length_y = geometry.length_y();
  message.info.pose.position.x = geometry.origin_x() + geometry.length_x() / 2;
  message.info.pose.position.y = geometry.origin_y() + geometry.length_y() / 2;
  message.info.pose.orientation.w = 1;
  message.layers = map.names();
  if (map.has(layer::elevation)) message.basic_layers = {layer::elevation};
  const auto rows = static_cast<std::uint32_t>(geometry.nx());
  const auto columns = static_cast<std::uint32_t>(geometry.ny());
  for (const std::string& name : message.layers) {
    std_msgs::Float32MultiArray& array = message.data.emplace_back();
    array.layout.dim.resize(2);
    array.layout.dim[0].label = "column_index";
    array.layout.dim[0].size = columns;
    array.layout.dim[0].stride = rows * columns;
    array.layout.dim[1].label = "row_index";
    array.layout.dim[1].size = rows;
    array.layout.dim[1].stride = rows;
    const HeightMap::Layer& values = map.layer(name);
    array.data.assign(values.rbegin(), values.rend());
  }
  return message;
}

HeightMap to_height_map(const grid_map_msgs::GridMap& message, const std::vector<std::string>& only) {
  HeightMap map(to_geometry(message.info));
  const GridGeometry& geometry = map.geometry();
  if (message.layers.size() != message.data.size())
    throw Error(fmt::format("grid map: there are {} layer names for {} layers of data", message.layers.size(),
                            message.data.size()));
  const int first_row = message.outer_start_index;
  const int first_column = message.inner_start_index;
  if (first_row >= geometry.nx() || first_column >= geometry.ny())
    throw Error(fmt::format("grid map: start index is ({}, {}), must be within {} rows and {} columns",
                            first_row, first_column, geometry.nx(), geometry.ny()));
  for (std::size_t i = 0; i < message.layers.size(); ++i) {
    const std::string& name = message.layers[i];
    if (only.empty() || std::find(only.begin(), only.end(), name) != only.end())
      map.add(name, to_layer(name, message.data[i], geometry, first_row, first_column));
  }
  return map;
}

grid_map_msgs::GridMap to_message(const WindField& wind, const GridGeometry& extent,
                                  const std_msgs::Header& header) {
  HeightMap map = wind.cells;
  if (map.names().empty()) {
    const double cell = std::max(extent.length_x(), extent.length_y());
    map = HeightMap(GridGeometry(extent.origin_x() + (extent.length_x() - cell) / 2,
                                 extent.origin_y() + (extent.length_y() - cell) / 2, cell, 1, 1));
    map.add(friction_velocity_layer, static_cast<float>(wind.friction_velocity));
    map.add(direction_layer, static_cast<float>(wind.direction));
  } else {
    map.add(speed_up_layer, speed_up(wind));
  }
  map.add(air_density_layer, static_cast<float>(wind.air_density));
  grid_map_msgs::GridMap message = to_message(map, header);
  message.basic_layers = {friction_velocity_layer, direction_layer};
  return message;
}

WindField to_wind_field(const grid_map_msgs::GridMap& message) {
  HeightMap map = to_height_map(message);
  const HeightMap::Layer& speeds = map.layer(friction_velocity_layer);
  const HeightMap::Layer& directions = map.layer(direction_layer);
  const HeightMap::Layer* separated = map.has(separated_layer) ? &map.layer(separated_layer) : nullptr;
  WindField wind;
  double east = 0;
  double north = 0;
  double sum = 0;
  std::size_t known = 0;
  std::size_t attached = 0;
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    if (!std::isfinite(speeds[i]) || !std::isfinite(directions[i])) continue;
    ++known;
    if (separated && (*separated)[i] > 0) continue;
    const double speed = static_cast<double>(speeds[i]);
    const double direction = static_cast<double>(directions[i]);
    east += speed * std::cos(direction);
    north += speed * std::sin(direction);
    sum += speed;
    ++attached;
  }
  if (known == 0) throw Error("wind field: no cell has a finite friction velocity and direction");
  wind.friction_velocity = attached > 0 ? sum / static_cast<double>(attached) : 0;
  wind.direction = speeds.size() == 1 ? static_cast<double>(directions[0]) : std::atan2(north, east);
  if (map.has(air_density_layer)) wind.air_density = mean_of_known(map.layer(air_density_layer));
  if (speeds.size() > 1) wind.cells = std::move(map);
  return wind;
}

}  // namespace aeolian
