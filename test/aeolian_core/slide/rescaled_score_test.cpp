#include "aeolian_core/slide/calibration/rescaled_score.hpp"

#include "../../error_of.hpp"
#include <gtest/gtest.h>

namespace aeolian {
namespace {

// The thesis' winner: (0.014 - 0.009) / 0.058 and (0.067 - 0.034) / 0.084 average to 0.2395 (it prints
// 0.237).
TEST(RescaledScore, TheWinnersOfTheThesis) {
  const auto scores = rescaled_scores({{0.009, 0.118}, {0.014, 0.067}, {0.067, 0.034}});
  EXPECT_NEAR(scores[1], 0.24, 0.005);
  EXPECT_DOUBLE_EQ(scores[0], 0.5);
  EXPECT_DOUBLE_EQ(scores[2], 0.5);
}

TEST(RescaledScore, NeedsSetsThatDiffer) {
  EXPECT_NE(error_of([] {
              rescaled_scores({{0.1, 0.1}, {0.1, 0.2}});
            }).find("must differ"),
            std::string::npos);
  EXPECT_NE(error_of([] { rescaled_scores({}); }).find("must differ"), std::string::npos);
}

}  // namespace
}  // namespace aeolian
