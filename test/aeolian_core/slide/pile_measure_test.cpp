#include "aeolian_core/slide/piles/pile_measure.hpp"

#include <cmath>

#include "../../error_of.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

/// A cone filled evenly: 0.1 m high, of radius 0.3 m about (1, 0).
std::vector<Point<3>> cone() {
  std::vector<Point<3>> points;
  RandomStream random(1, 0);
  while (points.size() < 40000) {
    const Point<3> p(0.6 * random.uniform() - 0.3, 0.6 * random.uniform() - 0.3, 0.1 * random.uniform());
    if (std::hypot(p.x(), p.y()) < 0.3 * (1 - p.z() / 0.1)) points.emplace_back(p.x() + 1, p.y(), p.z());
  }
  return points;
}

// Of a cone with radius R the share outside of r is 1 - 3 (r/R)^2 + 2 (r/R)^3: 3 % at r = 0.898 R.
TEST(PileMeasure, ConeLosesItsThinRim) {
  const PileSize size = measure_pile<3>(cone());
  EXPECT_NEAR(size.height, 0.1, 0.005);
  const double cell = size.length / 30;  // the highest point of the last cell is up to a cell inside
  EXPECT_NEAR(size.length, 2 * 0.898 * 0.3 - cell, 1.1 * cell);
  EXPECT_NEAR(size.head, 1 - 0.898 * 0.3 + 0.5 * cell, 0.6 * cell);
  EXPECT_NEAR(size.raw_length, 0.6, 0.02);
  EXPECT_NEAR(size.shape(), size.height / size.length, 1e-15);
}

// In two dimensions a triangle loses 1.5 % at each end: sqrt(2 * 0.015) of its half-length.
TEST(PileMeasure, TriangleLosesItsEnds) {
  std::vector<Point<2>> points;
  RandomStream random(2, 0);
  while (points.size() < 40000) {
    const Point<2> p(2 * random.uniform() - 1, 0.3 * random.uniform());
    if (std::abs(p.x()) < 1 - p.y() / 0.3) points.push_back(p);
  }
  const PileSize size = measure_pile<2>(points);
  const double cell = size.length / 30;  // the highest point of the last cell is near its inner side
  EXPECT_NEAR(size.tail, 1 - std::sqrt(0.03) - cell, 0.3 * cell);
  EXPECT_NEAR(size.head, -1 + std::sqrt(0.03) + cell, 0.3 * cell);
  EXPECT_NEAR(size.height, 0.3, 0.01);
}

TEST(PileMeasure, DetachedBallsDoNotCount) {
  auto points = cone();
  const PileSize before = measure_pile<3>(points);
  for (int k = 0; k < 500; ++k) points.emplace_back(2 + 1e-4 * k, 0, 0.01);
  points.emplace_back(1, 0, 0.8);
  const PileSize after = measure_pile<3>(points);
  EXPECT_EQ(after.points, before.points);
  EXPECT_EQ(after.length, before.length);
  EXPECT_EQ(after.height, before.height);
}

TEST(PileMeasure, GroundMayBeTilted) {
  const double tilt = 0.2;
  auto points = cone();
  const PileSize level = measure_pile<3>(points);
  for (Point<3>& p : points)  // the inverse of the turn that makes the ground level
    p = {std::cos(tilt) * p.x() - std::sin(tilt) * p.z(), p.y(),
         std::sin(tilt) * p.x() + std::cos(tilt) * p.z()};
  PileRules rules;
  rules.ground_tilt = tilt;
  const PileSize turned = measure_pile<3>(points, rules);
  EXPECT_NEAR(turned.height, level.height, 1e-9);
  EXPECT_NEAR(turned.length, level.length, 1e-3);
}

// A map of the same cone is measured as its points are.
TEST(PileMeasure, MapsAndPointsAgree) {
  HeightMap map(GridGeometry(0.6, -0.4, 0.005, 160, 160));
  map.add(layer::elevation, HeightMap::unknown);
  map.add(layer::ground, 0.5F);
  for (int y = 0; y < 160; ++y)
    for (int x = 0; x < 160; ++x) {
      const double r = std::hypot(map.geometry().x(x) - 1, map.geometry().y(y));
      map.layer(layer::elevation)[map.geometry().index(x, y)] =
          static_cast<float>(0.5 + std::max(0.0, 0.1 * (1 - r / 0.3)));
    }
  const PileSize by_points = measure_pile<3>(cone());
  const PileSize by_map = measure_pile<3>(points_of_map(map));
  EXPECT_NEAR(by_map.height, by_points.height, 0.004);
  EXPECT_NEAR(by_map.length, by_points.length, 0.02);
}

TEST(PileMeasure, RefusesWhatCannotBeMeasured) {
  EXPECT_EQ(error_of([] { measure_pile<2>({}); }), "pile: number of points is 0, must be at least 1");
  EXPECT_EQ(error_of([] { measure_pile<2>({{0, std::nan("")}}); }), "pile: a point is not finite");
  PileRules rules;
  rules.trimmed = 1;
  EXPECT_EQ(error_of([&] {
              measure_pile<2>({{0, 0}}, rules);
            }),
            "pile: share of outliers is 1, must be from 0 to below 1");
}

}  // namespace
}  // namespace aeolian
