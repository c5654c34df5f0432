#include "aeolian_core/surface/height_map.hpp"

#include <algorithm>
#include <cmath>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

template <class Layers>
auto find_layer(Layers& layers, const std::string& name) {
  return std::find_if(layers.begin(), layers.end(), [&](const auto& entry) { return entry.first == name; });
}

/// Adds to each unknown cell of one row or column the weighted value of the nearest known cell on either
/// side.
void gather_along(const HeightMap::Layer& values, std::size_t start, std::size_t stride, int count,
                  std::vector<double>& sum, std::vector<double>& weight) {
  const auto sweep = [&](int from, int to, int step) {
    int last = -1;
    for (int i = from; i != to; i += step) {
      const std::size_t at = start + static_cast<std::size_t>(i) * stride;
      if (std::isfinite(values[at])) {
        last = i;
      } else if (last >= 0) {
        const double w = 1.0 / std::abs(i - last);
        sum[at] += w * static_cast<double>(values[start + static_cast<std::size_t>(last) * stride]);
        weight[at] += w;
      }
    }
  };
  sweep(0, count, 1);
  sweep(count - 1, -1, -1);
}

}  // namespace

bool HeightMap::has(const std::string& name) const { return find_layer(layers_, name) != layers_.end(); }

std::vector<std::string> HeightMap::names() const {
  std::vector<std::string> result;
  for (const auto& entry : layers_) result.push_back(entry.first);
  return result;
}

const HeightMap::Layer& HeightMap::layer(const std::string& name) const {
  const auto found = find_layer(layers_, name);
  if (found == layers_.end()) throw Error("height map: there is no layer '" + name + "'");
  return found->second;
}

HeightMap::Layer& HeightMap::layer(const std::string& name) {
  return const_cast<Layer&>(static_cast<const HeightMap*>(this)->layer(name));
}

HeightMap::Layer& HeightMap::add(const std::string& name, float value) {
  return add(name, Layer(geometry_.size(), value));
}

HeightMap::Layer& HeightMap::add(const std::string& name, Layer values) {
  if (values.size() != geometry_.size())
    throw Error("height map: layer '" + name + "' has " + std::to_string(values.size()) + " values for " +
                std::to_string(geometry_.size()) + " cells");
  const auto found = find_layer(layers_, name);
  if (found != layers_.end()) return found->second = std::move(values);
  return layers_.emplace_back(name, std::move(values)).second;
}

void HeightMap::remove(const std::string& name) {
  const auto found = find_layer(layers_, name);
  if (found != layers_.end()) layers_.erase(found);
}

std::size_t count_known(const HeightMap::Layer& values) {
  return static_cast<std::size_t>(
      std::count_if(values.begin(), values.end(), [](float v) { return std::isfinite(v); }));
}

HeightMap::Layer filled(const GridGeometry& geometry, const HeightMap::Layer& values) {
  HeightMap::Layer result = values;
  const std::size_t known = count_known(values);
  if (known == values.size()) return result;
  std::vector<double> sum(values.size(), 0);
  std::vector<double> weight(values.size(), 0);
  const auto nx = static_cast<std::size_t>(geometry.nx());
  for (int y = 0; y < geometry.ny(); ++y)
    gather_along(values, geometry.index(0, y), 1, geometry.nx(), sum, weight);
  for (int x = 0; x < geometry.nx(); ++x)
    gather_along(values, geometry.index(x, 0), nx, geometry.ny(), sum, weight);
  double mean = 0;
  for (const float v : values)
    if (std::isfinite(v)) mean += static_cast<double>(v) / static_cast<double>(known);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i])) result[i] = static_cast<float>(weight[i] > 0 ? sum[i] / weight[i] : mean);
  return result;
}

}  // namespace aeolian
