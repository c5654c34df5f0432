#include "aeolian_core/wind/wind_relief.hpp"

#include <algorithm>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/require.hpp"

namespace aeolian {
namespace {

constexpr double least_cells = 4;  ///< of the shortest wave that is kept
constexpr int passes = 4;          ///< of a box, which make a Gaussian
constexpr int hole_sweeps = 60;

/// A box of 2 r + 1 cells with a part `a` of one more at either end, normalised: any variance.
struct Box {
  explicit Box(double variance) {
    while ((radius + 1) * (radius + 2) / 3.0 <= variance) ++radius;
    const double n = 2 * radius + 1;
    const double outer = radius + 1;
    part = n * (variance - radius * (radius + 1) / 3.0) / (2 * (outer * outer - variance));
    scale = 1 / (n + 2 * part);
  }
  int radius = 0;
  double part = 0;
  double scale = 1;
};

/// The index that stands for one beyond the border: the other side of a map that repeats, or the mirror.
int folded(int i, int n, bool periodic) {
  if (n == 1) return 0;
  const int period = periodic ? n : 2 * n;
  i = ((i % period) + period) % period;
  return i < n ? i : period - 1 - i;
}

/// Boxes along x over some rows.
void smooth_rows(double* rows, int count, int nx, const Box& box, bool periodic) {
  const int margin = box.radius + 1;
  std::vector<double> wide(static_cast<std::size_t>(nx + 2 * margin));
  for (int y = 0; y < count; ++y) {
    double* row = rows + static_cast<std::ptrdiff_t>(y) * nx;
    for (int pass = 0; pass < passes; ++pass) {
      for (int i = 0; i < margin; ++i) {
        wide[static_cast<std::size_t>(i)] = row[folded(i - margin, nx, periodic)];
        wide[static_cast<std::size_t>(margin + nx + i)] = row[folded(nx + i, nx, periodic)];
      }
      std::copy_n(row, nx, wide.begin() + margin);
      const double* at = wide.data() + margin;
      double sum = 0;
      for (int i = -box.radius; i <= box.radius; ++i) sum += at[i];
      for (int x = 0; x < nx; ++x) {
        row[x] = box.scale * (sum + box.part * (at[x - margin] + at[x + margin]));
        sum += at[x + margin] - at[x - box.radius];
      }
    }
  }
}

/// Boxes along y over the columns [x0, x1).
void smooth_columns(std::vector<double>& height, int nx, int ny, int x0, int x1, const Box& box,
                    bool periodic) {
  const auto width = static_cast<std::size_t>(x1 - x0);
  std::vector<double> before(width * static_cast<std::size_t>(ny));
  std::vector<double> sum(width);
  for (int pass = 0; pass < passes; ++pass) {
    for (int y = 0; y < ny; ++y)
      std::copy_n(
          &height[static_cast<std::size_t>(y) * static_cast<std::size_t>(nx) + static_cast<std::size_t>(x0)],
          width, &before[static_cast<std::size_t>(y) * width]);
    const auto row = [&](int y) {
      return &before[static_cast<std::size_t>(folded(y, ny, periodic)) * width];
    };
    std::fill(sum.begin(), sum.end(), 0.0);
    for (int i = -box.radius; i <= box.radius; ++i)
      for (std::size_t x = 0; x < width; ++x) sum[x] += row(i)[x];
    for (int y = 0; y < ny; ++y) {
      const double* below = row(y - box.radius - 1);
      const double* above = row(y + box.radius + 1);
      const double* leaves = row(y - box.radius);
      double* out =
          &height[static_cast<std::size_t>(y) * static_cast<std::size_t>(nx) + static_cast<std::size_t>(x0)];
      for (std::size_t x = 0; x < width; ++x) {
        out[x] = box.scale * (sum[x] + box.part * (below[x] + above[x]));
        sum[x] += above[x] - leaves[x];
      }
    }
  }
}

/// Relaxes the cells that were unknown towards a membrane held by the known ones.
void relax_holes(const GridGeometry& g, const HeightMap::Layer& known, std::vector<double>& height) {
  std::vector<std::size_t> holes;
  for (std::size_t i = 0; i < known.size(); ++i)
    if (!std::isfinite(known[i])) holes.push_back(i);
  for (int sweep = 0; sweep < hole_sweeps; ++sweep)
    for (const std::size_t i : holes) {
      const CellIndex c = g.cell_at(i);
      double sum = 0;
      int count = 0;
      for (const CellIndex n : {CellIndex{c.x - 1, c.y}, CellIndex{c.x + 1, c.y}, CellIndex{c.x, c.y - 1},
                                CellIndex{c.x, c.y + 1}})
        if (g.contains(n)) {
          sum += height[g.index(n)];
          ++count;
        }
      if (count > 0) height[i] = sum / count;
    }
}

}  // namespace

void smooth(std::vector<double>& height, int nx, int ny, double sigma, bool periodic) {
  const Box box(sigma * sigma / passes);
  if (nx > 1)
    tbb::parallel_for(tbb::blocked_range<int>(0, ny, 16), [&](const tbb::blocked_range<int>& r) {
      smooth_rows(height.data() + static_cast<std::ptrdiff_t>(r.begin()) * nx, r.end() - r.begin(), nx, box,
                  periodic);
    });
  if (ny > 1)
    tbb::parallel_for(tbb::blocked_range<int>(0, nx, 64), [&](const tbb::blocked_range<int>& r) {
      smooth_columns(height, nx, ny, r.begin(), r.end(), box, periodic);
    });
}

WindRelief wind_relief(const HeightMap& surface, double shortest, bool periodic) {
  Require("wind over relief")(shortest >= 0 && std::isfinite(shortest), "shortest wavelength", shortest,
                              "zero or positive [m]");
  const GridGeometry& g = surface.geometry();
  const HeightMap::Layer& elevation = surface.layer(layer::elevation);
  const std::size_t known = count_known(elevation);
  if (known == 0) throw Error("wind over relief: no cell of the map has a known elevation");
  WindRelief relief{g, std::vector<double>(g.size()), 0, periodic};
  if (known == g.size()) {
    std::copy(elevation.begin(), elevation.end(), relief.height.begin());
  } else {
    const HeightMap::Layer whole = filled(g, elevation);
    std::copy(whole.begin(), whole.end(), relief.height.begin());
    relax_holes(g, elevation, relief.height);
  }
  double sum = 0;
  for (const double h : relief.height) sum += h;
  relief.mean = sum / static_cast<double>(g.size());
  for (double& h : relief.height) h -= relief.mean;
  // exp(-k^2 s^2/2) is one half at the shortest wave.
  const double cells = std::max(shortest / g.cell(), least_cells);
  smooth(relief.height, g.nx(), g.ny(), std::sqrt(2 * M_LN2) / (2 * M_PI) * cells, periodic);
  return relief;
}

Slope slope_at(const WindRelief& relief, int x, int y) {
  const GridGeometry& g = relief.geometry;
  const auto difference = [&](int i, int n, auto&& height) {
    if (n == 1) return 0.0;
    if (relief.periodic) return (height((i + 1) % n) - height((i + n - 1) % n)) / (2 * g.cell());
    const int before = std::max(i - 1, 0);
    const int after = std::min(i + 1, n - 1);
    return (height(after) - height(before)) / ((after - before) * g.cell());
  };
  return {difference(x, g.nx(), [&](int i) { return relief.height[g.index(i, y)]; }),
          difference(y, g.ny(), [&](int i) { return relief.height[g.index(x, i)]; })};
}

double steepness(const WindRelief& relief) {
  const GridGeometry& g = relief.geometry;
  std::vector<float> slopes(g.size());
  tbb::parallel_for(0, g.ny(), [&](int y) {
    for (int x = 0; x < g.nx(); ++x) {
      const Slope s = slope_at(relief, x, y);
      slopes[g.index(x, y)] = static_cast<float>(s.x * s.x + s.y * s.y);
    }
  });
  const auto rank = slopes.begin() + static_cast<std::ptrdiff_t>((slopes.size() - 1) * 999 / 1000);
  std::nth_element(slopes.begin(), rank, slopes.end());
  return std::sqrt(static_cast<double>(*rank));
}

}  // namespace aeolian
