#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "../../../error_of.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/grains/splash/beladjine.hpp"
#include "aeolian_core/grains/splash/composed_splash.hpp"
#include "aeolian_core/grains/splash/distribution_splash.hpp"
#include "aeolian_core/grains/splash/kok_renno.hpp"
#include "aeolian_core/grains/splash/laemmel.hpp"
#include "aeolian_core/grains/splash/splash_choice.hpp"
#include "aeolian_core/grains/splash/ungar_haff.hpp"
#include "aeolian_core/surface/degree.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

TEST(SplashFunctionsTest, no_event_has_more_energy_or_momentum_than_its_impact) {
  for (const std::string& name : splash_names())
    for (const std::string& material : splash_material_names()) {
      const auto splash = splash_of(name, material);
      RandomStream random(11, 1);
      SplashEvent event;
      for (int i = 0; i < 2000; ++i) {
        Impact impact{0.05 + 12 * random.uniform(), (2 + 86 * random.uniform()) * degree};
        impact.slope = (60 * random.uniform() - 30) * degree;
        impact.size_ratio = 0.3 + 2 * random.uniform();
        if (impact.angle_to_bed() < 1 * degree) continue;
        splash->sample(impact, random, event);
        ASSERT_LE(kinetic_energy(event), kinetic_energy(impact) * (1 + 1e-9)) << name;
        ASSERT_LE(momentum_along(impact, event), momentum(impact) * (1 + 1e-9)) << name;
        for (const LeavingGrain& grain : event.ejecta) ASSERT_TRUE(grain.velocity.allFinite()) << name;
      }
    }
}

TEST(SplashFunctionsTest, a_seed_decides_the_draws) {
  for (const std::string& name : splash_names()) {
    const auto splash = splash_of(name, "fine_sand");
    RandomStream one(4, 2), two(4, 2), other(5, 2);
    double a = 0, b = 0, c = 0;
    for (int i = 0; i < 50; ++i) {
      a += kinetic_energy(splash->sample({4, 0.2}, one));
      b += kinetic_energy(splash->sample({4, 0.2}, two));
      c += kinetic_energy(splash->sample({4, 0.2}, other));
    }
    EXPECT_EQ(a, b) << name;
    if (name == "beladjine") continue;  // whose rebound is the same each time
    EXPECT_NE(a, c) << name;
  }
}

TEST(SplashFunctionsTest, bad_impacts_are_refused_by_name) {
  const auto splash = splash_of("kok_renno", "fine_sand");
  const auto refusal = [&](const Impact& impact) {
    RandomStream random(1, 1);
    return error_of([&] { splash->sample(impact, random); });
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double speed : {0.0, -1.0, nan, std::numeric_limits<double>::infinity()})
    EXPECT_NE(refusal({speed, 0.2}).find("impact: speed is"), std::string::npos) << speed;
  for (const double angle : {0.0, -0.1, 3.2, nan})
    EXPECT_NE(refusal({1, angle}).find("angle to the bed"), std::string::npos) << angle;
  Impact impact{1, 0.2};
  impact.size_ratio = 0;
  EXPECT_EQ(refusal(impact), "impact: size ratio is 0, must be positive and finite");
  impact = {1, 2.0};
  impact.slope = -1.6;
  EXPECT_NE(refusal(impact).find("slope"), std::string::npos);
}

TEST(SplashFunctionsTest, unknown_names_are_refused_with_those_there_are) {
  const std::string told = error_of([] { splash_of("owen", "fine_sand"); });
  EXPECT_NE(told.find("splash is 'owen', must be one of werner, "), std::string::npos) << told;
  EXPECT_THROW(splash_of("distribution_7", "fine_sand"), Error);
  EXPECT_THROW(splash_of("werner", "gravel"), Error);
  EXPECT_THROW(ComposedSplash(nullptr, nullptr), Error);
  EXPECT_THROW(BeladjineEjection(Grain{}, -1), Error);
  EXPECT_THROW(UngarHaffEjection(Grain{}, 0), Error);
  EXPECT_THROW(LaemmelRebound({0, 0}), Error);
  EXPECT_THROW(DistributionSplash::thesis_case(0), Error);
}

TEST(KokRennoTest, rebounds_and_ejecta_have_the_published_means) {
  const Grain grain;
  const KokRennoEjection ejection(grain);
  const double unit = std::sqrt(gravity * grain.diameter);
  Impact impact{2, 12 * degree};
  EXPECT_NEAR(ejection.mean_number(impact), 0.02 * 2 / unit, 1e-12);
  impact.size_ratio = 2;
  EXPECT_NEAR(ejection.mean_number(impact), 0.08 / unit, 1e-12);
  EXPECT_NEAR(ejection.mean_speed(100), 7.5 * unit, 1e-12);

  const KokRennoRebound rebound;
  RandomStream random(1, 1);
  const int count = 40000;
  int rebounds = 0;
  double energy = 0;
  for (int i = 0; i < count; ++i)
    if (const auto leaves = rebound.sample({2, 0.2}, random)) {
      ++rebounds;
      energy += leaves->velocity.squaredNorm() / 4;
    }
  EXPECT_NEAR(static_cast<double>(rebounds) / count, 0.96 * (1 - std::exp(-2)), 4 * 0.4 / std::sqrt(count));
  EXPECT_NEAR(energy / rebounds, 0.45, 0.006);
}

TEST(LaemmelTest, rebounds_of_beads_are_those_measured) {  // Beladjine et al. (2007), 10 and 20 degrees
  const LaemmelRebound rebound;
  EXPECT_NEAR(rebound.restitution(10 * degree, 1), 0.77, 0.08);
  EXPECT_NEAR(rebound.restitution(20 * degree, 1), 0.61, 0.06);
}

TEST(LaemmelTest, elevations_follow_the_published_density) {
  // p(out | in) = gamma (in + out) / in ln(2 in / (gamma (in + out)^2)), integrated to its distribution.
  const double in = 15 * degree, epsilon = 0.7, nu = -0.15;
  const double mu = epsilon / (1 + epsilon), alpha = (1 + epsilon) / (1 + mu) - 1;
  const double beta = 1 - 2.0 / 7 * (1 - nu) / (1 + mu);
  const double gamma = 4.0 / 9 * beta / (alpha + beta) * beta / (alpha + beta);
  const auto up_to = [&](double out) {
    const double w = gamma * (in + out) * (in + out) / (2 * in);
    return w >= 1 ? 1 : w * (1 - std::log(w));
  };
  const LaemmelRebound rebound;
  RandomStream random(1, 1);
  const int count = 40000;
  std::vector<int> below(4);
  const double elevations[] = {0, 20, 40, 60};
  for (int i = 0; i < count; ++i) {
    const auto leaves = rebound.sample({1, in}, random);
    const double out = leaves ? std::atan2(leaves->velocity.z(), leaves->velocity.x()) : -1;
    for (std::size_t k = 0; k < 4; ++k) below[k] += out <= elevations[k] * degree ? 1 : 0;
  }
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_NEAR(static_cast<double>(below[k]) / count, up_to(elevations[k] * degree),
                4 * 0.5 / std::sqrt(count))
        << elevations[k];
}

TEST(LaemmelTest, ejecta_of_beads_are_those_measured) {  // Beladjine et al. (2007), 26 m/s
  Grain beads;
  beads.diameter = 0.006;
  const LaemmelEjection ejection(beads);
  const Impact impact{26, 20 * degree};
  EXPECT_NEAR(ejection.mean_number(impact), 14, 2.8);
  EXPECT_NEAR(ejection.mean_speed(impact), 0.86, 0.086);
  RandomStream random(1, 1);
  std::vector<LeavingGrain> ejecta;
  for (int i = 0; i < 2000; ++i) ejection.sample(impact, random, ejecta);
  double speed = 0;
  for (const LeavingGrain& grain : ejecta) {
    speed += grain.velocity.norm();
    ASSERT_GE(grain.velocity.squaredNorm(), 2 * gravity * beads.diameter * (1 - 1e-9));
  }
  EXPECT_NEAR(static_cast<double>(ejecta.size()) / 2000, ejection.mean_number(impact), 0.4);
  EXPECT_NEAR(speed / static_cast<double>(ejecta.size()), ejection.mean_speed(impact), 0.03);
  EXPECT_EQ(ejection.mean_number({0.1, 0.2}), 0);
}

TEST(BeladjineTest, restitutions_and_numbers_are_those_of_the_formulas) {
  Grain beads;
  beads.diameter = 0.006;
  const BeladjineEjection ejection(beads);
  // The specification's own evaluation, with a unit speed rounded to 0.2426 m/s.
  const double angles[] = {10, 20, 40, 60, 90}, numbers[] = {9.7, 13.3, 18.2, 20.5, 21.3};
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_NEAR(ejection.mean_number({26, angles[i] * degree}), numbers[i], 0.1);
  EXPECT_EQ(ejection.mean_number({40 * std::sqrt(gravity * 0.006) * 0.999, 0.3}), 0);
  RandomStream random(1, 1);
  const auto leaves = BeladjineRebound().sample({10, 30 * degree}, random);
  EXPECT_NEAR(leaves->velocity.norm(), 10 * (0.87 - 0.36), 1e-12);
  EXPECT_NEAR(leaves->velocity.z(), 10 * 0.5 * (0.6 - 0.15), 1e-12);
}

TEST(DistributionSplashTest, numbers_are_normalised_as_the_formula) {
  RandomStream random(1, 1);
  const Impact impact{3.3, 12 * degree};
  const DistributionSplash splash(DistributionSplash::thesis_case(2), DistributionSplash::Balance::mean);
  const double along = 3.3 * std::cos(12 * degree);
  EXPECT_NEAR(splash.mean_rebounds(impact), 2 * along / (along + 2.75), 1e-12);
  EXPECT_NEAR(splash.mean_ejecta(impact), 0.2 * 0.4 * 3.3 * 3.3, 1e-12);
  const int count = 40000;
  double grains = 0;
  for (int i = 0; i < count; ++i) {
    const SplashEvent event = splash.sample(impact, random);
    grains += static_cast<double>(event.ejecta.size()) + (event.rebound ? 1 : 0);
  }
  // Rebounds whose normal upward speed is below zero do not leave.
  const double peak = 0.1 * along + 0.7 * 3.3 * std::sin(12 * degree);
  const double upward = std::erfc(-peak / 0.35 / M_SQRT2) / 2;
  EXPECT_NEAR(grains / count, upward * splash.mean_rebounds(impact) + splash.mean_ejecta(impact), 0.025);
}

TEST(DistributionSplashTest, cases_five_and_six_keep_horizontal_speed) {
  RandomStream random(1, 1);
  const DistributionSplash splash(DistributionSplash::thesis_case(6), DistributionSplash::Balance::mean);
  for (int i = 0; i < 100; ++i)
    for (const LeavingGrain& grain : splash.sample({3, 10 * degree}, random).ejecta)
      EXPECT_NEAR(grain.velocity.x(), 0.3 * 0.9 * 3 * std::cos(10 * degree), 1e-12);
}

TEST(UngarHaffTest, number_grows_as_energy_and_all_leave_alike) {
  const UngarHaffEjection ejection{Grain{}};
  EXPECT_NEAR(ejection.mean_number({2.5, 0.2}), 1, 0.005);  // eq. 4.34, case 4: c3 c4 v^2
  EXPECT_NEAR(ejection.mean_number({5, 0.2}) / ejection.mean_number({2.5, 0.2}), 4, 1e-12);
  std::vector<LeavingGrain> ejecta;
  RandomStream random(1, 1);
  ejection.sample({5, 0.2}, random, ejecta);
  ASSERT_GE(ejecta.size(), 3U);
  for (const LeavingGrain& grain : ejecta) EXPECT_NEAR(grain.velocity.z(), 0.80, 0.001);
}

TEST(ConservationTest, grains_that_do_not_fit_are_left_out_in_order) {
  SplashEvent event;
  event.rebound = LeavingGrain{{0.8, 0, 0.2}, 1, 0, Origin::rebound};
  event.ejecta = {{{0, 0, 0.7}}, {{0, 0, 0.3}}, {{0.5, 0, 0.5}}};
  const Impact impact{1, 0.2};
  EXPECT_FALSE(within_impact(event, impact));
  drop_beyond_impact(event, impact);
  EXPECT_TRUE(within_impact(event, impact));
  ASSERT_EQ(event.ejecta.size(), 1U);
  EXPECT_EQ(event.ejecta[0].velocity.z(), 0.3);
}

TEST(ConservationTest, momentum_along_the_path_is_limited_too) {
  SplashEvent event;  // little energy, but many grains that all go forward
  for (int i = 0; i < 30; ++i) event.ejecta.push_back({{0.05, 0, 0.001}});
  EXPECT_LT(kinetic_energy(event), kinetic_energy(Impact{1, 0.2}));
  EXPECT_FALSE(within_impact(event, {1, 0.2}));
  drop_beyond_impact(event, {1, 0.2});
  EXPECT_EQ(event.ejecta.size(), 20U);
}

}  // namespace
}  // namespace aeolian
