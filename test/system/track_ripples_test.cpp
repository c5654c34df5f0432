// track_ripples as people run it.
#include <cmath>

#include "../aeolian_core/measure/ripple_world.hpp"
#include "program_outcome.hpp"
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "aeolian_core/surface/csv.hpp"
#include "aeolian_core/surface/geotiff.hpp"

namespace aeolian {
namespace {

const GridGeometry plot(0, 0, 0.004, 150, 100);

void write_train(const std::string& path, double way, const GridGeometry& grid = plot) {
  Train t;
  t.phase = 2 * M_PI / t.wavelength * way;
  HeightMap map(grid);
  map.add(layer::elevation, laid_out(grid, t));
  write_geotiff(map, path);
}

TEST(TrackRipplesTest, writes_what_moving_ripples_do) {
  const TemporaryFolder folder;
  for (int m = 0; m < 3; ++m) write_train(folder.file(fmt::format("map_{:03d}.tif", 60 * m)), 0.01 * m);
  const Outcome outcome = run_program(
      "track_ripples --out new/out --direction-deg 5 map_000.tif map_060.tif map_120.tif", folder.path());
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("wavelength 50.0"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("celerity 10"), std::string::npos) << outcome.out;
  const Table ripples = read_csv(folder.file("new/out/ripples.csv"));
  ASSERT_EQ(ripples.rows(), 3U);
  EXPECT_EQ(ripples.column("t_s")[2], 120);
  EXPECT_NEAR(ripples.column("wavelength_m")[1], 0.05, 5e-4);
  EXPECT_NEAR(ripples.column("celerity_m_s")[2], 0.01 / 60, 0.0002 / 60);
  EXPECT_TRUE(std::isnan(ripples.column("celerity_m_s")[0]));
  EXPECT_EQ(content_of(folder.file("new/out/events.csv")),
            "kind,t_s,start_s,end_s,x_m,y_m,length_m,ratio_before,ratio_after\n");
  EXPECT_NE(content_of(folder.file("new/out/crests.csv")).find("unseen"), std::string::npos);
  EXPECT_GT(read_csv(folder.file("new/out/crest_lines.csv")).rows(), 1000U);
  EXPECT_EQ(content_of(folder.file("new/out/map_060_crests.png")).substr(1, 3), "PNG");
  EXPECT_NE(content_of(folder.file("new/out/tracks.svg")).find("</svg>"), std::string::npos);
}

// Without a direction the motion tells it; a wind from the east blows to 180 degrees.
TEST(TrackRipplesTest, finds_the_wind_and_takes_times) {
  const TemporaryFolder folder;
  for (int m = 0; m < 3; ++m) write_train(folder.file(fmt::format("{}.tif", m)), -0.01 * m);
  folder.write("times.csv", "t_s\n0\n100\n200\n");
  const Outcome outcome =
      run_program("track_ripples --out out 0.tif 1.tif 2.tif --times-csv times.csv", folder.path());
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("(from 90 deg)"), std::string::npos) << outcome.out;
  EXPECT_NEAR(read_csv(folder.file("out/ripples.csv")).column("celerity_m_s")[1], 1e-4, 2e-6);
  const Outcome one = run_program("track_ripples --out one 0.tif --from-deg 90", folder.path());
  EXPECT_EQ(one.code, 0) << one.err;
}

TEST(TrackRipplesTest, says_what_it_cannot_do) {
  const TemporaryFolder folder;
  write_train(folder.file("map_000.tif"), 0);
  write_train(folder.file("map_060.tif"), 0.01);
  write_train(folder.file("other_120.tif"), 0.01, GridGeometry(0, 0, 0.004, 100, 100));
  write_train(folder.file("nameless.tif"), 0.01);
  HeightMap flat(plot);
  flat.add(layer::elevation, 0.F);
  write_geotiff(flat, folder.file("flat.tif"));
  const auto complaint = [&](const std::string& arguments) {
    const Outcome outcome = run_program("track_ripples --out out " + arguments, folder.path());
    EXPECT_EQ(outcome.code, 1) << arguments;
    return outcome.err;
  };
  EXPECT_EQ(complaint("map_060.tif map_000.tif --direction-deg 0"),
            "track_ripples: 'map_000.tif' at 0 s: must be later than 'map_060.tif' at 60 s\n");
  EXPECT_EQ(complaint("map_000.tif other_120.tif --direction-deg 0"),
            "track_ripples: 'other_120.tif' lies on another grid than 'map_000.tif'; all maps must have the "
            "same\n");
  EXPECT_EQ(complaint("map_000.tif nameless.tif"),
            "track_ripples: 'nameless.tif': no time in its name; give the times with --times\n");
  EXPECT_EQ(complaint("map_000.tif map_060.tif --times 1"),
            "track_ripples: --times: 1 times for 2 maps, must be one each\n");
  EXPECT_NE(complaint("flat.tif --direction-deg 0").find("no map has ripples that stand out of its noise"),
            std::string::npos);
  EXPECT_EQ(complaint("flat.tif"),
            "track_ripples: 'flat.tif': no ripples that stand out of its noise; give the wind with "
            "--direction-deg or "
            "--from-deg\n");
  EXPECT_NE(complaint("missing.tif --direction-deg 0").find("missing.tif"), std::string::npos);
  EXPECT_NE(complaint("map_000.tif --direction-deg 0 --from-deg 3").find("excludes"), std::string::npos);
}

}  // namespace
}  // namespace aeolian
