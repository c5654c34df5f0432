#include "aeolian_core/wind/spectral_volume.hpp"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "aeolian_core/surface/require.hpp"
#include "aeolian_core/wind/wave_table.hpp"

namespace aeolian {
namespace {

constexpr Require require("wind volume");
using Complex = Fourier::Spectrum::value_type;
constexpr double growth = 1.25;  ///< of the thickness of layers

/// Where ln(z) has its mean over a layer.
double log_mean_height(double low, double high) {
  if (low <= 0) return high / M_E;
  return std::exp((high * std::log(high) - low * std::log(low)) / (high - low) - 1);
}

/// Linear interpolation between the points i and i + 1 of n, held within them.
struct Between {
  Between(double at, int n) {
    at = std::clamp(at, 0.0, n - 1.0);
    low = std::min(static_cast<int>(at), std::max(n - 2, 0));
    high = std::min(low + 1, n - 1);
    part = at - low;
  }
  int low, high;
  double part;
};

template <class Value>
double bilinear(const Between& x, const Between& y, Value&& value) {
  return (1 - y.part) * ((1 - x.part) * value(x.low, y.low) + x.part * value(x.high, y.low)) +
         y.part * ((1 - x.part) * value(x.low, y.high) + x.part * value(x.high, y.high));
}

}  // namespace

SpectralVolume::SpectralVolume(const WindRelief& relief, double direction, const UpwindProfile& upwind,
                               const LeeBubble& bubble, double top)
    : geometry_(relief.geometry), upwind_(upwind), direction_(direction) {
  require(top > 0 && std::isfinite(top), "top", top, "positive [m]");
  require(std::isfinite(direction), "direction", direction, "finite [rad]");
  ShelteredRelief shelter = sheltered(relief, direction, bubble);
  relief_ = std::move(shelter.relief);
  if (!shelter.separated.empty()) {
    raised_.resize(relief_.height.size());
    for (std::size_t i = 0; i < raised_.size(); ++i) raised_[i] = relief_.height[i] - relief.height[i];
  }
  const ReliefSpectrum spectrum(relief_);
  // The inner layer of the shortest wave is some layers deep.
  const double shortest = 1 / spectrum.shortest();
  double face = upwind.sheared()
                    ? std::max(20 * upwind.roughness(), 0.5 * inner_depth(shortest, upwind.roughness()))
                    : 0.5 * shortest;
  faces_ = {0, face};
  while (faces_.back() < top) faces_.push_back(face *= growth);
  for (std::size_t i = 0; i + 1 < faces_.size(); ++i)
    centres_.push_back(upwind.sheared() ? log_mean_height(faces_[i], faces_[i + 1])
                                        : 0.5 * (faces_[i] + faces_[i + 1]));
  flows_ = FaceFlows(geometry_.nx(), geometry_.ny(), static_cast<int>(centres_.size()));
  blow(spectrum);
  raise();
}

void SpectralVolume::blow(const ReliefSpectrum& spectrum) {
  const Fourier& fourier = spectrum.fourier();
  const double c = std::cos(direction_);
  const double s = std::sin(direction_);
  const double cell = geometry_.cell();
  const int nx = geometry_.nx();
  const int ny = geometry_.ny();
  const int rows = std::min(ny + 1, fourier.ny());
  for (int iz = 0; iz < flows_.nz(); ++iz) {
    const auto level = static_cast<std::size_t>(iz);
    const double height = centres_[level];
    const double area = cell * (faces_[level + 1] - faces_[level]);
    const double speed = upwind_.speed(height);
    const WaveTable table(upwind_, spectrum.longest(), spectrum.shortest(),
                          [&](const ReliefWave& wave) { return wave.velocity(height); });
    Fourier::Spectrum east(spectrum.spectrum().size());
    Fourier::Spectrum north(spectrum.spectrum().size());
    tbb::parallel_for(0, fourier.ny(), [&](int row) {
      spectrum.for_each_wave(row, [&](std::size_t i, double kx, double ky) {
        const WaveTable::Parts r =
            table(static_cast<float>(c * kx + s * ky), static_cast<float>(c * ky - s * kx));
        const std::complex<double> along(r.along_real, r.along_imaginary);
        const std::complex<double> across(r.across_real, r.across_imaginary);
        const std::complex<double> h(spectrum.spectrum()[i]);
        // Faces lie half a cell before the middles of cells.
        east[i] = Complex(h * (c * along - s * across) * std::polar(1.0, -0.5 * kx * cell));
        north[i] = Complex(h * (s * along + c * across) * std::polar(1.0, -0.5 * ky * cell));
      });
    });
    const std::vector<float> u = fourier.inverse(std::move(east), ny);
    const std::vector<float> v = fourier.inverse(std::move(north), rows);
    const auto at = [&](const std::vector<float>& grid, int x, int y) {
      return static_cast<double>(
          grid[static_cast<std::size_t>(y % fourier.ny()) * static_cast<std::size_t>(fourier.nx()) +
               static_cast<std::size_t>(x % fourier.nx())]);
    };
    tbb::parallel_for(0, ny + 1, [&](int y) {
      for (int x = 0; x <= nx; ++x) {
        if (y < ny) flows_.x(x, y, iz) = area * (c * speed + at(u, x, y));
        if (x < nx) flows_.y(x, y, iz) = area * (s * speed + at(v, x, y));
      }
    });
  }
}

void SpectralVolume::raise() {
  tbb::parallel_for(0, geometry_.ny(), [&](int y) {
    for (int x = 0; x < geometry_.nx(); ++x)
      for (int z = 0; z < flows_.nz(); ++z)
        flows_.z(x, y, z + 1) = flows_.z(x, y, z) + flows_.x(x, y, z) - flows_.x(x + 1, y, z) +
                                flows_.y(x, y, z) - flows_.y(x, y + 1, z);
  });
}

AirVelocity SpectralVolume::level(double x, double y, int iz) const {
  const auto i = static_cast<std::size_t>(iz);
  const double area = geometry_.cell() * (faces_[i + 1] - faces_[i]);
  const Between cell_x(x, flows_.nx());
  const Between cell_y(y, flows_.ny());
  const Between face_x(x + 0.5, flows_.nx() + 1);
  const Between face_y(y + 0.5, flows_.ny() + 1);
  return {bilinear(face_x, cell_y, [&](int ix, int iy) { return flows_.x(ix, iy, iz); }) / area,
          bilinear(cell_x, face_y, [&](int ix, int iy) { return flows_.y(ix, iy, iz); }) / area, 0};
}

AirVelocity SpectralVolume::velocity(double px, double py, double height) const {
  if (!geometry_.find(px, py) || !(height <= top())) return {NAN, NAN, NAN};
  const double x = (px - geometry_.origin_x()) / geometry_.cell() - 0.5;
  const double y = (py - geometry_.origin_y()) / geometry_.cell() - 0.5;
  const Between cell_x(x, flows_.nx());
  const Between cell_y(y, flows_.ny());
  if (!raised_.empty())
    height -= bilinear(cell_x, cell_y, [&](int ix, int iy) { return raised_[geometry_.index(ix, iy)]; });
  if (height <= upwind_.roughness()) return {};
  const auto above =
      static_cast<int>(std::upper_bound(centres_.begin(), centres_.end(), height) - centres_.begin());
  AirVelocity wind;
  if (above == 0 || above == flows_.nz()) {
    // Below the first layer's height a log law down to the roughness length.
    wind = level(x, y, std::min(above, flows_.nz() - 1));
    const double part =
        above == 0 && upwind_.sheared() ? upwind_.speed(height) / upwind_.speed(centres_[0]) : 1;
    wind.east *= part;
    wind.north *= part;
  } else {
    const AirVelocity low = level(x, y, above - 1);
    const AirVelocity high = level(x, y, above);
    const double z0 = centres_[static_cast<std::size_t>(above - 1)];
    const double z1 = centres_[static_cast<std::size_t>(above)];
    const double part =
        upwind_.sheared() ? std::log(height / z0) / std::log(z1 / z0) : (height - z0) / (z1 - z0);
    wind = {low.east + part * (high.east - low.east), low.north + part * (high.north - low.north), 0};
  }
  const auto face = static_cast<int>(std::upper_bound(faces_.begin(), faces_.end(), height) - faces_.begin());
  const int below = std::min(face, flows_.nz()) - 1;
  const double low = faces_[static_cast<std::size_t>(below)];
  const double part = std::min(1.0, (height - low) / (faces_[static_cast<std::size_t>(below + 1)] - low));
  const double through = bilinear(cell_x, cell_y, [&](int ix, int iy) {
    return (1 - part) * flows_.z(ix, iy, below) + part * flows_.z(ix, iy, below + 1);
  });
  const auto slope = [&](auto&& component) {
    return bilinear(cell_x, cell_y, [&](int ix, int iy) { return component(slope_at(relief_, ix, iy)); });
  };
  wind.up = through / (geometry_.cell() * geometry_.cell()) + wind.east * slope([](Slope s) { return s.x; }) +
            wind.north * slope([](Slope s) { return s.y; });
  return wind;
}

}  // namespace aeolian
