#include "aeolian_core/measure/virtual_camera.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

/// A level bed under a straightedge along x, 4 cm high, in light that travels towards -y at 35 degrees; the
/// camera looks straight down from 0.7 m.
struct Rig {
  HeightMap bed{GridGeometry(-1, -1, 0.004, 500, 500)};
  Straightedge edge{{-0.3, 0.05, 0.04}, {0.3, 0.05, 0.04}, 0.02};
  double elevation = 35 * M_PI / 180;
  Eigen::Vector3d light{0, -std::cos(elevation), -std::sin(elevation)};
  VirtualCamera camera;

  Rig() {
    bed.add(layer::elevation, 0);
    camera.pose.translation() = Eigen::Vector3d(0, 0, 0.7);
    camera.pose.linear() = Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()).toRotationMatrix();
    camera.width_px = 320;
    camera.height_px = 400;
    camera.focal_px = 1200;
  }
  /// Row at which a point of the map appears [px, from the upper rim of the picture].
  double row(double y, double z) const { return 0.5 * camera.height_px - camera.focal_px * y / (0.7 - z); }
  /// Mean light of each row's middle part, of 255: the sRGB curve (IEC 61966-2-1) undone.
  std::vector<double> rows(std::uint64_t seed = 1) const {
    const auto picture = camera.photograph(bed, edge, light, 0.0004, seed);
    std::vector<double> mean;
    for (int r = 0; r < camera.height_px; ++r) {
      double sum = 0;
      for (int c = 20; c < camera.width_px - 20; ++c)
        sum += 255 *
               std::pow((picture[static_cast<std::size_t>(r * camera.width_px + c)] / 255.0 + 0.055) / 1.055,
                        2.4);
      mean.push_back(sum / (camera.width_px - 40));
    }
    return mean;
  }
  /// Where the rows after `from` first cross a level [px].
  static double crossing(const std::vector<double>& rows, double from, double level) {
    for (auto r = static_cast<std::size_t>(from); r + 1 < rows.size(); ++r)
      if ((rows[r] - level) * (rows[r + 1] - level) <= 0)
        return static_cast<double>(r) + 0.5 + (level - rows[r]) / (rows[r + 1] - rows[r]);
    return std::nan("");
  }
};

TEST(VirtualCamera, ShadowLiesWhereGeometrySays) {
  const Rig rig;
  const auto rows = rig.rows();
  const double terminus = 0.05 - 0.04 / std::tan(rig.elevation);
  const double expected = rig.row(terminus, 0);
  const double lit = rows[static_cast<std::size_t>(expected) + 30];
  const double dark = rows[static_cast<std::size_t>(expected) - 12];
  EXPECT_LT(dark, 0.4 * lit);
  EXPECT_NEAR(Rig::crossing(rows, expected - 12, 0.5 * (lit + dark)), expected, 0.5);
  // The far rim of the face casts the other side of the shadow.
  const double upper = rig.row(terminus + 0.02, 0);
  EXPECT_NEAR(Rig::crossing(rows, upper - 10, 0.5 * (lit + dark)), upper, 0.5);
}

// 10 % to 90 % of a disc behind a straight line take 0.687 of its diameter; the width on the ground is zeta D
// / sin^2.
TEST(VirtualCamera, PenumbraHasItsWidth) {
  Rig rig;
  rig.camera.sun_diameter = 0.08;
  const auto rows = rig.rows();
  const double expected = rig.row(0.05 - 0.04 / std::tan(rig.elevation), 0);
  const double lit = rows[static_cast<std::size_t>(expected) + 30];
  const double dark = lit * 0.25;
  const double tenth = Rig::crossing(rows, expected - 15, dark + 0.1 * (lit - dark));
  const double nine_tenths = Rig::crossing(rows, expected - 15, dark + 0.9 * (lit - dark));
  const double width = 0.04 * rig.camera.sun_diameter / std::pow(std::sin(rig.elevation), 2);
  EXPECT_NEAR((nine_tenths - tenth) * 0.7 / rig.camera.focal_px, 0.687 * width, 0.08 * width);
}

TEST(VirtualCamera, ShowsTheTopFaceInALightTone) {
  const Rig rig;
  const auto rows = rig.rows();
  const double casting = rig.row(0.05, 0.04);
  const double far = rig.row(0.07, 0.04);
  EXPECT_GT(rows[static_cast<std::size_t>(0.5 * (casting + far))], 230);
  EXPECT_NEAR(Rig::crossing(rows, casting - 5, 198), casting, 0.7);
}

TEST(VirtualCamera, LitSlopesAreBrighter) {
  Rig rig;
  auto& heights = rig.bed.layer(layer::elevation);
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const CellIndex c = rig.bed.geometry().cell_at(i);
    const double y = rig.bed.geometry().y(c.y) + 0.07;
    heights[i] = static_cast<float>(-0.1 * std::abs(y));
  }
  const auto rows = rig.rows();
  const auto towards = static_cast<std::size_t>(rig.row(-0.06, 0));
  const auto away = static_cast<std::size_t>(rig.row(-0.08, 0));
  // Lambert: sin(35 +- 5.71 degrees) / sin 35 on the direct three quarters.
  const double tilt = std::atan(0.1);
  const double expected = (0.25 + 0.75 * std::sin(rig.elevation + tilt) / std::sin(rig.elevation)) /
                          (0.25 + 0.75 * std::sin(rig.elevation - tilt) / std::sin(rig.elevation));
  EXPECT_NEAR(rows[towards] / rows[away], expected, 0.03 * expected);
}

TEST(VirtualCamera, IsDecidedByItsSeed) {
  Rig rig;
  rig.camera.width_px = 60;
  rig.camera.height_px = 40;
  const auto picture = [&](std::uint64_t seed) {
    return rig.camera.photograph(rig.bed, rig.edge, rig.light, 0.0004, seed);
  };
  EXPECT_EQ(picture(1), picture(1));
  EXPECT_NE(picture(1), picture(2));
}

TEST(VirtualCamera, RefusesWhatCannotBe) {
  Rig rig;
  EXPECT_THROW(rig.camera.photograph(rig.bed, rig.edge, Eigen::Vector3d::UnitZ(), 0.0004, 1), Error);
  EXPECT_THROW(rig.camera.photograph(rig.bed, rig.edge, rig.light, 0, 1), Error);
  rig.edge.end = rig.edge.start;
  EXPECT_THROW(rig.camera.photograph(rig.bed, rig.edge, rig.light, 0.0004, 1), Error);
}

}  // namespace
}  // namespace aeolian
