#pragma once

#include <deque>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <string>

#include <grid_map_msgs/GridMap.h>
#include <tf2/buffer_core.h>

#include "aeolian_core/twin/forecast_engine.hpp"
#include "aeolian_core/twin/forecast_scorer.hpp"
#include "aeolian_twin/nodes/cloud_input.hpp"
#include "aeolian_twin/nodes/health.hpp"
#include "aeolian_twin/nodes/map_keeper.hpp"
#include "aeolian_twin/nodes/relative_clock.hpp"
#include "aeolian_twin/nodes/told_map.hpp"
#include "aeolian_twin/nodes/wind_reader.hpp"
#include "aeolian_twin/replay/bag_source.hpp"
#include "aeolian_twin/replay/twin_bag.hpp"

namespace aeolian {

/// The nodes height_mapper, wind_estimator, forecaster and comparator without a master: each message of a bag
/// goes through what the nodes are made of, in the bag's order, and what they would publish goes into another
/// bag.
///
/// Forecasts run beside the fusion of the clouds that follow, but enter where a forecaster that takes no time
/// would publish them: what comes out depends on nothing but the bag and the parameters.
class TwinReplay {
 public:
  /// One line about something that is amiss and was not before.
  using Complain = std::function<void(const std::string& line)>;

  /// `out` must outlive this. Throws Error for parameters that do not fit together.
  TwinReplay(const ReplayConfig& config, TwinBag& out, Complain complain);
  TwinReplay(const TwinReplay&) = delete;
  TwinReplay& operator=(const TwinReplay&) = delete;

  void take(const BagSource::Message& message);
  /// To be called after the last message. Throws Error, with what was amiss, when there is no map or no
  /// forecast.
  void finish();
  /// Writes what was learned from misses, if anything was.
  void save_learned(const std::string& path);

 private:
  using GridMap = grid_map_msgs::GridMap;
  using Input = CloudInput<ReadCloud>;

  /// A forecast that runs.
  struct Running {
    std_msgs::Header header;  ///< of the map
    ros::Time began;          ///< in the bag
    std::future<EnsembleForecast> result;
  };

  void take_content(const BagSource::Transforms& transforms);
  void take_content(const BagSource::Cloud& cloud);
  void take_content(const geometry_msgs::TwistStampedConstPtr& wind);
  void take_content(const aeolian_msgs::WindAheadConstPtr& ahead);
  void fuse(const PointCloud& cloud, const Eigen::Isometry3d& pose, const ros::Time& measured,
            const SensorSettings& sensor);
  void publish_map();
  void publish_bed(const Eigen::Isometry3d& bed);
  void take_map(const GridMap& message);
  void forecast(ForecastJob job, const std_msgs::Header& header);
  void deliver_forecasts_due(const ros::Time& map);
  void deliver_first();
  void publish(std::vector<ForecastScorer::Score> scores);

  Tell tell(const std::string& node);
  std::string complaints() const;

  template <class Message>
  void write(const std::string& topic, const ros::Time& time, boost::shared_ptr<const Message> message) {
    out_.write(topic, time, std::move(message));
  }

  ReplayConfig config_;
  TwinBag& out_;
  Complain complain_;
  std::map<std::string, Health> health_;                ///< of each node
  std::map<std::string, std::string> last_complaints_;  ///< of each node's things that are amiss

  ros::Time now_;  ///< of the message that is being taken
  tf2::BufferCore transforms_;
  MapKeeper keeper_;
  ToldMap told_;
  std::map<std::string, std::unique_ptr<Input>> inputs_;  ///< by topic
  WindReader wind_;
  ForecastEngine engine_;
  ForecastScorer scorer_;
  RelativeClock clock_;  ///< of the scorer
  std::deque<Running> running_;
  std::size_t maps_ = 0;
  std::size_t lessons_ = 0;
  std::size_t forecasts_ = 0;
};

}  // namespace aeolian
