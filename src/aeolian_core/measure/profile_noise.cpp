#include "aeolian_core/measure/profile_noise.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "aeolian_core/surface/median.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {

double neighbour_noise(const std::vector<double>& z) {
  std::vector<double> bends;
  for (std::size_t i = 2; i < z.size(); ++i) bends.push_back(std::abs(z[i] - 2 * z[i - 1] + z[i - 2]));
  if (bends.empty()) return 0;
  return sigma_per_median * median(bends) / std::sqrt(6.0);
}

ProfileNoise::ProfileNoise(std::vector<double> sigma, std::size_t correlated)
    : sigma_(std::move(sigma)), correlated_(std::max<std::size_t>(1, correlated)) {}

std::vector<double> ProfileNoise::draw(std::uint64_t number) const {
  RandomStream random(1987, number);
  std::vector<double> white(sigma_.size() + correlated_ - 1);
  for (double& w : white) w = random.normal();
  std::vector<double> noise(sigma_.size());
  const double share = 1 / std::sqrt(static_cast<double>(correlated_));
  for (std::size_t i = 0; i < noise.size(); ++i) {
    for (std::size_t k = 0; k < correlated_; ++k) noise[i] += white[i + k];
    noise[i] *= share * sigma_[i];
  }
  return noise;
}

}  // namespace aeolian
