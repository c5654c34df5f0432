#include <algorithm>
#include <filesystem>
#include <optional>

#include <fmt/format.h>
#include <message_filters/subscriber.h>
#include <pluginlib/class_list_macros.hpp>
#include <sensor_msgs/PointCloud2.h>
#include <std_srvs/Trigger.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/message_filter.h>
#include <tf2_ros/transform_listener.h>

#include "aeolian_core/measure/fusion.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/geotiff.hpp"
#include "aeolian_twin/nodes/conversions.hpp"
#include "aeolian_twin/nodes/node.hpp"
#include "aeolian_twin/nodes/sensor_file.hpp"

namespace aeolian {

/// Point clouds and tf to a live height map. A cloud that cannot be used is said in the diagnostics; the map
/// stays.
class HeightMapper : public Node {
 public:
  HeightMapper() : Node(describe_height_mapper()) {}

 private:
  using PointCloud2 = sensor_msgs::PointCloud2;

  void start() override {
    frame_ = parameters().text("frame_id");
    cell_size_ = parameters().number("cell_size");
    max_cells_ = parameters().number("max_cells");
    publish_period_ = ros::Duration(parameters().number("publish_period"));
    tf_timeout_ = ros::WallDuration(parameters().number("tf_timeout"));
    fusion_parameters_.sensor.range_sigma = parameters().number("range_sigma");
    fusion_parameters_.sensor.range_sigma_per_metre = parameters().number("range_sigma_per_metre");
    fusion_parameters_.change.rate_sigma = parameters().number("rate_sigma");
    fusion_parameters_.change.rate_time = parameters().number("rate_time");
    fusion_parameters_.robust = parameters().flag("robust");
    fusion_parameters_.gate_sigma = parameters().number("gate_sigma");
    fusion_parameters_.gate_patience = parameters().integer("gate_patience");
    fusion_parameters_.min_range = parameters().number("min_range");
    fusion_parameters_.max_range = parameters().number("max_range");
    if (fusion_parameters_.min_range >= fusion_parameters_.max_range)
      parameters().refuse("min_range", "less than max_range");
    if (const std::string file = parameters().text("sensor_file"); !file.empty()) {
      const SensorFile sensor = read_sensor_file(file);
      fusion_parameters_.sensor = sensor.noise;
      fusion_parameters_.min_range = std::max(fusion_parameters_.min_range, sensor.min_range);
      fusion_parameters_.max_range = std::min(fusion_parameters_.max_range, sensor.max_range);
    }
    if ((parameters().number("length_x") > 0) != (parameters().number("length_y") > 0))
      parameters().refuse("length_y", "positive together with length_x, or 0 with it");
    if (parameters().number("length_x") > 0) {
      const double x = parameters().number("min_x");
      const double y = parameters().number("min_y");
      begin_map(GridGeometry::covering(x, y, x + parameters().number("length_x"),
                                       y + parameters().number("length_y"), cell_size_));
    }

    map_publisher_ = nh().advertise<grid_map_msgs::GridMap>("height_map", 1, /*latch=*/true);
    services_ = {nh().advertiseService("save_map", &HeightMapper::save_map, this),
                 nh().advertiseService("load_map", &HeightMapper::load_map, this),
                 nh().advertiseService("clear_map", &HeightMapper::clear_map, this)};
    listener_ = std::make_unique<tf2_ros::TransformListener>(tf_buffer_);
    const auto queue_size = static_cast<std::uint32_t>(parameters().integer("queue_size"));
    subscriber_.registerCallback(&HeightMapper::arrived, this);
    filter_ = std::make_unique<tf2_ros::MessageFilter<PointCloud2>>(subscriber_, tf_buffer_, frame_,
                                                                    queue_size, nh());
    filter_->registerCallback(&HeightMapper::add, this);
    filter_->registerFailureCallback([this](const PointCloud2::ConstPtr& cloud, auto) { dropped(*cloud); });
    subscriber_.subscribe(nh(), "points", queue_size);
    bad("clouds", "no cloud has arrived on " + subscriber_.getTopic());
  }

  void watch() override {
    if (waiting_ > 0 && ros::WallTime::now() - waiting_since_ > tf_timeout_)
      complain_of_transform(waiting_header_);
  }

  /// Every cloud, before it waits for its transform.
  void arrived(const PointCloud2::ConstPtr& cloud) {
    if (waiting_++ == 0) waiting_since_ = ros::WallTime::now();
    waiting_header_ = cloud->header;
    const ros::Time stamp = cloud->header.stamp;
    if (stamp < newest_arrived_) {
      bad("clock", fmt::format("time jumped back by {:.1f} s (a bag that loops?), the map is kept",
                               (newest_arrived_ - stamp).toSec()));
      // Transforms of the time before the jump would make tf refuse the new ones as too old.
      if (!tf_buffer_.canTransform(frame_, cloud->header.frame_id, stamp)) {
        filter_->clear();
        tf_buffer_.clear();
        waiting_ = 1;
      }
    } else if (!newest_arrived_.isZero()) {
      good("clock", "time runs forward");
    }
    newest_arrived_ = stamp;
  }

  void dropped(const PointCloud2& cloud) {
    if (waiting_ > 0) --waiting_;
    complain_of_transform(cloud.header);
  }

  void complain_of_transform(const std_msgs::Header& header) {
    std::string reason = "the cloud's frame_id is empty";
    if (!header.frame_id.empty()) tf_buffer_.canTransform(frame_, header.frame_id, header.stamp, &reason);
    bad("transform", fmt::format("no transform from '{}' to '{}': {}", header.frame_id, frame_, reason));
  }

  void add(const PointCloud2::ConstPtr& message) {
    waiting_ = 0;
    try {
      const Eigen::Isometry3d pose = tf2::transformToEigen(
          tf_buffer_.lookupTransform(frame_, message->header.frame_id, message->header.stamp));
      good("transform", fmt::format("from '{}' to '{}' is known", message->header.frame_id, frame_));
      fuse(to_point_cloud(*message), pose, message->header.stamp);
    } catch (const tf2::TransformException& error) {
      bad("transform", error.what());
    } catch (const Error& error) {
      bad("clouds", subscriber_.getTopic() + ": " + error.what());
    }
  }

  void fuse(const PointCloud& cloud, const Eigen::Isometry3d& pose, const ros::Time& stamp) {
    if (!fusion_) begin_map(covering(cloud, pose));
    if (first_stamp_.isZero()) first_stamp_ = stamp;
    const FusionResult result = fusion_->add(cloud, pose, (stamp - first_stamp_).toSec());
    if (result.used == 0)
      throw Error(
          fmt::format("none of {} points can be used: {} not finite, {} out of range, {} outside the map",
                      cloud.size(), result.not_finite, result.out_of_range, result.outside));
    good("clouds", fmt::format("{} of {} points used, {} cells refused as outliers", result.used,
                               cloud.size(), result.outlier_cells));
    stamp_ = stamp;
    if (stamp < published_ || stamp - published_ >= publish_period_) {
      publish(stamp);
      published_ = stamp;
    }
  }

  /// The grid that covers a first cloud.
  GridGeometry covering(const PointCloud& cloud, const Eigen::Isometry3d& pose) const {
    Eigen::AlignedBox2d box;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const Eigen::Vector3d point(cloud.origin_x + static_cast<double>(cloud.x[i]),
                                  cloud.origin_y + static_cast<double>(cloud.y[i]),
                                  cloud.origin_z + static_cast<double>(cloud.z[i]));
      const double range = point.norm();
      if (!(range >= fusion_parameters_.min_range && range <= fusion_parameters_.max_range)) continue;
      box.extend((pose * point).head<2>());
    }
    if (box.isEmpty()) throw Error(fmt::format("none of {} points is finite and within range", cloud.size()));
    const double margin =
        1e-3 * cell_size_;  // cells are half open: a point on the far border is inside the next
    return GridGeometry::covering(box.min().x(), box.min().y(), box.max().x() + margin,
                                  box.max().y() + margin, cell_size_);
  }

  void begin_map(const GridGeometry& geometry) {
    require_size(geometry);
    fusion_.emplace(geometry, fusion_parameters_);
  }

  void require_size(const GridGeometry& geometry) const {
    if (static_cast<double>(geometry.size()) > max_cells_)
      throw Error(fmt::format("a map of {} x {} cells of {} m is more than ~max_cells = {}", geometry.nx(),
                              geometry.ny(), geometry.cell(), max_cells_));
  }

  void publish(const ros::Time& stamp) {
    std_msgs::Header header;
    header.frame_id = frame_;
    header.stamp = stamp;
    map_publisher_.publish(to_message(fusion_->map(), header));
  }

  /// The parameter ~map_file, read anew at each call so that `rosparam set` chooses the next file.
  std::string map_file() {
    std::string file = parameters().text("map_file");
    private_nh().getParam("map_file", file);
    return std::filesystem::absolute(file).string();
  }

  bool save_map(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
    return answer(response, [this] {
      if (!fusion_) throw Error("there is no map yet");
      const std::string file = map_file();
      write_geotiff(fusion_->map(), file);
      return "saved to " + file;
    });
  }

  bool load_map(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
    return answer(response, [this] {
      const std::string file = map_file();
      const HeightMap map = read_geotiff(file);
      require_size(map.geometry());
      const double time = stamp_.isZero() ? 0 : (stamp_ - first_stamp_).toSec();
      fusion_.emplace(map, fusion_parameters_, time);
      publish(stamp_.isZero() ? ros::Time::now() : stamp_);
      return "loaded from " + file;
    });
  }

  bool clear_map(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
    return answer(response, [this] {
      if (!fusion_) return std::string("there was no map");
      fusion_->clear();
      publish(stamp_.isZero() ? ros::Time::now() : stamp_);
      return std::string("cleared");
    });
  }

  template <class Work>
  static bool answer(std_srvs::Trigger::Response& response, Work&& work) {
    try {
      response.message = work();
      response.success = true;
    } catch (const Error& error) {
      response.message = error.what();
      response.success = false;
    }
    return true;
  }

  std::string frame_;
  double cell_size_ = 0;
  double max_cells_ = 0;
  ros::Duration publish_period_;
  ros::WallDuration tf_timeout_;
  FusionParameters fusion_parameters_;
  std::optional<HeightFusion> fusion_;

  tf2_ros::Buffer tf_buffer_;
  std::unique_ptr<tf2_ros::TransformListener> listener_;
  message_filters::Subscriber<PointCloud2> subscriber_;
  std::unique_ptr<tf2_ros::MessageFilter<PointCloud2>> filter_;
  ros::Publisher map_publisher_;
  std::vector<ros::ServiceServer> services_;

  int waiting_ = 0;  ///< clouds whose transform is not known yet
  ros::WallTime waiting_since_;
  std_msgs::Header waiting_header_;  ///< of the newest of them
  ros::Time newest_arrived_;
  ros::Time first_stamp_;  ///< seconds are doubles only relative to this
  ros::Time stamp_;        ///< of the map
  ros::Time published_;
};

NodeDescription describe_height_mapper() {
  const FusionParameters fusion;
  return {
      "height_mapper",
      "keeps a live height map from point clouds",
      {"points (sensor_msgs/PointCloud2), with tf from its frame to ~frame_id"},
      {"height_map (grid_map_msgs/GridMap, latched): elevation [m], variance [m^2], rate [m/s], "
       "rate_variance [m^2/s^2]",
       "save_map, load_map, clear_map (std_srvs/Trigger): the map and ~map_file"},
      {
          frame_parameter(),
          {"cell_size", 0.002, "m", "side of a cell", Limits::positive()},
          {"min_x", 0.0, "m", "western border of the map", Limits::any()},
          {"min_y", 0.0, "m", "southern border of the map", Limits::any()},
          {"length_x", 0.0, "m", "extent to the east; 0: the map covers the first cloud",
           Limits::not_negative()},
          {"length_y", 0.0, "m", "extent to the north; 0: the map covers the first cloud",
           Limits::not_negative()},
          {"max_cells", 25e6, "", "a larger map is refused", Limits::positive()},
          {"publish_period", 0.0, "s", "least time between maps, by the stamps of the clouds",
           Limits::not_negative()},
          {"range_sigma", fusion.sensor.range_sigma, "m", "noise of the sensor along the ray",
           Limits::positive()},
          {"range_sigma_per_metre", fusion.sensor.range_sigma_per_metre, "m/m", "its growth with range",
           Limits::not_negative()},
          {"sensor_file", std::string(), "",
           "file of config/sensors with the noise and the ranges of the sensor; empty: as said here"},
          {"rate_sigma", fusion.change.rate_sigma, "m/s", "how fast the bed rises and sinks (rms)",
           Limits::not_negative()},
          {"rate_time", fusion.change.rate_time, "s", "how long it goes on rising or sinking",
           Limits::positive()},
          {"robust", fusion.robust, "",
           "drop points that are not of the bed (grains in flight, flying pixels)"},
          {"gate_sigma", fusion.gate_sigma, "", "standard deviations beyond which a new height is an outlier",
           Limits::positive()},
          {"gate_patience", fusion.gate_patience, "",
           "scans in a row that may disagree before a cell begins anew", Limits::between(0, 100)},
          {"min_range", fusion.min_range, "m", "nearer points are ignored", Limits::not_negative()},
          {"max_range", 1e9, "m", "farther points are ignored", Limits::positive()},
          {"tf_timeout", 2.0, "s", "a transform that is missing for so long is reported", Limits::positive()},
          {"queue_size", 10, "", "clouds that may wait for their transform", Limits::between(1, 1000)},
          {"map_file", std::string("height_map.tif"), "", "GeoTIFF that save_map writes and load_map reads"},
      },
      [] { return std::make_shared<HeightMapper>(); }};
}

}  // namespace aeolian

PLUGINLIB_EXPORT_CLASS(aeolian::HeightMapper, nodelet::Nodelet)
