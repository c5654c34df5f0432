#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <pluginlib/class_list_macros.hpp>
#include <std_msgs/Float64MultiArray.h>
#include <visualization_msgs/MarkerArray.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/shading.hpp"
#include "aeolian_core/twin/forecast.hpp"
#include "aeolian_core/wind/direction.hpp"
#include "aeolian_twin/nodes/drawn_crests.hpp"
#include "aeolian_twin/nodes/drawn_surface.hpp"
#include "aeolian_twin/nodes/drawn_wind.hpp"
#include "aeolian_twin/nodes/lead_time_words.hpp"
#include "aeolian_twin/nodes/map_legend.hpp"
#include "aeolian_twin/nodes/map_receiver.hpp"
#include "aeolian_twin/nodes/node.hpp"
#include "aeolian_twin/nodes/wind_drawing.hpp"

namespace aeolian {
namespace {

const std::map<std::string, Palette> palettes = {
    {"sand", Palette::sand}, {"diverging", Palette::diverging}, {"viridis", Palette::viridis}};

/// Crests are found up to 60 degrees off; another wind must not bring them near that.
constexpr double notable_turn = degrees_to_radians(20);

}  // namespace

/// Any grid map as a coloured point cloud, a shaded mesh with title and colour bar, the crests of its ripples
/// and the wind over it, for a stock rviz. Only what has changed is drawn anew, and nothing that nobody looks
/// at; one who starts to look gets the last picture.
class SurfaceDisplay : public Node {
 public:
  SurfaceDisplay() : Node(describe_surface_display()) {}

 private:
  void start() override {
    heights_ = parameters().text("layer");
    values_ = parameters().text("value_layer").empty() ? heights_ : parameters().text("value_layer");
    look_.palette = palettes.at(parameters().text("palette"));
    look_.range = {parameters().number("range_low"), parameters().number("range_high")};
    if (look_.range.low > look_.range.high) parameters().refuse("range_low", "at most range_high");
    chooses_range_ = look_.range.low == look_.range.high;
    const std::string& other = parameters().text("range_topic");
    if (chooses_range_ && other.empty())
      range_publisher_ = nh().advertise<std_msgs::Float64MultiArray>("range", 1, /*latch=*/true);
    else if (chooses_range_)
      range_subscriber_ = nh().subscribe(other, 1, &SurfaceDisplay::take_range, this);
    if (parameters().numbers("offset").size() != 3) parameters().refuse("offset", "a list of three numbers");
    centred_ = parameters().flag("centred");
    look_.shaded = parameters().flag("shaded");
    look_.exaggeration = parameters().number("exaggeration");
    mesh_.emplace(parameters().number("max_mesh_cells"));
    title_ = parameters().text("title");
    unit_ = parameters().text("unit");

    using Looker = ros::SingleSubscriberPublisher;
    cloud_publisher_ = nh().advertise<sensor_msgs::PointCloud2>(
        "cloud", 1, [this](const Looker& to) { show([&] { to.publish(draw_cloud()); }); });
    mesh_publisher_ = nh().advertise<visualization_msgs::MarkerArray>(
        "mesh", 1, [this](const Looker& to) { show([&] { to.publish(draw_mesh()); }); });
    crests_ = std::make_unique<WindDrawing<visualization_msgs::Marker>>(nh(), crests());
    wind_ = std::make_unique<WindDrawing<visualization_msgs::MarkerArray>>(nh(), wind());
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
    show_to_lookers();
    crests_->note_change();
    wind_->note_change();
  }

  void take_range(const std_msgs::Float64MultiArray::ConstPtr& message) {
    const auto& ends = message->data;
    if (ends.size() != 2 || !(ends[0] <= ends[1])) {
      bad("range",
          fmt::format("{}: must be two numbers, the first at most the second", range_subscriber_.getTopic()));
      return;
    }
    good("range", "as " + range_subscriber_.getTopic());
    chooses_range_ = false;
    look_.range = {ends[0], ends[1]};
    show_to_lookers();
  }

  void show_to_lookers() {
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
    if (!title_.empty() && map_->has(heights_) && !map_->has(values_)) return say_unknown();
    const DrawnLayers layers = choose_look();
    visualization_msgs::MarkerArray& drawn = mesh_->draw(layers, look_, not_in_mesh_, drawn_at_once());
    not_in_mesh_.clear();
    drawn.markers.resize(1);
    if (title_.empty()) return drawn;
    for (visualization_msgs::Marker& marker :
         legend(title_ + lead_time_in_words(), mesh_->lowest()).markers())
      drawn.markers.push_back(std::move(marker));
    return drawn;
  }

  /// A title instead of a picture, for a layer that the map may lack as well as have.
  const visualization_msgs::MarkerArray& say_unknown() {
    look_.offset = offset();
    visualization_msgs::Marker surface;
    surface.header = drawn_at_once();
    surface.ns = "surface";
    surface.action = visualization_msgs::Marker::DELETE;
    unknown_.markers =
        legend(fmt::format("{}: no layer '{}'", title_, values_), lowest_height(map_->layer(heights_)))
            .only_title();
    unknown_.markers.insert(unknown_.markers.begin(), surface);
    return unknown_;
  }

  MapLegend legend(const std::string& title, double lowest) const {
    return {geometry_, look_, lowest, title, unit_, drawn_at_once()};
  }

  std_msgs::Header drawn_at_once() const {
    std_msgs::Header header = header_;
    header.stamp = ros::Time();
    return header;
  }

  WindDrawing<visualization_msgs::Marker>::What crests() {
    WindField wind;
    wind.direction = degrees_to_radians(parameters().number("direction_deg"));
    const auto draw = [this](const WindField& now) {
      std::optional<visualization_msgs::Marker> result;
      show([&] { result = draw_crests(choose_look(), look_, now.direction, drawn_at_once()); });
      return result;
    };
    const auto differs = [](const WindField& drawn, const WindField& now) {
      return std::abs(wrap_angle(now.direction - drawn.direction)) > notable_turn;
    };
    return {"crests", parameters().number("crest_period"), wind, draw, differs};
  }

  WindDrawing<visualization_msgs::MarkerArray>::What wind() {
    const auto draw = [this](const WindField& now) {
      std::optional<visualization_msgs::MarkerArray> result;
      show([&] { result = draw_wind(now, choose_look(), look_, drawn_at_once()); });
      return result;
    };
    const auto differs = [](const WindField&, const WindField&) { return true; };
    return {"wind_arrows", parameters().number("wind_period"), std::nullopt, draw, differs};
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
      tell_range();
    }
    return layers;
  }

  void tell_range() const {
    if (!range_publisher_) return;
    std_msgs::Float64MultiArray message;
    message.data = {look_.range.low, look_.range.high};
    range_publisher_.publish(message);
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

  /// ", 2 min ahead" of a forecast, else nothing.
  std::string lead_time_in_words() const {
    if (!map_->has(layer::lead_time)) return "";
    const HeightMap::Layer& lead = map_->layer(layer::lead_time);
    const auto known = std::find_if(lead.begin(), lead.end(), [](float t) { return std::isfinite(t); });
    if (known == lead.end()) return "";
    const std::string words = ", " + lead_time_words(static_cast<double>(*known));
    return *known > 0 ? words + " ahead" : words;
  }

  std::string heights_;
  std::string values_;
  bool chooses_range_ = false;
  bool centred_ = false;
  std::string title_;
  std::string unit_;
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
  ros::Publisher range_publisher_;
  ros::Subscriber range_subscriber_;
  ros::Publisher mesh_publisher_;
  visualization_msgs::MarkerArray unknown_;
  std::unique_ptr<WindDrawing<visualization_msgs::Marker>> crests_;
  std::unique_ptr<WindDrawing<visualization_msgs::MarkerArray>> wind_;
  std::unique_ptr<MapReceiver> receiver_;
};

NodeDescription describe_surface_display() {
  return {
      "surface_display",
      "shows any grid map in a stock rviz",
      {"map (grid_map_msgs/GridMap), map_updates (grid_map_msgs/GridMap): parts of it that have changed",
       "wind_field (grid_map_msgs/GridMap): while somebody looks at crests, which lie across it, or at its "
       "arrows"},
      {"cloud (sensor_msgs/PointCloud2): x, y, z, rgb for each known cell",
       "range (std_msgs/Float64MultiArray, latched): the values of the first and last colour, where the map "
       "chooses them",
       "mesh (visualization_msgs/MarkerArray): shaded surface, title, colour bar",
       "crests (visualization_msgs/Marker): lines along the crests of ripples",
       "wind_arrows (visualization_msgs/MarkerArray): arrows and streamlines of the wind at the ground"},
      {
          frame_parameter(),
          {"layer", layer::elevation, "", "drawn as height"},
          {"value_layer", std::string(), "", "drawn as colour; empty: the layer of the heights"},
          {"palette",
           std::string("sand"),
           "",
           "of the colours",
           Limits::any(),
           {"sand", "diverging", "viridis"}},
          {"range_low", 0.0, "m", "value of the first colour; equal to range_high: chosen from the map",
           Limits::any()},
          {"range_high", 0.0, "m", "value of the last colour", Limits::any()},
          {"range_topic", std::string(), "",
           "range of another surface_display, so that both have the same colours; empty: its own"},
          {"shaded", true, "", "slopes are darker or brighter, as under a lamp in the north-west"},
          {"exaggeration", 3.0, "", "factor on the heights as drawn", Limits::positive()},
          {"offset", std::vector<double>{0, 0, 0}, "map lengths, map lengths, m",
           "drawn so far beside its place", Limits::any()},
          {"centred", false, "",
           "drawn with its centre at the frame's origin, for maps with large coordinates"},
          {"max_mesh_cells", 60000.0, "", "a larger map is drawn with coarser cells", Limits::positive()},
          {"title", std::string(), "", "text above the mesh, which then has a colour bar; empty: neither"},
          {"unit", std::string("m"), "",
           "of the colours, as the bar says it; of m also millimetres are told"},
          {"crest_period", 1.0, "s", "least time between drawings of the crests", Limits::not_negative()},
          {"wind_period", 1.0, "s", "least time between drawings of the wind", Limits::not_negative()},
          {"direction_deg", 0.0, "degrees",
           "where the wind blows to, counter-clockwise from east, until it is known",
           Limits::between(-360, 360)},
      },
      [] { return std::make_shared<SurfaceDisplay>(); }};
}

}  // namespace aeolian

PLUGINLIB_EXPORT_CLASS(aeolian::SurfaceDisplay, nodelet::Nodelet)
