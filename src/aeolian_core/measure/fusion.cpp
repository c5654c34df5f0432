#include "aeolian_core/measure/fusion.hpp"

#include <cmath>
#include <limits>
#include <string>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

/// Rms slope of the bed along a ray; ripples of index 15 have about this.
constexpr double bed_slope = 0.1;

void require(bool allowed, const char* name, double value, const char* what) {
  if (!allowed)
    throw Error("fusion: " + std::string(name) + " is " + std::to_string(value) + ", must be " + what);
}

/// Takes points of a cloud to the map frame, relative to the grid's origin, and weighs them. Large
/// coordinates cancel in double, here, before a point is looked at.
class PointModel {
 public:
  PointModel(const PointCloud& cloud, const Eigen::Isometry3d& pose, const GridGeometry& geometry,
             const FusionParameters& parameters)
      : origin_(cloud.origin_x, cloud.origin_y, cloud.origin_z),
        rotation_(pose.linear()),
        turned_origin_(rotation_ * origin_),
        offset_(turned_origin_ + pose.translation() -
                Eigen::Vector3d(geometry.origin_x(), geometry.origin_y(), 0)),
        sigma_(parameters.sensor.range_sigma),
        sigma_per_metre_(parameters.sensor.range_sigma_per_metre),
        georeferenced_(origin_.norm() > parameters.max_range) {}

  bool georeferenced() const { return georeferenced_; }
  double squared_range(const Eigen::Vector3d& point) const { return (origin_ + point).squaredNorm(); }
  Eigen::Vector3d turned(const Eigen::Vector3d& point) const { return rotation_ * point; }
  const Eigen::Vector3d& offset() const { return offset_; }

  /// Inverse variance of the height of a point [1/m^2]; `turned_z` of the turned point.
  double weight(double turned_z, double squared_range) const {
    if (georeferenced_) return 1 / (sigma_ * sigma_);
    const double sigma = sigma_per_metre_ > 0 ? sigma_ + sigma_per_metre_ * std::sqrt(squared_range) : sigma_;
    const double drop = turned_z + turned_origin_.z();
    constexpr double m2 = bed_slope * bed_slope;
    return squared_range / (sigma * sigma * ((1 - m2) * drop * drop + m2 * squared_range));
  }

 private:
  Eigen::Vector3d origin_;
  Eigen::Matrix3d rotation_;
  Eigen::Vector3d turned_origin_;
  Eigen::Vector3d offset_;
  double sigma_;
  double sigma_per_metre_;
  bool georeferenced_;
};

}  // namespace

HeightFusion::HeightFusion(const GridGeometry& geometry, const FusionParameters& parameters)
    : map_(geometry),
      parameters_(parameters),
      updated_(geometry.size()),
      refusals_(geometry.size()),
      sums_(geometry.size()) {
  check_parameters();
  map_.add(layer::elevation);
  map_.add(layer::variance);
}

HeightFusion::HeightFusion(const HeightMap& map, const FusionParameters& parameters, double stamp)
    : HeightFusion(map.geometry(), parameters) {
  require(std::isfinite(stamp), "stamp", stamp, "finite");
  map_.layer(layer::elevation) = map.layer(layer::elevation);
  auto& elevation = map_.layer(layer::elevation);
  auto& variance = map_.layer(layer::variance);
  if (map.has(layer::variance)) variance = map.layer(layer::variance);
  const double sigma = parameters.sensor.range_sigma;
  for (std::size_t i = 0; i < elevation.size(); ++i) {
    if (!std::isfinite(elevation[i]))
      elevation[i] = variance[i] = HeightMap::unknown;
    else if (!(variance[i] >= 0) || !std::isfinite(variance[i]))
      variance[i] = static_cast<float>(sigma * sigma);
  }
  updated_.assign(updated_.size(), stamp);
  last_stamp_ = stamp;
  has_stamp_ = true;
}

void HeightFusion::check_parameters() const {
  const auto& p = parameters_;
  const auto finite = [](double v) { return std::isfinite(v); };
  require(p.sensor.range_sigma > 0 && finite(p.sensor.range_sigma), "range_sigma", p.sensor.range_sigma,
          "positive and finite");
  require(p.sensor.range_sigma_per_metre >= 0 && finite(p.sensor.range_sigma_per_metre),
          "range_sigma_per_metre", p.sensor.range_sigma_per_metre, "zero or positive");
  require(p.change_rate >= 0 && finite(p.change_rate), "change_rate", p.change_rate, "zero or positive");
  require(p.gate_sigma > 0, "gate_sigma", p.gate_sigma, "positive");
  require(p.gate_patience >= 0 && p.gate_patience < 255, "gate_patience", p.gate_patience, "from 0 to 254");
  require(p.min_range >= 0 && finite(p.min_range), "min_range", p.min_range, "zero or positive");
  require(p.max_range > p.min_range, "max_range", p.max_range, "greater than min_range");
}

FusionResult HeightFusion::add(const PointCloud& cloud, const Eigen::Isometry3d& pose, double stamp) {
  if (cloud.y.size() != cloud.size() || cloud.z.size() != cloud.size())
    throw Error("fusion: the cloud has " + std::to_string(cloud.x.size()) + " x, " +
                std::to_string(cloud.y.size()) + " y and " + std::to_string(cloud.z.size()) +
                " z, must be as many of each");
  require(std::isfinite(stamp), "stamp", stamp, "finite");
  if (!pose.matrix().allFinite()) throw Error("fusion: the pose of the sensor is not finite");
  set_clock(stamp);

  FusionResult result;
  result.changed = TileMask(map_.geometry());
  gather(cloud, pose, result);
  update(stamp, result);
  return result;
}

void HeightFusion::set_clock(double stamp) {
  if (has_stamp_ && stamp < last_stamp_) {
    auto& variance = map_.layer(layer::variance);
    const double rate = parameters_.change_rate * parameters_.change_rate;
    for (std::size_t i = 0; i < variance.size(); ++i) {
      variance[i] += static_cast<float>(rate * (last_stamp_ - updated_[i]));
      updated_[i] = stamp;
    }
  }
  last_stamp_ = stamp;
  has_stamp_ = true;
}

void HeightFusion::gather(const PointCloud& cloud, const Eigen::Isometry3d& pose, FusionResult& result) {
  const GridGeometry& g = map_.geometry();
  const PointModel model(cloud, pose, g, parameters_);
  const double nearest = parameters_.min_range * parameters_.min_range;
  const double farthest = parameters_.max_range * parameters_.max_range;
  const double per_cell = 1 / g.cell();
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d point(cloud.x[i], cloud.y[i], cloud.z[i]);
    const double squared_range = model.squared_range(point);
    if (!std::isfinite(squared_range)) {
      ++result.not_finite;
      continue;
    }
    const bool in_range = squared_range > 0 && squared_range >= nearest && squared_range <= farthest;
    if (!in_range && !model.georeferenced()) {
      ++result.out_of_range;
      continue;
    }
    const Eigen::Vector3d turned = model.turned(point);
    const double cx = (turned.x() + model.offset().x()) * per_cell;
    const double cy = (turned.y() + model.offset().y()) * per_cell;
    if (!(cx >= 0 && cy >= 0 && cx < g.nx() && cy < g.ny())) {
      ++result.outside;
      continue;
    }
    const std::size_t cell = g.index(static_cast<int>(cx), static_cast<int>(cy));
    const double weight = model.weight(turned.z(), squared_range);
    Sums& sums = sums_[cell];
    if (sums.weight == 0) touched_.push_back(static_cast<std::uint32_t>(cell));
    sums.weight += weight;
    sums.weighted_height += weight * (turned.z() + model.offset().z());
    ++result.used;
  }
}

void HeightFusion::update(double stamp, FusionResult& result) {
  auto& elevation = map_.layer(layer::elevation);
  auto& variance = map_.layer(layer::variance);
  const auto nx = static_cast<std::uint32_t>(map_.geometry().nx());
  const double rate = parameters_.change_rate * parameters_.change_rate;
  const double squared_gate = parameters_.gate_sigma * parameters_.gate_sigma;
  for (const std::uint32_t cell : touched_) {
    const double measured = sums_[cell].weighted_height / sums_[cell].weight;
    const double noise = 1 / sums_[cell].weight;
    sums_[cell] = {};

    double height = measured;
    double spread = noise;
    if (std::isfinite(elevation[cell])) {
      const double known = static_cast<double>(elevation[cell]);
      const double predicted = static_cast<double>(variance[cell]) + rate * (stamp - updated_[cell]);
      const double innovation = measured - known;
      if (innovation * innovation <= squared_gate * (predicted + noise)) {
        const double gain = predicted / (predicted + noise);
        height = known + gain * innovation;
        spread = gain * noise;
      } else if (refusals_[cell] < parameters_.gate_patience) {
        ++refusals_[cell];
        ++result.outlier_cells;
        continue;
      }
    }
    elevation[cell] = static_cast<float>(height);
    variance[cell] = static_cast<float>(spread);
    updated_[cell] = stamp;
    refusals_[cell] = 0;
    result.changed.activate(static_cast<int>(cell % nx), static_cast<int>(cell / nx));
  }
  touched_.clear();
}

void HeightFusion::clear() {
  map_.add(layer::elevation);
  map_.add(layer::variance);
  refusals_.assign(refusals_.size(), 0);
  has_stamp_ = false;
}

}  // namespace aeolian
