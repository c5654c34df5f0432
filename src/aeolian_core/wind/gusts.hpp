#pragma once

#include <cstdint>
#include <vector>

namespace aeolian {

/// Components of gusts: along the mean wind, across it, upwards.
enum class GustComponent { along, across, up };

/// Kaimal's spectra of the surface layer (Kaimal et al. 1972), one-sided, over the square of the friction
/// velocity: n S/u*^2 at the reduced frequency f = n z/U.
double kaimal_spectrum(GustComponent component, double reduced_frequency);

/// Their integrals' roots: the standard deviation of each component over u*, 2.18, 1.64 and 1.21.
double kaimal_deviation(GustComponent component);

/// Where gusts are wanted.
struct GustSetting {
  double speed = 0;              ///< mean, U [m/s]
  double height = 0;             ///< over the ground, z [m]
  double friction_velocity = 0;  ///< [m/s]
  double step = 0.05;            ///< of time [s]
  std::size_t samples = 4096;
};

/// Departures from the mean wind [m/s], equally spaced in time.
struct Gusts {
  double step = 0;  ///< [s]
  std::vector<double> along, across, up;
};

/// Gusts with Kaimal's spectra between the slowest wave of the record and the fastest that its step resolves,
/// with phases at random; the components do not know of each other. Throws Error for what is not positive, or
/// fewer than 16 samples.
Gusts synthetic_gusts(const GustSetting& setting, std::uint64_t seed);

/// The power spectrum of a record without its mean and trend: one-sided, so that its sum times the spacing of
/// its frequencies is the variance.
struct GustSpectrum {
  std::vector<double> frequency;  ///< [1/s], from the slowest wave on
  std::vector<double> density;    ///< [(m/s)^2 s]
  double spacing = 0;             ///< [1/s]
};
/// Throws Error for fewer than 16 samples or a step that is not positive.
GustSpectrum gust_spectrum(const std::vector<double>& record, double step);

}  // namespace aeolian
