#pragma once

#include <string>

#include "aeolian_core/surface/height_map.hpp"

namespace aeolian {

/// Writes every layer as a float32 band (band description = layer name, NaN = no data, north-up), atomically,
/// deflated. `projection` is anything GDAL understands ("EPSG:32632"), empty for local coordinates. Throws
/// Error naming the file.
void write_geotiff(const HeightMap& map, const std::string& path, const std::string& projection = {});

/// Reads every band as a layer; a band without description is called "elevation" when it is the first,
/// "band_N" otherwise; no-data values become NaN. Throws Error naming the file for what is not a north-up
/// raster of square cells.
HeightMap read_geotiff(const std::string& path);

}  // namespace aeolian
