#include "aeolian_twin/nodes/score_output.hpp"

#include <utility>

#include <fmt/format.h>

#include "aeolian_twin/nodes/conversions.hpp"

namespace aeolian {

void put_out(std::vector<ForecastScorer::Score> scores, ForecastScorer& scorer, const ScoreOutput& out) {
  for (ForecastScorer::Score& score : scores) {
    std_msgs::Header header;
    header.frame_id = out.frame;
    header.stamp = out.clock.stamp(score.time);
    if (!score.refused.empty()) {
      out.tell(
          "forecast", false,
          fmt::format("a forecast for {}.{:09}: {}", header.stamp.sec, header.stamp.nsec, score.refused));
      continue;
    }
    out.comparison(to_message(score.comparison, header, out.clock.stamp(score.issued)));
    header.stamp = out.clock.stamp(score.measured_time);
    out.difference(to_message(score.difference, header));
    scorer.reuse(std::move(score.difference));
    out.tell("forecast", true,
             fmt::format(
                 "the last one, {:.0f} s ahead, has an RMSE of {:.3g} mm and a skill of {:.2f} against "
                 "persistence",
                 score.time - score.issued, 1e3 * score.comparison.rmse, score.comparison.skill_persistence));
  }
}

}  // namespace aeolian
