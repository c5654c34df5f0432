#include "aeolian_core/measure/virtual_scanner.hpp"

#include <cmath>
#include <limits>
#include <string>

#include "aeolian_core/measure/surface_rays.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

struct SineCosine {
  double sine;
  double cosine;
};

/// The directions of a fan of `count` steps, each taken at a fraction `phase` of its step.
std::vector<SineCosine> fan(int count, double field_of_view, double phase) {
  std::vector<SineCosine> result;
  for (int i = 0; i < count; ++i) {
    const double angle = ((i + phase) / count - 0.5) * field_of_view;
    result.push_back({std::sin(angle), std::cos(angle)});
  }
  return result;
}

double uniform(std::uint32_t word) { return (static_cast<double>(word) + 0.5) * 0x1p-32; }

void check(const VirtualScanner& scanner) {
  if (scanner.columns < 1 || scanner.rows < 1)
    throw Error("scanner: " + std::to_string(scanner.columns) + " x " + std::to_string(scanner.rows) +
                " rays, must be at least 1 x 1");
  for (const double angle : {scanner.field_of_view_x, scanner.field_of_view_y})
    if (!(angle > 0 && angle < M_PI))
      throw Error("scanner: field of view is " + std::to_string(angle) + " rad, must be from 0 to pi");
  if (!(scanner.range_sigma >= 0))
    throw Error("scanner: range_sigma is " + std::to_string(scanner.range_sigma) +
                " m, must not be negative");
  if (!(scanner.dropout >= 0 && scanner.dropout <= 1))
    throw Error("scanner: dropout is " + std::to_string(scanner.dropout) + ", must be from 0 to 1");
}

}  // namespace

PointCloud VirtualScanner::scan(const HeightMap& truth, std::uint64_t seed, std::uint64_t scan_number) const {
  check(*this);
  const SurfaceRays surface(truth.geometry(), truth.layer(layer::elevation));
  const Philox random(seed);
  const auto phase = random(std::numeric_limits<std::uint64_t>::max(), scan_number);
  const auto across = fan(columns, field_of_view_x, uniform(phase[0]));
  const auto along = fan(rows, field_of_view_y, uniform(phase[1]));
  PointCloud cloud;
  cloud.reserve(across.size() * along.size());
  std::uint64_t ray = 0;
  for (const auto& b : along) {
    for (const auto& a : across) {
      const Eigen::Vector3d direction(a.sine * b.cosine, b.sine, a.cosine * b.cosine);
      const auto bits = random(ray++, scan_number);
      const auto hit = uniform(bits[2]) < dropout
                           ? std::nullopt
                           : surface.first_hit(pose.translation(), pose.linear() * direction);
      if (!hit) {
        cloud.push_back(HeightMap::unknown, HeightMap::unknown, HeightMap::unknown);
        continue;
      }
      const double normal =
          std::sqrt(-2 * std::log(uniform(bits[0]))) * std::cos(2 * M_PI * uniform(bits[1]));
      const Eigen::Vector3f point = ((hit->distance + range_sigma * normal) * direction).cast<float>();
      cloud.push_back(point.x(), point.y(), point.z());
    }
  }
  return cloud;
}

}  // namespace aeolian
