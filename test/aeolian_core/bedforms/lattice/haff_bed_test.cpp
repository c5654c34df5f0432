#include "aeolian_core/bedforms/lattice/haff_bed.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "../../../error_of.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/bedforms/theory/periodic_profile.hpp"
#include "aeolian_core/surface/degree.hpp"

namespace aeolian {
namespace {

HaffParameters limited() {
  HaffParameters parameters;
  parameters.steepest_stoss = 10 * degree;
  return parameters;
}

double steep_rise(const HaffBed& bed) { return upslope_quantile(bed.heights(), 4, 0.9) / degree; }

TEST(HaffBedTest, a_stoss_climbs_to_repose_unless_it_is_limited) {
  HaffBed bed({}, 1);
  bed.advance(95);
  EXPECT_EQ(bed.impacts(), 95 * 4000);
  EXPECT_GT(steep_rise(bed), 26);
  HaffBed limited_bed(limited(), 1);
  limited_bed.advance(95);
  EXPECT_LT(steep_rise(limited_bed), 18);
}

TEST(HaffBedTest, ripples_grow_as_specified_and_merge_without_end) {
  HaffBed bed({}, 1);
  bed.advance(30);
  const double young = mean_wavelength(bed.heights(), 4);
  EXPECT_NEAR(young / 150, 1, 0.2);
  bed.advance(65);
  EXPECT_NEAR(mean_wavelength(bed.heights(), 4) / 235, 1, 0.2);
  bed.advance(205);
  EXPECT_GT(mean_wavelength(bed.heights(), 4), 2 * young);
}

TEST(HaffBedTest, grains_are_conserved_and_nothing_is_steeper_than_repose) {
  for (const HaffParameters& parameters : {HaffParameters{}, limited()}) {
    HaffBed bed(parameters, 3);
    for (int i = 0; i < 10; ++i) {
      bed.advance(2.5);
      const std::vector<int>& grains = bed.grains();
      EXPECT_EQ(std::accumulate(grains.begin(), grains.end(), 0), 0);
      for (std::size_t j = 0; j < grains.size(); ++j) {
        const double rise = (grains[(j + 1) % grains.size()] - grains[j]) / 4.0;
        ASSERT_LE(std::abs(rise) / 4, std::tan(30 * degree));
      }
    }
  }
}

TEST(HaffBedTest, a_given_bed_slides_to_repose) {
  HaffParameters parameters;
  parameters.bins = 20;
  std::vector<int> grains(20);
  grains[3] = 1000;
  const HaffBed bed(parameters, grains, 1, 0);
  EXPECT_EQ(std::accumulate(bed.grains().begin(), bed.grains().end(), 0), 1000);
  for (std::size_t i = 0; i < 20; ++i)
    EXPECT_LE(std::abs(bed.grains()[(i + 1) % 20] - bed.grains()[i]), 16 * std::tan(30 * degree));
  EXPECT_EQ(bed.moved(), 0);
  EXPECT_EQ(error_of([&] {
              HaffBed(parameters, {1, 2}, 1, 0);
            }),
            "Haff's bed: grains are given for 2 bins, must be for 20");
}

TEST(HaffBedTest, a_run_depends_on_its_seed_only) {
  HaffBed at_once({}, 1), in_parts({}, 1), other({}, 2);
  at_once.advance(3);
  for (int i = 0; i < 3; ++i) in_parts.advance(1);
  other.advance(3);
  EXPECT_EQ(at_once.grains(), in_parts.grains());
  EXPECT_NE(at_once.grains(), other.grains());
}

TEST(HaffBedTest, refuses_parameters_without_a_bed) {
  const auto error = [](auto change) {
    HaffParameters parameters;
    change(parameters);
    return error_of([&] { HaffBed(parameters, 1); });
  };
  EXPECT_EQ(error([](auto& p) { p.bins = 2; }),
            "Haff's bed: number of bins is 2, must be from 3 to 10 million");
  EXPECT_EQ(error([](auto& p) { p.bin_length = 0; }), "Haff's bed: bin length [d] is 0, must be above 0");
  EXPECT_EQ(error([](auto& p) { p.reptation_length = 4000; }),
            "Haff's bed: reptation length [d] is 4000, must be from one bin to below the length of the bed");
  EXPECT_EQ(error([](auto& p) { p.impact_angle = NAN; }),
            "Haff's bed: impact angle [rad] is nan, must be between 0 and pi / 2");
  EXPECT_EQ(error([](auto& p) { p.angle_of_repose = -1; }),
            "Haff's bed: angle of repose [rad] is -1, must be between 0 and pi / 2");
  EXPECT_EQ(error([](auto& p) { p.steepest_stoss = 2; }),
            "Haff's bed: steepest stoss [rad] is 2, must be between 0 and pi / 2");
  EXPECT_EQ(error([](auto& p) { p.bin_length = 1; }),
            "Haff's bed: bin length [d] is 1, must be so long that one grain more than in the next bin "
            "is below repose");
  EXPECT_EQ(error_of([] { HaffBed({}, 1).advance(-1); }),
            "Haff's bed: number of impacts per diameter is -1, must be zero or more and finite");
}

TEST(PeriodicProfileTest, finds_wavelength_and_steep_rises) {
  std::vector<double> wave, teeth;
  for (int i = 0; i < 200; ++i) {
    wave.push_back(std::sin(2 * M_PI * i / 25));
    teeth.push_back(i % 10);
  }
  EXPECT_NEAR(mean_wavelength(wave, 2), 50, 1e-9);
  EXPECT_NEAR(upslope_quantile(teeth, 2, 0.9), std::atan(0.5), 1e-12);
  EXPECT_EQ(upslope_quantile({1, 1, 1}, 1, 0.9), 0);
  EXPECT_EQ(error_of([] {
              mean_wavelength({1, 1, 1, 1}, 1);
            }),
            "profile: too short or flat, it has no wavelength");
}

}  // namespace
}  // namespace aeolian
