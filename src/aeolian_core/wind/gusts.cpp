#include "aeolian_core/wind/gusts.hpp"

#include <cmath>

#include "aeolian_core/surface/random.hpp"
#include "aeolian_core/surface/require.hpp"
#include "aeolian_core/wind/fourier.hpp"

namespace aeolian {
namespace {

constexpr Require require("gusts");
constexpr std::size_t fewest = 16;
constexpr std::size_t most = std::size_t{1} << 26;

void require_record(std::size_t samples, double step) {
  require(samples >= fewest && samples <= most, "number of samples", static_cast<double>(samples),
          "16 to 67108864");
  require(step > 0 && std::isfinite(step), "step", step, "positive [s]");
}

}  // namespace

double kaimal_spectrum(GustComponent component, double f) {
  switch (component) {
    case GustComponent::along:
      return 105 * f / std::pow(1 + 33 * f, 5.0 / 3);
    case GustComponent::across:
      return 17 * f / std::pow(1 + 9.5 * f, 5.0 / 3);
    default:
      return 2 * f / (1 + 5.3 * std::pow(f, 5.0 / 3));
  }
}

double kaimal_deviation(GustComponent component) {
  switch (component) {
    case GustComponent::along:
      return std::sqrt(1.5 * 105 / 33);
    case GustComponent::across:
      return std::sqrt(1.5 * 17 / 9.5);
    // The integral of 2/(1 + a x^(5/3)) is 2 a^(-3/5) (3 pi/5)/sin(3 pi/5).
    default:
      return std::sqrt(2 * std::pow(5.3, -0.6) * 0.6 * M_PI / std::sin(0.6 * M_PI));
  }
}

Gusts synthetic_gusts(const GustSetting& setting, std::uint64_t seed) {
  require_record(setting.samples, setting.step);
  require(setting.speed > 0 && std::isfinite(setting.speed), "mean speed", setting.speed, "positive [m/s]");
  require(setting.height > 0 && std::isfinite(setting.height), "height", setting.height, "positive [m]");
  require(setting.friction_velocity >= 0 && std::isfinite(setting.friction_velocity), "friction velocity",
          setting.friction_velocity, "zero or positive [m/s]");
  const auto n = static_cast<int>(setting.samples);
  const Fourier fourier(n, 1);
  const double spacing = 1 / (n * setting.step);
  const auto component = [&](GustComponent which) {
    RandomStream random(seed, static_cast<std::uint64_t>(which));
    Fourier::Spectrum waves(static_cast<std::size_t>(fourier.columns()));
    for (std::size_t i = 1; 2 * i < setting.samples; ++i) {
      const double frequency = static_cast<double>(i) * spacing;
      const double density = setting.friction_velocity * setting.friction_velocity *
                             kaimal_spectrum(which, frequency * setting.height / setting.speed) / frequency;
      // A wave of amplitude a has half of it in either sign's coefficient.
      const double half = 0.5 * n * std::sqrt(2 * density * spacing);
      waves[i] = Fourier::Spectrum::value_type(std::polar(half, 2 * M_PI * random.uniform()));
    }
    const std::vector<float> values = fourier.inverse(std::move(waves), 1);
    return std::vector<double>(values.begin(), values.end());
  };
  return {setting.step, component(GustComponent::along), component(GustComponent::across),
          component(GustComponent::up)};
}

GustSpectrum gust_spectrum(const std::vector<double>& record, double step) {
  require_record(record.size(), step);
  const auto n = static_cast<double>(record.size());
  double mean = 0;
  double trend = 0;
  for (std::size_t i = 0; i < record.size(); ++i) {
    mean += record[i] / n;
    trend += record[i] * (static_cast<double>(i) - 0.5 * (n - 1));
  }
  trend /= n * (n * n - 1) / 12;
  std::vector<float> rest(record.size());
  for (std::size_t i = 0; i < record.size(); ++i)
    rest[i] = static_cast<float>(record[i] - mean - trend * (static_cast<double>(i) - 0.5 * (n - 1)));
  const Fourier fourier(static_cast<int>(record.size()), 1);
  const Fourier::Spectrum waves = fourier.forward(rest);
  GustSpectrum spectrum;
  spectrum.spacing = 1 / (n * step);
  for (std::size_t i = 1; 2 * i <= record.size(); ++i) {
    const double both = 2 * i == record.size() ? 1 : 2;  // signs of the frequency
    spectrum.frequency.push_back(static_cast<double>(i) * spectrum.spacing);
    spectrum.density.push_back(both * static_cast<double>(std::norm(waves[i])) * step / n);
  }
  return spectrum;
}

}  // namespace aeolian
