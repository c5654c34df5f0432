#include "aeolian_core/slide/calibration/snow_calibration.hpp"

#include <cmath>

#include "../../../error_of.hpp"
#include "../../../temporary_folder.hpp"
#include <gtest/gtest.h>

namespace aeolian {
namespace {

/// A snow whose errors are known: they rise with the distance from M 0.53, p0 6.4 kPa, beta 0.17.
PileErrors errors_of(const SnowSet& s) {
  const double a = (s.friction - 0.53) / 0.3, b = (s.consolidation - 6400) / 3000,
               c = (s.cohesion - 0.17) / 0.15;
  return {0.01 + 0.05 * (a * a + c * c), 0.03 + 0.1 * (b * b + 0.5 * a * a)};
}
std::optional<std::vector<PileErrors>> measured(const std::vector<SnowSet>& sets) {
  std::vector<PileErrors> errors;
  for (const SnowSet& set : sets) errors.push_back(errors_of(set));
  return errors;
}

TEST(SnowCalibration, TheThesisGridHas48Sets) { EXPECT_EQ(sets_of({}).size(), 48U); }

TEST(SnowCalibration, TheGridFindsTheNearestSetAndTheOptimiserWhatLiesBetween) {
  const auto coarse = calibrate({}, 0, measured);
  ASSERT_TRUE(coarse);
  EXPECT_EQ(coarse->best.set.friction, 0.5);
  EXPECT_EQ(coarse->best.set.consolidation, 6000);
  EXPECT_EQ(coarse->best.set.cohesion, 0.2);
  const auto fine = calibrate({}, 200, measured);
  ASSERT_TRUE(fine);
  EXPECT_LE(fine->refined.size(), 200U);
  EXPECT_LT(fine->best.score, coarse->best.score);
  EXPECT_NEAR(fine->best.set.friction, 0.53, 0.01);
  EXPECT_NEAR(fine->best.set.consolidation, 6400, 50);
  EXPECT_NEAR(fine->best.set.cohesion, 0.17, 0.01);
  EXPECT_EQ(fine->best.set.panel_friction, 0.7);  // held
}

TEST(SnowCalibration, TheOptimiserStaysWithinTheGrid) {
  SnowGrid grid;
  grid.friction = {0.6, 0.7};  // the best is below
  const auto result = calibrate(grid, 100, measured);
  ASSERT_TRUE(result);
  for (const ScoredSet& s : result->refined) {
    EXPECT_GE(s.set.friction, 0.6);
    EXPECT_LE(s.set.friction, 0.7);
  }
  EXPECT_NEAR(result->best.set.friction, 0.6, 1e-6);
}

TEST(SnowCalibration, EndsWhenItIsStopped) {
  int calls = 0;
  const auto stop_soon = [&](const std::vector<SnowSet>& sets) {
    return ++calls > 5 ? std::nullopt : measured(sets);
  };
  EXPECT_FALSE(calibrate({}, 100, stop_soon));
  EXPECT_EQ(calls, 6);
}

TEST(SnowCalibration, APileThatIsNotThereCountsWithItsWholeSize) {
  PileSize pile;
  pile.height = 0.1;
  pile.length = 0.3;
  const std::vector<LabPile> lab{{0.7, 1, 0.13, 0.3}, {0.7, 2, 0.04, 0.5}};
  const PileErrors errors = errors_against(lab, {pile, std::nullopt});
  EXPECT_NEAR(errors.height, std::sqrt((0.03 * 0.03 + 0.04 * 0.04) / 2), 1e-15);
  EXPECT_NEAR(errors.length, std::sqrt(0.25 / 2), 1e-15);
}

TEST(SnowCalibration, AnIndexIsARatioOfRelativeChanges) {
  EXPECT_NEAR(sensitivity_index(0.1, 0.13, 0.3, 0.6), 0.3, 1e-12);
  EXPECT_NEAR(sensitivity_index(0.1, 0.09, 2, 3), -0.2, 1e-12);
}

TEST(SnowCalibration, RefusesBadLaboratories) {
  const TemporaryFolder folder;
  const auto refusal = [&](const std::string& text) {
    const std::string file = folder.write("lab.csv", text);
    std::string message = error_of([&] { read_lab_piles(file); });
    const auto at = message.find(file);
    return at == std::string::npos ? message : message.substr(at + file.size());
  };
  const std::string head = "tilt_deg,event,height_m,length_m\n";
  EXPECT_EQ(refusal(head), ": there are 0 piles, must be at least 1");
  EXPECT_EQ(refusal("tilt_deg,event,height_m\n40,1,0.1\n"), ": there is no column 'length_m'");
  EXPECT_EQ(refusal("tilt_deg,event,height_m,length_m,snow\n40,1,0.1,0.2,3\n"),
            ": column 'snow' is not one of a table of the laboratory: tilt_deg, event, height_m, length_m");
  EXPECT_EQ(refusal(head + "40,0,0.1,0.2\n"), ": row 1: event is 0, must be a whole number from 1 to 1000");
  EXPECT_EQ(refusal(head + "40,1,nan,0.2\n"), ": row 1: height_m is nan, must be above 0 and at most 1e4");
  EXPECT_EQ(refusal(head + "95,1,0.1,0.2\n"), ": row 1: tilt_deg is 95, must be from 1 to 89");
  EXPECT_EQ(refusal(head + "40,1,0.1,0.2\n40,1,0.1,0.2\n"), ": row 2: event 1 at 40 degrees is there twice");
  SnowGrid none;
  none.cohesion.clear();
  EXPECT_EQ(error_of([&] { sets_of(none); }),
            "calibration: a list of values is empty, must have at least one");
}

}  // namespace
}  // namespace aeolian
