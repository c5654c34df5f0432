#include <cmath>
#include <numeric>

#include "../rendering/shadow_score.hpp"
#include <gtest/gtest.h>

namespace aeolian {
namespace {

/// The random set-ups of the bars, measured once for all tests of this file.
class ShadowEnsemble : public testing::Test {
 protected:
  static void SetUpTestSuite() { members_ = measure_ensemble(1, 200, 1.1, 2); }
  static void TearDownTestSuite() { members_.clear(); }

  static std::vector<EnsembleMember> members_;
};
std::vector<EnsembleMember> ShadowEnsemble::members_;

TEST_F(ShadowEnsemble, EveryPhotographIsMeasured) {
  for (const auto& member : members_) EXPECT_EQ(member.refusal, "") << "seed " << member.seed;
}

TEST_F(ShadowEnsemble, ErrorsAreBelowAQuarterGrain) {
  std::vector<double> shares;
  for (const auto& member : members_) {
    const ShadowScore& s = member.score;
    EXPECT_LE(s.rmse, s.bar) << "seed " << member.seed;
    shares.push_back(s.rmse / s.bar);
  }
  RecordProperty("median_rmse_over_bar", std::to_string(quantile(shares, 0.5)));
}

// A light that is told wrongly by 0.1 degrees lifts or sinks a whole profile, which no reading of the photo
// can tell; so the mean over the set-ups is held against the bar and against its own standard error.
TEST_F(ShadowEnsemble, HeightsAreNotBiased) {
  std::vector<double> biases;
  for (const auto& member : members_)
    if (member.score.bias && !std::holds_alternative<PhotoSetup::Post>(member.set_up.setup.light))
      biases.push_back(*member.score.bias);
  ASSERT_GT(biases.size(), 40u);
  const auto n = static_cast<double>(biases.size());
  const double mean = std::accumulate(biases.begin(), biases.end(), 0.0) / n;
  double squares = 0;
  for (const double bias : biases) squares += (bias - mean) * (bias - mean);
  EXPECT_LE(std::abs(mean), 0.05e-3);
  EXPECT_LE(std::abs(mean), 3 * std::sqrt(squares / n / (n - 1)));
}

// The bar of half a percent is for views that fix the wavelength so well; with few or low ripples in view the
// fit states a larger error, and is held to that.
TEST_F(ShadowEnsemble, WavelengthsAreGoodToHalfAPercent) {
  std::vector<double> errors;
  int beyond = 0;
  for (const auto& member : members_) {
    const WavelengthScore& w = member.wavelength;
    if (std::isnan(w.error)) continue;  // no whole ripple in view, and said so
    errors.push_back(std::abs(w.error));
    if (!(std::abs(w.error) <= std::max(0.005, 3 * w.sigma))) ++beyond;
  }
  EXPECT_GE(errors.size(), 180u);
  EXPECT_LE(beyond, 2);  // of 200: three standard errors leave 0.3 %
  EXPECT_LE(quantile(errors, 0.5), 0.0025);
  EXPECT_LE(quantile(errors, 0.9), 0.005);
}

TEST_F(ShadowEnsemble, StatedIntervalsCoverTheTruth) {
  double covered = 0;
  double stations = 0;
  for (const auto& member : members_) {
    covered += static_cast<double>(member.score.covered);
    stations += static_cast<double>(member.score.stations);
  }
  EXPECT_GE(covered / stations, 0.93);
  EXPECT_LE(covered / stations, 0.97);
}

TEST(ShadowEnsembleThreads, DoNotMatter) {
  const auto alone = measure_ensemble(7, 3, 0.5, 1);
  const auto shared = measure_ensemble(7, 3, 0.5, 3);
  for (std::size_t i = 0; i < alone.size(); ++i) EXPECT_EQ(alone[i].profile.z, shared[i].profile.z);
}

}  // namespace
}  // namespace aeolian
