#include "aeolian_core/grains/draws.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

double density(double z) { return std::exp(-z * z / 2) / std::sqrt(2 * M_PI); }
double below(double z) { return std::erfc(-z / M_SQRT2) / 2; }

}  // namespace

int draw_poisson(double mean, RandomStream& random) {
  constexpr double largest = 30;  // of one inversion: the sum of two such numbers is such a number
  int count = 0;
  for (; mean > largest; mean -= largest) count += draw_poisson(largest, random);
  if (mean <= 0) return count;
  double probability = std::exp(-mean);
  double left = random.uniform() - probability;
  for (int k = 1; left > 0 && probability > 1e-18; ++k) {
    probability *= mean / k;
    left -= probability;
    ++count;
  }
  return count;
}

int draw_rounded(double mean, RandomStream& random) {
  const double whole = std::floor(mean);
  return static_cast<int>(whole) + (random.uniform() < mean - whole ? 1 : 0);
}

TruncatedNormal::TruncatedNormal(double mean, double deviation, double low, double high)
    : middle_(mean), width_(deviation), low_(low), high_(high) {
  // Moments of the cut distribution; middle and width follow theirs by what is missing until both agree.
  for (int i = 0; i < 2000; ++i) {
    const double a = (low - middle_) / width_;
    const double b = (high - middle_) / width_;
    const double share = below(b) - below(a);
    const double shift = (density(a) - density(b)) / share;
    const double variance = 1 + (a * density(a) - b * density(b)) / share - shift * shift;
    const double mean_error = mean - (middle_ + width_ * shift);
    const double ratio = deviation / (width_ * std::sqrt(variance));
    if (std::abs(mean_error) < 1e-9 * deviation && std::abs(ratio - 1) < 1e-9) return;
    if (!(share > 1e-3) || !std::isfinite(ratio)) break;
    middle_ += mean_error;
    width_ *= ratio;
  }
  throw Error("no normal distribution cut off at " + std::to_string(low) + " and " + std::to_string(high) +
              " has mean " + std::to_string(mean) + " and deviation " + std::to_string(deviation));
}

double TruncatedNormal::draw(RandomStream& random) const {
  for (;;) {
    const double value = middle_ + width_ * random.normal();
    if (value >= low_ && value <= high_) return value;
  }
}

LogNormal::LogNormal(double mean, double deviation) {
  const double square = std::log1p(deviation * deviation / (mean * mean));
  width_ = std::sqrt(square);
  middle_ = std::log(mean) - square / 2;
}

double LogNormal::at(double z) const { return std::exp(middle_ + width_ * z); }

CountDistribution::CountDistribution(double mean, double deviation) {
  const double variance = deviation * deviation;
  const bool tight = variance < mean;
  const double trials =
      tight ? std::ceil(mean * mean / (mean - variance)) : mean * mean / std::max(variance - mean, 1e-6);
  const double chance = tight ? mean / trials : mean / (trials + mean);
  double probability = std::pow(1 - chance, trials);
  double sum = 0;
  for (int k = 0; sum < 1 - 1e-10 && k < 1000; ++k) {
    sum += probability;
    up_to_.push_back(sum);
    probability *= tight ? (trials - k) / (k + 1) * chance / (1 - chance) : (trials + k) / (k + 1) * chance;
  }
}

int CountDistribution::draw(RandomStream& random) const {
  const double u = random.uniform();
  std::size_t count = 0;
  while (count + 1 < up_to_.size() && u > up_to_[count]) ++count;
  return static_cast<int>(count);
}

double draw_normal_above(double low, RandomStream& random) {
  if (low <= 0) {
    for (;;) {
      const double z = random.normal();
      if (z > low) return z;
    }
  }
  const double rate = (low + std::sqrt(low * low + 4)) / 2;
  for (;;) {
    const double z = low + random.exponential() / rate;
    if (random.uniform() < std::exp(-(z - rate) * (z - rate) / 2)) return z;
  }
}

}  // namespace aeolian
