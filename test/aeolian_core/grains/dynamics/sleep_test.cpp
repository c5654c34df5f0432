#include <algorithm>
#include <cmath>

#include "grain_radius.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/grains/dynamics/grain_dynamics.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

GrainDynamics<2> settled_bed(int columns, int rows) {
  GrainWorld<2> world;
  world.law = ContactLaw::spring(6e5, 0.7, 0.003, 0.5);
  const double width = 2.02 * columns * radius;
  world.walls = {{{-1, 0}, {1 + width, 0}}, {{0, 0}, {0, 1}}, {{width, 0}, {width, 1}}};
  world.drag = 50;
  GrainDynamics<2> grains(world);
  RandomStream random(5, 0);
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns - j % 2; ++i)
      grains.add({(2.02 * i + 1.01 * (1 + j % 2)) * radius, (1.75 * j + 1) * radius},
                 radius * (1 - 0.03 * random.uniform()));
  grains.advance(0.15);
  world.drag = 0;
  grains.set_world(world);
  return grains;
}

void let_sleep(GrainDynamics<2>& grains, double speed) {
  GrainWorld<2> world = grains.world();
  world.sleep = {speed, 0.001};
  grains.set_world(world);
  grains.advance(0.004);
}

TEST(SleepTest, a_bed_at_rest_sleeps_and_costs_nothing) {
  GrainDynamics<2> grains = settled_bed(20, 8);
  const auto before = grains.contacts();
  let_sleep(grains, 0.02);
  EXPECT_EQ(grains.awake(), 0u);
  const std::size_t work = grains.grain_steps();
  const Vector<2> place = grains.position(30);
  grains.advance(0.1);
  EXPECT_EQ(grains.grain_steps(), work);
  EXPECT_EQ(grains.position(30), place);
  // Who touches whom, and how hard, is kept.
  const auto after = grains.contacts();
  EXPECT_NEAR(static_cast<double>(after.size()), static_cast<double>(before.size()),
              0.02 * static_cast<double>(before.size()));
  double load = 0;
  for (const auto& contact : after)
    if (contact.second == -1) load += contact.normal_force * contact.normal.y();
  double weight = 0;
  for (const int grain : grains.numbers()) weight += 9.81 * grains.mass(grain);
  EXPECT_GT(load, 0.5 * weight);
}

TEST(SleepTest, grains_wake_when_their_support_goes) {
  GrainDynamics<2> grains = settled_bed(10, 4);
  let_sleep(grains, 0.02);
  ASSERT_EQ(grains.awake(), 0u);
  GrainWorld<2> world = grains.world();
  const double before = grains.position(35).y();
  for (int grain = 0; grain < 10; ++grain) grains.remove(grain);
  grains.advance(0.15);
  EXPECT_LT(grains.position(35).y(), before - radius);
}

// One that leaves of its own does not pull its neighbours along, but they no longer lean on it.
TEST(SleepTest, grains_wake_when_an_awake_support_leaves) {
  GrainWorld<2> world;
  world.law = ContactLaw::spring(6e4, 0.3, 0.003, 0.5);
  world.walls = {{{-1, 0}, {1, 0}}, {{-radius, 0}, {-radius, 1}}, {{radius, 0}, {radius, 1}}};
  world.sleep = {0.02, 0.001};
  GrainDynamics<2> grains(world);
  grains.add({0, radius}, radius);
  grains.add({0, 2.9999 * radius}, radius);
  grains.advance(0.5);
  ASSERT_EQ(grains.awake(), 0u);
  grains.remove(0);
  grains.advance(0.2);
  EXPECT_NEAR(grains.position(1).y(), radius, 1e-4);
  EXPECT_EQ(grains.awake(), 0u);
}

TEST(SleepTest, contacts_of_one_grain_are_those_of_the_whole_whoever_sleeps) {
  GrainDynamics<2> grains = settled_bed(20, 10);
  let_sleep(grains, 0.02);
  const int struck = grains.numbers().front();
  grains.set_motion(struck, {0.3, 0.2}, Spin<2>::Zero());
  grains.advance(0.002);
  const std::vector<int> moving = grains.moving();
  ASSERT_GT(moving.size(), 0u);
  ASSERT_LT(moving.size(), grains.size());
  EXPECT_EQ(moving.size(), grains.awake());
  const auto all = grains.contacts();
  for (const int grain : grains.numbers()) {
    std::vector<std::pair<int, int>> expected, found;
    for (const auto& contact : all)
      if (contact.first == grain || contact.second == grain)
        expected.emplace_back(contact.first, contact.second);
    for (const auto& contact : grains.contacts(grain)) found.emplace_back(contact.first, contact.second);
    EXPECT_EQ(found, expected) << "grain " << grain;
    const bool moves = grains.velocity(grain).norm() > 0;
    EXPECT_GE(std::count(moving.begin(), moving.end(), grain), moves ? 1 : 0) << "grain " << grain;
  }
}

TEST(SleepTest, a_grain_in_the_air_does_not_fall_asleep) {
  GrainWorld<2> world;
  world.sleep = {0.1, 0.001};
  GrainDynamics<2> grains(world);
  grains.add({0, 1}, radius, {0, 0.5});  // slow for 0.02 s about the top of its path
  grains.advance(0.2);
  EXPECT_NEAR(grains.position(0).y(), 1 + 0.1 - 9.81 * 0.02, 1e-9);
}

TEST(SleepTest, a_light_load_is_borne_asleep_without_drift) {
  GrainDynamics<2> grains = settled_bed(10, 4);
  let_sleep(grains, 0.02);
  const Vector<2> place = grains.position(15);
  grains.add({0.1, 0.1}, radius);
  grains.advance(1.5);
  EXPECT_EQ(grains.awake(), 0u);
  EXPECT_LT((grains.position(15) - place).norm(), 0.02 * radius);
}

TEST(SleepTest, set_motion_wakes) {
  GrainDynamics<2> grains = settled_bed(10, 4);
  let_sleep(grains, 0.02);
  grains.set_motion(36, {0, 1}, Spin<2>::Zero());
  EXPECT_EQ(grains.awake(), 1u);
  const double before = grains.position(36).y();
  grains.advance(0.02);
  EXPECT_GT(grains.position(36).y(), before + 0.01);
}

/// What an impact leaves: the hitting grain's velocity, and the energy of the bed.
struct After {
  Vector<2> velocity;
  double energy;
};

After impact_on(GrainDynamics<2> grains) {
  const int grain = grains.add({0.1, 0.2}, radius, {14, -5});
  grains.advance(0.018);
  return {grains.velocity(grain), grains.kinetic_energy()};
}

// The impulse that a sleeper has not answered is less than what would give it the rule's speed, so results
// converge as that falls.
TEST(SleepTest, impact_on_a_sleeping_bed_converges_to_that_on_one_awake) {
  const GrainDynamics<2> bed = settled_bed(20, 8);
  const After truth = impact_on(bed);
  ASSERT_LT(truth.velocity.norm(), 13);  // it has hit
  for (const double speed : {0.3, 0.03, 0.003}) {
    GrainDynamics<2> sleeping = bed;
    let_sleep(sleeping, speed);
    ASSERT_LT(sleeping.awake(), 5u);
    const After after = impact_on(sleeping);
    EXPECT_LT((after.velocity - truth.velocity).norm(), 0.02 + 2 * speed) << speed;
    EXPECT_NEAR(after.energy / truth.energy, 1, 0.005 + speed) << speed;
  }
}

}  // namespace
}  // namespace aeolian
