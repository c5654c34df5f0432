#pragma once

#include <cstdint>
#include <vector>

#include <sensor_msgs/PointCloud2.h>
#include <std_msgs/Header.h>
#include <visualization_msgs/MarkerArray.h>

#include "aeolian_twin/nodes/drawn_cells.hpp"

namespace aeolian {

/// Messages for a stock rviz that are kept and rewritten only where a map has changed: byte for byte what
/// they would be if they were drawn anew.

/// A point (x, y, z, rgb) for each known cell.
class DrawnCloud {
 public:
  /// The cloud of a map of which only some tiles differ from the last time.
  const sensor_msgs::PointCloud2& draw(const DrawnLayers& layers, const SurfaceLook& look,
                                       const TileMask& changed, const std_msgs::Header& header);

 private:
  bool has_points_of(const HeightMap::Layer& heights, const CellRange& range) const;
  void make_points(const HeightMap::Layer& heights);
  void write(const HeightMap::Layer& heights, const CellRange& range);

  DrawnCells cells_;
  std::vector<std::int32_t> point_of_cell_;  ///< -1: none
  sensor_msgs::PointCloud2 cloud_;
};

/// Two triangles between each four known neighbours, a colour at each vertex, about the map's corner as pose;
/// of a map with more than some number of cells blocks of cells are drawn.
class DrawnMesh {
 public:
  explicit DrawnMesh(double max_cells) : max_cells_(max_cells) { markers_.markers.resize(1); }

  /// The mesh of a map of which only some tiles differ from the last time, as the first marker; others that
  /// are put behind it stay there.
  visualization_msgs::MarkerArray& draw(const DrawnLayers& layers, const SurfaceLook& look,
                                        const TileMask& changed, const std_msgs::Header& header);
  /// The lowest height that was drawn [m].
  double lowest() const { return cells_.lowest(); }

 private:
  TileMask thin(const DrawnLayers& layers, const TileMask& changed);
  bool has_squares_of(const CellRange& squares) const;
  void make_squares();
  void write(const CellRange& squares);
  bool is_known(int x, int y) const;
  CellRange squares_at(const CellRange& cells) const;

  double max_cells_;
  GridGeometry full_;  ///< before blocks were taken together
  GridGeometry geometry_;
  HeightMap::Layer heights_;
  HeightMap::Layer values_;
  DrawnCells cells_;
  std::vector<std::int32_t> square_of_cell_;  ///< by the cell of its south-western corner; -1: none
  visualization_msgs::MarkerArray markers_;
};

}  // namespace aeolian
