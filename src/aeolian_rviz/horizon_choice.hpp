#pragma once

#include <string>
#include <vector>

#include <aeolian_msgs/ForecastHorizons.h>

namespace aeolian {

/// What a slider over the horizons of the forecasts says: position 0 is the surface as measured now, each
/// further one the next lead time.
class HorizonChoice {
 public:
  void take(aeolian_msgs::ForecastHorizons horizons) { horizons_ = std::move(horizons); }

  /// Of the last position; 0 while there is no forecast.
  int last() const { return static_cast<int>(horizons_.lead_times.size()); }
  /// Of the one shown: the position nearest to it.
  int chosen() const;
  /// Lead time at a position [s].
  double lead_time(int position) const;
  /// Beside the slider: "now", "30 s", "5 min".
  std::string mark(int position) const;
  /// "Predicted 5 min ahead".
  std::string title(int position) const;
  /// "for 14:05:00 UTC, from the surface at 14:00:00 UTC"; the time alone where the clock does not count from
  /// 1970 (a simulation's).
  std::string times(int position) const;

 private:
  aeolian_msgs::ForecastHorizons horizons_;
};

}  // namespace aeolian
