#include "aeolian_core/bedforms/theory/periodic_profile.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {

double mean_wavelength(const std::vector<double>& height, double spacing) {
  const std::size_t count = height.size();
  if (count < 4 || std::all_of(height.begin(), height.end(), [&](double h) { return h == height.front(); }))
    throw Error("profile: too short or flat, it has no wavelength");
  double power = 0;
  double moment = 0;
  for (std::size_t n = 1; n <= count / 2; ++n) {
    const std::complex<double> turn =
        std::polar(1.0, -2 * M_PI * static_cast<double>(n) / static_cast<double>(count));
    std::complex<double> sum = 0;
    std::complex<double> phase = 1;
    for (const double h : height) {
      sum += h * phase;
      phase *= turn;
    }
    power += std::norm(sum);
    moment += std::norm(sum) * static_cast<double>(n);
  }
  return spacing * static_cast<double>(count) * power / moment;
}

double upslope_quantile(const std::vector<double>& height, double spacing, double share) {
  std::vector<double> rises;
  for (std::size_t i = 0; i < height.size(); ++i) {
    const double rise = height[(i + 1) % height.size()] - height[i];
    if (rise > 0) rises.push_back(rise);
  }
  if (rises.empty()) return 0;
  const auto place =
      rises.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(rises.size() - 1));
  std::nth_element(rises.begin(), place, rises.end());
  return std::atan(*place / spacing);
}

}  // namespace aeolian
