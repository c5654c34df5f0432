#pragma once

#include <vector>

#include "aeolian_core/surface/random.hpp"

namespace aeolian {

/// Standard normal: Marsaglia and Tsang's ziggurat with 128 layers as Doornik (2005) improved it. Four times
/// as fast as RandomStream::normal().
double draw_normal(RandomStream& random);

/// Exponential with mean 1: Marsaglia and Tsang's ziggurat with 256 layers. Faster than
/// RandomStream::exponential().
double draw_exponential(RandomStream& random);

/// A whole number whose mean is `mean` and whose variance is the same.
int draw_poisson(double mean, RandomStream& random);

/// A whole number next to `mean` whose mean it is.
int draw_rounded(double mean, RandomStream& random);

/// A normal distribution cut off on both sides, told by its mean and standard deviation after the cut.
class TruncatedNormal {
 public:
  TruncatedNormal() = default;
  /// Throws Error when no cut normal distribution has these.
  TruncatedNormal(double mean, double deviation, double low, double high);
  double draw(RandomStream& random) const;

  double middle() const { return middle_; }  ///< before the cut
  double width() const { return width_; }    ///< before the cut

 private:
  double middle_ = 0, width_ = 0, low_ = 0, high_ = 0;
};

/// A log-normal distribution told by its own mean and standard deviation.
class LogNormal {
 public:
  LogNormal() = default;
  LogNormal(double mean, double deviation);
  /// The value that a standard normal number stands for.
  double at(double z) const;

 private:
  double middle_ = 0, width_ = 0;
};

/// Whole numbers from zero with this mean and standard deviation: binomial where they vary less than by
/// chance, negative binomial where more.
class CountDistribution {
 public:
  CountDistribution() = default;
  CountDistribution(double mean, double deviation);
  int draw(RandomStream& random) const;

 private:
  std::vector<double> up_to_;  ///< probability of at most so many
};

/// Standard normal above `low`: by exponentials in the tail (Robert 1995).
double draw_normal_above(double low, RandomStream& random);

}  // namespace aeolian
