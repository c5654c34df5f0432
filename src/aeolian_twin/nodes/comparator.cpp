#include <memory>
#include <utility>

#include <fmt/format.h>
#include <pluginlib/class_list_macros.hpp>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/twin/forecast_scorer.hpp"
#include "aeolian_core/wind/direction.hpp"
#include "aeolian_twin/nodes/conversions.hpp"
#include "aeolian_twin/nodes/map_receiver.hpp"
#include "aeolian_twin/nodes/node.hpp"
#include "aeolian_twin/nodes/relative_clock.hpp"
#include "aeolian_twin/nodes/score_output.hpp"
#include "aeolian_twin/nodes/settings.hpp"

namespace aeolian {

/// ForecastScorer on topics.
class Comparator : public Node {
 public:
  Comparator() : Node(describe_comparator()) {}

 private:
  using Map = grid_map_msgs::GridMap::ConstPtr;

  void start() override {
    scorer_ = std::make_unique<ForecastScorer>(read_scorer(parameters()));
    comparison_publisher_ = nh().advertise<aeolian_msgs::Comparison>("comparison", 100);
    difference_publisher_ = nh().advertise<grid_map_msgs::GridMap>("difference", 10, /*latch=*/true);
    wind_subscriber_ = nh().subscribe("wind_field", 1000, &Comparator::take_wind, this);
    forecast_subscriber_ = nh().subscribe("forecast", 100, &Comparator::take_forecast, this);
    WantedMap wanted;
    wanted.layers = {layer::elevation, layer::variance};
    wanted.accept = [this](const std::string& topic, const std_msgs::Header& header) {
      require_frame(topic, header);
    };
    wanted.queue_size = 10;
    receiver_ = std::make_unique<MapReceiver>(
        nh(), "height_map",
        [this](const HeightMap& map, const std_msgs::Header& header, const TileMask& changed) {
          take_map(map, header, changed);
        },
        [this](const std::string& reason) { bad("map", reason); }, wanted);
  }

  void take_wind(const Map& message) {
    try {
      const WindField wind = to_wind_field(*message);
      scorer_->take_wind({clock_.seconds(message->info.header.stamp), wind.friction_velocity, wind.direction,
                          wind.air_density});
      good("wind", "its direction is known");
    } catch (const Error& error) {
      bad("wind", error.what());
    }
  }

  void take_forecast(const Map& message) {
    try {
      require_frame(forecast_subscriber_.getTopic(), message->info.header);
      ForecastScorer::Taken taken =
          scorer_->take_forecast(std::make_shared<const HeightMap>(to_height_map(*message)),
                                 clock_.seconds(message->info.header.stamp));
      if (taken.oldest_dropped)
        bad("pending", fmt::format("more than {} forecasts wait (~max_pending): the oldest was dropped",
                                   parameters().integer("max_pending")));
      publish(std::move(taken.scores));
    } catch (const Error& error) {
      bad("forecast", error.what());
    }
  }

  void take_map(const HeightMap& map, const std_msgs::Header& header, const TileMask& changed) {
    const bool first = scorer_->newest_map() == nullptr;
    ForecastScorer::Taken taken = scorer_->take_map(
        changed.empty() && !first ? scorer_->newest_map() : std::make_shared<const HeightMap>(map),
        clock_.seconds(header.stamp));
    if (taken.begun_anew)
      bad("clock", fmt::format("time jumped back (a bag that loops?): {} waiting forecasts were dropped",
                               *taken.begun_anew));
    else if (!first)
      good("clock", "time runs forward");
    publish(std::move(taken.scores));
    good("map", "in use");
  }

  void publish(std::vector<ForecastScorer::Score> scores) {
    put_out(std::move(scores), *scorer_,
            {parameters().text("frame_id"), clock_,
             [this](const aeolian_msgs::Comparison& message) { comparison_publisher_.publish(message); },
             [this](const grid_map_msgs::GridMap& message) { difference_publisher_.publish(message); },
             [this](const std::string& thing, bool well, const std::string& line) {
               well ? good(thing, line) : bad(thing, line);
             }});
  }

  std::unique_ptr<ForecastScorer> scorer_;
  RelativeClock clock_;
  ros::Publisher comparison_publisher_;
  ros::Publisher difference_publisher_;
  ros::Subscriber wind_subscriber_;
  ros::Subscriber forecast_subscriber_;
  std::unique_ptr<MapReceiver> receiver_;
};

ForecastScorer::Settings read_scorer(const Parameters& parameters) {
  ForecastScorer::Settings settings;
  settings.tolerance = parameters.number("tolerance");
  settings.direction = degrees_to_radians(parameters.number("direction_deg"));
  settings.max_maps = static_cast<std::size_t>(parameters.integer("max_maps"));
  settings.max_pending = static_cast<std::size_t>(parameters.integer("max_pending"));
  return settings;
}

NodeDescription describe_comparator() {
  return {
      "comparator",
      "scores every forecast against the measurement of its time",
      {"height_map, height_map_updates (grid_map_msgs/GridMap): whole, what has changed",
       "forecast (grid_map_msgs/GridMap)", "wind_field (grid_map_msgs/GridMap)"},
      {"comparison (aeolian_msgs/Comparison)",
       "difference (grid_map_msgs/GridMap, latched): difference (predicted - measured), lod95 (what noise "
       "alone exceeds in 5 % of the cells; of maps with variance), elevation (measured) [m], lead_time [s]"},
      {
          frame_parameter(),
          {"tolerance", 1.0, "s", "the map compared must be so near to the forecast's time",
           Limits::not_negative()},
          {"direction_deg", 0.0, "degrees",
           "where the wind blows to, counter-clockwise from east, until it is known",
           Limits::between(-360, 360)},
          {"max_pending", 100, "", "forecasts that may wait for their measurement",
           Limits::between(1, 10000)},
          {"max_maps", 20, "", "measured maps that are kept for forecasts that come late",
           Limits::between(2, 1000)},
      },
      [] { return std::make_shared<Comparator>(); }};
}

}  // namespace aeolian

PLUGINLIB_EXPORT_CLASS(aeolian::Comparator, nodelet::Nodelet)
