#include "aeolian_core/wind/wind_model.hpp"

#include <gtest/gtest.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/wind/log_law.hpp"

namespace aeolian {
namespace {

TEST(LogLaw, HandValue) {
  // d = 0.3 mm: z0 = 1e-5 m; ln(1 m / 1e-5 m) = 5 ln 10 = 11.5129; 0.4 * 10 / 11.5129 = 0.347436 m/s.
  EXPECT_NEAR(grain_roughness(3e-4), 1e-5, 1e-20);
  EXPECT_NEAR(friction_velocity(10, 1, 1e-5), 0.347436, 1e-6);
  // One e-fold above the ground the wind is u*/kappa.
  EXPECT_NEAR(log_law_speed(0.3, M_E * 1e-5, 1e-5), 0.75, 1e-12);
}

TEST(LogLaw, SpeedIsTheInverse) {
  for (const double height : {0.02, 0.5, 10.0})
    for (const double speed : {0.0, 0.1, 4.0, 30.0})
      EXPECT_NEAR(log_law_speed(friction_velocity(speed, height, 1e-5), height, 1e-5), speed, 1e-13 * speed);
}

TEST(LogLaw, RefusesWhatIsNotPhysical) {
  EXPECT_THROW(friction_velocity(-1, 1, 1e-5), Error);
  EXPECT_THROW(friction_velocity(NAN, 1, 1e-5), Error);
  EXPECT_THROW(friction_velocity(1, 1e-5, 1e-5), Error);
  EXPECT_THROW(friction_velocity(1, -1, 1e-5), Error);
  EXPECT_THROW(friction_velocity(1, 1, 0), Error);
  EXPECT_THROW(friction_velocity(1, INFINITY, 1e-5), Error);
  EXPECT_THROW(log_law_speed(-0.1, 1, 1e-5), Error);
}

TEST(LogLawWind, IsTheSameEverywhere) {
  LogLawWind model(1e-5);
  const HeightMap surface(GridGeometry(0, 0, 0.01, 4, 4));
  const WindField field = model.solve({10, 5 * M_PI / 2, 1, 1.2, 7}, &surface);
  EXPECT_NEAR(field.friction_velocity, 0.347436, 1e-6);
  EXPECT_NEAR(field.direction, M_PI / 2, 1e-14);
  EXPECT_EQ(field.air_density, 1.2);
  EXPECT_TRUE(field.cells.names().empty());
  EXPECT_EQ(field.model, "log law");
  EXPECT_EQ(model.solve({0, 0, 1, 1.2, 0}, nullptr).friction_velocity, 0);
}

TEST(LogLawWind, RefusesWhatIsNotPhysical) {
  EXPECT_THROW(LogLawWind(0), Error);
  EXPECT_THROW(LogLawWind(-1e-5), Error);
  EXPECT_THROW(LogLawWind(NAN), Error);
  LogLawWind model(1e-5);
  EXPECT_THROW(model.solve({-1, 0, 1, 1.2, 0}, nullptr), Error);
  EXPECT_THROW(model.solve({1, NAN, 1, 1.2, 0}, nullptr), Error);
  EXPECT_THROW(model.solve({1, 0, 1e-6, 1.2, 0}, nullptr), Error);
  EXPECT_THROW(model.solve({1, 0, 1, 0, 0}, nullptr), Error);
}

}  // namespace
}  // namespace aeolian
