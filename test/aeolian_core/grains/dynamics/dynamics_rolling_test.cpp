#include <cmath>

#include "grain_radius.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/grains/dynamics/grain_dynamics.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

/// A floor in a world tilted by `slope`, so that down the slope is +x.
GrainWorld<2> tilted(double slope, double friction) {
  GrainWorld<2> world;
  world.law = ContactLaw::spring(6e4, 0.5, 0.003, friction);
  world.acceleration = 9.81 * Vector<2>(std::sin(slope), -std::cos(slope));
  world.walls = {{{-10, 0}, {10, 0}}};
  return world;
}

GrainWorld<3> tilted_plane(double slope, double friction) {
  GrainWorld<3> world;
  world.law = ContactLaw::spring(6e4, 0.5, 0.004, friction);
  world.acceleration = 9.81 * Vector<3>(std::sin(slope), 0, -std::cos(slope));
  world.walls = {{Vector<3>::Zero(), Vector<3>::UnitZ()}};
  return world;
}

/// Mean acceleration down the slope once the first bounce is over.
template <int Dim>
double acceleration_on(const GrainWorld<Dim>& world) {
  GrainDynamics<Dim> grains(world);
  grains.add(0.999 * radius * Vector<Dim>::Unit(Dim - 1), radius);
  grains.advance(0.1);
  const double before = grains.velocity(0).x();
  grains.advance(0.1);
  return (grains.velocity(0).x() - before) / 0.1;
}

// V4: rolls while tan(slope) < friction (1 + m r^2 / I), slips beyond.
TEST(DynamicsRollingTest, disc_rolls_down_a_slope) {
  EXPECT_NEAR(acceleration_on(tilted(0.4, 0.3)) / (2.0 / 3 * 9.81 * std::sin(0.4)), 1, 0.01);
}
TEST(DynamicsRollingTest, disc_slips_down_a_steep_slope) {
  const double slope = 0.8, friction = 0.2;  // 3 friction < tan(slope)
  EXPECT_NEAR(
      acceleration_on(tilted(slope, friction)) / (9.81 * (std::sin(slope) - friction * std::cos(slope))), 1,
      0.01);
}
TEST(DynamicsRollingTest, sphere_rolls_and_slips_down_a_slope) {
  EXPECT_NEAR(acceleration_on(tilted_plane(0.4, 0.3)) / (5.0 / 7 * 9.81 * std::sin(0.4)), 1, 0.01);
  EXPECT_NEAR(acceleration_on(tilted_plane(0.9, 0.2)) / (9.81 * (std::sin(0.9) - 0.2 * std::cos(0.9))), 1,
              0.01);
}

/// How far a disc slides in a second that is wedged between two walls, in terms of the weight that their
/// friction can bear. The walls hold it on both sides, so it cannot roll.
double slide(double load) {
  const double overlap = 1e-6, friction = 0.5, stiffness = 6e4;
  GrainWorld<2> world;
  world.law = ContactLaw::spring(stiffness, 0.5, 0.003, friction);
  const double mass = M_PI * radius * radius * world.density * world.thickness;
  world.acceleration = {0, -load * 2 * friction * stiffness * overlap / mass};
  const double apart = radius - overlap;
  world.walls = {{{-apart, -9}, {-apart, 9}}, {{apart, -9}, {apart, 9}}};
  GrainDynamics<2> grains(world);
  grains.add({0, 0}, radius);
  grains.advance(0.05);
  const double start = grains.position(0).y();
  grains.advance(1);
  return start - grains.position(0).y();
}

// V4: a block slips where its load exceeds the friction, and does not creep where it does not.
TEST(DynamicsRollingTest, block_slips_at_the_limit_of_friction) {
  EXPECT_LT(std::abs(slide(0.99)), 1e-6 * radius);
  EXPECT_GT(slide(1.01), radius);
}

// V3: spinning elastic disc on a line loses 778 erg to first and 771.8 erg to second order in friction.
TEST(DynamicsRollingTest, spinning_disc_loses_energy_to_friction) {
  GrainWorld<2> world;
  world.law.damping = world.law.shear_damping = 0;
  world.law.friction = 0.01;
  world.acceleration.setZero();
  world.walls = {{{-1, 0}, {1, 0}}};
  GrainDynamics<2> grains(world);
  grains.add({0, 0.006}, 0.005, {0, -0.991}, Spin<2>(500.0));
  const double inertia = 0.5 * grains.mass(0) * 0.005 * 0.005;
  EXPECT_NEAR(grains.mass(0), 1.57e-3, 1e-5);
  grains.advance(3e-3);
  ASSERT_NEAR(grains.velocity(0).y(), 0.991, 1e-3);
  const double lost = 0.5 * inertia * (500.0 * 500.0 - std::pow(grains.spin(0)[0], 2));
  EXPECT_NEAR(lost, 771.8e-7, 0.01 * 771.8e-7);
}

/// Mean speed down a slope, after 0.3 s, of a bed of discs of several sizes on a ribbed floor.
double flow_at(double slope) {
  GrainWorld<2> world;
  world.law = ContactLaw::spring(6e4, 0.5, 0.003, 0.5);
  world.period = {0.4, 0};
  world.drag = 10;
  world.walls = {{{-1, 0}, {1.4, 0}}};
  for (int i = 0; i < 16; ++i) world.walls.push_back({{0.0125 + 0.025 * i, 0}, {0.0125 + 0.025 * i, 0.008}});
  GrainDynamics<2> grains(world);
  RandomStream random(1, 0);
  for (int j = 0; j < 8; ++j)
    for (int i = 0; i < 18; ++i)
      grains.add({0.0222 * (i + 0.3 + 0.4 * random.uniform()), 0.02 + 0.026 * j},
                 radius * (0.8 + 0.2 * random.uniform()));
  grains.advance(0.4);
  world.drag = 0;
  world.acceleration = 9.81 * Vector<2>(std::sin(slope), -std::cos(slope));
  grains.set_world(world);
  grains.advance(0.3);
  double sum = 0;
  for (const int grain : grains.numbers()) sum += grains.velocity(grain).x();
  return sum / static_cast<double>(grains.size());
}

// Beds of discs with a friction of 0.5 start to flow between 20 and 30 degrees or so (GDR MiDi 2004).
TEST(DynamicsRollingTest, bed_stands_below_the_angle_of_repose_and_flows_above) {
  EXPECT_LT(flow_at(12 * M_PI / 180), 0.01);
  EXPECT_GT(flow_at(35 * M_PI / 180), 0.2);
}

// A disc that rolls off the end of a segment goes round its end: at no time does its distance fall short.
TEST(DynamicsRollingTest, disc_rolls_off_an_edge) {
  GrainWorld<2> world;
  world.law = ContactLaw::spring(6e4, 0.5, 0.003, 0.5);
  world.walls = {{{-1, 0}, {0, 0}}};
  GrainDynamics<2> grains(world);
  grains.add({-0.01, radius}, radius, {0.1, 0}, Spin<2>(-10.0));
  double energy = grains.kinetic_energy() + grains.potential_energy();
  const double start = energy;
  while (grains.position(0).y() > -0.02) {
    grains.step();
    const double now = grains.kinetic_energy() + grains.potential_energy();
    ASSERT_LT(now, energy + 1e-4 * start);
    energy = now;
    if (grains.position(0).x() > 0 && grains.position(0).y() > 0) {
      ASSERT_GT(grains.position(0).norm(), 0.99 * radius);
    }
    ASSERT_LT(grains.time(), 1);
  }
  EXPECT_GT(grains.position(0).x(), radius);
}

TEST(DynamicsRollingTest, moving_wall_carries_a_grain) {
  GrainWorld<2> world;
  world.law = ContactLaw::spring(6e4, 0.3, 0.003, 0.5);
  world.walls = {{{-1, 0}, {1, 0}, {0, 0.2}}};
  GrainDynamics<2> grains(world);
  grains.add({0, radius}, radius, {0, 0.2});
  grains.advance(0.3);
  EXPECT_NEAR(grains.position(0).y(), radius + 0.06, 1e-5);
  EXPECT_NEAR(grains.velocity(0).y(), 0.2, 1e-4);
  EXPECT_NEAR(grains.world().walls[0].from.y(), 0.06, 1e-12);
}

// Of two discs on each other and the floor; the wall bears both.
TEST(DynamicsRollingTest, contacts_tell_the_weight) {
  GrainWorld<2> world;
  world.law = ContactLaw::spring(6e4, 0.3, 0.003, 0.5);
  world.walls = {{{-1, 0}, {1, 0}}, {{-radius, 0}, {-radius, 1}}, {{radius, 0}, {radius, 1}}};
  world.drag = 50;
  GrainDynamics<2> grains(world);
  grains.add({0, radius}, radius);
  grains.add({0, 3 * radius}, radius);
  grains.advance(1);
  const double weight = grains.mass(0) * 9.81;
  const auto contacts = grains.contacts();
  const auto force_on = [&](int second) {
    double force = 0;
    for (const auto& contact : contacts)
      if (contact.first == 0 && contact.second == second) force = contact.normal_force * contact.normal.y();
    return force;
  };
  EXPECT_NEAR(force_on(-1) / weight, 2, 1e-4);
  EXPECT_NEAR(force_on(1) / weight, -1, 1e-4);
  EXPECT_GE(contacts.size(), 2u);
  EXPECT_LE(contacts[0].second, contacts[1].second);
}

}  // namespace
}  // namespace aeolian
