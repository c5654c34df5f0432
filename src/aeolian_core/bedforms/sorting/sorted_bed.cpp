#include "aeolian_core/bedforms/sorting/sorted_bed.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/require.hpp"

namespace aeolian {
namespace {

constexpr Require require{"sorted bed"};

std::vector<double> heights_of(const HeightMap& map) {
  const HeightMap::Layer whole = filled(map.geometry(), map.layer(layer::elevation));
  return {whole.begin(), whole.end()};
}

std::string name_of(int stratum) { return layer::coarse_fraction + "_" + std::to_string(stratum); }

/// A layer's fraction in a cell, the bulk's where the map does not know.
double told_fraction(const HeightMap& map, const std::string& name, std::size_t cell, double bulk) {
  if (!map.has(name)) return bulk;
  const auto fraction = static_cast<double>(map.layer(name)[cell]);
  if (std::isnan(fraction)) return bulk;
  if (fraction < 0 || fraction > 1)
    throw Error("sorted bed: layer " + name + ", cell " + std::to_string(cell) + " is " +
                std::to_string(fraction) + ", must be 0 to 1");
  return fraction;
}

}  // namespace

void check(const BedLayers& layers) {
  require(layers.active > 0 && std::isfinite(layers.active), "the active layer", layers.active,
          "positive and finite");
  require(layers.stratum > 0 && std::isfinite(layers.stratum), "the thickness of strata", layers.stratum,
          "positive and finite");
  require(layers.remembered >= 1 && layers.remembered <= 64, "the number of strata", layers.remembered,
          "1 to 64");
  require(layers.bulk >= 0 && layers.bulk <= 1, "the coarse fraction", layers.bulk, "0 to 1");
}

SortedBed::SortedBed(const GridGeometry& g, std::vector<double> h, const BedLayers& l)
    : geometry(g),
      layers(l),
      height(std::move(h)),
      coarse(g.size(), l.active * l.bulk),
      upper(g.size()),
      upper_coarse(g.size()) {
  check(layers);
  strata = Strata(g.size(), l.remembered, l.stratum, l.bulk);
  if (height.size() != g.size())
    throw Error("sorted bed: " + std::to_string(height.size()) + " heights for " + std::to_string(g.size()) +
                " cells");
  for (std::size_t i = 0; i < height.size(); ++i) {
    if (!std::isfinite(height[i])) throw Error("sorted bed: a height is not finite");
    const double bottom = (height[i] - l.active) / l.stratum;
    upper[i] = (bottom - std::ceil(bottom) + 1) * l.stratum;
    upper_coarse[i] = upper[i] * l.bulk;
  }
}

SortedBed::SortedBed(const HeightMap& map, const BedLayers& l)
    : SortedBed(map.geometry(), heights_of(map), l) {
  int told = 0;
  while (told < l.remembered && map.has(name_of(told + 1))) ++told;
  for (std::size_t i = 0; i < height.size(); ++i) {
    coarse[i] = l.active * told_fraction(map, layer::coarse_fraction, i, l.bulk);
    if (told == 0) continue;
    for (int k = told; k > 1; --k)
      strata.bury(i, static_cast<float>(l.stratum * told_fraction(map, name_of(k), i, l.bulk)));
    upper_coarse[i] = upper[i] * told_fraction(map, name_of(1), i, l.bulk);
  }
}

double SortedBed::volume() const {
  double sum = 0;
  for (const double h : height) sum += h;
  return sum * geometry.cell() * geometry.cell();
}

double SortedBed::coarse_volume() const {
  double sum = 0;
  for (std::size_t i = 0; i < height.size(); ++i)
    sum +=
        layers.bulk * (height[i] - layers.active - upper[i]) + coarse[i] + upper_coarse[i] + strata.excess(i);
  return sum * geometry.cell() * geometry.cell();
}

double SortedBed::fraction_at(std::size_t cell, double depth) const {
  if (depth < layers.active) return surface_fraction(cell);
  const double below = depth - layers.active - upper[cell];
  if (below < 0) return upper_coarse[cell] / upper[cell];
  return strata.fraction(cell, static_cast<int>(std::min(below / layers.stratum, 1e6)));
}

void SortedBed::write_composition(HeightMap& map) const {
  const HeightMap::Layer& elevation = map.layer(layer::elevation);
  const auto write = [&](const std::string& name, auto&& fraction) {
    HeightMap::Layer& values = map.add(name);
    for (std::size_t i = 0; i < values.size(); ++i)
      if (std::isfinite(elevation[i])) values[i] = static_cast<float>(std::clamp(fraction(i), 0.0, 1.0));
  };
  write(layer::coarse_fraction, [&](std::size_t i) { return surface_fraction(i); });
  write(name_of(1), [&](std::size_t i) { return upper_coarse[i] / upper[i]; });
  for (int k = 2; k <= layers.remembered; ++k)
    write(name_of(k), [&](std::size_t i) { return strata.fraction(i, k - 2); });
}

}  // namespace aeolian
