#include "aeolian_twin/replay/twin_replay.hpp"

#include <utility>

#include <aeolian_msgs/Comparison.h>
#include <aeolian_msgs/LearnedParameters.h>
#include <fmt/format.h>
#include <tf2_eigen/tf2_eigen.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_twin/nodes/conversions.hpp"
#include "aeolian_twin/nodes/engine_settings.hpp"
#include "aeolian_twin/nodes/frame_check.hpp"
#include "aeolian_twin/nodes/score_output.hpp"
#include "aeolian_twin/nodes/wind_words.hpp"

namespace aeolian {
namespace {

const std::string mapper = "height_mapper";
const std::string estimator = "wind_estimator";
const std::string forecaster = "forecaster";
const std::string comparator = "comparator";

/// More forecasts than this do not run at a time.
constexpr std::size_t most_running = 4;

template <class Message>
boost::shared_ptr<const Message> shared(Message message) {
  return boost::make_shared<const Message>(std::move(message));
}

}  // namespace

TwinReplay::TwinReplay(const ReplayConfig& config, TwinBag& out, Complain complain)
    : config_(config),
      out_(out),
      complain_(std::move(complain)),
      keeper_(config.height_mapper, config.noise, tell(mapper),
              [this](const Eigen::Isometry3d& bed) { publish_bed(bed); }),
      told_(keeper_.live()),
      wind_(config.wind_estimator, config.topics.wind, transforms_, tell(estimator)),
      engine_(read_engine(config.forecaster, tell(forecaster))),
      scorer_(read_scorer(config.comparator)) {
  // What still waits at the end has waited long enough: there is no other time to lose patience at.
  const CloudPlacer::Frames frames{transforms_, config.height_mapper.text("frame_id"), ros::WallDuration(0),
                                   static_cast<std::uint32_t>(config.height_mapper.integer("queue_size"))};
  const CloudPlacer::Use use = [this](const PointCloud& cloud, const Eigen::Isometry3d& pose,
                                      const ros::Time& measured,
                                      const SensorSettings& from) { fuse(cloud, pose, measured, from); };
  for (const SensorSettings& sensor : config.sensors)
    inputs_[sensor.topic] = std::make_unique<Input>(sensor, frames, use, tell(mapper), nullptr);
  prepare_engine(config.forecaster, engine_, tell(forecaster));
}

Tell TwinReplay::tell(const std::string& node) {
  return [this, node](const std::string& thing, bool well, const std::string& line) {
    // The clouds are there, as BagSource knows: that none has come is no news before the bag has begun.
    if (node == mapper && now_.isZero()) return;
    Health& health = health_[node];
    const std::string key = node + ": " + thing;
    if (well) {
      health.good(thing, line);
      last_complaints_.erase(key);
    } else {
      if (health.bad(thing, line)) complain_(fmt::format("{}: {}", key, line));
      last_complaints_[key] = line;
    }
  };
}

std::string TwinReplay::complaints() const {
  std::string all;
  for (const auto& [key, line] : last_complaints_)
    all += fmt::format("{}{}: {}", all.empty() ? "" : "; ", key, line);
  return all.empty() ? "the bag is too short" : all;
}

void TwinReplay::take(const BagSource::Message& message) {
  now_ = message.time;
  std::visit([this](const auto& content) { take_content(content); }, message.content);
}

void TwinReplay::finish() {
  while (!running_.empty()) deliver_first();
  for (const auto& [topic, input] : inputs_) input->watch();
  if (maps_ == 0) throw Error("there is no map: " + complaints());
  if (forecasts_ == 0) throw Error("there is no forecast: " + complaints());
}

void TwinReplay::save_learned(const std::string& path) {
  if (lessons_ > 0) engine_.learner()->save(path);
}

void TwinReplay::take_content(const BagSource::Transforms& transforms) {
  for (const geometry_msgs::TransformStamped& transform : transforms.message->transforms) {
    try {
      transforms_.setTransform(transform, "bag", transforms.are_static);
    } catch (const tf2::TransformException& error) {
      tell(mapper)("transform", false, error.what());
    }
  }
}

void TwinReplay::take_content(const BagSource::Cloud& cloud) {
  const auto input = inputs_.find(cloud.topic);
  input->second->add(cloud.message);
}

void TwinReplay::take_content(const geometry_msgs::TwistStampedConstPtr& wind) {
  auto field = wind_.take_wind(*wind);
  if (!field) return;
  const auto message = shared(std::move(*field));
  write("/wind_field", now_, message);
  const ros::Time& stamp = message->info.header.stamp;
  const WindField felt = to_wind_field(*message);
  try {
    require_frame("/wind_field", message->info.header, config_.forecaster);
    engine_.take_wind({stamp.toSec(), felt.friction_velocity, felt.direction, felt.air_density});
  } catch (const Error& error) {
    tell(forecaster)("wind", false, error.what());
  }
  scorer_.take_wind({clock_.seconds(stamp), felt.friction_velocity, felt.direction, felt.air_density});
}

void TwinReplay::take_content(const aeolian_msgs::WindAheadConstPtr& ahead) {
  try {
    require_frame(config_.topics.wind_ahead, ahead->header, config_.forecaster);
    engine_.give_wind_ahead(to_wind_samples(*ahead, bed_roughness(config_.forecaster)));
  } catch (const Error& error) {
    tell(forecaster)("wind ahead", false, error.what());
  }
}

void TwinReplay::fuse(const PointCloud& cloud, const Eigen::Isometry3d& pose, const ros::Time& measured,
                      const SensorSettings& sensor) {
  told_.note(keeper_.take(cloud, pose, measured, sensor));
  if (keeper_.is_due(measured)) publish_map();
}

void TwinReplay::publish_bed(const Eigen::Isometry3d& bed) {
  tf2_msgs::TFMessage message;
  message.transforms.push_back(tf2::eigenToTransform(bed));
  geometry_msgs::TransformStamped& transform = message.transforms.back();
  transform.header.frame_id = config_.height_mapper.text("frame_id");
  transform.header.stamp = now_;
  transform.child_frame_id = keeper_.live().frame();
  write("/tf_static", now_, shared(std::move(message)));
}

void TwinReplay::publish_map() {
  const auto message = shared(to_message(told_.tell(), keeper_.live().header()));
  ++maps_;
  write("/height_map", now_, message);
  try {
    require_frame("/height_map", message->info.header, config_.wind_estimator);
    wind_.take_map(*message);
  } catch (const Error& error) {
    tell(estimator)("map", false, error.what());
  }
  take_map(*message);
}

/// What forecaster and comparator do with a map.
void TwinReplay::take_map(const GridMap& message) {
  const std_msgs::Header& header = message.info.header;
  deliver_forecasts_due(header.stamp);
  const auto map = std::make_shared<const HeightMap>(to_height_map(message));
  try {
    require_frame("/height_map", header, config_.comparator);
    ForecastScorer::Taken taken = scorer_.take_map(map, clock_.seconds(header.stamp));
    if (taken.begun_anew)
      tell(comparator)("clock", false,
                       fmt::format("time jumped back (a bag that loops?): {} waiting forecasts were dropped",
                                   *taken.begun_anew));
    publish(std::move(taken.scores));
  } catch (const Error& error) {
    tell(comparator)("map", false, error.what());
  }
  try {
    require_frame("/height_map", header, config_.forecaster);
    ForecastEngine::Taken taken = engine_.take_map(*map, header.stamp.toSec());
    tell_of_wind(taken, engine_.settings(), header.stamp, tell(forecaster));
    if (taken.learned) {
      lessons_ += taken.learned->learned ? 1 : 0;
      write("/learned", now_,
            shared(to_message(engine_.learner()->state(), *taken.learned, engine_.believes(), header)));
    }
    if (taken.job) forecast(std::move(*taken.job), header);
  } catch (const Error& error) {
    tell(forecaster)("map", false, error.what());
  }
}

void TwinReplay::forecast(ForecastJob job, const std_msgs::Header& header) {
  running_.push_back({header, now_, std::async(std::launch::async, [this, begun = std::move(job)] {
                        return engine_.run(begun);
                      })});
}

/// Those that could be scored with a map of that time.
void TwinReplay::deliver_forecasts_due(const ros::Time& map) {
  const ros::Duration shortest(engine_.settings().horizons.front());
  const auto is_due = [&](const Running& forecast) {
    return map < forecast.header.stamp || map >= forecast.header.stamp + shortest;
  };
  while (!running_.empty() && (is_due(running_.front()) || running_.size() >= most_running)) deliver_first();
}

void TwinReplay::deliver_first() {
  Running forecast = std::move(running_.front());
  running_.pop_front();
  try {
    const EnsembleForecast result = forecast.result.get();
    ++forecasts_;
    for (const Forecast& at : result.forecasts) {
      std_msgs::Header header = forecast.header;
      header.stamp += ros::Duration(at.lead_time);
      const auto message = shared(to_message(at.map, header));
      write("/forecast", forecast.began, message);
      ForecastScorer::Taken taken = scorer_.take_forecast(
          std::make_shared<const HeightMap>(to_height_map(*message)), clock_.seconds(header.stamp));
      if (taken.oldest_dropped)
        tell(comparator)("pending", false,
                         fmt::format("more than {} forecasts wait (~max_pending): the oldest was dropped",
                                     config_.comparator.integer("max_pending")));
      publish(std::move(taken.scores));
    }
  } catch (const Error& error) {
    tell(forecaster)("forecast", false, error.what());
  }
}

void TwinReplay::publish(std::vector<ForecastScorer::Score> scores) {
  put_out(
      std::move(scores), scorer_,
      {config_.comparator.text("frame_id"), clock_,
       [this](aeolian_msgs::Comparison message) { write("/comparison", now_, shared(std::move(message))); },
       [this](GridMap message) { write("/difference", now_, shared(std::move(message))); },
       tell(comparator)});
}

}  // namespace aeolian
