#include "aeolian_core/twin/map_error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

/// The four lattice points that reach a cell along one axis: their weights have a sum of squares of one.
struct Reach {
  std::size_t first;
  std::array<double, 4> weight;
};

std::vector<Reach> reaches(int cells, double cells_per_point) {
  std::vector<Reach> result;
  for (int i = 0; i < cells; ++i) {
    const double at = (i + 0.5) / cells_per_point;
    const double first = std::floor(at);
    const double t = at - first;
    Reach reach{static_cast<std::size_t>(first),
                {(1 - t) * (1 - t) * (1 - t), 4 - 6 * t * t + 3 * t * t * t,
                 1 + 3 * t + 3 * t * t - 3 * t * t * t, t * t * t}};
    double square = 0;
    for (const double w : reach.weight) square += w * w;
    for (double& w : reach.weight) w /= std::sqrt(square);
    result.push_back(reach);
  }
  return result;
}

}  // namespace

HeightMap::Layer smooth_noise(const GridGeometry& geometry, double length, std::uint64_t seed,
                              std::uint64_t stream) {
  const double cells_per_point = std::max(1.0, length / geometry.cell());
  const std::vector<Reach> along = reaches(geometry.nx(), cells_per_point);
  const std::vector<Reach> across = reaches(geometry.ny(), cells_per_point);
  const std::size_t points_x = along.back().first + 4;
  const std::size_t points_y = across.back().first + 4;
  const auto nx = static_cast<std::size_t>(geometry.nx());

  // Rows of the lattice, spread along x.
  RandomStream random(seed, stream);
  std::vector<double> rows(points_y * nx);
  std::vector<double> points(points_x);
  for (std::size_t row = 0; row < points_y; ++row) {
    for (double& point : points) point = random.normal();
    for (std::size_t x = 0; x < nx; ++x)
      for (std::size_t k = 0; k < 4; ++k)
        rows[row * nx + x] += along[x].weight[k] * points[along[x].first + k];
  }
  HeightMap::Layer noise(geometry.size());
  for (std::size_t y = 0; y < across.size(); ++y) {
    const Reach& reach = across[y];
    const double* from = &rows[reach.first * nx];
    for (std::size_t x = 0; x < nx; ++x)
      noise[y * nx + x] =
          static_cast<float>(reach.weight[0] * from[x] + reach.weight[1] * from[nx + x] +
                             reach.weight[2] * from[2 * nx + x] + reach.weight[3] * from[3 * nx + x]);
  }
  return noise;
}

}  // namespace aeolian
