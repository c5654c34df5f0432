#include <cmath>
#include <string>

#include "../../../error_of.hpp"
#include "grain_radius.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/grains/dynamics/grain_dynamics.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

GrainWorld<2> box(double width) {
  GrainWorld<2> world;
  world.walls = {{{0, 0}, {width, 0}}, {{0, 0}, {0, 1}}, {{width, 0}, {width, 1}}};
  return world;
}

/// A heap that starts in rows with a little disorder.
GrainDynamics<2> collapsing(const GrainWorld<2>& world, int columns, int rows) {
  GrainDynamics<2> grains(world);
  RandomStream random(11, 0);
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i)
      grains.add({(2.1 * i + 1.05 + 0.04 * random.uniform()) * radius, (2.02 * j + 1.01) * radius}, radius);
  return grains;
}

template <int Dim>
double fastest(const GrainDynamics<Dim>& grains) {
  double fastest = 0;
  for (const int grain : grains.numbers()) {
    const double speed = grains.velocity(grain).norm();
    if (!(speed <= fastest)) fastest = speed;  // keeps what is no number
  }
  return fastest;
}

TEST(DynamicsStabilityTest, stiffness_over_four_decades) {
  for (const double stiffness : {6e3, 6e4, 6e5, 6e6, 6e7}) {
    GrainWorld<2> world = box(0.21);
    world.law = ContactLaw::spring(stiffness, 0.85, 0.00314, 0.5);
    GrainDynamics<2> grains = collapsing(world, 10, 5);
    const double energy = grains.potential_energy();
    for (int k = 0; k < 2000; ++k) grains.step();
    EXPECT_LT(grains.kinetic_energy() + grains.potential_energy(), energy * 1.0001) << stiffness;
  }
}

// Also a law whose damping is far beyond critical.
TEST(DynamicsStabilityTest, overdamped_contacts) {
  GrainWorld<2> world = box(0.21);
  world.law.stiffness = world.law.shear_stiffness = 600;
  GrainDynamics<2> grains = collapsing(world, 10, 5);
  grains.advance(0.05);
  EXPECT_LT(fastest(grains), 1);
}

TEST(DynamicsStabilityTest, time_step_over_four_decades) {
  for (const double steps : {8.0, 36.0, 360.0, 3600.0, 80000.0}) {
    GrainWorld<2> world = box(0.21);
    world.steps_per_contact = steps;
    GrainDynamics<2> grains = collapsing(world, 10, 5);
    const double energy = grains.potential_energy();
    for (int k = 0; k < 4000; ++k) grains.step();
    EXPECT_LT(grains.kinetic_energy() + grains.potential_energy(), energy * 1.0001) << steps;
  }
  GrainWorld<2> world;
  world.steps_per_contact = 2;
  EXPECT_EQ(error_of([&] { GrainDynamics<2>{world}; }),
            "grain dynamics: steps per contact is 2, must be 8 or more");
}

TEST(DynamicsStabilityTest, overlapping_start_flies_apart_and_no_faster_than_its_springs_allow) {
  GrainWorld<2> world;
  world.acceleration.setZero();
  GrainDynamics<2> grains(world);
  grains.add({0, 0}, radius);
  grains.add({1.1 * radius, 0}, radius);
  const double energy = grains.potential_energy();
  EXPECT_NEAR(energy, 0.5 * 6e6 * std::pow(0.9 * radius, 2), 1e-6 * energy);
  grains.advance(1e-3);
  EXPECT_LT(grains.kinetic_energy(), energy);
  EXPECT_GT(grains.kinetic_energy(), 0.3 * energy);
}

TEST(DynamicsStabilityTest, hopeless_overlap_is_refused_and_all_stays) {
  GrainDynamics<2> grains(box(0.2));
  grains.add({0.1, 0.1}, radius, {1, 2});
  grains.advance(1e-3);
  const Vector<2> place = grains.position(0);
  const int other = grains.add({0.1, 0.102}, 0.3 * radius);
  const double time = grains.time();
  EXPECT_EQ(error_of([&] { grains.step(); }).substr(0, 49),
            "grain dynamics: grain 0 and grain 1 overlap by 3.");
  EXPECT_EQ(grains.time(), time);
  EXPECT_EQ(grains.position(0), place);
  EXPECT_EQ(grains.velocity(other), Vector<2>::Zero());
  grains.remove(other);
  grains.advance(1e-3);
  EXPECT_GT(grains.time(), time);
}

TEST(DynamicsStabilityTest, very_fast_impact) {
  GrainDynamics<2> grains = collapsing(box(0.42), 20, 6);
  grains.advance(0.005);
  const int fast = grains.add({0.1, 0.2}, radius, {40, -30});
  const double energy = grains.kinetic_energy() + grains.potential_energy();
  grains.advance(0.01);
  EXPECT_LT(fastest(grains), 50);
  EXPECT_TRUE(grains.position(fast).allFinite());
  EXPECT_LT(grains.kinetic_energy() + grains.potential_energy(), energy);
}

// No grain moves more than a tenth of the smallest radius in a step.
TEST(DynamicsStabilityTest, steps_are_short_for_fast_grains) {
  GrainWorld<2> world;
  world.law = ContactLaw::spring(10, 0.8, 0.003, 0.5);
  GrainDynamics<2> grains(world);
  grains.add({0, 0}, radius, {50, 0});
  grains.add({0, 1}, 0.1 * radius);
  EXPECT_LE(grains.step() * 50, 0.1 * 0.1 * radius);
}

TEST(DynamicsStabilityTest, sizes_that_differ_tenfold) {
  GrainDynamics<2> grains(box(0.2));
  RandomStream random(2, 0);
  for (int j = 0; j < 10; ++j)
    for (int i = 0; i < 60; ++i)
      grains.add({0.00332 * (i + 0.5), 0.0025 * (j + 0.5)}, 0.001 + 0.0002 * random.uniform());
  grains.add({0.1, 0.05}, 0.012, {0, -1});
  const double energy = grains.kinetic_energy() + grains.potential_energy();
  for (int k = 0; k < 3000; ++k) grains.step();
  EXPECT_LT(grains.kinetic_energy() + grains.potential_energy(), energy * 1.0001);
  EXPECT_LT(fastest(grains), 5);
}

TEST(DynamicsStabilityTest, one_grain_and_none) {
  GrainDynamics<3> grains(GrainWorld<3>{});
  EXPECT_EQ(grains.step(), 0);
  EXPECT_EQ(grains.step(0.25), 0.25);
  grains.advance(1);
  EXPECT_EQ(grains.time(), 1.25);
  EXPECT_EQ(grains.size(), 0u);
  EXPECT_EQ(grains.kinetic_energy(), 0);
  EXPECT_TRUE(grains.contacts().empty());
  const int grain = grains.add({0, 0, 0}, radius);
  EXPECT_GT(grains.step(), 0);
  grains.remove(grain);
  EXPECT_FALSE(grains.holds(grain));
  EXPECT_EQ(grains.step(0.5), 0.5);
  EXPECT_EQ(grains.add({0, 0, 0}, radius), 1);  // numbers are not used again
}

TEST(DynamicsStabilityTest, numbers_stay_through_sorting_and_removal) {
  GrainDynamics<2> grains = collapsing(box(0.42), 20, 20);
  for (int grain = 0; grain < 400; grain += 3) grains.remove(grain);
  grains.advance(0.02);
  for (const int grain : {1, 5, 200, 398}) {
    EXPECT_NEAR(grains.position(grain).x(), (2.1 * (grain % 20) + 1.05) * radius, 3 * radius);
    EXPECT_FALSE(grains.holds(grain - grain % 3));
  }
  EXPECT_EQ(grains.size(), 266u);
  EXPECT_EQ(grains.numbers().size(), 266u);
  EXPECT_EQ(error_of([&] { grains.position(3); }), "grain dynamics: there is no grain 3");
}

TEST(DynamicsStabilityTest, refusals_name_what_and_how_much) {
  GrainWorld<2> world;
  world.density = -2;
  EXPECT_EQ(error_of([&] { GrainDynamics<2>{world}; }), "grain dynamics: density is -2, must be positive");
  world = {};
  world.walls = {{{1, 1}, {1, 1}}};
  EXPECT_EQ(error_of([&] { GrainDynamics<2>{world}; }),
            "grain dynamics: wall 0: to is (1, 1), must be another place than from");
  world = {};
  world.sleep.speed = 0.1;
  EXPECT_EQ(error_of([&] { GrainDynamics<2>{world}; }),
            "grain dynamics: sleep patience is 0, must be positive where grains may sleep");
  GrainWorld<3> space;
  space.walls = {{Vector<3>::Zero(), {0, 0, 2}}};
  EXPECT_EQ(error_of([&] { GrainDynamics<3>{space}; }),
            "grain dynamics: wall 0: normal is (0, 0, 2), must be of unit length");
  world = {};
  world.period = {0.5, 0};
  GrainDynamics<2> grains(world);
  EXPECT_EQ(error_of([&] {
              grains.add({0.1, 0}, 0);
            }),
            "grain dynamics: radius of a grain is 0, must be positive");
  EXPECT_EQ(error_of([&] {
              grains.add({0.7, 0}, 0.01);
            }),
            "grain dynamics: place of a grain is (0.7, 0), must be between 0 and the period, 0.5");
  EXPECT_EQ(error_of([&] {
              grains.add({0.1, 0}, 0.1);
            }),
            "grain dynamics: radius of a grain is 0.1, must be at most an eighth of the period, 0.5");
  EXPECT_THROW(grains.add({0.1, NAN}, 0.01), Error);
  EXPECT_THROW(grains.set_threads(-1), Error);
  EXPECT_EQ(grains.size(), 0u);
}

template <int Dim>
void expect_same(const GrainDynamics<Dim>& a, const GrainDynamics<Dim>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (const int grain : a.numbers()) {
    ASSERT_EQ(a.position(grain), b.position(grain)) << grain;
    ASSERT_EQ(a.velocity(grain), b.velocity(grain)) << grain;
    ASSERT_EQ(a.spin(grain), b.spin(grain)) << grain;
  }
}

// V7, with grains that fall asleep and are woken.
TEST(DynamicsStabilityTest, threads_do_not_change_a_bit) {
  GrainWorld<2> world = box(0.63);
  world.law = ContactLaw::spring(6e4, 0.6, 0.003, 0.5);
  world.sleep = {0.1, 0.001};
  world.drag = 20;
  GrainDynamics<2> one = collapsing(world, 30, 40);
  one.advance(0.15);
  one.add({0.3, 1}, radius, {5, -10});
  GrainDynamics<2> three(one), copy(one);
  three.set_threads(3);
  one.advance(0.04);
  three.advance(0.04);
  copy.advance(0.04);
  EXPECT_LT(one.awake(), one.size());
  expect_same(one, three);
  expect_same(one, copy);
}

TEST(DynamicsStabilityTest, spheres_on_threads_do_not_change_a_bit) {
  GrainWorld<3> world;
  world.law.kind = ContactLaw::Kind::hertz_mindlin;
  world.law.youngs_modulus = 1e7;
  world.walls = {{Vector<3>::Zero(), Vector<3>::UnitZ()}};
  world.period = {0.2, 0.2, 0};
  GrainDynamics<3> one(world);
  RandomStream random(4, 0);
  for (int i = 0; i < 1000; ++i)
    one.add({0.02 * (i % 10) + 0.001 * random.uniform(), 0.02 * (i / 10 % 10) + 0.001 * random.uniform(),
             0.0202 * (i / 100) + 0.0101},
            0.0095);
  GrainDynamics<3> two(one);
  two.set_threads(2);
  for (int k = 0; k < 500; ++k) {
    one.step();
    two.step();
  }
  EXPECT_GT(one.contacts().size(), 100u);
  expect_same(one, two);
}

}  // namespace
}  // namespace aeolian
