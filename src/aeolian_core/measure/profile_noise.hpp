#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace aeolian {

/// Standard deviation of white noise that would roughen neighbouring samples as much, from the median of the
/// second differences: ripples and single breaks hardly count.
double neighbour_noise(const std::vector<double>& z);

/// Noise like that of a measured profile: normal, with a standard error for each sample, correlated over
/// `correlated` samples (a moving sum of so many white ones).
class ProfileNoise {
 public:
  ProfileNoise(std::vector<double> sigma, std::size_t correlated);

  /// One draw, the same for the same number.
  std::vector<double> draw(std::uint64_t number) const;

 private:
  std::vector<double> sigma_;
  std::size_t correlated_;
};

}  // namespace aeolian
