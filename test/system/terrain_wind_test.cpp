// terrain_wind as people run it.
#include <cmath>

#include "program_outcome.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/surface/csv.hpp"
#include "aeolian_core/surface/geotiff.hpp"

namespace aeolian {
namespace {

/// A hill of 2 m and, in the east, a step down of 6 m.
void write_ground(const std::string& path, bool with_step) {
  HeightMap map(GridGeometry(500000, 4000000, 1, 120, 80));
  HeightMap::Layer& z = map.add(layer::elevation, 100);
  for (int y = 0; y < 80; ++y)
    for (int x = 0; x < 120; ++x) {
      const float r2 = static_cast<float>((x - 40) * (x - 40) + (y - 40) * (y - 40));
      z[map.geometry().index(x, y)] += 2 * std::exp(-r2 / 200) - (with_step && x > 80 ? 6.0F : 0.0F);
    }
  z[0] = HeightMap::unknown;
  write_geotiff(map, path);
}

TEST(TerrainWindTest, tells_the_wind_at_the_ground_and_at_probes) {
  const TemporaryFolder folder;
  write_ground(folder.file("dem.tif"), false);
  const std::string probes =
      folder.write("p.csv", "x_m,y_m,height_m\n500040.5,4000040.5,1\n500005,4000005,10\n");
  const Outcome run = run_program("terrain_wind --map " + folder.file("dem.tif") +
                                  " --speed 8 --height 2 --from-deg 270 --probes " + probes + " --out " +
                                  folder.file("new/out"));
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.out.find("spectral: friction velocity of the surroundings 0.262 m/s"), 0u) << run.out;
  const HeightMap wind = read_geotiff(folder.file("new/out/wind.tif"));
  const HeightMap::Layer& u = wind.layer("friction_velocity");
  EXPECT_TRUE(std::isnan(u[0]));
  EXPECT_GT(u[wind.geometry().index(38, 40)], 0.28F);
  EXPECT_LT(u[wind.geometry().index(60, 40)], 0.262F);
  EXPECT_NE(content_of(folder.file("new/out/speed_up.png")).find("PNG"), std::string::npos);
  EXPECT_NE(content_of(folder.file("new/out/summary.yaml")).find("model: spectral"), std::string::npos);
  const Table readings = read_csv(folder.file("new/out/probes.csv"));
  ASSERT_EQ(readings.rows(), 2u);
  EXPECT_GT(readings.column("speed_m_s")[0], 7.55);  // more than the log law's at 1 m
  EXPECT_NEAR(readings.column("direction_deg")[1], 0, 5);
}

TEST(TerrainWindTest, each_model_can_be_forced) {
  const TemporaryFolder folder;
  write_ground(folder.file("dem.tif"), true);
  for (const char* model : {"log", "spectral", "mass_consistent"}) {
    const Outcome run = run_program("terrain_wind --map " + folder.file("dem.tif") + " --speed 5 --model " +
                                    model + " --out " + folder.file(model));
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_TRUE(read_geotiff(folder.file(model) + "/wind.tif").has("separated"));
  }
}

TEST(TerrainWindTest, says_what_it_cannot_do) {
  const TemporaryFolder folder;
  write_ground(folder.file("dem.tif"), true);
  const auto complaint = [&](const std::string& flags) {
    const Outcome outcome = run_program("terrain_wind --map " + folder.file("dem.tif") + " --out " +
                                        folder.file("out") + " " + flags);
    EXPECT_EQ(outcome.code, 1) << flags;
    return outcome.err;
  };
  const auto says = [](const std::string& text, const std::string& words) {
    EXPECT_NE(text.find(words), std::string::npos) << text;
  };
  says(complaint(""), "--speed is required");
  says(complaint("--speed 8 --anemometer 500085 4000040"), "separates behind a lee");
  says(complaint("--speed 8 --anemometer 0 0"), "beside the map");
  says(complaint("--speed 8 --height 0.000001"), "above the roughness length");
  says(complaint("--speed 8 --model les"), "--model");
  says(complaint("--speed 8 --probes " + folder.write("p.csv", "x_m,y_m\n1,2\n")), "no column height_m");
  says(complaint("--speed 8 --probes " + folder.write("q.csv", "x_m,y_m,height_m\n1,2,-3\n")),
       "must be positive");
}

}  // namespace
}  // namespace aeolian
