#include "aeolian_core/bedforms/height_map/long_wave_flux.hpp"

#include <cmath>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

constexpr double cell = 0.002;
constexpr double wavelength = 0.1;
constexpr double diffusivity = 1e-6;

/// A grid's heights after long waves have decayed for a time under a wind of this direction.
std::vector<double> decayed(const GridGeometry& g, const std::vector<double>& height, double direction,
                            bool periodic, double duration) {
  const WindFrame frame(g, direction, periodic);
  FrameField bed, dune(frame.stations(), frame.rows());
  frame.enter(height, bed);
  LongWaveFlux flux(frame, cell, wavelength, diffusivity);
  flux.run(dune, duration, nullptr, ActivePatches(frame.stations(), frame.rows()), bed);
  std::vector<double> result(g.size());
  frame.leave(bed, result);
  return result;
}

TEST(LongWaveFluxTest, waves_decay_at_the_rate_that_is_told_whatever_their_direction) {
  struct Wave {
    int x, y;
  };
  const GridGeometry g(0, 0, cell, 400, 300);
  for (const Wave n : {Wave{2, 0}, Wave{4, 0}, Wave{8, 0}, Wave{16, 0}, Wave{0, 3}, Wave{0, 6}, Wave{4, 3},
                       Wave{6, -4}, Wave{12, 9}}) {
    const double kx = 2 * M_PI * n.x / g.length_x();
    const double ky = 2 * M_PI * n.y / g.length_y();
    std::vector<double> h(g.size());
    for (int y = 0; y < g.ny(); ++y)
      for (int x = 0; x < g.nx(); ++x) h[g.index(x, y)] = std::cos(kx * g.x(x) + ky * g.y(y));
    for (const double direction : {0.0, 1.8}) {
      const std::vector<double> after = decayed(g, h, direction, true, 1);
      double left = 0;
      for (std::size_t i = 0; i < h.size(); ++i) left += 2 * h[i] * after[i] / static_cast<double>(h.size());
      const double k2 = kx * kx + ky * ky;
      const double smooth = std::exp(-k2 * wavelength * wavelength / (2 * M_PI * M_PI));
      // Running means are nearly a Gaussian; the greatest rate is 7e-4. The shortest wave here is left alone.
      EXPECT_NEAR(1 - left, diffusivity * k2 * smooth, k2 > 15000 ? 7e-6 : 1.3e-4) << n.x << ' ' << n.y;
    }
  }
}

TEST(LongWaveFluxTest, sand_is_conserved_between_walls_and_around_a_period) {
  const GridGeometry g(0, 0, cell, 130, 77);
  RandomStream random(1, 0);
  std::vector<double> h(g.size());
  for (double& z : h) z = 0.01 * random.normal();
  for (const bool periodic : {false, true})
    for (const double duration : {1.0, 1e5}) {
      const std::vector<double> after = decayed(g, h, 0.3, periodic, duration);
      EXPECT_NEAR(std::accumulate(after.begin(), after.end(), 0.0), std::accumulate(h.begin(), h.end(), 0.0),
                  1e-12);
      for (const double z : after) ASSERT_LT(std::abs(z), 0.06);
    }
}

TEST(LongWaveFluxTest, hard_ground_gives_no_sand_and_unknown_ground_takes_none) {
  const GridGeometry g(0, 0, cell, 160, 64);
  const WindFrame frame(g, 0, false);
  FrameField bed(frame.stations(), frame.rows()), dune = bed;
  HardGround ground{bed, bed, true};
  double before = 0;
  for (int i = 0; i < frame.stations(); ++i) {
    for (int row = 0; row < frame.rows(); ++row) {
      const double z = 0.01 * std::cos(2 * M_PI * i / 80.0);
      bed.at(i)[row] = z;
      ground.floor.at(i)[row] = i > 60 ? z - 1e-5 : HardGround::bottomless;
      ground.open.at(i)[row] = i > 30 && i < 40 ? 0 : 1;
      before += z;
    }
    for (FrameField* field : {&bed, &ground.floor, &ground.open}) field->fill_pads(i, false);
  }
  const FrameField start = bed;
  LongWaveFlux flux(frame, cell, wavelength, diffusivity);
  flux.run(dune, 2000, &ground, ActivePatches(frame.stations(), frame.rows()), bed);
  double after = 0;
  double moved = 0;
  for (int i = 0; i < frame.stations(); ++i)
    for (int row = 0; row < frame.rows(); ++row) {
      after += bed.at(i)[row];
      moved += std::abs(bed.at(i)[row] - start.at(i)[row]);
      ASSERT_GE(bed.at(i)[row], ground.floor.at(i)[row]) << i;
      if (i > 30 && i < 40) {
        ASSERT_EQ(bed.at(i)[row], start.at(i)[row]);
      }
    }
  EXPECT_GT(moved, 1e-3);
  EXPECT_NEAR(after, before, 1e-12);
}

}  // namespace
}  // namespace aeolian
