#include "aeolian_core/measure/profile_strip.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "aeolian_core/surface/degree.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

/// The bed of the tests, over the level frame's origin [m].
double bed(double x) { return -0.02 + 0.003 * std::sin(2 * M_PI * x / 0.06); }

/// A section as a straightedge of an inclination would report it: its readings, zero mean or from `height`.
ShadowProfile section(double inclination, std::optional<double> height = std::nullopt) {
  ShadowProfile profile;
  profile.inclination = inclination;
  double z_sum = 0;
  double rise_sum = 0;
  std::vector<double> z;
  for (int i = 0; i <= 400; ++i) {
    const double x = 0.0005 * i;
    profile.x.push_back(x * std::cos(inclination) + bed(x) * std::sin(inclination));
    profile.y.push_back(-0.03 - 0.01 * x);
    profile.sigma_z.push_back(1e-4 * (1 + x));
    z.push_back(bed(x));
    z_sum += bed(x) / 401;
    rise_sum += profile.x.back() * std::sin(inclination) / 401;
  }
  profile.drop = rise_sum - z_sum;
  for (const double value : z) profile.z.push_back(value + height.value_or(-z_sum));
  return profile;
}

/// Turned in plan, then somewhere far from zero.
Eigen::Isometry3d turned(double angle) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  pose.translation() = Eigen::Vector3d(431234.3, 5412345.7, 812);
  return pose;
}

TEST(BedPoints, LieWhereTheSectionWasMeasured) {
  for (const double inclination : {-8 * degree, 0.0, 5 * degree})
    for (const std::optional<double> height : {std::optional<double>(), std::optional<double>(0.3)}) {
      const auto points = bed_points(section(inclination, height));
      ASSERT_EQ(points.size(), 401U);
      for (std::size_t i = 0; i < points.size(); ++i) {
        const double x = 0.0005 * static_cast<double>(i);
        EXPECT_LT((points[i] - Eigen::Vector3d(x, -0.03 - 0.01 * x, bed(x))).norm(), 1e-12);
      }
    }
}

TEST(BedPoints, NeedAllCoordinates) {
  ShadowProfile profile = section(0);
  profile.y.pop_back();
  EXPECT_THROW(bed_points(profile), Error);
}

TEST(StraightedgePlace, IsTakenApartIntoInclinationLeanAndHeading) {
  const double inclination = 4 * degree;
  const double lean = -3 * degree;
  const Eigen::AngleAxisd rise(-inclination, Eigen::Vector3d::UnitY());  // x towards z
  const Eigen::AngleAxisd roll(lean, Eigen::Vector3d::UnitX());
  Eigen::Isometry3d pose = turned(130 * degree);
  pose.linear() = pose.linear() * (rise * roll).toRotationMatrix();
  const StraightedgePlace place = straightedge_place(pose);
  EXPECT_NEAR(place.inclination, inclination, 1e-12);
  EXPECT_NEAR(std::sin(place.lean), std::sin(lean) * std::cos(inclination), 1e-12);
  EXPECT_TRUE(place.level_to_map.isApprox(turned(130 * degree)));
}

TEST(StraightedgePlace, RefusesOneThatStandsOrLiesOnItsFace) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::AngleAxisd(-50 * degree, Eigen::Vector3d::UnitY()).toRotationMatrix();
  EXPECT_THROW(straightedge_place(pose), Error);
  pose.linear() = Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()).toRotationMatrix();
  EXPECT_THROW(straightedge_place(pose), Error);
}

TEST(ProfileStrip, HasTheSectionsHeightsInTheCellsUnderIt) {
  for (const double heading : {0.0, 37 * degree, 180 * degree, -100 * degree})
    for (const double cell : {0.0002, 0.002, 0.005}) {  // less than a step between stations, and more
      const Eigen::Isometry3d pose = turned(heading);
      const HeightMap strip = profile_strip(section(2 * degree), pose, cell);
      const GridGeometry& g = strip.geometry();
      std::size_t known = 0;
      for (std::size_t i = 0; i < g.size(); ++i) {
        const double z = static_cast<double>(strip.layer(layer::elevation)[i]);
        const double variance = static_cast<double>(strip.layer(layer::variance)[i]);
        ASSERT_EQ(std::isfinite(z), std::isfinite(variance));
        if (!std::isfinite(z)) continue;
        ++known;
        const CellIndex c = g.cell_at(i);
        const Eigen::Vector3d at = pose.inverse() * Eigen::Vector3d(g.x(c.x), g.y(c.y), 0);
        const double x = std::clamp(at.x(), 0.0, 0.2);
        EXPECT_LT(std::abs(at.y() + 0.03 + 0.01 * at.x()), 0.75 * cell) << "off the section";
        EXPECT_NEAR(z, 812 + bed(x), 5e-5) << "floats resolve 0.06 mm at 812 m";
        EXPECT_NEAR(variance, std::pow(1e-4 * (1 + x), 2), 1e-11);
      }
      EXPECT_GE(static_cast<double>(known), 0.2 / cell);
      EXPECT_LE(static_cast<double>(known), 1.5 * 0.2 / cell + 4) << heading << " " << cell;
    }
}

TEST(ProfileStrip, LeavesGapsUnknown) {
  ShadowProfile profile = section(0);
  for (auto* values : {&profile.x, &profile.y, &profile.z, &profile.sigma_z})
    values->erase(values->begin() + 100, values->begin() + 160);  // 0.0495 to 0.08 m
  profile.drop = 0.02;
  const HeightMap strip = profile_strip(profile, Eigen::Isometry3d::Identity(), 0.002);
  for (int ix = 0; ix < strip.geometry().nx(); ++ix) {
    bool known = false;
    for (int iy = 0; iy < strip.geometry().ny(); ++iy)
      known = known || std::isfinite(strip.layer(layer::elevation)[strip.geometry().index(ix, iy)]);
    const double x = strip.geometry().x(ix);
    EXPECT_EQ(known, x < 0.0495 || x > 0.08) << x;
  }
}

TEST(ProfileStrip, RefusesWhatCannotBe) {
  EXPECT_THROW(profile_strip(ShadowProfile(), Eigen::Isometry3d::Identity(), 0.002), Error);
  EXPECT_THROW(profile_strip(section(0), Eigen::Isometry3d::Identity(), 0), Error);
}

}  // namespace
}  // namespace aeolian
