#include "aeolian_core/measure/virtual_anemometer.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {

std::vector<VirtualAnemometer::Sample> VirtualAnemometer::record(double duration, double rate,
                                                                 std::uint64_t seed) const {
  if (!(rate > 0 && std::isfinite(rate)))
    throw Error("anemometer: rate is " + std::to_string(rate) + " Hz, must be positive");
  if (!(gust_time > 0))
    throw Error("anemometer: gust_time is " + std::to_string(gust_time) + " s, must be positive");
  if (!(duration >= 0 && duration * rate < 1e9))
    throw Error("anemometer: duration is " + std::to_string(duration) + " s, must be from 0 to 1e9 samples");
  const double kept = std::exp(-1 / (rate * gust_time));
  const double fresh = std::sqrt(1 - kept * kept);
  RandomStream speeds(seed, 0);
  RandomStream directions(seed, 1);
  double gust = speeds.normal();
  double turn = directions.normal();
  const auto count = static_cast<std::size_t>(std::ceil(duration * rate - 1e-9));
  std::vector<Sample> samples;
  samples.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    samples.push_back({static_cast<double>(i) / rate, std::max(0.0, mean_speed * (1 + gust_intensity * gust)),
                       std::remainder(direction + direction_sigma * turn, 2 * M_PI)});
    gust = kept * gust + fresh * speeds.normal();
    turn = kept * turn + fresh * directions.normal();
  }
  return samples;
}

}  // namespace aeolian
