#include <cmath>
#include <memory>

#include "thesis_bed.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/grains/splash/composed_splash.hpp"
#include "aeolian_core/grains/splash/kok_renno.hpp"
#include "aeolian_core/saltation/kok_renno_kernel.hpp"
#include "aeolian_core/saltation/sampled_kernel.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

/// The spectrum of one impact.
std::vector<double> one_impact(const SplashKernel& kernel, double vx, double vy) {
  Landings landings;
  landings.resize(1);
  landings.vx[0] = vx;
  landings.vy[0] = vy;
  std::vector<double> spectrum;
  kernel.splash({{0}, {1}, {1}}, 0, landings, spectrum);
  return spectrum;
}

TEST(DistributionKernelTest, numbers_are_the_integrals_of_the_formula) {
  const auto p = DistributionSplash::thesis_case(2);
  const DistributionKernel kernel(p, 0.05, 6);
  const auto spectrum = one_impact(kernel, 3, 0.6);
  double expected = 0;
  const double step = 1e-4;
  for (double v = 0.5 * step; v < 6; v += step) {
    const double z = (v - p.conversion * 3 - p.restitution * 0.6) / p.c2;
    expected += step * (p.c1 / (p.c2 * std::sqrt(2 * M_PI)) * 3 / (3 + p.c5) * std::exp(-0.5 * z * z) +
                        p.c3 * (9 + 0.36) * std::exp(-v / p.c4));
  }
  EXPECT_NEAR(kernel.number(spectrum), expected, 1e-4);
}

TEST(DistributionKernelTest, launches_keep_the_mean_forward_velocity) {
  const DistributionKernel kernel = thesis_splash(6);
  Launches launches;
  kernel.launch(one_impact(kernel, 3, 0.6), launches);
  for (std::size_t k = 0; k < launches.size(); ++k)
    if (launches.number[k] > 1e-9) {
      EXPECT_NEAR(launches.vx[k], 0.3 * 0.9 * 3, 1e-9);
    }
}

TEST(KernelTest, spectra_are_linear_in_the_impacts) {
  const Grain grain;
  const KokRennoKernel kernel(grain, {});
  const auto a = one_impact(kernel, 1, 0.2);
  const auto b = one_impact(kernel, 3, 0.7);
  Landings landings;
  landings.resize(2);
  landings.vx = {1, 3};
  landings.vy = {0.2, 0.7};
  std::vector<double> both;
  kernel.splash({{0, 0}, {1, 1}, {2, 0.5}}, 0, landings, both);
  for (std::size_t i = 0; i < both.size(); ++i) EXPECT_NEAR(both[i], 2 * a[i] + 0.5 * b[i], 1e-12);
}

/// The kernel against the same splash drawn one by one, in its number and its energy.
TEST(KokRennoKernelTest, agrees_with_draws_of_the_same_splash) {
  const Grain grain;
  KokRennoConstants constants;
  constants.ejecta_momentum = 0.15;
  constants.steepest = M_PI;
  constants.slowest = 0.02;
  const KokRennoKernel kernel(grain, {}, constants, 16, 40);
  const KokRennoRebound rebound;
  const KokRennoEjection ejection(grain);
  for (const double v : {0.8, 2.0, 4.0}) {
    const Impact impact{v, 0.2};
    RandomStream random(3, 1);
    double number = 0, energy = 0;
    const int draws = 40000;
    std::vector<LeavingGrain> ejecta;
    for (int n = 0; n < draws; ++n) {
      ejecta.clear();
      ejection.sample(impact, random, ejecta);
      if (const auto grain_back = rebound.sample(impact, random)) ejecta.push_back(*grain_back);
      number += static_cast<double>(ejecta.size()) / draws;
      for (const LeavingGrain& g : ejecta) energy += g.velocity.squaredNorm() / draws;
    }
    Launches launches;
    kernel.launch(one_impact(kernel, v * std::cos(0.2), v * std::sin(0.2)), launches);
    double ours = 0, our_energy = 0;
    for (std::size_t k = 0; k < launches.size(); ++k) {
      ours += launches.number[k];
      our_energy += launches.number[k] * (std::pow(launches.vx[k], 2) + std::pow(launches.vy[k], 2));
    }
    EXPECT_NEAR(ours / number, 1, 0.03) << v;
    EXPECT_NEAR(our_energy / energy, 1, 0.03) << v;
  }
}

TEST(SampledKernelTest, is_the_same_for_the_same_seed_and_near_the_exact_one) {
  // Case 5 has two components and an exact kernel.
  const SaltatingBed bed = thesis_bed();
  const auto splash = std::make_shared<DistributionSplash>(DistributionSplash::thesis_case(5),
                                                           DistributionSplash::Balance::mean);
  SplashSampling sampling;
  sampling.events = 300;
  const SampledKernel one(splash, "case 5", bed.grain, bed.atmosphere, sampling);
  const SampledKernel two(splash, "case 5", bed.grain, bed.atmosphere, sampling);
  EXPECT_EQ(one_impact(one, 3, 0.5), one_impact(two, 3, 0.5));
  const SteadyState sampled = SaltationSolver(bed, one).solve(1);
  const SteadyState exact = SaltationSolver(bed, thesis_splash(5)).solve(1);
  ASSERT_TRUE(sampled.steady());
  EXPECT_NEAR(sampled.surface_friction_velocity / exact.surface_friction_velocity, 1, 0.03);
  EXPECT_NEAR(sampled.mass_flux() / exact.mass_flux(), 1, 0.05);
}

TEST(SampledKernelTest, splashes_that_conserve_give_less_than_those_that_do_not) {
  const SaltatingBed bed;
  const auto splash = std::make_shared<ComposedSplash>(std::make_shared<KokRennoRebound>(),
                                                       std::make_shared<KokRennoEjection>(bed.grain));
  SplashSampling sampling;
  sampling.events = 200;
  const SampledKernel conserving(splash, "kok_renno", bed.grain, bed.atmosphere, sampling);
  const SteadyState s = SaltationSolver(bed, conserving).solve(0.4);
  const SteadyState free = SaltationSolver(bed, KokRennoKernel(bed.grain, bed.atmosphere)).solve(0.4);
  ASSERT_TRUE(s.steady());
  EXPECT_LT(s.mass_flux(), free.mass_flux());
  EXPECT_NEAR(s.mass_flux() / 0.02977, 1, 0.08);  // the prototype's, saltation specification sec. 7
}

TEST(KernelTest, refuse_what_is_not_physical) {
  const Grain grain;
  KokRennoConstants constants;
  constants.energy_kept = 1.5;
  EXPECT_THROW(KokRennoKernel(grain, {}, constants), Error);
  EXPECT_THROW(KokRennoKernel(grain, {}, {}, 0), Error);
  SplashSampling sampling;
  sampling.events = 0;
  EXPECT_THROW(SampledKernel(std::make_shared<DistributionSplash>(DistributionSplash::thesis_case(1)), "",
                             grain, {}, sampling),
               Error);
}

}  // namespace
}  // namespace aeolian
