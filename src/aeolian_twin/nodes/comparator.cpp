#include <algorithm>
#include <cmath>
#include <deque>
#include <memory>
#include <utility>

#include <fmt/format.h>
#include <pluginlib/class_list_macros.hpp>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/twin/comparison.hpp"
#include "aeolian_core/twin/difference.hpp"
#include "aeolian_core/twin/forecast.hpp"
#include "aeolian_core/twin/on_grid.hpp"
#include "aeolian_core/wind/direction.hpp"
#include "aeolian_twin/nodes/conversions.hpp"
#include "aeolian_twin/nodes/map_receiver.hpp"
#include "aeolian_twin/nodes/node.hpp"

namespace aeolian {

/// Scores every forecast against the measured map nearest to the time for which it holds.
class Comparator : public Node {
 public:
  Comparator() : Node(describe_comparator()) {}

 private:
  using Map = grid_map_msgs::GridMap::ConstPtr;

  struct Measured {
    std_msgs::Header header;
    std::shared_ptr<const HeightMap> surface;  ///< elevation, and variance if known
  };
  struct WindSample {
    ros::Time stamp;
    double friction_velocity;
    double direction;
  };

  void start() override {
    tolerance_ = parameters().number("tolerance");
    direction_ = degrees_to_radians(parameters().number("direction_deg"));
    max_maps_ = static_cast<std::size_t>(parameters().integer("max_maps"));
    max_pending_ = static_cast<std::size_t>(parameters().integer("max_pending"));
    comparison_publisher_ = nh().advertise<aeolian_msgs::Comparison>("comparison", 100);
    difference_publisher_ = nh().advertise<grid_map_msgs::GridMap>("difference", 1, /*latch=*/true);
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
      wind_.push_back({message->info.header.stamp, wind.friction_velocity, wind.direction});
      if (wind_.size() > 100000) wind_.pop_front();  // some hours of readings
      good("wind", "its direction is known");
    } catch (const Error& error) {
      bad("wind", error.what());
    }
  }

  void take_forecast(const Map& message) {
    try {
      require_frame(forecast_subscriber_.getTopic(), message->info.header);
      pending_.push_back(message);
      if (pending_.size() > max_pending_) {
        pending_.pop_front();
        bad("pending",
            fmt::format("more than {} forecasts wait (~max_pending): the oldest was dropped", max_pending_));
      }
      score_pending();
    } catch (const Error& error) {
      bad("forecast", error.what());
    }
  }

  void take_map(const HeightMap& map, const std_msgs::Header& header, const TileMask& changed) {
    if (!maps_.empty() && header.stamp < maps_.back().header.stamp) {
      bad("clock", fmt::format("time jumped back (a bag that loops?): {} waiting forecasts were dropped",
                               pending_.size()));
      pending_.clear();
      maps_.clear();
      wind_.clear();
    } else if (!maps_.empty()) {
      good("clock", "time runs forward");
    }
    const bool same = changed.empty() && !maps_.empty();
    maps_.push_back({header, same ? maps_.back().surface : std::make_shared<const HeightMap>(map)});
    if (maps_.size() > max_maps_) maps_.pop_front();
    score_pending();
    good("map", "in use");
  }

  /// Scores the forecasts whose time has come: the nearest map is known once one at or after it has arrived.
  void score_pending() {
    if (maps_.empty()) return;
    const ros::Time newest = maps_.back().header.stamp;
    const auto due = [&](const Map& forecast) { return forecast->info.header.stamp <= newest; };
    const auto first_due =
        std::stable_partition(pending_.begin(), pending_.end(), [&](const Map& m) { return !due(m); });
    const std::vector<Map> ready(first_due, pending_.end());
    pending_.erase(first_due, pending_.end());
    for (const Map& forecast : ready) {
      try {
        score(*forecast, nearest_map(forecast->info.header.stamp));
      } catch (const Error& error) {
        bad("forecast", error.what());
      }
    }
  }

  const Measured& nearest_map(const ros::Time& time) const {
    const auto distance = [&](const Measured& map) { return std::abs((map.header.stamp - time).toSec()); };
    const Measured& nearest =
        *std::min_element(maps_.begin(), maps_.end(),
                          [&](const Measured& a, const Measured& b) { return distance(a) < distance(b); });
    if (distance(nearest) > tolerance_)
      throw Error(fmt::format(
          "the map nearest to a forecast for {}.{:09} is {:.2f} s away, must be within {} s (~tolerance)",
          time.sec, time.nsec, distance(nearest), tolerance_));
    return nearest;
  }

  void score(const grid_map_msgs::GridMap& forecast_message, const Measured& measured) {
    const GridGeometry& geometry = measured.surface->geometry();
    const HeightMap forecast = on_grid(to_height_map(forecast_message), geometry);
    const HeightMap::Layer& predicted = forecast.layer(layer::elevation);
    const HeightMap::Layer& heights = measured.surface->layer(layer::elevation);

    const std_msgs::Header& header = forecast_message.info.header;
    const ros::Time issued = header.stamp - ros::Duration(lead_time(forecast));
    const Comparison comparison = compare(geometry, predicted, heights, forecast.layer(layer::initial),
                                          wind_direction(issued, header.stamp));
    comparison_publisher_.publish(to_message(comparison, header, issued));

    difference_ = difference_map(forecast, *measured.surface, std::move(difference_));
    difference_.add(layer::elevation, heights);
    difference_.add(layer::lead_time, forecast.layer(layer::lead_time));
    difference_publisher_.publish(to_message(difference_, measured.header));
    good("forecast",
         fmt::format("the last one, {:.0f} s ahead, has an RMSE of {:.3g} mm and a skill of {:.2f} against "
                     "persistence",
                     (header.stamp - issued).toSec(), 1e3 * comparison.rmse, comparison.skill_persistence));
  }

  /// To a microsecond, as the layer holds floats.
  static double lead_time(const HeightMap& forecast) {
    for (const float t : forecast.layer(layer::lead_time))
      if (std::isfinite(t)) return std::round(static_cast<double>(t) * 1e6) / 1e6;
    throw Error("forecast: layer 'lead_time' has no known cell");
  }

  /// Mean over an interval, weighted by friction velocity; ~direction_deg when no wind is known there.
  double wind_direction(const ros::Time& from, const ros::Time& to) const {
    double east = 0;
    double north = 0;
    for (const WindSample& sample : wind_) {
      if (sample.stamp < from || sample.stamp > to) continue;
      east += sample.friction_velocity * std::cos(sample.direction);
      north += sample.friction_velocity * std::sin(sample.direction);
    }
    return east == 0 && north == 0 ? direction_ : std::atan2(north, east);
  }

  double tolerance_ = 0;
  double direction_ = 0;
  std::size_t max_maps_ = 0;
  std::size_t max_pending_ = 0;
  std::deque<Measured> maps_;  ///< the newest measured maps, oldest first
  std::deque<Map> pending_;    ///< forecasts whose time has not come
  std::deque<WindSample> wind_;
  ros::Publisher comparison_publisher_;
  ros::Publisher difference_publisher_;
  ros::Subscriber wind_subscriber_;
  ros::Subscriber forecast_subscriber_;
  std::unique_ptr<MapReceiver> receiver_;
  HeightMap difference_;  ///< the last one
};

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
