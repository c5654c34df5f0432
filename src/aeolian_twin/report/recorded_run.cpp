#include "aeolian_twin/report/recorded_run.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include <aeolian_msgs/Comparison.h>
#include <fmt/format.h>
#include <grid_map_msgs/GridMap.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <tbb/parallel_for.h>

#include "aeolian_core/measure/ripple_statistics.hpp"
#include "aeolian_core/surface/csv.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/geotiff.hpp"
#include "aeolian_core/twin/forecast.hpp"
#include "aeolian_twin/nodes/conversions.hpp"

namespace aeolian {
namespace {

using grid_map_msgs::GridMap;

/// A bag with the topics that the nodes publish.
class RecordedTwin {
 public:
  explicit RecordedTwin(const std::string& path) : path_(path) {
    try {
      bag_.open(path, rosbag::bagmode::Read);
    } catch (const rosbag::BagException& error) {
      throw Error("bag " + path + ": cannot be read: " + error.what());
    }
    require_topics({"/height_map", "/forecast", "/wind_field"});
  }

  /// Calls `visit` for each message of a topic in the order of recording.
  template <class Message, class Visit>
  void for_each(const std::string& topic, Visit visit) const {
    rosbag::View view(bag_, rosbag::TopicQuery(topic));
    for (const rosbag::MessageInstance& instance : view) {
      const auto message = read<Message>(topic, instance);
      try {
        visit(*message);
      } catch (const Error& error) {
        throw Error(fmt::format("bag {}: topic {}: {}", path_, topic, error.what()));
      }
    }
  }

  /// The message of a number, from 0, on a topic; it must be there.
  template <class Message>
  typename Message::ConstPtr message(const std::string& topic, std::size_t number) const {
    rosbag::View view(bag_, rosbag::TopicQuery(topic));
    return read<Message>(topic, *std::next(view.begin(), static_cast<std::ptrdiff_t>(number)));
  }

 private:
  template <class Message>
  typename Message::ConstPtr read(const std::string& topic, const rosbag::MessageInstance& instance) const {
    const auto message = instance.instantiate<Message>();
    if (message == nullptr)
      throw Error(fmt::format("bag {}: topic {} holds {}, must be {}", path_, topic, instance.getDataType(),
                              ros::message_traits::datatype<Message>()));
    return message;
  }

  void require_topics(const std::vector<std::string>& needed) const {
    std::vector<std::string> missing;
    for (const std::string& topic : needed)
      if (rosbag::View(bag_, rosbag::TopicQuery(topic)).size() == 0) missing.push_back(topic);
    if (missing.empty()) return;
    std::set<std::string> present;
    rosbag::View all(bag_);
    for (const rosbag::ConnectionInfo* connection : all.getConnections()) present.insert(connection->topic);
    throw Error(fmt::format("bag {}: nothing was recorded on {}; its topics are: {}", path_,
                            fmt::join(missing, ", "),
                            present.empty() ? "none" : fmt::format("{}", fmt::join(present, ", "))));
  }

  std::string path_;
  rosbag::Bag bag_;
};

/// The wind of a run, by stamp.
class WindHistory {
 public:
  explicit WindHistory(const RecordedTwin& twin) {
    twin.for_each<GridMap>("/wind_field", [&](const GridMap& message) {
      samples_[message.info.header.stamp] = to_wind_field(message);
    });
  }

  ros::Time start() const { return samples_.begin()->first; }

  /// Of the mean wind vector; NaN when it never blew.
  double direction() const {
    double east = 0;
    double north = 0;
    for (const auto& [stamp, wind] : samples_) {
      east += wind.friction_velocity * std::cos(wind.direction);
      north += wind.friction_velocity * std::sin(wind.direction);
    }
    return east == 0 && north == 0 ? NAN : std::atan2(north, east);
  }

  /// Mean over the time after `from` up to `to`, that of the last sample before when there is none; NaN
  /// before the first.
  double friction_velocity(const ros::Time& from, const ros::Time& to) const {
    const auto end = samples_.upper_bound(to);
    if (end == samples_.begin()) return NAN;
    const auto begin = samples_.upper_bound(from);
    if (begin == end) return std::prev(end)->second.friction_velocity;
    double sum = 0;
    for (auto sample = begin; sample != end; ++sample) sum += sample->second.friction_velocity;
    return sum / static_cast<double>(std::distance(begin, end));
  }

 private:
  std::map<ros::Time, WindField> samples_;
};

/// What simulate_field stored beside its bag.
class Truth {
 public:
  explicit Truth(const std::string& directory) : directory_(std::filesystem::path(directory) / "truth") {}

  std::vector<Run::State> states() const {
    const Table table = read_csv((directory_ / "truth.csv").string());
    const std::vector<double>& times = table.column("t_s");
    const std::vector<double>& wavelengths = table.column("wavelength_m");
    const std::vector<double>& heights = table.column("height_m");
    const std::vector<double>& winds = table.column("friction_velocity_m_s");
    std::vector<Run::State> states;
    for (std::size_t i = 0; i < times.size(); ++i)
      states.push_back({times[i], wavelengths[i], heights[i], 1, winds[i]});
    return states;
  }

  /// The file of a time [s], when there is one for the same second.
  std::optional<std::string> surface_at(double time) const {
    const auto path = directory_ / fmt::format("elevation_{:04.0f}.tif", time);
    return std::filesystem::exists(path) ? std::optional<std::string>(path.string()) : std::nullopt;
  }

 private:
  std::filesystem::path directory_;
};

/// Puts a recorded run together.
class RunReader {
 public:
  RunReader(const std::string& bag, const std::string& truth_directory)
      : twin_(bag), wind_(twin_), start_(wind_.start()) {
    run_.title = "A digital twin of wind-blown sand";
    run_.source = std::filesystem::path(bag).filename().string();
    run_.wind_direction = wind_.direction();
    if (!truth_directory.empty()) truth_.emplace(truth_directory);
  }

  Run read() {
    std::size_t number = 0;
    twin_.for_each<GridMap>("/height_map", [&](const GridMap& m) {
      add_state(m, number++);
      if (unread_.size() == read_together) read_ripples();
    });
    read_ripples();
    for (std::size_t i = 0; i < maps_.size(); ++i) run_.states[i].time = seconds(maps_[i].stamp);
    twin_.for_each<aeolian_msgs::Comparison>("/comparison",
                                             [&](const aeolian_msgs::Comparison& m) { add_score(m); });
    if (truth_) run_.true_states = truth_->states();
    const Run::Score* shown = choose_score();
    find_measured(shown != nullptr ? shown->time : run_.states.back().time);
    twin_.for_each<GridMap>("/forecast", [&](const GridMap& m) {
      ++run_.forecasts;
      if (shown != nullptr) take_forecast(m, *shown);
    });
    return std::move(run_);
  }

 private:
  double seconds(const ros::Time& stamp) const { return (stamp - start_).toSec(); }

  void add_state(const GridMap& message, std::size_t number) {
    const ros::Time stamp = message.info.header.stamp;
    start_ = std::min(start_, stamp);
    if (!maps_.empty() && stamp < maps_.back().stamp) return;  // a bag that was looped
    // Two sensors may have seen the same moment, and a latched map may come again: the last one counts.
    if (!maps_.empty() && stamp == maps_.back().stamp) {
      run_.states.pop_back();
      maps_.pop_back();
      if (!unread_.empty()) unread_.pop_back();
    }
    unread_.push_back(to_height_map(message, {layer::elevation}));
    const HeightMap::Layer& elevation = unread_.back().layer(layer::elevation);
    run_.states.push_back(
        {0, NAN, NAN, static_cast<double>(count_known(elevation)) / static_cast<double>(elevation.size()),
         wind_.friction_velocity(maps_.empty() ? start_ : maps_.back().stamp, stamp)});
    maps_.push_back({stamp, number});
  }

  /// Tells the newest states the ripples of their maps.
  void read_ripples() {
    const double direction = std::isnan(run_.wind_direction) ? 0 : run_.wind_direction;
    const std::size_t first = run_.states.size() - unread_.size();
    tbb::parallel_for(std::size_t{0}, unread_.size(), [&](std::size_t i) {
      const HeightMap& map = unread_[i];
      const RippleStatistics ripples =
          ripple_statistics(map.geometry(), map.layer(layer::elevation), direction);
      run_.states[first + i].wavelength = ripples.wavelength;
      run_.states[first + i].height = ripples.height;
    });
    unread_.clear();
  }

  void add_score(const aeolian_msgs::Comparison& m) {
    run_.scores.push_back({seconds(m.header.stamp), m.lead_time, to_comparison(m)});
  }

  /// The last one of the longest lead time; one whose true surface is known goes before.
  const Run::Score* choose_score() const {
    double longest = 0;
    for (const Run::Score& score : run_.scores) longest = std::max(longest, score.lead_time);
    const Run::Score* chosen = nullptr;
    bool chosen_has_truth = false;
    for (const Run::Score& score : run_.scores) {
      if (score.lead_time < 0.98 * longest) continue;
      const bool has_truth = truth_ && truth_->surface_at(score.time);
      if (chosen_has_truth && !has_truth) continue;
      chosen = &score;
      chosen_has_truth = has_truth;
    }
    return chosen;
  }

  /// Takes the map nearest to a time, and the truth of that map.
  void find_measured(double time) {
    std::size_t nearest = 0;
    for (std::size_t i = 0; i < maps_.size(); ++i)
      if (!(std::abs(run_.states[i].time - time) > std::abs(run_.states[nearest].time - time))) nearest = i;
    run_.measured = to_height_map(*twin_.message<GridMap>("/height_map", maps_[nearest].number));
    if (!truth_) return;
    if (const auto file = truth_->surface_at(run_.states[nearest].time)) run_.truth = read_geotiff(*file);
  }

  /// Keeps a forecast when it is the one that was scored.
  void take_forecast(const GridMap& message, const Run::Score& score) {
    if (std::abs(seconds(message.info.header.stamp) - score.time) > 1e-3) return;
    HeightMap map = to_height_map(message);
    for (const float lead : map.layer(layer::lead_time)) {
      if (!std::isfinite(lead)) continue;
      if (std::abs(static_cast<double>(lead) - score.lead_time) > 0.5) return;
      break;
    }
    run_.forecast = std::move(map);
    run_.forecast_lead = score.lead_time;
  }

  /// A map by its number among those of the bag.
  struct Recorded {
    ros::Time stamp;
    std::size_t number;
  };

  RecordedTwin twin_;
  WindHistory wind_;
  ros::Time start_;
  std::vector<Recorded> maps_;  ///< of the states
  static constexpr std::size_t read_together = 16;
  std::vector<HeightMap> unread_;  ///< of the newest states, whose ripples are not known yet
  std::optional<Truth> truth_;
  Run run_;
};

}  // namespace

Run read_recorded_run(const std::string& bag, const std::string& truth_directory) {
  return RunReader(bag, truth_directory).read();
}

}  // namespace aeolian
