#include "aeolian_twin/erosion/terrain.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {

const std::vector<std::string>& terrain_names() {
  static const std::vector<std::string> names{"flat",   "hump", "steep_hump", "dune", "valley",
                                              "stakes", "step", "crags",      "crags"};
  return names;
}

HeightMap hard_terrain(const std::string& name, const GridGeometry& g) {
  const auto& names = terrain_names();
  if (std::find(names.begin(), names.end(), name) == names.end())
    throw Error(fmt::format("terrain: '{}', must be one of {}", name, fmt::join(names, ", ")));
  const double length = g.length_x();
  const auto gaussian = [&](double x, double y, double width, double height) {
    const double r = std::hypot(x - 0.5 * g.length_x(), y - 0.5 * g.length_y()) / (width * length);
    return height * length * std::exp(-0.5 * r * r);
  };
  const auto crag = [&](double x, double y) {
    double z = 0;
    for (const auto& [east, north] : {std::pair{0.2, 0.25}, {0.35, 0.7}, {0.6, 0.4}}) {
      const double r = std::hypot(x - east * g.length_x(), y - north * g.length_y()) / (0.025 * length);
      z = std::max(z, 0.018 * length * std::exp(-0.5 * r * r));
    }
    return z;
  };
  HeightMap map(g);
  HeightMap::Layer& ground = map.add(layer::ground, 0);
  for (int iy = 0; iy < g.ny(); ++iy)
    for (int ix = 0; ix < g.nx(); ++ix) {
      const double x = (ix + 0.5) * g.cell();
      const double y = (iy + 0.5) * g.cell();
      double z = 0;
      if (name == "hump") z = gaussian(x, y, 0.15, 0.05);
      if (name == "steep_hump") z = gaussian(x, y, 0.15, 0.15);
      if (name == "dune") z = gaussian(x, y, 0.25, 0.08);
      if (name == "valley") z = 0.015 * length * (1 - std::cos(2 * M_PI * y / g.length_y()));
      if (name == "step") z = x < 0.5 * length ? 0 : 0.05 * length;
      if (name == "crags") z = crag(x, y);
      if (name == "stakes" && ix * 4 % g.nx() < 8 && iy * 4 % g.ny() < 8 && ix * 4 >= g.nx() &&
          iy * 4 >= g.ny())
        z = 0.1 * length;
      ground[g.index(ix, iy)] = static_cast<float>(z);
    }
  return map;
}

void cover(HeightMap& map, const LooseCover& loose, double grain_diameter, std::uint64_t seed) {
  const GridGeometry& g = map.geometry();
  RandomStream random(seed, 0x7e44a17);
  std::vector<double> depth(g.size(), loose.share < 1 ? 0 : loose.depth);
  if (loose.share < 1) {
    // Heaps may overlap: with as many as would cover the share by themselves, times what overlaps.
    const double expected =
        -std::log1p(-loose.share) * g.length_x() * g.length_y() / (M_PI * loose.heap * loose.heap);
    for (int n = 0; n < static_cast<int>(std::lround(std::max(1.0, expected))); ++n) {
      const double cx = random.uniform() * g.length_x();
      const double cy = random.uniform() * g.length_y();
      for (int iy = 0; iy < g.ny(); ++iy)
        for (int ix = 0; ix < g.nx(); ++ix) {
          // On the ring, so that heaps at a border go on behind the other.
          const double dx = std::remainder((ix + 0.5) * g.cell() - cx, g.length_x());
          const double dy = std::remainder((iy + 0.5) * g.cell() - cy, g.length_y());
          const double r = std::hypot(dx, dy) / loose.heap;
          double& d = depth[g.index(ix, iy)];
          d = std::max(d, loose.depth * (1 - r * r));
        }
    }
  }
  const HeightMap::Layer& ground = map.layer(layer::ground);
  HeightMap::Layer& elevation = map.add(layer::elevation);
  for (std::size_t i = 0; i < g.size(); ++i) {
    const double uneven = depth[i] > 0 ? grain_diameter * (2 * random.uniform() - 1) : 0;
    elevation[i] = ground[i] + static_cast<float>(std::max(0.0, depth[i] + uneven));
  }
}

}  // namespace aeolian
