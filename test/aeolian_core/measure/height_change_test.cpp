#include "aeolian_core/measure/height_change.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

// A sinusoid of 5 mm height and 10 cm wavelength at 3 cm / min: the rms of its rate, by hand.
TEST(HeightChange, HasTheRateOfMigratingRipples) {
  const HeightChange change = HeightChange::of_ripples(0.0005, 0.1, 0.005);
  const double frequency = 2 * M_PI * 0.0005 / 0.1;
  EXPECT_NEAR(change.rate_sigma, frequency * 0.0025 / std::sqrt(2.0), 1e-15);
  EXPECT_NEAR(change.rate_sigma, HeightChange().rate_sigma, 1e-6);
  EXPECT_NEAR(change.rate_time, HeightChange().rate_time, 1);
  EXPECT_THROW(HeightChange::of_ripples(0, 0.1, 0.005), Error);
}

/// Two steps after one another.
HeightStep chain(const HeightStep& a, const HeightStep& b) {
  HeightStep c;
  const double l = b.height_per_rate;
  const double k = b.rate_kept;
  c.height_per_rate = a.height_per_rate + l * a.rate_kept;
  c.rate_kept = a.rate_kept * k;
  c.height_variance = a.height_variance + 2 * l * a.covariance + l * l * a.rate_variance + b.height_variance;
  c.covariance = k * (a.covariance + l * a.rate_variance) + b.covariance;
  c.rate_variance = k * k * a.rate_variance + b.rate_variance;
  return c;
}

TEST(HeightChange, StepsFollowOneAnother) {
  const HeightChange change{2e-5, 50};
  for (const double seconds : {0.001, 0.4, 1.2, 30.0, 400.0}) {
    const HeightStep half = height_step(change, seconds / 2);
    const HeightStep twice = chain(half, half);
    const HeightStep whole = height_step(change, seconds);
    EXPECT_NEAR(twice.height_per_rate / whole.height_per_rate, 1, 1e-9) << seconds;
    EXPECT_NEAR(twice.rate_kept, whole.rate_kept, 1e-12) << seconds;
    EXPECT_NEAR(twice.height_variance / whole.height_variance, 1, 1e-5) << seconds;
    EXPECT_NEAR(twice.covariance / whole.covariance, 1, 1e-9) << seconds;
    EXPECT_NEAR(twice.rate_variance / whole.rate_variance, 1, 1e-9) << seconds;
  }
}

TEST(HeightChange, EndsInAStationaryRateAndADiffusingHeight) {
  const HeightChange change{2e-5, 50};
  const HeightStep step = height_step(change, 1e5);
  EXPECT_NEAR(step.rate_variance, 4e-10, 1e-18);
  EXPECT_NEAR(step.height_variance / (2 * 4e-10 * 50 * 1e5), 1, 1e-3);
}

}  // namespace
}  // namespace aeolian
