#pragma once

#include <map>
#include <string>

#include "aeolian_core/surface/height_map.hpp"

namespace aeolian {

/// Words about a raster that travel in its file, by name.
using GeotiffNotes = std::map<std::string, std::string>;

/// Writes every layer as a float32 band (band description = layer name, NaN = no data, north-up), atomically,
/// deflated. `projection` is anything GDAL understands ("EPSG:32632"), empty for local coordinates. Throws
/// Error naming the file.
void write_geotiff(const HeightMap& map, const std::string& path, const std::string& projection = {},
                   const GeotiffNotes& notes = {});

/// Reads every band as a layer; a band without description is called "elevation" when it is the first,
/// "band_N" otherwise; no-data values become NaN. Throws Error naming the file for what is not a north-up
/// raster of square cells.
HeightMap read_geotiff(const std::string& path);

/// The notes with which a file was written, and those that other programs left in it; throws Error naming the
/// file when it is not a raster.
GeotiffNotes read_geotiff_notes(const std::string& path);

/// The projection (with its datums) that a file states, as write_geotiff takes it; empty when it states none.
/// Throws Error naming the file when it is not a raster.
std::string read_geotiff_projection(const std::string& path);

/// Whether two projections are the same, datums and units included, however they are written.
bool same_projection(const std::string& a, const std::string& b);

}  // namespace aeolian
