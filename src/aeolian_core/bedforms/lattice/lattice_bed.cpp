#include "aeolian_core/bedforms/lattice/lattice_bed.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "aeolian_core/bedforms/wrapped.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/require.hpp"

namespace aeolian {
namespace {

constexpr Require require{"lattice bed"};

/// How the cells of a grid overlap the columns of a periodic lattice along one axis.
struct Overlap {
  std::vector<int> first;                   ///< of the columns of each cell
  std::vector<std::vector<double>> weight;  ///< of each column, summing to 1

  Overlap(double origin, double cell, int cells, double spacing) {
    for (int i = 0; i < cells; ++i) {
      // An edge within a millionth of a column of a column's edge lies on it.
      const double from = (origin + i * cell) / spacing;
      const double to = (origin + (i + 1) * cell) / spacing;
      const int begin = static_cast<int>(std::floor(from + 1e-6));
      const int end = std::max(begin + 1, static_cast<int>(std::ceil(to - 1e-6)));
      first.push_back(begin);
      weight.emplace_back();
      for (int column = begin; column < end; ++column)
        weight.back().push_back(std::max(0.0, std::min(to, column + 1.0) - std::max(from, double(column))));
      const double sum = std::accumulate(weight.back().begin(), weight.back().end(), 0.0);
      for (double& w : weight.back()) w /= sum;
    }
  }
};

}  // namespace

LatticeBed::LatticeBed(int nx, int ny, double spacing, double angle_of_repose, std::uint64_t seed,
                       double roughening)
    : nx_(nx),
      ny_(ny),
      spacing_(spacing),
      layer_(spacing * std::tan(angle_of_repose)),
      random_(seed, 0),
      draws_(seed) {
  if (nx < 4 || ny < 4 || nx % 2 != 0 || ny % 2 != 0 || nx > 30000 || ny > 30000)
    throw Error("lattice bed: " + std::to_string(nx) + " x " + std::to_string(ny) +
                " columns, both must be even and 4 to 30000");
  require(spacing > 0 && std::isfinite(spacing), "spacing", spacing, "positive and finite [m]");
  require(angle_of_repose > 0.1 && angle_of_repose < 1.4, "angle of repose", angle_of_repose,
          "0.1 to 1.4 rad");
  require(roughening >= 0 && roughening <= 1000, "roughening", roughening, "0 to 1000 moves per column");

  height_.resize(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny));
  for (int y = 0; y < ny; ++y)
    for (int x = 0; x < nx; ++x)
      height_[static_cast<std::size_t>(y) * static_cast<std::size_t>(nx) + static_cast<std::size_t>(x)] =
          static_cast<std::int16_t>((x + y) % 2);
  compare_neighbours();
  roughen(roughening);
}

std::int64_t LatticeBed::total() const {
  return std::accumulate(height_.begin(), height_.end(), std::int64_t{0});
}

HeightMap::Layer LatticeBed::elevation(const GridGeometry& geometry) const {
  const Overlap along_x(geometry.origin_x(), geometry.cell(), geometry.nx(), spacing_);
  const Overlap along_y(geometry.origin_y(), geometry.cell(), geometry.ny(), spacing_);
  HeightMap::Layer result(geometry.size());
  std::vector<double> rows(static_cast<std::size_t>(nx_));
  for (int cy = 0; cy < geometry.ny(); ++cy) {
    std::fill(rows.begin(), rows.end(), 0.0);
    const auto& weight_y = along_y.weight[static_cast<std::size_t>(cy)];
    for (std::size_t k = 0; k < weight_y.size(); ++k) {
      const int y = wrapped(along_y.first[static_cast<std::size_t>(cy)] + static_cast<int>(k), ny_);
      const std::int16_t* row = &height_[static_cast<std::size_t>(y) * static_cast<std::size_t>(nx_)];
      for (std::size_t x = 0; x < rows.size(); ++x) rows[x] += weight_y[k] * row[x];
    }
    for (int cx = 0; cx < geometry.nx(); ++cx) {
      const auto& weight_x = along_x.weight[static_cast<std::size_t>(cx)];
      double sum = 0;
      for (std::size_t k = 0; k < weight_x.size(); ++k)
        sum += weight_x[k] * rows[static_cast<std::size_t>(wrapped(
                                 along_x.first[static_cast<std::size_t>(cx)] + static_cast<int>(k), nx_))];
      result[geometry.index(cx, cy)] = static_cast<float>(sum * layer_);
    }
  }
  return result;
}

}  // namespace aeolian
