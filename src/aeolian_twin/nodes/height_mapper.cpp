#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <grid_map_msgs/GridMap.h>
#include <pluginlib/class_list_macros.hpp>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_twin/nodes/autosave.hpp"
#include "aeolian_twin/nodes/cloud_input.hpp"
#include "aeolian_twin/nodes/conversions.hpp"
#include "aeolian_twin/nodes/map_keeper.hpp"
#include "aeolian_twin/nodes/map_publisher.hpp"
#include "aeolian_twin/nodes/map_services.hpp"
#include "aeolian_twin/nodes/message_pool.hpp"
#include "aeolian_twin/nodes/node.hpp"
#include "aeolian_twin/nodes/transform_input.hpp"

namespace aeolian {
namespace {

const std::string autosave_topic = "height_map";

}  // namespace

/// Point clouds and tf to a live height map. A cloud that cannot be used is said in the diagnostics; the map
/// stays.
class HeightMapper : public Node {
 public:
  HeightMapper() : Node(describe_height_mapper()) {}

  ~HeightMapper() override {
    if (!autosave_ || !unsaved_) return;
    autosave_->wait();
    autosave_->begin(live().stored());
  }

 private:
  using Input = CloudInput<sensor_msgs::PointCloud2>;

  void start() override {
    const SensorSettings shared = read_sensor(parameters(), "", nh().resolveName("points"));
    if (parameters().flag("level") && parameters().number("autosave_period") > 0)
      parameters().refuse("autosave_period", "0 with ~level: a node started again would fit another frame");
    const Tell tell = [this](const std::string& thing, bool well, const std::string& line) {
      well ? good(thing, line) : bad(thing, line);
    };
    keeper_ = std::make_unique<MapKeeper>(parameters(), shared.noise, tell,
                                          [this](const Eigen::Isometry3d& bed) { send(bed); });
    begin_autosave();
    publisher_ = std::make_unique<MapPublisher>(nh(), live(), parameters().flag("incremental"));
    serve();
    const std::string name = private_nh().getNamespace();
    XmlRpc::XmlRpcValue values;
    ros::param::get(name, values);
    listen(read_sensors(name, values, shared), tell);
    patch_subscriber_ = nh().subscribe("patches", 10, &HeightMapper::take_patch, this);
  }

  void watch() override {
    for (const auto& input : inputs_) input->watch();
    report_autosave();
  }

  void listen(const std::vector<SensorSettings>& sensors, const Tell& tell) {
    transforms_ = std::make_unique<TransformInput>(tf_buffer_);
    const CloudPlacer::Frames frames{tf_buffer_, parameters().text("frame_id"),
                                     ros::WallDuration(parameters().number("tf_timeout")),
                                     static_cast<std::uint32_t>(parameters().integer("queue_size"))};
    const CloudPlacer::Use use = [this](const PointCloud& cloud, const Eigen::Isometry3d& pose,
                                        const ros::Time& measured,
                                        const SensorSettings& from) { fuse(cloud, pose, measured, from); };
    for (SensorSettings sensor : sensors) {
      sensor.topic = nh().resolveName(sensor.topic);
      inputs_.push_back(std::make_unique<Input>(sensor, frames, use, tell, nh().getCallbackQueue()));
      ros::SubscribeOptions options;
      options.init<sensor_msgs::PointCloud2>(
          sensor.topic, frames.queue_size,
          [input = inputs_.back().get()](const Input::ConstPtr& cloud) { input->add(cloud); },
          MessagePool<sensor_msgs::PointCloud2>());
      subscribers_.push_back(nh().subscribe(options));
    }
  }

  void fuse(const PointCloud& cloud, const Eigen::Isometry3d& pose, const ros::Time& measured,
            const SensorSettings& sensor) {
    if (!services_->updates_enabled()) {
      good(sensor.thing("clouds"), "not used: disable_updates was called");
      return;
    }
    publisher_->note(keeper_->take(cloud, pose, measured, sensor));
    unsaved_ = true;
    if (keeper_->is_due(measured)) publisher_->publish();
  }

  void take_patch(const grid_map_msgs::GridMap::ConstPtr& message) {
    try {
      publisher_->note(live().patch(to_height_map(*message), message->info.header.frame_id));
      good("patches", "in the map");
      publish_replaced();
    } catch (const Error& error) {
      bad("patches", fmt::format("{}: {}", patch_subscriber_.getTopic(), error.what()));
    }
  }

  void send(const Eigen::Isometry3d& bed) {
    geometry_msgs::TransformStamped transform = tf2::eigenToTransform(bed);
    transform.header.frame_id = parameters().text("frame_id");
    transform.header.stamp = ros::Time::now();
    transform.child_frame_id = live().frame();
    broadcaster_.sendTransform(transform);
  }

  LiveMap& live() { return keeper_->live(); }

  void serve() {
    MapServices::Host host{live(), tf_buffer_};
    host.default_file = [this] {
      std::string file = parameters().text("map_file");
      private_nh().getParam("map_file", file);  // anew at each call, so that `rosparam set` chooses the next
      return file;
    };
    host.is_another = [this] {
      publisher_->note_all();
      publish_replaced();
    };
    host.has_changed = [this](const TileMask& tiles) {
      publisher_->note(tiles);
      publish_replaced();
    };
    host.good = [this](const std::string& service, const std::string& line) { good(service, line); };
    host.bad = [this](const std::string& service, const std::string& line) { bad(service, line); };
    services_ = std::make_unique<MapServices>(nh(), std::move(host));
  }

  void publish_replaced() {
    unsaved_ = true;
    publisher_->publish();
  }

  /// A node that was killed goes on with the map that it saved.
  void begin_autosave() {
    const double period = parameters().number("autosave_period");
    if (period == 0) return;
    const std::string file = std::filesystem::absolute(parameters().text("autosave_file")).string();
    if (std::filesystem::exists(file)) go_on_with(file);
    autosave_ = std::make_unique<Autosave>(file, autosave_topic);
    autosave_timer_ = nh().createWallTimer(ros::WallDuration(period), [this](const ros::WallTimerEvent&) {
      report_autosave();
      if (!unsaved_ || autosave_->under_way()) return;
      autosave_->begin(live().stored());
      unsaved_ = false;
    });
  }

  void go_on_with(const std::string& file) {
    try {
      live().load(load_map(file, autosave_topic));
      good("autosave", "went on with the map of " + file);
    } catch (const Error& error) {
      bad("autosave", error.what());
    }
  }

  void report_autosave() {
    if (!autosave_) return;
    const std::optional<std::string> complaint = autosave_->finished();
    if (!complaint) return;
    if (complaint->empty()) {
      good("autosave", "saved to " + autosave_->file());
    } else {
      bad("autosave", *complaint);
      unsaved_ = true;
    }
  }

  tf2_ros::StaticTransformBroadcaster broadcaster_;
  std::unique_ptr<MapKeeper> keeper_;
  std::unique_ptr<MapPublisher> publisher_;
  std::unique_ptr<MapServices> services_;
  std::unique_ptr<Autosave> autosave_;
  bool unsaved_ = false;

  tf2_ros::Buffer tf_buffer_;
  std::unique_ptr<TransformInput> transforms_;
  std::vector<std::unique_ptr<Input>> inputs_;
  std::vector<ros::Subscriber> subscribers_;
  ros::Subscriber patch_subscriber_;
  ros::WallTimer autosave_timer_;
};

NodeDescription describe_height_mapper() {
  const FusionParameters fusion;
  SensorSettings sensor;
  sensor.noise.max_range = 1e9;
  std::vector<ParameterDeclaration> parameters{
      frame_parameter(),
      {"cell_size", 0.002, "m", "side of a cell", Limits::positive()},
      {"min_x", 0.0, "m", "western border of the map", Limits::any()},
      {"min_y", 0.0, "m", "southern border of the map", Limits::any()},
      {"length_x", 0.0, "m", "extent to the east; 0: the map covers the first cloud", Limits::not_negative()},
      {"length_y", 0.0, "m", "extent to the north; 0: the map covers the first cloud",
       Limits::not_negative()},
      {"max_cells", 25e6, "", "a larger map is refused", Limits::positive()},
      {"publish_period", 0.0, "s", "least time between maps, by the stamps of the clouds",
       Limits::not_negative()},
      {"level", false, "", "z of the map along the normal of the bed, by a plane fit to the first cloud"},
      {"bed_frame", std::string("bed"), "", "with level: the frame of the map, published on tf"},
      {"incremental", false, "", "publish only what changed, on height_map_updates"},
      {"rate_sigma", fusion.change.rate_sigma, "m/s", "how fast the bed rises and sinks (rms)",
       Limits::not_negative()},
      {"rate_time", fusion.change.rate_time, "s", "how long it goes on rising or sinking",
       Limits::positive()},
      {"robust", fusion.robust, "", "drop points that are not of the bed (grains in flight, flying pixels)"},
      {"gate_sigma", fusion.gate_sigma, "", "standard deviations beyond which a new height is an outlier",
       Limits::positive()},
      {"gate_patience", fusion.gate_patience, "",
       "scans in a row that may disagree before a cell begins anew", Limits::between(0, 100)},
      {"tf_timeout", 2.0, "s", "a transform that is missing for so long is reported", Limits::positive()},
      {"queue_size", 10, "", "clouds that may wait for their transform", Limits::between(1, 1000)},
      {"map_file", std::string("height_map.tif"), "",
       "*.tif or *.bag that save_map and load_map use when they are not given one"},
      {"autosave_period", 0.0, "s", "save so often, and go on with that map when started again; 0: never",
       Limits::not_negative()},
      {"autosave_file", std::string("height_map_autosave.bag"), "", "*.tif or *.bag"},
  };
  for (const ParameterDeclaration& p : sensor_parameters(sensor)) parameters.push_back(p);
  return {"height_mapper",
          "keeps a live height map from point clouds",
          {"points (sensor_msgs/PointCloud2), with tf from its frame to ~frame_id; of several sensors, those "
           "that ~sensors names: {NAME: {topic: NAME/points, sensor_file: FILE, latency: 0, ...}}",
           "patches (grid_map_msgs/GridMap): elevation and variance of cells that a model says have changed"},
          {"height_map (grid_map_msgs/GridMap): elevation [m], variance [m^2], rate [m/s], "
           "rate_variance [m^2/s^2]; one who starts to listen gets the last",
           "height_map_updates (grid_map_msgs/GridMap), with ~incremental: rectangles of it that changed",
           "save_map, load_map (grid_map_msgs/ProcessFile): the map and a file, ~map_file when it names none",
           "get_submap (grid_map_msgs/GetGridMap), masked_replace (grid_map_msgs/SetGridMap: the cells where "
           "its layer `mask` is not NaN)",
           "clear_map, disable_updates, enable_updates (std_srvs/Empty)"},
          parameters,
          [] { return std::make_shared<HeightMapper>(); }};
}

}  // namespace aeolian

PLUGINLIB_EXPORT_CLASS(aeolian::HeightMapper, nodelet::Nodelet)
