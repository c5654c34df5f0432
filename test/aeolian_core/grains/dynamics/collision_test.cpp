#include <cmath>

#include "grain_radius.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/grains/dynamics/grain_dynamics.hpp"

namespace aeolian {
namespace {

constexpr double delay = 1e-6;  // before two grains meet [s]

template <int Dim>
GrainWorld<Dim> weightless(const ContactLaw& law, double steps_per_contact) {
  GrainWorld<Dim> world;
  world.law = law;
  world.acceleration.setZero();
  world.steps_per_contact = steps_per_contact;
  return world;
}

/// Two grains that are about to meet along x, the first with `velocity`.
template <int Dim>
GrainDynamics<Dim> about_to_meet(const ContactLaw& law, double steps_per_contact, const Vector<Dim>& velocity,
                                 double gap) {
  GrainDynamics<Dim> grains(weightless<Dim>(law, steps_per_contact));
  grains.add(Vector<Dim>::Zero(), radius, velocity);
  grains.add((2 * radius + gap) * Vector<Dim>::Unit(0), radius);
  return grains;
}

template <int Dim>
double restitution_of(const ContactLaw& law, double steps_per_contact, double speed) {
  const double gap = 1e-5 * speed;
  GrainDynamics<Dim> grains = about_to_meet<Dim>(law, steps_per_contact, speed * Vector<Dim>::Unit(0), gap);
  const double mass = grains.mass(0) / 2;
  grains.advance(gap / speed + 1.5 * contact_time(law, mass, radius / 2, speed));
  EXPECT_TRUE(grains.contacts().empty());
  return (grains.velocity(1) - grains.velocity(0)).x() / speed;
}

ContactLaw law_of_table_2_1() {
  ContactLaw law;
  law.stiffness = law.shear_stiffness = 5e4;
  law.damping = law.shear_damping = 1000;
  return law;
}

// V1: Werner (1987), table 2.1, 10 to 3000 cm/s.
TEST(CollisionTest, restitution_does_not_depend_on_speed) {
  for (const double speed : {0.1, 0.5, 1.0, 5.0, 10.0, 30.0}) {
    EXPECT_NEAR(restitution_of<2>(law_of_table_2_1(), 36, speed), 0.6724, 0.03 * 0.6724) << speed;
    EXPECT_NEAR(restitution_of<2>(law_of_table_2_1(), 360, speed), 0.6724, 0.001 * 0.6724) << speed;
  }
}

// V2
TEST(CollisionTest, restitution_of_the_impact_study) {
  EXPECT_NEAR(restitution_of<2>(ContactLaw(), 36, 30), 0.85, 0.005 * 0.85);
}

// Of the damped oscillator half a period long.
template <int Dim>
void expect_analytic_collision() {
  const ContactLaw law = law_of_table_2_1();
  const double speed = 1;
  GrainDynamics<Dim> grains = about_to_meet<Dim>(law, 4000, speed * Vector<Dim>::Unit(0), speed * delay);
  const double mass = grains.mass(0) / 2;
  const double decay = law.damping / 2, frequency = std::sqrt(law.stiffness / mass - decay * decay);
  const double part = 0.3 * M_PI / frequency;
  grains.advance(delay + part);
  const double overlap = 2 * radius - (grains.position(1) - grains.position(0)).x();
  EXPECT_NEAR(overlap / (speed / frequency * std::exp(-decay * part) * std::sin(frequency * part)), 1, 1e-6);
  grains.advance(0.8 * M_PI / frequency);
  const Vector<Dim> parting = grains.velocity(1) - grains.velocity(0);
  EXPECT_NEAR(parting.x() / (speed * std::exp(-decay * M_PI / frequency)), 1, 1e-6);
  EXPECT_NEAR(parting.norm(), parting.x(), 1e-12);
}
TEST(CollisionTest, discs_follow_the_analytic_solution) { expect_analytic_collision<2>(); }
TEST(CollisionTest, spheres_follow_the_analytic_solution) { expect_analytic_collision<3>(); }

/// An oblique hit that slips throughout: the tangential impulse is the friction times the impulse of the
/// normal force while it pushes, that is until the overlap's second derivative vanishes.
template <int Dim>
void expect_analytic_slip(double moment_factor) {
  ContactLaw law = law_of_table_2_1();
  law.friction = 0.1;
  const double speed = 1e-6;  // so slow that the line of centres does not turn
  GrainDynamics<Dim> grains =
      about_to_meet<Dim>(law, 5000, speed * (Vector<Dim>::Unit(0) + Vector<Dim>::Unit(1)), speed * delay);
  const double mass = grains.mass(0), reduced = mass / 2;
  const double b = law.damping / 2, w = std::sqrt(law.stiffness / reduced - b * b);
  const double phase = M_PI - std::atan2(2 * b * w, w * w - b * b);
  const double approach = speed * std::exp(-b * phase / w) * (std::cos(phase) - b / w * std::sin(phase));
  const double impulse = law.friction * reduced * (speed - approach);
  grains.advance(1.2 * M_PI / w);
  EXPECT_NEAR(grains.velocity(1).y() / (impulse / mass), 1, 1e-6);
  EXPECT_NEAR((speed - grains.velocity(0).y()) / (impulse / mass), 1, 1e-6);
  const double spin = impulse * radius / (moment_factor * mass * radius * radius);
  constexpr int axis = Dim == 2 ? 0 : 2;
  EXPECT_NEAR(std::abs(grains.spin(0)[axis]) / spin, 1, 1e-6);
  EXPECT_DOUBLE_EQ(grains.spin(0)[axis], grains.spin(1)[axis]);
  EXPECT_LT(grains.spin(0)[axis], 0);  // the first is held back where the two touch, on its right
}
TEST(CollisionTest, slipping_discs_follow_the_analytic_solution) { expect_analytic_slip<2>(0.5); }
TEST(CollisionTest, slipping_spheres_follow_the_analytic_solution) { expect_analytic_slip<3>(0.4); }

// Contacts begin and end between steps; the scheme is of second order nevertheless. Errors of single runs
// scatter with the fraction of a step at which the contact begins, so take a mean over it.
TEST(CollisionTest, converges_with_the_square_of_the_step) {
  const auto error = [](double steps) {
    double sum = 0;
    for (int k = 0; k < 16; ++k) {
      GrainDynamics<2> grains =
          about_to_meet<2>(law_of_table_2_1(), steps, {1, 0}, 1e-4 * (1 + k / 16.0 * 0.05));
      const double exact = restitution(5e4, 1000, grains.mass(0) / 2);
      grains.advance(2e-3);
      sum += std::pow((grains.velocity(1) - grains.velocity(0)).x() - exact, 2);
    }
    return std::sqrt(sum / 16);
  };
  const double coarse = error(20), fine = error(160);
  EXPECT_GT(std::log(coarse / fine) / std::log(8), 1.7) << coarse << " " << fine;
}

TEST(CollisionTest, hertz_restitution_is_the_stated_one_at_any_speed) {
  ContactLaw law;
  law.kind = ContactLaw::Kind::hertz_mindlin;
  law.youngs_modulus = 1e8;
  for (const double restitution : {0.3, 0.7, 0.95, 1.0}) {
    law.restitution = restitution;
    for (const double speed : {0.01, 1.0, 20.0})
      EXPECT_NEAR(restitution_of<3>(law, 100, speed), restitution, 0.005) << speed;
  }
}

// No slip, no damping, a head-on meeting of spinning spheres: Maw, Barber & Fawcett (1976); without slip at
// any time the tangential motion of the contact is that of a spring beside the normal one.
TEST(CollisionTest, shear_spring_sets_the_phase_of_a_sticking_contact) {
  ContactLaw law;
  law.damping = law.shear_damping = 0;
  law.stiffness = 5e4;
  law.friction = 1e3;
  const double speed = 1e-4;
  for (const double ratio : {0.1, 1.0 / 3, 1.0}) {
    law.shear_stiffness = ratio * law.stiffness;
    GrainDynamics<2> grains = about_to_meet<2>(law, 2000, {speed, 0.1 * speed}, 0);
    const double frequency = std::sqrt(law.stiffness / (grains.mass(0) / 2));
    grains.advance(1.2 * M_PI / frequency);
    const double slip =
        (grains.velocity(0) - grains.velocity(1)).y() - radius * (-grains.spin(0)[0] - grains.spin(1)[0]);
    // Discs present a third of their mass to a tangential force at the rim.
    const double expected = 0.1 * speed * std::cos(std::sqrt(3 * ratio) * M_PI);
    EXPECT_NEAR(slip, expected, 2e-3 * 0.1 * speed) << ratio;
  }
}

TEST(CollisionTest, frictionless_grains_do_not_spin) {
  ContactLaw law;
  law.friction = 0;
  GrainDynamics<3> grains = about_to_meet<3>(law, 36, {3, 2, 1}, 1e-4);
  grains.advance(3e-3);
  EXPECT_EQ(grains.spin(0).norm(), 0);
  EXPECT_NEAR(grains.velocity(1).x(), 0, 3.0);
  EXPECT_GT(grains.velocity(1).x(), 1);
}

}  // namespace
}  // namespace aeolian
