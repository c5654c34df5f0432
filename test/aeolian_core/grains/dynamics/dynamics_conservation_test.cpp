#include <cmath>
#include <set>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "aeolian_core/grains/dynamics/grain_dynamics.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

struct Totals {
  Vector<3> momentum = Vector<3>::Zero(), angular = Vector<3>::Zero();
};

Vector<3> in_space(const Vector<2>& v) { return {v.x(), v.y(), 0}; }
Vector<3> in_space(const Vector<3>& v) { return v; }
Vector<3> spin_of(const GrainDynamics<2>& grains, int grain) { return {0, 0, grains.spin(grain)[0]}; }
Vector<3> spin_of(const GrainDynamics<3>& grains, int grain) { return grains.spin(grain); }

template <int Dim>
Totals totals(const GrainDynamics<Dim>& grains) {
  Totals sum;
  for (const int grain : grains.numbers()) {
    const double mass = grains.mass(grain), radius = grains.radius(grain);
    const Vector<3> momentum = mass * in_space(grains.velocity(grain));
    sum.momentum += momentum;
    sum.angular += in_space(grains.position(grain)).cross(momentum) +
                   (Dim == 2 ? 0.5 : 0.4) * mass * radius * radius * spin_of(grains, grain);
  }
  return sum;
}

/// A cloud that falls together, spinning, with friction and damping.
template <int Dim>
void expect_conserved_momenta(ContactLaw::Kind kind) {
  GrainWorld<Dim> world;
  world.law.kind = kind;
  world.law.youngs_modulus = 1e8;
  world.acceleration.setZero();
  GrainDynamics<Dim> grains(world);
  RandomStream random(7, 0);
  const int side = Dim == 2 ? 8 : 4;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j)
      for (int k = 0; k < (Dim == 2 ? 1 : side); ++k) {
        Vector<Dim> place = Vector<Dim>::Zero();
        place[0] = i - 0.5 * side + 0.1 * random.uniform();
        place[1] = j - 0.5 * side + 0.1 * random.uniform();
        if (Dim == 3) place[Dim - 1] = k - 0.5 * side + 0.1 * random.uniform();
        Vector<Dim> velocity = -3 * place;
        velocity[0] += 0.5 + 2 * place[1];
        grains.add(0.025 * place, 0.007 + 0.003 * random.uniform(), velocity,
                   Spin<Dim>::Constant(20 * random.uniform()));
      }
  const Totals before = totals(grains);
  const double energy = grains.kinetic_energy();
  double size = 0;
  for (const int grain : grains.numbers()) size += grains.mass(grain) * grains.velocity(grain).norm();
  grains.advance(0.02);
  const Totals after = totals(grains);
  EXPECT_LT((after.momentum - before.momentum).norm(), 1e-12 * size);
  EXPECT_LT((after.angular - before.angular).norm(), 1e-9 * before.angular.norm());
  EXPECT_LT(grains.kinetic_energy() + grains.potential_energy(), 0.9 * energy);
}

// V5
TEST(DynamicsConservationTest, discs_conserve_momenta) {
  expect_conserved_momenta<2>(ContactLaw::Kind::spring);
  expect_conserved_momenta<2>(ContactLaw::Kind::hertz_mindlin);
}
TEST(DynamicsConservationTest, spheres_conserve_momenta) {
  expect_conserved_momenta<3>(ContactLaw::Kind::spring);
  expect_conserved_momenta<3>(ContactLaw::Kind::hertz_mindlin);
}

/// A periodic gas without losses.
template <int Dim>
GrainDynamics<Dim> lossless_gas(int side, double speed, double steps_per_contact) {
  GrainWorld<Dim> world;
  world.steps_per_contact = steps_per_contact;
  world.law.damping = world.law.shear_damping = world.law.friction = 0;
  world.acceleration.setZero();
  world.period.setConstant(side * 0.021);
  GrainDynamics<Dim> grains(world);
  RandomStream random(3, 0);
  const int layers = Dim == 2 ? 1 : side;
  for (int i = 0; i < side * side * layers; ++i) {
    Vector<Dim> place, velocity;
    for (int d = 0, rest = i; d < Dim; ++d, rest /= side) {
      place[d] = 0.021 * (rest % side + 0.5);
      velocity[d] = speed * (random.uniform() - 0.5);
    }
    grains.add(place, 0.01, velocity);
  }
  return grains;
}

// V5, and the project's bar: 1e-4 over 1e5 contacts.
TEST(DynamicsConservationTest, lossless_grains_keep_their_energy_over_1e5_contacts) {
  GrainDynamics<2> grains = lossless_gas<2>(10, 20, 150);
  const double energy = grains.kinetic_energy();
  double worst = 0;
  std::size_t begun = 0;
  std::set<std::pair<int, int>> touching;
  while (begun < 100000) {
    grains.advance(5e-5);  // less than a contact
    std::set<std::pair<int, int>> now;
    for (const auto& contact : grains.contacts()) {
      now.insert({contact.first, contact.second});
      begun += touching.count({contact.first, contact.second}) == 0;
    }
    touching.swap(now);
    worst = std::max(worst, std::abs(grains.kinetic_energy() + grains.potential_energy() - energy) / energy);
  }
  EXPECT_LT(worst, 1e-4);
}

TEST(DynamicsConservationTest, lossless_spheres_keep_their_energy) {
  GrainDynamics<3> grains = lossless_gas<3>(5, 6, 72);
  const double energy = grains.kinetic_energy();
  for (int k = 0; k < 50; ++k) {
    grains.advance(1e-4);
    ASSERT_NEAR((grains.kinetic_energy() + grains.potential_energy()) / energy, 1, 1e-4);
  }
}

TEST(DynamicsConservationTest, free_fall_is_exact) {
  GrainDynamics<2> grains(GrainWorld<2>{});
  grains.add({0, 10}, 0.01, {3, 4}, Spin<2>(5.0));
  grains.advance(0.5);
  EXPECT_NEAR(grains.position(0).x(), 1.5, 1e-10);
  EXPECT_NEAR(grains.position(0).y(), 10 + 2 - 9.81 / 8, 1e-10);
  EXPECT_NEAR(grains.velocity(0).y(), 4 - 9.81 / 2, 1e-10);
  EXPECT_DOUBLE_EQ(grains.spin(0)[0], 5);
  EXPECT_NEAR(grains.time(), 0.5, 1e-10);
}

TEST(DynamicsConservationTest, grains_meet_across_a_period) {
  GrainWorld<2> world;
  world.acceleration.setZero();
  world.period = {0.2, 0};
  world.law.damping = 0;
  GrainDynamics<2> grains(world);
  grains.add({0.185, 0.5}, 0.01, {2, 0});
  grains.add({0.02, 0.5}, 0.01);
  grains.advance(0.02);
  EXPECT_NEAR(grains.velocity(1).x(), 2, 1e-3);
  EXPECT_NEAR(grains.velocity(0).x(), 0, 1e-3);
  grains.advance(0.3);  // three times round
  EXPECT_GE(grains.position(0).x(), 0);
  EXPECT_LE(grains.position(1).x(), 0.2);
}

}  // namespace
}  // namespace aeolian
