#include "aeolian_core/bedforms/height_map/border_supply.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "aeolian_core/bedforms/height_map/ripple_model.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

Forcing blown(double direction) {
  Grain grain;
  grain.diameter = 0.0004;
  return make_forcing(steady_saltation(0.45, grain), direction, grain, MeanSplash{});
}

const GridGeometry plot(0, 0, 0.002, 200, 40);

std::vector<double> noise() {
  RandomStream random(1, 0);
  std::vector<double> h(plot.size());
  for (double& z : h) z = 3e-4 * random.normal();
  return h;
}

struct Moved {
  std::vector<double> height;
  VolumeBalance volume;
};

Moved run(Inflow inflow, double duration, double direction = 0) {
  RippleParameters p;
  p.inflow = inflow;
  p.wavelength_law = std::make_shared<ConstantWavelength>(250);
  Moved result{noise(), {}};
  result.volume = RippleModel(p).advance(plot, result.height, blown(direction), duration).volume;
  return result;
}

/// RMS over the cells [begin, end) along x.
double rms(const std::vector<double>& h, int begin, int end) {
  double square = 0;
  for (int y = 0; y < plot.ny(); ++y)
    for (int x = begin; x < end; ++x) square += h[plot.index(x, y)] * h[plot.index(x, y)];
  return std::sqrt(square / (plot.ny() * (end - begin)));
}

TEST(BorderSupplyTest, margin_is_the_longer_of_shadow_and_five_hops) {
  Forcing forcing = blown(0);
  forcing.impact_angle = 10 * M_PI / 180;
  forcing.reptation_length = 0.01;
  EXPECT_DOUBLE_EQ(polluted_margin(forcing, 0), 0.05);
  EXPECT_NEAR(polluted_margin(forcing, 0.02), 0.1134, 1e-4);
  EXPECT_THROW(polluted_margin(forcing, -1), Error);
  EXPECT_THROW(polluted_margin(forcing, std::numeric_limits<double>::infinity()), Error);
}

TEST(BorderSupplyTest, a_train_of_ripples_brings_what_a_flat_bed_does_on_the_mean) {
  double mean = 0;
  double square = 0;
  constexpr int times = 200;
  for (int i = 0; i < times; ++i) {
    const double s = border_supply(Inflow::ripples, 0.05, 0.02, 0.002, 157.0 * i, 7)(0, 3);
    EXPECT_GE(s, 0);
    mean += s / times;
    square += s * s / times;
  }
  EXPECT_NEAR(mean, 1, 0.1);
  EXPECT_NEAR(std::sqrt(square - mean * mean), 0.3, 0.1);
}

TEST(BorderSupplyTest, a_share_of_it_is_that_share) {
  EXPECT_FALSE(border_supply(Inflow::flat_bed, 0.05, 0.02, 0.002, 3, 7));  // all of it, the fast way
  EXPECT_EQ(border_supply(Inflow::flat_bed, 0.05, 0.02, 0.002, 3, 7, 0.4)(0, 3), 0.4);
  EXPECT_EQ(border_supply(Inflow::none, 0.05, 0.02, 0.002, 3, 7, 0.4)(0, 3), 0);
  EXPECT_DOUBLE_EQ(border_supply(Inflow::ripples, 0.05, 0.02, 0.002, 3, 7, 0.4)(0, 3),
                   0.4 * border_supply(Inflow::ripples, 0.05, 0.02, 0.002, 3, 7)(0, 3));
}

TEST(BorderSupplyTest, nothing_comes_in_where_there_is_no_sand_upwind) {
  for (const double direction : {0.0, 0.6}) {
    const Moved none = run(Inflow::none, 30, direction);
    const Moved flat = run(Inflow::flat_bed, 30, direction);
    EXPECT_NEAR(none.volume.error(), 0, 1e-12);
    // Lines beside the grid book what they lose in both cases.
    EXPECT_LT(none.volume.inflow, 0.6 * flat.volume.inflow);
    EXPECT_LT(none.volume.change, -0.3 * flat.volume.inflow);
    double at_border = 0;
    for (int y = 0; y < plot.ny(); ++y) at_border += none.height[plot.index(1, y)] / plot.ny();
    EXPECT_LT(at_border, -1e-3);
  }
}

TEST(BorderSupplyTest, what_comes_in_changes_a_short_run_in_the_margin_only) {
  const Moved flat = run(Inflow::flat_bed, 60);
  const Moved ripples = run(Inflow::ripples, 60);
  EXPECT_NEAR(ripples.volume.error(), 0, 1e-12);
  std::vector<double> difference(flat.height.size());
  for (std::size_t i = 0; i < difference.size(); ++i) difference[i] = ripples.height[i] - flat.height[i];
  const int margin = static_cast<int>(polluted_margin(blown(0), 0.003) / plot.cell());
  EXPECT_GT(rms(difference, 0, margin), 3e-5);
  EXPECT_LT(rms(difference, margin, plot.nx()), 0.02 * rms(difference, 0, margin));
}

TEST(BorderSupplyTest, no_dead_margin_spreads) {
  // A flat bed's supply leaves the first wavelengths bare for a while, ripples do not.
  const Moved flat = run(Inflow::flat_bed, 1200);
  const Moved ripples = run(Inflow::ripples, 1200);
  EXPECT_LT(rms(flat.height, 0, 50), 0.2 * rms(flat.height, 100, 200));
  EXPECT_GT(rms(ripples.height, 0, 50), 0.5 * rms(ripples.height, 100, 200));
  const Moved later = run(Inflow::flat_bed, 5400);
  EXPECT_GT(rms(later.height, 0, 50), 0.5 * rms(later.height, 100, 200));
}

}  // namespace
}  // namespace aeolian
