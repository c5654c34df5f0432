// compare_surfaces as people run it.
#include <algorithm>
#include <cmath>
#include <fstream>

#include "program_outcome.hpp"
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "aeolian_core/surface/atomic_file.hpp"
#include "aeolian_core/surface/cloud_file.hpp"
#include "aeolian_core/surface/csv.hpp"
#include "aeolian_core/surface/geotiff.hpp"
#include "aeolian_core/surface/random.hpp"
#include "aeolian_core/twin/crest_displacement.hpp"
#include "aeolian_core/twin/difference.hpp"
#include "aeolian_twin/nodes/map_file.hpp"

namespace aeolian {
namespace {

/// Ripples of 6 cm with noise of 0.2 mm.
HeightMap ripples(const GridGeometry& grid, double shift, std::uint64_t seed) {
  RandomStream random(seed, 0);
  HeightMap map(grid);
  HeightMap::Layer& z = map.add(layer::elevation);
  for (std::size_t i = 0; i < z.size(); ++i)
    z[i] = static_cast<float>(0.003 * std::sin(2 * M_PI * (grid.x(grid.cell_at(i).x) - shift) / 0.06) +
                              0.0002 * random.normal());
  return map;
}

class CompareSurfacesTest : public testing::Test {
 protected:
  std::string file(const std::string& name) const { return folder_.file(name); }
  std::string write(const HeightMap& map, const std::string& name, const std::string& projection = {}) const {
    write_geotiff(map, file(name), projection);
    return file(name) + " ";
  }
  Outcome compare(const std::string& arguments) const {
    return run_program("compare_surfaces " + arguments + " --out " + file("out"));
  }
  YAML::Node figures() const { return YAML::LoadFile(file("out/comparison.yaml")); }
  std::string complaint(const std::string& arguments) const {
    const Outcome outcome = compare(arguments);
    EXPECT_EQ(outcome.code, 1) << arguments;
    EXPECT_EQ(outcome.err.find('\n'), outcome.err.size() - 1) << outcome.err;
    return outcome.err;
  }

  TemporaryFolder folder_;
  const GridGeometry grid_{10, 20, 0.002, 300, 150};
};

TEST_F(CompareSurfacesTest, tells_figures_with_errors_and_draws_a_page) {
  const std::string a = write(ripples(grid_, 0.01, 1), "a.tif", "EPSG:32632");
  const std::string b = write(ripples(grid_, 0.002, 2), "b.tif", "EPSG:32632");
  const std::string start = write(ripples(grid_, 0, 3), "start.tif");
  const Outcome run = compare(a + b + "--initial " + start + "--sigma-a 0.0002 --sigma-b 0.0002");
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(std::count(run.out.begin(), run.out.end(), '\n'), 2);
  EXPECT_NE(run.out.find("skill"), std::string::npos) << run.out;
  const YAML::Node y = figures();
  EXPECT_NEAR(y["first_pattern"]["wavelength_m"].as<double>(), 0.06, 0.0003);
  EXPECT_GT(y["first_pattern"]["sigma_wavelength_m"].as<double>(), 0);
  EXPECT_NEAR(y["displacement"]["first_from_second_m"].as<double>(), 0.008, 0.00008);
  EXPECT_NEAR(y["displacement"]["first_since_initial_m"].as<double>(), 0.01, 0.0001);
  EXPECT_LT(y["skill"]["against_persistence"].as<double>(), 0);
  EXPECT_GT(y["change"]["significant_share"].as<double>(), 0.5);
  const std::string page = content_of(file("out/index.html"));
  EXPECT_NE(page.find("data:image/png;base64,"), std::string::npos);
  EXPECT_EQ(page.find("src=\"difference.png"), std::string::npos);
  for (const char* picture :
       {"first.png", "second.png", "difference.png", "significant.png", "displacement.png"})
    EXPECT_NE(content_of(file("out/") + picture).find("PNG"), std::string::npos) << picture;
  for (const char* picture : {"histogram.svg", "coherence.svg", "scales.svg"})
    EXPECT_NE(content_of(file("out/") + picture).find("</svg>"), std::string::npos) << picture;
  const HeightMap map = read_geotiff(file("out/difference.tif"));
  EXPECT_EQ(map.geometry(), grid_);
  EXPECT_TRUE(map.has(layer::lod95) && map.has(layer::displacement));
  EXPECT_TRUE(same_projection(read_geotiff_projection(file("out/difference.tif")), "EPSG:32632"));
}

TEST_F(CompareSurfacesTest, a_surface_against_itself_gives_zeros) {
  const std::string a = write(ripples(grid_, 0, 1), "a.tif");
  ASSERT_EQ(compare(a + a).code, 0);
  const YAML::Node y = figures();
  for (const char* name : {"bias_m", "sigma_bias_m", "rmse_m", "nmad_m", "le90_m"})
    EXPECT_EQ(y["difference"][name].as<double>(), 0) << name;
  EXPECT_EQ(y["displacement"]["first_from_second_m"].as<double>(), 0);
  EXPECT_EQ(y["change"]["volume_net_m3"].as<double>(), 0);
}

TEST_F(CompareSurfacesTest, grids_clouds_and_reads_bags) {
  const HeightMap map = ripples(grid_, 0, 1);
  const std::string tif = write(map, "a.tif");
  write_cloud(to_cloud(map), file("a.pcd"));
  write_cloud(to_cloud(map), file("a.ply"));
  write_cloud(to_cloud(map), file("a.csv"));
  save_map({map, "map", ros::Time(5)}, file("a.bag"), "/there");
  for (const char* name : {"a.pcd", "a.ply", "a.csv", "a.bag:/there"}) {
    const Outcome run = compare(file(name) + " " + tif);
    ASSERT_EQ(run.code, 0) << name << run.err;
    EXPECT_LT(figures()["difference"]["rmse_m"].as<double>(), 1e-5) << name;
  }
  const Outcome run = compare(file("a.pcd") + " " + file("a.ply") + " --cell 0.004");
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(figures()["cell_m"].as<double>(), 0.004);
  EXPECT_NE(complaint(file("a.pcd") + " " + file("a.ply")).find("--cell"), std::string::npos);
}

TEST_F(CompareSurfacesTest, compares_on_the_coarser_grid_and_says_so) {
  const std::string fine = write(ripples(grid_, 0, 1), "fine.tif");
  const std::string coarse = write(ripples(GridGeometry(10, 20, 0.005, 120, 60), 0, 2), "coarse.tif");
  ASSERT_EQ(compare(fine + coarse).code, 0);
  EXPECT_EQ(figures()["cell_m"].as<double>(), 0.005);
  EXPECT_NE(figures()["remarks"][0].as<std::string>().find("resampled from cells of 0.002 m to 0.005 m"),
            std::string::npos);
}

TEST_F(CompareSurfacesTest, co_registers_and_says_what_it_removed) {
  HeightMap a = ripples(grid_, 0.0031, 1);
  for (float& z : a.layer(layer::elevation)) z += 0.004F;
  const std::string first = write(a, "a.tif");
  const std::string second = write(ripples(grid_, 0, 2), "b.tif");
  const Outcome run = compare(first + second + "--co-register shift --max-shift 0.01");
  ASSERT_EQ(run.code, 0) << run.err;
  const YAML::Node r = figures()["co_registration"];
  EXPECT_NEAR(r["moved_east_m"].as<double>(), -0.0031, 2e-5);
  EXPECT_NEAR(r["moved_up_m"].as<double>(), -0.004, 2e-5);
  EXPECT_NE(complaint(first + second + "--co-register shift --max-shift 0.001").find("more than 0.001 m"),
            std::string::npos);
}

TEST_F(CompareSurfacesTest, compares_profiles) {
  const auto profile = [&](double shift, double step, const std::string& name) {
    Table table{{"x_m", "z_m"}, {{}, {}}};
    for (int i = 0; i * step < 0.8; ++i) {
      table.columns[0].push_back(i * step);
      table.columns[1].push_back(0.003 * std::sin(2 * M_PI * (i * step - shift) / 0.06));
    }
    write_csv(table, file(name));
    return file(name) + " ";
  };
  const std::string a = profile(0.007, 0.001, "a.csv");
  const Outcome run = compare(a + profile(0, 0.002, "b.csv"));
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NEAR(figures()["displacement"]["first_from_second_m"].as<double>(), 0.007, 0.00007);
  EXPECT_NEAR(figures()["second_pattern"]["wavelength_m"].as<double>(), 0.06, 0.0003);
  EXPECT_NE(content_of(file("out/profiles.svg")).find("</svg>"), std::string::npos);
  EXPECT_GT(read_csv(file("out/difference.csv")).rows(), 390u);
  EXPECT_NE(complaint(a + write(ripples(grid_, 0, 1), "map.tif")).find("profiles are compared with profiles"),
            std::string::npos);
}

TEST_F(CompareSurfacesTest, refuses_what_cannot_be_compared_in_one_line) {
  const HeightMap map = ripples(grid_, 0, 1);
  const std::string a = write(map, "a.tif", "EPSG:32632");
  const auto says = [&](const std::string& arguments, const std::string& words) {
    const std::string line = complaint(arguments);
    EXPECT_NE(line.find(words), std::string::npos) << line;
    EXPECT_EQ(line.rfind("compare_surfaces: ", 0), 0u) << line;
    EXPECT_FALSE(std::ifstream(file("out/comparison.yaml")).good());
  };
  says(a + write(ripples(GridGeometry(50, 20, 0.002, 300, 150), 0, 1), "far.tif"), "do not overlap");
  says(a + write(map, "other.tif", "EPSG:32633"), "different projections or datums");
  save_map({map, "map", ros::Time(5)}, file("a.bag"), "/m");
  save_map({map, "odom", ros::Time(5)}, file("b.bag"), "/m");
  says(file("a.bag") + ":/m " + file("b.bag") + ":/m", "frame");
  HeightMap unknown(grid_);
  unknown.add(layer::elevation);
  says(a + write(unknown, "unknown.tif"), "no cell of 'elevation' is known");
  says(write(ripples(GridGeometry(10, 20, 0.002, 1, 1), 0, 1), "one.tif") + a, "at least 16");
  HeightMap half = map;
  for (std::size_t i = 0; i < half.geometry().size() / 2; ++i)
    half.layer(layer::elevation)[i] = HeightMap::unknown;
  HeightMap other = map;
  for (std::size_t i = half.geometry().size() / 2; i < half.geometry().size(); ++i)
    other.layer(layer::elevation)[i] = HeightMap::unknown;
  says(write(half, "half.tif") + write(other, "other_half.tif"), "0 cells are known in both surfaces");
  write_text_atomically(file("empty.csv"), "");
  says(a + file("empty.csv"), "empty.csv");
  says(a + file("none.tif"), "none.tif");
}

}  // namespace
}  // namespace aeolian
