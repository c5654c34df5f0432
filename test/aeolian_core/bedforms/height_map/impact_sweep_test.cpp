#include "aeolian_core/bedforms/height_map/impact_sweep.hpp"

#include <cmath>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

namespace aeolian {
namespace {

constexpr double cell = 0.001;
const double tan_impact = std::tan(10 * M_PI / 180);

/// A sweep so short that the bed does not change.
struct Sweep {
  GridGeometry geometry;
  WindFrame frame;
  ImpactSweep impacts;

  Sweep(int nx, int ny, double direction, bool periodic, const std::function<double(int, int)>& height,
        const ImpactAngles& angles = tan_impact)
      : geometry(0, 0, cell, nx, ny), frame(geometry, direction, periodic), impacts(frame, angles, 0.01, 1) {
    std::vector<double> h(geometry.size());
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x) h[geometry.index(x, y)] = height(x, y);
    FrameField bed, dune;
    frame.enter(h, bed);
    frame.enter(std::vector<double>(h.size(), 0.0), dune);
    impacts.run(bed, dune, 1e-12);
  }
  double erosion(int station, int line) const { return impacts.erosion().at(station)[line]; }
};

TEST(ImpactSweepTest, a_plane_is_struck_in_proportion_to_its_slope_against_the_grains) {
  // Werner 1987, eq. 5.6 per horizontal length: 1 + tan(slope) / tan(impact angle).
  for (const double direction : {0.0, 0.3, M_PI / 4, 2.0, -1.2})
    for (const double slope : {-0.1, 0.05, 0.3}) {
      const double c = slope * cell * std::cos(direction);
      const double s = slope * cell * std::sin(direction);
      const Sweep sweep(80, 90, direction, false, [&](int x, int y) { return c * x + s * y; });
      const int middle = sweep.frame.rows() / 2;
      for (int station = 35; station < 45; ++station)
        ASSERT_NEAR(sweep.erosion(station, middle), 1 + slope / tan_impact, 1e-9)
            << direction << ' ' << slope;
    }
}

TEST(ImpactSweepTest, a_shadow_ends_where_grains_pass_the_crest) {
  constexpr double crest = 0.01;
  const Sweep sweep(300, 12, 0, false, [](int x, int) { return x >= 50 && x < 60 ? crest : 0.0; });
  const double end = 59 + crest / tan_impact / cell;
  for (int station = 61; station < 300; ++station) {
    if (station < end - 1) {
      ASSERT_EQ(sweep.erosion(station, 6), 0) << station;
    } else if (station > end + 1) {
      ASSERT_NEAR(sweep.erosion(station, 6), 1, 1e-9) << station;
    }
  }
}

TEST(ImpactSweepTest, the_edge_of_a_shadow_is_as_wide_as_the_spread_of_the_angles) {
  // Behind a crest, each angle's shadow ends by itself: exposure is the share of the angles that have passed.
  constexpr double crest = 0.01;
  const ImpactAngles angles(0.2, 0.08);
  const Sweep sweep(
      400, 12, 0, false, [](int x, int) { return x >= 50 && x < 60 ? crest : 0.0; }, angles);
  for (int station = 61; station < 400; ++station) {
    double share = 0;
    bool at_an_edge = false;
    for (int n = 0; n < angles.count(); ++n) {
      const double end = 59 + crest / angles.tangent(n) / cell;
      if (station > end) share += angles.weight(n);
      at_an_edge = at_an_edge || std::abs(station - end) <= 1;
    }
    if (!at_an_edge) {
      ASSERT_NEAR(sweep.erosion(station, 6), share, 1e-9) << station;
    }
  }
}

TEST(ImpactSweepTest, every_impact_of_the_supply_strikes_a_periodic_bed) {
  for (const ImpactAngles& angles : {ImpactAngles(tan_impact), ImpactAngles(0.2, 0.1)})
    for (const double direction : {0.0, 0.3, M_PI / 4, 2.0}) {
      const Sweep sweep(
          120, 100, direction, true,
          [](int x, int y) {
            return 0.006 * std::sin(2 * M_PI * x / 40) + 0.003 * std::cos(2 * M_PI * (y - x) / 20);
          },
          angles);
      double struck = 0;
      double fell = 0;
      for (int station = 0; station < sweep.frame.stations(); ++station)
        for (int q = 0; q < sweep.frame.rows(); ++q) {
          struck += sweep.erosion(station, q);
          fell += sweep.impacts.deposition().at(station)[q];
        }
      EXPECT_NEAR(struck / 12000, 1, 1e-12) << direction;
      EXPECT_NEAR(fell / struck, 1, 1e-12) << direction;
    }
}

TEST(ImpactAnglesTest, nodes_have_the_moments_of_the_distribution) {
  // Of a log-normal of this mean and deviation, the mean of 1 / angle is (1 + ratio^2) / mean; the
  // cotangent is a third of the angle less.
  const ImpactAngles angles(0.1, 0.03);
  double mean = 0;
  double square = 0;
  for (int n = 0; n < angles.count(); ++n) {
    const double angle = std::atan(angles.tangent(n));
    mean += angles.weight(n) * angle;
    square += angles.weight(n) * angle * angle;
  }
  EXPECT_NEAR(mean, 0.1, 1e-5);
  EXPECT_NEAR(std::sqrt(square - mean * mean), 0.03, 1e-4);
  EXPECT_NEAR(1 / angles.effective_tangent(), 1.09 / 0.1 - 0.1 / 3, 0.01);
}

TEST(ImpactAnglesTest, without_spread_there_is_one_and_with_much_none_is_out_of_range) {
  const ImpactAngles one(0.17, 0);
  EXPECT_EQ(one.count(), 1);
  EXPECT_EQ(one.tangent(0), std::tan(0.17));
  EXPECT_EQ(one.effective_tangent(), std::tan(0.17));
  const ImpactAngles wide(1.0, 1.0);
  for (int n = 0; n < wide.count(); ++n) {
    EXPECT_GE(wide.tangent(n), std::tan(ImpactAngles::shallowest));
    EXPECT_LE(wide.tangent(n), std::tan(ImpactAngles::steepest));
  }
}

TEST(ImpactSweepTest, sheltered_sand_that_is_left_out_changes_nothing_else) {
  // Lines 0 ... 40 behind a ridge, by themselves and beside lines that no shadow lets rest.
  struct OnGround {
    GridGeometry geometry;
    WindFrame frame;
    ImpactSweep impacts;
    ActivePatches active;

    explicit OnGround(int ny)
        : geometry(0, 0, cell, 500, ny),
          frame(geometry, 0, false),
          impacts(frame, tan_impact, 0.005, 1),
          active(500, ny) {
      std::vector<double> h(geometry.size(), 0.0);
      for (int y = 0; y < 40; ++y)
        for (int x = 0; x < 500; ++x)
          h[geometry.index(x, y)] =
              0.05 * std::exp(-0.5 * std::pow((x - 120) / 40.0, 2)) + 0.0005 * std::sin(0.4 * x + 0.2 * y);
      FrameField bed, dune;
      HardGround ground;
      frame.enter(h, bed);
      frame.enter(std::vector<double>(h.size(), 0.0), dune);
      frame.enter(std::vector<double>(h.size(), HardGround::bottomless), ground.floor);
      frame.enter(std::vector<double>(h.size(), 1.0), ground.open);
      const ActivePatches sandy = active;
      impacts.run(bed, dune, ground, sandy, 1e-4, active);
    }
  };
  const OnGround alone(40);
  const OnGround beside(60);
  EXPECT_FALSE(alone.active.get(300, 0));
  EXPECT_TRUE(beside.active.get(300, 1));
  EXPECT_TRUE(alone.active.get(450, 0));
  for (int q = 1; q < 39; ++q) {
    double gained = 0;
    for (int station = 0; station < 500; ++station) {
      const auto gain = [&](const OnGround& run) { return run.impacts.deposition().at(station)[q]; };
      const auto loss = [&](const OnGround& run) { return run.impacts.erosion().at(station)[q]; };
      // A flat bed's flux is five cells'.
      ASSERT_NEAR(gain(alone), gain(beside), 5 * least_flux) << station << ' ' << q;
      ASSERT_NEAR(loss(alone), loss(beside), 5 * least_flux) << station << ' ' << q;
      gained += gain(alone) - gain(beside);
    }
    EXPECT_NEAR(gained, 0, 1e-9);
  }
}

TEST(ImpactSweepTest, what_enters_an_open_bed_leaves_it_or_stays) {
  for (const double direction : {0.0, 0.3, -0.6, M_PI / 4}) {
    const Sweep sweep(90, 70, direction, false,
                      [](int x, int y) { return 0.004 * std::sin(0.3 * x + 0.1 * std::sin(0.2 * y)); });
    const WindFrame& frame = sweep.frame;
    double gain = 0;
    for (int station = 0; station < frame.stations(); ++station)
      for (int q = 0; q <= frame.rows(); ++q)
        gain += sweep.impacts.deposition().at(station)[q] - sweep.erosion(station, q);
    EXPECT_NEAR(gain, sweep.impacts.inflow() - sweep.impacts.outflow(), 1e-9) << direction;
  }
}

}  // namespace
}  // namespace aeolian
