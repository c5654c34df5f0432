#pragma once

#include <string>

#include <ros/time.h>

#include "aeolian_core/surface/height_map.hpp"

namespace aeolian {

/// A map with what a file must say of it.
struct StoredMap {
  HeightMap map;
  std::string frame;  ///< empty: not known
  ros::Time stamp;    ///< when it holds; zero: not known
};

/// Writes a map, atomically, in the format that the name tells: *.tif and *.tiff a GeoTIFF with the layers as
/// bands, *.bag a bag with one grid_map_msgs/GridMap on `topic`. Throws Error naming the file.
void save_map(const StoredMap& stored, const std::string& file, const std::string& topic);

/// Reads such a file, and those of others: a GeoTIFF of any origin, the last grid map on a bag's `topic`.
/// Throws Error naming the file for what has no layer `elevation` with a known cell.
StoredMap load_map(const std::string& file, const std::string& topic);

}  // namespace aeolian
