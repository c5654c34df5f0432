#include <cmath>

#include <gtest/gtest.h>

#include "aeolian_core/measure/ripple_statistics.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

const GridGeometry plot(0, 0, 0.002, 500, 250);

/// An aperiodic pattern that is known everywhere: waves of random direction and phase, 2 to 10 cm long.
class RandomPattern {
 public:
  explicit RandomPattern(std::uint64_t seed) {
    RandomStream random(seed, 0);
    for (Wave& w : waves_) {
      const double number = 2 * M_PI / (0.02 + 0.08 * random.uniform());
      const double angle = 2 * M_PI * random.uniform();
      w = {number * std::cos(angle), number * std::sin(angle), 2 * M_PI * random.uniform()};
    }
  }
  HeightMap::Layer moved(double dx, double dy) const {
    HeightMap::Layer layer(plot.size());
    for (int iy = 0; iy < plot.ny(); ++iy)
      for (int ix = 0; ix < plot.nx(); ++ix) {
        double h = 0;
        for (const Wave& w : waves_)
          h += std::sin(w.kx * (plot.x(ix) - dx) + w.ky * (plot.y(iy) - dy) + w.phase);
        layer[plot.index(ix, iy)] = static_cast<float>(0.001 * h);
      }
    return layer;
  }

 private:
  struct Wave {
    double kx, ky, phase;
  };
  std::array<Wave, 12> waves_;
};

class Displacement : public testing::TestWithParam<double> {};

TEST_P(Displacement, OfARandomPatternIsFound) {
  const double direction = GetParam() * M_PI / 180;
  const RandomPattern pattern(11);
  const auto before = pattern.moved(0, 0);
  for (const double shift : {0.0, 0.0007, 0.0113, -0.0066}) {
    const auto after = pattern.moved(shift * std::cos(direction), shift * std::sin(direction));
    const auto found = pattern_displacement(plot, before, after, direction, 0.05);
    ASSERT_TRUE(found.has_value());
    EXPECT_NEAR(*found, shift, 0.05 * plot.cell()) << GetParam() << " degrees";
  }
}
INSTANTIATE_TEST_SUITE_P(Directions, Displacement, testing::Values(0.0, 30.0, 90.0, 200.0));

TEST(PatternDisplacement, OfASinusoidIsTheShortestOne) {
  const double wavelength = 0.0731;
  const auto sinusoid = [&](double shift) {
    HeightMap::Layer layer(plot.size());
    for (std::size_t i = 0; i < layer.size(); ++i)
      layer[i] =
          static_cast<float>(0.002 * std::sin(2 * M_PI * (plot.x(plot.cell_at(i).x) - shift) / wavelength));
    return layer;
  };
  for (const double shift : {0.0015, 0.0301, -0.0218}) {
    const auto found = pattern_displacement(plot, sinusoid(0), sinusoid(shift), 0, 0.15);
    ASSERT_TRUE(found.has_value());
    EXPECT_NEAR(*found, shift, 0.05 * plot.cell());
  }
}

TEST(PatternDisplacement, StandsNoiseAndUnknownCells) {
  const RandomPattern pattern(5);
  auto before = pattern.moved(0, 0);
  auto after = pattern.moved(0.0113, 0);
  RandomStream random(1, 0);
  for (auto* layer : {&before, &after})
    for (float& h : *layer) {
      h += static_cast<float>(0.0005 * random.normal());
      if (random.uniform() < 0.3) h = HeightMap::unknown;
    }
  const auto found = pattern_displacement(plot, before, after, 0, 0.05);
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(*found, 0.0113, 0.1 * plot.cell());
}

TEST(PatternDisplacement, IsNothingWithoutACommonPattern) {
  const auto before = RandomPattern(1).moved(0, 0);
  HeightMap::Layer noise(plot.size());
  RandomStream random(2, 0);
  for (float& h : noise) h = static_cast<float>(0.001 * random.normal());
  EXPECT_FALSE(pattern_displacement(plot, before, noise, 0, 0.05).has_value());
  EXPECT_FALSE(pattern_displacement(plot, before, HeightMap::Layer(plot.size(), 0.F), 0, 0.05).has_value());
  EXPECT_FALSE(pattern_displacement(plot, before, HeightMap::Layer(plot.size(), HeightMap::unknown), 0, 0.05)
                   .has_value());
  // A shift beyond the bound.
  EXPECT_FALSE(pattern_displacement(plot, before, RandomPattern(1).moved(0.009, 0), 0, 0.005).has_value());
  EXPECT_THROW(pattern_displacement(plot, before, noise, 0, 0), Error);
}

}  // namespace
}  // namespace aeolian
