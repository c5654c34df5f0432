#include <cmath>

#include "synthetic_profile.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

using namespace synthetic;
using Event = ProfileSeries::Event;

constexpr double length = 0.27;
constexpr double interval = 60;

/// A series of photographs of a bed z(x, t), `interval` apart.
template <class Bed>
std::vector<ProfileAnalysis> photographs(int count, double noise, std::uint64_t seed, double downwind,
                                         Bed&& bed) {
  std::vector<ProfileAnalysis> analyses;
  for (int i = 0; i < count; ++i) {
    ShadowProfile profile = profile_of([&](double x) { return bed(x, i * interval); }, length, grain);
    profile.grain_diameter = grain;
    profile.downwind = downwind;
    add_noise(profile, noise, 100 * seed + static_cast<std::uint64_t>(i));
    analyses.push_back(analyse(profile));
  }
  return analyses;
}

std::vector<double> times(std::size_t count) {
  std::vector<double> t;
  for (std::size_t i = 0; i < count; ++i) t.push_back(1000 + interval * static_cast<double>(i));
  return t;
}

double sine(double x) { return 0.002 * std::sin(2 * M_PI * x / 0.07); }

TEST(ProfileSeries, SpeedOfATranslatingSine) {
  for (const double wind : {1.0, -1.0}) {
    const auto analyses = photographs(
        10, 0.1e-3, 1, wind, [&](double x, double t) { return sine(x - wind * 1e-4 * t) + 0.02 * x; });
    const auto series = analyse_series(analyses, times(10));
    ASSERT_EQ(series.steps.size(), 9u);
    EXPECT_NEAR(series.steps[0].time, 0.5 * interval, 1e-9);
    EXPECT_NEAR(series.migration.value, 1e-4, 1e-6);
    EXPECT_LT(series.migration.sigma, 1e-6);
    EXPECT_NEAR(series.growth.value, 0, 4 * series.growth.sigma);
    EXPECT_TRUE(series.events.empty());
    for (const auto& step : series.steps) EXPECT_NEAR(step.migration.value, 1e-4, 5e-6);
  }
}

// Half a wavelength in a step could not be told from backwards; the speed of the last step leads on.
TEST(ProfileSeries, AGatheringSpeedIsFollowedBeyondHalfAWavelength) {
  const auto place = [](double t) { return 0.03 * (t / interval) * (t / interval) / 4; };
  const auto analyses = photographs(5, 0.05e-3, 2, 1, [&](double x, double t) { return sine(x - place(t)); });
  const auto series = analyse_series(analyses, times(5));
  for (int i = 0; i < 4; ++i)
    EXPECT_NEAR(series.steps[static_cast<std::size_t>(i)].migration.value * interval,
                place((i + 1) * interval) - place(i * interval), 0.5e-3);
}

TEST(ProfileSeries, StandardErrorsOfMigrationAndGrowthAreRight) {
  double migration = 0;
  double growth = 0;
  double overall = 0;
  double line = 0;
  int steps = 0;
  constexpr int series_count = 20;
  for (std::uint64_t seed = 0; seed < series_count; ++seed) {
    const auto analyses = photographs(5, 0.1e-3, seed, 1, [](double x, double t) {
      return (1 + 0.001 * t) * leaning(0.07, 0.003)(x - 1e-4 * t);
    });
    const auto series = analyse_series(analyses, times(5));
    for (const auto& step : series.steps) {
      migration += std::pow((step.migration.value - 1e-4) / step.migration.sigma, 2);
      growth += std::pow((step.growth.value - 3e-6) / step.growth.sigma, 2);
      ++steps;
    }
    overall += std::pow((series.migration.value - 1e-4) / series.migration.sigma, 2) / series_count;
    line += std::pow((series.growth.value - 3e-6) / series.growth.sigma, 2) / series_count;
  }
  for (const auto& [name, square] : {std::pair("migration of a step", migration / steps),
                                     {"growth of a step", growth / steps},
                                     {"migration", overall},
                                     {"growth", line}}) {
    EXPECT_GT(std::sqrt(square), 0.65) << name;
    EXPECT_LT(std::sqrt(square), 1.4) << name;
  }
}

/// Ripples 7 cm apart that move at 0.05 mm/s, and a smaller one that runs up to the back of the third.
double merging_bed(double x, double t) {
  const auto bump = [](double s, double height, double width) {
    return height * std::exp(-0.5 * s * s / (width * width));
  };
  double z = 0;
  for (int i = -1; i < 6; ++i) z += bump(x - 0.02 - 0.07 * i - 5e-5 * t, 0.004, 0.012);
  const double behind = std::max(0.0, 0.036 - 3.5e-5 * t);
  return z + bump(x - (0.16 - behind) - 5e-5 * t, 0.0025, 0.007);
}

/// When the smaller ripple is no crest of its own any more: the dip before the larger one is less than 15 %
/// of the relief. Found on the bed itself.
double merger_time() {
  for (double t = 0;; t += 1) {
    double lowest = 1;
    double small = 0;
    const double larger = 0.16 + 5e-5 * t;
    for (double x = larger; x > larger - 0.045; x -= 1e-4) {
      const double z = merging_bed(x, t);
      if (z < lowest) {
        lowest = z;
        small = z;
      }
      small = std::max(small, z);
      if (small - lowest > 0.6e-3) break;
    }
    if (small - lowest < 0.6e-3) return t;
  }
}

class Merger : public testing::TestWithParam<int> {};

TEST_P(Merger, IsFoundOnceAtItsTimeAndPlace) {
  const auto analyses = photographs(14, 0.05e-3, static_cast<std::uint64_t>(GetParam()), 1, merging_bed);
  const auto series = analyse_series(analyses, times(14));
  const double when = merger_time();
  ASSERT_GT(when, 3 * interval);
  ASSERT_LT(when, 11 * interval);
  int mergers = 0;
  for (const Event& event : series.events) {
    ASSERT_EQ(event.kind, Event::Kind::merger) << event.time << " s " << event.position;
    ++mergers;
    EXPECT_NEAR(event.time, when, 1.5 * interval);
    EXPECT_NEAR(event.position, 0.16 + 5e-5 * when, 0.006);
  }
  EXPECT_EQ(mergers, 1);
}
INSTANTIATE_TEST_SUITE_P(Seeds, Merger, testing::Range(0, 4));

TEST(ProfileSeries, TheReverseIsASplit) {
  const auto analyses =
      photographs(14, 0.05e-3, 7, -1, [](double x, double t) { return merging_bed(x, 13 * interval - t); });
  const auto series = analyse_series(analyses, times(14));
  ASSERT_EQ(series.events.size(), 1u);
  EXPECT_EQ(series.events[0].kind, Event::Kind::split);
  EXPECT_NEAR(series.events[0].time, 13 * interval - merger_time(), 1.5 * interval);
}

TEST(ProfileSeries, ACrestThatFadesIsALossAndOneThatRisesABirth) {
  const auto bed = [](double share) {
    return [share](double x, double t) {
      double z = 0;
      for (const double at : {0.03, 0.09, 0.15, 0.21}) {
        const double fading = std::max(0.0, share > 0 ? 1 - t / (6 * interval) : t / (6 * interval) - 0.4);
        const double height = at == 0.15 ? 0.004 * std::min(1.0, fading) : 0.004;
        z += height * std::exp(-0.5 * (x - at) * (x - at) / 1e-4);
      }
      return z;
    };
  };
  const auto loss = analyse_series(photographs(9, 0.03e-3, 3, 1, bed(1)), times(9));
  ASSERT_EQ(loss.events.size(), 1u);
  EXPECT_EQ(loss.events[0].kind, Event::Kind::loss);
  EXPECT_NEAR(loss.events[0].position, 0.15, 0.003);
  const auto birth = analyse_series(photographs(9, 0.03e-3, 3, 1, bed(0)), times(9));
  ASSERT_EQ(birth.events.size(), 1u);
  EXPECT_EQ(birth.events[0].kind, Event::Kind::birth);
}

TEST(ProfileSeries, FlatBedsHaveNoFiguresButNoErrorEither) {
  const auto analyses = photographs(3, 0.1e-3, 5, 1, [](double, double) { return 0.0; });
  const auto series = analyse_series(analyses, times(3));
  EXPECT_TRUE(std::isnan(series.migration.value));
  EXPECT_TRUE(std::isnan(series.growth.value));
  EXPECT_TRUE(series.events.empty());
}

TEST(ProfileSeries, RefusesWhatIsNoSeries) {
  const auto analyses = photographs(2, 0.1e-3, 6, 1, [](double x, double) { return sine(x); });
  EXPECT_THROW(analyse_series({analyses[0]}, {0}), Error);
  EXPECT_THROW(analyse_series(analyses, {0}), Error);
  EXPECT_THROW(analyse_series(analyses, {60, 60}), Error);
  EXPECT_THROW(analyse_series(analyses, {60, 0}), Error);
  EXPECT_THROW(analyse_series(analyses, {0, NAN}), Error);
  auto apart = analyses;
  apart[1].even.start += 1;
  EXPECT_THROW(analyse_series(apart, {0, 60}), Error);
}

}  // namespace
}  // namespace aeolian
