#pragma once

#include <string>

#include "aeolian_core/surface/height_map.hpp"
#include "aeolian_core/surface/point_cloud.hpp"

namespace aeolian {

/// Reads PCD, PLY, XYZ/CSV/TXT (three columns; a header line with x,y,z names picks the columns; comma,
/// semicolon or blanks) or GeoTIFF (a point for each known cell of the first band), chosen by the extension,
/// case ignored.
///
/// Coordinates may be floats or doubles; the origin is the first finite point rounded to whole metres when
/// any coordinate exceeds 1000 m, else zero, and the float differences to it are taken in double. Points that
/// are not finite are kept as NaN, so that an organised cloud keeps its order. Throws Error naming the file
/// and the reason: missing, wrong format, no x/y/z field, no finite point, LAS/LAZ (no Debian library reads
/// it: the message says to convert to XYZ).
PointCloud read_cloud(const std::string& path);

/// Writes PCD (binary), PLY (binary) or XYZ/CSV (text, 17 digits), by the extension, in true coordinates as
/// doubles, atomically. Points that are not finite are left out.
void write_cloud(const PointCloud& cloud, const std::string& path);

/// The known cells of a layer as points at the cells' centres; throws Error when there are none.
PointCloud to_cloud(const HeightMap& map, const std::string& layer = layer::elevation);

}  // namespace aeolian
