#include "aeolian_core/wind/sph/lattice.hpp"

#include <cmath>
#include <numeric>

#include "aeolian_core/wind/sph/wendland.hpp"

namespace aeolian::sph {
namespace {

/// The air around each point.
std::vector<float> crowd(const CellOrder& cells, const std::vector<Four>& place,
                         const std::vector<Four>& points, float support) {
  const Wendland kernel(support);
  std::vector<float> result(points.size());
  for_chunks(points.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p)
      for_near(cells, place, points[p], support,
               [&](std::size_t, const Four& way) { result[p] += kernel.value(std::sqrt(dot3(way, way))); });
  });
  return result;
}

/// Indices of the `count` least values, by index where they are the same.
std::vector<std::size_t> least(const std::vector<float>& values, std::size_t count) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  count = std::min(count, order.size());
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end(),
                    [&](std::size_t a, std::size_t b) {
                      return values[a] < values[b] || (!(values[b] < values[a]) && a < b);
                    });
  order.resize(count);
  return order;
}

}  // namespace

std::vector<Four> lattice(const AirGround& ground) {
  const BoxPlace& box = ground.place();
  std::vector<Four> sites;
  double owed = 0;
  for (int y = 0; y < box.ny; ++y)
    for (int x = 0; x < box.nx; ++x) {
      const float px = static_cast<float>(x) + 0.5F;
      const float py = static_cast<float>(y) + 0.5F;
      const float z = ground.height(px, py);
      const float depth = static_cast<float>(box.nz) - z;
      owed += static_cast<double>(depth);
      const int count = std::max(1, static_cast<int>(std::lround(owed)));
      owed -= count;
      for (int n = 0; n < count; ++n)
        sites.push_back(
            Four{px, py, z + (static_cast<float>(n) + 0.5F) * depth / static_cast<float>(count), 0});
    }
  return sites;
}

std::vector<std::size_t> emptiest(const CellOrder& cells, const std::vector<Four>& place,
                                  const std::vector<Four>& sites, std::size_t count, float support) {
  return least(crowd(cells, place, sites, support), count);
}

std::vector<std::size_t> fullest(const CellOrder& cells, const std::vector<Four>& place, std::size_t count,
                                 float support) {
  std::vector<float> air = crowd(cells, place, place, support);
  for (float& a : air) a = -a;
  return least(air, count);
}

}  // namespace aeolian::sph
