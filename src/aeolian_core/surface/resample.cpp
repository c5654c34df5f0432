#include "aeolian_core/surface/resample.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace aeolian {
namespace {

/// A weight below this is a rounding error of large coordinates, not a neighbour.
constexpr double negligible = 1e-5;

/// The two cells of one axis between whose centres a point lies; a weight of exactly zero means "not needed".
struct Neighbours {
  int low = -1;  ///< -1: outside the grid
  int high = -1;
  double share = 0;  ///< of the high one
};

/// `position` in cells from the outer edge of cell 0.
Neighbours neighbours(double position, int count) {
  if (!(position >= -negligible && position <= count + negligible)) return {};
  const double from_centre = std::clamp(position - 0.5, 0.0, count - 1.0);
  Neighbours result;
  result.low = static_cast<int>(from_centre);
  result.share = from_centre - result.low;
  if (result.share > 1 - negligible) {
    ++result.low;
    result.share = 0;
  }
  if (result.share < negligible) result.share = 0;
  result.high = std::min(result.low + 1, count - 1);
  return result;
}

double bilinear(const GridGeometry& geometry, const HeightMap::Layer& values, const Neighbours& nx,
                const Neighbours& ny) {
  if (nx.low < 0 || ny.low < 0) return static_cast<double>(HeightMap::unknown);
  const auto row = [&](int y) {
    const double low = static_cast<double>(values[geometry.index(nx.low, y)]);
    if (nx.share == 0) return low;
    return (1 - nx.share) * low + nx.share * static_cast<double>(values[geometry.index(nx.high, y)]);
  };
  if (ny.share == 0) return row(ny.low);
  return (1 - ny.share) * row(ny.low) + ny.share * row(ny.high);
}

/// The source cells of one axis that a target cell overlaps, with the overlap in units of the target cell.
struct Overlap {
  int first = 0;
  std::vector<double> weights;
};

Overlap overlap(double start, double width, int count) {
  Overlap result;
  const double from = std::clamp(start, 0.0, static_cast<double>(count));
  const double to = std::clamp(start + width, 0.0, static_cast<double>(count));
  result.first = static_cast<int>(from);
  for (int cell = result.first; cell < to; ++cell)
    result.weights.push_back((std::min(to, cell + 1.0) - std::max(from, static_cast<double>(cell))) / width);
  return result;
}

HeightMap::Layer refined(const GridGeometry& source, const HeightMap::Layer& values,
                         const GridGeometry& target) {
  const double ratio = target.cell() / source.cell();
  const double shift_x = (target.origin_x() - source.origin_x()) / source.cell();
  const double shift_y = (target.origin_y() - source.origin_y()) / source.cell();
  std::vector<Neighbours> columns(static_cast<std::size_t>(target.nx()));
  for (std::size_t x = 0; x < columns.size(); ++x)
    columns[x] = neighbours(shift_x + (static_cast<double>(x) + 0.5) * ratio, source.nx());
  HeightMap::Layer result;
  result.reserve(target.size());
  for (int y = 0; y < target.ny(); ++y) {
    const Neighbours row = neighbours(shift_y + (y + 0.5) * ratio, source.ny());
    for (const Neighbours& column : columns)
      result.push_back(static_cast<float>(bilinear(source, values, column, row)));
  }
  return result;
}

HeightMap::Layer coarsened(const GridGeometry& source, const HeightMap::Layer& values,
                           const GridGeometry& target) {
  const double ratio = target.cell() / source.cell();
  const double shift_x = (target.origin_x() - source.origin_x()) / source.cell();
  const double shift_y = (target.origin_y() - source.origin_y()) / source.cell();
  std::vector<Overlap> columns(static_cast<std::size_t>(target.nx()));
  for (std::size_t x = 0; x < columns.size(); ++x)
    columns[x] = overlap(shift_x + static_cast<double>(x) * ratio, ratio, source.nx());
  HeightMap::Layer result;
  result.reserve(target.size());
  for (int y = 0; y < target.ny(); ++y) {
    const Overlap row = overlap(shift_y + y * ratio, ratio, source.ny());
    for (const Overlap& column : columns) {
      double sum = 0;
      double area = 0;
      for (std::size_t j = 0; j < row.weights.size(); ++j) {
        const std::size_t start = source.index(column.first, row.first + static_cast<int>(j));
        for (std::size_t i = 0; i < column.weights.size(); ++i) {
          const float value = values[start + i];
          if (!std::isfinite(value)) continue;
          const double weight = row.weights[j] * column.weights[i];
          sum += weight * static_cast<double>(value);
          area += weight;
        }
      }
      result.push_back(area >= 0.5 - negligible ? static_cast<float>(sum / area) : HeightMap::unknown);
    }
  }
  return result;
}

}  // namespace

HeightMap resample(const HeightMap& map, const GridGeometry& target) {
  HeightMap result(target);
  const GridGeometry& source = map.geometry();
  const bool coarser = target.cell() > source.cell() * (1 + 1e-9);
  for (const std::string& name : map.names()) {
    const HeightMap::Layer& values = map.layer(name);
    result.add(name, coarser ? coarsened(source, values, target) : refined(source, values, target));
  }
  return result;
}

double sample(const GridGeometry& geometry, const HeightMap::Layer& values, double x, double y) {
  const Neighbours nx = neighbours((x - geometry.origin_x()) / geometry.cell(), geometry.nx());
  const Neighbours ny = neighbours((y - geometry.origin_y()) / geometry.cell(), geometry.ny());
  return bilinear(geometry, values, nx, ny);
}

}  // namespace aeolian
