#include "aeolian_rviz/frame_budget.hpp"

#include <set>

#include <gtest/gtest.h>

namespace aeolian {
namespace {

/// A view whose blocks all lie at one distance, the worst case: their levels change together.
std::size_t triangles(double quad_pixels) {
  std::size_t count = 2000000;
  for (double pixels = 0.8; 2 * pixels <= quad_pixels; pixels *= 2) count /= 4;
  return count;
}

struct Machine {
  double constant;      // s
  double per_triangle;  // s
  double seconds(const FrameBudget& budget) const {
    return constant + per_triangle * static_cast<double>(triangles(budget.quad_pixels()));
  }
};

/// The sizes that were drawn in the last 200 frames of 1000.
std::set<double> settle(FrameBudget& budget, const Machine& machine) {
  std::set<double> sizes;
  for (int i = 0; i < 1000; ++i) {
    budget.add_frame(machine.seconds(budget), triangles);
    if (i >= 800) sizes.insert(budget.quad_pixels());
  }
  return sizes;
}

TEST(FrameBudget, LeavesAFastMachineAlone) {
  FrameBudget budget(0.04);
  EXPECT_EQ(settle(budget, {0.001, 1e-9}), std::set<double>{3});
  EXPECT_NEAR(budget.frame_seconds(), 0.001 + 1e-9 * static_cast<double>(triangles(3)), 1e-12);
}

TEST(FrameBudget, DrawsCoarserUntilTheFrameFitsAndStaysThere) {
  for (const double per_triangle : {1e-7, 3e-7, 1e-6})
    for (const double constant : {0.002, 0.02}) {
      FrameBudget budget(0.04);
      const Machine machine{constant, per_triangle};
      EXPECT_EQ(settle(budget, machine).size(), 1U) << "it swings";
      EXPECT_LE(machine.seconds(budget), 0.04) << per_triangle << " " << constant;
    }
}

TEST(FrameBudget, IsNotMisledForLongByALoadThatCameWithATriangleCount) {
  FrameBudget budget(0.04);
  settle(budget, {0.005, 3e-7});
  const double alone = budget.quad_pixels();
  settle(budget, {0.2, 3e-6});
  EXPECT_EQ(settle(budget, {0.005, 3e-7}), std::set<double>{alone});
}

TEST(FrameBudget, BecomesFineAgainWhenThereIsRoom) {
  FrameBudget budget(0.04);
  settle(budget, {0.005, 1e-6});
  EXPECT_GT(budget.quad_pixels(), 3);
  EXPECT_EQ(settle(budget, {0.001, 1e-9}), std::set<double>{3});
}

TEST(FrameBudget, DoesNotDrawBadlyForTheLoadOfOthers) {
  FrameBudget budget(0.04);
  EXPECT_LE(*settle(budget, {0.2, 1e-8}).rbegin(), 12);
}

TEST(FrameBudget, IsNotMisledForLongByALoadThatWentWithATriangleCount) {
  FrameBudget budget(0.04);
  const Machine machine{0.02, 1e-6};
  settle(budget, machine);
  const double settled = budget.quad_pixels();
  for (int i = 0; i < 7; ++i) budget.add_frame(3, [](double) { return std::size_t{1000}; });
  for (int i = 0; i < 7; ++i) budget.add_frame(0.03, triangles);
  EXPECT_EQ(settle(budget, machine), std::set<double>{settled});
}

TEST(FrameBudget, SurvivesAViewWithoutTriangles) {
  FrameBudget budget(0.04);
  for (int i = 0; i < 100; ++i) budget.add_frame(0.1, [](double) { return std::size_t{0}; });
  for (int i = 0; i < 100; ++i) budget.add_frame(0, [](double) { return std::size_t{0}; });
  EXPECT_EQ(settle(budget, {0.001, 1e-9}), std::set<double>{3});
}

}  // namespace
}  // namespace aeolian
