#include "aeolian_core/wind/spectral_wind.hpp"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include "aeolian_core/surface/require.hpp"
#include "aeolian_core/wind/wave_table.hpp"

namespace aeolian {
namespace {

constexpr Require require("wind over relief");

/// The stress of each cell, relative to that of flat ground, along and across the wind.
struct Stress {
  std::vector<float> along;
  std::vector<float> across;
  int row = 0;  ///< length of a row
};

Stress stress_of(const ReliefSpectrum& relief, int rows, const UpwindProfile& upwind, double direction) {
  const WaveTable table(upwind, relief.longest(), relief.shortest(),
                        [](const ReliefWave& wave) { return wave.stress(); });
  const double c = std::cos(direction);
  const double s = std::sin(direction);
  Fourier::Spectrum along(relief.spectrum().size());
  Fourier::Spectrum across(relief.spectrum().size());
  const Fourier& fourier = relief.fourier();
  tbb::parallel_for(0, fourier.ny(), [&](int row) {
    relief.for_each_wave(row, [&](std::size_t i, double kx, double ky) {
      const WaveTable::Parts r =
          table(static_cast<float>(c * kx + s * ky), static_cast<float>(c * ky - s * kx));
      const float real = relief.spectrum()[i].real();
      const float imaginary = relief.spectrum()[i].imag();
      // Written out: the library's product of complex numbers looks for infinities.
      along[i] = {real * r.along_real - imaginary * r.along_imaginary,
                  real * r.along_imaginary + imaginary * r.along_real};
      across[i] = {real * r.across_real - imaginary * r.across_imaginary,
                   real * r.across_imaginary + imaginary * r.across_real};
    });
  });
  Stress result;
  result.row = fourier.nx();
  tbb::parallel_invoke([&] { result.along = fourier.inverse(std::move(along), rows); },
                       [&] { result.across = fourier.inverse(std::move(across), rows); });
  return result;
}

}  // namespace

double ReliefSettings::shortest() const {
  constexpr double in_roughness = 200;  // roughness lengths: shorter waves are part of it
  return std::max(shortest_wavelength, in_roughness * roughness);
}

SpectralWind::SpectralWind(const ReliefSettings& settings) : settings_(settings) {
  UpwindProfile::log_law(settings.roughness);
  require(settings.shortest_wavelength >= 0 && std::isfinite(settings.shortest_wavelength),
          "shortest wavelength", settings.shortest_wavelength, "zero or positive [m]");
  require(settings.bubble.steepest > 0 && settings.bubble.steepest <= settings.bubble.onset,
          "downslope of a bubble", settings.bubble.steepest, "positive and at most the slope of separation");
}

TerrainResponse SpectralWind::solve(const HeightMap& surface, double direction) const {
  TerrainResponse response = solve(wind_relief(surface, settings_.shortest(), settings_.periodic), direction);
  const HeightMap::Layer& elevation = surface.layer(layer::elevation);
  for (std::size_t i = 0; i < elevation.size(); ++i)
    if (!std::isfinite(elevation[i]))
      response.friction[i] = response.deflection[i] = response.separated[i] = HeightMap::unknown;
  return response;
}

TerrainResponse SpectralWind::solve(const WindRelief& relief, double direction) const {
  require(std::isfinite(direction), "direction", direction, "finite [rad]");
  const ShelteredRelief shelter = sheltered(relief, direction, settings_.bubble);
  const GridGeometry& g = relief.geometry;
  TerrainResponse response{g, HeightMap::Layer(g.size()), HeightMap::Layer(g.size()),
                           HeightMap::Layer(shelter.separated.begin(), shelter.separated.end())};
  if (response.separated.empty()) response.separated.assign(g.size(), 0);
  if (g.size() == 1) {
    response.friction[0] = 1;
    return response;
  }
  const Stress stress = stress_of(ReliefSpectrum(shelter.relief), g.ny(),
                                  UpwindProfile::log_law(settings_.roughness), direction);
  tbb::parallel_for(0, g.ny(), [&](int y) {
    for (int x = 0; x < g.nx(); ++x) {
      const std::size_t cell = g.index(x, y);
      if (response.separated[cell] > 0) continue;
      const auto i =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(stress.row) + static_cast<std::size_t>(x);
      const float along = 1 + stress.along[i];
      const float across = stress.across[i];
      if (along <= 0) continue;  // the wind that theory knows is at rest there
      response.friction[cell] = std::sqrt(std::sqrt(along * along + across * across));
      response.deflection[cell] = std::atan2(across, along);
    }
  });
  return response;
}

}  // namespace aeolian
