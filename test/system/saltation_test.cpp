// saltation as people run it.
#include <cmath>
#include <fstream>

#include "program_outcome.hpp"
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "aeolian_core/saltation/saltation_table.hpp"
#include "aeolian_core/surface/csv.hpp"

namespace aeolian {
namespace {

TEST(SaltationTest, writes_summary_tables_and_pictures) {
  const TemporaryFolder folder;
  const Outcome run = run_program(
      "saltation --friction-velocity 0.75 --splash werner --case 1 --drag sphere "
      "--grain-density 2600 --air-density 1.23 --out " +
      folder.file("out"));
  ASSERT_EQ(run.code, 0) << run.err;
  const YAML::Node summary = YAML::LoadFile(folder.file("out/summary.yaml"));
  // Saltation specification, sec. 5.2.
  EXPECT_NEAR(summary["state"]["surface_friction_velocity_m_s"].as<double>() / 0.2615, 1, 0.015);
  EXPECT_NEAR(summary["state"]["mass_flux_kg_m_s"].as<double>() / 0.0651, 1, 0.015);
  EXPECT_NEAR(summary["thresholds"]["impact_threshold_m_s"].as<double>() / 0.2996, 1, 0.015);
  const Table profiles = read_csv(folder.file("out/profiles.csv"));
  double flux = 0;
  for (const double q : profiles.column("mass_flux_kg_m2_s"))
    flux += q * (profiles.column("height_m")[1] - profiles.column("height_m")[0]);
  EXPECT_NEAR(flux / summary["state"]["mass_flux_kg_m_s"].as<double>(), 1, 0.005);
  EXPECT_GT(read_csv(folder.file("out/wind.csv")).rows(), 100u);
  EXPECT_GT(read_csv(folder.file("out/launches.csv")).rows(), 10u);
  for (const char* picture : {"winds.svg", "heights.svg", "launches.svg"})
    EXPECT_NE(content_of(folder.file(std::string("out/") + picture)).find("</svg>"), std::string::npos)
        << picture;
}

TEST(SaltationTest, gusts_drive_the_flux) {
  const TemporaryFolder folder;
  std::ofstream wind(folder.file("wind.csv"));
  wind << "t_s,speed_m_s,direction_deg\n";
  for (int i = 0; i <= 40; ++i) wind << 0.25 * i << ',' << (i % 20 < 10 ? 12 : 2) << ",90\n";
  wind.close();
  const Outcome run = run_program("saltation --friction-velocity 0.5 --gusts " + folder.file("wind.csv") +
                                  " --out " + folder.file("out"));
  ASSERT_EQ(run.code, 0) << run.err;
  const Table gusts = read_csv(folder.file("out/gusts.csv"));
  ASSERT_EQ(gusts.rows(), 41u);
  const auto& steady = gusts.column("steady_flux_kg_m_s");
  const auto& relaxed = gusts.column("relaxed_flux_kg_m_s");
  EXPECT_GT(steady[5], 0);
  EXPECT_EQ(steady[15], 0);
  EXPECT_LT(relaxed[5], steady[5]);
  EXPECT_GT(relaxed[15], 0);
  EXPECT_GT(YAML::LoadFile(folder.file("out/summary.yaml"))["gusts"]["mean_relaxed_flux_kg_m_s"].as<double>(),
            0);
}

TEST(SaltationTest, a_mixture_is_told_by_size) {
  const TemporaryFolder folder;
  std::ofstream(folder.file("sizes.csv")) << "diameter_mm,share\n0.2,25\n0.25,50\n0.3,25\n";
  const Outcome run = run_program("saltation --friction-velocity 0.4 --mixture " + folder.file("sizes.csv") +
                                  " --out " + folder.file("out"));
  ASSERT_EQ(run.code, 0) << run.err;
  const YAML::Node all = YAML::LoadFile(folder.file("out/mixture.yaml"));
  const Table sizes = read_csv(folder.file("out/mixture.csv"));
  ASSERT_EQ(sizes.rows(), 3u);
  EXPECT_EQ(sizes.column("share")[1], 0.5);
  double flux = 0, stress = 0;
  for (std::size_t s = 0; s < sizes.rows(); ++s) {
    flux += sizes.column("mass_flux_kg_m_s")[s];
    stress += sizes.column("grain_stress_Pa")[s];
  }
  EXPECT_NEAR(flux / all["mass_flux_kg_m_s"].as<double>(), 1, 1e-5);
  const auto surface = all["surface_friction_velocity_m_s"].as<double>();
  EXPECT_NEAR(stress / (1.225 * (0.16 - surface * surface)), 1, 1e-4);
  // Sizes so close together move like the mean one.
  const YAML::Node mean = YAML::LoadFile(folder.file("out/summary.yaml"))["state"];
  EXPECT_NEAR(flux / mean["mass_flux_kg_m_s"].as<double>(), 1, 0.05);
}

TEST(SaltationTest, the_flux_of_a_place_is_told) {
  const TemporaryFolder folder;
  const std::string command = "saltation --friction-velocity 0.35 --out " + folder.file("out");
  const auto site = [&](const std::string& flags) {
    const Outcome run = run_program(command + flags);
    EXPECT_EQ(run.code, 0) << run.err;
    return YAML::LoadFile(folder.file("out/site.yaml"));
  };
  const auto value = [](const YAML::Node& node, const char* key) { return node[key].as<double>(); };
  const YAML::Node level = site(" --slope-deg 0");
  EXPECT_EQ(level["starts_without_grains_from_upwind"].as<std::string>(), "true");
  const YAML::Node short_plot = site(" --fetch-m 2.379591837");  // twice 2.2 d rho_s / rho
  EXPECT_NEAR(value(short_plot, "mass_flux_kg_m_s") / value(level, "mass_flux_kg_m_s"), 1 - std::exp(-2.0),
              1e-4);
  const YAML::Node rising = site(" --slope-deg 10");
  const double factor = std::sqrt(std::sin((33 + 10) * M_PI / 180) / std::sin(33 * M_PI / 180));
  EXPECT_NEAR(value(rising, "impact_threshold_m_s") / value(level, "impact_threshold_m_s"), factor, 1e-4);
  EXPECT_LT(value(rising, "mass_flux_kg_m_s"), value(level, "mass_flux_kg_m_s"));
  const YAML::Node damp = site(" --cohesion 0.005");
  EXPECT_EQ(damp["starts_without_grains_from_upwind"].as<std::string>(), "false");
  EXPECT_EQ(value(damp, "mass_flux_kg_m_s"), value(level, "mass_flux_kg_m_s"));
}

TEST(SaltationTest, grains_from_upwind_fly_higher_over_hard_ground) {
  const TemporaryFolder folder;
  const Outcome run =
      run_program("saltation --friction-velocity 0.5 --hard-ground-flux 0.01 --out " + folder.file("out"));
  ASSERT_EQ(run.code, 0) << run.err;
  const YAML::Node hard = YAML::LoadFile(folder.file("out/hard_ground.yaml"));
  const YAML::Node sand = YAML::LoadFile(folder.file("out/summary.yaml"))["state"];
  EXPECT_EQ(hard["outcome"].as<std::string>(), "steady");
  EXPECT_NEAR(hard["mass_flux_kg_m_s"].as<double>(), 0.01, 1e-4);
  EXPECT_GT(hard["mean_hop_height_m"].as<double>(), 2 * sand["mean_hop_height_m"].as<double>());
}

TEST(SaltationTest, too_weak_a_wind_is_a_result) {
  const TemporaryFolder folder;
  const Outcome run = run_program("saltation --friction-velocity 0.1 --out " + folder.file("out"));
  EXPECT_EQ(run.code, 0) << run.err;
  const YAML::Node state = YAML::LoadFile(folder.file("out/summary.yaml"))["state"];
  EXPECT_EQ(state["outcome"].as<std::string>(), "below_threshold");
  EXPECT_EQ(state["mass_flux_kg_m_s"].as<double>(), 0);
}

TEST(SaltationTest, the_shipped_table_is_that_of_the_default_splash) {
  const SaltationTable table = SaltationTable::read(AEOLIAN_REPOSITORY "/config/saltation/quartz_in_air.csv");
  EXPECT_LE(table.error(), 0.02);
  EXPECT_NEAR(table.state(0.4, 0.00025).mass_flux, 0.0346, 0.0007);
  EXPECT_NEAR(table.state(0.4, 0.00025).impact_angle_spread * 180 / M_PI, 8.45, 0.5);
}

TEST(SaltationTest, bad_input_is_told_by_flag_and_value) {
  const TemporaryFolder folder;
  const std::string out = " --out " + folder.file("out");
  const struct {
    const char* arguments;
    const char* says;
  } rows[] = {{"--friction-velocity -1", "--friction-velocity: -1"},
              {"--friction-velocity nan", "--friction-velocity: nan"},
              {"--friction-velocity 0.4 --splash foo", "--splash: 'foo'"},
              {"--friction-velocity 0.4 --splash table:absent.csv", "absent.csv"},
              {"--friction-velocity 0.4 --grain-diameter-mm 0", "--grain-diameter-mm"},
              {"--friction-velocity 0.4 --splash werner --case 9", "--case"},
              {"--friction-velocity 0.4 --mixture absent.csv", "absent.csv"},
              {"--friction-velocity 0.4 --splash werner --mixture absent.csv", "--mixture"},
              {"--friction-velocity 0.4 --gusts absent.csv", "absent.csv"},
              {"--friction-velocity 0.1 --gusts absent.csv", "--gusts"},
              {"--friction-velocity 0.4 --slope-deg 40", "--slope-deg: 40, must be between -33 and 33"},
              {"--friction-velocity 0.4 --slope-deg nan", "--slope-deg: nan"},
              {"--friction-velocity 0.1 --fetch-m 3", "needs a flux law"},
              {"--friction-velocity 0.4 --cohesion -1", "--cohesion"},
              {"--friction-velocity 0.4 --hard-ground-flux 0", "--hard-ground-flux"},
              {"--friction-velocity 0.4 --air-density 0", "--air-density"}};
  for (const auto& row : rows) {
    const Outcome run = run_program(std::string("saltation ") + row.arguments + out);
    EXPECT_EQ(run.code, 1) << row.arguments;
    EXPECT_NE((run.err + run.out).find(row.says), std::string::npos)
        << row.arguments << ": " << run.err << run.out;
  }
}

}  // namespace
}  // namespace aeolian
