#include "aeolian_core/grains/dynamics/contact_law.hpp"

#include <cmath>
#include <limits>
#include <string>

#include "../../../error_of.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

// Two discs of radius 1 cm and 2 g/cm^3, one centimetre thick.
constexpr double pair_mass = M_PI * 1e-4 * 2000 * 0.01 / 2;

std::string refusal(const ContactLaw& law) {
  return error_of([&] { law.require_valid(); });
}

// Werner (1987), table 2.1, with the stiffness that the thesis must have meant (5e7 dyn/cm).
TEST(ContactLawTest, restitution_is_that_of_the_thesis) {
  EXPECT_NEAR(restitution(5e4, 1000, pair_mass), 0.672, 0.0005);
}

TEST(ContactLawTest, critical_damping_leaves_nothing) { EXPECT_EQ(restitution(1, 10, 1), 0); }

// Section 4.1 of the splash specification.
TEST(ContactLawTest, spring_of_a_restitution_is_that_of_the_impact_study) {
  const ContactLaw law = ContactLaw::spring(6e6, 0.85, pair_mass, 0.5);
  EXPECT_NEAR(law.damping, 4515, 2);
  EXPECT_EQ(law.damping, law.shear_damping);
  EXPECT_NEAR(contact_time(law, pair_mass, 0.005, 30), 7.20e-5, 1e-7);
}

TEST(ContactLawTest, spring_and_restitution_are_inverse) {
  for (const double wanted : {0.05, 0.5, 0.85, 0.999, 1.0}) {
    const ContactLaw law = ContactLaw::spring(2e5, wanted, 0.003, 0.5);
    EXPECT_NEAR(restitution(law.stiffness, law.damping, 0.003), wanted, 1e-12);
  }
}

// Landau & Lifshitz, Theory of Elasticity, sec. 9: 2.94 h / v, h where Hertz' energy is that of the motion.
TEST(ContactLawTest, hertz_contact_of_steel_balls) {
  ContactLaw law;
  law.kind = ContactLaw::Kind::hertz_mindlin;
  law.youngs_modulus = 210e9;
  law.poisson_ratio = 0.3;
  const double mass = 2.0 / 3 * M_PI * 1e-6 * 7800, modulus = 210e9 / (2 * 0.91);
  const double deepest = std::pow(15 * mass * 4 / (16 * modulus * std::sqrt(0.005)), 0.4);
  EXPECT_NEAR(contact_time(law, mass, 0.005, 2) / (2.9432 * deepest / 2), 1, 0.002);
}

TEST(ContactLawTest, refusals_name_the_constant_and_its_value) {
  ContactLaw law;
  EXPECT_NO_THROW(law.require_valid());
  law.friction = -0.5;
  EXPECT_EQ(refusal(law), "contact law: friction is -0.5, allowed is zero or a positive number");
  law = {};
  law.stiffness = 0;
  EXPECT_EQ(refusal(law), "contact law: stiffness is 0, allowed is a positive number");
  law = {};
  law.damping = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refusal(law).find("damping is nan"), std::string::npos);
  law = {};
  law.kind = ContactLaw::Kind::hertz_mindlin;
  law.restitution = 1.2;
  EXPECT_EQ(refusal(law), "contact law: restitution is 1.2, allowed is above 0 and up to 1");
  law.restitution = 0.9;
  law.poisson_ratio = 0.7;
  EXPECT_NE(refusal(law).find("Poisson's ratio is 0.7"), std::string::npos);
  EXPECT_THROW(ContactLaw::spring(1e5, 0, 0.01, 0.5), Error);
  EXPECT_THROW(ContactLaw::spring(1e5, 0.8, -1, 0.5), Error);
}

}  // namespace
}  // namespace aeolian
