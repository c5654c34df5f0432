#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <pluginlib/class_list_macros.hpp>
#include <visualization_msgs/MarkerArray.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/shading.hpp"
#include "aeolian_core/twin/forecast.hpp"
#include "aeolian_twin/nodes/drawn_surface.hpp"
#include "aeolian_twin/nodes/map_receiver.hpp"
#include "aeolian_twin/nodes/node.hpp"

namespace aeolian {

/// Any grid map as a coloured point cloud and a shaded mesh for a stock rviz. Only what has changed is drawn
/// anew, and nothing that nobody looks at; one who starts to look gets the last picture.
class SurfaceDisplay : public Node {
 public:
  SurfaceDisplay() : Node(describe_surface_display()) {}

 private:
  void start() override {
    heights_ = parameters().text("layer");
    values_ = parameters().text("value_layer").empty() ? heights_ : parameters().text("value_layer");
    look_.palette = parameters().text("palette") == "diverging" ? Palette::diverging : Palette::sand;
    look_.range = {parameters().number("range_low"), parameters().number("range_high")};
    if (look_.range.low > look_.range.high) parameters().refuse("range_low", "at most range_high");
    chooses_range_ = look_.range.low == look_.range.high;
    if (parameters().numbers("offset").size() != 3) parameters().refuse("offset", "a list of three numbers");
    centred_ = parameters().flag("centred");
    look_.shaded = parameters().flag("shaded");
    look_.exaggeration = parameters().number("exaggeration");
    mesh_.emplace(parameters().number("max_mesh_cells"));
    title_ = parameters().text("title");

    using Looker = ros::SingleSubscriberPublisher;
    cloud_publisher_ = nh().advertise<sensor_msgs::PointCloud2>(
        "cloud", 1, [this](const Looker& to) { show([&] { to.publish(draw_cloud()); }); });
    mesh_publisher_ = nh().advertise<visualization_msgs::MarkerArray>(
        "mesh", 1, [this](const Looker& to) { show([&] { to.publish(draw_mesh()); }); });
    WantedMap wanted;
    wanted.layers = {heights_, values_, layer::lead_time};
    wanted.accept = [this](const std::string& topic, const std_msgs::Header& header) {
      require_frame(topic, header);
    };
    receiver_ = std::make_unique<MapReceiver>(
        nh(), "map",
        [this](const HeightMap& map, const std_msgs::Header& header, const TileMask& changed) {
          take(map, header, changed);
        },
        [this](const std::string& reason) { bad("map", reason); }, wanted);
  }

  void take(const HeightMap& map, const std_msgs::Header& header, const TileMask& changed) {
    const bool another = !map_ || geometry_ != map.geometry();
    map_ = &map;
    header_ = header;
    geometry_ = map.geometry();
    if (another) {
      not_in_cloud_ = not_in_mesh_ = changed;
    } else {
      not_in_cloud_.merge(changed);
      not_in_mesh_.merge(changed);
    }
    since_range_ = another ? changed.count() : since_range_ + changed.count();
    if (changed.empty()) return;
    if (cloud_publisher_.getNumSubscribers() > 0) show([this] { cloud_publisher_.publish(draw_cloud()); });
    if (mesh_publisher_.getNumSubscribers() > 0) show([this] { mesh_publisher_.publish(draw_mesh()); });
  }

  template <class Publish>
  void show(Publish&& publish) {
    if (!map_) return;
    try {
      publish();
      good("map", "shown");
    } catch (const Error& error) {
      bad("map", receiver_->topic() + ": " + error.what());
    }
  }

  const sensor_msgs::PointCloud2& draw_cloud() {
    const DrawnLayers layers = choose_look();
    const sensor_msgs::PointCloud2& drawn = cloud_.draw(layers, look_, not_in_cloud_, header_);
    not_in_cloud_.clear();
    return drawn;
  }

  const visualization_msgs::MarkerArray& draw_mesh() {
    const DrawnLayers layers = choose_look();
    std_msgs::Header header = header_;
    header.stamp = ros::Time();  // drawn at once
    visualization_msgs::MarkerArray& drawn = mesh_->draw(layers, look_, not_in_mesh_, header);
    not_in_mesh_.clear();
    drawn.markers.resize(title_.empty() ? 1 : 2);
    if (!title_.empty()) drawn.markers.back() = title(header);
    return drawn;
  }

  /// The layers to be drawn. A range that the map gives is chosen anew only when as many tiles have changed
  /// as the map has, so that few changes do not cost a walk over the whole map and colours do not flicker.
  DrawnLayers choose_look() {
    const DrawnLayers layers{geometry_, map_->layer(heights_), map_->layer(values_)};
    look_.offset = offset();
    const TileMask all(geometry_);
    if (chooses_range_ && since_range_ >= all.tiles_x() * all.tiles_y()) {
      look_.range = display_range(layers.values, look_.palette);
      since_range_ = 0;
    }
    return layers;
  }

  std::array<double, 3> offset() const {
    const std::vector<double>& lengths = parameters().numbers("offset");
    std::array<double, 3> result{lengths[0] * geometry_.length_x(), lengths[1] * geometry_.length_y(),
                                 lengths[2]};
    if (centred_) {
      result[0] -= geometry_.origin_x() + geometry_.length_x() / 2;
      result[1] -= geometry_.origin_y() + geometry_.length_y() / 2;
    }
    return result;
  }

  /// The title with the lead time of a forecast and what the first and last colour mean, in millimetres or
  /// metres.
  visualization_msgs::Marker title(const std_msgs::Header& header) const {
    std::string text = title_;
    if (map_->has(layer::lead_time)) {
      const HeightMap::Layer& lead = map_->layer(layer::lead_time);
      const auto known = std::find_if(lead.begin(), lead.end(), [](float t) { return std::isfinite(t); });
      if (known != lead.end()) text += fmt::format(" {:.0f} s ahead", *known);
    }
    const ValueRange& shown = look_.range;
    const bool small = std::max(std::abs(shown.low), std::abs(shown.high)) < 0.5;
    const double unit = small ? 1e-3 : 1;
    const bool diverging = look_.palette == Palette::diverging;
    text += fmt::format(", {} {:.1f} to {} {:.1f} {}", diverging ? "blue" : "dark", shown.low / unit,
                        diverging ? "red" : "bright", shown.high / unit, small ? "mm" : "m");

    visualization_msgs::Marker marker;
    marker.header = header;
    marker.ns = "title";
    marker.type = visualization_msgs::Marker::TEXT_VIEW_FACING;
    marker.action = visualization_msgs::Marker::ADD;
    marker.text = text;
    marker.scale.z = 0.05 * geometry_.length_x();
    marker.pose.position.x = geometry_.origin_x() + geometry_.length_x() / 2 + look_.offset[0];
    marker.pose.position.y =
        geometry_.origin_y() + geometry_.length_y() + 0.9 * marker.scale.z + look_.offset[1];
    marker.pose.position.z = mesh_->lowest() + look_.offset[2];
    marker.pose.orientation.w = 1;
    marker.color.r = marker.color.g = marker.color.b = 0.15F;
    marker.color.a = 1;
    return marker;
  }

  std::string heights_;
  std::string values_;
  bool chooses_range_ = false;
  bool centred_ = false;
  std::string title_;
  SurfaceLook look_;

  const HeightMap* map_ = nullptr;  ///< the receiver's, once there is one
  std_msgs::Header header_;
  GridGeometry geometry_;
  int since_range_ = 0;  ///< tiles changed since the range of the colours was chosen
  TileMask not_in_cloud_;
  TileMask not_in_mesh_;
  DrawnCloud cloud_;
  std::optional<DrawnMesh> mesh_;
  ros::Publisher cloud_publisher_;
  ros::Publisher mesh_publisher_;
  std::unique_ptr<MapReceiver> receiver_;
};

NodeDescription describe_surface_display() {
  return {"surface_display",
          "shows any grid map in a stock rviz",
          {"map (grid_map_msgs/GridMap), map_updates (grid_map_msgs/GridMap): parts of it that have changed"},
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
