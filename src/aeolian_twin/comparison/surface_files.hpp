#pragma once

#include <optional>
#include <string>
#include <vector>

#include "aeolian_core/surface/height_map.hpp"
#include "aeolian_core/surface/point_cloud.hpp"

namespace aeolian {

/// A surface as it was found in a file: exactly one of map, cloud and profile.
struct SurfaceFile {
  std::string name;
  std::optional<HeightMap> map;  ///< elevation and, when the file has it, variance
  std::optional<PointCloud> cloud;
  std::optional<HeightMap> profile;  ///< one row of cells along x; variance when sigma_z is given
  std::string projection;            ///< empty: not stated
  std::string frame;                 ///< empty: not stated
};

/// Reads GeoTIFF, bag (FILE.bag:TOPIC, the last grid map of the topic, /height_map without one), PCD, PLY,
/// XYZ, TXT, CSV. A CSV with columns x_m, z_m (or x_mm, z_mm; sigma_z_m, sigma_z_mm) and no y is a profile;
/// stations are put on even steps of their median distance, gaps of more than three steps stay gaps. Throws
/// Error naming the file.
SurfaceFile read_surface(const std::string& name);

/// Surfaces on one grid, and what was done to get there, one line each.
struct CommonGrid {
  std::vector<HeightMap> maps;  ///< in the order of the files
  std::vector<std::string> remarks;
  bool profile = false;
};

/// Puts surfaces on the grid of the coarsest map among them, cut to what all cover. Clouds are gridded there,
/// as fuse_clouds does it; without a map, in cells of `cell` [m], which otherwise overrules the maps' cells
/// when coarser. Throws Error when frames or projections that the files state differ, when a profile meets a
/// map, when surfaces do not overlap, and for clouds only without `cell`.
CommonGrid on_common_grid(const std::vector<SurfaceFile>& files, std::optional<double> cell);

/// A mask (first band of a GeoTIFF, above 0.5: yes) on a grid, by the nearest cell.
HeightMap::Layer read_mask(const std::string& file, const GridGeometry& grid);

}  // namespace aeolian
