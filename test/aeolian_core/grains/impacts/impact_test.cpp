#include "aeolian_core/grains/impacts/impact.hpp"

#include "../../../error_of.hpp"
#include "small_bed.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/surface/degree.hpp"

namespace aeolian {
namespace {

const Bed<2>& loose_bed() {
  static const Bed<2> bed = make_bed(small_recipe(), soft_discs(), 1);
  return bed;
}

Shot grazing() {
  Shot shot;
  shot.speed = 10;
  shot.angle = 15 * degree;
  shot.along = 0.2;
  return shot;
}

TEST(Impact, OneFreeGrainAnswersWithItsOwnMass) {
  // Grains that do not touch their neighbours (splash specification, T4): a collision of two bodies.
  GrainDynamics<2> grains(soft_discs());
  for (int column = 0; column < 20; ++column) grains.add({(2.1 * column + 1) * 0.01, 0.011}, 0.01);
  BedRecipe recipe = small_recipe();
  const Bed<2> bed = settled_bed(grains, recipe);
  Shot shot = grazing();
  shot.angle = 60 * degree;
  shot.speed = 30;
  const ImpactOutcome outcome = fire(bed, shot, {});
  ASSERT_TRUE(outcome.contact);
  if (outcome.contact->struck == 1) {
    EXPECT_NEAR(outcome.contact->effective_mass, 1, 0.1);
  }
  EXPECT_NEAR(outcome.contact->approach, shot.speed * std::sin(shot.angle + outcome.contact->normal_angle),
              0.01 * shot.speed);
}

TEST(Impact, NeverMoreEnergyThanCameIn) {
  for (const double angle : {15., 30., 80.})
    for (const double along : {0.15, 0.2, 0.24}) {
      Shot shot = grazing();
      shot.angle = angle * degree;
      shot.along = along;
      const ImpactOutcome outcome = fire(loose_bed(), shot, {});
      ASSERT_TRUE(outcome.contact);
      double energy = 0;
      double momentum = 0;
      const auto take = [&](const RisenGrain& grain) {
        energy += grain.velocity.squaredNorm();
        momentum += grain.velocity.x();
      };
      if (outcome.rebound) take(*outcome.rebound);
      for (const RisenGrain& grain : outcome.ejecta) take(grain);
      EXPECT_LT(energy, shot.speed * shot.speed);
      EXPECT_LT(momentum, shot.speed);
      const SplashEvent event = splash_event(outcome, 0.01);
      EXPECT_LE(kinetic_energy(event), 0.5 * shot.speed * shot.speed);
    }
}

TEST(Impact, WhatRisesIsTold) {
  const ImpactOutcome outcome = fire(loose_bed(), grazing(), {});
  ASSERT_TRUE(outcome.contact);
  ASSERT_TRUE(outcome.rebound);
  EXPECT_EQ(outcome.rebound->kind, Origin::rebound);
  EXPECT_GT(outcome.rebound->velocity.x(), 0.3 * outcome.shot.speed);
  EXPECT_GT(outcome.rebound->spin, 0);
  const double plane = loose_bed().surface.top() + 0.02;
  for (const RisenGrain& grain : outcome.ejecta) {
    EXPECT_GT(grain.place.z(), plane);
    EXPECT_LT(grain.place.z(), plane + 0.005);
    EXPECT_GT(grain.velocity.z(), 0);
    EXPECT_LT(grain.origin.z(), 0.01);
    EXPECT_GE(grain.layer, 1);
    EXPECT_EQ(grain.kind == Origin::target, grain.grain == outcome.contact->target);
    EXPECT_LE(grain.time, 0.0701);
  }
  EXPECT_GE(outcome.contact->struck, 1);
  EXPECT_GT(outcome.contact->approach, 0);
}

TEST(Impact, TheCalmEndLosesNothing) {
  ImpactRules to_the_end;
  to_the_end.end_when_calm = false;
  Shot shot = grazing();
  shot.speed = 2;
  const ImpactOutcome early = fire(loose_bed(), shot, {});
  const ImpactOutcome late = fire(loose_bed(), shot, to_the_end);
  EXPECT_LT(early.steps, late.steps);
  EXPECT_EQ(early.ejecta.size(), late.ejecta.size());
  ASSERT_TRUE(early.rebound && late.rebound);
  EXPECT_EQ(early.rebound->velocity, late.rebound->velocity);
}

TEST(Impact, SpheresBehaveAsWell) {
  BedRecipe recipe;
  recipe.packing = BedRecipe::Packing::poured;
  recipe.grains = 240;
  recipe.length = 0.16;
  recipe.width = 0.1;
  recipe.calm = 1e-4;
  const auto bed = make_bed(recipe, soft_spheres(), 2);
  Shot shot = grazing();
  shot.angle = 40 * degree;
  shot.speed = 20;
  shot.along = 0.15;
  shot.across = 0.099;
  const ImpactOutcome outcome = fire(bed, shot, {});
  ASSERT_TRUE(outcome.contact);
  EXPECT_GT(outcome.ejecta.size(), 0U);
  for (const RisenGrain& grain : outcome.ejecta) {
    EXPECT_LE(std::abs(grain.origin.x()), 0.08);
    EXPECT_LE(std::abs(grain.origin.y()), 0.05);
  }
}

TEST(Impact, SplashEventIsOfTheBedsTop) {
  ImpactOutcome outcome;
  RisenGrain risen{};
  risen.radius = 0.005;
  risen.velocity = {1, 2, 3};
  risen.origin = {0.04, 0, -0.01};
  risen.kind = Origin::brink;
  outcome.ejecta.push_back(risen);
  const SplashEvent event = splash_event(outcome, 0.01);
  EXPECT_FALSE(event.rebound);
  ASSERT_EQ(event.ejecta.size(), 1U);
  EXPECT_EQ(event.ejecta[0].velocity.x(), 1);
  EXPECT_EQ(event.ejecta[0].velocity.y(), 2);
  EXPECT_NEAR(event.ejecta[0].velocity.z(), std::sqrt(9 + 2 * 9.81 * 0.02), 1e-12);
  EXPECT_EQ(event.ejecta[0].size_ratio, 0.5);
  EXPECT_EQ(event.ejecta[0].distance, 0.04);
  EXPECT_EQ(event.ejecta[0].origin, Origin::brink);
}

TEST(Impact, RefusesShotsThatCannotBe) {
  const auto message = [](const Shot& shot) { return error_of([&] { fire(loose_bed(), shot, {}); }); };
  Shot shot = grazing();
  shot.speed = 0;
  EXPECT_EQ(message(shot), "shot: speed is 0, must be positive");
  shot = grazing();
  shot.angle = 0;
  EXPECT_EQ(message(shot), "shot: angle is 0, must be 0.01745 to 1.5708 (1 to 90 degrees)");
  shot = grazing();
  shot.size_ratio = 20;
  EXPECT_EQ(message(shot), "shot: size_ratio is 20, must be 0.1 to 10");
}

}  // namespace
}  // namespace aeolian
