#include "aeolian_core/grains/splash/reptation.hpp"

#include <algorithm>
#include <cmath>

#include "aeolian_core/grains/grain.hpp"

namespace aeolian {

double hop_length(double horizontal, double upward, double slope) {
  const double over_the_bed = upward - horizontal * std::tan(slope);
  return 2 * horizontal * std::max(0.0, over_the_bed) / gravity;
}

double mean_reptation(double level, double number, double mean_square_speed, double slope) {
  return level - 2 * number * mean_square_speed * std::tan(slope) / gravity;
}

}  // namespace aeolian
