#include "aeolian_core/twin/co_registration.hpp"

#include <cmath>

#include "noise_fields.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

const GridGeometry plot(1000, 2000, 0.01, 300, 240);

struct Misalignment {
  double east = 0, north = 0, up = 0, tilt_east = 0, tilt_north = 0, turn = 0;
};

/// Two crossing systems of waves, misaligned about the middle of the plot.
HeightMap dunes(const Misalignment& by, double noise, std::uint64_t seed) {
  HeightMap::Layer z = white_noise(plot, noise, seed);
  const double mx = plot.origin_x() + 0.5 * plot.length_x();
  const double my = plot.origin_y() + 0.5 * plot.length_y();
  for (std::size_t i = 0; i < z.size(); ++i) {
    const CellIndex at = plot.cell_at(i);
    const double ux = plot.x(at.x) - mx;
    const double uy = plot.y(at.y) - my;
    const double c = std::cos(by.turn);
    const double s = std::sin(by.turn);
    const double x = c * (ux - by.east) + s * (uy - by.north);
    const double y = -s * (ux - by.east) + c * (uy - by.north);
    z[i] += static_cast<float>(0.03 * std::sin(2 * M_PI * x / 0.8) +
                               0.02 * std::sin(2 * M_PI * (0.6 * x + y) / 0.9) + by.up + by.tilt_east * ux +
                               by.tilt_north * uy);
  }
  return map_of(plot, z);
}

/// `moved` is undone within its standard errors and so well [m].
void expect_undone(const Figure& figure, double moved, double within) {
  EXPECT_NEAR(figure.value, -moved, within);
  EXPECT_LE(std::abs(figure.value + moved), 4 * figure.sigma + 1e-6);
  EXPECT_LT(figure.sigma, within);
}

TEST(CoRegistrationTest, a_shift_is_found_to_a_hundredth_of_a_cell) {
  const HeightMap b = dunes({}, 0.001, 1);
  for (const double cells : {0.3, 1.5, 6.0}) {
    const HeightMap a = dunes({cells * 0.01, -0.7 * cells * 0.01, 0.02, 0, 0, 0}, 0.001, 2);
    const CoRegistered r = co_register(a, b, CoRegistration::shift, 0.2, nullptr);
    expect_undone(r.east, cells * 0.01, 1e-4);
    expect_undone(r.north, -0.7 * cells * 0.01, 1e-4);
    expect_undone(r.up, 0.02, 5e-5);
    EXPECT_EQ(r.turn.value, 0);
    EXPECT_EQ(r.held, 2);
    EXPECT_LT(r.nmad_after, 0.00145);
    EXPECT_GT(r.nmad_before, r.nmad_after);
  }
}

TEST(CoRegistrationTest, a_plane_is_found_without_moving_anything_sideways) {
  const HeightMap b = dunes({}, 0.001, 1);
  const CoRegistered r =
      co_register(dunes({0, 0, 0.01, 0.002, -0.004, 0}, 0.001, 2), b, CoRegistration::plane, 0.2, nullptr);
  expect_undone(r.up, 0.01, 5e-5);
  expect_undone(r.tilt_east, 0.002, 2e-5);
  expect_undone(r.tilt_north, -0.004, 2e-5);
  EXPECT_EQ(r.east.value, 0);
  EXPECT_EQ(r.north.sigma, 0);
}

TEST(CoRegistrationTest, a_rigid_motion_is_found) {
  const HeightMap b = dunes({}, 0.001, 1);
  const Misalignment by{0.02, 0.01, -0.01, 0.001, 0.002, 0.01};
  const CoRegistered r = co_register(dunes(by, 0.001, 2), b, CoRegistration::rigid, 0.2, nullptr);
  // The turn is undone about the middle first.
  expect_undone(r.east, by.east * std::cos(by.turn) + by.north * std::sin(by.turn), 2e-4);
  expect_undone(r.turn, by.turn, 2e-4);
  expect_undone(r.tilt_north, by.tilt_north, 3e-5);
}

TEST(CoRegistrationTest, change_does_not_pull_what_stable_ground_says) {
  const HeightMap b = dunes({}, 0.001, 1);
  HeightMap a = dunes({0.015, 0, 0, 0, 0, 0}, 0.001, 2);
  // All but a frame of stable ground has been filled up and has moved on.
  const HeightMap active = dunes({0.08, 0, 0.1, 0, 0, 0}, 0.001, 3);
  HeightMap::Layer stable(plot.size(), 1);
  for (int y = 40; y < 200; ++y)
    for (int x = 40; x < 260; ++x) {
      stable[plot.index(x, y)] = 0;
      a.layer(layer::elevation)[plot.index(x, y)] = active.layer(layer::elevation)[plot.index(x, y)];
    }
  const CoRegistered r = co_register(a, b, CoRegistration::shift, 0.2, &stable);
  expect_undone(r.east, 0.015, 2e-4);
  expect_undone(r.up, 0, 1e-4);
}

TEST(CoRegistrationTest, is_not_moved_where_nothing_holds_it) {
  const CoRegistered level =
      co_register(map_of(plot, white_noise(plot, 0.001, 1)), map_of(plot, white_noise(plot, 0.001, 2)),
                  CoRegistration::shift, 0.2, nullptr);
  EXPECT_EQ(level.held, 0);
  EXPECT_EQ(level.east.value, 0);
}

TEST(CoRegistrationTest, refuses_what_it_must_not_move) {
  const HeightMap b = dunes({}, 0.001, 1);
  EXPECT_THROW(co_register(dunes({0.06, 0, 0, 0, 0, 0}, 0.001, 2), b, CoRegistration::shift, 0.05, nullptr),
               Error);
  EXPECT_THROW(co_register(dunes({0, 0, 0.06, 0, 0, 0}, 0.001, 2), b, CoRegistration::plane, 0.05, nullptr),
               Error);
  const HeightMap::Layer none(plot.size(), 0);
  EXPECT_THROW(co_register(b, b, CoRegistration::shift, 0.05, &none), Error);
  HeightMap far(GridGeometry(0, 0, 0.01, 300, 240));
  far.add(layer::elevation, 0);
  EXPECT_THROW(co_register(far, b, CoRegistration::shift, 0.05, nullptr), Error);
}

}  // namespace
}  // namespace aeolian
