#include "aeolian_core/saltation/saltation_table.hpp"

#include <cmath>
#include <fstream>
#include <limits>

#include "../../temporary_folder.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/saltation/kok_renno_kernel.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

std::unique_ptr<SplashKernel> splash(const SaltatingBed& bed) {
  return std::make_unique<KokRennoKernel>(bed.grain, bed.atmosphere, KokRennoConstants{}, 3, 8);
}

const SaltationTable& small_table() {
  static const SaltationTable table =
      SaltationTable::build({}, splash, {0.0002, 0.00025, 0.0003}, {1.05, 1.2, 1.5, 2, 3});
  return table;
}

TEST(SaltationTableTest, error_is_within_its_budget_and_true) {
  EXPECT_GT(small_table().error(), 0);
  EXPECT_LT(small_table().error(), 0.02);
  SaltatingBed bed;
  bed.grain.diameter = 0.000275;
  const SteadyState s = SaltationSolver(bed, *splash(bed)).solve(0.41);
  const SaltationState t = small_table().state(0.41, 0.000275);
  EXPECT_NEAR(t.mass_flux / s.mass_flux(), 1, 0.02);
  EXPECT_NEAR(t.surface_friction_velocity / s.surface_friction_velocity, 1, 0.01);
  EXPECT_NEAR(t.hop_length / s.mean(s.landings.length), 1, 0.02);
  EXPECT_NEAR(t.apparent_roughness / s.wind.apparent_roughness(), 1, 0.07);
  EXPECT_NEAR(small_table().law(0.000275).flux(0.41) / s.mass_flux(), 1, 0.03);
}

TEST(SaltationTableTest, a_summary_knows_how_far_impact_angles_spread) {
  const SaltatingBed bed;
  const SteadyState s = SaltationSolver(bed, *splash(bed)).solve(0.4);
  const SaltationState state = summary(s, 0.2);
  double number = 0;
  double square = 0;
  for (std::size_t k = 0; k < s.launches.number.size(); ++k) {
    const double apart = std::atan2(s.landings.vy[k], s.landings.vx[k]) - state.impact_angle;
    if (!(s.launches.number[k] > 0)) continue;
    number += s.launches.number[k];
    square += s.launches.number[k] * apart * apart;
  }
  EXPECT_NEAR(state.impact_angle_spread, std::sqrt(square / number), 1e-9);
  EXPECT_GT(state.impact_angle_spread, 0.01);
  EXPECT_LT(state.impact_angle_spread, state.impact_angle * 2);
}

TEST(SaltationTableTest, nothing_moves_up_to_the_threshold_and_flux_rises_from_it) {
  const double threshold = small_table().state(0.1, 0.00025).impact_threshold;
  EXPECT_EQ(small_table().state(threshold, 0.00025).mass_flux, 0);
  EXPECT_EQ(small_table().state(threshold, 0.00025).impact_rate, 0);
  double last = 0;
  for (double u = 1.001 * threshold; u < 5; u *= 1.02) {
    const SaltationState s = small_table().state(u, 0.00025);
    EXPECT_GT(s.mass_flux, last) << u;
    EXPECT_LE(s.surface_friction_velocity, threshold * 1.001) << u;
    last = s.mass_flux;
  }
}

TEST(SaltationTableTest, reads_back_what_it_wrote) {
  const TemporaryFolder folder;
  const std::string path = folder.file("table.csv");
  small_table().write(path);
  const SaltationTable read = SaltationTable::read(path);
  EXPECT_EQ(read.error(), small_table().error());
  for (const double u : {0.1, 0.25, 0.5, 2.0}) {
    EXPECT_DOUBLE_EQ(read.state(u, 0.00022).mass_flux, small_table().state(u, 0.00022).mass_flux);
    EXPECT_NEAR(read.state(u, 0.00022).impact_angle, small_table().state(u, 0.00022).impact_angle, 1e-12);
  }
}

TEST(SaltationTableTest, refuses_what_is_not_a_table) {
  const TemporaryFolder folder;
  const std::string path = folder.file("table.csv");
  std::ofstream(path) << "diameter_m,ratio\n0.0002,1.1\n";
  EXPECT_THROW(SaltationTable::read(path), Error);
  small_table().write(path);
  std::string text = content_of(path);
  text.replace(text.rfind("\n"), 1, "0\n1");
  std::ofstream(path) << text;
  EXPECT_THROW(SaltationTable::read(path), Error);
  EXPECT_THROW(SaltationTable::read(folder.file("absent.csv")), Error);
}

TEST(SaltationTableTest, refuses_what_is_outside) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(small_table().state(-1, 0.00025), Error);
  EXPECT_THROW(small_table().state(nan, 0.00025), Error);
  EXPECT_THROW(small_table().state(0.4, 0.001), Error);
  EXPECT_THROW(small_table().law(nan), Error);
  EXPECT_THROW(SaltationTable::build({}, splash, {0.0002}, {1.1, 2}), Error);
  EXPECT_THROW(SaltationTable::build({}, splash, {0.0002, 0.0003}, {0.9, 2}), Error);
}

TEST(FluxLawTest, fit_returns_the_law_that_made_the_points) {
  const FluxLaw law{0.2, 0.25, 0.08};
  std::vector<double> u, flux;
  for (double x = 0.22; x < 1; x += 0.1) u.push_back(x), flux.push_back(law.flux(x));
  const FluxLaw fit = FluxLaw::fit(0.2, u, flux);
  EXPECT_NEAR(fit.amplitude, 0.25, 1e-12);
  EXPECT_NEAR(fit.correction, 0.08, 1e-12);
  EXPECT_EQ(fit.flux(0.2), 0);
  EXPECT_EQ(fit.flux(std::nan("")), 0);
  EXPECT_THROW(FluxLaw::fit(0.3, u, flux), Error);
  EXPECT_THROW(FluxLaw::fit(0.2, {0.3}, {1}), Error);
}

}  // namespace
}  // namespace aeolian
