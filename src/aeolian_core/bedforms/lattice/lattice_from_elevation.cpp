/// A LatticeBed in the shape of a height map.

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "aeolian_core/bedforms/lattice/lattice_bed.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

/// A periodic surface at the columns of a lattice, in layers.
struct ColumnHeights {
  int nx, ny;
  std::vector<double> value;

  double& at(int x, int y) {
    return value[static_cast<std::size_t>(y) * static_cast<std::size_t>(nx) + static_cast<std::size_t>(x)];
  }
  /// No column stands more than a layer above one beside it: what does is cut off.
  void cut_steep() {
    for (bool steep = true; steep;) {
      steep = false;
      const auto cut = [&](int x, int y) {
        const double beside = std::min({at(x == 0 ? nx - 1 : x - 1, y), at(x + 1 == nx ? 0 : x + 1, y),
                                        at(x, y == 0 ? ny - 1 : y - 1), at(x, y + 1 == ny ? 0 : y + 1)});
        // A rounding error above is none.
        if (at(x, y) <= beside + 1 + 1e-9) return;
        at(x, y) = beside + 1;
        steep = true;
      };
      for (int y = 0; y < ny; ++y)
        for (int x = 0; x < nx; ++x) cut(x, y);
      for (int y = ny; y-- > 0;)
        for (int x = nx; x-- > 0;) cut(x, y);
    }
  }
  void turn_over() {
    for (double& v : value) v = -v;
  }
};

/// Columns between the centres of cells, linear along both axes.
ColumnHeights at_columns(const GridGeometry& g, const std::vector<double>& elevation, int columns_per_cell,
                         double datum, double layer) {
  ColumnHeights result{g.nx() * columns_per_cell, g.ny() * columns_per_cell, {}};
  struct Place {
    int cell, next;
    double part;
  };
  const auto places = [&](int columns, int cells) {
    std::vector<Place> all;
    for (int i = 0; i < columns; ++i) {
      const double centre = (i + 0.5) / columns_per_cell - 0.5;
      const int cell = static_cast<int>(std::floor(centre));
      all.push_back({(cell + cells) % cells, (cell + 1) % cells, centre - cell});
    }
    return all;
  };
  const std::vector<Place> along_x = places(result.nx, g.nx());
  const std::vector<Place> along_y = places(result.ny, g.ny());
  for (const Place& y : along_y)
    for (const Place& x : along_x) {
      const auto row = [&](int cell_y) {
        return elevation[g.index(x.cell, cell_y)] * (1 - x.part) +
               elevation[g.index(x.next, cell_y)] * x.part;
      };
      result.value.push_back((row(y.cell) * (1 - y.part) + row(y.next) * y.part - datum) / layer);
    }
  return result;
}

}  // namespace

LatticeBed LatticeBed::from_elevation(const GridGeometry& geometry, const std::vector<double>& elevation,
                                      int columns_per_cell, double angle_of_repose, std::uint64_t seed) {
  if (elevation.size() != geometry.size())
    throw Error("lattice bed: " + std::to_string(elevation.size()) + " elevations for " +
                std::to_string(geometry.size()) + " cells");
  if (columns_per_cell < 1 || columns_per_cell > 1000)
    throw Error("lattice bed: " + std::to_string(columns_per_cell) + " columns per cell, must be 1 to 1000");
  LatticeBed bed(geometry.nx() * columns_per_cell, geometry.ny() * columns_per_cell,
                 geometry.cell() / columns_per_cell, angle_of_repose, seed, 0);

  const double datum =
      std::accumulate(elevation.begin(), elevation.end(), 0.0) / static_cast<double>(elevation.size());
  constexpr int most_layers = std::numeric_limits<std::int16_t>::max() / 2;
  for (const double h : elevation)
    if (!(std::abs(h - datum) < most_layers * bed.layer_))
      throw Error("lattice bed: an elevation is " + std::to_string(h - datum) +
                  " m above the mean, must be within " + std::to_string(most_layers * bed.layer_) + " m");

  ColumnHeights surface = at_columns(geometry, elevation, columns_per_cell, datum, bed.layer_);
  const double volume = std::accumulate(surface.value.begin(), surface.value.end(), 0.0);
  // Where the surface is steeper than repose, halfway between what remains when its heights are cut off and
  // what remains when its depths are filled.
  ColumnHeights filled = surface;
  surface.cut_steep();
  filled.turn_over();
  filled.cut_steep();
  filled.turn_over();

  // The highest of a column's layers, those of its parity, that is not above the surface and one layer. As
  // neighbours on the surface differ by no more than one layer, these differ by exactly one.
  std::int16_t* column = bed.height_.data();
  for (int y = 0; y < bed.ny_; ++y)
    for (int x = 0; x < bed.nx_; ++x, ++column) {
      const int parity = (x + y) % 2;
      const double top = (surface.at(x, y) + filled.at(x, y)) / 2 + 1;
      *column = static_cast<std::int16_t>(2 * std::floor((top - parity) / 2) + parity);
    }
  bed.compare_neighbours();
  bed.settle(std::llround((volume - static_cast<double>(bed.total())) / 2));
  return bed;
}

}  // namespace aeolian
