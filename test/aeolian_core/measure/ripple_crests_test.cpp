#include "aeolian_core/measure/ripple_crests.hpp"

#include <algorithm>

#include "ripple_world.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/measure/ripple_shapes.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

const GridGeometry plot(600000, 5e6, 0.002, 500, 400);  // 1 m x 0.8 m, far from zero

/// The train about the plot's south-western corner, on a slope.
HeightMap::Layer train(const Train& t) {
  return laid_out(plot, [&](double x, double y) {
    return t(x - plot.origin_x(), y - plot.origin_y()) + 0.1 * (x - plot.origin_x()) -
           0.05 * (y - plot.origin_y());
  });
}

double turned_by(double angle, double from) { return std::remainder(angle - from, M_PI); }

class CrestDirection : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(RippleCrests, CrestDirection, testing::Values(0.0, 17.0, 30.0, 45.0, -120.0));

TEST_P(CrestDirection, sinusoids_have_their_size_and_orientation) {
  for (const double wavelength : {0.02, 0.0731}) {
    Train t{wavelength, wavelength / 15, GetParam() * degree, 0.7, {}};
    const RippleField f = ripple_field(find_crests(plot, train(t), t.direction + 10 * degree));
    EXPECT_NEAR(f.wavelength.value, t.wavelength, 1e-3 * t.wavelength);
    EXPECT_NEAR(f.height.value, t.height, 0.02 * t.height);
    EXPECT_NEAR(f.index.value, 15, 0.3);
    EXPECT_LT(std::abs(turned_by(f.orientation.value, t.direction + M_PI / 2)), 0.25 * degree);
    EXPECT_GT(f.concentration, 0.999);
    EXPECT_NEAR(f.asymmetry.value, 1, 0.05);
    EXPECT_NEAR(f.stoss_max.value, std::atan(M_PI / 15), 0.06 * M_PI / 15);
    EXPECT_EQ(f.terminations + f.junctions, 0);
    EXPECT_NEAR(f.crests, 1 / wavelength, 0.45 / wavelength);
  }
}

// A quarter of the height as noise in every cell.
TEST_P(CrestDirection, stands_noise_of_a_quarter_of_the_height) {
  for (const double wavelength : {0.02, 0.05}) {
    Train t{wavelength, wavelength / 15, GetParam() * degree, 0.7, {}};
    HeightMap::Layer layer = train(t);
    add_noise(layer, 0.25 * t.height, 3);
    const RippleField f = ripple_field(find_crests(plot, layer, t.direction - 10 * degree));
    EXPECT_NEAR(f.wavelength.value, t.wavelength, 0.01 * t.wavelength);
    EXPECT_NEAR(f.height.value, t.height, 0.07 * t.height);
    EXPECT_LT(std::abs(turned_by(f.orientation.value, t.direction + M_PI / 2)), 0.5 * degree);
    EXPECT_EQ(f.terminations + f.junctions, 0);
  }
}

// Rises over 80 % of the wavelength.
TEST(RippleCrests, stoss_and_lee_of_triangles) {
  for (const double direction : {0.0, 30 * degree, M_PI}) {
    const double wavelength = 0.1;
    const double height = 0.006;
    const auto layer = laid_out(plot, [&](double x, double y) {
      const double s =
          ((x - plot.origin_x()) * std::cos(direction) + (y - plot.origin_y()) * std::sin(direction)) /
          wavelength;
      const double phase = s - std::floor(s);
      return height * (phase < 0.8 ? phase / 0.8 : (1 - phase) / 0.2);
    });
    const RippleField f = ripple_field(find_crests(plot, layer, direction));
    const double stoss = std::atan(height / (0.8 * wavelength));
    const double lee = std::atan(height / (0.2 * wavelength));
    EXPECT_NEAR(f.wavelength.value, wavelength, 0.005 * wavelength);
    EXPECT_NEAR(f.height.value, height, 0.08 * height);
    EXPECT_NEAR(f.stoss_mean.value, stoss, 0.1 * stoss);
    EXPECT_NEAR(f.lee_mean.value, lee, 0.2 * lee);
    EXPECT_NEAR(f.lee_max.value, lee, 0.1 * lee);
    EXPECT_NEAR(f.asymmetry.value, 4, 0.8);
  }
}

TEST(RippleCrests, points_run_to_the_left_of_the_wind) {
  Train t;
  t.direction = M_PI / 2;  // crests east-west, left of a wind to the north is west
  for (const CrestLine& crest : find_crests(plot, train(t), t.direction).crests) {
    EXPECT_LT(crest.points.back().x(), crest.points.front().x() - 0.9);
    EXPECT_EQ(crest.points.size(), crest.sections.size());
    EXPECT_NEAR(crest.length, 1, 0.02);
    EXPECT_EQ(crest.right, CrestEnd::unseen);
    EXPECT_EQ(crest.left, CrestEnd::unseen);
  }
}

std::vector<Dislocation> scattered(int count, std::uint64_t seed) {
  RandomStream random(seed, 1);
  std::vector<Dislocation> all;
  while (static_cast<int>(all.size()) < count) {
    const Dislocation d{0.15 + 0.7 * random.uniform(), 0.15 + 0.5 * random.uniform(),
                        random.uniform() < 0.5 ? 1 : -1};
    if (std::all_of(all.begin(), all.end(),
                    [&](const Dislocation& o) { return std::hypot(o.x - d.x, o.y - d.y) > 0.2; }))
      all.push_back(d);
  }
  return all;
}

// One to four dislocations of either sign, at noise of up to a quarter of the height.
TEST(RippleCrests, finds_every_dislocation_and_no_other) {
  for (const double noise : {0.0, 0.25})
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
      Train t;
      t.phase = static_cast<double>(seed);
      t.dislocations = scattered(1 + static_cast<int>(seed % 4), seed);
      HeightMap::Layer layer = train(t);
      add_noise(layer, noise * t.height, seed);
      const RippleCrests found = find_crests(plot, layer, 0);
      ASSERT_EQ(found.defects.size(), t.dislocations.size()) << "noise " << noise << ", seed " << seed;
      for (const Dislocation& d : t.dislocations) {
        const Eigen::Vector2d place(d.x + plot.origin_x(), d.y + plot.origin_y());
        const auto& nearest =
            *std::min_element(found.defects.begin(), found.defects.end(), [&](const auto& a, const auto& b) {
              return (a.place - place).norm() < (b.place - place).norm();
            });
        EXPECT_LT((nearest.place - place).norm(), 0.7 * t.wavelength);
        // From right to left of a dislocation the phase to its east grows by 2 pi more than to its west.
        EXPECT_EQ(nearest.opens_left, d.sign < 0) << "seed " << seed;
      }
    }
}

TEST(RippleCrests, holes_and_borders_are_no_ends) {
  Train t;
  t.direction = 17 * degree;
  HeightMap::Layer layer = train(t);
  add_noise(layer, 0.05 * t.height, 1);
  const double x = plot.origin_x();
  const double y = plot.origin_y();
  dig_holes(plot, layer, {{x + 0.3, y + 0.3}, {x + 0.7, y + 0.5}, {x + 0.5, y + 0.1}}, 0.06);
  const RippleCrests found = find_crests(plot, layer, 0);
  EXPECT_TRUE(found.defects.empty());
  EXPECT_GT(found.crests.size(), 23U);  // those that the holes cut are two
  EXPECT_NEAR(ripple_field(found).wavelength.value, t.wavelength, 0.005 * t.wavelength);
}

TEST(RippleCrests, stands_half_of_the_cells_unknown) {
  Train t;
  HeightMap::Layer layer = train(t);
  add_noise(layer, 0.1 * t.height, 1);
  RandomStream random(2, 0);
  for (float& h : layer)
    if (random.uniform() < 0.5) h = HeightMap::unknown;
  const RippleField f = ripple_field(find_crests(plot, layer, 0));
  EXPECT_NEAR(f.wavelength.value, t.wavelength, 0.01 * t.wavelength);
  EXPECT_EQ(f.terminations + f.junctions, 0);
}

// A dune flank of 15 degrees that bends under ripples whose own slopes are 12.
TEST(RippleCrests, dunes_beneath_do_not_matter) {
  Train t;
  const auto layer = laid_out(plot, [&](double x, double y) {
    const double u = x - plot.origin_x();
    return t(u, y - plot.origin_y()) + 0.15 * std::sin(1.8 * u);
  });
  const RippleField f = ripple_field(find_crests(plot, layer, 0));
  EXPECT_NEAR(f.wavelength.value, t.wavelength, 0.01 * t.wavelength);
  EXPECT_NEAR(f.height.value, t.height, 0.02 * t.height);
}

TEST(RippleCrests, finds_nothing_in_noise_on_empty_level_and_tiny_maps) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    HeightMap::Layer layer(plot.size(), 0.F);
    add_noise(layer, 0.001, seed);
    const RippleCrests found = find_crests(plot, layer, 0.3);
    EXPECT_TRUE(found.crests.empty() && found.defects.empty()) << seed;
    EXPECT_TRUE(std::isnan(ripple_field(found).wavelength.value));
  }
  EXPECT_TRUE(find_crests(plot, HeightMap::Layer(plot.size(), 0.1F), 0).crests.empty());
  EXPECT_TRUE(find_crests(plot, HeightMap::Layer(plot.size(), HeightMap::unknown), 0).crests.empty());
  EXPECT_TRUE(find_crests(GridGeometry(0, 0, 1, 1, 1), {0.F}, 0).crests.empty());
  EXPECT_TRUE(find_crests(GridGeometry(0, 0, 1, 200, 2), HeightMap::Layer(400, 0.F), 0).crests.empty());
}

TEST(RippleCrests, grains_are_no_ripples) {
  Train t;
  t.height = 4e-4;
  EXPECT_FALSE(find_crests(plot, train(t), 0, 2e-4).crests.empty());
  EXPECT_TRUE(find_crests(plot, train(t), 0, 1e-3).crests.empty());
}

TEST(RippleCrests, shapes_tell_the_wind) {
  for (const double direction : {0.3, 2.0, -2.5}) {
    const auto layer = laid_out(plot, [&](double x, double y) {
      const double s =
          ((x - plot.origin_x()) * std::cos(direction) + (y - plot.origin_y()) * std::sin(direction)) / 0.06;
      const double phase = s - std::floor(s);
      return 0.004 * (phase < 0.7 ? phase / 0.7 : (1 - phase) / 0.3);
    });
    const auto wind = likely_wind(plot, layer);
    ASSERT_TRUE(wind);
    EXPECT_NEAR(std::remainder(*wind - direction, 2 * M_PI), 0, degree);
  }
  EXPECT_FALSE(likely_wind(plot, HeightMap::Layer(plot.size(), 0.F)));
}

TEST(RippleCrests, refuses_a_layer_of_another_grid) {
  EXPECT_THROW(find_crests(plot, HeightMap::Layer(5), 0), Error);
  EXPECT_THROW(find_crests(plot, HeightMap::Layer(plot.size()), std::nan("")), Error);
}

}  // namespace
}  // namespace aeolian
