#include <cmath>
#include <ctime>
#include <optional>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <image_transport/image_transport.h>
#include <pluginlib/class_list_macros.hpp>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_ros/buffer.h>

#include "aeolian_core/measure/profile_strip.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_twin/nodes/conversions.hpp"
#include "aeolian_twin/nodes/node.hpp"
#include "aeolian_twin/nodes/transform_input.hpp"
#include "aeolian_twin/photo/measured_photo.hpp"
#include "aeolian_twin/photo/overlay.hpp"

namespace aeolian {

/// Photographs of a straightedge's shadow to profiles of the bed. A photo that cannot be measured is said in
/// the diagnostics, and nothing is published of it.
class ShadowProfiler : public Node {
 public:
  ShadowProfiler() : Node(describe_shadow_profiler()) {}

 private:
  using Image = sensor_msgs::Image;

  /// Where the straightedge lies in `~frame_id`, as tf says.
  struct Place {
    Eigen::Isometry3d straightedge_to_map;
    StraightedgePlace level;
  };

  void start() override {
    frame_ = parameters().text("frame_id");
    straightedge_frame_ = parameters().text("straightedge_frame");
    pose_from_tf_ = parameters().flag("pose_from_tf");
    sun_from_stamp_ = parameters().flag("sun_from_stamp");
    cell_size_ = parameters().number("cell_size");
    overlay_width_ = parameters().integer("overlay_width");
    patience_ = ros::WallDuration(parameters().number("tf_timeout"));
    if (straightedge_frame_.empty()) parameters().refuse("straightedge_frame", "the name of a frame");
    if (parameters().text("setup").empty())
      parameters().refuse("setup", "the path of a setup file (docs/measure_photo.md)");
    setup_ = read_photo_setup(parameters().text("setup"), !pose_from_tf_);

    profile_publisher_ = nh().advertise<aeolian_msgs::Profile>("profile", 1, /*latch=*/true);
    strip_publisher_ = nh().advertise<grid_map_msgs::GridMap>("strip", 1, /*latch=*/true);
    cloud_publisher_ = nh().advertise<sensor_msgs::PointCloud2>("profile_points", 1, /*latch=*/true);
    transport_ = std::make_unique<image_transport::ImageTransport>(nh());
    overlay_publisher_ = transport_->advertise("overlay", 1, /*latch=*/true);
    transforms_ = std::make_unique<TransformInput>(tf_buffer_);
    camera_subscriber_ = nh().subscribe("camera_info", 1, &ShadowProfiler::take_camera, this);
    image_subscriber_ = transport_->subscribe("image", 2, &ShadowProfiler::take_image, this);
    retry_ =
        nh().createWallTimer(ros::WallDuration(0.05), [this](const ros::WallTimerEvent&) { try_waiting(); });
    bad("photos", "no image has arrived on " + image_subscriber_.getTopic());
  }

  void take_camera(const sensor_msgs::CameraInfo::ConstPtr& message) {
    camera_info_seen_ = true;
    try {
      camera_ = to_camera_model(*message);
      good("camera", fmt::format("{} x {} pixels, focal length {:.1f} px", camera_->width_px,
                                 camera_->height_px, camera_->fx));
    } catch (const Error& error) {
      bad("camera", camera_subscriber_.getTopic() + ": " + error.what());
    }
    try_waiting();
  }

  void take_image(const Image::ConstPtr& message) {
    if (!anybody_listens()) {
      good("photos", "are not measured while nobody listens");
      return;
    }
    // An image that waits is not pushed aside: newer ones would wait as long for their own transforms.
    if (waiting_) return;
    waiting_ = message;
    waiting_since_ = ros::WallTime::now();
    try_waiting();
  }

  bool anybody_listens() const {
    return profile_publisher_.getNumSubscribers() > 0 || strip_publisher_.getNumSubscribers() > 0 ||
           cloud_publisher_.getNumSubscribers() > 0 || overlay_publisher_.getNumSubscribers() > 0;
  }

  /// Measures the waiting image once all that it needs is there; gives it up after a while.
  void try_waiting() {
    if (!waiting_) return;
    const std::string missing = what_is_missing(waiting_->header);
    if (!missing.empty() && ros::WallTime::now() - waiting_since_ < patience_) return;
    const Image::ConstPtr image = std::move(waiting_);
    waiting_.reset();
    try {
      if (!missing.empty()) throw Error(missing);
      const std::optional<Place> place = place_at(image->header.stamp);
      publish(*image, measured(*image, place), place);
    } catch (const Error& error) {
      bad("photos", image_subscriber_.getTopic() + ": " + error.what());
    } catch (const tf2::TransformException& error) {
      bad("photos", image_subscriber_.getTopic() + ": " + error.what());
    }
  }

  std::string what_is_missing(const std_msgs::Header& header) const {
    const bool needs_info = pose_from_tf_ && !setup_.camera && !camera_;
    const bool expects_info = camera_subscriber_.getNumPublishers() > 0 && !camera_info_seen_;
    if (needs_info || expects_info)
      return "no calibration of the camera has arrived on " + camera_subscriber_.getTopic();
    if (!pose_from_tf_) return {};
    if (header.frame_id.empty()) return "the image's frame_id is empty";
    std::string reason;
    if (tf_buffer_.canTransform(header.frame_id, straightedge_frame_, header.stamp, &reason)) return {};
    return fmt::format("no transform from '{}' to '{}': {}", straightedge_frame_, header.frame_id, reason);
  }

  std::optional<Place> place_at(const ros::Time& stamp) {
    if (!tf_buffer_.canTransform(frame_, straightedge_frame_, stamp)) {
      good("place", fmt::format("of '{}' in '{}' is not known to tf: no strip, and no points in the profiles",
                                straightedge_frame_, frame_));
      return std::nullopt;
    }
    Place place;
    place.straightedge_to_map =
        tf2::transformToEigen(tf_buffer_.lookupTransform(frame_, straightedge_frame_, stamp));
    place.level = straightedge_place(place.straightedge_to_map);
    good("place", fmt::format("of '{}' in '{}' is known", straightedge_frame_, frame_));
    return place;
  }

  MeasuredPhoto measured(const Image& image, const std::optional<Place>& place) const {
    const Photo photo = to_photo(image);
    const PhotoSetup setup = setup_at(image.header.stamp, place);
    if (camera_ && (camera_->width_px != photo.width_px || camera_->height_px != photo.height_px))
      throw Error(fmt::format("it has {} x {} pixels, the camera of {} {} x {}", photo.width_px,
                              photo.height_px, camera_subscriber_.getTopic(), camera_->width_px,
                              camera_->height_px));
    MeasuredPhoto result;
    result.time = image.header.stamp.toSec();
    result.name = fmt::format("{:%Y-%m-%d %H:%M:%S} UTC", fmt::gmtime(std::time_t{image.header.stamp.sec}));
    result.profile = pose_from_tf_ ? measure_shadow(photo, setup, level_straightedge_to_camera(image, place))
                                   : measure_shadow(photo, setup, ProfileMode::full);
    result.analysis = analyse(result.profile);
    return result;
  }

  /// The setup file with what tf, the camera and the image know better.
  PhotoSetup setup_at(const ros::Time& stamp, const std::optional<Place>& place) const {
    PhotoSetup setup = setup_;
    if (camera_) setup.camera = camera_;
    if (auto* sun = std::get_if<PhotoSetup::Sun>(&setup.light); sun != nullptr && sun_from_stamp_)
      sun->unix_time = stamp.toSec();
    if (!place) return setup;
    constexpr double most_lean = M_PI / 180;
    if (!pose_from_tf_ && std::abs(place->level.lean) > most_lean)
      throw Error(
          fmt::format("in tf '{}' leans by {:.1f} degrees about its x axis; marks are measured on a top "
                      "face that leans by at most 1",
                      straightedge_frame_, place->level.lean * 180 / M_PI));
    setup.inclination = place->level.inclination;
    setup.height = place->straightedge_to_map.translation().z();  // so that z is the elevation in the map
    return setup;
  }

  /// The pose for a straightedge that is level across: only its casting edge throws the shadow, and the top
  /// face may lean.
  Eigen::Isometry3d level_straightedge_to_camera(const Image& image,
                                                 const std::optional<Place>& place) const {
    const Eigen::Isometry3d to_camera = tf2::transformToEigen(
        tf_buffer_.lookupTransform(image.header.frame_id, straightedge_frame_, image.header.stamp));
    if (!place) return to_camera;
    return to_camera * place->straightedge_to_map.inverse() * place->level.level_to_map *
           Eigen::AngleAxisd(-place->level.inclination, Eigen::Vector3d::UnitY());
  }

  void publish(const Image& image, const MeasuredPhoto& photo, const std::optional<Place>& place) {
    const ShadowProfile& profile = photo.profile;
    std::vector<Eigen::Vector3d> on_straightedge = bed_points(profile);
    std::vector<Eigen::Vector3d> on_map;
    for (Eigen::Vector3d& point : on_straightedge) {
      if (place) {
        on_map.push_back(place->level.level_to_map * point);
        point = place->straightedge_to_map.inverse() * on_map.back();
      } else {
        point = Eigen::AngleAxisd(profile.inclination, Eigen::Vector3d::UnitY()) * point;
      }
    }
    std_msgs::Header header;
    header.stamp = image.header.stamp;
    header.frame_id = straightedge_frame_;
    cloud_publisher_.publish(to_cloud(on_straightedge, profile.sigma_z, header));
    if (place) {
      header.frame_id = frame_;
      strip_publisher_.publish(
          to_message(profile_strip(profile, place->level.level_to_map, cell_size_), header));
    }
    profile_publisher_.publish(to_message(profile, photo.analysis, on_map, header));
    if (overlay_publisher_.getNumSubscribers() > 0)
      overlay_publisher_.publish(
          to_message(draw_overlay(to_picture(image), photo, overlay_width_), image.header));
    std::string line = in_one_line(photo.analysis);
    for (const std::string& remark : profile.remarks) line += "; " + remark;
    good("photos", line);
  }

  std::string frame_;
  std::string straightedge_frame_;
  bool pose_from_tf_ = false;
  bool sun_from_stamp_ = true;
  double cell_size_ = 0;
  int overlay_width_ = 0;
  ros::WallDuration patience_;
  PhotoSetup setup_;
  std::optional<CameraModel> camera_;  ///< of the last good camera_info
  bool camera_info_seen_ = false;

  Image::ConstPtr waiting_;  ///< for its transform or the first camera_info
  ros::WallTime waiting_since_;
  ros::WallTimer retry_;

  tf2_ros::Buffer tf_buffer_;
  std::unique_ptr<TransformInput> transforms_;
  std::unique_ptr<image_transport::ImageTransport> transport_;
  image_transport::Subscriber image_subscriber_;
  image_transport::Publisher overlay_publisher_;
  ros::Subscriber camera_subscriber_;
  ros::Publisher profile_publisher_;
  ros::Publisher strip_publisher_;
  ros::Publisher cloud_publisher_;
};

NodeDescription describe_shadow_profiler() {
  return {
      "shadow_profiler",
      "measures the bed's profile on photographs of a straightedge's shadow",
      {"image (sensor_msgs/Image, unrectified): mono8, mono16, bgr8, rgb8, bgra8 or rgba8",
       "camera_info (sensor_msgs/CameraInfo): goes before the setup file's camera",
       "tf from ~straightedge_frame to the image's frame (~pose_from_tf) and to ~frame_id (for strip, points "
       "and inclination)"},
      {"profile (aeolian_msgs/Profile, latched): z is the elevation in ~frame_id when tf knows the "
       "straightedge's place there",
       "strip (grid_map_msgs/GridMap, latched): elevation [m], variance [m^2] of the cells under the section",
       "profile_points (sensor_msgs/PointCloud2, latched): x, y, z, sigma_z [m] in ~straightedge_frame; a "
       "cloud for height_mapper",
       "overlay (sensor_msgs/Image): the photo with what was found on it"},
      {
          frame_parameter(),
          {"setup", std::string(), "", "setup file with the light and the marks, see docs/measure_photo.md"},
          {"pose_from_tf", false, "",
           "where the camera stands comes from tf rather than from marks on the photo"},
          {"straightedge_frame", std::string("straightedge"), "",
           "x along the scale, y = 0 on the casting edge, z up"},
          {"sun_from_stamp", true, "", "the setup's sun stands as at the image's stamp, not as at its utc"},
          {"cell_size", 0.002, "m", "side of a cell of the strip", Limits::positive()},
          {"overlay_width", 1600, "px", "a wider overlay is scaled down", Limits::between(100, 20000)},
          {"tf_timeout", 2.0, "s", "how long an image waits for its transform and the first camera_info",
           Limits::positive()},
      },
      [] { return std::make_shared<ShadowProfiler>(); }};
}

}  // namespace aeolian

PLUGINLIB_EXPORT_CLASS(aeolian::ShadowProfiler, nodelet::Nodelet)
