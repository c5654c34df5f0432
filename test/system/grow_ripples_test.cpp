// grow_ripples as people run it.
#include <cmath>
#include <numeric>

#include "program_outcome.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/surface/csv.hpp"
#include "aeolian_core/surface/geotiff.hpp"

namespace aeolian {
namespace {

double sum(const HeightMap::Layer& values) {
  double result = 0;
  for (const float v : values)
    if (std::isfinite(v)) result += static_cast<double>(v);
  return result;
}

TEST(GrowRipplesTest, ripples_grow_on_a_level_bed_and_their_sand_is_conserved) {
  const TemporaryFolder folder;
  const Outcome run = run_program(
      "grow_ripples --flat 0.4x0.2@0.002 --friction-velocity 0.5 --minutes 12 --map-every-s 200 --out " +
      folder.file("new/out"));
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.out.find("after 12 min: ripples of "), 0u) << run.out;
  const std::string out = folder.file("new/out/");
  for (const char* picture : {"ripples.svg", "sections.svg"})
    EXPECT_NE(content_of(out + picture).find("</svg>"), std::string::npos) << picture;
  EXPECT_NE(content_of(out + "map.png").find("PNG"), std::string::npos);

  const Table history = read_csv(out + "ripples.csv");
  ASSERT_EQ(history.rows(), 73u);
  EXPECT_EQ(history.column("t_s")[72], 720);
  EXPECT_GT(history.column("height_m")[72], 0.001);
  EXPECT_GT(history.column("speed_m_s")[72], 0);
  EXPECT_LT(std::abs(history.column("volume_error")[72]), 1e-9);

  const HeightMap first = read_geotiff(out + "elevation_0000.tif");
  const HeightMap last = read_geotiff(out + "elevation_0720.tif");
  EXPECT_NO_THROW(read_geotiff(out + "elevation_0600.tif"));
  EXPECT_NEAR(sum(first.layer(layer::elevation)), sum(last.layer(layer::elevation)), 1e-6);
}

TEST(GrowRipplesTest, goes_on_from_a_map_with_holes_and_the_wind_of_the_weather_service) {
  const TemporaryFolder folder;
  HeightMap map(GridGeometry(500000, 4000000, 0.002, 150, 100));
  HeightMap::Layer& height = map.add(layer::elevation, 0);
  for (std::size_t i = 0; i < height.size(); ++i)
    height[i] = 100 + 0.002F * std::sin(0.12F * static_cast<float>(i % 150));
  height[50 * 150 + 75] = HeightMap::unknown;
  write_geotiff(map, folder.file("bed.tif"));
  const Outcome run =
      run_program("grow_ripples --bed " + folder.file("bed.tif") +
                  " --friction-velocity 0.4 --from-deg 270 --minutes 2 --out " + folder.file("out"));
  ASSERT_EQ(run.code, 0) << run.err;
  const HeightMap last = read_geotiff(folder.file("out/elevation_0120.tif"));
  EXPECT_EQ(last.geometry(), map.geometry());
  EXPECT_TRUE(std::isnan(last.layer(layer::elevation)[50 * 150 + 75]));
  EXPECT_EQ(count_known(last.layer(layer::elevation)), height.size() - 1);
  EXPECT_GT(read_csv(folder.file("out/ripples.csv")).column("speed_m_s").back(), 0);  // to the east
}

TEST(GrowRipplesTest, a_calm_changes_nothing) {
  const TemporaryFolder folder;
  const Outcome run = run_program(
      "grow_ripples --flat 0.1x0.1@0.002 --friction-velocity 0.1 --minutes 5 --out " + folder.file("out"));
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.out, "u* 0.1 m/s is below the impact threshold: nothing moves\n");
  EXPECT_EQ(read_geotiff(folder.file("out/elevation_0000.tif")).layer(layer::elevation),
            read_geotiff(folder.file("out/elevation_0300.tif")).layer(layer::elevation));
}

TEST(GrowRipplesTest, says_what_it_cannot_do) {
  const TemporaryFolder folder;
  const std::string wind = "grow_ripples --friction-velocity 0.4 --out " + folder.file("out") + " ";
  const auto complaint = [](const std::string& command) {
    const Outcome outcome = run_program(command);
    EXPECT_EQ(outcome.code, 1) << command;
    return outcome.err;
  };
  EXPECT_NE(complaint("grow_ripples --out x").find("--friction-velocity is required"), std::string::npos);
  EXPECT_NE(complaint(wind + "--flat 1x1").find("--flat: '1x1' must be LENGTHxWIDTH@CELL"),
            std::string::npos);
  EXPECT_NE(complaint(wind + "--minutes -1").find("--minutes"), std::string::npos);
  EXPECT_NE(complaint(wind + "--bed " + folder.file("none.tif")).find("none.tif"), std::string::npos);
  HeightMap empty(GridGeometry(0, 0, 0.01, 10, 10));
  empty.add(layer::elevation);
  write_geotiff(empty, folder.file("empty.tif"));
  EXPECT_EQ(complaint(wind + "--bed " + folder.file("empty.tif")),
            "grow_ripples: '" + folder.file("empty.tif") + "' has no known cell in a band elevation\n");
  empty.layer(layer::elevation)[0] = 1;
  write_geotiff(empty, folder.file("hole.tif"));
  EXPECT_EQ(complaint(wind + "--border periodic --bed " + folder.file("hole.tif")),
            "grow_ripples: ripple model: a periodic map must be known everywhere\n");
}

}  // namespace
}  // namespace aeolian
