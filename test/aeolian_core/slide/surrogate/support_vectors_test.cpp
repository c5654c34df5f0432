#include "aeolian_core/slide/surrogate/support_vectors.hpp"

#include <algorithm>
#include <cmath>

#include "../../../error_of.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

std::vector<PileFeatures> random_rows(std::size_t count) {
  RandomStream random(7, 0);
  std::vector<PileFeatures> rows(count);
  for (auto& row : rows)
    for (std::size_t d = 0; d < row.size(); ++d) row[d] = static_cast<double>(d + 1) * random.uniform();
  return rows;
}

TEST(SupportVectors, ALinearKernelFindsAPlane) {
  const auto rows = random_rows(80);
  std::vector<double> targets;
  for (const auto& r : rows) targets.push_back(3 + 2 * r[0] - r[1] + 0.5 * r[4]);
  SvrSettings settings{SvrKernel::linear, 100, 0.001, 1};
  const auto trained = SupportVectors::train(rows, targets, settings);
  for (const PileFeatures& at : random_rows(5))
    EXPECT_NEAR(trained.at(at), 3 + 2 * at[0] - at[1] + 0.5 * at[4], 0.01);
}

TEST(SupportVectors, BellsFollowACurveWhereAPlaneCannot) {
  std::vector<PileFeatures> rows;
  std::vector<double> targets;
  for (int k = 0; k <= 60; ++k) {
    const double x = 0.1 * k;
    rows.push_back({x, 1, 1, 1, 1});
    targets.push_back(std::sin(x));
  }
  const auto bells = SupportVectors::train(rows, targets, {SvrKernel::rbf, 100, 0.01, 1});
  const auto plane = SupportVectors::train(rows, targets, {SvrKernel::linear, 100, 0.01, 1});
  double worst_bells = 0, worst_plane = 0;
  for (double x = 0.05; x < 6; x += 0.1) {
    worst_bells = std::max(worst_bells, std::abs(bells.at({x, 1, 1, 1, 1}) - std::sin(x)));
    worst_plane = std::max(worst_plane, std::abs(plane.at({x, 1, 1, 1, 1}) - std::sin(x)));
  }
  EXPECT_LT(worst_bells, 0.02);
  EXPECT_GT(worst_plane, 0.3);
}

/// The sum over lanes against the formula of the specification, 2.11.
TEST(SupportVectors, IsTheSumOverItsVectors) {
  const auto rows = random_rows(37);
  std::vector<double> targets;
  for (const auto& r : rows) targets.push_back(std::sin(3 * r[0]) + r[1] * r[2]);
  const auto trained = SupportVectors::train(rows, targets, {SvrKernel::rbf, 10, 0.01, 0.3});
  const SupportVectors::Parts& p = trained.parts();
  ASSERT_NE(p.vectors.size() % 4, 0U) << "the last lanes should be filled up";
  double weights = 0;
  for (const double w : p.weights) weights += w;
  EXPECT_NEAR(weights, 0, 1e-9);
  for (const PileFeatures& at : random_rows(3)) {
    double sum = p.offset;
    for (std::size_t k = 0; k < p.vectors.size(); ++k) {
      double square = 0;
      for (std::size_t d = 0; d < at.size(); ++d)
        square += std::pow((at[d] - p.mean[d]) / p.deviation[d] - p.vectors[k][d], 2);
      sum += p.weights[k] * std::exp(-0.3 * square);
    }
    EXPECT_NEAR(trained.at(at), p.target_mean + p.target_deviation * sum, 1e-12);
  }
}

/// A free error as wide as all targets leaves nothing to learn.
TEST(SupportVectors, WithinToleranceNothingIsLearnt) {
  const auto rows = random_rows(10);
  const std::vector<double> targets(10, 4.);
  const auto trained = SupportVectors::train(rows, targets, {});
  EXPECT_TRUE(trained.parts().vectors.empty());
  EXPECT_DOUBLE_EQ(trained.at(rows[0]), 4);
}

TEST(SupportVectors, RefusesWhatCannotBe) {
  EXPECT_EQ(error_of([] { SupportVectors::train({}, {}, {}); }),
            "support vectors: number of rows is 0, must be at least 1, and that of targets");
  EXPECT_EQ(error_of([] {
              SupportVectors::train({PileFeatures{}}, {1}, {SvrKernel::rbf, 0, 0.1, 1});
            }),
            "support vectors: cost is 0, must be positive");
  EXPECT_EQ(
      error_of([] {
        SupportVectors({{}, {}, {}, 0, 1, 0, {PileFeatures{}}, {}});
      }),
      "support vectors: there are 1 vectors and 0 weights, must be as many, and one for a linear kernel");
}

}  // namespace
}  // namespace aeolian
