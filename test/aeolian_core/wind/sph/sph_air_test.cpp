#include "aeolian_core/wind/sph/sph_air.hpp"

#include <cstring>

#include "air_box.hpp"
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian::sph {
namespace {

bool sound(const SphAir& air) {
  for (std::size_t i = 0; i < air.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      if (!std::isfinite(air.place()[i][c]) || !std::isfinite(air.motion()[i][c])) return false;
      const float length = c == 0 ? air.torus().length_x : c == 1 ? air.torus().length_y : air.torus().height;
      if (air.place()[i][c] < 0 || air.place()[i][c] > length) return false;
    }
  return true;
}

std::size_t fired(const SphAir& air) {
  const AirGuards& g = air.guards();
  return g.lifted + g.lowered + g.slowed + g.unsolved;
}

TEST(SphAir, StartsAtTheDensityOfRest) {  // A4
  SphAir air = level_box(12, 10).air();
  for (const float d : air.density()) EXPECT_NEAR(d, 1, 0.01);
}

TEST(SphAir, StillAirStaysAsItIsThoughNoGuardHoldsIt) {  // A1 to A3, traps 5 and 6
  SphAir air = level_box(10, 10).air();
  // Stirred, so that it could move: random velocities that the pressure has to make free of divergence.
  RandomStream random(3, 0);
  for (Four& u : air.motion())
    for (int c = 0; c < 3; ++c) u[c] = 0.1F * static_cast<float>(random.uniform() - 0.5);
  Upwind still;
  still.east = 0;
  air.set_upwind(still);
  const std::size_t n = air.size();
  for (int i = 0; i < 300; ++i) air.step();
  EXPECT_EQ(air.size(), n);
  const std::vector<float> density = air.density();
  EXPECT_NEAR(mean(density), 1, 0.01);
  EXPECT_LT(deviation(layer_means(air, density)), 0.01);
  EXPECT_EQ(fired(air), 0U);
}

TEST(SphAir, UniformWindPassesThroughAMovingBoxUnchanged) {  // F2, trap 10
  SphAir air = level_box(12, 10).air();
  const std::size_t n = air.size();
  for (int i = 0; i < 40; ++i) {
    air.step();
    if (i % 10 == 3) air.move(0.7 * i, -0.4 * i);
    if (i == 20) air.move(120, -240);  // Ten widths away.
  }
  EXPECT_EQ(air.size(), n);
  for (const Four& u : air.motion()) {
    ASSERT_NEAR(u[0], 1, 0.01);
    ASSERT_NEAR(u[1], 0, 0.01);
    ASSERT_NEAR(u[2], 0, 0.01);
  }
  EXPECT_EQ(fired(air), 0U);
  EXPECT_EQ(air.guards().refilled, 0U);
}

TEST(SphAir, SameBitsForAnyNumberOfThreads) {
  const AirBox box(world(14, 14, 1, [](double x, double y) { return gaussian(std::hypot(x, y), 1.5, 3); }),
                   14, 14, 12, 3, 3);
  std::vector<Four> first;
  for (const std::size_t threads : {1, 2, 3}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    SphAir air = box.air();
    for (int i = 0; i < 10; ++i) air.step();
    if (threads == 1) first = air.motion();
    ASSERT_EQ(first.size(), air.motion().size());
    EXPECT_EQ(std::memcmp(first.data(), air.motion().data(), first.size() * sizeof(Four)), 0);
  }
}

TEST(SphAir, IsFreeOfDivergenceAndEvenlySpacedOverAHill) {  // A5
  const AirBox box(world(16, 16, 1, [](double x, double y) { return gaussian(std::hypot(x, y), 1.5, 3); }),
                   24, 24, 12, 4, 4);
  SphAir air = box.air();
  const std::size_t n = air.size();
  for (int i = 0; i < 60; ++i) air.step();
  double square = 0;
  for (const float d : air.divergence()) square += static_cast<double>(d * d);
  EXPECT_LT(std::sqrt(square / static_cast<double>(n)), 0.02);
  EXPECT_EQ(air.size(), n);
  EXPECT_LT(deviation(air.density()), 0.05);
  EXPECT_EQ(fired(air), 0U);
}

TEST(SphAir, HalfTheStepChangesLittle) {  // trap 12
  const AirBox box(world(16, 16, 1, [](double x, double y) { return gaussian(std::hypot(x, y), 1.5, 3); }),
                   18, 18, 11, 3, 3);
  double crest[2];
  for (int n = 0; n < 2; ++n) {
    AirSettings settings;
    settings.step = n == 0 ? 0.2F : 0.1F;
    SphAir air = box.air({}, settings);
    MeanAir mean(air);
    while (air.time() < 10) {
      air.step();
      if (air.time() > 4) mean.add(air);
    }
    crest[n] = static_cast<double>(mean.at(9, 9, 0.5F)[0]);
  }
  EXPECT_NEAR(crest[0], crest[1], 0.02 * crest[1]);
  EXPECT_GT(crest[1], 1.1);
}

TEST(SphAir,
     RunsOverAHalfCylinderWithoutFallingBehind) {  // F7: what holds it on the bend is not felt as a brake
  constexpr float a = 4;
  AirBox box(ridge(1120, 0.05, [](double x) { return std::abs(x) < 4 ? std::sqrt(16 - x * x) : 0; }), 56, 9,
             20, 5, 0);
  smooth(box.relief.height, 1120, 1, 0.375 / 0.05, false);
  box.place.floor = *std::min_element(box.relief.height.begin(), box.relief.height.end());
  SphAir air = box.air();
  double speed = 0;
  double exact = 0;
  double lee = 0;
  double lee_count = 0;
  while (air.time() < 30) {
    air.step();
    if (air.time() < 20) continue;
    for (std::size_t i = 0; i < air.size(); ++i) {
      const float x = air.place()[i][0] - 28;
      const float r = std::hypot(x, air.place()[i][2]);
      if (std::abs(x) < 1 && r < a + 1) {
        speed += static_cast<double>(air.motion()[i][0]);
        exact += static_cast<double>(1 + a * a / (r * r));
      }
      if (x > 1.1F * a && x < 2.5F * a && air.place()[i][2] < 0.6F * a) {
        lee += static_cast<double>(air.motion()[i][0]);
        ++lee_count;
      }
    }
  }
  EXPECT_NEAR(speed, exact, 0.1 * exact);
  EXPECT_GT(lee / lee_count, 0.25);  // No air stands still behind it.
  EXPECT_EQ(fired(air), 0U);
}

TEST(MeanAir, ReadsAShearAsItIsAtAWall) {
  const AirBox box = level_box(12, 12);
  SphAir air = box.air();
  air.density();
  for (std::size_t i = 0; i < air.size(); ++i) air.motion()[i] = Four{0.1F * air.place()[i][2], 0, 0.3F, 0};
  MeanAir mean(air);
  mean.add(air);
  for (const float height : {0.0F, 0.3F, 1.0F, 6.5F}) {
    EXPECT_NEAR(mean.at(6, 6, height)[0], 0.1F * height, 1e-4);
    EXPECT_NEAR(mean.at(6, 6, height)[2], 0.3F, 1e-4);
  }
}

TEST(SphAir, StaysSoundWhereNobodyWouldBlow) {
  const std::function<double(double, double)> worlds[] = {
      [](double x, double) { return x > 0 ? 4.0 : 0.0; },
      [](double x, double y) { return std::abs(x) < 0.6 && std::abs(y) < 0.6 ? 4.0 : 0.0; },
      [](double x, double y) { return std::fmod(std::floor(x) + std::floor(y), 2) == 0 ? 1.0 : 0.0; }};
  for (const auto& height : worlds) {
    const AirBox box(world(14, 14, 1, height), 14, 14, 14, 3, 3);
    SphAir air = box.air();
    const std::size_t n = air.size();
    for (int i = 0; i < 75; ++i) {
      if (i == 25) air.set_upwind({-1, 0, 0, 0});  // It turns round.
      if (i == 50) air.set_upwind({0, 0, 0, 0});
      air.step();
    }
    EXPECT_TRUE(sound(air));
    EXPECT_EQ(air.size(), n);
    EXPECT_LT(air.energy(), 4);
  }
}

TEST(SphAir, ABoxThatFliesOffTheMapKeepsItsAir) {
  const AirBox box(world(40, 40, 1, [](double x, double y) { return gaussian(std::hypot(x, y), 4, 6); }), 14,
                   14, 14, 3, 3);
  SphAir air = box.air();
  for (int i = 0; i < 60; ++i) {
    air.move(i < 30 ? 3.3 : 37.5, 1.7);  // Forty times as fast as the wind.
    air.step();
    ASSERT_TRUE(sound(air));
  }
  // Over level ground again, at the height of the map's border.
  EXPECT_NEAR(static_cast<double>(air.size()),
              14 * 14 * (14 - static_cast<double>(air.ground().height(7, 7))), 8);
  EXPECT_LT(air.energy(), 4);
}

TEST(SphAir, RefusesWhatIsNotAllowed) {
  AirSettings settings;
  settings.support = 5;
  EXPECT_THROW(level_box(20, 12).air({}, settings), Error);
  settings = {};
  settings.step = 0;
  EXPECT_THROW(level_box(12, 12).air({}, settings), Error);
  EXPECT_THROW(level_box(6, 12).air(), Error);
  EXPECT_THROW(
      AirBox(world(12, 12, 1, [](double x, double) { return x > 0 ? 9.0 : 0; }), 12, 12, 12, 3, 3).air(),
      Error);
}

}  // namespace
}  // namespace aeolian::sph
