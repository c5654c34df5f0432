#include "aeolian_core/saltation/conveyor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <gtest/gtest.h>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

ConveyorSplash splash_case(char name) {
  ConveyorSplash splash;
  if (name == 'B') splash.gamma = 0.004, splash.delta = 0.2;
  if (name == 'C') splash.gamma = 0.2, splash.delta = 0.5;
  return splash;
}

SpectrumConveyor conveyor(char name, double power = 1000) {
  return SpectrumConveyor({power, 0.05, 0.6}, splash_case(name));
}

double grains(const SpectrumConveyor::Steady& s) {
  return std::accumulate(s.flux.begin(), s.flux.end(), 0.0);
}

TEST(DeltaConveyorTest, case_d_has_the_exact_fixed_point) {
  const DeltaConveyor conveyor({1000, 0, 0.6}, [](double) { return 0.8; });
  const auto fixed = conveyor.fixed_point();
  EXPECT_NEAR(fixed.state.speed, 1.25, 1e-12);
  EXPECT_NEAR(fixed.impact_x, 1, 1e-12);
  EXPECT_NEAR(fixed.impact_y, -0.75, 1e-12);
  EXPECT_NEAR(fixed.belt_speed, 5, 1e-12);
  EXPECT_NEAR(fixed.state.flux, 200, 1e-9);
  const auto eigenvalues = conveyor.eigenvalues(fixed.state);
  EXPECT_NEAR(eigenvalues[0], 0.7867, 1e-4);
  EXPECT_NEAR(eigenvalues[1], 0, 1e-6);
  const auto next = conveyor.next(fixed.state);
  EXPECT_NEAR(next.speed, fixed.state.speed, 1e-12);
  EXPECT_NEAR(next.flux, fixed.state.flux, 1e-9);
}

TEST(DeltaConveyorTest, grains_come_to_the_fixed_point_from_elsewhere) {
  const DeltaConveyor conveyor({1000, 0, 0.6}, [](double) { return 0.8; });
  DeltaConveyor::State state{0.7, 20};
  for (int n = 0; n < 150; ++n) state = conveyor.next(state);
  EXPECT_NEAR(state.speed, 1.25, 1e-9);
  EXPECT_NEAR(state.flux, 200, 1e-6);
}

TEST(DeltaConveyorTest, a_steep_fall_of_f_makes_a_cycle_of_two) {
  const auto falling = [](double width) {
    return DeltaConveyor({1000, 0, 0.6},
                         [width](double v) { return 0.7 - 0.1 * std::tanh((v - 1) / width); });
  };
  const auto settled = [](const DeltaConveyor& conveyor) {
    DeltaConveyor::State state = conveyor.fixed_point().state;
    state.speed *= 1.01;
    for (int n = 0; n < 4000; ++n) state = conveyor.next(state);
    return state;
  };
  const DeltaConveyor gentle = falling(0.1);
  EXPECT_NEAR(settled(gentle).speed, 1.094, 1e-3);
  EXPECT_NEAR(settled(gentle).flux, 85.71, 0.01);
  const DeltaConveyor steep = falling(0.05);
  DeltaConveyor::State a = settled(steep);
  DeltaConveyor::State b = steep.next(a);
  if (a.speed < b.speed) std::swap(a, b);
  EXPECT_NEAR(a.speed, 1.178, 1e-3);
  EXPECT_NEAR(a.flux, 73.81, 0.01);
  EXPECT_NEAR(b.speed, 1.002, 1e-3);
  EXPECT_NEAR(b.flux, 85.62, 0.01);
}

TEST(DeltaConveyorTest, linear_response_follows_the_map_in_small_steps) {
  const Belt belt{1000, 0, 0.6};
  const DeltaConveyor conveyor(belt, [](double) { return 0.8; });
  const auto fixed = conveyor.fixed_point();
  const double gap = 2;
  const auto response = linear_response(fixed, belt, 0.8, gap);
  // One cycle takes (1 + eps) h / (eps v); a small change of v at a belt and a number that are held.
  const double cycle = 1.6 * gap / (0.6 * fixed.state.speed);
  const double v = fixed.state.speed;
  const double vc = fixed.belt_speed;
  const auto held = [&](double speed) { return speed * (0.36 + 0.8 * vc / (vc + speed)); };
  const double derivative = (held(v + 1e-6) - held(v - 1e-6)) / 2e-6;
  EXPECT_NEAR(response.a[0][0] * cycle, derivative - 1, 1e-6);
  EXPECT_EQ(response.a[1][1], 0);
  EXPECT_NEAR(response.b[1][1] * cycle, fixed.state.flux, 1e-9);
}

TEST(DeltaConveyorTest, needs_more_conversion_than_loss) {
  const DeltaConveyor conveyor({1000, 0, 0.6}, [](double) { return 0.6; });
  EXPECT_THROW(conveyor.fixed_point(), Error);
}

TEST(SpectrumConveyorTest, steady_states_are_those_of_the_specification) {
  const struct {
    char name;
    double belt_speed, mean, spread, flux;
  } rows[] = {{'A', 14.124, 3.917, 0.891, 23.06},
              {'B', 14.124, 3.887, 0.946, 23.24},
              {'C', 13.639, 2.001, 1.662, 45.0}};
  for (const auto& row : rows) {
    const SpectrumConveyor c = conveyor(row.name);
    const auto s = c.solve();
    double first = 0, second = 0;
    for (int i = 0; i < 40; ++i) {
      const double v = c.launch_speed(i);
      first += v * s.flux[static_cast<std::size_t>(i)] / grains(s);
      second += v * v * s.flux[static_cast<std::size_t>(i)] / grains(s);
    }
    EXPECT_NEAR(s.belt_speed / row.belt_speed, 1, 0.005) << row.name;
    EXPECT_NEAR(first / row.mean, 1, 0.005) << row.name;
    EXPECT_NEAR(std::sqrt(second - first * first) / row.spread, 1, 0.005) << row.name;
    EXPECT_NEAR(grains(s) / row.flux, 1, 0.005) << row.name;
    if (row.name == 'A') {
      EXPECT_GT(std::sqrt(second - first * first), 0.5);
    }
    if (row.name == 'C') {
      EXPECT_EQ(std::max_element(s.flux.begin(), s.flux.end()), s.flux.begin());
    }
  }
}

TEST(SpectrumConveyorTest, power_changes_the_number_only) {
  const auto one = conveyor('A').solve();
  const auto two = conveyor('A', 2000).solve();
  EXPECT_NEAR(one.belt_speed, two.belt_speed, 1e-6);
  for (std::size_t i = 0; i < one.flux.size(); ++i)
    EXPECT_NEAR(one.flux[i] / grains(one), two.flux[i] / grains(two), 1e-6);
  EXPECT_NEAR(grains(two) / grains(one), 2.010, 0.005 * 2.010);
}

TEST(SpectrumConveyorTest, a_column_is_that_of_figure_4_2) {
  const SpectrumConveyor c = conveyor('B');
  const double vc = c.solve().belt_speed;
  const double mu = c.launch_speed(29);
  EXPECT_DOUBLE_EQ(mu, 7.375);
  EXPECT_NEAR(vc * mu / (vc + mu) / 4.845, 1, 0.005);
  const auto column = c.column(mu, vc);
  EXPECT_NEAR(std::accumulate(column.begin(), column.end(), 0.0) * 0.25 / 1.256, 1, 0.005);
  const auto peak = std::max_element(column.begin(), column.end()) - column.begin();
  EXPECT_NEAR(c.launch_speed(static_cast<int>(peak)), 6.531, 0.125);
}

TEST(SpectrumConveyorTest, the_thesis_iteration_ends_from_anywhere_at_the_same_state) {
  for (const char name : {'A', 'B', 'C'}) {
    const SpectrumConveyor c = conveyor(name);
    std::vector<double> flat(40, 1.0), single(40, 0.0);
    single[20] = 10;
    for (const auto& start : {flat, single}) {
      const auto s = c.iterate(start, 0.01);
      EXPECT_LE(s.iterations, 50) << name;
      EXPECT_NEAR(c.iterate(start, 1e-10).belt_speed, c.solve().belt_speed, 1e-6) << name;
    }
  }
}

TEST(SpectrumConveyorTest, too_little_power_moves_nothing) {
  const SpectrumConveyor c({9, 0.05, 0.6}, splash_case('A'));  // 0.05 x 14.12^2 = 9.97
  for (const double flux : c.solve().flux) EXPECT_EQ(flux, 0);
}

TEST(ConveyorTest, refuses_what_is_not_physical) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto f = [](double) { return 0.8; };
  EXPECT_THROW(DeltaConveyor({-1, 0, 0.6}, f), Error);
  EXPECT_THROW(DeltaConveyor({1000, nan, 0.6}, f), Error);
  EXPECT_THROW(DeltaConveyor({1000, 0, 1}, f), Error);
  EXPECT_THROW(SpectrumConveyor({1000, 0, 0.6}, {}, 1), Error);
  EXPECT_THROW(SpectrumConveyor({1000, 0, 0.6}, {0.8, 1.6, 0}), Error);
  EXPECT_THROW(SpectrumConveyor({1000, 0.05, 0.6}, {0.8, 0}).solve(), Error);  // nothing ever leaves
}

}  // namespace
}  // namespace aeolian
