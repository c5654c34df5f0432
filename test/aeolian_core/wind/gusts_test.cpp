#include "aeolian_core/wind/gusts.hpp"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

double variance(const std::vector<double>& values) {
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  double sum = 0;
  for (const double v : values) sum += (v - mean) * (v - mean);
  return sum / static_cast<double>(values.size());
}

// E1 of the wind spec.
TEST(GustSpectrum, ASineStandsAtItsFrequencyWithItsVariance) {
  std::vector<double> record(512);
  for (std::size_t i = 0; i < record.size(); ++i)
    record[i] = 5 + 0.002 * static_cast<double>(i) + std::sin(2 * M_PI * static_cast<double>(i) / 8);
  const GustSpectrum s = gust_spectrum(record, 1.0 / 8);
  std::size_t peak = 0;
  double sum = 0;
  for (std::size_t i = 0; i < s.density.size(); ++i) {
    if (s.density[i] > s.density[peak]) peak = i;
    sum += s.density[i] * s.spacing;
  }
  EXPECT_NEAR(s.frequency[peak], 1, s.spacing);
  EXPECT_NEAR(sum, 0.5, 0.01);
  EXPECT_NEAR(s.frequency.front(), 1.0 / 64, 1e-12);
  EXPECT_NEAR(s.frequency.back(), 4, 1e-12);
}

// E2.
TEST(Gusts, HaveKaimalsVariancesAndSlope) {
  for (const double speed : {5.0, 12.0}) {
    const GustSetting setting{speed, 3, 0.4, 0.02, 1U << 17};
    const Gusts g = synthetic_gusts(setting, 7);
    const GustComponent components[] = {GustComponent::along, GustComponent::across, GustComponent::up};
    const std::vector<double>* records[] = {&g.along, &g.across, &g.up};
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(std::sqrt(variance(*records[c])) / 0.4, kaimal_deviation(components[c]),
                  0.1 * kaimal_deviation(components[c]));
      // Least squares over a decade of the inertial range.
      const GustSpectrum s = gust_spectrum(*records[c], setting.step);
      double n = 0, x = 0, y = 0, xx = 0, xy = 0;
      for (std::size_t i = 0; i < s.density.size(); ++i) {
        const double f = s.frequency[i] * setting.height / speed;
        if (f < 1 || f > 10) continue;
        const double lx = std::log(s.frequency[i]);
        const double ly = std::log(s.density[i]);
        n += 1, x += lx, y += ly, xx += lx * lx, xy += lx * ly;
      }
      EXPECT_NEAR((n * xy - x * y) / (n * xx - x * x), -5.0 / 3, 0.15);
    }
  }
  EXPECT_NEAR(kaimal_deviation(GustComponent::along), 2.18, 0.01);
  EXPECT_NEAR(kaimal_deviation(GustComponent::across), 1.64, 0.01);
  EXPECT_NEAR(kaimal_deviation(GustComponent::up), 1.21, 0.02);
}

TEST(Gusts, AreDecidedByTheSeed) {
  const GustSetting setting{8, 2, 0.3, 0.05, 1000};
  EXPECT_EQ(synthetic_gusts(setting, 1).along, synthetic_gusts(setting, 1).along);
  EXPECT_NE(synthetic_gusts(setting, 1).along, synthetic_gusts(setting, 2).along);
  EXPECT_NE(synthetic_gusts(setting, 1).along, synthetic_gusts(setting, 1).up);
}

TEST(Gusts, RefuseWhatIsNotAllowed) {
  EXPECT_THROW(synthetic_gusts({0, 2, 0.3, 0.05, 1000}, 1), Error);
  EXPECT_THROW(synthetic_gusts({8, 0, 0.3, 0.05, 1000}, 1), Error);
  EXPECT_THROW(synthetic_gusts({8, 2, -1, 0.05, 1000}, 1), Error);
  EXPECT_THROW(synthetic_gusts({8, 2, 0.3, 0, 1000}, 1), Error);
  EXPECT_THROW(synthetic_gusts({8, 2, 0.3, 0.05, 3}, 1), Error);
  EXPECT_THROW(gust_spectrum({1, 2, 3}, 1), Error);
}

}  // namespace
}  // namespace aeolian
