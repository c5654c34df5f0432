#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <pluginlib/class_list_macros.hpp>
#include <visualization_msgs/MarkerArray.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/resample.hpp"
#include "aeolian_core/surface/shading.hpp"
#include "aeolian_core/twin/forecast.hpp"
#include "aeolian_twin/nodes/conversions.hpp"
#include "aeolian_twin/nodes/node.hpp"

namespace aeolian {

/// Any grid map as a coloured point cloud and a shaded mesh for a stock rviz. Nothing is converted that
/// nobody looks at; one who starts to look gets the last map.
class SurfaceDisplay : public Node {
 public:
  SurfaceDisplay() : Node(describe_surface_display()) {}

 private:
  void start() override {
    heights_ = parameters().text("layer");
    values_ = parameters().text("value_layer").empty() ? heights_ : parameters().text("value_layer");
    palette_ = parameters().text("palette") == "diverging" ? Palette::diverging : Palette::sand;
    range_ = {parameters().number("range_low"), parameters().number("range_high")};
    if (range_.low > range_.high) parameters().refuse("range_low", "at most range_high");
    if (parameters().numbers("offset").size() != 3) parameters().refuse("offset", "a list of three numbers");
    std::copy_n(parameters().numbers("offset").begin(), 3, offset_.begin());
    centred_ = parameters().flag("centred");
    shaded_ = parameters().flag("shaded");
    exaggeration_ = parameters().number("exaggeration");
    max_cells_ = parameters().number("max_mesh_cells");
    title_ = parameters().text("title");

    using Subscriber = ros::SingleSubscriberPublisher;
    cloud_publisher_ = nh().advertise<sensor_msgs::PointCloud2>(
        "cloud", 1, [this](const Subscriber& to) { show([&] { to.publish(cloud()); }); });
    mesh_publisher_ = nh().advertise<visualization_msgs::MarkerArray>(
        "mesh", 1, [this](const Subscriber& to) { show([&] { to.publish(mesh()); }); });
    subscriber_ = nh().subscribe("map", 1, &SurfaceDisplay::take, this);
  }

  void take(const grid_map_msgs::GridMap::ConstPtr& message) {
    message_ = message;
    if (cloud_publisher_.getNumSubscribers() > 0) show([this] { cloud_publisher_.publish(cloud()); });
    if (mesh_publisher_.getNumSubscribers() > 0) show([this] { mesh_publisher_.publish(mesh()); });
  }

  template <class Publish>
  void show(Publish&& publish) {
    if (!message_) return;
    try {
      require_frame(subscriber_.getTopic(), message_->info.header);
      publish();
      good("map", "shown");
    } catch (const Error& error) {
      bad("map", subscriber_.getTopic() + ": " + error.what());
    }
  }

  sensor_msgs::PointCloud2 cloud() const {
    const HeightMap map = to_height_map(*message_);
    return to_coloured_cloud(map, drawing(map, range(map)), message_->info.header);
  }

  visualization_msgs::MarkerArray mesh() const {
    const HeightMap full = to_height_map(*message_);
    const ValueRange shown = range(full);
    const HeightMap map = thinned(full);
    visualization_msgs::MarkerArray markers;
    markers.markers.push_back(to_mesh(map, drawing(map, shown), message_->info.header));
    if (!title_.empty()) markers.markers.push_back(title(map, shown));
    for (visualization_msgs::Marker& marker : markers.markers)
      marker.header.stamp = ros::Time();  // drawn at once
    return markers;
  }

  ValueRange range(const HeightMap& map) const {
    return range_.low < range_.high ? range_ : display_range(map.layer(values_), palette_);
  }

  Drawing drawing(const HeightMap& map, const ValueRange& shown) const {
    Drawing result;
    result.layer = heights_;
    result.exaggeration = exaggeration_;
    result.offset = offset(map.geometry());
    result.colours = shaded_ ? shaded_colours(map.geometry(), map.layer(values_), palette_, shown,
                                              &map.layer(heights_), exaggeration_)
                             : plain_colours(map.layer(values_), shown);
    return result;
  }

  std::vector<Rgb> plain_colours(const HeightMap::Layer& values, const ValueRange& shown) const {
    const double extent = shown.high > shown.low ? shown.high - shown.low : 1;
    std::vector<Rgb> colours;
    colours.reserve(values.size());
    for (const float v : values)
      colours.push_back(colour(palette_, (static_cast<double>(v) - shown.low) / extent));
    return colours;
  }

  std::array<double, 3> offset(const GridGeometry& geometry) const {
    std::array<double, 3> result{offset_[0] * geometry.length_x(), offset_[1] * geometry.length_y(),
                                 offset_[2]};
    if (centred_) {
      result[0] -= geometry.origin_x() + geometry.length_x() / 2;
      result[1] -= geometry.origin_y() + geometry.length_y() / 2;
    }
    return result;
  }

  /// The map with so few cells that rviz stays quick.
  HeightMap thinned(const HeightMap& map) const {
    const GridGeometry& g = map.geometry();
    const double factor = std::ceil(std::sqrt(static_cast<double>(g.size()) / max_cells_));
    if (factor <= 1) return map;
    const auto coarse = [factor](int cells) { return static_cast<int>(std::ceil(cells / factor)); };
    return resample(
        map, GridGeometry(g.origin_x(), g.origin_y(), g.cell() * factor, coarse(g.nx()), coarse(g.ny())));
  }

  /// The title with the lead time of a forecast and what the first and last colour mean, in millimetres or
  /// metres.
  visualization_msgs::Marker title(const HeightMap& map, const ValueRange& shown) const {
    std::string text = title_;
    if (map.has(layer::lead_time)) {
      const HeightMap::Layer& lead = map.layer(layer::lead_time);
      const auto known = std::find_if(lead.begin(), lead.end(), [](float t) { return std::isfinite(t); });
      if (known != lead.end()) text += fmt::format(" {:.0f} s ahead", *known);
    }
    const bool small = std::max(std::abs(shown.low), std::abs(shown.high)) < 0.5;
    const double unit = small ? 1e-3 : 1;
    const bool diverging = palette_ == Palette::diverging;
    text += fmt::format(", {} {:.1f} to {} {:.1f} {}", diverging ? "blue" : "dark", shown.low / unit,
                        diverging ? "red" : "bright", shown.high / unit, small ? "mm" : "m");

    const GridGeometry& geometry = map.geometry();
    const std::array<double, 3> moved = offset(geometry);
    visualization_msgs::Marker marker;
    marker.header = message_->info.header;
    marker.ns = "title";
    marker.type = visualization_msgs::Marker::TEXT_VIEW_FACING;
    marker.action = visualization_msgs::Marker::ADD;
    marker.text = text;
    marker.scale.z = 0.05 * geometry.length_x();
    marker.pose.position.x = geometry.origin_x() + geometry.length_x() / 2 + moved[0];
    marker.pose.position.y = geometry.origin_y() + geometry.length_y() + 0.9 * marker.scale.z + moved[1];
    marker.pose.position.z = lowest(map.layer(heights_)) + moved[2];
    marker.pose.orientation.w = 1;
    marker.color.r = marker.color.g = marker.color.b = 0.15F;
    marker.color.a = 1;
    return marker;
  }

  static double lowest(const HeightMap::Layer& heights) {
    double low = std::numeric_limits<double>::infinity();
    for (const float z : heights)
      if (std::isfinite(z)) low = std::min(low, static_cast<double>(z));
    return std::isfinite(low) ? low : 0;
  }

  std::string heights_;
  std::string values_;
  Palette palette_ = Palette::sand;
  ValueRange range_;
  std::array<double, 3> offset_{};
  bool centred_ = false;
  bool shaded_ = true;
  double exaggeration_ = 1;
  double max_cells_ = 0;
  std::string title_;
  grid_map_msgs::GridMap::ConstPtr message_;
  ros::Publisher cloud_publisher_;
  ros::Publisher mesh_publisher_;
  ros::Subscriber subscriber_;
};

NodeDescription describe_surface_display() {
  return {"surface_display",
          "shows any grid map in a stock rviz",
          {"map (grid_map_msgs/GridMap)"},
          {"cloud (sensor_msgs/PointCloud2): x, y, z, rgb for each known cell",
           "mesh (visualization_msgs/MarkerArray): shaded surface and title"},
          {
              frame_parameter(),
              {"layer", layer::elevation, "", "drawn as height"},
              {"value_layer", std::string(), "", "drawn as colour; empty: the layer of the heights"},
              {"palette", std::string("sand"), "", "of the colours", Limits::any(), {"sand", "diverging"}},
              {"range_low", 0.0, "m", "value of the first colour; equal to range_high: chosen from the map",
               Limits::any()},
              {"range_high", 0.0, "m", "value of the last colour", Limits::any()},
              {"shaded", true, "", "slopes are darker or brighter, as under a lamp in the north-west"},
              {"exaggeration", 3.0, "", "factor on the heights as drawn", Limits::positive()},
              {"offset", std::vector<double>{0, 0, 0}, "map lengths, map lengths, m",
               "drawn so far beside its place", Limits::any()},
              {"centred", false, "",
               "drawn with its centre at the frame's origin, for maps with large coordinates"},
              {"max_mesh_cells", 60000.0, "", "a larger map is drawn with coarser cells", Limits::positive()},
              {"title", std::string(), "", "text above the mesh; empty: none"},
          },
          [] { return std::make_shared<SurfaceDisplay>(); }};
}

}  // namespace aeolian

PLUGINLIB_EXPORT_CLASS(aeolian::SurfaceDisplay, nodelet::Nodelet)
