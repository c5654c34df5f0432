#include "aeolian_core/measure/sensor_noise.hpp"

#include <algorithm>
#include <cmath>

#include "aeolian_core/surface/require.hpp"

namespace aeolian {
namespace {

constexpr Require require{"sensor noise"};

}  // namespace

double SensorNoise::along_ray(double range, double cosine) const {
  const double polynomial =
      range_sigma + range * (range_sigma_per_metre + range * range_sigma_per_square_metre);
  return polynomial * (1 + incidence_growth * (1 / std::max(cosine, least_cosine) - 1));
}

double SensorNoise::height_variance(double range, double cosine) const {
  const double along = along_ray(range, cosine);
  const double across = range * angular_sigma;
  const double cos2 = cosine * cosine;
  const double sin2 = 1 - cos2;
  constexpr double m2 = bed_slope * bed_slope;
  return along * along * (cos2 + m2 * sin2) + across * across * (sin2 + m2 * cos2);
}

void SensorNoise::require_valid() const {
  const auto finite = [](double v) { return std::isfinite(v); };
  require(min_range >= 0 && finite(min_range), "min_range", min_range, "zero or positive");
  require(max_range > min_range, "max_range", max_range, "greater than min_range");
  require(range_sigma > 0 && finite(range_sigma), "range_sigma", range_sigma, "positive and finite");
  require(finite(range_sigma_per_metre), "range_sigma_per_metre", range_sigma_per_metre, "finite");
  require(finite(range_sigma_per_square_metre) && range_sigma_per_square_metre >= 0,
          "range_sigma_per_square_metre", range_sigma_per_square_metre, "zero or positive");
  require(angular_sigma >= 0 && angular_sigma < 1, "angular_sigma", angular_sigma, "from 0 to 1 rad");
  require(incidence_growth >= 0 && incidence_growth <= 10, "incidence_growth", incidence_growth,
          "from 0 to 10");
  require(finite(range_bias), "range_bias", range_bias, "finite");
  if (range_sigma_per_metre >= 0) return;
  const double bottom = range_sigma_per_square_metre > 0
                            ? -range_sigma_per_metre / (2 * range_sigma_per_square_metre)
                            : max_range;
  const double least = along_ray(std::clamp(bottom, min_range, max_range), 1);
  require(least > 0, "range_sigma_per_metre", range_sigma_per_metre,
          "so large that the noise stays positive between min_range and max_range");
}

}  // namespace aeolian
