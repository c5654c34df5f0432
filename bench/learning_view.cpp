#include "learning_view.hpp"

#include <array>
#include <cmath>

#include "aeolian_core/measure/fusion.hpp"
#include "aeolian_core/measure/virtual_scanner.hpp"
#include "aeolian_core/surface/degree.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

constexpr double noise = 0.0002;        // of a cell [m]
constexpr double range_sigma = 0.0006;  // of a scanner [m]
constexpr double minute = 60;           // [s]

HeightMap surface_at(const LearningDay& day, double time) {
  HeightMap map(day.plot);
  map.add(layer::elevation, day.at(time));
  return map;
}

HeightMap noisy_map(const LearningDay& day, std::uint64_t seed, double time) {
  HeightMap map = surface_at(day, time);
  RandomStream random(seed, static_cast<std::uint64_t>(time));
  for (float& z : map.layer(layer::elevation)) z += static_cast<float>(noise * random.normal());
  map.add(layer::variance, static_cast<float>(noise * noise));
  return map;
}

/// On one long side of the plot, 0.6 m away and 1.2 m up, looking at its middle.
VirtualScanner scanner_at(const GridGeometry& plot, bool north) {
  const double across = north ? plot.length_y() + 0.6 : -0.6;
  const Eigen::Vector3d position(plot.length_x() / 2, across, 1.2);
  const Eigen::Vector3d target(plot.length_x() / 2, plot.length_y() / 2, 0);
  const Eigen::Vector3d forward = (target - position).normalized();
  const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
  VirtualScanner scanner;
  scanner.pose.translation() = position;
  scanner.pose.linear().col(0) = right;
  scanner.pose.linear().col(1) = forward.cross(right);
  scanner.pose.linear().col(2) = forward;
  scanner.columns = 235;
  scanner.rows = 110;
  scanner.field_of_view_x = 22 * degree;
  scanner.field_of_view_y = 9.4 * degree;
  scanner.range_sigma = range_sigma;
  return scanner;
}

std::vector<HeightMap> fused_maps(const LearningDay& day, std::uint64_t seed, double until) {
  const std::array<VirtualScanner, 2> scanners{scanner_at(day.plot, false), scanner_at(day.plot, true)};
  FusionParameters parameters;
  parameters.sensor.range_sigma = range_sigma;
  HeightFusion fusion(day.plot, parameters);
  std::vector<HeightMap> maps;
  for (double time = 0; time <= until; time += LearningDay::period) {
    const HeightMap truth = surface_at(day, time);
    for (std::size_t i = 0; i < scanners.size(); ++i)
      fusion.add(scanners[i].scan(truth, seed + 1000 * (i + 1), static_cast<std::uint64_t>(time)),
                 scanners[i].pose, time);
    if (std::fmod(time, minute) != 0) continue;
    HeightMap map(day.plot);
    for (const std::string& name : {layer::elevation, layer::variance})
      map.add(name, fusion.map().layer(name));
    maps.push_back(std::move(map));
  }
  return maps;
}

}  // namespace

std::vector<HeightMap> measured_maps(const LearningDay& day, View view, std::uint64_t seed, double until) {
  if (view == View::scanned) return fused_maps(day, seed, until);
  std::vector<HeightMap> maps;
  for (double time = 0; time <= until; time += minute) maps.push_back(noisy_map(day, seed, time));
  return maps;
}

}  // namespace aeolian
