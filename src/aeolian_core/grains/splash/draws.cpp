#include "aeolian_core/grains/splash/draws.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

double density(double z) { return std::exp(-z * z / 2) / std::sqrt(2 * M_PI); }
double below(double z) { return std::erfc(-z / M_SQRT2) / 2; }

/// Layers of equal area under a falling density from x = 0: layer i reaches from 0 to x[i], all of it below
/// x[i + 1] is under the density; the lowest holds the tail as well.
template <unsigned Layers>
struct Ziggurat {
  std::array<double, Layers + 1> x;
  std::array<double, Layers + 1> height;  ///< of the density at x

  template <typename Density, typename Inverse>
  Ziggurat(double tail, double area, const Density& at, const Inverse& where) {
    x[0] = area / at(tail);
    x[1] = tail;
    x[Layers] = 0;
    for (unsigned i = 2; i < Layers; ++i) x[i] = where(area / x[i - 1] + at(x[i - 1]));
    for (unsigned i = 0; i <= Layers; ++i) height[i] = at(x[i]);
  }
};

constexpr double normal_tail = 3.442619855899;
const Ziggurat<128> normal_layers(
    normal_tail, 9.91256303526217e-3, [](double x) { return std::exp(-x * x / 2); },
    [](double y) { return std::sqrt(-2 * std::log(y)); });

constexpr double exponential_tail = 7.69711747013104972;
const Ziggurat<256> exponential_layers(
    exponential_tail, 3.9496598225815571993e-3, [](double x) { return std::exp(-x); },
    [](double y) { return -std::log(y); });

/// Whether a point at random over x in a layer, beside what is surely under the density, is under it.
template <unsigned Layers>
bool under(const Ziggurat<Layers>& all, unsigned layer, double density_there, RandomStream& random) {
  const double low = all.height[layer], high = all.height[layer + 1];
  return low + random.uniform() * (high - low) < density_there;
}

}  // namespace

double draw_normal(RandomStream& random) {
  for (;;) {
    const double u = 2 * random.uniform() - 1;
    const unsigned layer = random.bits() % 128;
    const double x = u * normal_layers.x[layer];
    if (std::abs(x) < normal_layers.x[layer + 1]) return x;
    if (layer > 0) {
      if (under(normal_layers, layer, std::exp(-x * x / 2), random)) return x;
      continue;
    }
    for (;;) {
      const double beyond = draw_exponential(random) / normal_tail;
      if (2 * draw_exponential(random) > beyond * beyond) return std::copysign(normal_tail + beyond, u);
    }
  }
}

double draw_exponential(RandomStream& random) {
  double passed = 0;  // of the tail, which is the whole again
  for (;;) {
    const unsigned layer = random.bits() % 256;
    const double x = random.uniform() * exponential_layers.x[layer];
    if (x < exponential_layers.x[layer + 1]) return passed + x;
    if (layer == 0)
      passed += exponential_tail;
    else if (under(exponential_layers, layer, std::exp(-x), random))
      return passed + x;
  }
}

int draw_poisson(double mean, RandomStream& random) {
  constexpr double largest = 30;  // of one inversion: the sum of two such numbers is such a number
  int count = 0;
  while (mean > largest) {
    count += draw_poisson(largest, random);
    mean -= largest;
  }
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
    const double value = middle_ + width_ * draw_normal(random);
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
      const double z = draw_normal(random);
      if (z > low) return z;
    }
  }
  const double rate = (low + std::sqrt(low * low + 4)) / 2;
  for (;;) {
    const double z = low + draw_exponential(random) / rate;
    const double half_square = (z - rate) * (z - rate) / 2;
    const double u = random.uniform();
    if (u < 1 - half_square || u < std::exp(-half_square)) return z;
  }
}

}  // namespace aeolian
