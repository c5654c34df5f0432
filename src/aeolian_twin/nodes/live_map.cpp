#include "aeolian_twin/nodes/live_map.hpp"

#include <cmath>

#include <fmt/format.h>

#include "aeolian_core/measure/cloud_sample.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

const std::string mask_layer = "mask";

/// A cloud may be so much older than the newest before time is taken to have jumped back.
const ros::Duration greatest_delay(10);

/// The layers that `part` has, on another grid: of each cell the value where its centre lies, NaN outside.
HeightMap nearest_cells(const HeightMap& part, const GridGeometry& grid) {
  HeightMap result(grid);
  const std::vector<std::string> names = part.names();
  for (const std::string& name : names) {
    const HeightMap::Layer& from = part.layer(name);
    HeightMap::Layer& to = result.add(name);
    for (std::size_t i = 0; i < to.size(); ++i) {
      const CellIndex at = grid.cell_at(i);
      if (const auto cell = part.geometry().find(grid.x(at.x), grid.y(at.y)))
        to[i] = from[part.geometry().index(*cell)];
    }
  }
  return result;
}

}  // namespace

LiveMap::LiveMap(const Settings& settings) : settings_(settings) {
  settings.fusion.require_valid();
  if (settings.geometry) begin(*settings.geometry);
}

const HeightFusion& LiveMap::fusion() const {
  if (!fusion_) throw Error("there is no map yet");
  return *fusion_;
}

const HeightMap& LiveMap::map() const { return fusion().map(); }

const HeightMap& LiveMap::map(const TileMask& up_to_date) const { return fusion().map(up_to_date); }

std_msgs::Header LiveMap::header() const {
  std_msgs::Header header;
  header.frame_id = settings_.frame;
  header.stamp = stamp_;
  return header;
}

StoredMap LiveMap::stored() const { return {fusion().map(), settings_.frame, stamp_}; }

FusionResult LiveMap::fuse(const PointCloud& cloud, const Eigen::Isometry3d& pose, const ros::Time& stamp,
                           const SensorNoise& sensor) {
  if (stamp.isZero()) throw Error("the cloud's stamp is zero, must be the time of its measurement");
  if (!fusion_) begin(covering(cloud, pose, sensor));
  if (first_stamp_.isZero()) first_stamp_ = stamp;
  const FusionResult result = fusion_->add(cloud, pose, seconds(stamp), sensor);
  if (stamp > stamp_ || stamp_ - stamp > greatest_delay) stamp_ = stamp;
  return result;
}

GridGeometry LiveMap::covering(const PointCloud& cloud, const Eigen::Isometry3d& pose,
                               const SensorNoise& sensor) const {
  Eigen::AlignedBox2d box;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d point = true_point(cloud, i);
    const double range = point.norm();
    if (range >= sensor.min_range && range <= sensor.max_range) box.extend((pose * point).head<2>());
  }
  if (box.isEmpty()) throw Error(fmt::format("none of {} points is finite and within range", cloud.size()));
  // Cells are half open: a point on the far border is inside the next.
  const double margin = 1e-3 * settings_.cell_size;
  return GridGeometry::covering(box.min().x(), box.min().y(), box.max().x() + margin, box.max().y() + margin,
                                settings_.cell_size);
}

void LiveMap::begin(const GridGeometry& geometry) {
  require_size(geometry);
  fusion_.emplace(geometry, settings_.fusion);
}

void LiveMap::require_size(const GridGeometry& geometry) const {
  if (static_cast<double>(geometry.size()) > settings_.max_cells)
    throw Error(fmt::format("a map of {} x {} cells of {} m is more than ~max_cells = {}", geometry.nx(),
                            geometry.ny(), geometry.cell(), settings_.max_cells));
}

void LiveMap::require_frame(const std::string& frame) const {
  if (!frame.empty() && frame != settings_.frame)
    throw Error(fmt::format("the map's frame is '{}', must be '{}'", frame, settings_.frame));
}

void LiveMap::load(const StoredMap& stored) {
  require_frame(stored.frame);
  require_size(stored.map.geometry());
  const ros::Time holds = stored.stamp.isZero() ? stamp_ : stored.stamp;
  if (first_stamp_.isZero()) first_stamp_ = holds;
  fusion_.emplace(stored.map, settings_.fusion, seconds(holds));
  stamp_ = std::max(stamp_, holds);
}

TileMask LiveMap::replace(const HeightMap& cells, const std::string& frame) {
  require_frame(frame);
  if (!cells.has(layer::elevation))
    throw Error(fmt::format("the map has no layer '{}' to replace cells by", layer::elevation));
  const HeightMap known = nearest_cells(cells, map().geometry());
  return fusion_->replace(known, known.layer(known.has(mask_layer) ? mask_layer : layer::elevation));
}

TileMask LiveMap::patch(const HeightMap& cells, const std::string& frame) {
  if (!cells.has(layer::variance))
    throw Error(fmt::format("the patch has no layer '{}', must say how certain it is", layer::variance));
  const HeightMap::Layer& variance = cells.layer(layer::variance);
  const HeightMap::Layer& elevation = cells.layer(layer::elevation);
  for (std::size_t k = 0; k < variance.size(); ++k)
    if (std::isfinite(elevation[k]) && !(variance[k] > 0 && std::isfinite(variance[k])))
      throw Error(fmt::format("the patch's variance of cell ({}, {}) is {}, must be positive",
                              cells.geometry().cell_at(k).x, cells.geometry().cell_at(k).y, variance[k]));
  HeightMap known(cells.geometry());
  known.add(layer::elevation, elevation);
  known.add(layer::variance, variance);
  return replace(known, frame);
}

void LiveMap::clear() {
  if (fusion_) fusion_->clear();
}

}  // namespace aeolian
