#include <cmath>
#include <memory>

#include <aeolian_msgs/ForecastHorizons.h>
#include <fmt/format.h>
#include <pluginlib/class_list_macros.hpp>
#include <std_msgs/Float64.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/twin/forecast_ensemble.hpp"
#include "aeolian_twin/nodes/conversions.hpp"
#include "aeolian_twin/nodes/horizon_shelf.hpp"
#include "aeolian_twin/nodes/lead_time_words.hpp"
#include "aeolian_twin/nodes/map_receiver.hpp"
#include "aeolian_twin/nodes/node.hpp"

namespace aeolian {
namespace {

/// To a microsecond, as the layer holds floats.
double lead_time_of(const grid_map_msgs::GridMap& message, const std::string& topic) {
  try {
    const HeightMap map = to_height_map(message, {layer::lead_time});
    for (const float t : map.layer(layer::lead_time))
      if (std::isfinite(t) && t > 0) return std::round(static_cast<double>(t) * 1e6) / 1e6;
  } catch (const Error& error) {
    throw Error(topic + ": " + error.what());
  }
  throw Error(topic + ": layer 'lead_time' has no time above 0 s");
}

}  // namespace

/// Keeps the forecasts by lead time and shows the one that a person has chosen, with what forecasts of its
/// lead time have missed by; or, for a lead time of 0, the surface as measured now.
class ForecastShelf : public Node {
 public:
  ForecastShelf() : Node(describe_forecast_shelf()) {}

 private:
  using Map = grid_map_msgs::GridMap::ConstPtr;
  using Looker = ros::SingleSubscriberPublisher;

  void start() override {
    wanted_ = parameters().number("lead_time");
    const auto looks = [this](const Looker& to) {
      follow_measured();
      if (const Map map = chosen_forecast()) to.publish(map);
    };
    const auto looks_away = [this](const Looker&) { follow_measured(); };
    forecast_publisher_ = nh().advertise<grid_map_msgs::GridMap>("chosen_forecast", 1, looks, looks_away);
    difference_publisher_ =
        nh().advertise<grid_map_msgs::GridMap>("chosen_difference", 1, [this](const Looker& to) {
          if (const Map map = chosen_difference()) to.publish(map);
        });
    horizons_publisher_ =
        nh().advertise<aeolian_msgs::ForecastHorizons>("forecast_horizons", 1, /*latch=*/true);
    forecast_subscriber_ = nh().subscribe("forecast", 100, &ForecastShelf::take_forecast, this);
    difference_subscriber_ = nh().subscribe("difference", 100, &ForecastShelf::take_difference, this);
    choice_subscriber_ = nh().subscribe("chosen_lead_time", 10, &ForecastShelf::choose, this);
    tell_horizons();
  }

  void take_forecast(const Map& message) {
    try {
      require_frame(forecast_subscriber_.getTopic(), message->info.header);
      const double lead = lead_time_of(*message, forecast_subscriber_.getTopic());
      if (message->info.header.stamp.toSec() < lead)
        throw Error(fmt::format("{}: stamp is {} s, must be at least the lead time of {} s",
                                forecast_subscriber_.getTopic(), message->info.header.stamp.toSec(), lead));
      const ros::Time begin = message->info.header.stamp - ros::Duration(lead);
      if (!shelf_.put(to_stamp(begin), lead, message, to_stamp(ros::Time::now()))) return;
      good("forecast", fmt::format("{} horizons", shelf_.entries().size()));
      follow_measured();
      tell_horizons();
      if (chosen_forecast() == message) show_forecast();
    } catch (const Error& error) {
      bad("forecast", error.what());
    }
  }

  void take_difference(const Map& message) {
    try {
      require_frame(difference_subscriber_.getTopic(), message->info.header);
      differences_[lead_time_of(*message, difference_subscriber_.getTopic())] = message;
      if (chosen_difference() == message) show_difference();
      good("difference", "kept");
    } catch (const Error& error) {
      bad("difference", error.what());
    }
  }

  void choose(const std_msgs::Float64::ConstPtr& message) {
    if (!std::isfinite(message->data) || message->data < 0) {
      bad("choice", fmt::format("{}: {}, must be a lead time [s], or 0 for the surface as measured now",
                                choice_subscriber_.getTopic(), message->data));
      return;
    }
    const Map forecast = chosen_forecast();
    const Map difference = chosen_difference();
    wanted_ = message->data;
    follow_measured();
    tell_horizons();
    if (chosen_forecast() != forecast) show_forecast();
    if (chosen_difference() != difference) show_difference();
    good("choice", lead_time_words(chosen()));
  }

  /// The lead time wanted, or the nearest that there is.
  double chosen() const {
    const auto nearest = nearest_lead(shelf_.entries(), wanted_);
    if (nearest == shelf_.entries().end()) return wanted_;
    return wanted_ <= nearest->first / 2 ? 0 : nearest->first;
  }
  Map chosen_forecast() const {
    if (chosen() == 0) return measured_;
    const auto entry = shelf_.entries().find(chosen());
    return entry == shelf_.entries().end() ? nullptr : entry->second.item;
  }
  Map chosen_difference() const {
    const auto nearest = nearest_lead(differences_, chosen());
    return nearest == differences_.end() ? nullptr : nearest->second;
  }

  void show_forecast() {
    if (const Map map = chosen_forecast(); map && forecast_publisher_.getNumSubscribers() > 0)
      forecast_publisher_.publish(map);
  }
  void show_difference() {
    if (const Map map = chosen_difference(); map && difference_publisher_.getNumSubscribers() > 0)
      difference_publisher_.publish(map);
  }

  void tell_horizons() {
    aeolian_msgs::ForecastHorizons message;
    message.header.frame_id = parameters().text("frame_id");
    message.header.stamp = to_time(shelf_.newest_start());
    for (const auto& [lead, entry] : shelf_.entries()) {
      message.lead_times.push_back(lead);
      message.valid.push_back(to_time(entry.start) + ros::Duration(lead));
    }
    message.chosen = chosen();
    horizons_publisher_.publish(message);
  }

  /// Listens to the measured map while it is chosen and looked at.
  void follow_measured() {
    const bool follows = chosen() == 0 && forecast_publisher_.getNumSubscribers() > 0;
    if (follows == static_cast<bool>(receiver_)) return;
    measured_.reset();
    receiver_.reset();
    if (!follows) return;
    WantedMap wanted;
    wanted.layers = {layer::elevation, layer::variance};
    wanted.accept = [this](const std::string& topic, const std_msgs::Header& header) {
      require_frame(topic, header);
    };
    receiver_ = std::make_unique<MapReceiver>(
        nh(), "height_map",
        [this](const HeightMap& map, const std_msgs::Header& header, const TileMask& changed) {
          if (changed.empty() && measured_) return;
          show_measured(map, header);
        },
        [this](const std::string& reason) { bad("map", reason); }, wanted);
  }

  /// As a forecast of lead time 0: the standard deviation of the measurement is its spread.
  void show_measured(const HeightMap& map, const std_msgs::Header& header) {
    HeightMap now(map.geometry());
    now.add(layer::elevation, map.layer(layer::elevation));
    if (map.has(layer::variance)) {
      HeightMap::Layer& spread = now.add(layer::spread, map.layer(layer::variance));
      for (float& s : spread) s = std::sqrt(s);
    }
    now.add(layer::lead_time, 0);
    measured_ = boost::make_shared<const grid_map_msgs::GridMap>(to_message(now, header));
    show_forecast();
    good("map", "shown");
  }

  double wanted_ = 0;
  HorizonShelf<Map> shelf_;
  std::map<double, Map> differences_;  ///< the newest of each lead time [s]
  Map measured_;                       ///< while it is chosen and looked at
  ros::Publisher forecast_publisher_;
  ros::Publisher difference_publisher_;
  ros::Publisher horizons_publisher_;
  ros::Subscriber forecast_subscriber_;
  ros::Subscriber difference_subscriber_;
  ros::Subscriber choice_subscriber_;
  std::unique_ptr<MapReceiver> receiver_;
};

NodeDescription describe_forecast_shelf() {
  return {
      "forecast_shelf",
      "shows the forecast of a chosen lead time",
      {"forecast (grid_map_msgs/GridMap), difference (grid_map_msgs/GridMap)",
       "height_map, height_map_updates (grid_map_msgs/GridMap): while a lead time of 0 is shown",
       "chosen_lead_time (std_msgs/Float64) [s]: of the forecast to be shown, the nearest that there is; 0: "
       "the surface as measured now"},
      {"chosen_forecast (grid_map_msgs/GridMap): elevation and, of an ensemble, spread [m], lead_time [s]",
       "chosen_difference (grid_map_msgs/GridMap): the newest of the lead time nearest to the one chosen",
       "forecast_horizons (aeolian_msgs/ForecastHorizons, latched)"},
      {
          frame_parameter(),
          {"lead_time", 120.0, "s", "shown at first; 0: the surface as measured now", Limits::not_negative()},
      },
      [] { return std::make_shared<ForecastShelf>(); }};
}

}  // namespace aeolian

PLUGINLIB_EXPORT_CLASS(aeolian::ForecastShelf, nodelet::Nodelet)
