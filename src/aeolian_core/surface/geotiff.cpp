#include "aeolian_core/surface/geotiff.hpp"

#include <array>
#include <cmath>
#include <memory>
#include <mutex>
#include <vector>

#include <cpl_error.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include "aeolian_core/surface/atomic_file.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/text.hpp"

namespace aeolian {
namespace {

/// The south edge is written beside GDAL's north edge, so that the geometry reads back to the last bit.
constexpr const char* south_edge_item = "AEOLIAN_SOUTH_EDGE_M";

/// While it lives GDAL of this thread prints nothing and keeps its last message for us.
class QuietGdal {
 public:
  QuietGdal() {
    static std::once_flag registered;
    std::call_once(registered, [] { GDALAllRegister(); });
    CPLPushErrorHandler(CPLQuietErrorHandler);
    CPLErrorReset();
  }
  QuietGdal(const QuietGdal&) = delete;
  QuietGdal& operator=(const QuietGdal&) = delete;
  ~QuietGdal() { CPLPopErrorHandler(); }

  static bool failed() { return CPLGetLastErrorType() >= CE_Failure; }
  /// GDAL's last message in one line.
  static std::string reason() {
    std::string text = CPLGetLastErrorMsg();
    for (char& c : text)
      if (c == '\n') c = ' ';
    return text.empty() ? "GDAL gives no reason" : text;
  }
};

struct CloseDataset {
  void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
};
using Dataset = std::unique_ptr<GDALDataset, CloseDataset>;

/// Throws Error unless the coordinates of a projection are metres.
void require_metres(const OGRSpatialReference& projection, const std::string& where) {
  if (projection.IsGeographic())
    throw Error(where + "coordinates are in degrees, must be metres (gdalwarp -t_srs reprojects)");
  if (projection.IsProjected() && std::abs(projection.GetLinearUnits() - 1) > 1e-9)
    throw Error(where + "coordinates are in another unit than metres (gdalwarp -t_srs reprojects)");
}

GridGeometry geometry_of(GDALDataset& dataset, const std::string& where) {
  std::array<double, 6> t{};
  if (dataset.GetGeoTransform(t.data()) != CE_None)
    throw Error(where + "no georeferencing, must have cell size and origin");
  if (t[2] != 0 || t[4] != 0 || !(t[1] > 0) || !(t[5] < 0))
    throw Error(where + "is rotated or mirrored, must be north-up");
  if (std::abs(t[1] + t[5]) > 1e-6 * t[1])
    throw Error(where + "cells are " + std::to_string(t[1]) + " x " + std::to_string(-t[5]) +
                " m, must be square");
  if (const auto* projection = dataset.GetSpatialRef()) require_metres(*projection, where);
  double south = t[3] + t[5] * dataset.GetRasterYSize();
  if (const char* item = dataset.GetMetadataItem(south_edge_item))
    if (const auto exact = parse_number(item); exact && std::abs(*exact - south) < 1e-5 * t[1])
      south = *exact;
  try {
    return {t[0], south, t[1], dataset.GetRasterXSize(), dataset.GetRasterYSize()};
  } catch (const Error& error) {
    throw Error(where + error.what());
  }
}

HeightMap::Layer read_band(GDALRasterBand& band, const GridGeometry& geometry, const std::string& where) {
  const int nx = geometry.nx();
  const double scale = band.GetScale();
  const double offset = band.GetOffset();
  GDALRasterBand& mask = *band.GetMaskBand();
  std::vector<double> row(static_cast<std::size_t>(nx));
  std::vector<std::uint8_t> valid(row.size());
  HeightMap::Layer layer(geometry.size());
  for (int from_north = 0; from_north < geometry.ny(); ++from_north) {
    if (band.RasterIO(GF_Read, 0, from_north, nx, 1, row.data(), nx, 1, GDT_Float64, 0, 0) != CE_None ||
        mask.RasterIO(GF_Read, 0, from_north, nx, 1, valid.data(), nx, 1, GDT_Byte, 0, 0) != CE_None)
      throw Error(where + QuietGdal::reason());
    float* values = &layer[geometry.index(0, geometry.ny() - 1 - from_north)];
    for (std::size_t x = 0; x < row.size(); ++x)
      values[x] = valid[x] != 0 ? static_cast<float>(row[x] * scale + offset) : HeightMap::unknown;
  }
  return layer;
}

void write_band(GDALRasterBand& band, const GridGeometry& geometry, const std::string& name,
                HeightMap::Layer values) {
  band.SetDescription(name.c_str());
  band.SetNoDataValue(static_cast<double>(HeightMap::unknown));
  const int nx = geometry.nx();
  for (int from_north = 0; from_north < geometry.ny() && !QuietGdal::failed(); ++from_north) {
    float* row = &values[geometry.index(0, geometry.ny() - 1 - from_north)];
    if (band.RasterIO(GF_Write, 0, from_north, nx, 1, row, nx, 1, GDT_Float32, 0, 0) != CE_None) return;
  }
}

Dataset open(const std::string& path, const std::string& where) {
  Dataset dataset(GDALDataset::Open(path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR));
  if (!dataset) throw Error(where + QuietGdal::reason());
  return dataset;
}

void write_file(const HeightMap& map, const std::string& path, const OGRSpatialReference& projection,
                const GeotiffNotes& notes) {
  const GridGeometry& geometry = map.geometry();
  const std::vector<std::string> names = map.names();
  const char* options[] = {"COMPRESS=DEFLATE", "PREDICTOR=3", "INTERLEAVE=BAND", "BIGTIFF=IF_SAFER", nullptr};
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  const Dataset dataset(driver->Create(path.c_str(), geometry.nx(), geometry.ny(),
                                       static_cast<int>(names.size()), GDT_Float32,
                                       const_cast<char**>(options)));
  if (!dataset) return;
  const double north = geometry.origin_y() + geometry.length_y();
  std::array<double, 6> transform{geometry.origin_x(), geometry.cell(), 0, north, 0, -geometry.cell()};
  dataset->SetGeoTransform(transform.data());
  std::string south;
  append_number(south, geometry.origin_y());
  dataset->SetMetadataItem(south_edge_item, south.c_str());
  for (const auto& [name, text] : notes) dataset->SetMetadataItem(name.c_str(), text.c_str());
  if (!projection.IsEmpty()) dataset->SetSpatialRef(&projection);
  for (std::size_t i = 0; i < names.size(); ++i)
    write_band(*dataset->GetRasterBand(static_cast<int>(i) + 1), geometry, names[i], map.layer(names[i]));
}

}  // namespace

void write_geotiff(const HeightMap& map, const std::string& path, const std::string& projection,
                   const GeotiffNotes& notes) {
  const QuietGdal quiet;
  const std::string where = "GeoTIFF '" + path + "': ";
  if (map.names().empty()) throw Error(where + "the map has no layers");
  OGRSpatialReference reference;
  if (!projection.empty() && reference.SetFromUserInput(projection.c_str()) != OGRERR_NONE)
    throw Error(where + "projection is '" + projection + "', must be known to GDAL, like EPSG:32632");
  require_metres(reference, where);
  write_atomically(path, [&](const std::string& temporary) {
    write_file(map, temporary, reference, notes);
    if (QuietGdal::failed()) throw Error(where + QuietGdal::reason());
  });
}

HeightMap read_geotiff(const std::string& path) {
  const QuietGdal quiet;
  const std::string where = "GeoTIFF '" + path + "': ";
  const Dataset dataset = open(path, where);
  if (dataset->GetRasterCount() == 0) throw Error(where + "has no bands");
  HeightMap map(geometry_of(*dataset, where));
  for (int i = 1; i <= dataset->GetRasterCount(); ++i) {
    GDALRasterBand& band = *dataset->GetRasterBand(i);
    std::string name = band.GetDescription();
    if (name.empty()) name = i == 1 ? layer::elevation : "band_" + std::to_string(i);
    map.add(name, read_band(band, map.geometry(), where));
  }
  return map;
}

GeotiffNotes read_geotiff_notes(const std::string& path) {
  const QuietGdal quiet;
  const Dataset dataset = open(path, "GeoTIFF '" + path + "': ");
  GeotiffNotes notes;
  for (CSLConstList item = dataset->GetMetadata(); item != nullptr && *item != nullptr; ++item) {
    const std::string text = *item;
    const std::size_t sign = text.find('=');
    if (sign != std::string::npos) notes[text.substr(0, sign)] = text.substr(sign + 1);
  }
  return notes;
}

std::string read_geotiff_projection(const std::string& path) {
  const QuietGdal quiet;
  const Dataset dataset = open(path, "GeoTIFF '" + path + "': ");
  return dataset->GetProjectionRef();
}

bool same_projection(const std::string& a, const std::string& b) {
  const QuietGdal quiet;
  OGRSpatialReference first;
  OGRSpatialReference second;
  if (first.SetFromUserInput(a.c_str()) != OGRERR_NONE || second.SetFromUserInput(b.c_str()) != OGRERR_NONE)
    return a == b;
  return first.IsSame(&second) != 0;
}

}  // namespace aeolian
