#include "aeolian_core/wind/relief_spectrum.hpp"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

namespace aeolian {
namespace {

/// a + b x + c y of least squares over a whole grid, about its middle.
struct Plane {
  double mean = 0, slope_x = 0, slope_y = 0;
};

Plane middle_plane(const WindRelief& relief) {
  const GridGeometry& g = relief.geometry;
  Plane plane;
  double xx = 0;
  double yy = 0;
  for (int y = 0; y < g.ny(); ++y) {
    const double dy = y - 0.5 * (g.ny() - 1);
    for (int x = 0; x < g.nx(); ++x) {
      const double dx = x - 0.5 * (g.nx() - 1);
      const double h = relief.height[g.index(x, y)];
      plane.mean += h;
      plane.slope_x += h * dx;
      plane.slope_y += h * dy;
      xx += dx * dx;
      yy += dy * dy;
    }
  }
  plane.mean /= static_cast<double>(g.size());
  plane.slope_x = xx > 0 && !relief.periodic ? plane.slope_x / xx : 0;
  plane.slope_y = yy > 0 && !relief.periodic ? plane.slope_y / yy : 0;
  return plane;
}

int padded(int n, bool periodic) { return n == 1 || periodic ? n : Fourier::good_count(2 * n); }

/// How much of a border is left in each cell of the padding beyond it; nothing from halfway on.
std::vector<float> remains(int padding) {
  std::vector<float> parts(static_cast<std::size_t>(padding));
  const double reach = 0.5 * padding + 0.5;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const double distance = static_cast<double>(i) + 1;
    parts[i] = distance < reach ? static_cast<float>(0.5 * (1 + std::cos(M_PI * distance / reach))) : 0.0F;
  }
  return parts;
}

}  // namespace

ReliefSpectrum::ReliefSpectrum(const WindRelief& relief) {
  const GridGeometry& g = relief.geometry;
  const int nx = padded(g.nx(), relief.periodic);
  const int ny = padded(g.ny(), relief.periodic);
  fourier_ = std::make_unique<Fourier>(nx, ny);
  unit_x_ = 2 * M_PI / (nx * g.cell());
  unit_y_ = 2 * M_PI / (ny * g.cell());
  const Plane plane = middle_plane(relief);
  std::vector<float> grid(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny));
  const auto at = [&](int x, int y) -> float& {
    return grid[static_cast<std::size_t>(y) * static_cast<std::size_t>(nx) + static_cast<std::size_t>(x)];
  };
  const std::vector<float> beside = remains(nx - g.nx());
  const std::vector<float> beyond = remains(ny - g.ny());
  tbb::parallel_for(0, g.ny(), [&](int y) {
    const double row = plane.mean + plane.slope_y * (y - 0.5 * (g.ny() - 1));
    for (int x = 0; x < g.nx(); ++x)
      at(x, y) =
          static_cast<float>(relief.height[g.index(x, y)] - row - plane.slope_x * (x - 0.5 * (g.nx() - 1)));
    for (std::size_t i = 0; i < beside.size(); ++i)
      at(g.nx() + static_cast<int>(i), y) =
          beside[i] * at(g.nx() - 1, y) + beside[beside.size() - 1 - i] * at(0, y);
  });
  tbb::parallel_for(0, ny - g.ny(), [&](int i) {
    const float last = beyond[static_cast<std::size_t>(i)];
    const float first = beyond[beyond.size() - 1 - static_cast<std::size_t>(i)];
    for (int x = 0; x < nx; ++x) at(x, g.ny() + i) = last * at(x, g.ny() - 1) + first * at(x, 0);
  });
  spectrum_ = fourier_->forward(grid);
}

double ReliefSpectrum::longest() const {
  const double x = fourier_->nx() > 1 ? unit_x_ : INFINITY;
  const double y = fourier_->ny() > 1 ? unit_y_ : INFINITY;
  return std::min(x, y);
}

double ReliefSpectrum::shortest() const {
  return std::hypot(0.5 * fourier_->nx() * unit_x_, 0.5 * fourier_->ny() * unit_y_);
}

}  // namespace aeolian
