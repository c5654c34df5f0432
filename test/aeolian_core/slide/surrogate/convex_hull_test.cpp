#include "aeolian_core/slide/surrogate/convex_hull.hpp"

#include <algorithm>
#include <cmath>

#include "../../../error_of.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

/// The corners of a simplex, whose inside is known: coordinates of at least 0 with a sum of at most 1.
std::vector<PileFeatures> simplex() {
  std::vector<PileFeatures> points(6);
  for (std::size_t d = 0; d < 5; ++d) points[d][d] = 1;
  return points;
}

TEST(ConvexHull, ASimplexIsWhatItIs) {
  const ConvexHull hull(simplex());
  RandomStream random(1, 0);
  int inside = 0;
  for (int k = 0; k < 2000; ++k) {
    PileFeatures point{};
    double sum = 0;
    for (double& x : point) sum += x = 0.5 * random.uniform() - 0.02;
    const bool there = sum <= 1 && *std::min_element(point.begin(), point.end()) >= 0;
    EXPECT_EQ(hull.contains(point), there);
    inside += there ? 1 : 0;
  }
  EXPECT_GT(inside, 100);
}

TEST(ConvexHull, MeansOfItsPointsAreInsideAndOnlyCornersAreKept) {
  auto points = simplex();
  points.push_back({0.2, 0.2, 0.2, 0.2, 0.1});
  points.push_back({0.5, 0.5, 0, 0, 0});
  points.push_back(points[0]);
  const ConvexHull hull(points);
  EXPECT_EQ(hull.corners().size(), 6U);
  for (const PileFeatures& point : points) EXPECT_TRUE(hull.contains(point));
}

TEST(ConvexHull, ABoxIsItsRanges) {
  std::vector<PileFeatures> corners;
  for (std::size_t mask = 0; mask < 32; ++mask) {
    PileFeatures corner;
    for (std::size_t d = 0; d < 5; ++d) corner[d] = (mask >> d & 1) != 0 ? 3 : -1;
    corners.push_back(corner);
  }
  const ConvexHull hull(corners);
  EXPECT_EQ(hull.corners().size(), 32U);
  EXPECT_TRUE(hull.contains({3, 3, -1, 2, 0}));
  EXPECT_FALSE(hull.contains({3, 3, -1, 2, 3.001}));
}

TEST(ConvexHull, WhatIsTheSameForAllMustBeThat) {
  auto points = simplex();
  for (PileFeatures& point : points) point[3] = 7;
  const ConvexHull hull(points);
  EXPECT_TRUE(hull.contains({0.1, 0.1, 0.1, 7, 0.1}));
  EXPECT_FALSE(hull.contains({0.1, 0.1, 0.1, 7.01, 0.1}));
}

TEST(ConvexHull, NothingIsInsideThatIsNoNumber) {
  EXPECT_FALSE(ConvexHull(simplex()).contains({std::nan(""), 0, 0, 0, 0}));
  const std::vector<PileFeatures> none, broken{{std::nan(""), 0, 0, 0, 0}};
  EXPECT_EQ(error_of([&] { ConvexHull hull(none); }), "convex hull: there are 0 points, must be at least 1");
  EXPECT_EQ(error_of([&] { ConvexHull hull(broken); }), "convex hull: a feature is not finite");
}

}  // namespace
}  // namespace aeolian
