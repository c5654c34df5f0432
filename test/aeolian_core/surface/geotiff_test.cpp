#include "aeolian_core/surface/geotiff.hpp"

#include <cmath>

#include "../../temporary_folder.hpp"
#include "foreign_tiff.hpp"
#include <gtest/gtest.h>

namespace aeolian {
namespace {

constexpr float nan = HeightMap::unknown;

class GeoTiff : public testing::Test {
 protected:
  /// The error of reading a file; checks that nothing else was printed.
  std::string read_error(const std::string& path) const {
    testing::internal::CaptureStderr();
    const std::string message = error_of([&] { read_geotiff(path); });
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_NE(message.find(path), std::string::npos) << message;
    return message;
  }
  std::string foreign(const ForeignTiff& tiff) const { return folder_.write("foreign.tif", tiff.bytes()); }
  TemporaryFolder folder_;
};

TEST_F(GeoTiff, GivesBackGeometryLayersAndValuesToTheLastBit) {
  // An origin and a cell size that binary cannot hold, at UTM coordinates.
  HeightMap map(GridGeometry(512345.678, 5401234.567, 0.002, 5, 3));
  auto& elevation = map.add(layer::elevation);
  for (std::size_t i = 0; i < elevation.size(); ++i) elevation[i] = 312.3F + 0.001F * static_cast<float>(i);
  elevation[7] = nan;
  map.add(layer::age, 60);
  const std::string path = folder_.file("map.tif");
  write_geotiff(map, path, "EPSG:32632");
  const HeightMap back = read_geotiff(path);
  EXPECT_EQ(back.geometry(), map.geometry());
  EXPECT_EQ(back.names(), map.names());
  EXPECT_EQ(back.layer(layer::age), map.layer(layer::age));
  for (std::size_t i = 0; i < elevation.size(); ++i) {
    if (i == 7)
      EXPECT_TRUE(std::isnan(back.layer(layer::elevation)[i]));
    else
      EXPECT_EQ(back.layer(layer::elevation)[i], elevation[i]);
  }
  EXPECT_EQ(folder_.count_files(), 1U) << "no side-car files";
}

TEST_F(GeoTiff, CarriesNotes) {
  HeightMap map(GridGeometry(0, 0, 1, 2, 2));
  map.add(layer::elevation, 1);
  write_geotiff(map, folder_.file("map.tif"), {}, {{"FRAME", "bed = sand"}, {"STAMP", "1700000000.5"}});
  const GeotiffNotes notes = read_geotiff_notes(folder_.file("map.tif"));
  EXPECT_EQ(notes.at("FRAME"), "bed = sand");
  EXPECT_EQ(notes.at("STAMP"), "1700000000.5");
  EXPECT_NE(error_of([&] { read_geotiff_notes("/nowhere.tif"); }).find("/nowhere.tif"), std::string::npos);
}

TEST_F(GeoTiff, ReadsAForeignFileNorthUpWithItsNoDataValue) {
  ForeignTiff tiff;
  tiff.values = {11, 12, 13, 1, -9999, 3};
  const HeightMap map = read_geotiff(foreign(tiff));
  EXPECT_EQ(map.geometry(), GridGeometry(500000, 5400000 - 20, 10, 3, 2));
  const auto& values = map.layer(layer::elevation);
  EXPECT_EQ(values[map.geometry().index(0, 0)], 1) << "row 0 is the south row";
  EXPECT_TRUE(std::isnan(values[map.geometry().index(1, 0)]));
  EXPECT_EQ(values[map.geometry().index(2, 1)], 13);
}

TEST_F(GeoTiff, RefusesCellsThatAreNotSquare) {
  ForeignTiff tiff;
  tiff.values = {1, 2, 3, 4, 5, 6};
  tiff.cell_y = 20;
  EXPECT_NE(read_error(foreign(tiff)).find("must be square"), std::string::npos);
}

TEST_F(GeoTiff, RefusesDegrees) {
  ForeignTiff tiff;
  tiff.values = {1, 2, 3, 4, 5, 6};
  tiff.model = 2;
  tiff.west = 9;
  tiff.north = 48;
  tiff.cell_x = tiff.cell_y = 1e-4;
  EXPECT_NE(read_error(foreign(tiff)).find("degrees"), std::string::npos);
}

TEST_F(GeoTiff, RefusesAPictureWithoutPlace) {
  ForeignTiff tiff;
  tiff.values = {1, 2, 3, 4, 5, 6};
  tiff.georeferenced = false;
  EXPECT_NE(read_error(foreign(tiff)).find("no georeferencing"), std::string::npos);
}

TEST_F(GeoTiff, RefusesWhatIsNoRaster) {
  read_error(folder_.write("text.tif", "this is not a raster\n"));
  read_error(folder_.write("empty.tif", ""));
  EXPECT_NE(read_error(folder_.file("none.tif")).find("No such file"), std::string::npos);
}

TEST_F(GeoTiff, RefusesATruncatedFile) {
  HeightMap map(GridGeometry(0, 0, 1, 300, 300));
  auto& values = map.add(layer::elevation);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = std::sin(static_cast<float>(i * i));
  const std::string path = folder_.file("map.tif");
  write_geotiff(map, path);
  std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
  read_error(path);
}

TEST_F(GeoTiff, LeavesTheOldFileWhenItCannotWrite) {
  HeightMap map(GridGeometry(0, 0, 1, 2, 2));
  const std::string path = folder_.write("map.tif", "old");
  EXPECT_NE(error_of([&] { write_geotiff(map, path); }).find("no layers"), std::string::npos);
  map.add(layer::elevation, 0);
  EXPECT_NE(error_of([&] { write_geotiff(map, path, "EPSG:nonsense"); }).find("'EPSG:nonsense'"),
            std::string::npos);
  EXPECT_NE(error_of([&] { write_geotiff(map, path, "EPSG:4326"); }).find("degrees"), std::string::npos);
  EXPECT_EQ(content_of(path), "old");
  EXPECT_NE(error_of([&] { write_geotiff(map, path + "/x.tif"); }).find("Not a directory"),
            std::string::npos);
  EXPECT_EQ(folder_.count_files(), 1U);
}

}  // namespace
}  // namespace aeolian
