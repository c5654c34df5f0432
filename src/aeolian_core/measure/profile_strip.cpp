#include "aeolian_core/measure/profile_strip.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/median.hpp"

namespace aeolian {
namespace {

/// The height of the bed over the level frame's origin where z of the profile is zero [m].
double base_height(const ShadowProfile& profile) {
  const auto mean = [](const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  };
  return mean(profile.x) * std::sin(profile.inclination) - profile.drop - mean(profile.z);
}

/// Stations first to end - 1, without a gap.
struct Stretch {
  std::size_t first, end;
};

std::vector<Stretch> stretches(const std::vector<Eigen::Vector3d>& points, double cell) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < points.size(); ++i)
    steps.push_back((points[i] - points[i - 1]).head<2>().norm());
  const double widest = std::max(3 * median(steps), cell);
  std::vector<Stretch> result{{0, 1}};
  for (std::size_t i = 1; i < points.size(); ++i)
    if (steps[i - 1] > widest)
      result.push_back({i, i + 1});
    else
      result.back().end = i + 1;
  return result;
}

/// The heights of a stretch over the places along the section.
class StripSection {
 public:
  StripSection(const std::vector<Eigen::Vector3d>& points, const std::vector<double>& sigma,
               const Stretch& stretch, Eigen::Vector2d along)
      : along_(std::move(along)) {
    for (std::size_t i = stretch.first; i < stretch.end; ++i) {
      places_.push_back(along_.dot(points[i].head<2>()));
      heights_.push_back({points[i].z(), sigma[i]});
    }
  }

  /// The height of the section's place that lies square to it beside a point; its end's beyond an end.
  Figure beside(const Eigen::Vector2d& point) const {
    const double place = along_.dot(point);
    const auto right = std::upper_bound(places_.begin() + 1, places_.end() - 1, place);
    const auto i = static_cast<std::size_t>(right - places_.begin());
    const double step = places_[i] - places_[i - 1];
    const double t = step > 0 ? std::clamp((place - places_[i - 1]) / step, 0.0, 1.0) : 0.5;
    return {(1 - t) * heights_[i - 1].value + t * heights_[i].value,
            (1 - t) * heights_[i - 1].sigma + t * heights_[i].sigma};
  }

 private:
  Eigen::Vector2d along_;
  std::vector<double> places_;  ///< [m]
  std::vector<Figure> heights_;
};

/// Visits places on the lines between a stretch's stations, at most a step apart.
template <class Visit>
void for_each_place(const std::vector<Eigen::Vector3d>& points, const Stretch& stretch, double step,
                    Visit&& visit) {
  for (std::size_t i = stretch.first; i + 1 < stretch.end; ++i) {
    const Eigen::Vector2d from = points[i].head<2>();
    const Eigen::Vector2d way = points[i + 1].head<2>() - from;
    const int parts = std::max(1, static_cast<int>(std::ceil(way.norm() / step)));
    for (int k = 0; k <= parts; ++k) visit(Eigen::Vector2d(from + way * k / parts));
  }
}

}  // namespace

StraightedgePlace straightedge_place(const Eigen::Isometry3d& straightedge_to_map) {
  const Eigen::Vector3d edge = straightedge_to_map.linear().col(0);
  const Eigen::Vector3d top = straightedge_to_map.linear().col(2);
  constexpr double steepest = M_PI / 4;
  StraightedgePlace place;
  place.inclination = std::asin(std::clamp(edge.z(), -1.0, 1.0));
  if (!(std::abs(place.inclination) <= steepest && top.z() > 0))
    throw Error(fmt::format(
        "the straightedge rises by {:.0f} degrees along x and its z axis points {}, must rise by at most 45 "
        "and point up",
        place.inclination * 180 / M_PI, top.z() > 0 ? "up" : "down"));
  const Eigen::Vector3d along = Eigen::Vector3d(edge.x(), edge.y(), 0).normalized();
  const Eigen::Vector3d across = Eigen::Vector3d::UnitZ().cross(along);
  place.level_to_map.linear() << along, across, Eigen::Vector3d::UnitZ();
  place.level_to_map.translation() = straightedge_to_map.translation();
  place.level_to_map.makeAffine();
  place.lean = std::asin(std::clamp(straightedge_to_map.linear().col(1).z(), -1.0, 1.0));
  return place;
}

std::vector<Eigen::Vector3d> bed_points(const ShadowProfile& profile) {
  if (profile.y.size() != profile.x.size() || profile.z.size() != profile.x.size())
    throw Error(fmt::format("profile: {} places along, {} across and {} heights, must be as many of each",
                            profile.x.size(), profile.y.size(), profile.z.size()));
  const double sine = std::sin(profile.inclination);
  const double cosine = std::cos(profile.inclination);
  const double base = base_height(profile);
  std::vector<Eigen::Vector3d> points;
  points.reserve(profile.x.size());
  for (std::size_t i = 0; i < profile.x.size(); ++i) {
    const double z = profile.z[i] + base;
    points.emplace_back((profile.x[i] - z * sine) / cosine, profile.y[i], z);
  }
  return points;
}

HeightMap profile_strip(const ShadowProfile& profile, const Eigen::Isometry3d& level_to_map, double cell) {
  std::vector<Eigen::Vector3d> points = bed_points(profile);
  if (points.size() < 2)
    throw Error(fmt::format("profile: it has {} stations, must have at least 2 for a strip", points.size()));
  Eigen::AlignedBox2d box;
  for (Eigen::Vector3d& point : points) box.extend((point = level_to_map * point).head<2>());
  const double margin = 1e-3 * cell;  // cells are half open
  HeightMap map(GridGeometry::covering(box.min().x(), box.min().y(), box.max().x() + margin,
                                       box.max().y() + margin, cell));
  HeightMap::Layer& elevation = map.add(layer::elevation);
  HeightMap::Layer& variance = map.add(layer::variance);
  const Eigen::Vector2d along = level_to_map.linear().col(0).head<2>();
  const GridGeometry& geometry = map.geometry();
  for (const Stretch& stretch : stretches(points, cell)) {
    const StripSection section(points, profile.sigma_z, stretch, along);
    for_each_place(points, stretch, cell / 4, [&](const Eigen::Vector2d& place) {
      const std::optional<CellIndex> index = geometry.find(place.x(), place.y());
      if (!index) return;
      const Figure height = section.beside({geometry.x(index->x), geometry.y(index->y)});
      elevation[geometry.index(*index)] = static_cast<float>(height.value);
      variance[geometry.index(*index)] = static_cast<float>(height.sigma * height.sigma);
    });
  }
  return map;
}

}  // namespace aeolian
